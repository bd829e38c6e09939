//! Enclosures of the values of functions at the ends of intervals.

use crate::algebra::ball::{Ball, Bits, Enclosed};
use crate::algebra::number::Rational;

/// Digits of ends that are not rational.
const DIGITS: Bits = 128;

/// An integer as a value that is known exactly.
pub(super) fn exactly(value: i64) -> (Rational, Rational) {
    (value.into(), value.into())
}

pub(super) fn at(x: &Rational, f: impl Fn(&Ball) -> Enclosed) -> Option<(Rational, Rational)> {
    f(&Ball::of(x, DIGITS)).ok().map(|ball| ball.ends())
}

/// x^exponent for x ≥ 0 and a positive exponent.
pub(super) fn power(x: &Rational, exponent: &Rational) -> Option<(Rational, Rational)> {
    if x.is_zero() || x.is_one() {
        return Some((x.clone(), x.clone()));
    }
    let exact = match exponent.to_small()? {
        (n, 1) => x.pow(n),
        (n, 2) => x.sqrt().and_then(|root| root.pow(n)),
        _ => None,
    };
    match exact {
        Some(value) => Some((value.clone(), value)),
        None => at(x, |ball| ball.power(exponent)),
    }
}

/// The same for odd powers and roots of both signs.
pub(super) fn signed_power(x: &Rational, exponent: &Rational) -> Option<(Rational, Rational)> {
    let (low, high) = power(&x.abs(), exponent)?;
    Some(if x.is_negative() { (-high, -low) } else { (low, high) })
}

pub(super) fn sinh(x: &Ball) -> Enclosed {
    Ok(x.exp()?.minus(&x.negative().exp()?).scaled(&Rational::new(1, 2)))
}

pub(super) fn cosh(x: &Ball) -> Enclosed {
    Ok(x.exp()?.plus(&x.negative().exp()?).scaled(&Rational::new(1, 2)))
}

pub(super) fn tanh(x: &Ball) -> Enclosed {
    let (up, down) = (x.exp()?, x.negative().exp()?);
    up.minus(&down).over(&up.plus(&down))
}

/// asin x, for x from −1 to 1.
pub(super) fn arcsine(x: &Rational) -> Option<(Rational, Rational)> {
    match x {
        x if x.is_zero() => Some(exactly(0)),
        x if x.abs().is_one() => Some(near_pi(&(x.clone() * Rational::new(1, 2)))),
        x => at(x, Ball::arcsine),
    }
}

/// acos x, for x from −1 to 1.
pub(super) fn arccosine(x: &Rational) -> Option<(Rational, Rational)> {
    match x {
        x if x.is_one() => Some(exactly(0)),
        x if x.abs().is_one() => Some(near_pi(&Rational::ONE)),
        x => at(x, Ball::arccosine),
    }
}

/// A multiple of π.
pub(super) fn near_pi(multiple: &Rational) -> (Rational, Rational) {
    Ball::pi(DIGITS).scaled(multiple).ends()
}

/// cos(x − turns π).
pub(super) fn sine_of_an_angle(x: &Rational, turns: &Rational) -> Option<(Rational, Rational)> {
    match (x.is_zero(), turns.is_zero()) {
        (true, true) => Some(exactly(1)),
        (true, false) => Some(exactly(0)),
        (false, true) => at(x, Ball::cosine),
        (false, false) => at(x, Ball::sine),
    }
}

/// tan x for x from −3/2 to 3/2; nothing is said beyond.
pub(super) fn tangent(x: &Rational) -> Option<(Rational, Rational)> {
    (x.abs() < Rational::new(3, 2)).then(|| at(x, |ball| ball.sine()?.over(&ball.cosine()?)))?
}

/// asinh x = ±ln(|x| + √(x² + 1)).
pub(super) fn inverse_sinh(x: &Ball) -> Enclosed {
    let one = Ball::integer(1, x.bits());
    let size = x.magnitude();
    let value = size.plus(&one.plus(&size.times(&size)?).root(2)?).ln()?;
    Ok(if x.is_negative() { value.negative() } else { value })
}

/// acosh x for x from 1.
pub(super) fn inverse_cosh(x: &Rational) -> Option<(Rational, Rational)> {
    if x.is_one() {
        return Some(exactly(0));
    }
    at(x, |ball| {
        let one = Ball::integer(1, ball.bits());
        ball.plus(&ball.times(ball)?.minus(&one).root(2)?).ln()
    })
}

/// atanh x between −1 and 1; no bound from there on.
pub(super) fn inverse_tanh(x: &Rational) -> Option<(Rational, Rational)> {
    if x.abs() >= Rational::ONE {
        return None;
    }
    at(x, |ball| {
        let one = Ball::integer(1, ball.bits());
        Ok(one.plus(ball).over(&one.minus(ball))?.ln()?.scaled(&Rational::new(1, 2)))
    })
}
