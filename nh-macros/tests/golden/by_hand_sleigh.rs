#[automatically_derived]
impl ::nonholonomic::__private::Dynamics for Sleigh {
    type State = SleighState;
    type Input = SleighInput;
    #[inline(always)]
    #[allow(clippy::inline_always)]
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
impl Sleigh {
    /// What was derived from the declaration, as text.
    pub const REPORT: &'static ::core::primitive::str = "Derived by hand.\n\nOperations per evaluation:\n  derivative: 7 multiplications, 2 multiply-adds, 1 division, 1 sin_cos\n  energy: 5 multiplications, 2 multiply-adds\n  velocity: no operations\n  outputs: 5 multiplications, 2 multiply-adds, 1 square root\n";
    /// The time derivative of the state: the field `x` of the result is ẋ.
    #[must_use]
    #[inline(always)]
    #[allow(clippy::inline_always)]
    pub fn derivative(
        &self,
        t: ::core::primitive::f64,
        state: &SleighState,
        input: &SleighInput,
    ) -> SleighState {
        _ = t;
        let (sin_theta, cos_theta) = ::nonholonomic::__private::Scalar::sin_cos(
            state.theta,
        );
        let m_a = self.m * self.a;
        SleighState {
            theta: state.omega,
            x: state.v1 * cos_theta,
            y: state.v1 * sin_theta,
            omega: ::nonholonomic::__private::Scalar::mul_add(
                -(m_a * state.v1),
                state.omega,
                input.torque,
            ) * (1.0 / ::nonholonomic::__private::Scalar::mul_add(self.a, m_a, self.J)),
            v1: self.a * (state.omega * state.omega),
        }
    }
    /// The energy y · ∂L/∂y − L.
    #[must_use]
    #[inline]
    pub fn energy(
        &self,
        t: ::core::primitive::f64,
        state: &SleighState,
    ) -> ::core::primitive::f64 {
        _ = t;
        0.5
            * ::nonholonomic::__private::Scalar::mul_add(
                self.m,
                state.v1 * state.v1,
                ::nonholonomic::__private::Scalar::mul_add(
                    self.m,
                    self.a * self.a,
                    self.J,
                ) * (state.omega * state.omega),
            )
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
        SleighVelocity {
            omega: state.omega,
            v1: state.v1,
            v2: 0.0,
        }
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
        _ = t;
        _ = input;
        let v1_squared = state.v1 * state.v1;
        SleighOutputs {
            speed: ::nonholonomic::__private::Scalar::sqrt(v1_squared),
            E: 0.5
                * ::nonholonomic::__private::Scalar::mul_add(
                    self.m,
                    v1_squared,
                    ::nonholonomic::__private::Scalar::mul_add(
                        self.m,
                        self.a * self.a,
                        self.J,
                    ) * (state.omega * state.omega),
                ),
        }
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
        if !<::core::primitive::f64 as ::nonholonomic::__private::Scalar>::all_ne(
            ::nonholonomic::__private::Scalar::mul_add(self.m, self.a * self.a, self.J),
            <::core::primitive::f64 as ::nonholonomic::__private::Scalar>::ZERO,
        ) {
            return ::core::result::Result::Err(::nonholonomic::__private::ParameterError {
                parameter: "m",
                value: ::nonholonomic::__private::Scalar::to_f64(self.m),
                fault: ::nonholonomic::__private::ParameterFault::ZeroPivot {
                    expression: "J + m*a^2",
                },
            });
        }
        ::core::result::Result::Ok(())
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
