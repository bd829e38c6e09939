//! Laurent polynomials over atoms: exact coefficients, rational exponents of either sign.

use super::monomial::{Exponent, Monomial};
use super::terms::Terms;
use crate::algebra::number::Rational;
use crate::id::ExprId;

/// `Σ coefficient · monomial`; no coefficient is zero.
#[derive(Clone, Debug, PartialEq, Default)]
pub(super) struct Polynomial(pub(super) Terms);

impl Polynomial {
    pub(super) fn constant(value: Rational) -> Self {
        Self::term(Monomial::default(), value)
    }

    pub(super) fn one() -> Self {
        Self::constant(Rational::ONE)
    }

    pub(super) fn term(monomial: Monomial, coefficient: Rational) -> Self {
        let mut polynomial = Self::default();
        polynomial.add_term(monomial, coefficient);
        polynomial
    }

    #[inline(always)]
    pub(super) fn len(&self) -> usize {
        self.0.len()
    }

    #[inline(always)]
    pub(super) fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    /// The number, if it is nothing else; `None` for zero.
    pub(super) fn as_number(&self) -> Option<&Rational> {
        self.single().filter(|(monomial, _)| monomial.is_unit()).map(|(_, number)| number)
    }

    pub(super) fn add_term(&mut self, monomial: Monomial, coefficient: Rational) {
        if !coefficient.is_zero() {
            self.0.add(monomial, coefficient);
        }
    }

    pub(super) fn add_scaled(&mut self, other: &Self, scale: &Rational) {
        for (monomial, coefficient) in other.0.iter() {
            self.add_term(monomial.clone(), coefficient.clone() * scale.clone());
        }
    }

    /// Adds another polynomial.
    pub(super) fn add(&mut self, other: Self) {
        if self.is_zero() {
            *self = other;
            return;
        }
        for (monomial, coefficient) in other.0 {
            self.0.add(monomial, coefficient);
        }
    }

    pub(super) fn scaled(&self, scale: &Rational) -> Self {
        if scale.is_one() {
            return self.clone();
        }
        let mut result = Self(Terms::with_capacity(self.len()));
        if !scale.is_zero() {
            for (monomial, coefficient) in self.0.iter() {
                result.0.append(monomial.clone(), coefficient.clone() * scale.clone());
            }
        }
        result
    }

    /// The term, if there is just one.
    pub(super) fn single(&self) -> Option<(&Monomial, &Rational)> {
        (self.len() == 1).then(|| self.0.first()).flatten()
    }

    /// The term with the largest monomial.
    pub(super) fn leading(&self) -> Option<(&Monomial, &Rational)> {
        self.0.last()
    }

    /// The positive greatest common divisor of the coefficients.
    pub(super) fn content(&self) -> Rational {
        self.0.values().fold(Rational::ZERO, |gcd, coefficient| {
            if gcd.is_one() && coefficient.is_integer() { gcd } else { gcd.gcd(coefficient) }
        })
    }

    /// The smallest and the largest exponent of an atom, that of absent ones being 0.
    pub(super) fn span(&self, atom: ExprId) -> (Exponent, Exponent) {
        let mut exponents = self.0.keys().map(|monomial| monomial.exponent(atom));
        let first = exponents.next().unwrap_or(Exponent::ZERO);
        exponents.fold((first, first), |(least, most), next| {
            (if next < least { next } else { least }, if next > most { next } else { most })
        })
    }

    /// The largest monomial that divides all, negative exponents included.
    pub(super) fn meet(&self) -> Monomial {
        let mut monomials = self.0.keys();
        let first = monomials.next().cloned().unwrap_or_default();
        monomials.fold(first, |meet, monomial| meet.meet(monomial))
    }

    /// The smallest monomial that all divide.
    pub(super) fn join(&self) -> Monomial {
        let mut monomials = self.0.keys();
        let first = monomials.next().cloned().unwrap_or_default();
        monomials.fold(first, |join, monomial| join.join(monomial))
    }

    /// Every term times a monomial.
    pub(super) fn shifted(&self, by: &Monomial) -> Option<Self> {
        let mut result = Self(Terms::with_capacity(self.len()));
        for (monomial, coefficient) in self.0.iter() {
            // multiplication keeps the order
            result.0.append(monomial.times(by)?, coefficient.clone());
        }
        Some(result)
    }
}
