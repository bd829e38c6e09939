//! Exact rational numbers, with a fast path for the small ones that nearly all are.

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::Ratio;
use num_traits::{One, Pow, Signed, ToPrimitive, Zero};
use std::cmp::Ordering;
use std::fmt;
use std::hash::{Hash, Hasher};

mod float;

type Big = Ratio<BigInt>;

/// An exact rational number in lowest terms with a positive denominator.
///
/// ```
/// use nonholonomic_core::algebra::Rational;
/// let third = Rational::new(2, 6);
/// assert_eq!((third.clone() + Rational::from(1)).to_string(), "4/3");
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Rational(Repr);

/// `Large` holds only what does not fit `Small`, so that equality is structural.
#[derive(Debug, PartialEq, Eq)]
enum Repr {
    Small(i64, i64),
    Large(Box<Big>),
}

impl Clone for Repr {
    #[inline(always)]
    fn clone(&self) -> Self {
        #[cold]
        fn of_large(big: &Big) -> Repr {
            Repr::Large(Box::new(big.clone()))
        }
        match self {
            Self::Small(n, d) => Self::Small(*n, *d),
            Self::Large(big) => of_large(big),
        }
    }
}

impl Hash for Repr {
    #[inline]
    fn hash<H: Hasher>(&self, state: &mut H) {
        match self {
            Self::Small(n, d) => {
                state.write_i64(*n);
                state.write_i64(*d);
            }
            Self::Large(big) => big.hash(state),
        }
    }
}

impl Rational {
    /// Zero.
    pub const ZERO: Self = Self(Repr::Small(0, 1));
    /// One.
    pub const ONE: Self = Self(Repr::Small(1, 1));
    /// Minus one.
    pub const MINUS_ONE: Self = Self(Repr::Small(-1, 1));

    /// `numerator / denominator`, reduced.
    ///
    /// # Panics
    /// If the denominator is zero.
    #[must_use]
    pub fn new(numerator: i64, denominator: i64) -> Self {
        assert!(denominator != 0, "a rational number has a non-zero denominator");
        Self::from_wide(i128::from(numerator), i128::from(denominator))
    }

    /// `numerator / denominator` of any size; `None` if the denominator is zero.
    #[must_use]
    pub fn from_big(numerator: BigInt, denominator: BigInt) -> Option<Self> {
        (!denominator.is_zero()).then(|| Self::normal(Big::new(numerator, denominator)))
    }

    fn from_wide(numerator: i128, denominator: i128) -> Self {
        if denominator == 1
            && let Ok(n) = i64::try_from(numerator)
        {
            return Self(Repr::Small(n, 1));
        }
        if let (Ok(n), Ok(d)) = (i64::try_from(numerator), i64::try_from(denominator))
            && n != i64::MIN
            && d != i64::MIN
        {
            let divisor = n.gcd(&d).max(1) * d.signum();
            return Self(Repr::Small(n / divisor, d / divisor));
        }
        let divisor = numerator.gcd(&denominator).max(1);
        let sign = denominator.signum();
        let (n, d) = (numerator / divisor * sign, denominator / divisor * sign);
        match (i64::try_from(n), i64::try_from(d)) {
            (Ok(n), Ok(d)) => Self(Repr::Small(n, d)),
            _ => Self(Repr::Large(Box::new(Big::new_raw(n.into(), d.into())))),
        }
    }

    fn normal(big: Big) -> Self {
        match (big.numer().to_i64(), big.denom().to_i64()) {
            (Some(n), Some(d)) => Self(Repr::Small(n, d)),
            _ => Self(Repr::Large(Box::new(big))),
        }
    }

    fn big(&self) -> Big {
        match &self.0 {
            Repr::Small(n, d) => Big::new_raw((*n).into(), (*d).into()),
            Repr::Large(big) => (**big).clone(),
        }
    }

    /// The numerator.
    #[must_use]
    pub fn numerator(&self) -> BigInt {
        self.big().numer().clone()
    }

    /// The denominator, positive.
    #[must_use]
    pub fn denominator(&self) -> BigInt {
        self.big().denom().clone()
    }

    /// The value if it is an integer that fits.
    #[must_use]
    pub fn to_i64(&self) -> Option<i64> {
        match self.0 {
            Repr::Small(n, 1) => Some(n),
            _ => None,
        }
    }

    /// Numerator and denominator if both fit.
    #[must_use]
    #[inline(always)]
    pub fn to_small(&self) -> Option<(i64, i64)> {
        match self.0 {
            Repr::Small(n, d) => Some((n, d)),
            Repr::Large(_) => None,
        }
    }

    /// The nearest `f64`; infinite or zero beyond its range.
    #[must_use]
    #[allow(clippy::cast_precision_loss, reason = "the rounding is wanted; exact below 2^53")]
    pub fn to_f64(&self) -> f64 {
        match &self.0 {
            Repr::Small(n, d) if n.unsigned_abs() < 1 << 53 && *d < 1 << 53 => *n as f64 / *d as f64,
            _ => float::nearest(&self.big()),
        }
    }

    /// Whether this is 0.
    #[must_use]
    #[inline(always)]
    pub fn is_zero(&self) -> bool {
        matches!(self.0, Repr::Small(0, _))
    }

    /// Whether this is 1.
    #[must_use]
    #[inline(always)]
    pub fn is_one(&self) -> bool {
        matches!(self.0, Repr::Small(1, 1))
    }

    /// Whether the denominator is 1.
    #[must_use]
    pub fn is_integer(&self) -> bool {
        match &self.0 {
            Repr::Small(_, d) => *d == 1,
            Repr::Large(big) => big.is_integer(),
        }
    }

    /// Whether the numerator is odd.
    #[must_use]
    pub fn has_odd_numerator(&self) -> bool {
        match &self.0 {
            Repr::Small(n, _) => n % 2 != 0,
            Repr::Large(big) => big.numer().is_odd(),
        }
    }

    /// Whether this is an even integer.
    #[must_use]
    pub fn is_even(&self) -> bool {
        self.is_integer() && !self.has_odd_numerator()
    }

    /// Whether this is below 0.
    #[must_use]
    pub fn is_negative(&self) -> bool {
        match &self.0 {
            Repr::Small(n, _) => *n < 0,
            Repr::Large(big) => big.is_negative(),
        }
    }

    /// The absolute value.
    #[must_use]
    pub fn abs(&self) -> Self {
        if self.is_negative() { -self.clone() } else { self.clone() }
    }

    /// The reciprocal; `None` for zero.
    #[must_use]
    pub fn recip(&self) -> Option<Self> {
        match &self.0 {
            Repr::Small(0, _) => None,
            Repr::Small(n @ 1.., d) => Some(Self(Repr::Small(*d, *n))),
            Repr::Small(n, d) => Some(Self::from_wide(i128::from(*d), i128::from(*n))),
            Repr::Large(big) => Some(Self::normal(big.recip())),
        }
    }

    /// The integer power; `None` for a negative power of zero, and where the result would have
    /// more than [`Self::MAX_BITS`] bits.
    #[must_use]
    pub fn pow(&self, exponent: i64) -> Option<Self> {
        if self.is_one() || exponent == 0 {
            return Some(Self::ONE);
        }
        if *self == Self::MINUS_ONE {
            return Some(if exponent % 2 == 0 { Self::ONE } else { Self::MINUS_ONE });
        }
        if self.is_zero() {
            return (exponent > 0).then_some(Self::ZERO);
        }
        let times = u32::try_from(exponent.unsigned_abs()).ok()?;
        if self.bits().checked_mul(u64::from(times))? > Self::MAX_BITS {
            return None;
        }
        let base = if exponent < 0 { self.recip()? } else { self.clone() };
        // powers of coprime numbers are coprime
        if let Repr::Small(n, d) = base.0
            && let (Some(n), Some(d)) = (n.checked_pow(times), d.checked_pow(times))
        {
            return Some(Self(Repr::Small(n, d)));
        }
        Some(Self::normal(Pow::pow(base.big(), times)))
    }

    /// Powers and literals are kept below this many bits.
    pub const MAX_BITS: u64 = 4096;

    /// The bits of numerator and denominator together.
    #[must_use]
    pub fn bits(&self) -> u64 {
        if let Repr::Small(n, d) = self.0 {
            let bits = |n: u64| u64::from(u64::BITS - n.leading_zeros());
            return bits(n.unsigned_abs()) + bits(d.unsigned_abs());
        }
        let big = self.big();
        big.numer().bits() + big.denom().bits()
    }

    /// The greatest rational of which both are integer multiples; zero for two zeros.
    #[must_use]
    pub fn gcd(&self, other: &Self) -> Self {
        if let (Repr::Small(a, 1), Repr::Small(b, 1)) = (&self.0, &other.0) {
            return Self::from_wide(i128::from(a.unsigned_abs().gcd(&b.unsigned_abs())), 1);
        }
        if let (Repr::Small(a, b), Repr::Small(c, d)) = (&self.0, &other.0) {
            let denominator = i128::from(*b) * i128::from(*d);
            if let (Some(x), Some(y)) = (a.checked_mul(*d), c.checked_mul(*b)) {
                return Self::from_wide(i128::from(x.unsigned_abs().gcd(&y.unsigned_abs())), denominator);
            }
            let (x, y) = (i128::from(*a) * i128::from(*d), i128::from(*c) * i128::from(*b));
            return Self::from_wide(x.gcd(&y), denominator);
        }
        let (a, b) = (self.big(), other.big());
        let numerator = (a.numer() * b.denom()).gcd(&(b.numer() * a.denom()));
        Self::normal(Big::new(numerator, a.denom() * b.denom()))
    }

    /// The square root, if it is rational.
    #[must_use]
    pub fn sqrt(&self) -> Option<Self> {
        if self.is_negative() {
            return None;
        }
        if let Repr::Small(n, d) = self.0 {
            let (rn, rd) = (n.isqrt(), d.isqrt());
            return (rn * rn == n && rd * rd == d).then_some(Self(Repr::Small(rn, rd)));
        }
        let (n, d) = (self.numerator(), self.denominator());
        let (rn, rd) = (n.sqrt(), d.sqrt());
        (&rn * &rn == n && &rd * &rd == d).then(|| Self::normal(Big::new(rn, rd)))
    }
}

impl From<i64> for Rational {
    fn from(value: i64) -> Self {
        Self(Repr::Small(value, 1))
    }
}

impl std::ops::Add for Rational {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        match (&self.0, &other.0) {
            (Repr::Small(a, 1), Repr::Small(b, 1)) => match a.checked_add(*b) {
                Some(sum) => Self(Repr::Small(sum, 1)),
                None => Self::from_wide(i128::from(*a) + i128::from(*b), 1),
            },
            (Repr::Small(a, b), Repr::Small(c, d)) => {
                let (a, b, c, d) = (i128::from(*a), i128::from(*b), i128::from(*c), i128::from(*d));
                match (a * d).checked_add(c * b) {
                    Some(numerator) => Self::from_wide(numerator, b * d),
                    None => Self::normal(self.big() + other.big()),
                }
            }
            _ => Self::normal(self.big() + other.big()),
        }
    }
}

impl std::ops::Neg for Rational {
    type Output = Self;
    fn neg(self) -> Self {
        match self.0 {
            Repr::Small(n, d) => match n.checked_neg() {
                Some(n) => Self(Repr::Small(n, d)),
                None => Self::from_wide(-i128::from(n), i128::from(d)),
            },
            Repr::Large(big) => Self::normal(-*big),
        }
    }
}

impl std::ops::Sub for Rational {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl std::ops::Mul for Rational {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        match (&self.0, &other.0) {
            (Repr::Small(1, 1), _) => other,
            (_, Repr::Small(1, 1)) => self,
            (Repr::Small(a, 1), Repr::Small(b, 1)) => match a.checked_mul(*b) {
                Some(product) => Self(Repr::Small(product, 1)),
                None => Self::from_wide(i128::from(*a) * i128::from(*b), 1),
            },
            (Repr::Small(a, b), Repr::Small(c, d)) => {
                Self::from_wide(i128::from(*a) * i128::from(*c), i128::from(*b) * i128::from(*d))
            }
            _ => Self::normal(self.big() * other.big()),
        }
    }
}

impl PartialOrd for Rational {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Rational {
    fn cmp(&self, other: &Self) -> Ordering {
        match (&self.0, &other.0) {
            (Repr::Small(a, b), Repr::Small(c, d)) => {
                (i128::from(*a) * i128::from(*d)).cmp(&(i128::from(*c) * i128::from(*b)))
            }
            _ => self.big().cmp(&other.big()),
        }
    }
}

impl fmt::Display for Rational {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            Repr::Small(n, 1) => return write!(f, "{n}"),
            Repr::Small(n, d) => return write!(f, "{n}/{d}"),
            Repr::Large(_) => {}
        }
        let big = self.big();
        if big.denom().is_one() {
            write!(f, "{}", big.numer())
        } else {
            write!(f, "{}/{}", big.numer(), big.denom())
        }
    }
}

#[cfg(test)]
mod number_tests;
