//! Numbers of twice the precision: unevaluated sums of two `f64`, some 31 decimal digits.
//!
//! T. J. Dekker, *A floating-point technique for extending the available precision*, Numerische
//! Mathematik 18 (1971); D. E. Knuth, *The Art of Computer Programming* 2, section 4.2.2.

mod elementary;

use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

use nonholonomic::Scalar;

/// `high + low`, with `low` below half a unit in the last place of `high`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DoubleDouble {
    /// The nearest `f64`.
    pub high: f64,
    /// What is missing.
    pub low: f64,
}

/// `a + b` and its rounding error.
fn two_sum(a: f64, b: f64) -> DoubleDouble {
    let high = a + b;
    let rest = high - a;
    DoubleDouble { high, low: (a - (high - rest)) + (b - rest) }
}

/// `a b` and its rounding error.
fn two_product(a: f64, b: f64) -> DoubleDouble {
    let high = a * b;
    DoubleDouble { high, low: f64::mul_add(a, b, -high) }
}

impl DoubleDouble {
    /// A number times a power of two.
    fn scaled(self, factor: f64) -> Self {
        Self { high: self.high * factor, low: self.low * factor }
    }
}

impl Add for DoubleDouble {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let (sum, rest) = (two_sum(self.high, other.high), two_sum(self.low, other.low));
        let sum = two_sum(sum.high, sum.low + rest.high);
        two_sum(sum.high, sum.low + rest.low)
    }
}

impl Sub for DoubleDouble {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for DoubleDouble {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let product = two_product(self.high, other.high);
        two_sum(product.high, product.low + (self.high * other.low + self.low * other.high))
    }
}

impl Div for DoubleDouble {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let first = self.high / other.high;
        let rest = self - other * Self::from_f64(first);
        let second = rest.high / other.high;
        let rest = rest - other * Self::from_f64(second);
        two_sum(first, second) + Self::from_f64(rest.high / other.high)
    }
}

impl Neg for DoubleDouble {
    type Output = Self;
    fn neg(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }
}

impl AddAssign for DoubleDouble {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl SubAssign for DoubleDouble {
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl MulAssign for DoubleDouble {
    fn mul_assign(&mut self, other: Self) {
        *self = *self * other;
    }
}

/// Functions of one number that [`elementary`] has.
macro_rules! elementary {
    ($($name:ident)*) => {$(
        fn $name(self) -> Self {
            elementary::$name(self)
        }
    )*};
}

impl Scalar for DoubleDouble {
    const ZERO: Self = Self { high: 0.0, low: 0.0 };
    const ONE: Self = Self { high: 1.0, low: 0.0 };

    fn from_f64(value: f64) -> Self {
        Self { high: value, low: 0.0 }
    }
    fn to_f64(self) -> f64 {
        self.high
    }
    elementary! { sqrt cbrt sinh cosh tanh exp ln }
    fn sin(self) -> Self {
        self.sin_cos().0
    }
    fn cos(self) -> Self {
        self.sin_cos().1
    }
    fn sin_cos(self) -> (Self, Self) {
        elementary::sin_cos(self)
    }
    fn tan(self) -> Self {
        let (sin, cos) = self.sin_cos();
        sin / cos
    }
    fn asin(self) -> Self {
        self.atan2(elementary::other_leg(self))
    }
    fn acos(self) -> Self {
        elementary::other_leg(self).atan2(self)
    }
    fn atan(self) -> Self {
        self.atan2(Self::ONE)
    }
    fn atan2(self, x: Self) -> Self {
        elementary::angle(self, x)
    }
    fn powf(self, exponent: Self) -> Self {
        elementary::powf(self, exponent)
    }
    fn abs(self) -> Self {
        if self.high < 0.0 { -self } else { self }
    }
    fn sign(self) -> Self {
        Self::from_f64(self.high.sign())
    }
    fn min(self, other: Self) -> Self {
        if self.high.is_nan() || other.all_gt(self) { self } else { other }
    }
    fn max(self, other: Self) -> Self {
        if self.high.is_nan() || self.all_gt(other) { self } else { other }
    }
    fn is_finite(self) -> bool {
        self.high.is_finite()
    }
    fn all_gt(self, other: Self) -> bool {
        (self.high, self.low) > (other.high, other.low)
    }
    fn all_ge(self, other: Self) -> bool {
        (self.high, self.low) >= (other.high, other.low)
    }
    fn all_ne(self, other: Self) -> bool {
        self != other
    }
    fn select_gt(self, other: Self, then: Self, otherwise: Self) -> Self {
        if self.all_gt(other) { then } else { otherwise }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_third() {
        // as mpmath gives it
        let third = DoubleDouble::ONE / DoubleDouble::from_f64(3.0);
        let error = third - DoubleDouble { high: 1.0 / 3.0, low: 1.850_371_707_708_594e-17 };
        assert!(error.high.abs() < 1e-31, "{third:?}");
    }
}
