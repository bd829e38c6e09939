#[automatically_derived]
impl ::nonholonomic::__private::Dynamics for Rails {
    type State = RailsState;
    type Input = ();
    #[inline(always)]
    #[allow(clippy::inline_always)]
    fn derivative(
        &self,
        t: ::core::primitive::f64,
        state: &RailsState,
        input: &(),
    ) -> RailsState {
        Self::derivative(self, t, state, input)
    }
    #[inline]
    fn validate(
        &self,
    ) -> ::core::result::Result<(), ::nonholonomic::__private::ParameterError> {
        Self::validate(self)
    }
}
#[automatically_derived]
impl ::nonholonomic::__private::Energy for Rails {
    #[inline]
    fn energy(
        &self,
        t: ::core::primitive::f64,
        state: &RailsState,
    ) -> ::core::primitive::f64 {
        Self::energy(self, t, state)
    }
}
#[automatically_derived]
impl ::nonholonomic::__private::Constrained for Rails {
    type Constraints = ::nonholonomic::__private::D<2>;
    #[inline]
    fn constraint_residual(
        &self,
        t: ::core::primitive::f64,
        state: &RailsState,
    ) -> [::core::primitive::f64; 2] {
        ::core::convert::From::from(Self::constraint_residual(self, t, state))
    }
    fn constraint_names() -> [&'static ::core::primitive::str; 2] {
        ["constraint_1", "type"]
    }
    #[inline]
    fn project(
        &self,
        t: ::core::primitive::f64,
        state: &mut RailsState,
    ) -> ::core::result::Result<(), ::nonholonomic::__private::ProjectionError> {
        Self::project(self, t, state)
    }
}
impl Rails {
    /// What was derived from the declaration, as text.
    const REPORT: &'static ::core::primitive::str = "Derived by hand.\n\nOperations per evaluation:\n  derivative: no operations\n  energy: no operations\n  velocity: no operations\n  multipliers: 2 multiplications\n  reactions: 1 addition, 2 multiplications\n  constraint_residual: 1 addition, 1 multiply-add\n  project, each step: 1 addition, 1 multiplication, 1 multiply-add, 1 division\n";
    /// The time derivative of the state: the field `x` of the result is ẋ.
    #[must_use]
    #[inline(always)]
    #[allow(clippy::inline_always)]
    fn derivative(
        &self,
        t: ::core::primitive::f64,
        state: &RailsState,
        input: &(),
    ) -> RailsState {
        _ = self;
        _ = t;
        _ = input;
        RailsState {
            x: state.w[0],
            w: [0.0, 0.0],
            v: 0.0,
        }
    }
    /// The energy y · ∂L/∂y − L.
    #[must_use]
    #[inline]
    fn energy(
        &self,
        t: ::core::primitive::f64,
        state: &RailsState,
    ) -> ::core::primitive::f64 {
        _ = self;
        _ = t;
        _ = state;
        0.0
    }
    /// All quasi-velocities, as the constraints give them from the state.
    #[must_use]
    #[inline]
    fn velocity(&self, t: ::core::primitive::f64, state: &RailsState) -> RailsVelocity {
        _ = self;
        _ = t;
        RailsVelocity {
            w: [state.w[0], state.w[1]],
            v: state.v,
        }
    }
    /// The multipliers of the constraints, with their sign in +λ ∂φ/∂y on the side of the forces.
    #[must_use]
    #[inline]
    fn multipliers(
        &self,
        t: ::core::primitive::f64,
        state: &RailsState,
        input: &(),
    ) -> RailsMultipliers {
        _ = t;
        _ = input;
        RailsMultipliers {
            constraint_1: self.m * state.x * state.w[0],
            r#type: 0.0,
        }
    }
    /// The forces along the sections by which the constraints are kept.
    #[must_use]
    #[inline]
    fn reactions(
        &self,
        t: ::core::primitive::f64,
        state: &RailsState,
        input: &(),
    ) -> RailsReactions {
        _ = t;
        _ = input;
        let e1 = self.m * state.x * state.w[0];
        RailsReactions {
            w: [e1, 0.0],
            v: -e1,
        }
    }
    /// The constraints at a state: left-hand side less right-hand side, zero where they hold.
    #[must_use]
    #[inline]
    fn constraint_residual(
        &self,
        t: ::core::primitive::f64,
        state: &RailsState,
    ) -> RailsResidual {
        _ = self;
        _ = t;
        RailsResidual {
            constraint_1: ::nonholonomic::__private::Scalar::mul_add(
                -state.x,
                state.w[0],
                state.w[1],
            ),
            r#type: state.v - state.w[1],
        }
    }
    /// Moves the velocities to the nearest ones that satisfy the constraints, where distance is
    /// measured by the kinetic energy.
    ///
    /// # Errors
    /// If the constraints are not met, because the state is too far from them or they are
    /// dependent there; the state is then as it was.
    fn project(
        &self,
        t: ::core::primitive::f64,
        state: &mut RailsState,
    ) -> ::core::result::Result<(), ::nonholonomic::__private::ProjectionError> {
        [state.w[0], state.w[1], state.v] = ::nonholonomic::__private::project(
            [state.w[0], state.w[1], state.v],
            |start, present| {
                [
                    start[0],
                    (state.x * start[0]),
                    ::nonholonomic::__private::Scalar::mul_add(
                        present[1] - start[1],
                        1.0 / self.m,
                        start[2],
                    ),
                ]
            },
            |present| ::core::convert::From::from(
                Self::constraint_residual(
                    self,
                    t,
                    &RailsState {
                        x: state.x,
                        w: [present[0], present[1]],
                        v: present[2],
                    },
                ),
            ),
        )?;
        ::core::result::Result::Ok(())
    }
    /// Checks the parameters.
    ///
    /// # Errors
    /// The first parameter that is not finite, that breaks an assumption, or that makes an
    /// expression zero by which the equations divide.
    fn validate(
        &self,
    ) -> ::core::result::Result<(), ::nonholonomic::__private::ParameterError> {
        for (name, value) in [("m", self.m)] {
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
}
#[allow(unexpected_cfgs)]
const _: () = {
    #[cfg(rust_analyzer)]
    #[allow(warnings)]
    fn names(system: &Rails, state: &RailsState, velocity: &RailsVelocity) {
        {
            _ = state.x;
        }
        {
            _ = state.w;
            _ = state.v;
        }
        {
            _ = state.w;
            _ = state.x;
            _ = state.w;
            _ = state.v;
            _ = state.w;
        }
    }
};
#[doc(hidden)]
macro_rules! __nh_declaration_Rails_2c1c7c1b4234c327 {
    () => {};
    ($callback:path, { $($rest:tt)* }) => {
        $callback ! { declaration { { base { x } basis { w[2], v } lagrangian { 0 }
        constraints { w[1] = x * w[0]; r#type : v = w[1]; } } { struct Rails { m : f64 }
        } } $($rest)* }
    };
}
#[doc(hidden)]
use __nh_declaration_Rails_2c1c7c1b4234c327 as __nh_declaration_Rails;
__nh_declaration_Rails! {}
