//! Monomials with their coefficients in ascending order.
//!
//! A sorted list rather than a tree: most polynomials have a few terms, products come in order, and
//! in unoptimised builds, as procedural macros are by default, a list costs a fraction of a tree.

use super::polynomial::Monomial;
use crate::algebra::number::Rational;

/// Coefficients by monomial; none is zero.
#[derive(Clone, Debug, PartialEq, Default)]
pub(super) struct Terms(Vec<(Monomial, Rational)>);

impl Terms {
    pub(super) fn with_capacity(capacity: usize) -> Self {
        Self(Vec::with_capacity(capacity))
    }

    pub(super) fn len(&self) -> usize {
        self.0.len()
    }

    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = (&Monomial, &Rational)> {
        self.0.iter().map(|(monomial, coefficient)| (monomial, coefficient))
    }

    pub(super) fn keys(&self) -> impl Iterator<Item = &Monomial> {
        self.0.iter().map(|(monomial, _)| monomial)
    }

    pub(super) fn values(&self) -> impl Iterator<Item = &Rational> {
        self.0.iter().map(|(_, coefficient)| coefficient)
    }

    pub(super) fn first(&self) -> Option<(&Monomial, &Rational)> {
        self.0.first().map(|(monomial, coefficient)| (monomial, coefficient))
    }

    pub(super) fn last(&self) -> Option<(&Monomial, &Rational)> {
        self.0.last().map(|(monomial, coefficient)| (monomial, coefficient))
    }

    pub(super) fn get(&self, monomial: &Monomial) -> Option<&Rational> {
        self.place(monomial).ok().map(|index| &self.0[index].1)
    }

    pub(super) fn remove(&mut self, monomial: &Monomial) {
        if let Ok(index) = self.place(monomial) {
            self.0.remove(index);
        }
    }

    /// Adds a coefficient that is not zero.
    pub(super) fn add(&mut self, monomial: Monomial, coefficient: Rational) {
        match self.place(&monomial) {
            Err(index) => self.0.insert(index, (monomial, coefficient)),
            Ok(index) => {
                let sum = self.0[index].1.clone() + coefficient;
                if sum.is_zero() {
                    self.0.remove(index);
                } else {
                    self.0[index].1 = sum;
                }
            }
        }
    }

    /// Where a monomial stands or would stand: mostly at the end.
    fn place(&self, monomial: &Monomial) -> Result<usize, usize> {
        match self.0.last() {
            Some((last, _)) if monomial <= last => self.0.binary_search_by(|(key, _)| key.cmp(monomial)),
            _ => Err(self.0.len()),
        }
    }
}

impl IntoIterator for Terms {
    type Item = (Monomial, Rational);
    type IntoIter = std::vec::IntoIter<Self::Item>;
    fn into_iter(self) -> Self::IntoIter {
        self.0.into_iter()
    }
}
