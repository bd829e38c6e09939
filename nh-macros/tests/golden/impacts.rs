/// The impact `touch` of [`Wheel`], for [`advance_with_impacts`](nonholonomic::impacts::advance_with_impacts).
#[derive(
    ::core::clone::Clone,
    ::core::marker::Copy,
    ::core::fmt::Debug,
    ::core::default::Default
)]
struct WheelTouchImpact;
#[automatically_derived]
impl ::nonholonomic::__private::impacts::Impact<Wheel, 2> for WheelTouchImpact {
    fn names(&self) -> [&'static ::core::primitive::str; 2] {
        ["touch[0]", "touch[1]"]
    }
    fn restitution(&self, system: &Wheel) -> ::core::primitive::f64 {
        _ = system;
        system.e
    }
    fn bounces(&self) -> [::core::primitive::bool; 2] {
        [true, false]
    }
    fn is_homogeneous(&self) -> ::core::primitive::bool {
        true
    }
    fn sizes(
        &self,
        system: &Wheel,
        t: ::core::primitive::f64,
        state: &WheelState,
    ) -> [::core::primitive::f64; 2] {
        _ = (system, t, state);
        [
            <::core::primitive::f64 as ::nonholonomic::__private::Scalar>::abs(state.y),
            <::core::primitive::f64 as ::nonholonomic::__private::Scalar>::ZERO,
        ]
    }
    fn gaps(
        &self,
        system: &Wheel,
        t: ::core::primitive::f64,
        state: &WheelState,
    ) -> [::core::option::Option<::core::primitive::f64>; 2] {
        let gap0 = system.event_touch(t, state);
        [::core::option::Option::Some(gap0), ::core::option::Option::None]
    }
    fn rows(
        &self,
        system: &Wheel,
        t: ::core::primitive::f64,
        state: &WheelState,
    ) -> ::nonholonomic::__private::impacts::Rows<
        ::core::primitive::f64,
        ::nonholonomic::__private::VecOf<Wheel>,
        2,
    > {
        _ = (system, t, state);
        let mobility = 1.0 / system.m;
        let e1 = system.r / system.J;
        let mobility_2 = ::nonholonomic::__private::Scalar::mul_add(
            system.r,
            e1,
            mobility,
        );
        ::nonholonomic::__private::impacts::Rows {
            approach: [
                state.y_dot,
                ::nonholonomic::__private::Scalar::mul_add(
                    system.r,
                    state.phi_dot,
                    state.x_dot,
                ),
            ],
            response: [
                [
                    <::core::primitive::f64 as ::nonholonomic::__private::Scalar>::ZERO,
                    <::core::primitive::f64 as ::nonholonomic::__private::Scalar>::ZERO,
                    <::core::primitive::f64 as ::nonholonomic::__private::Scalar>::ZERO,
                    0.0,
                    mobility,
                    0.0,
                ],
                [
                    <::core::primitive::f64 as ::nonholonomic::__private::Scalar>::ZERO,
                    <::core::primitive::f64 as ::nonholonomic::__private::Scalar>::ZERO,
                    <::core::primitive::f64 as ::nonholonomic::__private::Scalar>::ZERO,
                    mobility,
                    0.0,
                    e1,
                ],
            ],
            mobility: [[mobility, 0.0], [0.0, mobility_2]],
        }
    }
}
/// The impact `stop` of [`Wheel`], for [`advance_with_impacts`](nonholonomic::impacts::advance_with_impacts).
#[derive(
    ::core::clone::Clone,
    ::core::marker::Copy,
    ::core::fmt::Debug,
    ::core::default::Default
)]
struct WheelStopImpact;
#[automatically_derived]
impl ::nonholonomic::__private::impacts::Impact<Wheel, 1> for WheelStopImpact {
    fn names(&self) -> [&'static ::core::primitive::str; 1] {
        ["stop"]
    }
    fn restitution(&self, system: &Wheel) -> ::core::primitive::f64 {
        _ = system;
        0.0
    }
    fn bounces(&self) -> [::core::primitive::bool; 1] {
        [false]
    }
    fn is_homogeneous(&self) -> ::core::primitive::bool {
        true
    }
    fn sizes(
        &self,
        system: &Wheel,
        t: ::core::primitive::f64,
        state: &WheelState,
    ) -> [::core::primitive::f64; 1] {
        _ = (system, t, state);
        [<::core::primitive::f64 as ::nonholonomic::__private::Scalar>::ZERO]
    }
    fn gaps(
        &self,
        system: &Wheel,
        t: ::core::primitive::f64,
        state: &WheelState,
    ) -> [::core::option::Option<::core::primitive::f64>; 1] {
        _ = (system, t, state);
        [::core::option::Option::None]
    }
    fn rows(
        &self,
        system: &Wheel,
        t: ::core::primitive::f64,
        state: &WheelState,
    ) -> ::nonholonomic::__private::impacts::Rows<
        ::core::primitive::f64,
        ::nonholonomic::__private::VecOf<Wheel>,
        1,
    > {
        _ = (system, t, state);
        let mobility = 1.0 / system.J;
        ::nonholonomic::__private::impacts::Rows {
            approach: [state.phi_dot],
            response: [
                [
                    <::core::primitive::f64 as ::nonholonomic::__private::Scalar>::ZERO,
                    <::core::primitive::f64 as ::nonholonomic::__private::Scalar>::ZERO,
                    <::core::primitive::f64 as ::nonholonomic::__private::Scalar>::ZERO,
                    0.0,
                    0.0,
                    mobility,
                ],
            ],
            mobility: [[mobility]],
        }
    }
}
impl Wheel {
    /// The state after the impact `touch`, and its impulses.
    ///
    /// A gap is closed where it is not above 0 by more than rounding. A state in which all gaps are open, or
    /// separate, comes back unchanged with zero impulses.
    ///
    /// # Errors
    /// If rows are dependent at the state, the coefficient of restitution is outside 0 … 1, or closed rows do not
    /// come to an end: with the row, by name.
    fn impact_touch(
        &self,
        t: ::core::primitive::f64,
        state: &WheelState,
    ) -> ::core::result::Result<
        (WheelState, WheelImpulses),
        ::nonholonomic::__private::impacts::ImpactError,
    > {
        let struck = ::nonholonomic::__private::impacts::strike(
            self,
            &WheelTouchImpact,
            t,
            state,
            <::core::primitive::f64 as ::nonholonomic::__private::Scalar>::ZERO,
        )?;
        let [mu0, mu1] = struck.impulses;
        ::core::result::Result::Ok((
            struck.after,
            WheelImpulses {
                touch: [mu0, mu1],
                stop: <::core::primitive::f64 as ::nonholonomic::__private::Scalar>::ZERO,
            },
        ))
    }
    /// The gap of the impact `touch`, for events in the direction `Closing`.
    #[must_use]
    #[inline]
    fn event_touch(
        &self,
        t: ::core::primitive::f64,
        state: &WheelState,
    ) -> ::core::primitive::f64 {
        _ = (t, state);
        state.y - self.r
    }
    /// The state after the impact `stop`, and its impulses.
    ///
    /// A gap is closed where it is not above 0 by more than rounding. A state in which all gaps are open, or
    /// separate, comes back unchanged with zero impulses.
    ///
    /// # Errors
    /// If rows are dependent at the state, the coefficient of restitution is outside 0 … 1, or closed rows do not
    /// come to an end: with the row, by name.
    fn impact_stop(
        &self,
        t: ::core::primitive::f64,
        state: &WheelState,
    ) -> ::core::result::Result<
        (WheelState, WheelImpulses),
        ::nonholonomic::__private::impacts::ImpactError,
    > {
        let struck = ::nonholonomic::__private::impacts::strike(
            self,
            &WheelStopImpact,
            t,
            state,
            <::core::primitive::f64 as ::nonholonomic::__private::Scalar>::ZERO,
        )?;
        let [mu0] = struck.impulses;
        ::core::result::Result::Ok((
            struck.after,
            WheelImpulses {
                touch: [
                    <::core::primitive::f64 as ::nonholonomic::__private::Scalar>::ZERO,
                    <::core::primitive::f64 as ::nonholonomic::__private::Scalar>::ZERO,
                ],
                stop: mu0,
            },
        ))
    }
}
