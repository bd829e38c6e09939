impl Sleigh {
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
        let v_dot_0 = ::nonholonomic::__private::Scalar::mul_add(
            -state.omega,
            ::nonholonomic::__private::Scalar::mul_add(
                m_a,
                ::nonholonomic::__private::Scalar::mul_add(
                    -self.b,
                    state.omega,
                    state.v1,
                ),
                self.c,
            ),
            input.torque,
        ) * (1.0 / ::nonholonomic::__private::Scalar::mul_add(self.a, m_a, self.J));
        let v_dot_1 = ::nonholonomic::__private::Scalar::mul_add(
            self.b,
            v_dot_0,
            self.a * (state.omega * state.omega),
        );
        SleighState {
            theta: state.omega,
            x: state.v1 * cos_theta,
            y: state.v1 * sin_theta,
            omega: v_dot_0,
            v1: v_dot_1,
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
        let m_v1 = self.m * state.v1;
        let e1 = ::nonholonomic::__private::Scalar::mul_add(
            -(0.5
                * ::nonholonomic::__private::Scalar::mul_add(
                    self.m,
                    ::nonholonomic::__private::Scalar::mul_add(
                        self.b,
                        self.b,
                        self.a * self.a,
                    ),
                    self.J,
                )),
            state.omega,
            self.b * m_v1,
        );
        ::nonholonomic::__private::Scalar::mul_add(
            -state.omega,
            e1,
            0.5 * state.v1 * m_v1,
        )
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
        _ = t;
        _ = input;
        let (sin_theta, cos_theta) = ::nonholonomic::__private::Scalar::sin_cos(
            state.theta,
        );
        let m_a = self.m * self.a;
        let e1 = 1.0 / ::nonholonomic::__private::Scalar::mul_add(self.a, m_a, self.J);
        let e2 = -(m_a * state.omega);
        let e3 = ::nonholonomic::__private::Scalar::mul_add(
            -self.b,
            e2,
            -::nonholonomic::__private::Scalar::mul_add(
                m_a,
                ::nonholonomic::__private::Scalar::mul_add(
                    -self.b,
                    state.omega,
                    state.v1,
                ),
                self.c,
            ),
        );
        let e4 = self.b * e1;
        (
            <::nonholonomic::__private::nalgebra::SMatrix<
                ::core::primitive::f64,
                5,
                5,
            > as ::core::convert::From<
                [[::core::primitive::f64; 5]; 5],
            >>::from([
                [0.0, -(state.v1 * sin_theta), (state.v1 * cos_theta), 0.0, 0.0],
                [0.0, 0.0, 0.0, 0.0, 0.0],
                [0.0, 0.0, 0.0, 0.0, 0.0],
                [
                    1.0,
                    0.0,
                    0.0,
                    (e1 * e3),
                    ::nonholonomic::__private::Scalar::mul_add(
                        2.0 * self.a,
                        state.omega,
                        e4 * e3,
                    ),
                ],
                [0.0, cos_theta, sin_theta, (e1 * e2), (e4 * e2)],
            ]),
            <::nonholonomic::__private::nalgebra::SMatrix<
                ::core::primitive::f64,
                5,
                1,
            > as ::core::convert::From<
                [[::core::primitive::f64; 5]; 1],
            >>::from([[0.0, 0.0, 0.0, e1, e4]]),
        )
    }
}
