//! Counts of operations, entries and terms: the numbers that forms are compared by.

use std::cmp::Ordering;
use std::fmt;
use std::iter::{Product, Sum};
use std::ops::{Add, AddAssign, Div, Mul, Sub};

/// A number of operations, or of anything else that declarations have many of.
///
/// Estimates may grow exponentially, as what a dense elimination would come to if it were written out.
/// Beyond 2⁶⁴ − 1 all counts are equal, *too many*; no arithmetic on them overflows, and none falls below 0.
///
/// ```
/// use nonholonomic_core::count::Count;
/// let many = Count::TOO_MANY;
/// assert_eq!(many + 1, many);
/// assert_eq!([many, many].into_iter().sum::<Count>() * 3, many);
/// assert!(Count::new(2) - 3 == 0 && Count::new(2) < 3);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Count(u64);

impl Count {
    /// Nothing.
    pub const ZERO: Self = Self(0);
    /// More than can be counted.
    pub const TOO_MANY: Self = Self(u64::MAX);

    /// So many.
    #[must_use]
    pub const fn new(count: u64) -> Self {
        Self(count)
    }

    /// The number, at most the largest `usize`.
    #[must_use]
    pub fn to_usize(self) -> usize {
        usize::try_from(self.0).unwrap_or(usize::MAX)
    }

    /// The number, at most 2⁶⁴ − 1.
    #[must_use]
    pub const fn get(self) -> u64 {
        self.0
    }
}

impl From<usize> for Count {
    fn from(count: usize) -> Self {
        Self(u64::try_from(count).unwrap_or(u64::MAX))
    }
}

macro_rules! arithmetic {
    ($($trait:ident $method:ident $saturating:ident,)*) => {$(
        impl $trait for Count {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                Self(self.0.$saturating(other.0))
            }
        }

        impl $trait<u64> for Count {
            type Output = Self;
            fn $method(self, other: u64) -> Self {
                Self(self.0.$saturating(other))
            }
        }
    )*};
}

arithmetic! {
    Add add saturating_add,
    Sub sub saturating_sub,
    Mul mul saturating_mul,
}

impl Div<u64> for Count {
    type Output = Self;
    /// The integer below the quotient; nothing where the divisor is 0.
    fn div(self, parts: u64) -> Self {
        Self(self.0.checked_div(parts).unwrap_or(0))
    }
}

impl AddAssign for Count {
    fn add_assign(&mut self, more: Self) {
        *self = *self + more;
    }
}

impl AddAssign<u64> for Count {
    fn add_assign(&mut self, more: u64) {
        *self = *self + more;
    }
}

impl Sum for Count {
    fn sum<I: Iterator<Item = Self>>(counts: I) -> Self {
        counts.fold(Self::ZERO, Add::add)
    }
}

impl Product for Count {
    fn product<I: Iterator<Item = Self>>(counts: I) -> Self {
        counts.fold(Self::new(1), Mul::mul)
    }
}

impl PartialEq<u64> for Count {
    fn eq(&self, other: &u64) -> bool {
        self.0 == *other
    }
}

impl PartialOrd<u64> for Count {
    fn partial_cmp(&self, other: &u64) -> Option<Ordering> {
        self.0.partial_cmp(other)
    }
}

impl fmt::Display for Count {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::TOO_MANY => f.write_str("more than 10^19"),
            Self(count) => count.fmt(f),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const EXTREME: [u64; 7] = [0, 1, 2, 1 << 32, u64::MAX / 2, u64::MAX - 1, u64::MAX];

    #[test]
    fn arithmetic_ends_at_the_extremes() {
        for a in EXTREME {
            for b in EXTREME {
                let (x, y) = (Count::new(a), Count::new(b));
                let exact = |value: i128| u64::try_from(value.clamp(0, u64::MAX.into())).unwrap_or(u64::MAX);
                assert_eq!(x + y, exact(i128::from(a) + i128::from(b)));
                assert_eq!(x - y, exact(i128::from(a) - i128::from(b)));
                assert_eq!((x * y).get(), a.saturating_mul(b));
                assert_eq!([x, y].into_iter().sum::<Count>(), x + y);
                assert_eq!([x, y].into_iter().product::<Count>(), x * y);
                // adding never makes a count smaller, so that orders hold
                assert!(x + y >= x && x + y >= y);
            }
        }
    }
}
