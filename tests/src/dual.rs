//! Dual numbers a + b ε with ε² = 0: derivatives of generated code to round-off. Nested, they give
//! derivatives of higher order.

use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

use nonholonomic::Scalar;

/// A number and its derivative in some direction.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Dual<T = f64> {
    /// The number.
    pub value: T,
    /// Its derivative.
    pub slope: T,
}

impl<T: Scalar> Dual<T> {
    /// A function of this number, by its value and derivative.
    fn apply(self, value: T, derivative: T) -> Self {
        Self { value, slope: if self.slope == T::ZERO { T::ZERO } else { derivative * self.slope } }
    }
}

impl<T: Scalar> Add for Dual<T> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { value: self.value + other.value, slope: self.slope + other.slope }
    }
}

impl<T: Scalar> Sub for Dual<T> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self { value: self.value - other.value, slope: self.slope - other.slope }
    }
}

impl<T: Scalar> Mul for Dual<T> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let slope = self.slope * other.value + self.value * other.slope;
        Self { value: self.value * other.value, slope }
    }
}

impl<T: Scalar> Div for Dual<T> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        Self { value, slope: (self.slope - value * other.slope) / other.value }
    }
}

impl<T: Scalar> Neg for Dual<T> {
    type Output = Self;
    fn neg(self) -> Self {
        Self { value: -self.value, slope: -self.slope }
    }
}

impl<T: Scalar> AddAssign for Dual<T> {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<T: Scalar> SubAssign for Dual<T> {
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl<T: Scalar> MulAssign for Dual<T> {
    fn mul_assign(&mut self, other: Self) {
        *self = *self * other;
    }
}

impl<T: Scalar> Scalar for Dual<T> {
    const ZERO: Self = Self { value: T::ZERO, slope: T::ZERO };
    const ONE: Self = Self { value: T::ONE, slope: T::ZERO };

    fn from_f64(value: f64) -> Self {
        Self { value: T::from_f64(value), slope: T::ZERO }
    }
    fn to_f64(self) -> f64 {
        self.value.to_f64()
    }
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.apply(root, T::from_f64(0.5) / root)
    }
    fn cbrt(self) -> Self {
        let root = self.value.cbrt();
        self.apply(root, T::ONE / (T::from_f64(3.0) * root * root))
    }
    fn sin(self) -> Self {
        self.apply(self.value.sin(), self.value.cos())
    }
    fn cos(self) -> Self {
        self.apply(self.value.cos(), -self.value.sin())
    }
    fn tan(self) -> Self {
        let tan = self.value.tan();
        self.apply(tan, T::ONE + tan * tan)
    }
    fn asin(self) -> Self {
        self.apply(self.value.asin(), T::ONE / (T::ONE - self.value * self.value).sqrt())
    }
    fn acos(self) -> Self {
        self.apply(self.value.acos(), -T::ONE / (T::ONE - self.value * self.value).sqrt())
    }
    fn atan(self) -> Self {
        self.apply(self.value.atan(), T::ONE / (T::ONE + self.value * self.value))
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
        self.apply(tanh, T::ONE - tanh * tanh)
    }
    fn exp(self) -> Self {
        let exp = self.value.exp();
        self.apply(exp, exp)
    }
    fn ln(self) -> Self {
        self.apply(self.value.ln(), T::ONE / self.value)
    }
    fn powf(self, exponent: Self) -> Self {
        let power = self.value.powf(exponent.value);
        self.apply(power, exponent.value * self.value.powf(exponent.value - T::ONE))
    }
    fn abs(self) -> Self {
        self.apply(self.value.abs(), self.value.sign())
    }
    fn sign(self) -> Self {
        Self { value: self.value.sign(), slope: T::ZERO }
    }
    fn min(self, other: Self) -> Self {
        if self.value.all_gt(other.value) { other } else { self }
    }
    fn max(self, other: Self) -> Self {
        if other.value.all_gt(self.value) { other } else { self }
    }
    fn is_finite(self) -> bool {
        self.value.is_finite() && self.slope.is_finite()
    }
    fn all_gt(self, other: Self) -> bool {
        self.value.all_gt(other.value)
    }
    fn all_ge(self, other: Self) -> bool {
        self.value.all_ge(other.value)
    }
    fn all_ne(self, other: Self) -> bool {
        self.value.all_ne(other.value)
    }
    fn select_gt(self, other: Self, then: Self, otherwise: Self) -> Self {
        if self.value.all_gt(other.value) { then } else { otherwise }
    }
}
