//! The constants π and ln 2, and power series, with the error of every rounding and of the rest.

use super::{Ball, Bits};
use num_bigint::BigInt;
use num_traits::{Signed, Zero};

/// Digits that series lose at most, with some to spare.
pub(super) const GUARD: Bits = 32;

/// Σ (±1)^k / ((2k+1) q^(2k+1)): the arcus tangens of 1/q, or the area tangens.
fn of_reciprocal(q: u32, alternating: bool, bits: Bits) -> Ball {
    let square = BigInt::from(q) * q;
    let mut power = (BigInt::from(1) << bits) / q;
    let (mut sum, mut k) = (BigInt::ZERO, 0u32);
    while !power.is_zero() {
        let term = &power / (2 * k + 1);
        if alternating && k % 2 == 1 {
            sum -= term;
        } else {
            sum += term;
        }
        power /= &square;
        k += 1;
    }
    // each term is off by at most two units, and the rest is below the first term that vanished
    Ball { middle: sum, radius: BigInt::from(2 * k + 4), bits }
}

impl Ball {
    /// π = 16 atan(1/5) − 4 atan(1/239) (Machin 1706).
    pub(in super::super) fn pi(bits: Bits) -> Self {
        let term = |q, times: i64| of_reciprocal(q, true, bits + GUARD).scaled(&times.into());
        term(5, 16).plus(&term(239, -4)).at(bits)
    }

    /// ln 2 = 18 atanh(1/26) − 2 atanh(1/4801) + 8 atanh(1/8749).
    pub(super) fn ln_2(bits: Bits) -> Self {
        let term = |q, times: i64| of_reciprocal(q, false, bits + GUARD).scaled(&times.into());
        term(26, 18).plus(&term(4801, -2)).plus(&term(8749, 8)).at(bits)
    }

    /// The number as an integer plus a rest of at most one half in magnitude; only the midpoint matters.
    pub(super) fn nearest_integer(&self) -> BigInt {
        let half = BigInt::from(1) << (self.bits - 1);
        (&self.middle + half) >> self.bits
    }

    /// Σ c_k x^k over k = first, first + step, … where c_k = c_{k−step} · ratio(k), for |x| ≤ 1/2 and
    /// |ratio| ≤ 1: the rest is at most twice the last term.
    pub(super) fn series(&self, first: u32, step: u32, ratio: impl Fn(u32) -> (i64, i64)) -> Self {
        let square = |x: &Self| if step == 1 { x.clone() } else { x.product(x) };
        let forward = square(self);
        let mut term = if first == 0 { Self::integer(1, self.bits) } else { self.clone() };
        let mut sum = term.clone();
        let mut k = first;
        loop {
            k += step;
            let (numerator, denominator) = ratio(k);
            term = term.product(&forward);
            let share = super::Rational::new(numerator, denominator);
            term = term.scaled(&share);
            sum = sum.plus(&term);
            if term.middle.abs() <= BigInt::from(2) {
                let rest = (term.middle.abs() + &term.radius) * 2 + 1;
                return sum.widened(rest);
            }
        }
    }

    /// A product of numbers of order one, which cannot be too long.
    pub(super) fn product(&self, other: &Self) -> Self {
        let radius = self.middle.abs() * &other.radius
            + other.middle.abs() * &self.radius
            + &self.radius * &other.radius;
        let middle = (&self.middle * &other.middle) >> self.bits;
        Self { middle, radius: (radius >> self.bits) + 2, bits: self.bits }
    }
}
