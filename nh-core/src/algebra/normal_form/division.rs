//! Denominators: exact division of numerators, and common denominators where they help.

use super::monomial::{Exponent, Factor, Kind, Monomial};
use super::polynomial::Polynomial;
use super::reader::Reader;
use crate::algebra::node::{Function, Node};
use crate::algebra::number::Rational;
use crate::id::ExprId;
use std::collections::BTreeMap;

/// Sums of more fractions than this are not brought over a common denominator.
const FRACTIONS: usize = 6;

/// What an attempt within the budget has come to.
enum Step {
    To(Polynomial),
    Nothing,
}

/// Numerators by denominator, the latter as a monomial with negative exponents.
type Fractions = BTreeMap<Monomial, Polynomial>;

impl Reader<'_> {
    /// The quotient, if the division of polynomials leaves no remainder.
    pub(super) fn quotient(&mut self, dividend: &Polynomial, divisor: &Polynomial) -> Option<Polynomial> {
        let (leading, coefficient) = divisor.leading()?;
        let inverse = coefficient.recip()?;
        if !spans_fit(dividend, divisor) {
            return None;
        }
        // the exponents of the quotient lie in a box, which ends the division if it is not exact
        let lowest = dividend.meet().over(&divisor.meet())?;
        let highest = dividend.join().over(&divisor.join())?;
        let (mut rest, mut quotient) = (dividend.clone(), Polynomial::default());
        while let Some((monomial, coefficient)) = rest.leading() {
            let monomial = monomial.over(leading)?;
            let coefficient = coefficient.clone() * inverse.clone();
            if lowest.meet(&monomial) != lowest || monomial.meet(&highest) != monomial {
                return None;
            }
            self.spend(divisor.len())?;
            rest.add_scaled(&divisor.shifted(&monomial)?, &-coefficient.clone());
            quotient.add_term(monomial, coefficient);
        }
        Some(quotient)
    }

    /// Whether something is divided by a sum, a sine or a cosine.
    pub(super) fn has_denominator(&self, polynomial: &Polynomial) -> bool {
        let is_denominator = |factor: &Factor| {
            factor.exponent.is_negative()
                && (matches!(factor.kind, Kind::Sum) || self.is_trigonometric_denominator(factor))
        };
        polynomial.0.keys().any(|monomial| monomial.has(is_denominator))
    }

    /// Removes the denominators that divide their numerators.
    pub(super) fn cancel(&mut self, polynomial: Polynomial) -> Option<Polynomial> {
        let mut current = polynomial;
        loop {
            if !self.has_denominator(&current) {
                return Some(current);
            }
            let fractions = self.fractions(&current, false);
            if let Step::To(next) = self.divided(&fractions)? {
                current = self.reduce(&next)?;
                continue;
            }
            match self.joined(&current)? {
                Step::To(next) => current = next,
                Step::Nothing => return Some(current),
            }
        }
    }

    fn is_trigonometric_denominator(&self, factor: &Factor) -> bool {
        use Function::{Cos, Cosh, Sin, Sinh};
        factor.exponent.is_negative()
            && matches!(self.graph.node(factor.atom), Node::Apply(Sin | Cos | Sinh | Cosh, _))
    }

    /// The terms by their denominators: sums, and on request sines and cosines.
    fn fractions(&self, polynomial: &Polynomial, trigonometric: bool) -> Fractions {
        let mut fractions = Fractions::new();
        for (monomial, coefficient) in polynomial.0.iter() {
            let (below, above) = monomial.split(|factor| {
                (factor.kind == Kind::Sum && factor.exponent.is_negative())
                    || (trigonometric && self.is_trigonometric_denominator(factor))
            });
            fractions.entry(below).or_default().add_term(above, coefficient.clone());
        }
        fractions
    }

    fn together(&mut self, fractions: &Fractions) -> Option<Polynomial> {
        let mut sum = Polynomial::default();
        for (below, above) in fractions {
            let factor = Polynomial::term(below.clone(), Rational::ONE);
            let fraction = self.multiply(above, &factor)?;
            sum.add(fraction);
        }
        Some(sum)
    }

    /// Divides one numerator by a sum in its denominator, or the other way round, if any can be.
    fn divided(&mut self, fractions: &Fractions) -> Option<Step> {
        for (below, above) in fractions {
            for factor in below.0.iter() {
                let meaning = self.meaning(factor.atom)?;
                let one = Monomial::of(factor.atom, factor.kind, Exponent::ONE);
                let raised = Polynomial::term(below.times(&one)?, Rational::ONE);
                let quotient = match self.quotient_of_either_form(above, &meaning)? {
                    Step::To(quotient) => quotient,
                    Step::Nothing if above.len() > 1 && above.len() <= meaning.len() => {
                        match self.quotient_of_either_form(&meaning, above)? {
                            Step::To(inverse) => self.power(&inverse, Exponent::whole(-1))?.into_owned(),
                            Step::Nothing => continue,
                        }
                    }
                    Step::Nothing => continue,
                };
                let mut others = fractions.clone();
                others.remove(below);
                let mut sum = self.together(&others)?;
                let fraction = self.multiply(&quotient, &raised)?;
                sum.add(fraction);
                return Some(Step::To(sum));
            }
        }
        Some(Step::Nothing)
    }

    /// The quotient with the squares of cosines or of sines eliminated, whichever is exact.
    fn quotient_of_either_form(&mut self, above: &Polynomial, below: &Polynomial) -> Option<Step> {
        if let Some(quotient) = self.quotient(above, below) {
            return Some(Step::To(quotient));
        }
        for cosine in [true, false] {
            let (n, d) = (self.reduced_to(above, cosine)?, self.reduced_to(below, cosine)?);
            if (n != *above || d != *below)
                && let Some(quotient) = self.quotient(&n, &d)
            {
                return Some(Step::To(quotient));
            }
        }
        self.spend(1)?;
        Some(Step::Nothing)
    }

    /// Adds fractions over their common denominator where that leaves fewer monomials. Every
    /// denominator of the sum was a denominator before.
    fn joined(&mut self, polynomial: &Polynomial) -> Option<Step> {
        let fractions = self.fractions(polynomial, true);
        if fractions.len() < 2 || fractions.len() > FRACTIONS {
            return Some(Step::Nothing);
        }
        let entries: Vec<_> = fractions.iter().collect();
        let mut subsets = vec![(0..entries.len()).collect::<Vec<_>>()];
        if entries.len() > 2 {
            for second in 1..entries.len() {
                subsets.extend((0..second).map(|first| vec![first, second]));
            }
        }
        for subset in subsets {
            let below = subset.iter().fold(Monomial::default(), |meet, i| meet.meet(entries[*i].0));
            let mut above = Polynomial::default();
            for index in &subset {
                let raised = self.cleared(entries[*index].1, &entries[*index].0.over(&below)?)?;
                above.add(raised);
            }
            let above = self.reduce(&above)?;
            let before: usize = subset.iter().map(|i| entries[*i].1.len()).sum();
            if above.len() < before {
                let mut rest = fractions.clone();
                rest.retain(|key, _| !subset.iter().any(|i| entries[*i].0 == key));
                let mut sum = self.together(&rest)?;
                let fraction = self.multiply(&above, &Polynomial::term(below, Rational::ONE))?;
                sum.add(fraction);
                return Some(Step::To(sum));
            }
        }
        Some(Step::Nothing)
    }

    /// A numerator times denominators, sums multiplied out.
    fn cleared(&mut self, above: &Polynomial, by: &Monomial) -> Option<Polynomial> {
        let mut product = above.clone();
        for factor in by.0.iter() {
            let power = match (factor.kind, factor.exponent.integer()) {
                (Kind::Sum, Some(times)) => {
                    let meaning = self.meaning(factor.atom)?;
                    let mut power = Polynomial::one();
                    for _ in 0..times {
                        power = self.multiply(&power, &meaning)?;
                    }
                    power
                }
                _ => Polynomial::term(Monomial::of(factor.atom, factor.kind, factor.exponent), Rational::ONE),
            };
            product = self.multiply(&product, &power)?;
        }
        Some(product)
    }
}

/// Whether the exponents of every atom range over as much in the dividend as in the divisor: those of factors add up.
fn spans_fit(dividend: &Polynomial, divisor: &Polynomial) -> bool {
    let mut asked: Vec<ExprId> = Vec::new();
    for factor in divisor.0.keys().flat_map(|monomial| monomial.0.iter()) {
        if asked.contains(&factor.atom) {
            continue;
        }
        asked.push(factor.atom);
        let (least, most) = divisor.span(factor.atom);
        if least == most {
            continue;
        }
        let (lowest, highest) = dividend.span(factor.atom);
        let is_narrow = |wide: Exponent, narrow: Exponent| wide.plus(least).zip(narrow.plus(most));
        // highest − lowest ≥ most − least
        if is_narrow(highest, lowest).is_some_and(|(wide, narrow)| wide < narrow) {
            return false;
        }
    }
    true
}
