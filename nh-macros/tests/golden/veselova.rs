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
        let free_z0 = ::nh_runtime::__private::Scalar::mul_add(
            (self.I[1] - self.I[2]) * state.w[1],
            state.w[2],
            ::nh_runtime::__private::Scalar::mul_add(
                -self.c[1],
                state.g[2],
                self.c[2] * state.g[1],
            ),
        );
        let over_i_0 = 1.0 / self.I[0];
        let e1 = over_i_0 * state.g[0];
        let free_z0_2 = ::nh_runtime::__private::Scalar::mul_add(
            -((self.I[0] - self.I[2]) * state.w[0]),
            state.w[2],
            ::nh_runtime::__private::Scalar::mul_add(
                -self.c[2],
                state.g[0],
                self.c[0] * state.g[2],
            ),
        );
        let over_i_1 = 1.0 / self.I[1];
        let e2 = over_i_1 * state.g[1];
        let free_z0_3 = ::nh_runtime::__private::Scalar::mul_add(
            (self.I[0] - self.I[1]) * state.w[0],
            state.w[1],
            ::nh_runtime::__private::Scalar::mul_add(
                -self.c[0],
                state.g[1],
                self.c[1] * state.g[0],
            ),
        );
        let over_i_2 = 1.0 / self.I[2];
        let e3 = over_i_2 * state.g[2];
        let e4 = ::nh_runtime::__private::Scalar::mul_add(
            -free_z0_3,
            e3,
            -::nh_runtime::__private::Scalar::mul_add(free_z0_2, e2, free_z0 * e1),
        )
            / ::nh_runtime::__private::Scalar::mul_add(
                state.g[2],
                e3,
                ::nh_runtime::__private::Scalar::mul_add(state.g[1], e2, state.g[0] * e1),
            );
        VeselovaState {
            g: [
                ::nh_runtime::__private::Scalar::mul_add(
                    -state.g[2],
                    state.w[1],
                    state.g[1] * state.w[2],
                ),
                ::nh_runtime::__private::Scalar::mul_add(
                    -state.g[0],
                    state.w[2],
                    state.g[2] * state.w[0],
                ),
                ::nh_runtime::__private::Scalar::mul_add(
                    -state.g[1],
                    state.w[0],
                    state.g[0] * state.w[1],
                ),
            ],
            w: [
                (over_i_0
                    * ::nh_runtime::__private::Scalar::mul_add(state.g[0], e4, free_z0)),
                (over_i_1
                    * ::nh_runtime::__private::Scalar::mul_add(
                        state.g[1],
                        e4,
                        free_z0_2,
                    )),
                (over_i_2
                    * ::nh_runtime::__private::Scalar::mul_add(
                        state.g[2],
                        e4,
                        free_z0_3,
                    )),
            ],
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
        let e1 = ::nh_runtime::__private::Scalar::mul_add(
            ::nh_runtime::__private::Scalar::mul_add(
                self.I[2],
                state.w[2] * state.w[2],
                ::nh_runtime::__private::Scalar::mul_add(
                    self.I[1],
                    state.w[1] * state.w[1],
                    self.I[0] * (state.w[0] * state.w[0]),
                ),
            ),
            0.5,
            ::nh_runtime::__private::Scalar::mul_add(
                self.c[2],
                state.g[2],
                ::nh_runtime::__private::Scalar::mul_add(
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
        ::nh_runtime::__private::nalgebra::SMatrix<::core::primitive::f64, 6, 6>,
        ::nh_runtime::__private::nalgebra::SMatrix<::core::primitive::f64, 6, 0>,
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
                6,
                6,
            > as ::core::convert::From<[[::core::primitive::f64; 6]; 6]>>::from(rows)
                .transpose(),
            <::nh_runtime::__private::nalgebra::SMatrix<
                ::core::primitive::f64,
                6,
                0,
            > as ::core::convert::From<[[::core::primitive::f64; 6]; 0]>>::from([]),
        )
    }
}
