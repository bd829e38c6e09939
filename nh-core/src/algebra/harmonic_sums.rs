//! The range of a sum of sines and cosines: products are written as sums, and a sin u + b cos u is at most √(a² + b²).

use super::combination::negative;
use super::graph::Graph;
use super::interval::Interval;
use super::node::{Function, Node};
use super::number::Rational;
use super::polynomial_terms::{Monomial, Terms, sum_of};
use crate::id::ExprId;
use std::collections::BTreeMap;

/// a sin u + b cos u for each angle u, a polynomial.
type Harmonics = BTreeMap<Terms, (Rational, Rational)>;

/// The same where a and b are polynomials.
pub(super) type Amplitudes = BTreeMap<Terms, (Terms, Terms)>;

/// Sines and cosines in one product; more are left as they are.
const FACTORS: usize = 6;

impl Graph {
    /// Of the terms of a polynomial, the range of those that are products of sines and cosines together, and the others.
    pub(super) fn without_harmonics(&self, polynomial: &Terms) -> Option<(Interval, Terms)> {
        let (mut harmonics, mut others) = (Harmonics::new(), Terms::new());
        for (monomial, coefficient) in polynomial {
            match self.harmonics_of(monomial) {
                Some(list) => {
                    for (angle, (sine, cosine)) in list {
                        add(
                            &mut harmonics,
                            angle,
                            (sine * coefficient.clone(), cosine * coefficient.clone()),
                        );
                    }
                }
                None => _ = others.insert(monomial.clone(), coefficient.clone()),
            }
        }
        if harmonics.is_empty() {
            return None;
        }
        let mut range = Interval::point(&Rational::ZERO);
        for (angle, (sine, cosine)) in harmonics {
            let own = if angle.is_empty() {
                Interval::point(&cosine)
            } else {
                Interval::amplitude(&(sine.clone() * sine + cosine.clone() * cosine))
            };
            range = range.plus(&own);
        }
        Some((range, others))
    }

    /// A polynomial as a sum of sines and cosines with coefficients that are polynomials in whatever else there is, and
    /// the terms without sines and cosines.
    pub(super) fn amplitudes(&self, polynomial: &Terms) -> (Amplitudes, Terms) {
        let (mut amplitudes, mut others) = (Amplitudes::new(), Terms::new());
        for (monomial, coefficient) in polynomial {
            let (circular, beside): (Monomial, Monomial) =
                monomial.iter().cloned().partition(|(part, exponent)| {
                    let function = self.node(*part);
                    !exponent.is_negative()
                        && matches!(function, Node::Apply(Function::Sin | Function::Cos, _))
                });
            let Some(harmonics) = self.harmonics_of(&circular) else {
                others.insert(monomial.clone(), coefficient.clone());
                continue;
            };
            for (angle, (sine, cosine)) in harmonics {
                let entry = amplitudes.entry(angle).or_default();
                let times = |sum: &Terms, number: Rational| {
                    let term = number * coefficient.clone();
                    if term.is_zero() {
                        sum.clone()
                    } else {
                        sum_of(sum, &Terms::from([(beside.clone(), term)]))
                    }
                };
                *entry = (times(&entry.0, sine), times(&entry.1, cosine));
            }
        }
        amplitudes.retain(|_, (sine, cosine)| !(sine.is_empty() && cosine.is_empty()));
        (amplitudes, others)
    }

    /// A product of sines and cosines as a sum of them.
    fn harmonics_of(&self, monomial: &Monomial) -> Option<Harmonics> {
        let mut factors: Vec<(Function, ExprId)> = Vec::new();
        for (base, exponent) in monomial {
            let times = exponent.to_i64().filter(|n| (1..=6).contains(n))?;
            let Node::Apply(function @ (Function::Sin | Function::Cos), x) = self.node(*base) else {
                return None;
            };
            factors.extend((0..times).map(|_| (*function, *x)));
        }
        if factors.is_empty() || factors.len() > FACTORS {
            return None;
        }
        let mut sum = Harmonics::from([(Terms::new(), (Rational::ZERO, Rational::ONE))]);
        for (function, x) in factors {
            sum = times_harmonic(&sum, function, &self.polynomial_terms(x)?);
        }
        Some(sum)
    }
}

/// Adds to the coefficients of an angle, up to the sign of which sines change theirs.
fn add(harmonics: &mut Harmonics, angle: Terms, (sine, cosine): (Rational, Rational)) {
    let is_negative = angle.values().next().is_some_and(Rational::is_negative);
    let (angle, sine) = if is_negative { (negative(&angle), -sine) } else { (angle, sine) };
    let entry = harmonics.entry(angle).or_insert((Rational::ZERO, Rational::ZERO));
    *entry = (entry.0.clone() + sine, entry.1.clone() + cosine);
}

/// 2 cos a cos b = cos(a − b) + cos(a + b), and its kin.
fn times_harmonic(sum: &Harmonics, function: Function, by: &Terms) -> Harmonics {
    let half = Rational::new(1, 2);
    let mut product = Harmonics::new();
    for (angle, (sine, cosine)) in sum {
        let (s, c) = (sine.clone() * half.clone(), cosine.clone() * half.clone());
        let (difference, total) =
            (combined(angle, by, &Rational::MINUS_ONE), combined(angle, by, &Rational::ONE));
        if function == Function::Cos {
            add(&mut product, difference, (s.clone(), c.clone()));
            add(&mut product, total, (s, c));
        } else {
            // 2 sin a sin b = cos(a − b) − cos(a + b), 2 cos a sin b = sin(a + b) − sin(a − b)
            add(&mut product, difference, (-c.clone(), s.clone()));
            add(&mut product, total, (c, -s));
        }
    }
    product
}

/// a ± b.
fn combined(a: &Terms, b: &Terms, sign: &Rational) -> Terms {
    let mut terms = a.clone();
    for (monomial, coefficient) in b {
        let entry = terms.entry(monomial.clone()).or_insert(Rational::ZERO);
        *entry = entry.clone() + sign.clone() * coefficient.clone();
    }
    terms.retain(|_, coefficient| !coefficient.is_zero());
    terms
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::Demand;

    /// Whether a sum of sines and cosines less a number is positive nowhere.
    #[test]
    fn amplitudes_bound_sums() {
        let mut g = Graph::new();
        let [x, y] = ["x", "y"].map(|name| {
            let symbol = g.new_symbol(name);
            g.symbol(symbol)
        });
        let (sx, cx, sy, cy) = (g.sin(x), g.cos(x), g.sin(y), g.cos(y));
        let twice = g.scale(2.into(), x);
        let double = g.cos(twice);
        let (three, four) = (g.scale(3.into(), sx), g.scale(4.into(), cx));
        let level = |numerator: i64, denominator: i64| Rational::new(numerator, denominator);
        let difference = g.formula(cx * cy + sx * sy);
        let squares = g.formula(sx.square() + cx.square() + cx.square());
        for (sum, least, most) in [
            (g.formula(sx + cx), level(14_143, 10_000), level(14_142, 10_000)),
            (g.formula(three + four), level(5, 1), level(49, 10)),
            (g.formula(sx * cx), level(1, 2), level(49, 100)),
            (difference, level(1, 1), level(99, 100)),
            (squares, level(2, 1), level(199, 100)),
            (g.formula(sx + cx + sy), level(2_415, 1000), level(24, 10)),
            (g.formula(sx * sx * sx), level(1, 1), level(99, 100)),
            (g.formula(double + sx), level(2, 1), level(9, 8)),
        ] {
            for (bound, is_contradictory) in [(least, true), (most, false)] {
                let bound = g.number(bound);
                let above = g.formula(sum - bound);
                let found = g.contradiction(&[(above, Demand::Positive)]).is_some();
                assert_eq!(found, is_contradictory, "{}", g.text(above));
            }
        }
    }
}
