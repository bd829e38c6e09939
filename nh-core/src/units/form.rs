//! Dimensions that depend on dimensions which are not known.

use std::collections::BTreeMap;

use super::dimension::Dimension;
use crate::algebra::Rational;
use crate::id::{ConstantId, SymbolId};

/// Something whose dimension is not known beforehand.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Unknown {
    /// A parameter, coordinate, velocity, input, or the time.
    Symbol(SymbolId),
    /// A number that has a name.
    Constant(ConstantId),
    /// The Lagrangian.
    Lagrangian,
    /// What a method of the struct returns.
    Method(String),
    /// An argument of a method, counted from 0.
    Argument(String, usize),
}

/// A dimension as a product of powers of unknown ones: exponents are linear in those of the unknowns.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Form {
    /// The unknown dimensions with their exponents, none of them 0.
    pub(super) unknowns: BTreeMap<Unknown, Rational>,
    /// What is known.
    pub(super) known: Dimension,
}

impl Form {
    /// That of a pure number.
    #[must_use]
    pub fn none() -> Self {
        Self::default()
    }

    /// A dimension that is known.
    #[must_use]
    pub fn known(known: Dimension) -> Self {
        Self { unknowns: BTreeMap::new(), known }
    }

    /// A dimension that is not.
    #[must_use]
    pub fn of(unknown: Unknown) -> Self {
        Self { unknowns: [(unknown, Rational::ONE)].into(), known: Dimension::none() }
    }

    /// The dimension of a product with a power of another quantity.
    #[must_use]
    pub fn times(mut self, other: &Self, exponent: &Rational) -> Self {
        for (unknown, own) in &other.unknowns {
            let sum = own.clone() * exponent.clone()
                + self.unknowns.get(unknown).cloned().unwrap_or(Rational::ZERO);
            if sum.is_zero() {
                self.unknowns.remove(unknown);
            } else {
                self.unknowns.insert(unknown.clone(), sum);
            }
        }
        self.known = self.known.times(&other.known, exponent);
        self
    }

    /// The dimension of a product.
    #[must_use]
    pub fn by(self, other: &Self) -> Self {
        self.times(other, &Rational::ONE)
    }

    /// The dimension of a quotient.
    #[must_use]
    pub fn over(self, other: &Self) -> Self {
        self.times(other, &Rational::MINUS_ONE)
    }

    /// The dimension, if nothing in it is unknown.
    #[must_use]
    pub fn value(&self) -> Option<&Dimension> {
        self.unknowns.is_empty().then_some(&self.known)
    }
}
