//! Laurent polynomials over atoms: exact coefficients, rational exponents of either sign.

use super::terms::Terms;
use crate::algebra::number::Rational;
use crate::id::ExprId;
use num_integer::Integer;
use std::cmp::Ordering;

/// An exponent in lowest terms with a positive denominator.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Exponent {
    numerator: i32,
    denominator: i32,
}

impl Exponent {
    pub(super) const ZERO: Self = Self::whole(0);
    pub(super) const ONE: Self = Self::whole(1);

    pub(super) const fn whole(numerator: i32) -> Self {
        Self { numerator, denominator: 1 }
    }

    /// `None` beyond the range that a polynomial is worth having for.
    fn reduced(numerator: i64, denominator: i64) -> Option<Self> {
        const LIMIT: i64 = 1 << 16;
        let divisor = numerator.gcd(&denominator).max(1);
        let (n, d) = (numerator / divisor, denominator / divisor);
        (n.abs() < LIMIT && d < LIMIT).then_some(())?;
        Some(Self { numerator: i32::try_from(n).ok()?, denominator: i32::try_from(d).ok()? })
    }

    pub(super) fn of(value: &Rational) -> Option<Self> {
        let (n, d) = value.to_small()?;
        Self::reduced(n, d)
    }

    pub(super) fn to_rational(self) -> Rational {
        Rational::new(self.numerator.into(), self.denominator.into())
    }

    pub(super) fn plus(self, other: Self) -> Option<Self> {
        if self.denominator == 1 && other.denominator == 1 {
            return Self::reduced(i64::from(self.numerator) + i64::from(other.numerator), 1);
        }
        let (a, b) = (i64::from(self.numerator), i64::from(self.denominator));
        let (c, d) = (i64::from(other.numerator), i64::from(other.denominator));
        Self::reduced(a * d + c * b, b * d)
    }

    pub(super) fn negated(self) -> Self {
        Self { numerator: -self.numerator, ..self }
    }

    pub(super) fn times(self, other: Self) -> Option<Self> {
        Self::reduced(
            i64::from(self.numerator) * i64::from(other.numerator),
            i64::from(self.denominator) * i64::from(other.denominator),
        )
    }

    pub(super) fn is_zero(self) -> bool {
        self.numerator == 0
    }

    pub(super) fn is_negative(self) -> bool {
        self.numerator < 0
    }

    pub(super) fn is_integer(self) -> bool {
        self.denominator == 1
    }

    /// The value if it is an integer.
    pub(super) fn integer(self) -> Option<i32> {
        self.is_integer().then_some(self.numerator)
    }

    /// The integer below, and what is left of it.
    pub(super) fn floor(self) -> (i32, Self) {
        let whole = self.numerator.div_euclid(self.denominator);
        let rest = self.numerator.rem_euclid(self.denominator);
        (whole, Self { numerator: rest, denominator: if rest == 0 { 1 } else { self.denominator } })
    }
}

impl Ord for Exponent {
    fn cmp(&self, other: &Self) -> Ordering {
        let left = i64::from(self.numerator) * i64::from(other.denominator);
        left.cmp(&(i64::from(other.numerator) * i64::from(self.denominator)))
    }
}

impl PartialOrd for Exponent {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// What an atom is, as far as its powers are concerned.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// Nothing is known about its powers.
    Plain,
    /// A prime number under a root: exponents between 0 and 1.
    Number,
    /// A product under a root: never an integer exponent.
    Product,
    /// A primitive sum under a root or in a denominator.
    Sum,
}

/// A power of an atom.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Factor {
    pub(super) atom: ExprId,
    pub(super) kind: Kind,
    pub(super) exponent: Exponent,
}

/// A product of powers of atoms, in ascending order of the atoms.
///
/// Monomials are ordered lexicographically by exponents, which multiplication respects.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub(super) struct Monomial(pub(super) Vec<Factor>);

impl Monomial {
    pub(super) fn of(atom: ExprId, kind: Kind, exponent: Exponent) -> Self {
        Self(if exponent.is_zero() { Vec::new() } else { vec![Factor { atom, kind, exponent }] })
    }

    pub(super) fn is_unit(&self) -> bool {
        self.0.is_empty()
    }

    pub(super) fn exponent(&self, atom: ExprId) -> Exponent {
        match self.0.binary_search_by_key(&atom, |factor| factor.atom) {
            Ok(index) => self.0[index].exponent,
            Err(_) => Exponent::ZERO,
        }
    }

    /// The product; `None` where an exponent leaves the range.
    pub(super) fn times(&self, other: &Self) -> Option<Self> {
        let mut factors = Vec::with_capacity(self.0.len() + other.0.len());
        let (mut left, mut right) = (self.0.iter().peekable(), other.0.iter().peekable());
        loop {
            match (left.peek(), right.peek()) {
                (None, None) => return Some(Self(factors)),
                (Some(a), Some(b)) if a.atom == b.atom => {
                    let exponent = a.exponent.plus(b.exponent)?;
                    if !exponent.is_zero() {
                        factors.push(Factor { exponent, ..**a });
                    }
                    left.next();
                    right.next();
                }
                (Some(a), b) if b.is_none_or(|b| a.atom < b.atom) => factors.extend(left.next()),
                _ => factors.extend(right.next()),
            }
        }
    }

    /// Every exponent multiplied.
    pub(super) fn power(&self, exponent: Exponent) -> Option<Self> {
        let scaled = |factor: &Factor| Some(Factor { exponent: factor.exponent.times(exponent)?, ..*factor });
        self.0.iter().map(scaled).collect::<Option<Vec<_>>>().map(Self)
    }

    pub(super) fn inverse(&self) -> Self {
        Self(self.0.iter().map(|f| Factor { exponent: f.exponent.negated(), ..*f }).collect())
    }

    pub(super) fn over(&self, other: &Self) -> Option<Self> {
        self.times(&other.inverse())
    }

    /// The factors that satisfy a condition, and the others.
    pub(super) fn split(&self, condition: impl Fn(&Factor) -> bool) -> (Self, Self) {
        let (yes, no) = self.0.iter().partition(|factor| condition(factor));
        (Self(yes), Self(no))
    }

    /// The smaller exponent of every atom, those of absent atoms being 0.
    pub(super) fn meet(&self, other: &Self) -> Self {
        let mut factors: Vec<Factor> = Vec::new();
        for factor in &self.0 {
            let exponent = factor.exponent.min(other.exponent(factor.atom));
            factors.push(Factor { exponent, ..*factor });
        }
        for factor in &other.0 {
            if self.exponent(factor.atom).is_zero() {
                factors.push(Factor { exponent: factor.exponent.min(Exponent::ZERO), ..*factor });
            }
        }
        factors.retain(|factor| !factor.exponent.is_zero());
        factors.sort_by_key(|factor| factor.atom);
        Self(factors)
    }
}

impl Ord for Monomial {
    fn cmp(&self, other: &Self) -> Ordering {
        let sign = |exponent: Exponent| exponent.cmp(&Exponent::ZERO);
        let (mut left, mut right) = (self.0.iter(), other.0.iter());
        loop {
            let order = match (left.next(), right.next()) {
                (None, None) => return Ordering::Equal,
                (Some(a), None) => sign(a.exponent),
                (None, Some(b)) => sign(b.exponent).reverse(),
                (Some(a), Some(b)) => match a.atom.cmp(&b.atom) {
                    Ordering::Less => sign(a.exponent),
                    Ordering::Greater => sign(b.exponent).reverse(),
                    Ordering::Equal => a.exponent.cmp(&b.exponent),
                },
            };
            if order != Ordering::Equal {
                return order;
            }
        }
    }
}

impl PartialOrd for Monomial {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// `Σ coefficient · monomial`; no coefficient is zero.
#[derive(Clone, Debug, PartialEq, Default)]
pub(super) struct Polynomial(pub(super) Terms);

impl Polynomial {
    pub(super) fn constant(value: Rational) -> Self {
        Self::term(Monomial::default(), value)
    }

    pub(super) fn one() -> Self {
        Self::constant(Rational::ONE)
    }

    pub(super) fn term(monomial: Monomial, coefficient: Rational) -> Self {
        let mut polynomial = Self::default();
        polynomial.add_term(monomial, coefficient);
        polynomial
    }

    pub(super) fn len(&self) -> usize {
        self.0.len()
    }

    pub(super) fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    pub(super) fn is_one(&self) -> bool {
        self.single().is_some_and(|(monomial, coefficient)| monomial.is_unit() && coefficient.is_one())
    }

    pub(super) fn add_term(&mut self, monomial: Monomial, coefficient: Rational) {
        if !coefficient.is_zero() {
            self.0.add(monomial, coefficient);
        }
    }

    pub(super) fn add_scaled(&mut self, other: &Self, scale: &Rational) {
        for (monomial, coefficient) in other.0.iter() {
            self.add_term(monomial.clone(), coefficient.clone() * scale.clone());
        }
    }

    /// Adds another polynomial.
    pub(super) fn add(&mut self, other: Self) {
        if self.is_zero() {
            *self = other;
            return;
        }
        for (monomial, coefficient) in other.0 {
            self.0.add(monomial, coefficient);
        }
    }

    pub(super) fn scaled(&self, scale: &Rational) -> Self {
        let mut result = Self(Terms::with_capacity(self.len()));
        result.add_scaled(self, scale);
        result
    }

    /// The term, if there is just one.
    pub(super) fn single(&self) -> Option<(&Monomial, &Rational)> {
        (self.len() == 1).then(|| self.0.first()).flatten()
    }

    /// The term with the largest monomial.
    pub(super) fn leading(&self) -> Option<(&Monomial, &Rational)> {
        self.0.last()
    }

    /// The positive greatest common divisor of the coefficients.
    pub(super) fn content(&self) -> Rational {
        self.0.values().fold(Rational::ZERO, |gcd, coefficient| {
            if gcd.is_one() && coefficient.is_integer() { gcd } else { gcd.gcd(coefficient) }
        })
    }

    /// The largest monomial that divides all, negative exponents included.
    pub(super) fn meet(&self) -> Monomial {
        let mut monomials = self.0.keys();
        let first = monomials.next().cloned().unwrap_or_default();
        monomials.fold(first, |meet, monomial| meet.meet(monomial))
    }

    /// Every term times a monomial.
    pub(super) fn shifted(&self, by: &Monomial) -> Option<Self> {
        let mut result = Self(Terms::with_capacity(self.len()));
        for (monomial, coefficient) in self.0.iter() {
            result.add_term(monomial.times(by)?, coefficient.clone());
        }
        Some(result)
    }
}
