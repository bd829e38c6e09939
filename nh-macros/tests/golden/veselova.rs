impl Veselova {
    /// The time derivative of the state: the field `x` of the result is ẋ.
    #[must_use]
    #[inline(always)]
    #[allow(clippy::inline_always)]
    pub fn derivative(
        &self,
        t: ::core::primitive::f64,
        state: &VeselovaState,
        input: &(),
    ) -> VeselovaState {
        _ = t;
        _ = input;
        let e1 = ::nonholonomic::__private::Scalar::mul_add(
            self.I[0],
            ::nonholonomic::__private::Scalar::mul_add(
                self.I[1],
                state.g[2] * state.g[2],
                self.I[2] * (state.g[1] * state.g[1]),
            ),
            self.I[1] * self.I[2] * (state.g[0] * state.g[0]),
        );
        let over_norm = 1.0 / e1;
        let force = ::nonholonomic::__private::Scalar::mul_add(
            -((self.I[0] - self.I[2]) * state.w[0]),
            state.w[2],
            ::nonholonomic::__private::Scalar::mul_add(
                -self.c[2],
                state.g[0],
                self.c[0] * state.g[2],
            ),
        );
        let force_2 = ::nonholonomic::__private::Scalar::mul_add(
            (self.I[1] - self.I[2]) * state.w[1],
            state.w[2],
            ::nonholonomic::__private::Scalar::mul_add(
                -self.c[1],
                state.g[2],
                self.c[2] * state.g[1],
            ),
        );
        let moment = ::nonholonomic::__private::Scalar::mul_add(
            -state.g[1],
            force_2,
            state.g[0] * force,
        );
        let turn = self.I[2] * over_norm * moment;
        let force_3 = ::nonholonomic::__private::Scalar::mul_add(
            (self.I[0] - self.I[1]) * state.w[0],
            state.w[1],
            ::nonholonomic::__private::Scalar::mul_add(
                -self.c[0],
                state.g[1],
                self.c[1] * state.g[0],
            ),
        );
        let moment_2 = ::nonholonomic::__private::Scalar::mul_add(
            -state.g[2],
            force_2,
            state.g[0] * force_3,
        );
        let turn_2 = self.I[1] * over_norm * moment_2;
        let y_dot = ::nonholonomic::__private::Scalar::mul_add(
            -state.g[2],
            turn_2,
            -(state.g[1] * turn),
        );
        let moment_3 = ::nonholonomic::__private::Scalar::mul_add(
            -state.g[2],
            force,
            state.g[1] * force_3,
        );
        let turn_3 = self.I[0] * over_norm * moment_3;
        let y_dot_2 = ::nonholonomic::__private::Scalar::mul_add(
            -state.g[2],
            turn_3,
            state.g[0] * turn,
        );
        let y_dot_3 = ::nonholonomic::__private::Scalar::mul_add(
            state.g[1],
            turn_3,
            state.g[0] * turn_2,
        );
        VeselovaState {
            g: [
                ::nonholonomic::__private::Scalar::mul_add(
                    -state.g[2],
                    state.w[1],
                    state.g[1] * state.w[2],
                ),
                ::nonholonomic::__private::Scalar::mul_add(
                    -state.g[0],
                    state.w[2],
                    state.g[2] * state.w[0],
                ),
                ::nonholonomic::__private::Scalar::mul_add(
                    -state.g[1],
                    state.w[0],
                    state.g[0] * state.w[1],
                ),
            ],
            w: [y_dot, y_dot_2, y_dot_3],
        }
    }
    /// The energy y · ∂L/∂y − L.
    #[must_use]
    #[inline]
    pub fn energy(
        &self,
        t: ::core::primitive::f64,
        state: &VeselovaState,
    ) -> ::core::primitive::f64 {
        _ = t;
        let e1 = ::nonholonomic::__private::Scalar::mul_add(
            ::nonholonomic::__private::Scalar::mul_add(
                self.I[2],
                state.w[2] * state.w[2],
                ::nonholonomic::__private::Scalar::mul_add(
                    self.I[1],
                    state.w[1] * state.w[1],
                    self.I[0] * (state.w[0] * state.w[0]),
                ),
            ),
            0.5,
            ::nonholonomic::__private::Scalar::mul_add(
                self.c[2],
                state.g[2],
                ::nonholonomic::__private::Scalar::mul_add(
                    self.c[1],
                    state.g[1],
                    self.c[0] * state.g[0],
                ),
            ),
        );
        e1
    }
    /// The Jacobian of the derivative by the state, and by the inputs: entry (i, j) of the first matrix
    /// is the derivative of component i of ẋ by component j of the state.
    #[must_use]
    #[inline]
    pub fn jacobian(
        &self,
        t: ::core::primitive::f64,
        state: &VeselovaState,
        input: &(),
    ) -> (
        ::nonholonomic::__private::nalgebra::SMatrix<::core::primitive::f64, 6, 6>,
        ::nonholonomic::__private::nalgebra::SMatrix<::core::primitive::f64, 6, 0>,
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
                6,
                6,
            > as ::core::convert::From<[[::core::primitive::f64; 6]; 6]>>::from(rows)
                .transpose(),
            <::nonholonomic::__private::nalgebra::SMatrix<
                ::core::primitive::f64,
                6,
                0,
            > as ::core::convert::From<[[::core::primitive::f64; 6]; 0]>>::from([]),
        )
    }
}
