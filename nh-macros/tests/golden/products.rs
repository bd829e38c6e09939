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
        let mut all = (
            SleighState {
                theta: state.omega,
                x: t,
                y: t,
                omega: t,
                v1: t,
            },
            [t, t, 1.0, t, t, t, t, t, t, t, t],
        );
        let (sin_theta, cos_theta) = ::nonholonomic::__private::Scalar::sin_cos(
            state.theta,
        );
        all.1[5] = cos_theta;
        all.1[6] = sin_theta;
        let e1 = state.v1 * cos_theta;
        all.0.x = e1;
        all.1[1] = e1;
        let e2 = state.v1 * sin_theta;
        all.0.y = e2;
        let m_a = self.m * self.a;
        let e3 = ::nonholonomic::__private::Scalar::mul_add(
            m_a,
            ::nonholonomic::__private::Scalar::mul_add(-self.b, state.omega, state.v1),
            self.c,
        );
        let e4 = 1.0 / ::nonholonomic::__private::Scalar::mul_add(self.a, m_a, self.J);
        all.1[9] = e4;
        let v_dot_0 = e4
            * ::nonholonomic::__private::Scalar::mul_add(-state.omega, e3, input.torque);
        all.0.omega = v_dot_0;
        let v_dot_1 = ::nonholonomic::__private::Scalar::mul_add(
            self.b,
            v_dot_0,
            self.a * (state.omega * state.omega),
        );
        all.0.v1 = v_dot_1;
        all.1[0] = -e2;
        let e5 = -(m_a * state.omega);
        let e6 = ::nonholonomic::__private::Scalar::mul_add(-self.b, e5, -e3);
        all.1[3] = e4 * e6;
        let e7 = self.b * e4;
        all.1[10] = e7;
        all.1[4] = ::nonholonomic::__private::Scalar::mul_add(
            2.0 * self.a,
            state.omega,
            e7 * e6,
        );
        all.1[7] = e4 * e5;
        all.1[8] = e7 * e5;
        all
    }
}
