//! Scalars as packs of lanes.

#[cfg(feature = "wide")]
mod wide;

use crate::{Fast, Scalar};

/// A [`Scalar`] that is several numbers side by side, or just one.
///
/// With the feature `wide` it is implemented for the `f64x4` and `f32x8` of the crate `wide`, and always
/// for `f64`, `f32` and [`Fast`] as packs of one: what is written for lanes also runs without them.
///
/// Whatever is computed with lanes equals, lane by lane and bit by bit, what `Fast<f64>` or
/// `Fast<f32>` gives: sums, products and roots are those of the processor, sine and cosine are the
/// same kernel, multiply-adds are fused in both or in neither. The other elementary functions are
/// evaluated lane after lane.
///
/// What is iterated until it settles, `project` and `normalize` to equations of the state, goes on until the last lane
/// has: the others take further steps and equal single numbers to rounding, and where one lane does not arrive there is an
/// error for all, with every lane as it was. Steps of a method make one correction, and equal those of numbers.
///
/// ```
/// use nonholonomic::{Lanes, Scalar};
///
/// fn sum_of_squares<L: Lanes<Lane = f64>>(numbers: &[f64]) -> f64 {
///     let pack = L::from_lanes(|i| numbers.get(i).copied().unwrap_or(0.0));
///     let squares = pack * pack;
///     (0..L::COUNT).map(|i| squares.lane(i)).sum()
/// }
/// assert_eq!(sum_of_squares::<f64>(&[3.0]), 9.0);
/// # #[cfg(feature = "wide")]
/// assert_eq!(sum_of_squares::<nonholonomic::wide::f64x4>(&[3.0, 4.0]), 25.0);
/// ```
pub trait Lanes: Scalar {
    /// The number in a lane.
    type Lane: Scalar;
    /// How many lanes there are.
    const COUNT: usize;

    /// The pack of the numbers that a function gives for 0, 1, … `COUNT` − 1.
    fn from_lanes(number: impl FnMut(usize) -> Self::Lane) -> Self;
    /// The pack with one number in all lanes.
    fn splat(number: Self::Lane) -> Self;
    /// The number in a lane; zero where there is no such lane.
    fn lane(self, index: usize) -> Self::Lane;
}

/// Numbers are packs of one.
macro_rules! single {
    ($($number:ty: $lane:ty, $wrap:expr, $unwrap:expr;)*) => {$(
        impl Lanes for $number {
            type Lane = $lane;
            const COUNT: usize = 1;

            #[inline]
            fn from_lanes(mut number: impl FnMut(usize) -> $lane) -> Self {
                $wrap(number(0))
            }
            #[inline]
            fn splat(number: $lane) -> Self {
                $wrap(number)
            }
            #[inline]
            fn lane(self, index: usize) -> $lane {
                if index == 0 { $unwrap(self) } else { <$lane as Scalar>::ZERO }
            }
        }
    )*};
}
single! {
    f64: f64, core::convert::identity, core::convert::identity;
    f32: f32, core::convert::identity, core::convert::identity;
    Fast<f64>: f64, Fast, |fast: Fast<f64>| fast.0;
    Fast<f32>: f32, Fast, |fast: Fast<f32>| fast.0;
}
