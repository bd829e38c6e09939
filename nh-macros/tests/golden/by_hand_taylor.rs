#[automatically_derived]
impl ::nonholonomic::__private::TaylorSeries for Sleigh {
    type Workspace<const P: ::core::primitive::usize> = ::nonholonomic::__private::History<
        ::core::primitive::f64,
        5,
        1,
        P,
    >;
    fn expand<const P: ::core::primitive::usize>(
        &self,
        t: ::core::primitive::f64,
        state: &SleighState,
        input: &SleighInput,
        unit: ::core::primitive::f64,
        series: &mut [SleighState],
        workspace: &mut Self::Workspace<P>,
    ) {
        _ = t;
        let (sin_theta, cos_theta) = ::nonholonomic::__private::Scalar::sin_cos(
            state.theta,
        );
        let m_a = self.m * self.a;
        let e1 = m_a * state.v1;
        let e2 = 1.0 / (self.a * m_a + self.J);
        workspace.restart();
        if let ::core::option::Option::Some(slot) = series.first_mut() {
            *slot = *state;
        }
        let mut rates: [::core::primitive::f64; 5] = [
            state.omega,
            (state.v1 * cos_theta),
            (state.v1 * sin_theta),
            ((input.torque - e1 * state.omega) * e2),
            (self.a * (state.omega * state.omega)),
        ];
        let mut k = <::core::primitive::f64 as ::nonholonomic::__private::Scalar>::ZERO;
        let end = if series.len() < P { series.len() } else { P };
        for index in 1..end {
            k += <::core::primitive::f64 as ::nonholonomic::__private::Scalar>::ONE;
            let state_k = SleighState {
                theta: unit * rates[0] / k,
                x: unit * rates[1] / k,
                y: unit * rates[2] / k,
                omega: unit * rates[3] / k,
                v1: unit * rates[4] / k,
            };
            if let ::core::option::Option::Some(slot) = series.get_mut(index) {
                *slot = state_k;
            }
            if index + 1 == end {
                break;
            }
            let sums = workspace.products();
            let squared = workspace.squares();
            let e3 = k * state_k.theta;
            let sin_theta_k = ::nonholonomic::__private::Scalar::mul_add(
                e3,
                cos_theta,
                sums[0],
            ) / k;
            let cos_theta_k = -(::nonholonomic::__private::Scalar::mul_add(
                e3,
                sin_theta,
                sums[1],
            ) / k);
            let e4 = ::nonholonomic::__private::Scalar::mul_add(
                state.v1,
                cos_theta_k,
                ::nonholonomic::__private::Scalar::mul_add(
                    state_k.v1,
                    cos_theta,
                    sums[2],
                ),
            );
            let e5 = ::nonholonomic::__private::Scalar::mul_add(
                state.v1,
                sin_theta_k,
                ::nonholonomic::__private::Scalar::mul_add(
                    state_k.v1,
                    sin_theta,
                    sums[3],
                ),
            );
            let e6 = state_k.v1 * m_a;
            let e7 = ::nonholonomic::__private::Scalar::mul_add(
                e1,
                state_k.omega,
                ::nonholonomic::__private::Scalar::mul_add(e6, state.omega, sums[4]),
            );
            let e8 = -e7;
            let e9 = e8 * e2;
            let omega_squared_k = ::nonholonomic::__private::Scalar::mul_add(
                (state.omega + state.omega),
                state_k.omega,
                squared[0],
            );
            let e10 = omega_squared_k * self.a;
            workspace
                .add(
                    [cos_theta_k, sin_theta_k, cos_theta_k, sin_theta_k, state_k.omega],
                    [e3, e3, state_k.v1, state_k.v1, e6],
                    [state_k.omega],
                );
            rates = [state_k.omega, e4, e5, e9, e10];
        }
    }
}
