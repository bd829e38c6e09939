//! The numbers that systems compute with.

use core::fmt::Debug;
use core::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

use crate::elementary;

/// A number: `f32`, `f64`, a pack of lanes of them, or a user's newtype with its own `sin_cos`.
///
/// Everything that generated equations call. There is no order here, since lanes have none; what
/// needs one asks for [`Real`], and conditions on numbers are put as "in every lane".
///
/// All functions follow IEEE 754 in that a NaN argument gives a NaN, [`min`](Self::min) and
/// [`max`](Self::max) included: no function hides a failed computation.
///
/// ```
/// use nonholonomic::Scalar;
///
/// fn kinetic_energy<T: Scalar>(m: T, v: T) -> T {
///     T::from_f64(0.5) * m * v.powi(2)
/// }
/// assert_eq!(kinetic_energy(2.0_f32, 3.0), 9.0);
/// assert_eq!(kinetic_energy(2.0_f64, 3.0), 9.0);
/// ```
pub trait Scalar:
    Copy
    + Default
    + Debug
    + PartialEq
    + 'static
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
{
    /// The neutral element of addition.
    const ZERO: Self;
    /// The neutral element of multiplication.
    const ONE: Self;
    /// The highest order of the partial derivatives that the number carries: 0 for a plain number, 1 for a
    /// [`Jet`](crate::Jet) of those, 2 for a jet of jets. Iterations go on until these have converged, too.
    const DERIVATIVES: u32 = 0;

    /// The nearest representable value (in every lane).
    fn from_f64(value: f64) -> Self;
    /// The value as a number for messages: of several lanes, the first that is not finite, or else
    /// the first.
    fn to_f64(self) -> f64;

    /// The square root; NaN for a negative number.
    #[must_use]
    fn sqrt(self) -> Self;
    /// The cube root, negative for a negative number.
    #[must_use]
    fn cbrt(self) -> Self;
    /// The sine of an angle in radians.
    #[must_use]
    fn sin(self) -> Self;
    /// The cosine of an angle in radians.
    #[must_use]
    fn cos(self) -> Self;
    /// Sine and cosine together: generated equations take every pair of them from here.
    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        (self.sin(), self.cos())
    }
    /// The tangent of an angle in radians.
    #[must_use]
    fn tan(self) -> Self;
    /// The angle in [−π/2, π/2] with this sine.
    #[must_use]
    fn asin(self) -> Self;
    /// The angle in [0, π] with this cosine.
    #[must_use]
    fn acos(self) -> Self;
    /// The angle in (−π/2, π/2) with this tangent.
    #[must_use]
    fn atan(self) -> Self;
    /// The angle in (−π, π] of the point with ordinate `self` and abscissa `x`.
    #[must_use]
    fn atan2(self, x: Self) -> Self;
    /// The hyperbolic sine.
    #[must_use]
    fn sinh(self) -> Self;
    /// The hyperbolic cosine.
    #[must_use]
    fn cosh(self) -> Self;
    /// The hyperbolic tangent.
    #[must_use]
    fn tanh(self) -> Self;
    /// The exponential function.
    #[must_use]
    fn exp(self) -> Self;
    /// The natural logarithm; NaN for a negative number.
    #[must_use]
    fn ln(self) -> Self;
    /// The power with a real exponent; NaN for a negative base and a broken exponent.
    #[must_use]
    fn powf(self, exponent: Self) -> Self;
    /// The power with an integer exponent, by repeated squaring: a constant exponent compiles to
    /// its chain of multiplications. A negative exponent takes the reciprocal of the power.
    #[inline]
    #[must_use]
    fn powi(self, exponent: i32) -> Self {
        let mut bits = exponent.unsigned_abs();
        let mut square = self;
        let mut power = Self::ONE;
        let mut started = false;
        while bits != 0 {
            if bits & 1 == 1 {
                power = if started { power * square } else { square };
                started = true;
            }
            bits >>= 1;
            if bits != 0 {
                square *= square;
            }
        }
        if exponent < 0 { power.recip() } else { power }
    }
    /// The absolute value.
    #[must_use]
    fn abs(self) -> Self;
    /// 1 for a positive number, −1 for a negative one, 0 for zero, NaN for NaN.
    #[must_use]
    fn sign(self) -> Self;
    /// The smaller of the two; NaN if either is.
    #[must_use]
    fn min(self, other: Self) -> Self;
    /// The larger of the two; NaN if either is.
    #[must_use]
    fn max(self, other: Self) -> Self;
    /// One over the number.
    #[inline]
    #[must_use]
    fn recip(self) -> Self {
        Self::ONE / self
    }
    /// `self * factor + summand`, fused into one rounding where the target has an instruction for
    /// it, and with two roundings elsewhere.
    #[inline]
    #[must_use]
    fn mul_add(self, factor: Self, summand: Self) -> Self {
        self * factor + summand
    }
    /// `self * factor + summand` where the summand is the negative of the product but for roundings, so that nothing
    /// is left without the exact product: the rounding error of `self * factor`, or what a quotient leaves.
    ///
    /// With the halves of both factors where the target has no fused multiply-add (T. J. Dekker, *Numerische
    /// Mathematik* 18 (1971)); there, factors beyond the range of these give what [`mul_add`](Self::mul_add) does.
    ///
    /// ```
    /// use nonholonomic::Scalar;
    /// let (x, y) = (1.0 + 2f64.powi(-30), 1.0 - 2f64.powi(-30));
    /// assert_eq!(x * y, 1.0);
    /// assert_eq!(Scalar::mul_add_exact(x, y, -1.0), -2f64.powi(-60));
    /// ```
    #[inline]
    #[must_use]
    fn mul_add_exact(self, factor: Self, summand: Self) -> Self {
        self.mul_add(factor, summand)
    }

    /// Whether the number, in every lane, is neither infinite nor NaN.
    fn is_finite(self) -> bool;
    /// Whether `self > other` in every lane.
    fn all_gt(self, other: Self) -> bool;
    /// Whether `self ≥ other` in every lane.
    fn all_ge(self, other: Self) -> bool;
    /// Whether `self ≠ other` in every lane, which a NaN is to everything.
    fn all_ne(self, other: Self) -> bool;
    /// In every lane, `then` where `self > other`, and `otherwise` elsewhere.
    #[must_use]
    fn select_gt(self, other: Self, then: Self, otherwise: Self) -> Self;
}

/// A [`Scalar`] that is one real number, with an order: what step control and pivoting ask for.
pub trait Real: Scalar + PartialOrd {
    /// The distance from 1 to the next larger number.
    const EPSILON: Self;
    /// The smallest positive normal number.
    const MIN_POSITIVE: Self;
    /// The relative tolerance of an adaptive method that was given none: 1e-6 in `f64`, 1e-4 in
    /// `f32`.
    const DEFAULT_TOLERANCE: Self;

    /// A count as a number, without a detour over another floating-point type.
    fn from_u32(count: u32) -> Self;
}

/// Implements [`Scalar`] and [`Real`] for a primitive floating-point type.
macro_rules! primitive {
    ($float:ident, $functions:ident, $angle:ident, $tolerance:literal, $splitter:literal) => {
        impl Scalar for $float {
            const ZERO: Self = 0.0;
            const ONE: Self = 1.0;

            #[inline]
            #[allow(clippy::cast_possible_truncation)] // rounding to the nearest is what is meant
            fn from_f64(value: f64) -> Self {
                value as Self
            }
            #[inline]
            fn to_f64(self) -> f64 {
                f64::from(self)
            }
            #[inline]
            fn sin(self) -> Self {
                elementary::$angle::sin(self)
            }
            #[inline]
            fn cos(self) -> Self {
                elementary::$angle::cos(self)
            }
            #[inline]
            fn sin_cos(self) -> (Self, Self) {
                elementary::$angle::sin_cos(self)
            }
            primitive! { @forward $functions;
                sqrt() cbrt() tan() asin() acos() atan() atan2(x) sinh() cosh() tanh()
                exp() ln() powf(exponent)
            }
            #[inline]
            fn abs(self) -> Self {
                $float::abs(self)
            }
            #[inline]
            fn sign(self) -> Self {
                if self > 0.0 {
                    1.0
                } else if self < 0.0 {
                    -1.0
                } else {
                    self
                }
            }
            #[inline]
            fn min(self, other: Self) -> Self {
                if self < other || self.is_nan() { self } else { other }
            }
            #[inline]
            fn max(self, other: Self) -> Self {
                if self > other || self.is_nan() { self } else { other }
            }
            #[inline]
            fn mul_add(self, factor: Self, summand: Self) -> Self {
                // elsewhere a correctly rounded one is a slow function call
                #[cfg(all(feature = "std", any(target_feature = "fma", target_arch = "aarch64")))]
                {
                    $float::mul_add(self, factor, summand)
                }
                #[cfg(not(all(feature = "std", any(target_feature = "fma", target_arch = "aarch64"))))]
                {
                    self * factor + summand
                }
            }
            #[inline]
            fn mul_add_exact(self, factor: Self, summand: Self) -> Self {
                #[cfg(all(feature = "std", any(target_feature = "fma", target_arch = "aarch64")))]
                {
                    $float::mul_add(self, factor, summand)
                }
                #[cfg(not(all(feature = "std", any(target_feature = "fma", target_arch = "aarch64"))))]
                {
                    // halves of the digits, whose products are exact
                    let halves = |x: Self| {
                        let large = x * $splitter;
                        let high = large - (large - x);
                        (high, x - high)
                    };
                    let product = self * factor;
                    let ((a, b), (c, d)) = (halves(self), halves(factor));
                    let rest = ((a * c - product) + a * d + b * c) + b * d;
                    let sum = product + summand;
                    if $float::is_finite(rest) { sum + rest } else { sum }
                }
            }
            #[inline]
            fn is_finite(self) -> bool {
                $float::is_finite(self)
            }
            #[inline]
            fn all_gt(self, other: Self) -> bool {
                self > other
            }
            #[inline]
            fn all_ge(self, other: Self) -> bool {
                self >= other
            }
            #[inline]
            #[allow(clippy::float_cmp)] // the exact comparison is the meaning
            fn all_ne(self, other: Self) -> bool {
                self != other
            }
            #[inline]
            fn select_gt(self, other: Self, then: Self, otherwise: Self) -> Self {
                if self > other { then } else { otherwise }
            }
        }

        impl Real for $float {
            const EPSILON: Self = $float::EPSILON;
            const MIN_POSITIVE: Self = $float::MIN_POSITIVE;
            const DEFAULT_TOLERANCE: Self = $tolerance;

            #[inline]
            #[allow(clippy::cast_precision_loss, clippy::cast_lossless)] // documented as a rounding
            fn from_u32(count: u32) -> Self {
                count as Self
            }
        }
    };
    (@forward $functions:ident; $($name:ident($($argument:ident)?))*) => {
        $(
            #[inline]
            fn $name(self $(, $argument: Self)?) -> Self {
                elementary::$functions::$name(self $(, $argument)?)
            }
        )*
    };
}

// the last number is 2 to half of the digits, and one
primitive!(f64, double, double_angle, 1e-6, 134_217_729.0);
primitive!(f32, single, single_angle, 1e-4, 4097.0);

#[cfg(test)]
#[allow(clippy::float_cmp)] // exact values are meant
mod tests {
    use super::*;

    #[test]
    fn powers_follow_the_chain() {
        for n in -7..=12 {
            let expected = (f64::from(n) * 1.5_f64.ln()).exp();
            assert!((Scalar::powi(1.5_f64, n) - expected).abs() < 1e-13 * expected);
        }
        assert_eq!(Scalar::powi(0.0_f64, 0), 1.0);
        assert_eq!(Scalar::powi(2.0_f32, i32::MIN), 0.0);
    }

    /// The error of a product, of a quotient, and where the halves of factors are out of range.
    #[test]
    fn what_rounding_took_is_found() {
        let (x, y) = (1.0 + f64::EPSILON, 1.0 - f64::EPSILON);
        assert_eq!(x.mul_add_exact(y, -(x * y)), -f64::EPSILON * f64::EPSILON);
        let quotient = 1.0_f64 / 3.0;
        assert_eq!((-quotient).mul_add_exact(3.0, 1.0), 2f64.powi(-54));
        let (x, y) = (1.0 + f32::EPSILON, 1.0 - f32::EPSILON);
        assert_eq!(x.mul_add_exact(y, -(x * y)), -f32::EPSILON * f32::EPSILON);
        let large = 2f64.powi(1010);
        assert_eq!(large.mul_add_exact(3.0, -3.0 * large), 0.0);
    }

    #[test]
    fn nan_is_never_hidden() {
        let nan = f64::NAN;
        for value in [
            Scalar::min(nan, 1.0),
            Scalar::min(1.0, nan),
            Scalar::max(nan, 1.0),
            Scalar::max(1.0, nan),
            nan.sign(),
        ] {
            assert!(value.is_nan());
        }
        assert!(!nan.all_ge(0.0) && nan.all_ne(0.0));
    }

    #[test]
    fn sign_is_zero_at_zero() {
        assert_eq!((3.0_f32.sign(), 0.0_f32.sign(), (-3.0_f32).sign()), (1.0, 0.0, -1.0));
    }
}
