//! Polynomials written back as expressions.

use super::polynomial::{Exponent, Factor, Kind, Monomial, Polynomial};
use super::reader::Reader;
use crate::algebra::graph::{Function, Node};
use crate::algebra::number::Rational;
use crate::id::ExprId;
use std::collections::BTreeMap;

/// Nested common factors that are taken out at most.
const NESTING: usize = 24;

impl Reader<'_> {
    /// `coefficient · monomial`.
    pub(super) fn monomial_expression(&mut self, monomial: &Monomial, coefficient: &Rational) -> ExprId {
        let mut factors: Vec<(ExprId, Rational)> = Vec::with_capacity(monomial.0.len());
        let (mut exponentials, mut radicand) = (Vec::new(), Rational::ONE);
        let half = Rational::new(1, 2);
        for Factor { atom, kind, exponent } in &monomial.0 {
            let exponent = exponent.to_rational();
            match (self.graph.node(*atom), kind) {
                (Node::Number(value), Kind::Number) if exponent == half => {
                    radicand = radicand * value.clone();
                }
                (Node::Apply(Function::Exp, x), _) => exponentials.push((exponent, *x, *atom)),
                _ => factors.push((*atom, exponent)),
            }
        }
        match exponentials.as_slice() {
            [] => {}
            // a power of one exponential shares it; several are cheaper as one
            [(exponent, _, atom)] if !exponent.is_negative() => factors.push((*atom, exponent.clone())),
            _ => {
                let summands: Vec<_> = exponentials.iter().map(|(e, x, _)| (e.clone(), *x)).collect();
                let argument = self.graph.linear_combination(&summands);
                factors.push((self.graph.apply(Function::Exp, argument), Rational::ONE));
            }
        }
        if !radicand.is_one() {
            factors.push((self.graph.number(radicand), half));
        }
        let product = self.graph.product(&factors);
        self.graph.scale(coefficient.clone(), product)
    }

    /// The sum of the terms as they are.
    pub(super) fn plain_sum(&mut self, polynomial: &Polynomial) -> ExprId {
        let summands: Vec<_> = polynomial
            .0
            .iter()
            .map(|(monomial, coefficient)| {
                (coefficient.clone(), self.monomial_expression(monomial, &Rational::ONE))
            })
            .collect();
        self.graph.linear_combination(&summands)
    }

    /// The canonical expression: what all terms share in front, one fraction per denominator.
    pub(super) fn expression(&mut self, polynomial: &Polynomial) -> ExprId {
        let (common, rest) = without_common_factor(polynomial);
        let mut fractions: BTreeMap<Monomial, Polynomial> = BTreeMap::new();
        for (monomial, coefficient) in rest.0.iter() {
            let (below, above) = monomial.split(is_denominator);
            fractions.entry(below).or_default().add_term(above, coefficient.clone());
        }
        let mut summands = Vec::with_capacity(fractions.len());
        for (below, above) in &fractions {
            let (shared, above) = without_common_factor(above);
            let sum = self.plain_sum(&above);
            let shared = self.monomial_expression(&shared, &Rational::ONE);
            let below = self.monomial_expression(below, &Rational::ONE);
            let factors = [sum, shared, below].map(|id| (id, Rational::ONE));
            summands.push(self.graph.product(&factors));
        }
        let sum = self.graph.sum(&summands);
        let common = self.monomial_expression(&common, &Rational::ONE);
        self.graph.mul(sum, common)
    }

    /// The expression with factors taken out greedily, the most frequent first.
    pub(super) fn factored(&mut self, polynomial: &Polynomial) -> ExprId {
        self.factored_within(polynomial, NESTING)
    }

    fn factored_within(&mut self, polynomial: &Polynomial, nesting: usize) -> ExprId {
        let (common, mut rest) = without_common_factor(polynomial);
        // Σ outer · inner; the inner ones are different
        let mut parts: Vec<(Polynomial, Polynomial)> = Vec::new();
        while let Some(factor) = most_frequent(&rest).filter(|_| nesting > 0) {
            let (mut inside, mut outside) = (Polynomial::default(), Polynomial::default());
            for (monomial, coefficient) in rest.0 {
                let target = if shares(&monomial, &factor) { &mut inside } else { &mut outside };
                target.add_term(monomial, coefficient);
            }
            let (outer, inner) = without_common_factor(&inside);
            let (scale, inner) = monic(inner);
            match parts.iter_mut().find(|part| part.1 == inner) {
                Some(part) => part.0.add_term(outer, scale),
                None => parts.push((Polynomial::term(outer, scale), inner)),
            }
            rest = outside;
        }
        let mut summands = vec![self.plain_sum(&rest)];
        for (outer, inner) in &parts {
            let outer = self.factored_within(outer, nesting - 1);
            let inner = self.factored_within(inner, nesting - 1);
            summands.push(self.graph.mul(outer, inner));
        }
        let sum = self.graph.sum(&summands);
        let common = self.monomial_expression(&common, &Rational::ONE);
        self.graph.mul(sum, common)
    }
}

/// The leading coefficient, and the polynomial divided by it.
fn monic(polynomial: Polynomial) -> (Rational, Polynomial) {
    let leading = polynomial.leading().map(|(_, coefficient)| coefficient.clone());
    match leading.as_ref().and_then(Rational::recip) {
        Some(inverse) => (leading.unwrap_or(Rational::ONE), polynomial.scaled(&inverse)),
        None => (Rational::ONE, polynomial),
    }
}

fn is_denominator(factor: &Factor) -> bool {
    factor.kind == Kind::Sum && factor.exponent.is_negative()
}

/// Takes out what stands in every term with an exponent of one sign.
fn without_common_factor(polynomial: &Polynomial) -> (Monomial, Polynomial) {
    if polynomial.len() < 2 {
        return (Monomial::default(), polynomial.clone());
    }
    let mut monomials = polynomial.0.keys();
    let mut common = monomials.next().cloned().unwrap_or_default();
    for monomial in monomials {
        for factor in &mut common.0 {
            let other = monomial.exponent(factor.atom);
            factor.exponent = nearer_to_zero(factor.exponent, other);
        }
        common.0.retain(|factor| !factor.exponent.is_zero());
    }
    match polynomial.shifted(&common.inverse()) {
        Some(rest) => (common, rest),
        None => (Monomial::default(), polynomial.clone()),
    }
}

/// The exponent that two powers have in common; 0 for opposite signs.
fn nearer_to_zero(a: Exponent, b: Exponent) -> Exponent {
    if a.is_negative() && b.is_negative() {
        a.max(b)
    } else if a.is_negative() || b.is_negative() {
        Exponent::ZERO
    } else {
        a.min(b)
    }
}

fn shares(monomial: &Monomial, factor: &Factor) -> bool {
    let exponent = monomial.exponent(factor.atom);
    !exponent.is_zero() && exponent.is_negative() == factor.exponent.is_negative()
}

/// The atom, with the sign of its exponent, that stands in most terms; denominators count double.
fn most_frequent(polynomial: &Polynomial) -> Option<Factor> {
    let mut counts: BTreeMap<(ExprId, bool), (usize, Factor)> = BTreeMap::new();
    for factor in polynomial.0.keys().flat_map(|monomial| &monomial.0) {
        let entry = counts.entry((factor.atom, factor.exponent.is_negative())).or_insert((0, *factor));
        entry.0 += if factor.exponent.is_negative() { 2 } else { 1 };
    }
    let enough = |count: usize, factor: &Factor| count >= if factor.exponent.is_negative() { 4 } else { 2 };
    let mut best: Option<(usize, Factor)> = None;
    for (count, factor) in counts.into_values() {
        if enough(count, &factor) && best.is_none_or(|(most, _)| count > most) {
            best = Some((count, factor));
        }
    }
    best.map(|(_, factor)| factor)
}
