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

    #[inline(always)]
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

    #[inline(always)]
    pub(super) fn plus(self, other: Self) -> Option<Self> {
        if self.denominator == 1 && other.denominator == 1 {
            return match self.numerator.checked_add(other.numerator) {
                None | Some(i16::MIN) => None,
                Some(sum) => Some(Self::whole(sum)),
            };
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

    #[inline(always)]
    pub(super) fn is_zero(self) -> bool {
        self.numerator == 0
    }

    #[inline(always)]
    pub(super) fn is_negative(self) -> bool {
        self.numerator < 0
    }

    #[inline(always)]
    pub(super) fn is_integer(self) -> bool {
        self.denominator == 1
    }

    #[inline(always)]
    pub(super) fn is_at_least(self, whole: i16) -> bool {
        i32::from(self.numerator) >= i32::from(whole) * i32::from(self.denominator)
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
        let (factors, atom): (&[Factor], usize) = (&self.0, atom.index());
        let mut place = 0;
        while place < factors.len() {
            let other = factors[place].atom.index();
            if other >= atom {
                return if other == atom { factors[place].exponent } else { Exponent::ZERO };
            }
            place += 1;
        }
        Exponent::ZERO
    }

    /// The product; `None` where an exponent leaves the range.
    pub(super) fn times(&self, other: &Self) -> Option<Self> {
        let (left, right): (&[Factor], &[Factor]) = (&self.0, &other.0);
        if left.is_empty() || right.is_empty() {
            return Some(if left.is_empty() { other.clone() } else { self.clone() });
        }
        let mut factors = Factors::default();
        let (mut i, mut j) = (0, 0);
        while i < left.len() && j < right.len() {
            let (a, b) = (&left[i], &right[j]);
            let (first, second) = (a.atom.index(), b.atom.index());
            if first == second {
                let exponent = a.exponent.plus(b.exponent)?;
                if exponent.numerator != 0 {
                    factors.push(Factor { exponent, ..*a });
                }
            } else {
                factors.push(if first < second { *a } else { *b });
            }
            i += usize::from(first <= second);
            j += usize::from(second <= first);
        }
        factors.extend_from_slice(&left[i..]);
        factors.extend_from_slice(&right[j..]);
        Some(Self(factors))
    }

    /// Whether some factor satisfies a condition.
    pub(super) fn has(&self, condition: impl Fn(&Factor) -> bool) -> bool {
        let factors: &[Factor] = &self.0;
        let mut place = 0;
        while place < factors.len() && !condition(&factors[place]) {
            place += 1;
        }
        place < factors.len()
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
        let factors: &[Factor] = &self.0;
        let (mut yes, mut no) = (Factors::default(), Factors::default());
        let mut place = 0;
        while place < factors.len() {
            if condition(&factors[place]) { &mut yes } else { &mut no }.push(factors[place]);
            place += 1;
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
        let (left, right): (&[Factor], &[Factor]) = (&self.0, &other.0);
        let mut factors = Factors::default();
        let (mut i, mut j) = (0, 0);
        while i < left.len() || j < right.len() {
            let first = if i < left.len() { left[i].atom.index() } else { usize::MAX };
            let second = if j < right.len() { right[j].atom.index() } else { usize::MAX };
            let factor = if first <= second { &left[i] } else { &right[j] };
            let exponent = if first == second {
                choose(factor.exponent, right[j].exponent)
            } else {
                choose(factor.exponent, Exponent::ZERO)
            };
            if exponent.numerator != 0 {
                factors.push(Factor { exponent, ..*factor });
            }
            i += usize::from(first <= second);
            j += usize::from(second <= first);
        }
        Self(factors)
    }
}

/// Written with indices and plain comparisons: unoptimised builds spend much of a derivation here.
impl Ord for Monomial {
    fn cmp(&self, other: &Self) -> Ordering {
        let (left, right): (&[Factor], &[Factor]) = (&self.0, &other.0);
        let both = if left.len() < right.len() { left.len() } else { right.len() };
        let mut place = 0;
        // no factor of the one is among those of the other: its exponent is compared with 0
        let mut is_first = left.len() > right.len();
        while place < both {
            let (a, b) = (&left[place], &right[place]);
            if a.atom.index() != b.atom.index() {
                is_first = a.atom.index() < b.atom.index();
                break;
            }
            let (a, b) = (a.exponent, b.exponent);
            if a.numerator != b.numerator || a.denominator != b.denominator {
                return a.cmp(&b);
            }
            place += 1;
        }
        if place == left.len() && place == right.len() {
            return Ordering::Equal;
        }
        let numerator =
            if is_first { left[place].exponent.numerator } else { right[place].exponent.numerator };
        // an exponent of 0 says nothing, and stands in no monomial
        if (numerator > 0) == is_first { Ordering::Greater } else { Ordering::Less }
    }
}

impl PartialOrd for Monomial {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
