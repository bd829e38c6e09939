//! Numbers with their partial derivatives.

use core::array;
use core::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

use crate::Scalar;

/// A number with its partial derivatives by N variables, and by M others: forward differentiation
/// (Griewank, Walther, Evaluating Derivatives, 2008, chapter 3).
///
/// What is written for any [`Scalar`], a declared system with a type parameter for example, is
/// differentiated exactly by evaluating it with jets. Where a function has no derivative the partial
/// derivatives are not finite, except those of `abs`, `sign`, `min` and `max`, which are one-sided, or zero as that of
/// `abs` at zero.
///
/// A product with a factor that is zero has a derivative wherever that factor has one, whether the other one has or not
/// (`x √x`, and the drag `v |v|` of a velocity in a plane): it is that of the factor times the other one, as long as this is
/// continuous, which all functions are there but `atan2` at the origin.
///
/// ```
/// use nonholonomic::{Jet, Scalar};
///
/// fn energy<T: Scalar>(m: T, v: T) -> T {
///     T::from_f64(0.5) * m * v * v
/// }
/// // by mass and speed
/// let [m, v] = Jet::<f64, 2>::variables([2.0, 3.0]);
/// assert_eq!(energy(m, v).by, [4.5, 6.0]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jet<T, const N: usize, const M: usize = 0> {
    /// The number.
    pub value: T,
    /// The partial derivatives.
    pub by: [T; N],
    /// The partial derivatives by the other variables.
    pub by_others: [T; M],
}

impl<T: Scalar, const N: usize, const M: usize> Jet<T, N, M> {
    /// A number that does not depend on the variables.
    #[inline]
    #[must_use]
    pub const fn constant(value: T) -> Self {
        Self { value, by: [T::ZERO; N], by_others: [T::ZERO; M] }
    }

    /// The variables themselves.
    #[inline]
    #[must_use]
    pub fn variables(values: [T; N]) -> [Self; N] {
        array::from_fn(|i| {
            let by = array::from_fn(|j| if i == j { T::ONE } else { T::ZERO });
            values.get(i).map_or(Self::ZERO, |value| Self { by, ..Self::constant(*value) })
        })
    }

    /// A function of this number alone, by its value and derivative.
    #[inline]
    fn function(self, value: T, derivative: T) -> Self {
        Self {
            value,
            by: self.by.map(|partial| derivative * partial),
            by_others: self.by_others.map(|partial| derivative * partial),
        }
    }

    /// A function of some numbers, by its value and derivatives there.
    #[inline]
    #[must_use]
    pub fn of_call<const K: usize>(value: T, derivatives: [T; K], arguments: [Self; K]) -> Self {
        let along = |sum: Self, (derivative, argument): (T, Self)| {
            sum.combined(argument, value, |sum, partial| derivative.mul_add(partial, sum))
        };
        derivatives.into_iter().zip(arguments).fold(Self::constant(value), along)
    }

    /// A function of two numbers, by its value and what it does to a pair of their partial derivatives.
    #[inline]
    fn combined(self, other: Self, value: T, partial: impl Fn(T, T) -> T) -> Self {
        let (mut by, mut by_others) = (self.by, self.by_others);
        for (a, b) in by.iter_mut().zip(other.by) {
            *a = partial(*a, b);
        }
        for (a, b) in by_others.iter_mut().zip(other.by_others) {
            *a = partial(*a, b);
        }
        Self { value, by, by_others }
    }
}

/// The derivative of a factor that stands beside `zero` in a product: none where that is zero, and has a derivative that is
/// finite, while the factor has none. Of second derivatives nothing is known there.
#[inline]
fn beside<T: Scalar>(zero: T, derivative: T, of_zero: T) -> T {
    if T::DERIVATIVES > 0 {
        return derivative;
    }
    // what is not finite gives no zero
    let where_finite = |number: T, then: T, otherwise: T| T::ONE.select_gt(number * T::ZERO, then, otherwise);
    let left = where_finite(derivative, derivative, where_finite(of_zero, T::ZERO, derivative));
    zero.abs().select_gt(T::ZERO, derivative, left)
}

impl<T: Scalar, const N: usize, const M: usize> Default for Jet<T, N, M> {
    fn default() -> Self {
        Self::ZERO
    }
}

impl<T: Scalar, const N: usize, const M: usize> Add for Jet<T, N, M> {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        self.combined(other, self.value + other.value, |a, b| a + b)
    }
}

impl<T: Scalar, const N: usize, const M: usize> Sub for Jet<T, N, M> {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        self.combined(other, self.value - other.value, |a, b| a - b)
    }
}

impl<T: Scalar, const N: usize, const M: usize> Mul for Jet<T, N, M> {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        let value = self.value * other.value;
        let partial = |a: T, b: T| a.mul_add(other.value, self.value * b);
        if self.value.all_ne(T::ZERO) && other.value.all_ne(T::ZERO) {
            return self.combined(other, value, partial);
        }
        self.combined(other, value, |a, b| partial(beside(other.value, a, b), beside(self.value, b, a)))
    }
}

impl<T: Scalar, const N: usize, const M: usize> Div for Jet<T, N, M> {
    type Output = Self;
    #[inline]
    #[allow(clippy::suspicious_arithmetic_impl)] // the quotient rule
    fn div(self, other: Self) -> Self {
        let quotient = self.value / other.value;
        if quotient.all_ne(T::ZERO) {
            return self.combined(other, quotient, |a, b| (a - quotient * b) / other.value);
        }
        self.combined(other, quotient, |a, b| (a - quotient * beside(quotient, b, a)) / other.value)
    }
}

impl<T: Scalar, const N: usize, const M: usize> Neg for Jet<T, N, M> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self { value: -self.value, by: self.by.map(|a| -a), by_others: self.by_others.map(|a| -a) }
    }
}

macro_rules! assign {
    ($($operator:ident $name:ident $symbol:tt;)*) => {$(
        impl<T: Scalar, const N: usize, const M: usize> $operator for Jet<T, N, M> {
            #[inline]
            fn $name(&mut self, other: Self) {
                *self = *self $symbol other;
            }
        }
    )*};
}
assign! {
    AddAssign add_assign +;
    SubAssign sub_assign -;
    MulAssign mul_assign *;
}

/// The functions of one number, by their derivatives as functions of the number and the value.
macro_rules! functions {
    ($($name:ident: |$x:pat_param, $value:pat_param| $derivative:expr;)*) => {$(
        #[inline]
        fn $name(self) -> Self {
            let derivative = |$x: T, $value: T| $derivative;
            let value = self.value.$name();
            self.function(value, derivative(self.value, value))
        }
    )*};
}

impl<T: Scalar, const N: usize, const M: usize> Scalar for Jet<T, N, M> {
    const ZERO: Self = Self::constant(T::ZERO);
    const ONE: Self = Self::constant(T::ONE);
    const DERIVATIVES: u32 = T::DERIVATIVES + 1;

    #[inline]
    fn from_f64(value: f64) -> Self {
        Self::constant(T::from_f64(value))
    }
    #[inline]
    fn to_f64(self) -> f64 {
        self.value.to_f64()
    }
    functions! {
        sqrt: |_, root| T::from_f64(0.5) / root;
        cbrt: |_, root| (T::from_f64(3.0) * root * root).recip();
        sin: |x, _| x.cos();
        cos: |x, _| -x.sin();
        tan: |_, tan| tan.mul_add(tan, T::ONE);
        asin: |x, _| (T::ONE - x * x).sqrt().recip();
        acos: |x, _| -(T::ONE - x * x).sqrt().recip();
        atan: |x, _| x.mul_add(x, T::ONE).recip();
        sinh: |x, _| x.cosh();
        cosh: |x, _| x.sinh();
        tanh: |x, tanh| {
            // far out all digits cancel in that difference
            let falling = (x.abs() * T::from_f64(-2.0)).exp();
            let square = (T::ONE + falling) * (T::ONE + falling);
            x.abs().select_gt(T::ONE, T::from_f64(4.0) * falling / square, T::ONE - tanh * tanh)
        };
        exp: |_, exp| exp;
        ln: |x, _| x.recip();
        abs: |x, _| x.sign();
        sign: |_, _| T::ZERO;
        recip: |_, reciprocal| -(reciprocal * reciprocal);
    }
    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = self.value.sin_cos();
        (self.function(sin, cos), self.function(cos, -sin))
    }
    #[inline]
    fn atan2(self, x: Self) -> Self {
        // by the quotient of the smaller by the larger: squares may leave the range of the numbers
        let (steep, flat) = (self.value.abs(), x.value.abs());
        let larger = steep.select_gt(flat, self.value, x.value);
        let quotient = steep.select_gt(flat, x.value, self.value) / larger;
        let by_y = steep.select_gt(flat, quotient, T::ONE);
        let by_x = steep.select_gt(flat, T::ONE, quotient);
        let scale = larger * quotient.mul_add(quotient, T::ONE);
        self.combined(x, self.value.atan2(x.value), |dy, dx| (by_y * dy - by_x * dx) / scale)
    }
    #[inline]
    fn powf(self, exponent: Self) -> Self {
        let power = self.value.powf(exponent.value);
        let by_base = exponent.value * self.value.powf(exponent.value - T::ONE);
        let by_exponent = power * self.value.ln();
        // a constant exponent is usual, and its base may be zero
        let zero = T::ZERO;
        self.combined(exponent, power, |a, b| {
            let rest = by_exponent * b;
            by_base.mul_add(a, b.abs().select_gt(zero, rest, b))
        })
    }
    #[inline]
    fn min(self, other: Self) -> Self {
        self.combined(other, self.value.min(other.value), |a, b| other.value.select_gt(self.value, a, b))
    }
    #[inline]
    fn max(self, other: Self) -> Self {
        self.combined(other, self.value.max(other.value), |a, b| self.value.select_gt(other.value, a, b))
    }
    #[inline]
    fn mul_add(self, factor: Self, summand: Self) -> Self {
        let product = Self { value: T::ZERO, ..self * factor };
        Self { value: self.value.mul_add(factor.value, summand.value), ..product + summand }
    }
    #[inline]
    fn mul_add_exact(self, factor: Self, summand: Self) -> Self {
        let product = Self { value: T::ZERO, ..self * factor };
        Self { value: self.value.mul_add_exact(factor.value, summand.value), ..product + summand }
    }

    #[inline]
    fn is_finite(self) -> bool {
        let partials = self.by.iter().chain(&self.by_others);
        partials.fold(self.value.is_finite(), |finite, partial| finite & partial.is_finite())
    }
    #[inline]
    fn all_gt(self, other: Self) -> bool {
        self.value.all_gt(other.value)
    }
    #[inline]
    fn all_ge(self, other: Self) -> bool {
        self.value.all_ge(other.value)
    }
    #[inline]
    fn all_ne(self, other: Self) -> bool {
        self.value.all_ne(other.value)
    }
    #[inline]
    fn select_gt(self, other: Self, then: Self, otherwise: Self) -> Self {
        let select = |a: T, b: T| self.value.select_gt(other.value, a, b);
        then.combined(otherwise, select(then.value, otherwise.value), select)
    }
}
