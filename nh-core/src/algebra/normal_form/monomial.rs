//! Monomials: products of powers of atoms, with rational exponents of either sign.

use super::factors::Factors;
use crate::algebra::number::Rational;
use crate::id::{ExprId, Id};
use num_integer::Integer;
use std::cmp::Ordering;

/// An exponent in lowest terms with a positive denominator.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Exponent {
    numerator: i16,
    denominator: i16,
}

impl Exponent {
    pub(super) const ZERO: Self = Self::whole(0);
    pub(super) const ONE: Self = Self::whole(1);

    pub(super) const fn whole(numerator: i16) -> Self {
        Self { numerator, denominator: 1 }
    }

    /// `None` beyond the range that a polynomial is worth having for.
    fn reduced(numerator: i64, denominator: i64) -> Option<Self> {
        let divisor = if denominator == 1 { 1 } else { numerator.gcd(&denominator).max(1) };
        let (n, d) = (numerator / divisor, denominator / divisor);
        // symmetric, so that every exponent has its opposite
        let numerator = i16::try_from(n).ok().filter(|n| *n != i16::MIN)?;
        Some(Self { numerator, denominator: i16::try_from(d).ok()? })
    }

    pub(super) fn of(value: &Rational) -> Option<Self> {
        let (n, d) = value.to_small()?;
        Self::reduced(n, d)
    }

    pub(super) fn to_rational(self) -> Rational {
        if self.is_integer() {
            return Rational::from(i64::from(self.numerator));
        }
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
        if other == Self::ONE {
            return Some(self);
        }
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
    pub(super) fn integer(self) -> Option<i16> {
        self.is_integer().then_some(self.numerator)
    }

    /// The integer below, and what is left of it.
    pub(super) fn floor(self) -> (i16, Self) {
        let whole = self.numerator.div_euclid(self.denominator);
        let rest = self.numerator.rem_euclid(self.denominator);
        (whole, Self { numerator: rest, denominator: if rest == 0 { 1 } else { self.denominator } })
    }
}

impl Ord for Exponent {
    fn cmp(&self, other: &Self) -> Ordering {
        let left = i32::from(self.numerator) * i32::from(other.denominator);
        left.cmp(&(i32::from(other.numerator) * i32::from(self.denominator)))
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

impl Factor {
    /// What stands in a place that is not taken.
    pub(super) const NONE: Self = Self { atom: ExprId::FIRST, kind: Kind::Plain, exponent: Exponent::ZERO };
}

/// A product of powers of atoms, in ascending order of the atoms.
///
/// Monomials are ordered lexicographically by exponents, which multiplication respects.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub(super) struct Monomial(pub(super) Factors);

impl Monomial {
    pub(super) fn of(atom: ExprId, kind: Kind, exponent: Exponent) -> Self {
        let mut factors = Factors::default();
        if !exponent.is_zero() {
            factors.push(Factor { atom, kind, exponent });
        }
        Self(factors)
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
        let mut factors = Factors::default();
        let (mut left, mut right) = (&self.0[..], &other.0[..]);
        while let ([a, after_a @ ..], [b, after_b @ ..]) = (left, right) {
            match a.atom.cmp(&b.atom) {
                Ordering::Less => {
                    factors.push(*a);
                    left = after_a;
                }
                Ordering::Greater => {
                    factors.push(*b);
                    right = after_b;
                }
                Ordering::Equal => {
                    let exponent = a.exponent.plus(b.exponent)?;
                    if !exponent.is_zero() {
                        factors.push(Factor { exponent, ..*a });
                    }
                    (left, right) = (after_a, after_b);
                }
            }
        }
        factors.extend_from_slice(left);
        factors.extend_from_slice(right);
        Some(Self(factors))
    }

    /// Every exponent multiplied.
    pub(super) fn power(&self, exponent: Exponent) -> Option<Self> {
        let scaled = |factor: &Factor| Some(Factor { exponent: factor.exponent.times(exponent)?, ..*factor });
        self.0.iter().map(scaled).collect::<Option<Factors>>().map(Self)
    }

    pub(super) fn inverse(&self) -> Self {
        Self(self.0.iter().map(|f| Factor { exponent: f.exponent.negated(), ..*f }).collect())
    }

    pub(super) fn over(&self, other: &Self) -> Option<Self> {
        self.times(&other.inverse())
    }

    /// The factors that satisfy a condition, and the others.
    pub(super) fn split(&self, condition: impl Fn(&Factor) -> bool) -> (Self, Self) {
        let (mut yes, mut no) = (Factors::default(), Factors::default());
        for factor in self.0.iter() {
            if condition(factor) { &mut yes } else { &mut no }.push(*factor);
        }
        (Self(yes), Self(no))
    }

    /// The smaller exponent of every atom, those of absent atoms being 0.
    pub(super) fn meet(&self, other: &Self) -> Self {
        self.merged(other, Ord::min)
    }

    /// The larger exponent of every atom, those of absent atoms being 0.
    pub(super) fn join(&self, other: &Self) -> Self {
        self.merged(other, Ord::max)
    }

    /// One exponent for each atom, of the two that it has.
    fn merged(&self, other: &Self, choose: impl Fn(Exponent, Exponent) -> Exponent) -> Self {
        let mut factors = Factors::default();
        let mut add = |factor: &Factor, other: Exponent| {
            let exponent = choose(factor.exponent, other);
            if !exponent.is_zero() {
                factors.push(Factor { exponent, ..*factor });
            }
        };
        let (mut left, mut right) = (&self.0[..], &other.0[..]);
        while let ([a, after_a @ ..], [b, after_b @ ..]) = (left, right) {
            match a.atom.cmp(&b.atom) {
                Ordering::Less => {
                    add(a, Exponent::ZERO);
                    left = after_a;
                }
                Ordering::Greater => {
                    add(b, Exponent::ZERO);
                    right = after_b;
                }
                Ordering::Equal => {
                    add(a, b.exponent);
                    (left, right) = (after_a, after_b);
                }
            }
        }
        left.iter().chain(right).for_each(|factor| add(factor, Exponent::ZERO));
        Self(factors)
    }
}

/// Written with indices and plain comparisons: unoptimised builds spend much of a derivation here.
impl Ord for Monomial {
    fn cmp(&self, other: &Self) -> Ordering {
        let (left, right): (&[Factor], &[Factor]) = (&self.0, &other.0);
        let mut place = 0;
        loop {
            let (one, two) = (place < left.len(), place < right.len());
            if !(one || two) {
                return Ordering::Equal;
            }
            if one && two && left[place].atom.index() == right[place].atom.index() {
                let (a, b) = (left[place].exponent, right[place].exponent);
                if a.numerator != b.numerator || a.denominator != b.denominator {
                    return a.cmp(&b);
                }
                place += 1;
                continue;
            }
            // no factor of the one is among those of the other: its exponent is compared with 0
            let is_first = one && (!two || left[place].atom.index() < right[place].atom.index());
            let numerator =
                if is_first { left[place].exponent.numerator } else { right[place].exponent.numerator };
            // an exponent of 0 says nothing, and stands in no monomial
            return if (numerator > 0) == is_first { Ordering::Greater } else { Ordering::Less };
        }
    }
}

impl PartialOrd for Monomial {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
