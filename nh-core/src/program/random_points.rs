//! Numbers at random points, where functions with branches have numbers of their own for each argument, so that nothing
//! is taken for equal that is so on one branch only: √(x²) is not x at points where x > 0.

use super::interpret::Arithmetic;
use crate::algebra::{Bounded, Function, Function2, Rational, Residue};

/// A value at a point, where functions with branches have numbers of their own.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sampled(pub(super) Bounded);

impl Sampled {
    /// A number that a function and what it is applied to determine.
    #[allow(clippy::cast_precision_loss, reason = "a sample needs no more digits")]
    fn own(tag: u64, arguments: &[Self]) -> Self {
        let word = arguments
            .iter()
            .fold(41_000 + tag, |word, argument| Residue::mixed(word, argument.0.value.to_bits()).word());
        if arguments.iter().any(|argument| argument.0.value.is_nan()) {
            return Self(Bounded { value: f64::NAN, error: f64::NAN });
        }
        Self(Bounded { value: 0.5 + (word & 0xFFFF_FFFF) as f64 / f64::from(u32::MAX), error: 0.0 })
    }
}

impl Arithmetic for Sampled {
    fn number(value: &Rational) -> Self {
        Self(Bounded::number(value))
    }
    fn pi() -> Self {
        Self(Bounded::pi())
    }
    fn add(&self, other: &Self) -> Self {
        Self(self.0.add(&other.0))
    }
    fn sub(&self, other: &Self) -> Self {
        Self(self.0.sub(&other.0))
    }
    fn mul(&self, other: &Self) -> Self {
        Self(self.0.mul(&other.0))
    }
    fn div(&self, other: &Self) -> Self {
        Self(self.0.div(&other.0))
    }
    fn sqrt(&self) -> Self {
        Self::own(1, &[*self])
    }
    fn cbrt(&self) -> Self {
        Self::own(2, &[*self])
    }
    fn pow(&self, exponent: &Rational) -> Self {
        Self::own(3, &[*self, Self::number(exponent)])
    }
    fn apply(&self, function: Function) -> Self {
        match function {
            Function::Sin
            | Function::Cos
            | Function::Sinh
            | Function::Cosh
            | Function::Tanh
            | Function::Exp => Self(self.0.apply(function)),
            _ => Self::own(4 + function as u64, &[*self]),
        }
    }
    fn apply2(&self, function: Function2, other: &Self) -> Self {
        Self::own(64 + function as u64, &[*self, *other])
    }
    fn magnitude(&self) -> f64 {
        self.0.magnitude()
    }
}
