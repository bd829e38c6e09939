//! Monomials with their coefficients in ascending order.
//!
//! A sorted list rather than a tree: most polynomials have a few terms, products come in order, and
//! in unoptimised builds, as procedural macros are by default, a list costs a fraction of a tree.

use super::monomial::Monomial;
use crate::algebra::number::Rational;
use std::cmp::Ordering;

/// Coefficients by monomial; none is zero.
#[derive(Clone, Debug)]
pub(super) enum Terms {
    /// At most one, in place.
    Few(Option<Term>),
    /// Any number.
    Many(Vec<Term>),
}

pub(super) type Term = (Monomial, Rational);

impl Terms {
    pub(super) fn with_capacity(capacity: usize) -> Self {
        if capacity < 2 { Self::default() } else { Self::Many(Vec::with_capacity(capacity)) }
    }

    #[inline(always)]
    fn list(&self) -> &[Term] {
        match self {
            Self::Few(term) => term.as_slice(),
            Self::Many(list) => list,
        }
    }

    #[inline(always)]
    pub(super) fn len(&self) -> usize {
        self.list().len()
    }

    #[inline(always)]
    pub(super) fn is_empty(&self) -> bool {
        self.list().is_empty()
    }

    pub(super) fn iter(&self) -> std::slice::Iter<'_, Term> {
        self.list().iter()
    }

    pub(super) fn keys(&self) -> impl Iterator<Item = &Monomial> {
        self.list().iter().map(|(monomial, _)| monomial)
    }

    pub(super) fn values(&self) -> impl Iterator<Item = &Rational> {
        self.list().iter().map(|(_, coefficient)| coefficient)
    }

    pub(super) fn first(&self) -> Option<(&Monomial, &Rational)> {
        self.list().first().map(|(monomial, coefficient)| (monomial, coefficient))
    }

    pub(super) fn last(&self) -> Option<(&Monomial, &Rational)> {
        self.list().last().map(|(monomial, coefficient)| (monomial, coefficient))
    }

    pub(super) fn get(&self, monomial: &Monomial) -> Option<&Rational> {
        self.place(monomial).ok().map(|index| &self.list()[index].1)
    }

    pub(super) fn remove(&mut self, monomial: &Monomial) {
        if let Ok(index) = self.place(monomial) {
            self.remove_at(index);
        }
    }

    fn remove_at(&mut self, index: usize) {
        match self {
            Self::Few(term) => *term = None,
            Self::Many(list) => _ = list.remove(index),
        }
    }

    fn insert_at(&mut self, index: usize, term: Term) {
        match self {
            Self::Few(place @ None) => *place = Some(term),
            Self::Few(first @ Some(_)) => {
                let mut list = Vec::with_capacity(4);
                list.extend(first.take());
                list.insert(index, term);
                *self = Self::Many(list);
            }
            Self::Many(list) if index == list.len() => list.push(term),
            Self::Many(list) => list.insert(index, term),
        }
    }

    /// Adds a coefficient that is not zero, of a monomial beyond all others.
    pub(super) fn append(&mut self, monomial: Monomial, coefficient: Rational) {
        self.insert_at(self.len(), (monomial, coefficient));
    }

    /// Adds a coefficient that is not zero.
    pub(super) fn add(&mut self, monomial: Monomial, coefficient: Rational) {
        let index = match self.place(&monomial) {
            Ok(index) => index,
            Err(index) => return self.insert_at(index, (monomial, coefficient)),
        };
        let known = match self {
            Self::Few(term) => term.as_mut_slice(),
            Self::Many(list) => list,
        };
        let sum = known[index].1.clone() + coefficient;
        if sum.is_zero() {
            self.remove_at(index);
        } else {
            known[index].1 = sum;
        }
    }

    /// Where a monomial stands or would stand: mostly at the end.
    fn place(&self, monomial: &Monomial) -> Result<usize, usize> {
        let list = self.list();
        let (mut low, mut high) = (0, list.len());
        // the last one is asked first
        let mut middle = high.wrapping_sub(1);
        while low < high {
            match list[middle].0.cmp(monomial) {
                Ordering::Less => low = middle + 1,
                Ordering::Equal => return Ok(middle),
                Ordering::Greater => high = middle,
            }
            middle = low + (high - low) / 2;
        }
        Err(low)
    }
}

impl Default for Terms {
    fn default() -> Self {
        Self::Few(None)
    }
}

impl PartialEq for Terms {
    fn eq(&self, other: &Self) -> bool {
        self.list() == other.list()
    }
}

impl IntoIterator for Terms {
    type Item = Term;
    type IntoIter = std::iter::Chain<std::option::IntoIter<Term>, std::vec::IntoIter<Term>>;
    fn into_iter(self) -> Self::IntoIter {
        let (few, many) = match self {
            Self::Few(term) => (term, Vec::new()),
            Self::Many(list) => (None, list),
        };
        few.into_iter().chain(many)
    }
}
