//! Complex numbers, for the complex pairs of eigenvalues that implicit methods have.

use core::ops::{Add, Div, Mul, Neg, Sub, SubAssign};

use crate::Real;

/// re + i im.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Complex<T> {
    pub(crate) re: T,
    pub(crate) im: T,
}

impl<T: Real> Add for Complex<T> {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        Self { re: self.re + other.re, im: self.im + other.im }
    }
}

impl<T: Real> Sub for Complex<T> {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        Self { re: self.re - other.re, im: self.im - other.im }
    }
}

impl<T: Real> SubAssign for Complex<T> {
    #[inline]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl<T: Real> Neg for Complex<T> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self { re: -self.re, im: -self.im }
    }
}

impl<T: Real> Mul for Complex<T> {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        Self { re: self.re * other.re - self.im * other.im, im: self.re * other.im + self.im * other.re }
    }
}

impl<T: Real> Div for Complex<T> {
    type Output = Self;
    /// By Smith's algorithm (Comm. ACM 5 (1962) 435), which keeps within range.
    #[inline]
    fn div(self, other: Self) -> Self {
        if other.re.abs() >= other.im.abs() {
            let ratio = other.im / other.re;
            let inverse = (other.re + other.im * ratio).recip();
            Self { re: (self.re + self.im * ratio) * inverse, im: (self.im - self.re * ratio) * inverse }
        } else {
            let ratio = other.re / other.im;
            let inverse = (other.re * ratio + other.im).recip();
            Self { re: (self.re * ratio + self.im) * inverse, im: (self.im * ratio - self.re) * inverse }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn division_undoes_multiplication() {
        for (re, im) in [(1.0, 2.0), (-3.0, 0.5), (0.0, 1e200), (1e-200, 0.0_f64)] {
            let a = Complex { re: 0.7, im: -1.3 };
            let b = Complex { re, im };
            let back = a * b / b;
            assert!((back.re - a.re).abs() < 1e-15 && (back.im - a.im).abs() < 1e-15, "{back:?}");
        }
    }
}
