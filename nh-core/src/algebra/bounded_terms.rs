//! Inequalities with functions of bounded values, as inequalities without these: a sin x + b cos y = c says
//! c ≤ a + b for positive a and b, and a sin x + b cos x = c says c² ≤ a² + b².
//!
//! What stands beside functions and even powers may be any polynomial of which the sign is known, from intervals or as
//! a demand. Two equations with r cos u and r sin u are also asked in the directions cos u and sin u: the closure of a
//! linkage says that no bar is longer than the others together.

use super::combination::negative;
use super::graph::Graph;
use super::inequalities::{Demand, Known};
use super::interval::Interval;
use super::node::{Function, Node};
use super::number::Rational;
use super::polynomial_terms::{Monomial, Terms, multiplied, product_of, sum_of};
use crate::id::ExprId;
use std::collections::BTreeMap;

/// What is known where demands are bounded.
pub(super) struct Bounding<'a> {
    pub(super) graph: &'a Graph,
    pub(super) known: &'a Known,
    /// Polynomials with what is demanded of them.
    pub(super) demands: &'a [(&'a Terms, Demand)],
}

/// A polynomial that is nowhere smaller than another one, and whether it is larger everywhere.
struct Above {
    polynomial: Terms,
    strictly: bool,
    /// The square of an amplitude without a known sign, which is to be added.
    squared_amplitude: Option<Terms>,
}

/// Pairs of equations that are turned.
const PAIRS: usize = 6;

impl Bounding<'_> {
    /// What demands say of that which is bounded by nothing: each with the demand that it comes from.
    pub(super) fn consequences(&self) -> Vec<(usize, Terms, Demand)> {
        let mut found = Vec::new();
        for (index, (polynomial, demand)) in self.demands.iter().enumerate() {
            self.add_consequences(index, polynomial, *demand, &mut found);
        }
        for (index, equation) in self.turned() {
            self.add_consequences(index, &equation, Demand::Zero, &mut found);
        }
        found
    }

    fn add_consequences(
        &self,
        index: usize,
        polynomial: &Terms,
        demand: Demand,
        found: &mut Vec<(usize, Terms, Demand)>,
    ) {
        let signs: &[bool] = match demand {
            Demand::Positive | Demand::NotNegative => &[true],
            Demand::Zero => &[true, false],
            Demand::Nonzero => &[],
        };
        for even_powers in [false, true] {
            for is_as_written in signs {
                let one = if *is_as_written { polynomial.clone() } else { negative(polynomial) };
                let Some(above) = self.above(&one, even_powers) else { continue };
                if above.polynomial == one {
                    continue;
                }
                match above.squared_amplitude {
                    None => {
                        let is_strict = above.strictly || demand == Demand::Positive;
                        let demand = if is_strict { Demand::Positive } else { Demand::NotNegative };
                        found.push((index, above.polynomial, demand));
                    }
                    // 0 ≤ rest + r with rest ≤ 0, or 0 = rest + r cos(u − u₀): rest² ≤ r²
                    Some(square) => {
                        let rest = &above.polynomial;
                        let is_equation = demand == Demand::Zero && !above.strictly && *is_as_written;
                        let is_below = self.sign(&negative(rest)).is_not_negative();
                        if let Some(squared) = multiplied(rest, rest)
                            && (is_below || (is_equation && self.is_rest_of_equation(&one, rest)))
                        {
                            found.push((index, sum_of(&square, &negative(&squared)), Demand::NotNegative));
                        }
                    }
                }
            }
        }
    }

    /// Whether nothing but one sine was taken out of an equation.
    fn is_rest_of_equation(&self, whole: &Terms, rest: &Terms) -> bool {
        let (mut amplitudes, others) = self.graph.amplitudes(whole);
        let (_, mean) = amplitudes.remove(&Terms::new()).unwrap_or_default();
        amplitudes.len() == 1 && sum_of(&others, &mean) == *rest
    }

    /// A polynomial without sines and cosines, and without other functions where these are bounded, that is nowhere
    /// smaller; `None` where two amplitudes have no known sign.
    fn above(&self, polynomial: &Terms, even_powers: bool) -> Option<Above> {
        let (amplitudes, mut others) = self.graph.amplitudes(polynomial);
        let mut squared_amplitude = None;
        for (angle, (sine, cosine)) in amplitudes {
            if angle.is_empty() {
                others = sum_of(&others, &cosine);
                continue;
            }
            if let Some(amplitude) = self.amplitude(&sine, &cosine) {
                others = sum_of(&others, &amplitude);
                continue;
            }
            let square = sum_of(&multiplied(&sine, &sine)?, &multiplied(&cosine, &cosine)?);
            if squared_amplitude.replace(square).is_some() {
                return None;
            }
        }
        let mut factors: BTreeMap<Monomial, Terms> = BTreeMap::new();
        for (monomial, coefficient) in others {
            let (bounded, beside) =
                monomial.into_iter().partition(|factor| self.is_bounded(factor, even_powers));
            factors.entry(bounded).or_default().insert(beside, coefficient);
        }
        let mut above = Above { polynomial: Terms::new(), strictly: false, squared_amplitude };
        for (bounded, beside) in &factors {
            let (term, strictly) = self.largest(bounded, beside);
            above.polynomial = sum_of(&above.polynomial, &term);
            above.strictly |= strictly;
        }
        Some(above)
    }

    /// |s| or |c| for s sin u + c cos u where the other is 0 and the sign of this one is known.
    fn amplitude(&self, sine: &Terms, cosine: &Terms) -> Option<Terms> {
        let lone = match (sine.is_empty(), cosine.is_empty()) {
            (true, _) => cosine,
            (_, true) => sine,
            _ => return None,
        };
        let sign = self.sign(lone);
        if sign.is_not_negative() {
            return Some(lone.clone());
        }
        sign.scaled(&Rational::MINUS_ONE).is_not_negative().then(|| negative(lone))
    }

    /// Whether a factor may have a largest or a smallest value.
    fn is_bounded(&self, (part, exponent): &(ExprId, Rational), even_powers: bool) -> bool {
        let is_even = exponent.is_integer() && !exponent.has_odd_numerator();
        matches!(self.graph.node(*part), Node::Apply(..)) || (even_powers && is_even)
    }

    /// A product where what is bounded has its largest value, if what stands beside it has a known sign; whether it is
    /// less everywhere.
    fn largest(&self, bounded: &Monomial, beside: &Terms) -> (Terms, bool) {
        let sign = self.sign(beside);
        let is_positive = sign.is_not_negative();
        let end =
            if bounded.is_empty() || !(is_positive || sign.scaled(&Rational::MINUS_ONE).is_not_negative()) {
                None
            } else if is_positive {
                self.range_of(bounded).highest()
            } else {
                self.range_of(bounded).lowest()
            };
        match end {
            None => (times(beside, bounded, &Rational::ONE), false),
            Some((value, is_open)) => (times(beside, &Monomial::new(), &value), is_open && sign.is_nonzero()),
        }
    }

    fn range_of(&self, monomial: &Monomial) -> Interval {
        let one = Interval::point(&Rational::ONE);
        monomial.iter().fold(one, |product, (part, exponent)| {
            let part = self.known.get(part).unwrap_or(&Interval::ALL);
            product.times(&part.power(exponent))
        })
    }

    /// The values that a polynomial may have: by intervals, or as it is demanded.
    fn sign(&self, polynomial: &Terms) -> Interval {
        let mut range = Interval::point(&Rational::ZERO);
        for (monomial, coefficient) in polynomial {
            range = range.plus(&self.range_of(monomial).scaled(coefficient));
        }
        for (other, demand) in self.demands {
            if let Some(factor) = multiple(polynomial, other) {
                range = range.meet(&demand.interval().scaled(&factor));
            }
        }
        range
    }

    /// For equations r cos u + … = 0 and r sin u + … = 0 their sum in the direction of u.
    fn turned(&self) -> Vec<(usize, Terms)> {
        let equations: Vec<(usize, &Terms)> = self
            .demands
            .iter()
            .enumerate()
            .filter(|(_, (_, demand))| *demand == Demand::Zero)
            .map(|(index, (polynomial, _))| (index, *polynomial))
            .collect();
        let mut found = Vec::new();
        for (place, (later, second)) in equations.iter().enumerate().take(PAIRS) {
            for (_, first) in &equations[..place] {
                for (one, other) in [(first, second), (second, first)] {
                    for (cosine, sine, factor) in self.turning(one, other) {
                        let along_cosine = times(one, &vec![(cosine, Rational::ONE)], &Rational::ONE);
                        let along_sine = times(other, &vec![(sine, Rational::ONE)], &factor);
                        found.push((*later, sum_of(&along_cosine, &along_sine)));
                    }
                }
            }
        }
        found
    }

    /// The angles u for which r cos u is a term of one equation and ± r sin u one of another: cos u, sin u and the sign.
    fn turning(&self, one: &Terms, other: &Terms) -> Vec<(ExprId, ExprId, Rational)> {
        let mut found: Vec<(ExprId, ExprId, Rational)> = Vec::new();
        for (monomial, coefficient) in one {
            for (part, exponent) in monomial {
                let Node::Apply(Function::Cos, x) = self.graph.node(*part) else { continue };
                let Some(sine) = self.graph.known_application(Function::Sin, *x) else { continue };
                if !exponent.is_one() || found.iter().any(|(known, ..)| known == part) {
                    continue;
                }
                let beside = product_of(monomial, &vec![(*part, Rational::MINUS_ONE), (sine, Rational::ONE)]);
                let factor = other.get(&beside).and_then(|sine| Some(coefficient.clone() * sine.recip()?));
                if let Some(factor) = factor.filter(|factor| factor.abs().is_one()) {
                    found.push((*part, sine, factor));
                }
            }
        }
        found
    }
}

/// A polynomial times a monomial and a number.
fn times(polynomial: &Terms, monomial: &Monomial, number: &Rational) -> Terms {
    if number.is_zero() {
        return Terms::new();
    }
    let product = |(own, c): (&Monomial, &Rational)| (product_of(own, monomial), c.clone() * number.clone());
    polynomial.iter().map(product).collect()
}

/// The number that a polynomial is of another one.
fn multiple(polynomial: &Terms, other: &Terms) -> Option<Rational> {
    let (monomial, coefficient) = polynomial.iter().next()?;
    let factor = coefficient.clone() * other.get(monomial)?.recip()?;
    let is_multiple = polynomial.len() == other.len()
        && polynomial
            .iter()
            .all(|(monomial, c)| other.get(monomial).is_some_and(|d| d.clone() * factor.clone() == *c));
    is_multiple.then_some(factor)
}
