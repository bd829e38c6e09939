impl Sleigh {
    /// The entries of the Jacobian of the derivative that are not always zero, column by column: those in
    /// the rows `JACOBIAN_ROWS` and the columns `JACOBIAN_COLUMNS`.
    #[must_use]
    #[inline]
    pub fn sparse_jacobian(
        &self,
        t: ::core::primitive::f64,
        state: &SleighState,
        input: &SleighInput,
    ) -> [::core::primitive::f64; 11] {
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
        [
            -(state.v1 * sin_theta),
            (state.v1 * cos_theta),
            1.0,
            (e1 * e3),
            ::nonholonomic::__private::Scalar::mul_add(
                2.0 * self.a,
                state.omega,
                e4 * e3,
            ),
            cos_theta,
            sin_theta,
            (e1 * e2),
            (e4 * e2),
            e1,
            e4,
        ]
    }
    /// The derivative together with the entries of `sparse_jacobian`.
    #[must_use]
    #[inline]
    pub fn sparse_linearized(
        &self,
        t: ::core::primitive::f64,
        state: &SleighState,
        input: &SleighInput,
    ) -> (SleighState, [::core::primitive::f64; 11]) {
        _ = t;
        let (sin_theta, cos_theta) = ::nonholonomic::__private::Scalar::sin_cos(
            state.theta,
        );
        let e1 = state.v1 * cos_theta;
        let e2 = state.v1 * sin_theta;
        let m_a = self.m * self.a;
        let e3 = ::nonholonomic::__private::Scalar::mul_add(
            m_a,
            ::nonholonomic::__private::Scalar::mul_add(-self.b, state.omega, state.v1),
            self.c,
        );
        let e4 = 1.0 / ::nonholonomic::__private::Scalar::mul_add(self.a, m_a, self.J);
        let v_dot_0 = e4
            * ::nonholonomic::__private::Scalar::mul_add(-state.omega, e3, input.torque);
        let v_dot_1 = ::nonholonomic::__private::Scalar::mul_add(
            self.b,
            v_dot_0,
            self.a * (state.omega * state.omega),
        );
        let e5 = -(m_a * state.omega);
        let e6 = ::nonholonomic::__private::Scalar::mul_add(-self.b, e5, -e3);
        let e7 = self.b * e4;
        (
            SleighState {
                theta: state.omega,
                x: e1,
                y: e2,
                omega: v_dot_0,
                v1: v_dot_1,
            },
            [
                -e2,
                e1,
                1.0,
                (e4 * e6),
                ::nonholonomic::__private::Scalar::mul_add(
                    2.0 * self.a,
                    state.omega,
                    e7 * e6,
                ),
                cos_theta,
                sin_theta,
                (e4 * e5),
                (e7 * e5),
                e4,
                e7,
            ],
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
        _ = t;
        _ = input;
        let (sin_theta, cos_theta) = ::nonholonomic::__private::Scalar::sin_cos(
            state.theta,
        );
        let v1_w0 = state.v1 * direction.theta;
        let m_a = self.m * self.a;
        let e1 = -(m_a * state.omega);
        let e2 = ::nonholonomic::__private::Scalar::mul_add(
            -direction.omega,
            ::nonholonomic::__private::Scalar::mul_add(
                self.b,
                e1,
                ::nonholonomic::__private::Scalar::mul_add(
                    m_a,
                    ::nonholonomic::__private::Scalar::mul_add(
                        -self.b,
                        state.omega,
                        state.v1,
                    ),
                    self.c,
                ),
            ),
            ::nonholonomic::__private::Scalar::mul_add(
                direction.v1,
                e1,
                input_direction.torque,
            ),
        );
        let e3 = 1.0 / ::nonholonomic::__private::Scalar::mul_add(self.a, m_a, self.J)
            * e2;
        SleighState {
            theta: direction.omega,
            x: ::nonholonomic::__private::Scalar::mul_add(
                -sin_theta,
                v1_w0,
                cos_theta * direction.v1,
            ),
            y: ::nonholonomic::__private::Scalar::mul_add(
                cos_theta,
                v1_w0,
                sin_theta * direction.v1,
            ),
            omega: e3,
            v1: ::nonholonomic::__private::Scalar::mul_add(
                2.0 * self.a * state.omega,
                direction.omega,
                self.b * e3,
            ),
        }
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
        _ = t;
        _ = input;
        let (sin_theta, cos_theta) = ::nonholonomic::__private::Scalar::sin_cos(
            state.theta,
        );
        let m_a = self.m * self.a;
        let e1 = 1.0 / ::nonholonomic::__private::Scalar::mul_add(self.a, m_a, self.J)
            * ::nonholonomic::__private::Scalar::mul_add(
                self.b,
                weights.v1,
                weights.omega,
            );
        let e2 = -(m_a * state.omega * e1);
        let e3 = ::nonholonomic::__private::Scalar::mul_add(
            -self.b,
            e2,
            ::nonholonomic::__private::Scalar::mul_add(
                -::nonholonomic::__private::Scalar::mul_add(
                    m_a,
                    ::nonholonomic::__private::Scalar::mul_add(
                        -self.b,
                        state.omega,
                        state.v1,
                    ),
                    self.c,
                ),
                e1,
                weights.theta,
            ),
        );
        (
            SleighState {
                theta: state.v1
                    * ::nonholonomic::__private::Scalar::mul_add(
                        -sin_theta,
                        weights.x,
                        cos_theta * weights.y,
                    ),
                x: 0.0,
                y: 0.0,
                omega: ::nonholonomic::__private::Scalar::mul_add(
                    2.0 * self.a * state.omega,
                    weights.v1,
                    e3,
                ),
                v1: ::nonholonomic::__private::Scalar::mul_add(
                    cos_theta,
                    weights.x,
                    ::nonholonomic::__private::Scalar::mul_add(sin_theta, weights.y, e2),
                ),
            },
            SleighInput { torque: e1 },
        )
    }
}
