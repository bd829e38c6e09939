#[automatically_derived]
impl ::nonholonomic::__private::Dynamics for Sleigh {
    type State = SleighState;
    type Input = SleighInput;
    #[inline]
    fn derivative(
        &self,
        t: ::core::primitive::f64,
        state: &SleighState,
        input: &SleighInput,
    ) -> SleighState {
        Self::derivative(self, t, state, input)
    }
    #[inline]
    fn validate(
        &self,
    ) -> ::core::result::Result<(), ::nonholonomic::__private::ParameterError> {
        Self::validate(self)
    }
    fn check_input(
        &self,
        input: &SleighInput,
    ) -> ::core::result::Result<(), ::nonholonomic::__private::InputFault> {
        for (name, value) in [("torque", input.torque)] {
            if !::nonholonomic::__private::Scalar::is_finite(value) {
                return ::core::result::Result::Err(::nonholonomic::__private::InputFault {
                    input: name,
                    value: ::nonholonomic::__private::Scalar::to_f64(value),
                });
            }
        }
        ::core::result::Result::Ok(())
    }
}
#[automatically_derived]
impl ::nonholonomic::__private::Energy for Sleigh {
    #[inline]
    fn energy(
        &self,
        t: ::core::primitive::f64,
        state: &SleighState,
    ) -> ::core::primitive::f64 {
        Self::energy(self, t, state)
    }
}
#[automatically_derived]
impl ::nonholonomic::__private::Observed for Sleigh {
    type Outputs = SleighOutputs;
    #[inline]
    fn outputs(
        &self,
        t: ::core::primitive::f64,
        state: &SleighState,
        input: &SleighInput,
    ) -> SleighOutputs {
        Self::outputs(self, t, state, input)
    }
}
#[automatically_derived]
impl ::nonholonomic::__private::TaylorSeries for Sleigh {
    type Workspace<const P: ::core::primitive::usize> = ();
    fn expand<const P: ::core::primitive::usize>(
        &self,
        t: ::core::primitive::f64,
        state: &SleighState,
        input: &SleighInput,
        unit: ::core::primitive::f64,
        series: &mut [SleighState],
        workspace: &mut Self::Workspace<P>,
    ) {
        _ = self;
        _ = t;
        _ = state;
        _ = input;
        _ = (unit, series, workspace);
    }
}
#[automatically_derived]
impl ::nonholonomic::__private::Constrained for Sleigh {
    type Constraints = ::nonholonomic::__private::D<1>;
    #[inline]
    fn constraint_residual(
        &self,
        t: ::core::primitive::f64,
        state: &SleighState,
    ) -> [::core::primitive::f64; 1] {
        ::core::convert::From::from(Self::constraint_residual(self, t, state))
    }
    #[inline]
    fn project(
        &self,
        t: ::core::primitive::f64,
        state: &mut SleighState,
    ) -> ::core::result::Result<(), ::nonholonomic::__private::ProjectionError> {
        Self::project(self, t, state)
    }
}
#[automatically_derived]
impl ::nonholonomic::__private::Jacobian for Sleigh {
    type InputDim = ::nonholonomic::__private::D<1>;
    #[inline]
    fn state_jacobian(
        &self,
        t: ::core::primitive::f64,
        state: &SleighState,
        input: &SleighInput,
    ) -> [[::core::primitive::f64; 5]; 5] {
        _ = self;
        _ = t;
        _ = state;
        _ = input;
        [[<::core::primitive::f64 as ::nonholonomic::__private::Scalar>::ZERO; 5]; 5]
    }
    #[inline]
    fn input_jacobian(
        &self,
        t: ::core::primitive::f64,
        state: &SleighState,
        input: &SleighInput,
    ) -> [[::core::primitive::f64; 1]; 5] {
        _ = self;
        _ = t;
        _ = state;
        _ = input;
        [[<::core::primitive::f64 as ::nonholonomic::__private::Scalar>::ZERO; 1]; 5]
    }
}
impl Sleigh {
    /// What was derived from the declaration, as text.
    pub const REPORT: &'static ::core::primitive::str = "";
    /// The time derivative of the state: the field `x` of the result is ẋ.
    #[must_use]
    #[inline]
    pub fn derivative(
        &self,
        t: ::core::primitive::f64,
        state: &SleighState,
        input: &SleighInput,
    ) -> SleighState {
        _ = self;
        _ = t;
        _ = state;
        _ = input;
        ::core::default::Default::default()
    }
    /// Checks the parameters.
    ///
    /// # Errors
    /// The first parameter that is not finite, that breaks an assumption, or that makes an
    /// expression zero by which the equations divide.
    pub fn validate(
        &self,
    ) -> ::core::result::Result<(), ::nonholonomic::__private::ParameterError> {
        for (name, value) in [
            ("m", self.m),
            ("J", self.J),
            ("a", self.a),
            ("c", self.c),
        ] {
            if !::nonholonomic::__private::Scalar::is_finite(value) {
                return ::core::result::Result::Err(::nonholonomic::__private::ParameterError {
                    parameter: name,
                    value: ::nonholonomic::__private::Scalar::to_f64(value),
                    fault: ::nonholonomic::__private::ParameterFault::NotFinite,
                });
            }
        }
        ::core::result::Result::Ok(())
    }
    /// The energy y · ∂L/∂y − L.
    #[must_use]
    #[inline]
    pub fn energy(
        &self,
        t: ::core::primitive::f64,
        state: &SleighState,
    ) -> ::core::primitive::f64 {
        _ = self;
        _ = t;
        _ = state;
        <::core::primitive::f64 as ::nonholonomic::__private::Scalar>::ZERO
    }
    /// All quasi-velocities, as the constraints give them from the state.
    #[must_use]
    #[inline]
    pub fn velocity(
        &self,
        t: ::core::primitive::f64,
        state: &SleighState,
    ) -> SleighVelocity {
        _ = self;
        _ = t;
        _ = state;
        ::core::default::Default::default()
    }
    /// The observables at a state.
    #[must_use]
    #[inline]
    pub fn outputs(
        &self,
        t: ::core::primitive::f64,
        state: &SleighState,
        input: &SleighInput,
    ) -> SleighOutputs {
        _ = self;
        _ = t;
        _ = state;
        _ = input;
        ::core::default::Default::default()
    }
    /// The multipliers of the constraints, with their sign in +λ ∂φ/∂y on the side of the forces.
    #[must_use]
    #[inline]
    pub fn multipliers(
        &self,
        t: ::core::primitive::f64,
        state: &SleighState,
        input: &SleighInput,
    ) -> SleighMultipliers {
        _ = self;
        _ = t;
        _ = state;
        _ = input;
        ::core::default::Default::default()
    }
    /// The constraints at a state: left-hand side less right-hand side, zero where they hold.
    #[must_use]
    #[inline]
    pub fn constraint_residual(
        &self,
        t: ::core::primitive::f64,
        state: &SleighState,
    ) -> SleighResidual {
        _ = self;
        _ = t;
        _ = state;
        ::core::default::Default::default()
    }
    /// The first Taylor coefficients of the solution through a state, with a constant input:
    /// x(t + τ) = Σ x_k τᵏ.
    #[must_use]
    #[inline]
    pub fn taylor<const P: ::core::primitive::usize>(
        &self,
        t: ::core::primitive::f64,
        state: &SleighState,
        input: &SleighInput,
    ) -> [SleighState; P] {
        ::nonholonomic::__private::TaylorSeries::taylor::<P>(self, t, state, input)
    }
    /// Moves the velocities to the nearest ones that satisfy the constraints, where distance is
    /// measured by the kinetic energy.
    ///
    /// # Errors
    /// If the constraints are not met, because the state is too far from them or they are
    /// dependent there; the state is then as it was.
    pub fn project(
        &self,
        t: ::core::primitive::f64,
        state: &mut SleighState,
    ) -> ::core::result::Result<(), ::nonholonomic::__private::ProjectionError> {
        _ = (self, t, state);
        ::core::result::Result::Ok(())
    }
    /// The Jacobian of the derivative by the state, and by the inputs: entry (i, j) of the first matrix
    /// is the derivative of component i of ẋ by component j of the state.
    #[must_use]
    #[inline]
    pub fn jacobian(
        &self,
        t: ::core::primitive::f64,
        state: &SleighState,
        input: &SleighInput,
    ) -> (
        ::nonholonomic::__private::nalgebra::SMatrix<::core::primitive::f64, 5, 5>,
        ::nonholonomic::__private::nalgebra::SMatrix<::core::primitive::f64, 5, 1>,
    ) {
        _ = self;
        _ = t;
        _ = state;
        _ = input;
        (
            <::nonholonomic::__private::nalgebra::SMatrix<
                ::core::primitive::f64,
                5,
                5,
            > as ::core::convert::From<
                [[::core::primitive::f64; 5]; 5],
            >>::from(
                [[<::core::primitive::f64 as ::nonholonomic::__private::Scalar>::ZERO; 5]; 5],
            ),
            <::nonholonomic::__private::nalgebra::SMatrix<
                ::core::primitive::f64,
                5,
                1,
            > as ::core::convert::From<
                [[::core::primitive::f64; 5]; 1],
            >>::from(
                [[<::core::primitive::f64 as ::nonholonomic::__private::Scalar>::ZERO; 5]; 1],
            ),
        )
    }
    /// The row of each entry of `sparse_jacobian`: a component of the derivative.
    pub const JACOBIAN_ROWS: [::core::primitive::usize; 0] = [];
    /// The column of each entry of `sparse_jacobian`, ascending: a variable of the state, or behind these an
    /// input.
    pub const JACOBIAN_COLUMNS: [::core::primitive::usize; 0] = [];
    /// The entries of the Jacobian of the derivative that are not always zero, column by column: those in
    /// the rows `JACOBIAN_ROWS` and the columns `JACOBIAN_COLUMNS`.
    #[must_use]
    #[inline]
    pub fn sparse_jacobian(
        &self,
        t: ::core::primitive::f64,
        state: &SleighState,
        input: &SleighInput,
    ) -> [::core::primitive::f64; 0] {
        _ = self;
        _ = t;
        _ = state;
        _ = input;
        []
    }
    /// The derivative together with the entries of `sparse_jacobian`.
    #[must_use]
    #[inline]
    pub fn sparse_linearized(
        &self,
        t: ::core::primitive::f64,
        state: &SleighState,
        input: &SleighInput,
    ) -> (SleighState, [::core::primitive::f64; 0]) {
        _ = self;
        _ = t;
        _ = state;
        _ = input;
        (
            SleighState {
                theta: <::core::primitive::f64 as ::nonholonomic::__private::Scalar>::ZERO,
                x: <::core::primitive::f64 as ::nonholonomic::__private::Scalar>::ZERO,
                y: <::core::primitive::f64 as ::nonholonomic::__private::Scalar>::ZERO,
                omega: <::core::primitive::f64 as ::nonholonomic::__private::Scalar>::ZERO,
                v1: <::core::primitive::f64 as ::nonholonomic::__private::Scalar>::ZERO,
            },
            [],
        )
    }
    /// The Jacobian of the derivative times a direction: how the derivative changes where the state
    /// changes along `direction`, and the inputs along `input_direction`.
    #[must_use]
    #[inline]
    pub fn jacobian_product(
        &self,
        t: ::core::primitive::f64,
        state: &SleighState,
        input: &SleighInput,
        direction: &SleighState,
        input_direction: &SleighInput,
    ) -> SleighState {
        _ = self;
        _ = t;
        _ = state;
        _ = input;
        _ = direction;
        _ = input_direction;
        ::core::default::Default::default()
    }
    /// The transpose of the Jacobian of the derivative times `weights`: the derivatives by the state,
    /// and by the inputs, of the sum of the components of ẋ with these weights.
    #[must_use]
    #[inline]
    pub fn adjoint_product(
        &self,
        t: ::core::primitive::f64,
        state: &SleighState,
        input: &SleighInput,
        weights: &SleighState,
    ) -> (SleighState, SleighInput) {
        _ = self;
        _ = t;
        _ = state;
        _ = input;
        _ = weights;
        ::core::default::Default::default()
    }
}
#[allow(unexpected_cfgs)]
const _: () = {
    #[cfg(rust_analyzer)]
    #[allow(warnings)]
    fn names(
        system: &Sleigh,
        state: &SleighState,
        velocity: &SleighVelocity,
        input: &SleighInput,
        outputs: &SleighOutputs,
    ) {
        {
            _ = state.theta;
            _ = state.x;
            _ = state.y;
        }
        {
            _ = state.omega;
            _ = state.v1;
            _ = velocity.v2;
        }
        {
            _ = velocity.v2;
        }
        {
            _ = input.torque;
        }
        {
            _ = outputs.speed;
            _ = state.v1;
            _ = outputs.E;
            _ = state.v1;
        }
    }
};
#[doc(hidden)]
#[allow(non_local_definitions)]
#[macro_export]
macro_rules! __nh_declaration_Sleigh_4d621d80cebc5a31 {
    () => {};
    ($callback:path, { $($rest:tt)* }) => {
        $callback ! { declaration { { base { theta, #[doc = " Along the first axis. "] x,
        y } basis { omega, v1, v2 } lagrangian { 0 } constraints { v2 = 0; } inputs {
        torque } outputs { speed = v1; E = v1; } } { #[doc =
        " A rigid body on a plane, carried by a knife edge."] #[derive(Clone, Copy,
        Debug)] pub struct Sleigh { #[doc = " Mass. "] pub m : f64, #[doc = " Inertia. "]
        pub J : f64, #[doc = " Offset. "] pub a : f64, #[doc = " Not used. "] pub c : f64
        } } } $($rest)* }
    };
}
#[doc(hidden)]
pub use __nh_declaration_Sleigh_4d621d80cebc5a31 as __nh_declaration_Sleigh;
__nh_declaration_Sleigh! {}
