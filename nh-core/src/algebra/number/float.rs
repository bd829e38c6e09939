//! Rational numbers and floating point.

use super::{Big, Rational};
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, ToPrimitive, Zero};

impl Rational {
    /// The number that a finite `f64` is.
    #[must_use]
    pub fn of_f64(value: f64) -> Option<Self> {
        if !value.is_finite() {
            return None;
        }
        let (mantissa, exponent, sign) = num_traits::float::FloatCore::integer_decode(value);
        let mantissa = BigInt::from(mantissa) * sign;
        let power = BigInt::one() << exponent.unsigned_abs();
        Some(Self::normal(if exponent < 0 { Big::new(mantissa, power) } else { (mantissa * power).into() }))
    }
}

/// The quotient to 66 bits and a sticky one, so that the conversion rounds only once.
#[allow(clippy::cast_precision_loss, reason = "the rounding is wanted")]
pub(super) fn nearest(value: &Big) -> f64 {
    let (numerator, denominator) = (value.numer().magnitude(), value.denom().magnitude());
    let bits = |n: &num_bigint::BigUint| i64::try_from(n.bits()).unwrap_or(i64::MAX / 4);
    let shift = 66 - (bits(numerator) - bits(denominator));
    let (up, down) = (shift.max(0), (-shift).max(0));
    let (quotient, rest) = (numerator << up).div_rem(&(denominator << down));
    let sticky = u128::from(!rest.is_zero());
    let mut result = (quotient.to_u128().unwrap_or(u128::MAX) | sticky) as f64;
    let mut left = -shift;
    while left != 0 && result != 0.0 && result.is_finite() {
        let step = left.clamp(-1000, 1000);
        result *= 2f64.powi(i32::try_from(step).unwrap_or(0));
        left -= step;
    }
    if value.is_negative() { -result } else { result }
}
