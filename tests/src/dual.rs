//! Dual numbers a + b ε with ε² = 0: derivatives of generated code to round-off.

use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

use nh_runtime::Scalar;

/// A number and its derivative in some direction.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Dual {
    /// The number.
    pub value: f64,
    /// Its derivative.
    pub slope: f64,
}

impl Dual {
    /// A function of this number, by its value and derivative.
    fn apply(self, value: f64, derivative: f64) -> Self {
        Self { value, slope: if self.slope == 0.0 { 0.0 } else { derivative * self.slope } }
    }
}

impl Add for Dual {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { value: self.value + other.value, slope: self.slope + other.slope }
    }
}

impl Sub for Dual {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self { value: self.value - other.value, slope: self.slope - other.slope }
    }
}

impl Mul for Dual {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let slope = self.slope * other.value + self.value * other.slope;
        Self { value: self.value * other.value, slope }
    }
}

impl Div for Dual {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        Self { value, slope: (self.slope - value * other.slope) / other.value }
    }
}

impl Neg for Dual {
    type Output = Self;
    fn neg(self) -> Self {
        Self { value: -self.value, slope: -self.slope }
    }
}

impl AddAssign for Dual {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl SubAssign for Dual {
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl MulAssign for Dual {
    fn mul_assign(&mut self, other: Self) {
        *self = *self * other;
    }
}

impl Scalar for Dual {
    const ZERO: Self = Self { value: 0.0, slope: 0.0 };
    const ONE: Self = Self { value: 1.0, slope: 0.0 };

    fn from_f64(value: f64) -> Self {
        Self { value, slope: 0.0 }
    }
    fn to_f64(self) -> f64 {
        self.value
    }
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.apply(root, 0.5 / root)
    }
    fn cbrt(self) -> Self {
        let root = self.value.cbrt();
        self.apply(root, 1.0 / (3.0 * root * root))
    }
    fn sin(self) -> Self {
        self.apply(self.value.sin(), self.value.cos())
    }
    fn cos(self) -> Self {
        self.apply(self.value.cos(), -self.value.sin())
    }
    fn tan(self) -> Self {
        let tan = self.value.tan();
        self.apply(tan, 1.0 + tan * tan)
    }
    fn asin(self) -> Self {
        self.apply(self.value.asin(), 1.0 / (1.0 - self.value * self.value).sqrt())
    }
    fn acos(self) -> Self {
        self.apply(self.value.acos(), -1.0 / (1.0 - self.value * self.value).sqrt())
    }
    fn atan(self) -> Self {
        self.apply(self.value.atan(), 1.0 / (1.0 + self.value * self.value))
    }
    fn atan2(self, x: Self) -> Self {
        let slope =
            (x.value * self.slope - self.value * x.slope) / (self.value * self.value + x.value * x.value);
        Self { value: self.value.atan2(x.value), slope }
    }
    fn sinh(self) -> Self {
        self.apply(self.value.sinh(), self.value.cosh())
    }
    fn cosh(self) -> Self {
        self.apply(self.value.cosh(), self.value.sinh())
    }
    fn tanh(self) -> Self {
        let tanh = self.value.tanh();
        self.apply(tanh, 1.0 - tanh * tanh)
    }
    fn exp(self) -> Self {
        let exp = self.value.exp();
        self.apply(exp, exp)
    }
    fn ln(self) -> Self {
        self.apply(self.value.ln(), 1.0 / self.value)
    }
    fn powf(self, exponent: Self) -> Self {
        let power = self.value.powf(exponent.value);
        self.apply(power, exponent.value * self.value.powf(exponent.value - 1.0))
    }
    fn abs(self) -> Self {
        self.apply(self.value.abs(), Scalar::sign(self.value))
    }
    fn sign(self) -> Self {
        Self::from_f64(Scalar::sign(self.value))
    }
    fn min(self, other: Self) -> Self {
        if other.value < self.value { other } else { self }
    }
    fn max(self, other: Self) -> Self {
        if other.value > self.value { other } else { self }
    }
    fn is_finite(self) -> bool {
        self.value.is_finite() && self.slope.is_finite()
    }
    fn all_gt(self, other: Self) -> bool {
        self.value > other.value
    }
    fn all_ge(self, other: Self) -> bool {
        self.value >= other.value
    }
    fn all_ne(self, other: Self) -> bool {
        self.value.all_ne(other.value)
    }
    fn select_gt(self, other: Self, then: Self, otherwise: Self) -> Self {
        if self.value > other.value { then } else { otherwise }
    }
}
