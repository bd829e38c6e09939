/// # Equations of motion
///
/// ```text
/// x' = …
/// ```
struct Rails {
    m: f64,
}
/// The state of [`Rails`]: base coordinates, then velocities.
#[derive(
    ::core::clone::Clone,
    ::core::marker::Copy,
    ::core::fmt::Debug,
    ::core::cmp::PartialEq,
    ::core::default::Default
)]
struct RailsState {
    /// The coordinate `x`.
    pub x: ::core::primitive::f64,
    /// The quasi-velocities `w`.
    pub w: [::core::primitive::f64; 2],
    /// The quasi-velocity `v`.
    pub v: ::core::primitive::f64,
}
#[automatically_derived]
impl ::core::convert::From<RailsState> for [::core::primitive::f64; 4] {
    #[inline]
    fn from(value: RailsState) -> Self {
        [value.x, value.w[0], value.w[1], value.v]
    }
}
#[automatically_derived]
impl ::core::convert::From<[::core::primitive::f64; 4]> for RailsState {
    #[inline]
    fn from([c0, c1, c2, c3]: [::core::primitive::f64; 4]) -> Self {
        Self { x: c0, w: [c1, c2], v: c3 }
    }
}
#[automatically_derived]
impl ::core::convert::From<RailsState>
for ::nonholonomic::__private::nalgebra::SVector<::core::primitive::f64, 4> {
    #[inline]
    fn from(value: RailsState) -> Self {
        ::core::convert::From::<
            [::core::primitive::f64; 4],
        >::from(::core::convert::From::from(value))
    }
}
#[automatically_derived]
impl ::core::convert::From<
    ::nonholonomic::__private::nalgebra::SVector<::core::primitive::f64, 4>,
> for RailsState {
    #[inline]
    fn from(
        value: ::nonholonomic::__private::nalgebra::SVector<::core::primitive::f64, 4>,
    ) -> Self {
        ::core::convert::From::<
            [::core::primitive::f64; 4],
        >::from(::core::convert::From::from(value))
    }
}
::nonholonomic::__private::serde_impls! {
    "::nonholonomic::__private::serde", "RailsState", {} RailsState[] { x :
    ::core::primitive::f64, w : [::core::primitive::f64; 2], v : ::core::primitive::f64,
    }
}
/// The quasi-velocities of [`Rails`].
#[derive(
    ::core::clone::Clone,
    ::core::marker::Copy,
    ::core::fmt::Debug,
    ::core::cmp::PartialEq,
    ::core::default::Default
)]
struct RailsVelocity {
    /// The quasi-velocities `w`.
    pub w: [::core::primitive::f64; 2],
    /// The quasi-velocity `v`.
    pub v: ::core::primitive::f64,
}
#[automatically_derived]
impl ::core::convert::From<RailsVelocity> for [::core::primitive::f64; 3] {
    #[inline]
    fn from(value: RailsVelocity) -> Self {
        [value.w[0], value.w[1], value.v]
    }
}
#[automatically_derived]
impl ::core::convert::From<[::core::primitive::f64; 3]> for RailsVelocity {
    #[inline]
    fn from([c0, c1, c2]: [::core::primitive::f64; 3]) -> Self {
        Self { w: [c0, c1], v: c2 }
    }
}
#[automatically_derived]
impl ::core::convert::From<RailsVelocity>
for ::nonholonomic::__private::nalgebra::SVector<::core::primitive::f64, 3> {
    #[inline]
    fn from(value: RailsVelocity) -> Self {
        ::core::convert::From::<
            [::core::primitive::f64; 3],
        >::from(::core::convert::From::from(value))
    }
}
#[automatically_derived]
impl ::core::convert::From<
    ::nonholonomic::__private::nalgebra::SVector<::core::primitive::f64, 3>,
> for RailsVelocity {
    #[inline]
    fn from(
        value: ::nonholonomic::__private::nalgebra::SVector<::core::primitive::f64, 3>,
    ) -> Self {
        ::core::convert::From::<
            [::core::primitive::f64; 3],
        >::from(::core::convert::From::from(value))
    }
}
::nonholonomic::__private::serde_impls! {
    "::nonholonomic::__private::serde", "RailsVelocity", {} RailsVelocity[] { w :
    [::core::primitive::f64; 2], v : ::core::primitive::f64, }
}
#[automatically_derived]
impl ::nonholonomic::__private::State for RailsState {
    type Scalar = ::core::primitive::f64;
    type Dim = ::nonholonomic::__private::D<4>;
    #[inline]
    fn to_array(&self) -> [::core::primitive::f64; 4] {
        ::core::convert::From::from(*self)
    }
    #[inline]
    fn from_array(components: [::core::primitive::f64; 4]) -> Self {
        ::core::convert::From::from(components)
    }
    #[inline]
    fn names() -> [&'static ::core::primitive::str; 4] {
        ["x", "w[0]", "w[1]", "v"]
    }
}
/// The multipliers of the constraints of [`Rails`], which enter as +λ ∂φ/∂y.
#[derive(
    ::core::clone::Clone,
    ::core::marker::Copy,
    ::core::fmt::Debug,
    ::core::cmp::PartialEq,
    ::core::default::Default
)]
struct RailsMultipliers {
    /// The multiplier of the constraint number 1.
    pub constraint_1: ::core::primitive::f64,
    /// The multiplier of the constraint `type`.
    pub r#type: ::core::primitive::f64,
}
#[automatically_derived]
impl ::core::convert::From<RailsMultipliers> for [::core::primitive::f64; 2] {
    #[inline]
    fn from(value: RailsMultipliers) -> Self {
        [value.constraint_1, value.r#type]
    }
}
#[automatically_derived]
impl ::core::convert::From<[::core::primitive::f64; 2]> for RailsMultipliers {
    #[inline]
    fn from([c0, c1]: [::core::primitive::f64; 2]) -> Self {
        Self {
            constraint_1: c0,
            r#type: c1,
        }
    }
}
#[automatically_derived]
impl ::core::convert::From<RailsMultipliers>
for ::nonholonomic::__private::nalgebra::SVector<::core::primitive::f64, 2> {
    #[inline]
    fn from(value: RailsMultipliers) -> Self {
        ::core::convert::From::<
            [::core::primitive::f64; 2],
        >::from(::core::convert::From::from(value))
    }
}
#[automatically_derived]
impl ::core::convert::From<
    ::nonholonomic::__private::nalgebra::SVector<::core::primitive::f64, 2>,
> for RailsMultipliers {
    #[inline]
    fn from(
        value: ::nonholonomic::__private::nalgebra::SVector<::core::primitive::f64, 2>,
    ) -> Self {
        ::core::convert::From::<
            [::core::primitive::f64; 2],
        >::from(::core::convert::From::from(value))
    }
}
::nonholonomic::__private::serde_impls! {
    "::nonholonomic::__private::serde", "RailsMultipliers", {} RailsMultipliers[] {
    constraint_1 : ::core::primitive::f64, r#type : ::core::primitive::f64, }
}
/// The constraint forces of [`Rails`] along its sections: each times the quasi-velocity of the same name is a power.
#[derive(
    ::core::clone::Clone,
    ::core::marker::Copy,
    ::core::fmt::Debug,
    ::core::cmp::PartialEq,
    ::core::default::Default
)]
struct RailsReactions {
    /// The constraint forces along `w`.
    pub w: [::core::primitive::f64; 2],
    /// The constraint force along `v`.
    pub v: ::core::primitive::f64,
}
#[automatically_derived]
impl ::core::convert::From<RailsReactions> for [::core::primitive::f64; 3] {
    #[inline]
    fn from(value: RailsReactions) -> Self {
        [value.w[0], value.w[1], value.v]
    }
}
#[automatically_derived]
impl ::core::convert::From<[::core::primitive::f64; 3]> for RailsReactions {
    #[inline]
    fn from([c0, c1, c2]: [::core::primitive::f64; 3]) -> Self {
        Self { w: [c0, c1], v: c2 }
    }
}
#[automatically_derived]
impl ::core::convert::From<RailsReactions>
for ::nonholonomic::__private::nalgebra::SVector<::core::primitive::f64, 3> {
    #[inline]
    fn from(value: RailsReactions) -> Self {
        ::core::convert::From::<
            [::core::primitive::f64; 3],
        >::from(::core::convert::From::from(value))
    }
}
#[automatically_derived]
impl ::core::convert::From<
    ::nonholonomic::__private::nalgebra::SVector<::core::primitive::f64, 3>,
> for RailsReactions {
    #[inline]
    fn from(
        value: ::nonholonomic::__private::nalgebra::SVector<::core::primitive::f64, 3>,
    ) -> Self {
        ::core::convert::From::<
            [::core::primitive::f64; 3],
        >::from(::core::convert::From::from(value))
    }
}
::nonholonomic::__private::serde_impls! {
    "::nonholonomic::__private::serde", "RailsReactions", {} RailsReactions[] { w :
    [::core::primitive::f64; 2], v : ::core::primitive::f64, }
}
/// The constraints of [`Rails`] at a state: left-hand sides less right-hand sides.
#[derive(
    ::core::clone::Clone,
    ::core::marker::Copy,
    ::core::fmt::Debug,
    ::core::cmp::PartialEq,
    ::core::default::Default
)]
struct RailsResidual {
    /// The residual of the constraint number 1.
    pub constraint_1: ::core::primitive::f64,
    /// The residual of the constraint `type`.
    pub r#type: ::core::primitive::f64,
}
#[automatically_derived]
impl ::core::convert::From<RailsResidual> for [::core::primitive::f64; 2] {
    #[inline]
    fn from(value: RailsResidual) -> Self {
        [value.constraint_1, value.r#type]
    }
}
#[automatically_derived]
impl ::core::convert::From<[::core::primitive::f64; 2]> for RailsResidual {
    #[inline]
    fn from([c0, c1]: [::core::primitive::f64; 2]) -> Self {
        Self {
            constraint_1: c0,
            r#type: c1,
        }
    }
}
#[automatically_derived]
impl ::core::convert::From<RailsResidual>
for ::nonholonomic::__private::nalgebra::SVector<::core::primitive::f64, 2> {
    #[inline]
    fn from(value: RailsResidual) -> Self {
        ::core::convert::From::<
            [::core::primitive::f64; 2],
        >::from(::core::convert::From::from(value))
    }
}
#[automatically_derived]
impl ::core::convert::From<
    ::nonholonomic::__private::nalgebra::SVector<::core::primitive::f64, 2>,
> for RailsResidual {
    #[inline]
    fn from(
        value: ::nonholonomic::__private::nalgebra::SVector<::core::primitive::f64, 2>,
    ) -> Self {
        ::core::convert::From::<
            [::core::primitive::f64; 2],
        >::from(::core::convert::From::from(value))
    }
}
::nonholonomic::__private::serde_impls! {
    "::nonholonomic::__private::serde", "RailsResidual", {} RailsResidual[] {
    constraint_1 : ::core::primitive::f64, r#type : ::core::primitive::f64, }
}
