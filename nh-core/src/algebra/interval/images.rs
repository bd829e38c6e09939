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
