//! Arithmetic in the field of the zero test.
//!
//! `P = 2^61 − 636873` is prime, `P ≡ 7 (mod 8)`, and every prime below 61 is a square modulo P
//! (checked in the tests). So −1 is not a square, which makes the rational parametrisation of the
//! circle regular everywhere, and the square roots of small integers exist.
//!
//! Random choices are residues modulo P. Numbers that are no squares there have their roots among a + b i, i² = −1,
//! where a root is chosen for each prime, so that the root of a product is the product of the roots.

use super::number::Rational;
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::ToPrimitive;

const BITS: u32 = 61;
const MASK: u64 = (1 << BITS) - 1;
const SHORTFALL: u64 = 636_873;
const P: u64 = (1 << BITS) - SHORTFALL;
/// The number of squares but 0.
const HALF: u64 = (P - 1) / 2;

/// An element of the field: residues a and b of a + b i. The second is zero but for some roots of numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Residue(u64, u64);

impl Residue {
    /// Zero.
    pub const ZERO: Self = Self(0, 0);
    /// One.
    pub const ONE: Self = Self(1, 0);
    /// The number of residues modulo P.
    pub const ORDER: u64 = P;
    /// The steps of work that a root takes, which is a power of 60 bits.
    pub(super) const ROOT_WORK: usize = 4;

    /// The residue of an arbitrary word.
    #[must_use]
    pub fn of_word(word: u64) -> Self {
        Self(word % P, 0)
    }

    /// The representative below P; a word that is mixed from two of them where there are two.
    #[must_use]
    pub fn word(self) -> u64 {
        if self.1 == 0 { self.0 } else { Self::mixed(self.0, self.1).0 }
    }

    /// The residue of an integer.
    #[must_use]
    fn of_integer(n: &BigInt) -> Self {
        Self(n.mod_floor(&BigInt::from(P)).to_u64().unwrap_or(0), 0)
    }

    /// The residue of a rational number; `None` where P divides the denominator.
    #[must_use]
    pub fn of(value: &Rational) -> Option<Self> {
        if let Some((n, d)) = value.to_small() {
            let magnitude = Self::of_word(n.unsigned_abs());
            let numerator = if n < 0 { -magnitude } else { magnitude };
            return if d == 1 {
                Some(numerator)
            } else {
                Some(numerator * Self::of_word(d.unsigned_abs()).inverse()?)
            };
        }
        Some(Self::of_integer(&value.numerator()) * Self::of_integer(&value.denominator()).inverse()?)
    }

    /// The power with a non-negative exponent.
    #[must_use]
    pub fn pow(self, mut exponent: u64) -> Self {
        let (mut base, mut result) = (self, Self::ONE);
        while exponent > 0 {
            if exponent & 1 == 1 {
                result = result * base;
            }
            base = base * base;
            exponent >>= 1;
        }
        result
    }

    /// The inverse, by the extended Euclidean algorithm; `None` for zero.
    #[must_use]
    pub fn inverse(self) -> Option<Self> {
        if self.1 != 0 {
            // 1/(a + b i) = (a − b i)/(a² + b²), and −1 is no square
            let (a, b) = (Self(self.0, 0), Self(self.1, 0));
            let scale = (a * a + b * b).inverse()?;
            return Some(Self((a * scale).0, (-b * scale).0));
        }
        if self.0 == 0 {
            return None;
        }
        let (_, inverse) = self.quotient(1);
        Some(Self(inverse.rem_euclid(P.cast_signed()).cast_unsigned(), 0))
    }

    /// The rational number with numerator and denominator up to 2²⁰ that has this residue, if there is
    /// one; there is no second. One residue in a million has one by chance.
    #[must_use]
    pub fn recognised(self) -> Option<Rational> {
        const LARGEST: i64 = 1 << 20;
        if self.1 != 0 {
            return None;
        }
        let (numerator, denominator) = self.quotient(LARGEST);
        (denominator.abs() <= LARGEST).then(|| Rational::new(numerator, denominator))
    }

    /// Numbers (r, s), r = s · self, with the first r ≤ `largest` of the extended Euclidean algorithm: both
    /// are small if the residue is that of a quotient of small numbers (P. Wang, *A p-adic algorithm for
    /// univariate partial fractions*, SYMSAC 1981).
    fn quotient(self, largest: i64) -> (i64, i64) {
        // remainders and cofactors are at most P in magnitude
        let (mut r0, mut r1) = (P.cast_signed(), self.0.cast_signed());
        let (mut s0, mut s1) = (0, 1);
        while r1 > largest {
            let quotient = r0 / r1;
            (r0, r1) = (r1, r0 - quotient * r1);
            (s0, s1) = (s1, s0 - quotient * s1);
        }
        (r1, s1)
    }

    /// The integer power; `None` for a negative power of zero.
    #[must_use]
    pub fn integer_power(self, exponent: i64) -> Option<Self> {
        let base = if exponent < 0 { self.inverse()? } else { self };
        Some(base.pow(exponent.unsigned_abs()))
    }

    /// The square root that is itself a square; `None` if there is none modulo P. This choice is
    /// multiplicative: the root of a product is the product of the roots.
    #[must_use]
    pub fn sqrt(self) -> Option<Self> {
        if self.1 != 0 {
            return None;
        }
        let root = self.pow(P.div_ceil(4));
        (root * root == self).then_some(root)
    }

    /// Whether the field has the roots of an order: for odd orders one of each element, for even ones one that
    /// is itself a square of each square.
    #[must_use]
    pub fn has_roots(order: u64) -> bool {
        order > 0 && order.gcd(&HALF) == 1
    }

    /// The root of an order that the field has; `None` for an even root of no square. This choice is
    /// multiplicative, as in [`Self::sqrt`].
    #[must_use]
    pub fn root(self, order: u64) -> Option<Self> {
        if order == 2 {
            return self.sqrt();
        }
        if self.1 != 0 {
            return None;
        }
        // the squares are a group of odd order (P − 1)/2, in which every such root is a power
        let inverse = i128::from(order).extended_gcd(&i128::from(HALF)).x.rem_euclid(i128::from(HALF));
        let inverse = u64::try_from(inverse).ok()?;
        let (root, opposite) = (self.pow(inverse), -(-self).pow(inverse));
        [root, opposite].into_iter().find(|root| root.pow(order) == self)
    }

    /// The square root of a positive number, as the product of those of its primes: that of q modulo P, or else
    /// i √−q. `None` for numbers beyond 64 bits.
    #[must_use]
    pub fn root_of_number(number: &Rational) -> Option<Self> {
        let (n, d) = number.to_small().filter(|(n, _)| *n > 0)?;
        let mut root = Self::of(number)?.sqrt();
        let primes: Vec<u64> = primes(n.unsigned_abs()).into_iter().chain(primes(d.unsigned_abs())).collect();
        let is_square = |prime: &u64| Self::of_word(*prime).sqrt().is_some();
        if !primes.iter().all(is_square) {
            let of_prime = |prime: &u64| {
                let prime = Self::of_word(*prime);
                prime.sqrt().or_else(|| (-prime).sqrt().map(|root| root * Self(0, 1)))
            };
            let above = primes.iter().try_fold(Self::ONE, |product, prime| Some(product * of_prime(prime)?));
            // √(n/d) = √(n d)/d
            root = Some(above? * Self::of_word(d.unsigned_abs()).inverse()?);
        }
        root
    }

    /// A square root among all a + b i; `None` where a² + b² is no square, unless b is 0.
    #[must_use]
    pub(super) fn root_of_constant(self) -> Option<Self> {
        let i = Self(0, 1);
        if self.1 == 0 {
            return self.sqrt().or_else(|| (-self).sqrt().map(|root| root * i));
        }
        // (c + d i)² with c² = (a ± √(a² + b²))/2
        let (a, b) = (Self(self.0, 0), Self(self.1, 0));
        let norm = (a * a + b * b).sqrt()?;
        let half = Self::of_word(2).inverse()?;
        let c = [a + norm, a + -norm].into_iter().find_map(|twice| (twice * half).sqrt())?;
        let d = b * half * c.inverse()?;
        Some(c + d * i)
    }

    /// The smaller one of x and −x, and whether that is −x.
    #[must_use]
    pub(super) fn up_to_sign(self) -> (Self, bool) {
        let opposite = -self;
        if (opposite.0, opposite.1) < (self.0, self.1) { (opposite, true) } else { (self, false) }
    }

    /// A word that a seed and a number determine, well mixed (the finaliser of `SplitMix64`).
    #[must_use]
    pub fn mixed(seed: u64, number: u64) -> Self {
        let mut z =
            seed.wrapping_mul(0x9E37_79B9_7F4A_7C15).wrapping_add(number).wrapping_add(0x9E37_79B9_7F4A_7C15);
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        Self::of_word(z ^ (z >> 31))
    }
}

/// Brings a value below 2^123 under P.
#[allow(clippy::cast_possible_truncation, reason = "the folds leave less than 2^63")]
#[inline(always)]
fn reduce(wide: u128) -> u64 {
    let once = (wide & u128::from(MASK)) + (wide >> BITS) * u128::from(SHORTFALL);
    let twice = (once & u128::from(MASK)) + (once >> BITS) * u128::from(SHORTFALL);
    let mut value = twice as u64;
    while value >= P {
        value -= P;
    }
    value
}

/// The primes in a number as often as they occur. What has no factor below two million is taken for a prime: the
/// product of two larger ones has a root of its own then.
fn primes(mut number: u64) -> Vec<u64> {
    const TRIED: u64 = 1 << 21;
    let mut found = Vec::new();
    let mut divisor = 2;
    while divisor < TRIED && divisor * divisor <= number {
        while number.is_multiple_of(divisor) {
            found.push(divisor);
            number /= divisor;
        }
        divisor += if divisor == 2 { 1 } else { 2 };
    }
    if number > 1 {
        found.push(number);
    }
    found
}

#[inline(always)]
fn sum(a: u64, b: u64) -> u64 {
    let sum = a + b;
    if sum >= P { sum - P } else { sum }
}

#[inline(always)]
fn negative(a: u64) -> u64 {
    if a == 0 { 0 } else { P - a }
}

#[inline(always)]
fn product(a: u64, b: u64) -> u64 {
    reduce(u128::from(a) * u128::from(b))
}

impl std::ops::Add for Residue {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self(sum(self.0, other.0), sum(self.1, other.1))
    }
}

impl std::ops::Neg for Residue {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(negative(self.0), negative(self.1))
    }
}

impl std::ops::Sub for Residue {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl std::ops::Mul for Residue {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let (Self(a, b), Self(c, d)) = (self, other);
        if b == 0 && d == 0 {
            return Self(product(a, c), 0);
        }
        let real = sum(product(a, c), negative(product(b, d)));
        Self(real, sum(product(a, d), product(b, c)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Miller–Rabin with the bases that decide every 64-bit number.
    fn is_prime(n: u64) -> bool {
        let power = |mut base: u128, mut exponent: u64| {
            let (modulus, mut result) = (u128::from(n), 1);
            while exponent > 0 {
                if exponent & 1 == 1 {
                    result = result * base % modulus;
                }
                base = base * base % modulus;
                exponent >>= 1;
            }
            result
        };
        let twos = (n - 1).trailing_zeros();
        [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37u128].into_iter().all(|base| {
            let mut x = power(base, (n - 1) >> twos);
            x == 1
                || (0..twos).any(|_| {
                    let minus_one = x == u128::from(n - 1);
                    x = x * x % u128::from(n);
                    minus_one
                })
        })
    }

    #[test]
    fn the_modulus_is_as_stated() {
        assert!(is_prime(P));
        assert_eq!(P % 8, 7);
        for prime in (2..61).filter(|n| (2..*n).all(|d| n % d != 0)) {
            assert!(Residue::of_word(prime).sqrt().is_some(), "{prime}");
        }
    }

    #[test]
    fn numbers_have_roots_that_are_multiplicative() {
        let root = |n, d| Residue::root_of_number(&Rational::new(n, d)).expect("a root");
        let mut outside = 0;
        for n in 1..400_i64 {
            let value = Residue::of_word(n.unsigned_abs());
            assert_eq!(root(n, 1) * root(n, 1), value);
            assert_eq!(root(n, 7) * root(7, 1), root(n, 1));
            assert_eq!(root(n, 67) * root(67, n), Residue::ONE);
            for m in [2, 61, 67, 71, 134] {
                assert_eq!(root(n, 1) * root(m, 1), root(n * m, 1), "{n} {m}");
            }
            if value.sqrt().is_none() {
                outside += 1;
                let shifted = root(n, 1) + Residue::ONE;
                assert_eq!(shifted * shifted.inverse().expect("not zero"), Residue::ONE);
                assert_ne!(shifted.word(), (-shifted).word());
            }
        }
        assert!(outside > 50, "{outside}");
        assert_eq!(Residue::root_of_number(&Rational::new(9, 4)), Residue::of(&Rational::new(3, 2)));
        assert_eq!(Residue::root_of_number(&Rational::from(-3)), None);
    }

    #[test]
    fn roots_of_numbers_have_roots() {
        let root = |n: i64| Residue::root_of_number(&Rational::from(n)).expect("a root");
        let mut found = 0;
        for n in 2..200 {
            for shift in 1..20 {
                let nested = root(n) + Residue::of_word(shift);
                if let Some(root) = nested.root_of_constant() {
                    assert_eq!(root * root, nested, "{shift} + sqrt({n})");
                    found += 1;
                }
            }
        }
        assert!(found > 1500, "{found}");
    }

    #[test]
    fn small_fractions_are_recognised() {
        for (numerator, denominator) in
            [(0, 1), (1, 1), (-1, 2), (-72, 23), (999_983, 1_000_003), (1 << 20, 3)]
        {
            let number = Rational::new(numerator, denominator);
            assert_eq!(Residue::of(&number).unwrap().recognised(), Some(number));
        }
        let chance = (0..1000).filter(|seed| Residue::mixed(*seed, 0).recognised().is_some()).count();
        assert_eq!(chance, 0);
    }

    #[test]
    fn arithmetic_is_that_of_a_field() {
        for word in [1, 2, 12_345_678_901, P - 1, P / 2] {
            let x = Residue::of_word(word);
            assert_eq!(x * x.inverse().unwrap(), Residue::ONE);
            assert_eq!(x + -x, Residue::ZERO);
            assert_eq!((x * x).sqrt().map(|root| root * root), Some(x * x));
            let exact = u128::from(word) * u128::from(P - 2) % u128::from(P);
            assert_eq!(u128::from((x * Residue::of_word(P - 2)).0), exact);
        }
        assert_eq!(Residue::of(&Rational::new(-1, 2)).unwrap() * Residue::of_word(2), -Residue::ONE);
    }
}
