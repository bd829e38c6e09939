impl Ball {
    /// The time derivative of the state: the field `x` of the result is ẋ.
    #[must_use]
    #[inline(always)]
    #[allow(clippy::inline_always)]
    pub fn derivative(
        &self,
        t: ::core::primitive::f64,
        state: &BallState,
        input: &(),
    ) -> BallState {
        _ = t;
        _ = input;
        let e1 = ::nonholonomic::__private::Scalar::mul_add(
            -self.Omega,
            state.y,
            self.r * state.wy,
        );
        let e2 = ::nonholonomic::__private::Scalar::mul_add(
            -self.r,
            state.wx,
            self.Omega * state.x,
        );
        let e3 = self.r * self.Omega
            / ::nonholonomic::__private::Scalar::mul_add(self.r, self.r, self.k2);
        let v_dot_0 = e3 * e1;
        let v_dot_1 = e3 * e2;
        BallState {
            x: e1,
            y: e2,
            wx: v_dot_0,
            wy: v_dot_1,
            wz: 0.0,
        }
    }
    /// The energy y · ∂L/∂y − L.
    #[must_use]
    #[inline]
    pub fn energy(
        &self,
        t: ::core::primitive::f64,
        state: &BallState,
    ) -> ::core::primitive::f64 {
        _ = t;
        let e1 = ::nonholonomic::__private::Scalar::mul_add(
            -self.Omega,
            state.y,
            self.r * state.wy,
        );
        let e2 = ::nonholonomic::__private::Scalar::mul_add(
            -self.r,
            state.wx,
            self.Omega * state.x,
        );
        let e3 = ::nonholonomic::__private::Scalar::mul_add(
            e2,
            e2,
            ::nonholonomic::__private::Scalar::mul_add(
                e1,
                e1,
                self.k2
                    * ::nonholonomic::__private::Scalar::mul_add(
                        state.wz,
                        state.wz,
                        ::nonholonomic::__private::Scalar::mul_add(
                            state.wy,
                            state.wy,
                            state.wx * state.wx,
                        ),
                    ),
            ),
        );
        0.5 * self.m * e3
    }
    /// The Jacobian of the derivative by the state, and by the inputs: entry (i, j) of the first matrix
    /// is the derivative of component i of ẋ by component j of the state.
    #[must_use]
    #[inline]
    pub fn jacobian(
        &self,
        t: ::core::primitive::f64,
        state: &BallState,
        input: &(),
    ) -> (
        ::nonholonomic::__private::nalgebra::SMatrix<::core::primitive::f64, 5, 5>,
        ::nonholonomic::__private::nalgebra::SMatrix<::core::primitive::f64, 5, 0>,
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
                5,
                5,
            > as ::core::convert::From<[[::core::primitive::f64; 5]; 5]>>::from(rows)
                .transpose(),
            <::nonholonomic::__private::nalgebra::SMatrix<
                ::core::primitive::f64,
                5,
                0,
            > as ::core::convert::From<[[::core::primitive::f64; 5]; 0]>>::from([]),
        )
    }
}
