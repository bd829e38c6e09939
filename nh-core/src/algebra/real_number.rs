//! A real number that is computed step by step with far more digits than are wanted of it.

use super::ball::{Ball, Enclosed, NoBall};
use super::enclosure::of_function;
use super::node::{Function, Function2};
use super::number::Rational;

/// A number to about `BITS` binary digits behind the point, with bounds on what is missing; or one of which nothing is
/// known.
#[derive(Clone, Debug)]
pub struct RealNumber<const BITS: u64>(Option<Ball>);

impl<const BITS: u64> RealNumber<BITS> {
    /// One of which nothing is known.
    pub const UNKNOWN: Self = Self(None);

    /// A rational number.
    #[must_use]
    pub fn of(value: &Rational) -> Self {
        Self(Some(Ball::of(value, BITS)))
    }

    /// π.
    #[must_use]
    pub fn pi() -> Self {
        Self(Some(Ball::pi(BITS)))
    }

    fn then(&self, f: impl FnOnce(&Ball) -> Enclosed) -> Self {
        Self(self.0.as_ref().and_then(|ball| f(ball).ok()))
    }

    fn with(&self, other: &Self, f: impl FnOnce(&Ball, &Ball) -> Enclosed) -> Self {
        self.then(|a| f(a, other.0.as_ref().ok_or(NoBall::Undefined)?))
    }

    /// The sum.
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        self.with(other, |a, b| Ok(a.plus(b)))
    }

    /// The difference.
    #[must_use]
    pub fn minus(&self, other: &Self) -> Self {
        self.with(other, |a, b| Ok(a.minus(b)))
    }

    /// The product.
    #[must_use]
    pub fn times(&self, other: &Self) -> Self {
        self.with(other, Ball::times)
    }

    /// The quotient.
    #[must_use]
    pub fn over(&self, other: &Self) -> Self {
        self.with(other, Ball::over)
    }

    /// The power of a number that is not negative.
    #[must_use]
    pub fn power(&self, exponent: &Rational) -> Self {
        self.then(|x| x.power(exponent))
    }

    /// The real cube root.
    #[must_use]
    pub fn cube_root(&self) -> Self {
        self.then(|x| if x.is_negative() { Ok(x.negative().root(3)?.negative()) } else { x.root(3) })
    }

    /// A function of one argument.
    #[must_use]
    pub fn function(&self, function: Function) -> Self {
        self.then(|x| of_function(function, x))
    }

    /// A function of two arguments.
    #[must_use]
    pub fn function2(&self, function: Function2, other: &Self) -> Self {
        let sign = self.minus(other).0;
        let is_less = sign.filter(Ball::is_nonzero).map(|difference| difference.is_negative());
        match (function, is_less) {
            (Function2::Atan2, _) => self.with(other, Ball::angle),
            (_, None) => Self::UNKNOWN,
            (Function2::Min, Some(is_less)) => if is_less { self } else { other }.clone(),
            (Function2::Max, Some(is_less)) => if is_less { other } else { self }.clone(),
        }
    }

    /// The number to more digits than any scalar type has, if so many are known.
    #[must_use]
    pub fn value(&self) -> Option<Rational> {
        self.0.as_ref().and_then(Ball::leading_digits)
    }
}
