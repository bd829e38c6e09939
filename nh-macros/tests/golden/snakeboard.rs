impl Snakeboard {
    /// The time derivative of the state: the field `x` of the result is ẋ.
    #[must_use]
    #[inline(always)]
    #[allow(clippy::inline_always)]
    pub fn derivative(
        &self,
        t: ::core::primitive::f64,
        state: &SnakeboardState,
        input: &SnakeboardInput,
    ) -> SnakeboardState {
        _ = t;
        let (sin_theta, cos_theta) = ::nonholonomic::__private::Scalar::sin_cos(
            state.theta,
        );
        let (sin_phi, cos_phi) = ::nonholonomic::__private::Scalar::sin_cos(state.phi);
        let e1 = sin_phi / cos_phi;
        let u1_dphi = state.u1 * state.dphi;
        let e2 = self.J0 * u1_dphi;
        let m_l = self.m * self.l;
        let e3 = 1.0
            / ::nonholonomic::__private::Scalar::mul_add(
                -self.l,
                m_l,
                self.J0 * (sin_phi * sin_phi),
            );
        let e4 = ::nonholonomic::__private::Scalar::mul_add(
            -self.l,
            ::nonholonomic::__private::Scalar::mul_add(
                -m_l,
                u1_dphi,
                cos_phi * cos_phi * input.rotor,
            ),
            -e2,
        ) * e3;
        let v_dot_2 = 0.5 / self.J1 * input.steering;
        SnakeboardState {
            x: state.u1 * cos_theta,
            y: state.u1 * sin_theta,
            theta: state.u1 * e1 * (-1.0 / self.l),
            psi: state.dpsi,
            phi: state.dphi,
            u1: e4 * e1,
            dpsi: m_l / self.J0
                * ::nonholonomic::__private::Scalar::mul_add(-self.l, input.rotor, -e2)
                * e3,
            dphi: v_dot_2,
        }
    }
    /// The energy y · ∂L/∂y − L.
    #[must_use]
    #[inline]
    pub fn energy(
        &self,
        t: ::core::primitive::f64,
        state: &SnakeboardState,
    ) -> ::core::primitive::f64 {
        _ = t;
        let (sin_phi, cos_phi) = ::nonholonomic::__private::Scalar::sin_cos(state.phi);
        let j0_dpsi = self.J0 * state.dpsi;
        let e1 = state.u1 / cos_phi;
        let e2 = ::nonholonomic::__private::Scalar::mul_add(
            -::nonholonomic::__private::Scalar::mul_add(
                -(0.5 * self.m),
                e1,
                sin_phi * j0_dpsi * (1.0 / self.l),
            ),
            e1,
            ::nonholonomic::__private::Scalar::mul_add(
                0.5 * state.dpsi,
                j0_dpsi,
                self.J1 * (state.dphi * state.dphi),
            ),
        );
        e2
    }
    /// The Jacobian of the derivative by the state, and by the inputs: entry (i, j) of the first matrix
    /// is the derivative of component i of ẋ by component j of the state.
    #[must_use]
    #[inline]
    pub fn jacobian(
        &self,
        t: ::core::primitive::f64,
        state: &SnakeboardState,
        input: &SnakeboardInput,
    ) -> (
        ::nonholonomic::__private::nalgebra::SMatrix<::core::primitive::f64, 8, 8>,
        ::nonholonomic::__private::nalgebra::SMatrix<::core::primitive::f64, 8, 2>,
    ) {
        _ = t;
        let (sin_theta, cos_theta) = ::nonholonomic::__private::Scalar::sin_cos(
            state.theta,
        );
        let (sin_phi, cos_phi) = ::nonholonomic::__private::Scalar::sin_cos(state.phi);
        let e1 = sin_phi / cos_phi;
        let e2 = ::nonholonomic::__private::Scalar::mul_add(e1, e1, 1.0);
        let e3 = -1.0 / self.l;
        let m_l = self.m * self.l;
        let e4 = self.l * m_l;
        let e5 = sin_phi * sin_phi;
        let e6 = -1.0 / ::nonholonomic::__private::Scalar::mul_add(self.J0, e5, -e4);
        let l_rotor = self.l * input.rotor;
        let e7 = 2.0 * e6;
        let u1_dphi = state.u1 * state.dphi;
        let e8 = self.J0 * u1_dphi;
        let e9 = ::nonholonomic::__private::Scalar::mul_add(
            self.l,
            ::nonholonomic::__private::Scalar::mul_add(
                -m_l,
                u1_dphi,
                cos_phi * cos_phi * input.rotor,
            ),
            e8,
        );
        let e10 = e1 * ((self.J0 - e4) * e6);
        let e11 = sin_phi * cos_phi;
        let e12 = m_l * e6;
        let d_v_dot_1 = (e8 + l_rotor) * e12 * e7 * e11;
        let d_v_dot_2 = 0.5 / self.J1;
        (
            <::nonholonomic::__private::nalgebra::SMatrix<
                ::core::primitive::f64,
                8,
                8,
            > as ::core::convert::From<
                [[::core::primitive::f64; 8]; 8],
            >>::from([
                [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
                [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
                [
                    -(state.u1 * sin_theta),
                    (state.u1 * cos_theta),
                    0.0,
                    0.0,
                    0.0,
                    0.0,
                    0.0,
                    0.0,
                ],
                [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
                [
                    0.0,
                    0.0,
                    (e3 * state.u1 * e2),
                    0.0,
                    0.0,
                    (::nonholonomic::__private::Scalar::mul_add(
                        ::nonholonomic::__private::Scalar::mul_add(
                            -l_rotor,
                            2.0,
                            e9
                                * ::nonholonomic::__private::Scalar::mul_add(
                                    self.J0,
                                    e7,
                                    e2,
                                ),
                        ),
                        e5,
                        e9,
                    ) * e6),
                    d_v_dot_1,
                    0.0,
                ],
                [
                    cos_theta,
                    sin_theta,
                    (e3 * e1),
                    0.0,
                    0.0,
                    (state.dphi * e10),
                    (state.dphi * e12),
                    0.0,
                ],
                [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0],
                [0.0, 0.0, 0.0, 0.0, 1.0, (state.u1 * e10), (state.u1 * e12), 0.0],
            ]),
            <::nonholonomic::__private::nalgebra::SMatrix<
                ::core::primitive::f64,
                8,
                2,
            > as ::core::convert::From<
                [[::core::primitive::f64; 8]; 2],
            >>::from([
                [
                    0.0,
                    0.0,
                    0.0,
                    0.0,
                    0.0,
                    (self.l * e6 * e11),
                    (self.l / self.J0 * e12),
                    0.0,
                ],
                [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, d_v_dot_2],
            ]),
        )
    }
}
