#[allow(non_snake_case)]
/// A rigid body on a plane, carried by a knife edge.
#[derive(Clone, Copy, Debug)]
pub struct Sleigh {
    /// Mass.
    pub m: f64,
    /// Inertia.
    pub J: f64,
    /// Offset.
    pub a: f64,
    /// Not used.
    pub c: f64,
}
/// The state of [`Sleigh`]: base coordinates, then velocities.
#[derive(
    ::core::clone::Clone,
    ::core::marker::Copy,
    ::core::fmt::Debug,
    ::core::cmp::PartialEq,
    ::core::default::Default
)]
pub struct SleighState {
    /// The coordinate `theta`.
    pub theta: ::core::primitive::f64,
    /// Along the first axis.
    pub x: ::core::primitive::f64,
    /// The coordinate `y`.
    pub y: ::core::primitive::f64,
    /// The quasi-velocity `omega`.
    pub omega: ::core::primitive::f64,
    /// The quasi-velocity `v1`.
    pub v1: ::core::primitive::f64,
}
#[automatically_derived]
impl ::core::convert::From<SleighState> for [::core::primitive::f64; 5] {
    #[inline]
    fn from(value: SleighState) -> Self {
        [value.theta, value.x, value.y, value.omega, value.v1]
    }
}
#[automatically_derived]
impl ::core::convert::From<[::core::primitive::f64; 5]> for SleighState {
    #[inline]
    fn from([c0, c1, c2, c3, c4]: [::core::primitive::f64; 5]) -> Self {
        Self {
            theta: c0,
            x: c1,
            y: c2,
            omega: c3,
            v1: c4,
        }
    }
}
#[automatically_derived]
impl ::core::convert::From<SleighState>
for ::nonholonomic::__private::nalgebra::SVector<::core::primitive::f64, 5> {
    #[inline]
    fn from(value: SleighState) -> Self {
        ::core::convert::From::<
            [::core::primitive::f64; 5],
        >::from(::core::convert::From::from(value))
    }
}
#[automatically_derived]
impl ::core::convert::From<
    ::nonholonomic::__private::nalgebra::SVector<::core::primitive::f64, 5>,
> for SleighState {
    #[inline]
    fn from(
        value: ::nonholonomic::__private::nalgebra::SVector<::core::primitive::f64, 5>,
    ) -> Self {
        ::core::convert::From::<
            [::core::primitive::f64; 5],
        >::from(::core::convert::From::from(value))
    }
}
::nonholonomic::__private::serde_impls! {
    "::nonholonomic::__private::serde", "SleighState", {} SleighState[] { theta :
    ::core::primitive::f64, x : ::core::primitive::f64, y : ::core::primitive::f64, omega
    : ::core::primitive::f64, v1 : ::core::primitive::f64, }
}
/// The quasi-velocities of [`Sleigh`].
#[derive(
    ::core::clone::Clone,
    ::core::marker::Copy,
    ::core::fmt::Debug,
    ::core::cmp::PartialEq,
    ::core::default::Default
)]
pub struct SleighVelocity {
    /// The quasi-velocity `omega`.
    pub omega: ::core::primitive::f64,
    /// The quasi-velocity `v1`.
    pub v1: ::core::primitive::f64,
    /// The quasi-velocity `v2`.
    pub v2: ::core::primitive::f64,
}
#[automatically_derived]
impl ::core::convert::From<SleighVelocity> for [::core::primitive::f64; 3] {
    #[inline]
    fn from(value: SleighVelocity) -> Self {
        [value.omega, value.v1, value.v2]
    }
}
#[automatically_derived]
impl ::core::convert::From<[::core::primitive::f64; 3]> for SleighVelocity {
    #[inline]
    fn from([c0, c1, c2]: [::core::primitive::f64; 3]) -> Self {
        Self { omega: c0, v1: c1, v2: c2 }
    }
}
#[automatically_derived]
impl ::core::convert::From<SleighVelocity>
for ::nonholonomic::__private::nalgebra::SVector<::core::primitive::f64, 3> {
    #[inline]
    fn from(value: SleighVelocity) -> Self {
        ::core::convert::From::<
            [::core::primitive::f64; 3],
        >::from(::core::convert::From::from(value))
    }
}
#[automatically_derived]
impl ::core::convert::From<
    ::nonholonomic::__private::nalgebra::SVector<::core::primitive::f64, 3>,
> for SleighVelocity {
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
    "::nonholonomic::__private::serde", "SleighVelocity", {} SleighVelocity[] { omega :
    ::core::primitive::f64, v1 : ::core::primitive::f64, v2 : ::core::primitive::f64, }
}
/// The control inputs of [`Sleigh`].
#[derive(
    ::core::clone::Clone,
    ::core::marker::Copy,
    ::core::fmt::Debug,
    ::core::cmp::PartialEq,
    ::core::default::Default
)]
pub struct SleighInput {
    /// The input `torque`.
    pub torque: ::core::primitive::f64,
}
#[automatically_derived]
impl ::core::convert::From<SleighInput> for [::core::primitive::f64; 1] {
    #[inline]
    fn from(value: SleighInput) -> Self {
        [value.torque]
    }
}
#[automatically_derived]
impl ::core::convert::From<[::core::primitive::f64; 1]> for SleighInput {
    #[inline]
    fn from([c0]: [::core::primitive::f64; 1]) -> Self {
        Self { torque: c0 }
    }
}
#[automatically_derived]
impl ::core::convert::From<SleighInput>
for ::nonholonomic::__private::nalgebra::SVector<::core::primitive::f64, 1> {
    #[inline]
    fn from(value: SleighInput) -> Self {
        ::core::convert::From::<
            [::core::primitive::f64; 1],
        >::from(::core::convert::From::from(value))
    }
}
#[automatically_derived]
impl ::core::convert::From<
    ::nonholonomic::__private::nalgebra::SVector<::core::primitive::f64, 1>,
> for SleighInput {
    #[inline]
    fn from(
        value: ::nonholonomic::__private::nalgebra::SVector<::core::primitive::f64, 1>,
    ) -> Self {
        ::core::convert::From::<
            [::core::primitive::f64; 1],
        >::from(::core::convert::From::from(value))
    }
}
::nonholonomic::__private::serde_impls! {
    "::nonholonomic::__private::serde", "SleighInput", {} SleighInput[] { torque :
    ::core::primitive::f64, }
}
/// The observables of [`Sleigh`].
#[derive(
    ::core::clone::Clone,
    ::core::marker::Copy,
    ::core::fmt::Debug,
    ::core::cmp::PartialEq,
    ::core::default::Default
)]
#[allow(non_snake_case)]
pub struct SleighOutputs {
    /// The output `speed`.
    pub speed: ::core::primitive::f64,
    /// The output `E`.
    pub E: ::core::primitive::f64,
}
#[automatically_derived]
impl ::core::convert::From<SleighOutputs> for [::core::primitive::f64; 2] {
    #[inline]
    fn from(value: SleighOutputs) -> Self {
        [value.speed, value.E]
    }
}
#[automatically_derived]
impl ::core::convert::From<[::core::primitive::f64; 2]> for SleighOutputs {
    #[inline]
    fn from([c0, c1]: [::core::primitive::f64; 2]) -> Self {
        Self { speed: c0, E: c1 }
    }
}
#[automatically_derived]
impl ::core::convert::From<SleighOutputs>
for ::nonholonomic::__private::nalgebra::SVector<::core::primitive::f64, 2> {
    #[inline]
    fn from(value: SleighOutputs) -> Self {
        ::core::convert::From::<
            [::core::primitive::f64; 2],
        >::from(::core::convert::From::from(value))
    }
}
#[automatically_derived]
impl ::core::convert::From<
    ::nonholonomic::__private::nalgebra::SVector<::core::primitive::f64, 2>,
> for SleighOutputs {
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
    "::nonholonomic::__private::serde", "SleighOutputs", { #[allow(non_snake_case)] }
    SleighOutputs[] { speed : ::core::primitive::f64, E : ::core::primitive::f64, }
}
#[automatically_derived]
impl ::nonholonomic::__private::State for SleighState {
    type Scalar = ::core::primitive::f64;
    type Dim = ::nonholonomic::__private::D<5>;
    #[inline]
    fn to_array(&self) -> [::core::primitive::f64; 5] {
        ::core::convert::From::from(*self)
    }
    #[inline]
    fn from_array(components: [::core::primitive::f64; 5]) -> Self {
        ::core::convert::From::from(components)
    }
    #[inline]
    fn names() -> [&'static ::core::primitive::str; 5] {
        ["theta", "x", "y", "omega", "v1"]
    }
}
/// The multipliers of the constraints of [`Sleigh`], which enter as +λ ∂φ/∂y.
#[derive(
    ::core::clone::Clone,
    ::core::marker::Copy,
    ::core::fmt::Debug,
    ::core::cmp::PartialEq,
    ::core::default::Default
)]
pub struct SleighMultipliers {
    /// The multiplier of the constraint `blade`.
    pub blade: ::core::primitive::f64,
}
#[automatically_derived]
impl ::core::convert::From<SleighMultipliers> for [::core::primitive::f64; 1] {
    #[inline]
    fn from(value: SleighMultipliers) -> Self {
        [value.blade]
    }
}
#[automatically_derived]
impl ::core::convert::From<[::core::primitive::f64; 1]> for SleighMultipliers {
    #[inline]
    fn from([c0]: [::core::primitive::f64; 1]) -> Self {
        Self { blade: c0 }
    }
}
#[automatically_derived]
impl ::core::convert::From<SleighMultipliers>
for ::nonholonomic::__private::nalgebra::SVector<::core::primitive::f64, 1> {
    #[inline]
    fn from(value: SleighMultipliers) -> Self {
        ::core::convert::From::<
            [::core::primitive::f64; 1],
        >::from(::core::convert::From::from(value))
    }
}
#[automatically_derived]
impl ::core::convert::From<
    ::nonholonomic::__private::nalgebra::SVector<::core::primitive::f64, 1>,
> for SleighMultipliers {
    #[inline]
    fn from(
        value: ::nonholonomic::__private::nalgebra::SVector<::core::primitive::f64, 1>,
    ) -> Self {
        ::core::convert::From::<
            [::core::primitive::f64; 1],
        >::from(::core::convert::From::from(value))
    }
}
::nonholonomic::__private::serde_impls! {
    "::nonholonomic::__private::serde", "SleighMultipliers", {} SleighMultipliers[] {
    blade : ::core::primitive::f64, }
}
/// The constraints of [`Sleigh`] at a state: left-hand sides less right-hand sides.
#[derive(
    ::core::clone::Clone,
    ::core::marker::Copy,
    ::core::fmt::Debug,
    ::core::cmp::PartialEq,
    ::core::default::Default
)]
pub struct SleighResidual {
    /// The residual of the constraint `blade`.
    pub blade: ::core::primitive::f64,
}
#[automatically_derived]
impl ::core::convert::From<SleighResidual> for [::core::primitive::f64; 1] {
    #[inline]
    fn from(value: SleighResidual) -> Self {
        [value.blade]
    }
}
#[automatically_derived]
impl ::core::convert::From<[::core::primitive::f64; 1]> for SleighResidual {
    #[inline]
    fn from([c0]: [::core::primitive::f64; 1]) -> Self {
        Self { blade: c0 }
    }
}
#[automatically_derived]
impl ::core::convert::From<SleighResidual>
for ::nonholonomic::__private::nalgebra::SVector<::core::primitive::f64, 1> {
    #[inline]
    fn from(value: SleighResidual) -> Self {
        ::core::convert::From::<
            [::core::primitive::f64; 1],
        >::from(::core::convert::From::from(value))
    }
}
#[automatically_derived]
impl ::core::convert::From<
    ::nonholonomic::__private::nalgebra::SVector<::core::primitive::f64, 1>,
> for SleighResidual {
    #[inline]
    fn from(
        value: ::nonholonomic::__private::nalgebra::SVector<::core::primitive::f64, 1>,
    ) -> Self {
        ::core::convert::From::<
            [::core::primitive::f64; 1],
        >::from(::core::convert::From::from(value))
    }
}
::nonholonomic::__private::serde_impls! {
    "::nonholonomic::__private::serde", "SleighResidual", {} SleighResidual[] { blade :
    ::core::primitive::f64, }
}
