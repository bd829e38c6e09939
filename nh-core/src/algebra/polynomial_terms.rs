//! Expressions as polynomials in whatever they are made of, for questions about their sign.

use super::graph::Graph;
use super::node::Node;
use super::number::Rational;
use crate::id::ExprId;
use std::collections::{BTreeMap, BTreeSet};

/// A product of powers of parts of an expression that are not sums; empty for the number 1.
pub(super) type Monomial = Vec<(ExprId, Rational)>;

/// `Σ coefficient · monomial`.
pub(super) type Terms = BTreeMap<Monomial, Rational>;

/// Terms that a polynomial may have.
const MOST: usize = 200;
/// Powers of sums that are multiplied out.
const HIGHEST: i64 = 4;

impl Graph {
    /// The expression multiplied out, if it does not become long.
    pub(super) fn polynomial_terms(&self, expression: ExprId) -> Option<Terms> {
        if let Some(value) = self.value_of(expression) {
            return Some(number(value.clone()));
        }
        match self.node(expression) {
            Node::Sum { constant, terms } => {
                let mut sum = number(constant.clone());
                for (term, coefficient) in terms.iter() {
                    for (monomial, factor) in self.polynomial_terms(*term)? {
                        add(&mut sum, monomial, factor * coefficient.clone());
                    }
                }
                (sum.len() <= MOST).then_some(sum)
            }
            Node::Product { coefficient, factors } => {
                let mut product = number(coefficient.clone());
                for (base, exponent) in factors.iter() {
                    let times = exponent.to_i64().filter(|n| (1..=HIGHEST).contains(n));
                    let is_sum = matches!(self.node(*base), Node::Sum { .. });
                    let (factor, times) = match times.filter(|_| is_sum || self.value_of(*base).is_some()) {
                        Some(times) => (self.polynomial_terms(*base)?, times),
                        None => (Terms::from([(vec![(*base, exponent.clone())], Rational::ONE)]), 1),
                    };
                    for _ in 0..times {
                        product = multiplied(&product, &factor)?;
                    }
                }
                Some(product)
            }
            _ => Some(Terms::from([(vec![(expression, Rational::ONE)], Rational::ONE)])),
        }
    }
}

fn number(value: Rational) -> Terms {
    if value.is_zero() { Terms::new() } else { Terms::from([(Monomial::new(), value)]) }
}

fn add(terms: &mut Terms, monomial: Monomial, coefficient: Rational) {
    let known = terms.remove(&monomial).unwrap_or(Rational::ZERO);
    let sum = known + coefficient;
    if !sum.is_zero() {
        terms.insert(monomial, sum);
    }
}

pub(super) fn multiplied(a: &Terms, b: &Terms) -> Option<Terms> {
    if a.len() * b.len() > MOST {
        return None;
    }
    let mut product = Terms::new();
    for (x, c) in a {
        for (y, d) in b {
            add(&mut product, product_of(x, y), c.clone() * d.clone());
        }
    }
    Some(product)
}

/// The sum of two polynomials.
pub(super) fn sum_of(a: &Terms, b: &Terms) -> Terms {
    let mut sum = a.clone();
    for (monomial, coefficient) in b {
        add(&mut sum, monomial.clone(), coefficient.clone());
    }
    sum
}

/// The product of two monomials.
pub(super) fn product_of(a: &Monomial, b: &Monomial) -> Monomial {
    let mut powers: BTreeMap<ExprId, Rational> = a.iter().cloned().collect();
    for (base, exponent) in b {
        let entry = powers.entry(*base).or_insert(Rational::ZERO);
        *entry = entry.clone() + exponent.clone();
    }
    powers.into_iter().filter(|(_, exponent)| !exponent.is_zero()).collect()
}

/// The least value of a quadratic polynomial over all real numbers for its variables, by completing
/// squares; `None` if it has none, or is not quadratic.
pub(super) fn least_value(terms: &Terms) -> Option<Rational> {
    let mut terms = terms.clone();
    loop {
        let variable = terms.keys().flatten().map(|(base, _)| *base).next();
        let Some(variable) = variable else {
            return Some(terms.remove(&Monomial::new()).unwrap_or(Rational::ZERO));
        };
        let Completed { coefficient, rest, .. } = completed(&terms, variable)?;
        let degree = |monomial: &Monomial| {
            monomial.iter().try_fold(0, |sum, (_, e)| Some(sum + e.to_i64().filter(|e| *e > 0)?))
        };
        if coefficient.is_negative() || terms.keys().any(|m| degree(m).is_none_or(|degree| degree > 2)) {
            return None;
        }
        terms = rest;
    }
}

/// The squares that are met where a polynomial is completed to squares, one variable after the other, as far as this
/// goes.
pub(super) fn squares_inside(terms: &Terms) -> Vec<Terms> {
    let mut terms = terms.clone();
    let mut found = Vec::new();
    loop {
        let variables: BTreeSet<ExprId> = terms.keys().flatten().map(|(base, _)| *base).collect();
        let Some(next) = variables.into_iter().find_map(|variable| completed(&terms, variable)) else {
            return found;
        };
        found.extend(multiplied(&next.root, &next.root));
        terms = next.rest;
    }
}

/// a x² + b x + c as (root² / a) / 4 + rest, with root = 2 a x + b.
struct Completed {
    coefficient: Rational,
    root: Terms,
    rest: Terms,
}

/// A polynomial of second degree in a variable whose square has a number as coefficient.
fn completed(terms: &Terms, variable: ExprId) -> Option<Completed> {
    let mut terms = terms.clone();
    let coefficient = terms.remove(&vec![(variable, Rational::from(2))])?;
    let (mut root, mut rest) = (Terms::new(), Terms::new());
    for (monomial, factor) in terms {
        match monomial.iter().position(|(base, _)| *base == variable) {
            Some(place) if monomial[place].1.is_one() => {
                let mut other = monomial;
                other.remove(place);
                add(&mut root, other, factor);
            }
            Some(_) => return None,
            None => add(&mut rest, monomial, factor),
        }
    }
    let scale = (coefficient.clone() * Rational::from(-4)).recip()?;
    for (monomial, factor) in multiplied(&root, &root)? {
        add(&mut rest, monomial, factor * scale.clone());
    }
    add(&mut root, vec![(variable, Rational::ONE)], coefficient.clone() * Rational::from(2));
    Some(Completed { coefficient, root, rest })
}
