#[allow(non_snake_case)]
/// # Equations of motion
///
/// ```text
/// x' = …
/// ```
pub struct Chain<T = f64> {
    /// Inertias.
    pub I: [[T; 2]; 2],
    /// Mass.
    pub r#type: T,
}
/// The state of [`Chain`]: base coordinates, then velocities.
#[derive(
    ::core::clone::Clone,
    ::core::marker::Copy,
    ::core::fmt::Debug,
    ::core::default::Default
)]
#[allow(non_snake_case)]
pub struct ChainState<T = f64> {
    /// The coordinates `q`.
    pub q: [T; 2],
    /// The coordinates `R`.
    pub R: [[T; 2]; 2],
    /// The quasi-velocity `w[0]`.
    pub w_0: T,
    /// The quasi-velocity `w[2]`.
    pub w_2: T,
}
#[automatically_derived]
impl<T: ::nonholonomic::__private::Scalar> ::core::convert::From<ChainState<T>>
for [T; 8] {
    #[inline]
    fn from(value: ChainState<T>) -> Self {
        [
            value.q[0],
            value.q[1],
            value.R[0][0],
            value.R[0][1],
            value.R[1][0],
            value.R[1][1],
            value.w_0,
            value.w_2,
        ]
    }
}
#[automatically_derived]
impl<T: ::nonholonomic::__private::Scalar> ::core::convert::From<[T; 8]>
for ChainState<T> {
    #[inline]
    fn from([c0, c1, c2, c3, c4, c5, c6, c7]: [T; 8]) -> Self {
        Self {
            q: [c0, c1],
            R: [[c2, c3], [c4, c5]],
            w_0: c6,
            w_2: c7,
        }
    }
}
#[automatically_derived]
impl<T: ::nonholonomic::__private::Scalar> ::core::convert::From<ChainState<T>>
for ::nonholonomic::__private::nalgebra::SVector<T, 8> {
    #[inline]
    fn from(value: ChainState<T>) -> Self {
        ::core::convert::From::<[T; 8]>::from(::core::convert::From::from(value))
    }
}
#[automatically_derived]
impl<
    T: ::nonholonomic::__private::Scalar,
> ::core::convert::From<::nonholonomic::__private::nalgebra::SVector<T, 8>>
for ChainState<T> {
    #[inline]
    fn from(value: ::nonholonomic::__private::nalgebra::SVector<T, 8>) -> Self {
        ::core::convert::From::<[T; 8]>::from(::core::convert::From::from(value))
    }
}
::nonholonomic::__private::serde_impls! {
    "::nonholonomic::__private::serde", "ChainState", { #[allow(non_snake_case)] }
    ChainState[< T >] { q : [T; 2], R : [[T; 2]; 2], w_0 : T, w_2 : T, }
}
/// The quasi-velocities of [`Chain`].
#[derive(
    ::core::clone::Clone,
    ::core::marker::Copy,
    ::core::fmt::Debug,
    ::core::default::Default
)]
pub struct ChainVelocity<T = f64> {
    /// The quasi-velocities `w`.
    pub w: [T; 3],
    /// The quasi-velocity `u`.
    pub u: T,
}
#[automatically_derived]
impl<T: ::nonholonomic::__private::Scalar> ::core::convert::From<ChainVelocity<T>>
for [T; 4] {
    #[inline]
    fn from(value: ChainVelocity<T>) -> Self {
        [value.w[0], value.w[1], value.w[2], value.u]
    }
}
#[automatically_derived]
impl<T: ::nonholonomic::__private::Scalar> ::core::convert::From<[T; 4]>
for ChainVelocity<T> {
    #[inline]
    fn from([c0, c1, c2, c3]: [T; 4]) -> Self {
        Self { w: [c0, c1, c2], u: c3 }
    }
}
#[automatically_derived]
impl<T: ::nonholonomic::__private::Scalar> ::core::convert::From<ChainVelocity<T>>
for ::nonholonomic::__private::nalgebra::SVector<T, 4> {
    #[inline]
    fn from(value: ChainVelocity<T>) -> Self {
        ::core::convert::From::<[T; 4]>::from(::core::convert::From::from(value))
    }
}
#[automatically_derived]
impl<
    T: ::nonholonomic::__private::Scalar,
> ::core::convert::From<::nonholonomic::__private::nalgebra::SVector<T, 4>>
for ChainVelocity<T> {
    #[inline]
    fn from(value: ::nonholonomic::__private::nalgebra::SVector<T, 4>) -> Self {
        ::core::convert::From::<[T; 4]>::from(::core::convert::From::from(value))
    }
}
::nonholonomic::__private::serde_impls! {
    "::nonholonomic::__private::serde", "ChainVelocity", {} ChainVelocity[< T >] { w :
    [T; 3], u : T, }
}
#[automatically_derived]
impl<T: ::nonholonomic::__private::Scalar> ::nonholonomic::__private::State
for ChainState<T> {
    type Scalar = T;
    type Dim = ::nonholonomic::__private::D<8>;
    #[inline]
    fn to_array(&self) -> [T; 8] {
        ::core::convert::From::from(*self)
    }
    #[inline]
    fn from_array(components: [T; 8]) -> Self {
        ::core::convert::From::from(components)
    }
    #[inline]
    fn names() -> [&'static ::core::primitive::str; 8] {
        ["q[0]", "q[1]", "R[0][0]", "R[0][1]", "R[1][0]", "R[1][1]", "w[0]", "w[2]"]
    }
}
