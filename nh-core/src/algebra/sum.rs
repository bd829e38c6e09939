//! Sums. Automatic identities, true everywhere: nested sums are flattened, numbers are added,
//! like terms are collected, a number times a sum is distributed.

use super::graph::Graph;
use super::node::Node;
use super::number::Rational;
use crate::id::ExprId;
use crate::limits;

impl Graph {
    /// `Σ coefficient · term`.
    pub fn linear_combination(&mut self, summands: &[(Rational, ExprId)]) -> ExprId {
        self.combination_of(summands.iter().map(|(coefficient, term)| (coefficient, *term)))
    }

    pub(super) fn combination_of<'a>(
        &mut self,
        summands: impl Iterator<Item = (&'a Rational, ExprId)>,
    ) -> ExprId {
        let mut constant = Rational::ZERO;
        let mut terms = self.take_spare();
        for (coefficient, id) in summands {
            self.collect_summand(coefficient, id, &mut constant, &mut terms);
        }
        let sum = self.sum_of_terms(constant, &mut terms);
        self.give_back(terms);
        sum
    }

    fn collect_summand(
        &mut self,
        scale: &Rational,
        id: ExprId,
        constant: &mut Rational,
        terms: &mut Vec<(ExprId, Rational)>,
    ) {
        match self.node(id) {
            Node::Number(value) => *constant = constant.clone() + scale.clone() * value.clone(),
            Node::Sum { constant: inner, terms: list } => {
                *constant = constant.clone() + scale.clone() * inner.clone();
                terms.extend(list.iter().map(|(term, c)| (*term, scale.clone() * c.clone())));
            }
            Node::Product { coefficient, .. } if !coefficient.is_one() => {
                let (coefficient, term) = self.split_coefficient(id);
                terms.push((term, scale.clone() * coefficient));
            }
            _ => terms.push((id, scale.clone())),
        }
    }

    /// Collects like terms and stores the sum.
    fn sum_of_terms(&mut self, mut constant: Rational, terms: &mut Vec<(ExprId, Rational)>) -> ExprId {
        limits::spend(1 + terms.len());
        collect_like(terms);
        terms.retain(|(_, coefficient)| !coefficient.is_zero());
        self.cancel_by_value(&mut constant, terms);
        match terms.as_slice() {
            [] => self.number(constant),
            [(term, coefficient)] if constant.is_zero() => {
                let (term, coefficient) = (*term, coefficient.clone());
                self.scale(coefficient, term)
            }
            terms => self.intern_sum(constant, terms),
        }
    }

    /// `a + b`.
    pub fn add(&mut self, a: ExprId, b: ExprId) -> ExprId {
        self.linear_combination(&[(Rational::ONE, a), (Rational::ONE, b)])
    }

    /// `a − b`.
    pub fn sub(&mut self, a: ExprId, b: ExprId) -> ExprId {
        self.linear_combination(&[(Rational::ONE, a), (Rational::MINUS_ONE, b)])
    }

    /// `−a`.
    pub fn neg(&mut self, a: ExprId) -> ExprId {
        self.scale(Rational::MINUS_ONE, a)
    }

    /// The sum of all.
    pub fn sum(&mut self, summands: &[ExprId]) -> ExprId {
        self.combination_of(summands.iter().map(|id| (&Rational::ONE, *id)))
    }

    /// `Σ a_i b_i`.
    pub fn inner_product(&mut self, a: &[ExprId], b: &[ExprId]) -> ExprId {
        let zero = self.zero();
        let pairs = a.iter().zip(b).filter(|(a, b)| **a != zero && **b != zero);
        let summands: Vec<_> = pairs.map(|(a, b)| self.mul(*a, *b)).collect();
        limits::spend(a.len() / 16);
        self.sum(&summands)
    }

    /// A sum as `(constant, terms)`; anything else as one term.
    #[must_use]
    pub fn as_linear(&self, id: ExprId) -> (Rational, Vec<(ExprId, Rational)>) {
        match self.node(id) {
            Node::Number(value) => (value.clone(), Vec::new()),
            Node::Sum { constant, terms } => (constant.clone(), terms.to_vec()),
            _ => (Rational::ZERO, vec![(id, Rational::ONE)]),
        }
    }
}

/// Sorts terms or factors, and adds the coefficients or exponents of equal ones.
pub(super) fn collect_like(list: &mut Vec<(ExprId, Rational)>) {
    if list.is_sorted_by(|(a, _), (b, _)| a < b) {
        return;
    }
    list.sort_by_key(|(id, _)| *id);
    list.dedup_by(|(id, number), (last, sum)| {
        let same = id == last;
        if same {
            *sum = sum.clone() + number.clone();
        }
        same
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn like_terms_collect_and_cancel() {
        let mut g = Graph::new();
        let (x, y) = (g.new_symbol("x"), g.new_symbol("y"));
        let (x, y) = (g.symbol(x), g.symbol(y));
        let s = g.add(x, y);
        let twice = g.scale(Rational::from(2), s);
        let back =
            g.linear_combination(&[(Rational::ONE, twice), (Rational::from(-2), y), (Rational::from(-2), x)]);
        assert!(g.is_literal_zero(back));
    }

    #[test]
    fn order_of_summands_does_not_matter() {
        let mut g = Graph::new();
        let (x, y) = (g.new_symbol("x"), g.new_symbol("y"));
        let (x, y) = (g.symbol(x), g.symbol(y));
        assert_eq!(g.add(x, y), g.add(y, x));
    }
}
