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
        let (sin_theta, cos_theta) = ::nh_runtime::__private::Scalar::sin_cos(
            state.theta,
        );
        let e1 = -0.5 * self.R;
        let e2 = e1 * (state.psi1_dot + state.psi2_dot);
        let over_c = 1.0 / self.c;
        let e3 = over_c * (state.psi1_dot - state.psi2_dot);
        let e4 = ::nh_runtime::__private::Scalar::mul_add(self.m1, 2.0, self.m0);
        let c_squared = self.c * self.c;
        let e5 = e4 * c_squared;
        let r_squared = self.R * self.R;
        let e6 = ::nh_runtime::__private::Scalar::mul_add(
            4.0 * self.J2,
            c_squared,
            (self.J + e5) * r_squared,
        );
        let e7 = (self.J - e5) * r_squared;
        let e8 = 2.0 * self.J2;
        let e9 = self.m0 * self.l * (self.R * over_c)
            * (1.0
                / ::nh_runtime::__private::Scalar::mul_add(
                    e8,
                    c_squared,
                    self.J * r_squared,
                ) / ::nh_runtime::__private::Scalar::mul_add(e4, r_squared, e8)
                * (r_squared * e3));
        let v_dot_0 = 0.25
            * ::nh_runtime::__private::Scalar::mul_add(
                -e7,
                state.psi1_dot,
                e6 * state.psi2_dot,
            ) * e9;
        let v_dot_1 = -0.25
            * ::nh_runtime::__private::Scalar::mul_add(
                -e7,
                state.psi2_dot,
                e6 * state.psi1_dot,
            ) * e9;
        RobotState {
            psi1: state.psi1_dot,
            psi2: state.psi2_dot,
            x: cos_theta * e2,
            y: sin_theta * e2,
            theta: e1 * e3,
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
        let e3 = ::nh_runtime::__private::Scalar::mul_add(
            ::nh_runtime::__private::Scalar::mul_add(self.m1, 2.0, self.m0),
            e2 * e2,
            self.J * (e1 * e1) * (1.0 / (self.c * self.c)),
        );
        ::nh_runtime::__private::Scalar::mul_add(
            0.125 * (self.R * self.R),
            e3,
            0.5 * self.J2
                * ::nh_runtime::__private::Scalar::mul_add(
                    state.psi2_dot,
                    state.psi2_dot,
                    state.psi1_dot * state.psi1_dot,
                ),
        )
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
        ::nh_runtime::__private::nalgebra::SMatrix<::core::primitive::f64, 7, 7>,
        ::nh_runtime::__private::nalgebra::SMatrix<::core::primitive::f64, 7, 0>,
    ) {
        let rows = ::nh_runtime::__private::Jacobian::state_jacobian(
            self,
            t,
            state,
            input,
        );
        (
            <::nh_runtime::__private::nalgebra::SMatrix<
                ::core::primitive::f64,
                7,
                7,
            > as ::core::convert::From<[[::core::primitive::f64; 7]; 7]>>::from(rows)
                .transpose(),
            <::nh_runtime::__private::nalgebra::SMatrix<
                ::core::primitive::f64,
                7,
                0,
            > as ::core::convert::From<[[::core::primitive::f64; 7]; 0]>>::from([]),
        )
    }
}
