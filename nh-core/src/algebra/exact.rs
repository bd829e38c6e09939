//! Algebraic numbers, decided: an enclosure, and a bound below which a number other than zero cannot be.
//!
//! A number is a quotient of algebraic integers, whose conjugates are bounded along with it: if it is not
//! zero, it is at least `(u^(D−1) l)^(−1)` in magnitude, where u bounds the conjugates of the numerator, l
//! those of the denominator, and D is the degree of the field (C. Burnikel, S. Funke, K. Mehlhorn,
//! S. Schirra, S. Schmitt, *A separation bound for real algebraic expressions*, ESA 2001).
//!
//! Logarithms and arcs of such numbers enter linearly, with rational coefficients. By Baker's theorem
//! (*Transcendental number theory*, theorem 2.1) a sum `β + Σ q ln α + Σ r arg γ` vanishes only if its three parts do; the
//! second does if the product of the powers is 1, the third if that of the powers of γ is positive and the
//! sum is less than a turn.

use super::ball::{Ball, Bits, Enclosed, NoBall};
use super::number::Rational;
use num_integer::Integer;

/// A real algebraic number.
#[derive(Clone, Debug)]
pub(super) struct Number {
    /// Where it is.
    pub(super) ball: Ball,
    /// The value, where it is rational.
    pub(super) rational: Option<Rational>,
    /// Bits of the conjugates of the numerator, and of the denominator.
    over: u64,
    under: u64,
}

/// Multiples of an arc up to which arcs are compared.
const LONGEST_ARC: u64 = 1000;

/// What is known of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Decision {
    /// It is zero.
    Zero,
    /// It is not zero.
    NonZero,
    /// With so many digits it can be decided.
    Digits(Bits),
}

/// The bits of log₂ n, rounded up.
fn logarithm(n: &num_bigint::BigInt) -> u64 {
    (n.magnitude() - u8::from(n.magnitude().bits() > 0)).bits()
}

impl Number {
    pub(super) fn of(value: &Rational, bits: Bits) -> Self {
        let (over, under) = (logarithm(&value.numerator()), logarithm(&value.denominator()));
        Self { ball: Ball::of(value, bits), rational: Some(value.clone()), over, under }
    }

    /// A rational result, unless it has too many digits.
    fn of_rational(value: Option<Rational>, bits: Bits) -> Option<Self> {
        let value = value.filter(|value| value.bits() <= Rational::MAX_BITS)?;
        Some(Self::of(&value, bits))
    }

    /// cos(turn · π), half an algebraic integer with conjugates up to 2.
    pub(super) fn cosine_of_part(turn: &Rational, bits: Bits) -> Result<Self, NoBall> {
        let ball = Ball::pi(bits + 16).scaled(turn).cosine()?.at(bits);
        Ok(Self { ball, rational: None, over: 1, under: 1 })
    }

    /// Σ c x.
    pub(super) fn sum<'a>(parts: impl Iterator<Item = (Rational, &'a Self)> + Clone, bits: Bits) -> Self {
        let rational = parts.clone().try_fold(Rational::ZERO, |sum, (coefficient, part)| {
            Some(sum + coefficient * part.rational.clone()?)
        });
        if let Some(exact) = Self::of_rational(rational, bits) {
            return exact;
        }
        let (mut ball, mut under, mut excess, mut count) = (Ball::integer(0, bits), 0u64, 0i128, 0u64);
        for (coefficient, part) in parts {
            let (n, d) = (logarithm(&coefficient.numerator()), logarithm(&coefficient.denominator()));
            ball = ball.plus(&part.ball.scaled(&coefficient));
            let (own_over, own_under) = (n.saturating_add(part.over), d.saturating_add(part.under));
            under = under.saturating_add(own_under);
            excess = excess.max(i128::from(own_over) - i128::from(own_under));
            count += 1;
        }
        let carry = u64::from(u64::BITS - count.saturating_sub(1).leading_zeros());
        let over = u64::try_from(i128::from(under) + excess).unwrap_or(u64::MAX).saturating_add(carry);
        Self { ball, rational: None, over, under }
    }

    pub(super) fn times(&self, other: &Self) -> Result<Self, NoBall> {
        let rational = self.rational.clone().zip(other.rational.clone()).map(|(a, b)| a * b);
        if let Some(exact) = Self::of_rational(rational, self.ball.bits()) {
            return Ok(exact);
        }
        Ok(Self {
            ball: self.ball.times(&other.ball)?,
            rational: None,
            over: self.over.saturating_add(other.over),
            under: self.under.saturating_add(other.under),
        })
    }

    pub(super) fn power(&self, exponent: i64) -> Result<Self, NoBall> {
        let rational = self.rational.as_ref().and_then(|value| value.pow(exponent));
        if let Some(exact) = Self::of_rational(rational, self.ball.bits()) {
            return Ok(exact);
        }
        let times = exponent.unsigned_abs();
        let (over, under) = (self.over.saturating_mul(times), self.under.saturating_mul(times));
        let ball = self.ball.integer_power(exponent)?;
        let (over, under) = if exponent < 0 { (under, over) } else { (over, under) };
        Ok(Self { ball, rational: None, over, under })
    }

    /// The root of a number that is not negative; it multiplies the degree of the field by its own.
    pub(super) fn root(&self, degree: u32) -> Result<Self, NoBall> {
        let (k, ball) = (u64::from(degree), self.ball.root(degree)?);
        let mean = |one: u64, rest: u64| one.saturating_add(rest.saturating_mul(k - 1)).div_ceil(k);
        Ok(if self.over >= self.under {
            Self { ball, rational: None, over: mean(self.over, self.under), under: self.under }
        } else {
            Self { ball, rational: None, over: self.over, under: mean(self.under, self.over) }
        })
    }

    /// Whether it is zero, in a field of the given degree.
    pub(super) fn decided(&self, degree: u64) -> Decision {
        if let Some(value) = &self.rational {
            return if value.is_zero() { Decision::Zero } else { Decision::NonZero };
        }
        if self.ball.is_nonzero() {
            return Decision::NonZero;
        }
        let bound = degree.saturating_sub(1).saturating_mul(self.over).saturating_add(self.under);
        match i64::try_from(bound).ok() {
            Some(bits) if self.ball.is_below(-bits - 1) => Decision::Zero,
            _ => Decision::Digits(bound.saturating_add(64)),
        }
    }
}

/// `algebraic + turns · π + Σ q ln α + Σ r arg(x + iy)`, q, r and turns rational.
#[derive(Clone, Debug)]
pub(super) struct Form {
    pub(super) algebraic: Number,
    pub(super) turns: Rational,
    pub(super) logarithms: Vec<(Rational, Number)>,
    pub(super) arcs: Vec<(Rational, [Number; 2])>,
}

impl Form {
    pub(super) fn rational(value: &Rational, bits: Bits) -> Self {
        Self::of(Number::of(value, bits))
    }

    pub(super) fn of(algebraic: Number) -> Self {
        let turns = Rational::ZERO;
        Self { algebraic, turns, logarithms: Vec::new(), arcs: Vec::new() }
    }

    /// Whether it is algebraic.
    pub(super) fn is_algebraic(&self) -> bool {
        self.turns.is_zero() && self.logarithms.is_empty() && self.arcs.is_empty()
    }

    /// Whether the algebraic part is missing.
    pub(super) fn has_no_number(&self) -> bool {
        self.algebraic.rational.as_ref().is_some_and(Rational::is_zero)
    }

    pub(super) fn sum(parts: &[(Rational, &Self)], bits: Bits) -> Self {
        let numbers = parts.iter().map(|(c, part)| (c.clone(), &part.algebraic));
        let mut form = Self::of(Number::sum(numbers, bits));
        for (c, part) in parts {
            form.turns = form.turns + c.clone() * part.turns.clone();
            form.logarithms.extend(part.logarithms.iter().map(|(q, x)| (c.clone() * q.clone(), x.clone())));
            form.arcs.extend(part.arcs.iter().map(|(q, x)| (c.clone() * q.clone(), x.clone())));
        }
        form
    }

    /// A product of which all but one factor is algebraic, or rational if that one is not algebraic.
    pub(super) fn times(&self, other: &Self, bits: Bits) -> Result<Option<Self>, NoBall> {
        for (one, rest) in [(self, other), (other, self)] {
            if let Some(value) = &one.algebraic.rational
                && one.is_algebraic()
            {
                return Ok(Some(Self::sum(&[(value.clone(), rest)], bits)));
            }
        }
        if !(self.is_algebraic() && other.is_algebraic()) {
            return Ok(None);
        }
        Ok(Some(Self::of(self.algebraic.times(&other.algebraic)?)))
    }

    /// The ball of what is not algebraic.
    fn transcendental_part(&self, bits: Bits) -> Enclosed {
        let mut sum = Ball::pi(bits).scaled(&self.turns);
        for (q, x) in &self.logarithms {
            sum = sum.plus(&x.ball.ln()?.scaled(q));
        }
        Ok(sum.plus(&self.arc(bits)?))
    }

    fn arc(&self, bits: Bits) -> Enclosed {
        self.arcs.iter().try_fold(Ball::integer(0, bits), |sum, (q, [x, y])| {
            Ok(sum.plus(&Ball::angle(&y.ball, &x.ball)?.scaled(q)))
        })
    }

    pub(super) fn ball(&self, bits: Bits) -> Enclosed {
        if self.is_algebraic() {
            return Ok(self.algebraic.ball.clone());
        }
        Ok(self.algebraic.ball.plus(&self.transcendental_part(bits)?))
    }

    /// Whether it is zero, in a field of the given degree.
    pub(super) fn decided(&self, degree: u64, bits: Bits) -> Result<Decision, NoBall> {
        if self.is_algebraic() {
            return Ok(self.algebraic.decided(degree));
        }
        if self.ball(bits)?.is_nonzero() {
            return Ok(Decision::NonZero);
        }
        let parts = [
            self.algebraic.decided(degree),
            self.product_of_logarithms(bits)?.decided(degree),
            self.sum_of_arcs(degree, bits)?,
        ];
        let digits = parts.iter().filter_map(|part| match part {
            Decision::Zero => None,
            // the whole is not zero either, and shows it with more digits
            Decision::NonZero => Some(2 * bits),
            Decision::Digits(more) => Some((*more).max(2 * bits)),
        });
        Ok(digits.max().map_or(Decision::Zero, Decision::Digits))
    }

    /// Π α^(N q) − 1 with the common denominator N.
    fn product_of_logarithms(&self, bits: Bits) -> Result<Number, NoBall> {
        let one = Number::of(&Rational::ONE, bits);
        let (exponents, _) = whole(self.logarithms.iter().map(|(q, _)| q))?;
        let mut product = one.clone();
        for ((_, x), exponent) in self.logarithms.iter().zip(exponents) {
            product = product.times(&x.power(exponent)?)?;
        }
        Ok(Number::sum([(Rational::ONE, &product), (Rational::MINUS_ONE, &one)].into_iter(), bits))
    }

    /// Whether the arcs and the multiple of π add up to zero.
    fn sum_of_arcs(&self, degree: u64, bits: Bits) -> Result<Decision, NoBall> {
        if self.turns.is_zero() && self.arcs.is_empty() {
            return Ok(Decision::Zero);
        }
        let (exponents, factor) = whole(self.arcs.iter().map(|(q, _)| q).chain([&self.turns]))?;
        let (turns, exponents) = exponents.split_last().ok_or(NoBall::TooLong)?;
        let whole_arc = self.arc(bits)?.plus(&Ball::pi(bits).scaled(&self.turns)).scaled(&factor);
        let (zero, one) = (Number::of(&Rational::ZERO, bits), Number::of(&Rational::ONE, bits));
        let mut product = [one, zero];
        for ((_, [x, y]), exponent) in self.arcs.iter().zip(exponents) {
            let mirrored = Number::sum([(Rational::from(exponent.signum()), y)].into_iter(), bits);
            let factor = [x.clone(), mirrored];
            if exponent.unsigned_abs() > LONGEST_ARC {
                return Err(NoBall::TooLong);
            }
            for _ in 0..exponent.unsigned_abs() {
                product = complex_product(&product, &factor, bits)?;
            }
        }
        let real = if turns.is_odd() { product[0].ball.negative() } else { product[0].ball.clone() };
        let three = Ball::integer(3, bits);
        let is_short = whole_arc.magnitude().minus(&three).is_negative();
        Ok(match product[1].decided(degree) {
            Decision::Zero if is_short && real.is_positive() => Decision::Zero,
            Decision::Zero => Decision::Digits(2 * bits),
            other => other,
        })
    }
}

pub(super) fn complex_product(a: &[Number; 2], b: &[Number; 2], bits: Bits) -> Result<[Number; 2], NoBall> {
    let products = [a[0].times(&b[0])?, a[1].times(&b[1])?, a[0].times(&b[1])?, a[1].times(&b[0])?];
    let real =
        Number::sum([(Rational::ONE, &products[0]), (Rational::MINUS_ONE, &products[1])].into_iter(), bits);
    let imaginary =
        Number::sum([(Rational::ONE, &products[2]), (Rational::ONE, &products[3])].into_iter(), bits);
    Ok([real, imaginary])
}

/// Rational numbers over the greatest of which all are multiples, as integers that are not large; and what
/// they were multiplied by.
fn whole<'a>(numbers: impl Iterator<Item = &'a Rational> + Clone) -> Result<(Vec<i64>, Rational), NoBall> {
    const LARGEST: i64 = 100_000;
    let unit = numbers.clone().fold(Rational::ZERO, |unit, number| unit.gcd(&number.abs()));
    let factor = unit.recip().unwrap_or(Rational::ONE);
    let scaled = numbers.map(|number| (number.clone() * factor.clone()).to_i64());
    let whole = scaled.map(|n| n.filter(|n| n.abs() < LARGEST).ok_or(NoBall::TooLong));
    Ok((whole.collect::<Result<_, _>>()?, factor))
}
