//! Powers of what has been read: integer ones multiplied out, roots of numbers by their prime factors,
//! those of sums as atoms.

use super::monomial::{Exponent, Kind, Monomial};
use super::polynomial::Polynomial;
use super::reader::{Reader, plain};
use crate::algebra::graph::Graph;
use crate::algebra::node::Node;
use crate::algebra::number::Rational;
use crate::algebra::range::Facts;
use crate::id::ExprId;
use std::borrow::Cow;
use std::rc::Rc;

/// Denominators that a new denominator is divided by, to find common factors.
const FACTORS_TRIED: usize = 8;

impl Reader<'_> {
    /// A power of what has been read.
    pub(super) fn power<'p>(
        &mut self,
        base: &'p Polynomial,
        exponent: Exponent,
    ) -> Option<Cow<'p, Polynomial>> {
        if base.is_zero() {
            // a division by zero is left to the checks
            return (!exponent.is_negative()).then(Cow::default);
        }
        if let Some((monomial, coefficient)) = base.single() {
            if exponent == Exponent::ONE && self.has_settled(monomial) {
                self.spend(1)?;
                return Some(Cow::Borrowed(base));
            }
            return self.power_of_monomial(monomial, coefficient, exponent).map(Cow::Owned);
        }
        match exponent.integer() {
            Some(1) if self.expands() => Some(Cow::Borrowed(base)),
            Some(times @ 2..) if self.expands() => {
                let mut product = self.multiply(base, base)?;
                for _ in 2..times {
                    product = self.multiply(&product, base)?;
                }
                Some(Cow::Owned(product))
            }
            _ => self.power_of_sum(base, exponent).map(Cow::Owned),
        }
    }

    /// A power of an expression and what it has been read as. A radicand stays as it stands if it is no sum of squares
    /// when it is multiplied out: rounding errors would make it negative where (a − b)² vanishes. Equal radicands become
    /// the one of them that was met first.
    pub(super) fn power_of<'p>(
        &mut self,
        (base, meaning): (ExprId, &'p Polynomial),
        exponent: Exponent,
    ) -> Option<Cow<'p, Polynomial>> {
        if exponent.is_integer() || meaning.len() < 2 {
            return self.power(meaning, exponent);
        }
        let tidy = self.tidy(meaning)?;
        let content = tidy.content();
        let primitive = tidy.scaled(&content.recip()?);
        let multiplied_out = self.plain_sum(&primitive);
        if !self.graph.kept_radicands.contains_key(&multiplied_out) {
            if !self.graph.is_better_kept(base, multiplied_out) {
                return self.power(meaning, exponent);
            }
            self.graph.kept_radicands.insert(multiplied_out, (base, content.clone()));
        }
        let (kept, its_content) = self.graph.kept_radicands.get(&multiplied_out)?.clone();
        let outside = self.power_of_number(&(content * its_content.recip()?), exponent)?;
        self.composites.insert(kept, Rc::new(primitive.scaled(&its_content)));
        let inside = Polynomial::term(Monomial::of(kept, Kind::Sum, exponent), Rational::ONE);
        self.multiply(&outside, &inside).map(Cow::Owned)
    }

    fn power_of_monomial(
        &mut self,
        monomial: &Monomial,
        coefficient: &Rational,
        exponent: Exponent,
    ) -> Option<Polynomial> {
        if let Some(times) = exponent.integer() {
            let (number, monomial) = (coefficient.pow(times.into())?, monomial.power(exponent)?);
            self.spend(1)?;
            if self.has_settled(&monomial) {
                return Some(Polynomial::term(monomial, number));
            }
            return self.open(&monomial, number);
        }
        if monomial.is_unit() {
            return self.power_of_number(coefficient, exponent);
        }
        // the identities of construction say which roots may be taken
        let inside = self.monomial_expression(monomial, coefficient);
        let value = self.graph.pow(inside, exponent.to_rational());
        let Node::Product { coefficient, factors } = self.graph.node(value).clone() else {
            return self.read_value(value);
        };
        let mut product = Polynomial::constant(coefficient);
        for (base, exponent) in factors.iter() {
            let exponent = Exponent::of(exponent)?;
            let power = match self.graph.node(*base).clone() {
                Node::Number(value) => self.power_of_number(&value, exponent)?,
                Node::Product { .. } => {
                    let meaning = self.read(*base)?;
                    self.composites.insert(*base, meaning);
                    Polynomial::term(Monomial::of(*base, Kind::Product, exponent), Rational::ONE)
                }
                Node::Sum { .. } => {
                    let meaning = self.read(*base)?;
                    self.power_of_sum(&meaning, exponent)?
                }
                _ => Polynomial::term(Monomial::of(*base, Kind::Plain, exponent), Rational::ONE),
            };
            product = self.multiply(&product, &power)?;
        }
        Some(product)
    }

    /// A root of a positive number, as roots of its prime factors.
    fn power_of_number(&mut self, value: &Rational, exponent: Exponent) -> Option<Polynomial> {
        if let Some(times) = exponent.integer() {
            return value.pow(times.into()).map(Polynomial::constant);
        }
        let Some((numerator, denominator)) = value.to_small().filter(|(n, _)| *n > 0) else {
            let base = self.graph.number(value.clone());
            let root = self.graph.pow(base, exponent.to_rational());
            return Some(plain(root));
        };
        let mut product = Polynomial::one();
        for (number, sign) in [(numerator, 1), (denominator, -1)] {
            for (prime, times) in prime_powers(number) {
                let atom = self.graph.number(prime);
                let exponent = exponent.times(Exponent::whole(times * sign))?;
                let factor = Polynomial::term(Monomial::of(atom, Kind::Number, exponent), Rational::ONE);
                product = self.multiply(&product, &factor)?;
            }
        }
        Some(product)
    }

    /// A power of a sum as a power of its primitive part, which becomes an atom.
    fn power_of_sum(&mut self, base: &Polynomial, exponent: Exponent) -> Option<Polynomial> {
        let base = self.tidy(base)?;
        if base.len() < 2 {
            return self.power(&base, exponent).map(Cow::into_owned);
        }
        if !exponent.is_integer() {
            let content = base.content();
            let outside = self.power_of_number(&content, exponent)?;
            let atom = self.atom_of_sum(base.scaled(&content.recip()?));
            let inside = Polynomial::term(Monomial::of(atom, Kind::Sum, exponent), Rational::ONE);
            return self.multiply(&outside, &inside);
        }
        let common = base.meet();
        let inverse = Polynomial::term(common.inverse(), Rational::ONE);
        let numerator = self.multiply(&base, &inverse)?;
        let numerator = self.reduce(&numerator)?;
        let (_, leading) = numerator.leading()?;
        let content = if leading.is_negative() { -numerator.content() } else { numerator.content() };
        let mut product = self.power_of_monomial(&common, &content, exponent)?;
        let mut rest = numerator.scaled(&content.recip()?);
        let known: Vec<_> =
            self.composites.iter().take(FACTORS_TRIED).map(|(a, p)| (*a, p.clone())).collect();
        for (atom, meaning) in known {
            while rest.len() > 1 && meaning.len() > 1 && meaning.len() <= rest.len() {
                let Some(quotient) = self.quotient(&rest, &meaning) else { break };
                let factor = Polynomial::term(Monomial::of(atom, Kind::Sum, exponent), Rational::ONE);
                product = self.multiply(&product, &factor)?;
                rest = quotient;
            }
        }
        let last = if let Some((monomial, coefficient)) = rest.single() {
            self.power_of_monomial(monomial, coefficient, exponent)?
        } else {
            let atom = self.atom_of_sum(rest);
            Polynomial::term(Monomial::of(atom, Kind::Sum, exponent), Rational::ONE)
        };
        self.multiply(&product, &last)
    }
}

impl Graph {
    /// Whether a radicand shows that it is not negative, or is a product of sums, and what it is when it is multiplied out
    /// does not show it.
    pub(super) fn is_better_kept(&self, radicand: ExprId, multiplied_out: ExprId) -> bool {
        let shows = |e: ExprId| self.range(e, &Facts::default()).is_not_negative();
        if radicand == multiplied_out || shows(multiplied_out) {
            return false;
        }
        let is_product = |id: ExprId| match self.node(id) {
            Node::Product { factors, .. } => {
                let sums = factors.iter().filter(|(base, _)| matches!(self.node(*base), Node::Sum { .. }));
                sums.map(|(_, exponent)| if *exponent == Rational::ONE { 1 } else { 2 }).sum::<u32>() > 1
            }
            _ => false,
        };
        shows(radicand) || self.reachable(&[radicand]).into_iter().any(is_product)
    }
}

/// Prime factors with exponents; a cofactor without small factors counts as prime.
fn prime_powers(mut number: i64) -> Vec<(i64, i16)> {
    const TRIED: i64 = 1000;
    let mut powers = Vec::new();
    let mut divisor = 2;
    while divisor < TRIED && divisor * divisor <= number {
        let mut times = 0;
        while number % divisor == 0 {
            number /= divisor;
            times += 1;
        }
        if times > 0 {
            powers.push((divisor, times));
        }
        divisor += 1;
    }
    if number > 1 {
        powers.push((number, 1));
    }
    powers
}
