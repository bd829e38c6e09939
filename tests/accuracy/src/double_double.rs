//! Numbers of twice the precision: unevaluated sums of two `f64`, some 31 decimal digits.
//!
//! T. J. Dekker, *A floating-point technique for extending the available precision*, Numerische
//! Mathematik 18 (1971); D. E. Knuth, *The Art of Computer Programming* 2, section 4.2.2.

use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

use nh_runtime::Scalar;

/// `high + low`, with `low` below half a unit in the last place of `high`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DoubleDouble {
    /// The nearest `f64`.
    pub high: f64,
    /// What is missing.
    pub low: f64,
}

/// π/2 in three parts, each the nearest to what the ones before leave.
const HALF_PI: [f64; 3] =
    [std::f64::consts::FRAC_PI_2, 6.123_233_995_736_766e-17, -1.497_384_904_859_169_8e-33];

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

/// Functions that no system of the table has.
macro_rules! without {
    ($($name:ident($($argument:ident)?))*) => {$(
        fn $name(self $(, $argument: Self)?) -> Self {
            $(let _ = $argument;)?
            unimplemented!(concat!("`", stringify!($name), "` of 31 digits"))
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
    fn sqrt(self) -> Self {
        if self.high <= 0.0 {
            return Self::from_f64(self.high.sqrt());
        }
        // Newton's step from the nearest f64
        let root = Self::from_f64(self.high.sqrt());
        root + (self - root * root) / root.scaled(2.0)
    }
    fn sin(self) -> Self {
        self.sin_cos().0
    }
    fn cos(self) -> Self {
        self.sin_cos().1
    }
    fn sin_cos(self) -> (Self, Self) {
        // 1. the rest of the division by a quarter turn
        let quarters = (self.high / HALF_PI[0]).round();
        let rest = HALF_PI.iter().fold(self, |rest, part| {
            let part = two_product(quarters, *part);
            rest - part
        });
        // 2. Taylor's series of an eighth of it, for sin and cos − 1
        let small = rest.scaled(0.125);
        let (mut sin, mut less) = (Self::ZERO, Self::ZERO);
        let mut term = Self::ONE;
        for order in 1..=24 {
            term = term * small / Self::from_f64(f64::from(order));
            match order % 4 {
                1 => sin += term,
                2 => less -= term,
                3 => sin -= term,
                _ => less += term,
            }
        }
        // 3. doubled three times
        for _ in 0..3 {
            (sin, less) = ((sin + sin * less).scaled(2.0), (less * (less + Self::from_f64(2.0))).scaled(2.0));
        }
        let cos = Self::ONE + less;
        // 4. turned back
        match quarters.rem_euclid(4.0) {
            0.0 => (sin, cos),
            1.0 => (cos, -sin),
            2.0 => (-sin, -cos),
            _ => (-cos, sin),
        }
    }
    fn tan(self) -> Self {
        let (sin, cos) = self.sin_cos();
        sin / cos
    }
    without! {
        cbrt() asin() acos() atan() atan2(x) sinh() cosh() tanh() exp() ln() powf(exponent)
        min(other) max(other)
    }
    fn abs(self) -> Self {
        if self.high < 0.0 { -self } else { self }
    }
    fn sign(self) -> Self {
        Self::from_f64(self.high.sign())
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

    const SIN_ONE: [f64; 2] = [0.841_470_984_807_896_5, 1.776_845_092_935_536e-18];
    const COS_ONE: [f64; 2] = [0.540_302_305_868_139_8, -4.760_954_612_604_417e-17];

    fn of(value: f64) -> DoubleDouble {
        DoubleDouble::from_f64(value)
    }

    /// The number is this one to thirty digits.
    fn is(found: DoubleDouble, high: f64, low: f64) {
        let error = found - DoubleDouble { high, low };
        assert!(error.high.abs() < 1e-30 * high.abs(), "{found:?} for {high:e} + {low:e}");
    }

    #[test]
    fn thirty_digits() {
        // 1/3, √2, sin 1, cos 1, sin 100 as mpmath gives them
        is(of(1.0) / of(3.0), 1.0 / 3.0, 1.850_371_707_708_594e-17);
        is(of(2.0).sqrt(), std::f64::consts::SQRT_2, -9.667_293_313_452_913e-17);
        for turns in [0.0, 4.0, -8.0] {
            let turned = of(1.0) + of(turns) * DoubleDouble { high: HALF_PI[0], low: HALF_PI[1] };
            let (sin, cos) = turned.sin_cos();
            is(sin, SIN_ONE[0], SIN_ONE[1]);
            is(cos, COS_ONE[0], COS_ONE[1]);
        }
    }

    #[test]
    fn identities_hold_to_thirty_digits() {
        for x in [1e-9, 0.3, 0.785, 1.57, 2.2, -3.0, 99.0, -1234.5] {
            let (sin, cos) = of(x).sin_cos();
            let (twice, _) = of(2.0 * x).sin_cos();
            let defect = sin * sin + cos * cos - of(1.0);
            assert!(defect.high.abs() < 1e-30, "{x}: {defect:?}");
            let defect = (sin * cos).scaled(2.0) - twice;
            assert!(defect.high.abs() < 1e-30 * twice.high.abs().max(1e-4), "{x}: {defect:?}");
        }
    }
}
