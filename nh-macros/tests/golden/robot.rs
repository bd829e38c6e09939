impl Robot {
    /// The time derivative of the state: the field `x` of the result is ẋ.
    #[must_use]
    #[inline(always)]
    #[allow(clippy::inline_always)]
    pub fn derivative(
        &self,
        t: ::core::primitive::f64,
        state: &RobotState,
        input: &(),
    ) -> RobotState {
        _ = t;
        _ = input;
        let (sin_theta, cos_theta) = ::nonholonomic::__private::Scalar::sin_cos(
            state.theta,
        );
        let e1 = self.R * (state.psi1_dot + state.psi2_dot);
        let e2 = -0.5 * e1;
        let theta_dot_per_psi1_dot = self.R / self.c;
        let e3 = theta_dot_per_psi1_dot * (state.psi1_dot - state.psi2_dot);
        let e4 = self.m0 * self.l * e3;
        let e5 = 2.0 * self.J2;
        let v_dot_0_mean = -0.25 * self.R
            / ::nonholonomic::__private::Scalar::mul_add(
                ::nonholonomic::__private::Scalar::mul_add(self.m1, 2.0, self.m0),
                self.R * self.R,
                e5,
            ) * e3 * e4;
        let v_dot_0_half = 0.25 * theta_dot_per_psi1_dot
            / ::nonholonomic::__private::Scalar::mul_add(
                self.J,
                theta_dot_per_psi1_dot * theta_dot_per_psi1_dot,
                e5,
            ) * e1 * e4;
        let v_dot_0 = v_dot_0_mean + v_dot_0_half;
        let v_dot_1 = v_dot_0_mean - v_dot_0_half;
        RobotState {
            psi1: state.psi1_dot,
            psi2: state.psi2_dot,
            x: cos_theta * e2,
            y: sin_theta * e2,
            theta: -0.5 * e3,
            psi1_dot: v_dot_0,
            psi2_dot: v_dot_1,
        }
    }
    /// The energy y · ∂L/∂y − L.
    #[must_use]
    #[inline]
    pub fn energy(
        &self,
        t: ::core::primitive::f64,
        state: &RobotState,
    ) -> ::core::primitive::f64 {
        _ = t;
        let e1 = state.psi1_dot - state.psi2_dot;
        let e2 = state.psi1_dot + state.psi2_dot;
        let e3 = ::nonholonomic::__private::Scalar::mul_add(
            0.125 * (self.R * self.R),
            ::nonholonomic::__private::Scalar::mul_add(
                ::nonholonomic::__private::Scalar::mul_add(self.m1, 2.0, self.m0),
                e2 * e2,
                self.J / (self.c * self.c) * (e1 * e1),
            ),
            0.5 * self.J2
                * ::nonholonomic::__private::Scalar::mul_add(
                    state.psi2_dot,
                    state.psi2_dot,
                    state.psi1_dot * state.psi1_dot,
                ),
        );
        e3
    }
    /// The Jacobian of the derivative by the state, and by the inputs: entry (i, j) of the first matrix
    /// is the derivative of component i of ẋ by component j of the state.
    #[must_use]
    #[inline]
    pub fn jacobian(
        &self,
        t: ::core::primitive::f64,
        state: &RobotState,
        input: &(),
    ) -> (
        ::nonholonomic::__private::nalgebra::SMatrix<::core::primitive::f64, 7, 7>,
        ::nonholonomic::__private::nalgebra::SMatrix<::core::primitive::f64, 7, 0>,
    ) {
        let rows = ::nonholonomic::__private::Jacobian::state_jacobian(
            self,
            t,
            state,
            input,
        );
        (
            <::nonholonomic::__private::nalgebra::SMatrix<
                ::core::primitive::f64,
                7,
                7,
            > as ::core::convert::From<[[::core::primitive::f64; 7]; 7]>>::from(rows)
                .transpose(),
            <::nonholonomic::__private::nalgebra::SMatrix<
                ::core::primitive::f64,
                7,
                0,
            > as ::core::convert::From<[[::core::primitive::f64; 7]; 0]>>::from([]),
        )
    }
}
