//! Polynomials written back as expressions.

use super::monomial::{Exponent, Factor, Kind, Monomial};
use super::polynomial::Polynomial;
use super::reader::Reader;
use crate::algebra::node::{Function, Node};
use crate::algebra::number::Rational;
use crate::id::ExprId;
use crate::id_map::IdMap;
use std::borrow::Cow;
use std::collections::BTreeMap;

/// Nested common factors that are taken out at most.
const NESTING: usize = 24;

impl Reader<'_> {
    /// `coefficient · monomial`.
    pub(super) fn monomial_expression(&mut self, monomial: &Monomial, coefficient: &Rational) -> ExprId {
        let is_special = |factor: &Factor| {
            factor.kind == Kind::Number
                || matches!(self.graph.node(factor.atom), Node::Apply(Function::Exp, _))
        };
        let product = if monomial.0.iter().any(is_special) {
            self.special_monomial(monomial)
        } else {
            let factors = monomial.0.iter().map(|factor| (factor.atom, factor.exponent.to_rational()));
            self.graph.product_of(factors)
        };
        self.graph.scale(coefficient.clone(), product)
    }

    /// A monomial with exponentials or roots of numbers, which are put together.
    fn special_monomial(&mut self, monomial: &Monomial) -> ExprId {
        let mut factors: Vec<(ExprId, Rational)> = Vec::with_capacity(monomial.0.len());
        let (mut exponentials, mut radicand) = (Vec::new(), Rational::ONE);
        let half = Rational::new(1, 2);
        for Factor { atom, kind, exponent } in monomial.0.iter() {
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
        self.graph.product(&factors)
    }

    /// The sum of the terms as they are.
    pub(super) fn plain_sum(&mut self, polynomial: &Polynomial) -> ExprId {
        let mut summands = self.graph.take_spare();
        for (monomial, coefficient) in polynomial.0.iter() {
            summands.push((self.monomial_expression(monomial, &Rational::ONE), coefficient.clone()));
        }
        let sum = self.graph.combination_of(summands.iter().map(|(term, coefficient)| (coefficient, *term)));
        self.graph.give_back(summands);
        sum
    }

    /// The canonical expression: what all terms share in front, one fraction per denominator.
    pub(super) fn expression(&mut self, polynomial: &Polynomial) -> ExprId {
        let (common, rest) = without_common_factor(polynomial);
        self.fractions_times(&rest, &common)
    }

    /// The canonical expression, and the one with factors taken out greedily, the most frequent first.
    pub(super) fn expressions(&mut self, polynomial: &Polynomial) -> (ExprId, ExprId) {
        let (common, rest) = without_common_factor(polynomial);
        let canonical = self.fractions_times(&rest, &common);
        if !has_fractions(&rest) && most_frequent(&rest).is_none() {
            return (canonical, canonical);
        }
        (canonical, self.factors_times(rest, &common, NESTING))
    }

    fn fractions_times(&mut self, rest: &Polynomial, common: &Monomial) -> ExprId {
        if rest.len() > 1 && !has_fractions(rest) {
            let sum = self.plain_sum(rest);
            let sum = self.graph.product(&[(sum, Rational::ONE)]);
            let common = self.monomial_expression(common, &Rational::ONE);
            return self.graph.mul(sum, common);
        }
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
        let common = self.monomial_expression(common, &Rational::ONE);
        self.graph.mul(sum, common)
    }

    fn factored_within(&mut self, polynomial: &Polynomial, nesting: usize) -> ExprId {
        let (common, rest) = without_common_factor(polynomial);
        self.factors_times(rest, &common, nesting)
    }

    fn factors_times(&mut self, rest: Cow<'_, Polynomial>, common: &Monomial, nesting: usize) -> ExprId {
        let mut rest = rest;
        // Σ outer · inner; the inner ones are different
        let mut parts: Vec<(Polynomial, Polynomial)> = Vec::new();
        while let Some(factor) = most_frequent(&rest).filter(|_| nesting > 0) {
            let (mut inside, mut outside) = (Polynomial::default(), Polynomial::default());
            for (monomial, coefficient) in rest.into_owned().0 {
                let target = if shares(&monomial, &factor) { &mut inside } else { &mut outside };
                target.add_term(monomial, coefficient);
            }
            let (outer, inner) = without_common_factor(&inside);
            let (scale, inner) = monic(inner);
            match parts.iter_mut().find(|part| part.1 == *inner) {
                Some(part) => part.0.add_term(outer, scale),
                None => parts.push((Polynomial::term(outer, scale), inner.into_owned())),
            }
            rest = Cow::Owned(outside);
        }
        let mut summands = vec![self.plain_sum(&rest)];
        for (outer, inner) in &parts {
            let outer = self.factored_within(outer, nesting - 1);
            let inner = self.factored_within(inner, nesting - 1);
            summands.push(self.graph.mul(outer, inner));
        }
        let sum = self.graph.sum(&summands);
        let common = self.monomial_expression(common, &Rational::ONE);
        self.graph.mul(sum, common)
    }
}

/// The leading coefficient, and the polynomial divided by it.
fn monic(polynomial: Cow<'_, Polynomial>) -> (Rational, Cow<'_, Polynomial>) {
    match polynomial.leading().map(|(_, coefficient)| coefficient.clone()) {
        Some(leading) if !leading.is_one() => match leading.recip() {
            Some(inverse) => (leading, Cow::Owned(polynomial.scaled(&inverse))),
            None => (Rational::ONE, polynomial),
        },
        _ => (Rational::ONE, polynomial),
    }
}

fn is_denominator(factor: &Factor) -> bool {
    factor.kind == Kind::Sum && factor.exponent.is_negative()
}

fn has_fractions(polynomial: &Polynomial) -> bool {
    polynomial.0.keys().any(|monomial| monomial.0.iter().any(is_denominator))
}

/// Takes out what stands in every term with an exponent of one sign.
fn without_common_factor(polynomial: &Polynomial) -> (Monomial, Cow<'_, Polynomial>) {
    if polynomial.len() < 2 {
        return (Monomial::default(), Cow::Borrowed(polynomial));
    }
    let mut monomials = polynomial.0.keys();
    let mut common = monomials.next().cloned().unwrap_or_default();
    for monomial in monomials {
        for factor in common.0.iter_mut() {
            let other = monomial.exponent(factor.atom);
            factor.exponent = nearer_to_zero(factor.exponent, other);
        }
        common.0.retain(|factor| !factor.exponent.is_zero());
        if common.is_unit() {
            return (common, Cow::Borrowed(polynomial));
        }
    }
    match polynomial.shifted(&common.inverse()) {
        Some(rest) => (common, Cow::Owned(rest)),
        None => (Monomial::default(), Cow::Borrowed(polynomial)),
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
    if polynomial.len() < 2 {
        return None;
    }
    // how many terms an atom stands in, above the fraction bar and below, and the factor of the first of them
    let mut atoms: IdMap<ExprId, [(usize, Factor); 2]> = IdMap::default();
    for (monomial, _) in polynomial.0.iter() {
        let factors: &[Factor] = &monomial.0;
        let mut place = 0;
        while place < factors.len() {
            let factor = factors[place];
            let (terms, first) =
                &mut atoms.entry(factor.atom, [(0, factor); 2])[usize::from(factor.exponent.is_negative())];
            if *terms == 0 {
                *first = factor;
            }
            *terms += 1;
            place += 1;
        }
    }
    let mut best: Option<(usize, Factor)> = None;
    for (atom, counted) in atoms.iter() {
        for (below, (terms, factor)) in counted.iter().enumerate() {
            let count = (1 + below) * terms;
            // of equally frequent ones the first atom, above the fraction bar
            let is_more =
                |(most, other): (usize, Factor)| count > most || (count == most && *atom < other.atom);
            if *terms > 1 && best.is_none_or(is_more) {
                best = Some((count, *factor));
            }
        }
    }
    best.map(|(_, factor)| factor)
}
