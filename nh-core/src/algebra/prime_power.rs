//! Arithmetic modulo a power of a prime: p-adic numbers by their first digits.

use super::number::Rational;
use num_bigint::BigInt;
use num_traits::{Euclid, ToPrimitive};

/// The numbers modulo pᵏ, where p is 3 modulo 4: there 1 + t² has an inverse for every t.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct PrimePower {
    prime: u64,
    modulus: u64,
}

/// Powers stay below this, so that sums fit.
const LARGEST: u64 = 1 << 60;

impl PrimePower {
    /// Steps of Newton's method to all digits: each doubles those that are right.
    pub(crate) const DOUBLINGS: u32 = 6;

    /// The prime itself.
    pub(crate) fn first(prime: u64) -> Self {
        Self { prime, modulus: prime }
    }

    /// The highest power below 2⁶⁰.
    pub(crate) fn highest(prime: u64) -> Self {
        let mut modulus = prime;
        while modulus < LARGEST / prime {
            modulus *= prime;
        }
        Self { prime, modulus }
    }

    pub(crate) fn prime(self) -> u64 {
        self.prime
    }

    pub(crate) fn modulus(self) -> u64 {
        self.modulus
    }

    pub(crate) fn sum(self, a: u64, b: u64) -> u64 {
        let sum = a + b;
        if sum < self.modulus { sum } else { sum - self.modulus }
    }

    pub(crate) fn negative(self, a: u64) -> u64 {
        if a == 0 { 0 } else { self.modulus - a }
    }

    pub(crate) fn difference(self, a: u64, b: u64) -> u64 {
        self.sum(a, self.negative(b))
    }

    #[allow(clippy::cast_possible_truncation, reason = "a remainder is smaller than the modulus")]
    pub(crate) fn product(self, a: u64, b: u64) -> u64 {
        if u32::try_from(self.modulus).is_ok() {
            return a * b % self.modulus;
        }
        (u128::from(a) * u128::from(b) % u128::from(self.modulus)) as u64
    }

    /// Whether there is an inverse.
    pub(crate) fn is_unit(self, a: u64) -> bool {
        !a.is_multiple_of(self.prime)
    }

    fn positive_power(self, a: u64, mut times: u64) -> u64 {
        let (mut square, mut power) = (a, 1);
        while times > 0 {
            if times % 2 == 1 {
                power = self.product(power, square);
            }
            square = self.product(square, square);
            times /= 2;
        }
        power
    }

    /// `a^times`, if there is such a number.
    pub(crate) fn power(self, a: u64, times: i64) -> Option<u64> {
        let power = self.positive_power(a, times.unsigned_abs());
        if times < 0 { self.inverse(power) } else { Some(power) }
    }

    /// 1/a of what is not divisible by p.
    pub(crate) fn inverse(self, a: u64) -> Option<u64> {
        if !self.is_unit(a) {
            return None;
        }
        // right modulo p (Fermat), then y ← y (2 − a y)
        let mut inverse = Self::first(self.prime).positive_power(a % self.prime, self.prime - 2);
        if self.modulus > self.prime {
            for _ in 0..Self::DOUBLINGS {
                let defect = self.difference(2, self.product(a, inverse));
                inverse = self.product(inverse, defect);
            }
        }
        Some(inverse)
    }

    /// A rational number, if its denominator is not divisible by p.
    pub(crate) fn of(self, number: &Rational) -> Option<u64> {
        let modulus = BigInt::from(self.modulus);
        let reduced = |part: BigInt| part.rem_euclid(&modulus).to_u64();
        let (numerator, denominator) = (reduced(number.numerator())?, reduced(number.denominator())?);
        Some(self.product(numerator, self.inverse(denominator)?))
    }

    /// The square root of a small number that begins with the lesser of the two digits there are.
    pub(crate) fn root(self, number: u64) -> Option<u64> {
        let digit = (1..=self.prime / 2).find(|x| x * x % self.prime == number % self.prime)?;
        // x ← (x + a/x)/2
        let (half, value) = (self.inverse(2)?, number % self.modulus);
        let mut root = digit;
        for _ in 0..Self::DOUBLINGS {
            let quotient = self.product(value, self.inverse(root)?);
            root = self.product(half, self.sum(root, quotient));
        }
        Some(root)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inverses_and_roots_have_all_digits() {
        for prime in [7, 11, 19, 23, 31] {
            let power = PrimePower::highest(prime);
            for number in (2..60).filter(|number| number % prime != 0) {
                let inverse = power.inverse(number).unwrap();
                assert_eq!(power.product(number, inverse), 1);
                let third = power.of(&Rational::new(1, i64::try_from(number).unwrap())).unwrap();
                assert_eq!(third, inverse);
                if let Some(root) = power.root(number) {
                    assert_eq!(power.product(root, root), number);
                }
            }
            assert_eq!(power.inverse(prime), None);
            assert_eq!(power.power(3, -2).map(|x| power.product(x, 9)), Some(1));
        }
    }
}
