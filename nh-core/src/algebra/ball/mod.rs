//! Real numbers with rigorous error bounds, to any number of digits: a midpoint and a radius, both
//! integer multiples of 2^−p (F. Johansson, *Arb: efficient arbitrary-precision midpoint-radius interval
//! arithmetic*, 2017, in fixed point). Every operation encloses the exact result; what a
//! ball can no longer decide is decided with more digits.

mod elementary;
mod series;

use super::number::Rational;
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, Zero};

/// Binary digits behind the point.
pub(super) type Bits = u64;

/// Results with more bits than this are not computed.
const LONGEST: u64 = 1 << 18;

/// Every number whose distance from `middle` is at most `radius`, in units of 2^−`bits`.
#[derive(Clone, Debug)]
pub(super) struct Ball {
    middle: BigInt,
    radius: BigInt,
    bits: Bits,
}

/// Why an operation has no enclosure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum NoBall {
    /// No number of the ball is in the domain of the operation.
    Undefined,
    /// The ball is too wide; more digits may help.
    TooWide,
    /// The result has too many digits in front of the point.
    TooLong,
}

pub(super) type Enclosed = Result<Ball, NoBall>;

impl Ball {
    /// An integer.
    pub(super) fn integer(value: impl Into<BigInt>, bits: Bits) -> Self {
        Self { middle: value.into() << bits, radius: BigInt::ZERO, bits }
    }

    /// A rational number.
    pub(super) fn of(value: &Rational, bits: Bits) -> Self {
        let (middle, rest) = (value.numerator() << bits).div_mod_floor(&value.denominator());
        Self { middle, radius: BigInt::from(u8::from(!rest.is_zero())), bits }
    }

    fn between(low: &BigInt, high: &BigInt, bits: Bits) -> Self {
        let middle: BigInt = (low + high) >> 1u8;
        let radius = high - &middle;
        Self { middle, radius, bits }
    }

    fn low(&self) -> BigInt {
        &self.middle - &self.radius
    }

    fn high(&self) -> BigInt {
        &self.middle + &self.radius
    }

    /// The same number to other digits.
    pub(super) fn at(&self, bits: Bits) -> Self {
        if bits >= self.bits {
            let more = bits - self.bits;
            return Self { middle: &self.middle << more, radius: &self.radius << more, bits };
        }
        let less = self.bits - bits;
        Self { middle: &self.middle >> less, radius: (&self.radius >> less) + 2, bits }
    }

    /// Every number that is at most `by` units farther away.
    fn widened(mut self, by: impl Into<BigInt>) -> Self {
        self.radius += by.into();
        self
    }

    /// Whether every number of the ball is positive.
    pub(super) fn is_positive(&self) -> bool {
        self.low().is_positive()
    }

    /// Whether every number of the ball is negative.
    pub(super) fn is_negative(&self) -> bool {
        self.high().is_negative()
    }

    /// Whether zero is not in the ball.
    pub(super) fn is_nonzero(&self) -> bool {
        self.is_positive() || self.is_negative()
    }

    /// Whether every number of the ball is below 2^`exponent` in magnitude.
    pub(super) fn is_below(&self, exponent: i64) -> bool {
        let bits = i64::try_from((self.middle.abs() + &self.radius).bits()).unwrap_or(i64::MAX);
        bits.saturating_sub(i64::try_from(self.bits).unwrap_or(i64::MAX)) <= exponent
    }

    /// The least and the greatest number.
    pub(super) fn ends(&self) -> (Rational, Rational) {
        let unit = BigInt::one() << self.bits;
        let end = |x: BigInt| Rational::from_big(x, unit.clone()).unwrap_or(Rational::ZERO);
        (end(self.low()), end(self.high()))
    }

    /// The midpoint, rounded.
    pub(super) fn to_f64(&self) -> f64 {
        Rational::from_big(self.middle.clone(), BigInt::one() << self.bits).map_or(f64::NAN, |q| q.to_f64())
    }

    /// The midpoint to 80 binary digits, where 72 of them are known.
    pub(super) fn leading_digits(&self) -> Option<Rational> {
        const GIVEN: u64 = 80;
        const KNOWN: u64 = 72;
        let length = self.middle.bits();
        if self.radius.bits() + KNOWN > length {
            return None;
        }
        let spare = length.saturating_sub(GIVEN).min(self.bits);
        Rational::from_big(&self.middle >> spare, BigInt::one() << (self.bits - spare))
    }

    fn checked(self) -> Enclosed {
        if self.middle.bits() + self.radius.bits() > LONGEST { Err(NoBall::TooLong) } else { Ok(self) }
    }

    /// Its digits.
    pub(super) fn bits(&self) -> Bits {
        self.bits
    }

    pub(super) fn plus(&self, other: &Self) -> Self {
        Self { middle: &self.middle + &other.middle, radius: &self.radius + &other.radius, bits: self.bits }
    }

    pub(super) fn minus(&self, other: &Self) -> Self {
        self.plus(&other.negative())
    }

    pub(super) fn negative(&self) -> Self {
        Self { middle: -&self.middle, radius: self.radius.clone(), bits: self.bits }
    }

    /// |x|.
    pub(super) fn magnitude(&self) -> Self {
        if self.is_negative() {
            return self.negative();
        }
        if self.is_positive() {
            return self.clone();
        }
        Self::between(&BigInt::ZERO, &(self.middle.abs() + &self.radius), self.bits)
    }

    pub(super) fn times(&self, other: &Self) -> Enclosed {
        let radius = self.middle.abs() * &other.radius
            + other.middle.abs() * &self.radius
            + &self.radius * &other.radius;
        let middle = (&self.middle * &other.middle) >> self.bits;
        Self { middle, radius: (radius >> self.bits) + 2, bits: self.bits }.checked()
    }

    /// A rational multiple.
    pub(super) fn scaled(&self, by: &Rational) -> Self {
        let (numerator, denominator) = (by.numerator(), by.denominator());
        let middle = (&self.middle * &numerator).div_floor(&denominator);
        let radius = (&self.radius * numerator.abs()).div_ceil(&denominator);
        let radius = if denominator.is_one() { radius } else { radius + 1 };
        Self { middle, radius, bits: self.bits }
    }

    /// 1/x.
    pub(super) fn reciprocal(&self) -> Enclosed {
        if self.middle.is_zero() && self.radius.is_zero() {
            return Err(NoBall::Undefined);
        }
        if !self.is_nonzero() {
            return Err(NoBall::TooWide);
        }
        let one = BigInt::one() << (2 * self.bits);
        let nearest = self.middle.abs() - &self.radius;
        let radius = (&one * &self.radius).div_ceil(&(self.middle.abs() * nearest)) + 1;
        Self { middle: one.div_floor(&self.middle), radius, bits: self.bits }.checked()
    }

    pub(super) fn over(&self, other: &Self) -> Enclosed {
        self.times(&other.reciprocal()?)
    }

    /// x^n.
    pub(super) fn integer_power(&self, exponent: i64) -> Enclosed {
        if exponent < 0 {
            return self.integer_power(exponent.checked_neg().ok_or(NoBall::TooLong)?)?.reciprocal();
        }
        let (mut left, mut base, mut result) = (exponent, self.clone(), Self::integer(1, self.bits));
        while left > 0 {
            if left & 1 == 1 {
                result = result.times(&base)?;
            }
            left >>= 1;
            if left > 0 {
                base = base.times(&base)?;
            }
        }
        Ok(result)
    }

    /// The root of degree `degree`, of the part of the ball that has one.
    pub(super) fn root(&self, degree: u32) -> Enclosed {
        if self.is_negative() {
            return Err(NoBall::Undefined);
        }
        let shift = u64::from(degree - 1) * self.bits;
        let floor = |x: BigInt| (x << shift).nth_root(degree);
        let low = floor(self.low().max(BigInt::ZERO));
        let high = if self.high().is_zero() { BigInt::ZERO } else { floor(self.high()) + 1 };
        Ok(Self::between(&low, &high, self.bits))
    }

    /// x^(n/d), defined for x ≥ 0 unless d = 1.
    pub(super) fn power(&self, exponent: &Rational) -> Enclosed {
        const LONG_ROOT: i64 = 8;
        match exponent.to_small() {
            Some((n, 1)) => self.integer_power(n),
            Some((n, d)) if d <= LONG_ROOT => {
                self.root(u32::try_from(d).map_err(|_| NoBall::TooLong)?)?.integer_power(n)
            }
            _ => self.ln()?.scaled(exponent).exp(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A ball around a known number with a radius of a few units.
    fn encloses(ball: &Ball, decimal: &str) {
        let digits = decimal.trim_start_matches('-').replace('.', "");
        let places = decimal.split_once('.').map_or(0, |(_, places)| places.len());
        let numerator: BigInt = digits.parse().unwrap();
        let numerator = if decimal.starts_with('-') { -numerator } else { numerator };
        let ten = BigInt::from(10).pow(u32::try_from(places).unwrap());
        let exact = Rational::from_big(numerator, ten.clone()).unwrap();
        let unit = Rational::from_big(1.into(), ten).unwrap();
        let difference = ball.minus(&Ball::of(&exact, ball.bits));
        let bound = Ball::of(&unit, ball.bits).widened(1);
        assert!(difference.middle.abs() <= bound.high() + &ball.radius, "{ball:?} is not {decimal}");
        assert!(ball.radius.bits() < 40, "{} is wide for {decimal}", ball.radius);
    }

    #[test]
    fn functions_have_their_digits() {
        let n = |value: i64| Ball::integer(value, 256);
        let q = |a, b| Ball::of(&Rational::new(a, b), 256);
        encloses(&Ball::pi(256), "3.1415926535897932384626433832795028841971693993751");
        encloses(&n(1).exp().unwrap(), "2.7182818284590452353602874713526624977572470936999");
        encloses(&n(-30).exp().unwrap(), "0.0000000000000935762296884017460491583222");
        encloses(&n(2).ln().unwrap(), "0.69314718055994530941723212145817656807550013436025");
        encloses(&n(10).ln().unwrap(), "2.3025850929940456840179914546843642076011014886287");
        encloses(&q(1, 1000).ln().unwrap(), "-6.90775527898213705205397436405309262280330");
        encloses(&n(1).sine().unwrap(), "0.84147098480789650665250232163029899962256306079837");
        encloses(&n(22).cosine().unwrap(), "-0.99996082639463712646");
        encloses(&n(2).root(2).unwrap(), "1.4142135623730950488016887242096980785696718753769");
        encloses(&n(1).arctangent().unwrap(), "0.78539816339744830961566084581987572104929234984377");
        encloses(&n(-50).arctangent().unwrap(), "-1.550798992821746086170568494738154954149351501001");
        encloses(&q(1, 2).arcsine().unwrap(), "0.52359877559829887307710723054658381403286156656251");
        encloses(&q(1, 3).power(&Rational::new(3, 11)).unwrap(), "0.741098648791918918341186518303847");
        encloses(&n(7).over(&n(3)).unwrap(), "2.3333333333333333333333333333333333333333333333333");
    }

    #[test]
    fn what_is_undefined_is_told_from_what_is_too_wide() {
        let zero = Ball::integer(0, 64);
        assert_eq!(zero.reciprocal().unwrap_err(), NoBall::Undefined);
        assert_eq!(zero.clone().widened(1).reciprocal().unwrap_err(), NoBall::TooWide);
        assert_eq!(Ball::integer(-1, 64).root(2).unwrap_err(), NoBall::Undefined);
        assert_eq!(Ball::integer(-1, 64).ln().unwrap_err(), NoBall::Undefined);
        assert_eq!(Ball::integer(2, 64).arcsine().unwrap_err(), NoBall::Undefined);
        for large in [30_000i64, 1 << 40] {
            assert_eq!(Ball::integer(large, 64).exp().unwrap_err(), NoBall::TooLong);
        }
        assert!(zero.widened(5).root(2).is_ok());
    }
}
