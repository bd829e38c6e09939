//! Elementary functions: the argument is reduced, a series summed, and the reduction undone, with the
//! error carried along by the arithmetic.

use super::series::GUARD;
use super::{Ball, Enclosed, NoBall, Rational};
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{Signed, ToPrimitive, Zero};

/// Halvings of an argument before a series, undone by doublings afterwards.
const HALVINGS: u32 = 8;

impl Ball {
    /// The midpoint alone, to more digits, and the radius.
    fn exact_middle(&self, more: u64) -> Self {
        Self { middle: self.middle.clone(), radius: BigInt::ZERO, bits: self.bits }.at(self.bits + more)
    }

    fn half_power(&self, times: u32) -> Self {
        self.scaled(&Rational::new(1, 1 << times))
    }

    /// eˣ = 2^k e^r; e^(m ± ρ) is within 2 ρ e^m of e^m for ρ < 1.
    pub(in super::super) fn exp(&self) -> Enclosed {
        // beyond it, digits in front of the point alone would take seconds
        const LARGEST: i64 = 20_000;
        let whole = self.nearest_integer().to_i64().filter(|n| n.abs() < LARGEST);
        let Some(whole) = whole else {
            let none = Self::integer(0, self.bits);
            return if self.is_negative() { Ok(none.widened(1)) } else { Err(NoBall::TooLong) };
        };
        if self.radius >= BigInt::from(1) << self.bits {
            return Err(NoBall::TooWide);
        }
        let long = u64::try_from(whole.max(0) * 3 / 2).unwrap_or(0);
        let argument = self.exact_middle(GUARD + long);
        let ln_2 = Self::ln_2(argument.bits + 20);
        let k = argument.at(ln_2.bits).over(&ln_2)?.nearest_integer();
        let turns = k.to_i64().unwrap_or(0);
        let rest = argument.at(ln_2.bits).minus(&ln_2.scaled(&turns.into()));
        let mut value = rest.half_power(HALVINGS).series(0, 1, |k| (1, i64::from(k)));
        for _ in 0..HALVINGS {
            value = value.product(&value);
        }
        let power = if turns >= 0 {
            Self { middle: value.middle << turns, radius: value.radius << turns, bits: value.bits }
        } else {
            let down = turns.unsigned_abs();
            Self { middle: value.middle >> down, radius: (value.radius >> down) + 2, bits: value.bits }
        };
        let power = power.at(self.bits);
        let spread = (power.high() * &self.radius * 2u8) >> self.bits;
        power.widened(spread + 1).checked()
    }

    /// ln x = k ln 2 + 2 atanh((m − 1)/(m + 1)); the distance to ln of the midpoint is at most ρ/(m − ρ).
    pub(in super::super) fn ln(&self) -> Enclosed {
        if self.is_negative() || (self.middle.is_zero() && self.radius.is_zero()) {
            return Err(NoBall::Undefined);
        }
        if !self.is_positive() {
            return Err(NoBall::TooWide);
        }
        let size = i64::try_from(self.middle.bits()).unwrap_or(i64::MAX);
        let k = size - i64::try_from(self.bits).unwrap_or(i64::MAX);
        // 1/2 ≤ m < 1
        let bits = self.bits + GUARD + k.unsigned_abs();
        let middle = self.exact_middle(bits - self.bits);
        let mantissa = if k >= 0 {
            Self { middle: middle.middle >> k, radius: 1.into(), bits }
        } else {
            Self { middle: middle.middle << k.unsigned_abs(), ..middle }
        };
        // the roots of m come near 1: ln m = 2^n ln m^(1/2^n)
        let mut root = mantissa;
        for _ in 0..HALVINGS {
            root = root.root(2)?;
        }
        let one = Self::integer(1, bits);
        let ratio = root.minus(&one).over(&root.plus(&one))?;
        let area = ratio.series(1, 2, |k| (i64::from(k) - 2, i64::from(k)));
        let scaled = area.scaled(&(i64::from(2) << HALVINGS).into());
        let value = scaled.plus(&Self::ln_2(bits).scaled(&k.into())).at(self.bits);
        let spread = (&self.radius << self.bits).div_ceil(&self.low());
        Ok(value.widened(spread + 1))
    }

    /// Sine and cosine together.
    fn circle(&self) -> Result<(Self, Self), NoBall> {
        let long = self.middle.bits().saturating_sub(self.bits);
        let argument = self.exact_middle(GUARD + long);
        let half_pi = Self::pi(argument.bits).half_power(1);
        let quarter = argument.over(&half_pi)?.nearest_integer();
        let turned =
            Self { middle: &half_pi.middle * &quarter, radius: &half_pi.radius * quarter.abs(), ..half_pi };
        let rest = argument.minus(&turned).half_power(HALVINGS);
        let product = |k: u32| (-1, i64::from(k) * i64::from(k - 1));
        let (mut sine, mut cosine) = (rest.series(1, 2, product), rest.series(0, 2, product));
        for _ in 0..HALVINGS {
            let double = sine.product(&cosine).scaled(&2.into());
            let one = Self::integer(1, cosine.bits);
            cosine = cosine.product(&cosine).scaled(&2.into()).minus(&one);
            sine = double;
        }
        let (sine, cosine) = match quarter.mod_floor(&4.into()).to_u8() {
            Some(0) => (sine, cosine),
            Some(1) => (cosine, sine.negative()),
            Some(2) => (sine.negative(), cosine.negative()),
            _ => (cosine.negative(), sine),
        };
        let near = |value: Self| value.at(self.bits).widened(self.radius.clone());
        Ok((near(sine), near(cosine)))
    }

    pub(in super::super) fn sine(&self) -> Enclosed {
        Ok(self.circle()?.0)
    }

    pub(in super::super) fn cosine(&self) -> Enclosed {
        Ok(self.circle()?.1)
    }

    /// atan x, by atan x = π/2 − atan(1/x) beyond 1 and atan x = 2 atan(x/(1 + √(1 + x²))).
    pub(in super::super) fn arctangent(&self) -> Enclosed {
        let argument = self.exact_middle(GUARD);
        let one = Self::integer(1, argument.bits);
        let is_large = argument.middle.abs() > one.middle;
        let mut x = if is_large { argument.reciprocal()? } else { argument.clone() };
        for _ in 0..HALVINGS {
            let hypotenuse = one.plus(&x.product(&x)).root(2)?;
            x = x.over(&one.plus(&hypotenuse))?;
        }
        let angle = x.series(1, 2, |k| (2 - i64::from(k), i64::from(k)));
        let angle = angle.scaled(&(1i64 << HALVINGS).into());
        let angle = if is_large {
            let quarter = Self::pi(argument.bits).half_power(1);
            let quarter = if argument.middle.is_negative() { quarter.negative() } else { quarter };
            quarter.minus(&angle)
        } else {
            angle
        };
        Ok(angle.at(self.bits).widened(self.radius.clone()))
    }

    /// asin x = 2 atan(x/(1 + √(1 − x²))).
    pub(in super::super) fn arcsine(&self) -> Enclosed {
        let one = Self::integer(1, self.bits);
        let opposite = one.minus(&self.times(self)?);
        let adjacent = one.plus(&opposite.root(2)?);
        Ok(self.over(&adjacent)?.arctangent()?.scaled(&2.into()))
    }

    /// acos x = π/2 − asin x.
    pub(in super::super) fn arccosine(&self) -> Enclosed {
        Ok(Self::pi(self.bits).half_power(1).minus(&self.arcsine()?))
    }

    /// The angle of the point (x, y) in (−π, π].
    pub(in super::super) fn angle(y: &Self, x: &Self) -> Enclosed {
        let quarter = Self::pi(x.bits).half_power(1);
        if x.is_positive() {
            return y.over(x)?.arctangent();
        }
        if y.is_positive() {
            return Ok(quarter.minus(&x.over(y)?.arctangent()?));
        }
        if y.is_negative() {
            return Ok(quarter.plus(&x.over(y)?.arctangent()?).negative());
        }
        let is_zero = |z: &Self| z.middle.is_zero() && z.radius.is_zero();
        match (is_zero(y), is_zero(x), x.is_negative()) {
            (true, true, _) => Err(NoBall::Undefined),
            (true, _, true) => Ok(Self::pi(x.bits)),
            _ => Err(NoBall::TooWide),
        }
    }
}
