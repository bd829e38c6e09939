//! Intervals of real numbers with exact ends, open or closed: what inequalities are propagated through.

mod images;
mod through_functions;

use self::images::{power, signed_power};
use super::ball::Ball;
use super::number::Rational;
use crate::limits;
use std::cmp::Ordering;

/// One end of an interval.
#[derive(Clone, Debug, PartialEq)]
struct End {
    value: Rational,
    /// Whether the value itself is left out.
    open: bool,
}

/// The numbers between two ends; without an end there is no bound.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Interval {
    low: Option<End>,
    high: Option<End>,
    /// Zero is left out.
    nonzero: bool,
}

/// Longer ends are rounded outwards.
const LONGEST: u64 = 512;
/// The square of the length of an end that takes a step of work.
const BITS_SQUARED_PER_STEP: u64 = 1000;

impl Interval {
    pub(super) const ALL: Self = Self { low: None, high: None, nonzero: false };
    pub(super) const NONZERO: Self = Self { low: None, high: None, nonzero: true };

    fn above(value: Rational, open: bool) -> Self {
        Self { low: Some(End { value, open }), ..Self::ALL }
    }

    fn below(value: Rational, open: bool) -> Self {
        Self { high: Some(End { value, open }), ..Self::ALL }
    }

    pub(super) fn positive() -> Self {
        Self::above(Rational::ZERO, true)
    }

    pub(super) fn not_negative() -> Self {
        Self::above(Rational::ZERO, false)
    }

    pub(super) fn at_least(value: Rational) -> Self {
        Self::above(value, false)
    }

    pub(super) fn point(value: &Rational) -> Self {
        Self::above(value.clone(), false).meet(&Self::below(value.clone(), false))
    }

    /// Between −√(square) and √(square).
    pub(super) fn amplitude(square: &Rational) -> Self {
        let size = Self::point(square).power(&Rational::new(1, 2));
        match size.high {
            Some(end) => Self::symmetric(end.value, false),
            None => Self::ALL,
        }
    }

    fn symmetric(by: Rational, open: bool) -> Self {
        Self::above(-by.clone(), open).meet(&Self::below(by, open))
    }

    /// Everything in a ball.
    pub(super) fn of_ball(ball: &Ball) -> Self {
        let (low, high) = ball.ends();
        Self::above(low, false).meet(&Self::below(high, false))
    }

    /// Bounds in floating point, outwards.
    pub(super) fn to_f64(&self) -> (f64, f64) {
        let down = |end: &End| if end.value.is_zero() { 0.0 } else { end.value.to_f64().next_down() };
        let up = |end: &End| if end.value.is_zero() { 0.0 } else { end.value.to_f64().next_up() };
        (self.low.as_ref().map_or(f64::NEG_INFINITY, down), self.high.as_ref().map_or(f64::INFINITY, up))
    }

    pub(super) fn meet(&self, other: &Self) -> Self {
        let tighter = |a: &Option<End>, b: &Option<End>, wanted: Ordering| match (a, b) {
            (Some(x), Some(y)) => match x.value.cmp(&y.value) {
                Ordering::Equal => Some(End { value: x.value.clone(), open: x.open || y.open }),
                order if order == wanted => Some(x.clone()),
                _ => Some(y.clone()),
            },
            (one, None) | (None, one) => one.clone(),
        };
        Self {
            low: tighter(&self.low, &other.low, Ordering::Greater),
            high: tighter(&self.high, &other.high, Ordering::Less),
            nonzero: self.nonzero || other.nonzero,
        }
    }

    pub(super) fn is_empty(&self) -> bool {
        let (Some(low), Some(high)) = (&self.low, &self.high) else { return false };
        match low.value.cmp(&high.value) {
            Ordering::Less => false,
            Ordering::Equal => low.open || high.open || (self.nonzero && low.value.is_zero()),
            Ordering::Greater => true,
        }
    }

    /// The largest value, and whether it is left out.
    pub(super) fn highest(&self) -> Option<(Rational, bool)> {
        self.high.as_ref().map(|end| (end.value.clone(), end.open))
    }

    /// The smallest value, and whether it is left out.
    pub(super) fn lowest(&self) -> Option<(Rational, bool)> {
        self.low.as_ref().map(|end| (end.value.clone(), end.open))
    }

    pub(super) fn is_nonzero(&self) -> bool {
        self.nonzero || self.is_positive() || self.negative().is_positive()
    }

    fn is_positive(&self) -> bool {
        self.low
            .as_ref()
            .is_some_and(|low| !low.value.is_negative() && (!low.value.is_zero() || low.open || self.nonzero))
    }

    pub(super) fn is_not_negative(&self) -> bool {
        self.low.as_ref().is_some_and(|low| !low.value.is_negative())
    }

    fn negative(&self) -> Self {
        self.scaled(&Rational::MINUS_ONE)
    }

    /// Shortens ends, outwards.
    fn rounded(mut self) -> Self {
        for (end, up) in [(&mut self.low, false), (&mut self.high, true)] {
            let bits = end.as_ref().map_or(0, |end| end.value.bits());
            // lowest terms take the square of the length
            limits::spend(1 + usize::try_from(bits * bits / BITS_SQUARED_PER_STEP).unwrap_or(usize::MAX));
            if let Some(long) = end
                && bits > LONGEST
            {
                let near = long.value.to_f64();
                let outside = if up { near.next_up() } else { near.next_down() };
                *end = Rational::of_f64(outside).map(|value| End { value, open: true });
            }
        }
        self
    }

    pub(super) fn scaled(&self, by: &Rational) -> Self {
        if by.is_zero() {
            return Self::point(&Rational::ZERO);
        }
        let scale = |end: &Option<End>| {
            end.as_ref().map(|end| End { value: end.value.clone() * by.clone(), open: end.open })
        };
        let (low, high) = (scale(&self.low), scale(&self.high));
        let (low, high) = if by.is_negative() { (high, low) } else { (low, high) };
        Self { low, high, nonzero: self.nonzero }
    }

    pub(super) fn plus(&self, other: &Self) -> Self {
        let add = |a: &Option<End>, b: &Option<End>| {
            let (a, b) = a.as_ref().zip(b.as_ref())?;
            Some(End { value: a.value.clone() + b.value.clone(), open: a.open || b.open })
        };
        Self { low: add(&self.low, &other.low), high: add(&self.high, &other.high), nonzero: false }.rounded()
    }

    pub(super) fn times(&self, other: &Self) -> Self {
        let mut corners: Vec<End> = Vec::new();
        let (mut bounded_below, mut bounded_above) = (true, true);
        for (a, a_up) in [(&self.low, false), (&self.high, true)] {
            for (b, b_up) in [(&other.low, false), (&other.high, true)] {
                let is_zero = |end: &Option<End>| end.as_ref().is_some_and(|end| end.value.is_zero());
                let closed_zero =
                    |end: &Option<End>| is_zero(end) && end.as_ref().is_some_and(|end| !end.open);
                let corner = match (a, b) {
                    (Some(x), Some(y)) => {
                        let open = !(closed_zero(a) || closed_zero(b)) && (x.open || y.open);
                        Ok(End { value: x.value.clone() * y.value.clone(), open })
                    }
                    _ if is_zero(a) || is_zero(b) => {
                        Ok(End { value: Rational::ZERO, open: !(closed_zero(a) || closed_zero(b)) })
                    }
                    // infinite: with which sign
                    _ => {
                        let sign = |end: &Option<End>, up: bool| {
                            end.as_ref().map_or(up, |end| !end.value.is_negative())
                        };
                        Err(sign(a, a_up) == sign(b, b_up))
                    }
                };
                match corner {
                    Err(true) => bounded_above = false,
                    Err(false) => bounded_below = false,
                    Ok(end) => corners.push(end),
                }
            }
        }
        let low = if bounded_below { extreme(&corners, Ordering::Less) } else { None };
        let high = if bounded_above { extreme(&corners, Ordering::Greater) } else { None };
        let nonzero = self.is_nonzero() && other.is_nonzero();
        Self { low, high, nonzero }.rounded()
    }

    pub(super) fn reciprocal(&self) -> Self {
        if self.is_not_negative() {
            let low = match &self.high {
                None => End { value: Rational::ZERO, open: true },
                Some(end) => match end.value.recip() {
                    Some(value) => End { value, open: end.open },
                    None => return Self::NONZERO,
                },
            };
            let high =
                self.low.as_ref().and_then(|end| Some(End { value: end.value.recip()?, open: end.open }));
            return Self { low: Some(low), high, nonzero: true };
        }
        if self.negative().is_not_negative() {
            return self.negative().reciprocal().negative();
        }
        Self::NONZERO
    }

    /// |x|.
    fn magnitude(&self) -> Self {
        if self.is_not_negative() {
            return self.clone();
        }
        let mirrored = self.negative();
        if mirrored.is_not_negative() {
            return mirrored;
        }
        let high = match (&self.high, &mirrored.high) {
            (Some(a), Some(b)) => match a.value.cmp(&b.value) {
                Ordering::Equal => Some(End { value: a.value.clone(), open: a.open && b.open }),
                Ordering::Greater => Some(a.clone()),
                Ordering::Less => Some(b.clone()),
            },
            _ => None,
        };
        Self { high, nonzero: self.nonzero, ..Self::not_negative() }
    }

    /// x^exponent where it is defined.
    pub(super) fn power(&self, exponent: &Rational) -> Self {
        if exponent.is_negative() {
            return self.power(&-exponent.clone()).reciprocal();
        }
        let even = exponent.is_integer() && !exponent.has_odd_numerator();
        if exponent.is_integer() && !even {
            return self.increasing(|x| signed_power(x, exponent));
        }
        let base = if even { self.magnitude() } else { self.meet(&Self::not_negative()) };
        base.increasing(|x| power(x, exponent))
    }

    /// Where x^exponent is in `self`, for x in `known`.
    pub(super) fn base_of_power(&self, exponent: &Rational, known: &Self) -> Self {
        let Some(inverse) = exponent.recip() else { return Self::ALL };
        if exponent.is_negative() {
            return self.reciprocal().base_of_power(&-exponent.clone(), known);
        }
        if exponent.is_integer() && exponent.has_odd_numerator() {
            return self.increasing(|x| signed_power(x, &inverse));
        }
        let size = self.meet(&Self::not_negative());
        if size.is_empty() {
            return size;
        }
        let size = Self { nonzero: size.is_nonzero(), ..size.increasing(|x| power(x, &inverse)) };
        if !exponent.is_integer() || known.is_not_negative() {
            return size;
        }
        if known.negative().is_not_negative() {
            return size.negative();
        }
        let Some(high) = size.high else { return Self { nonzero: size.nonzero, ..Self::ALL } };
        Self { nonzero: size.nonzero, ..Self::symmetric(high.value, high.open) }
    }

    /// The image under an increasing function, given by enclosures of its values at the ends.
    fn increasing(&self, f: impl Fn(&Rational) -> Option<(Rational, Rational)>) -> Self {
        let image = |end: &Option<End>, up: bool| {
            let end = end.as_ref()?;
            let (low, high) = f(&end.value)?;
            let exact = low == high;
            Some(End { value: if up { high } else { low }, open: end.open && exact })
        };
        Self { low: image(&self.low, false), high: image(&self.high, true), nonzero: self.nonzero }.rounded()
    }
}

/// The smallest or largest end; of equal ones the closed.
fn extreme(ends: &[End], wanted: Ordering) -> Option<End> {
    let better = |one: End, other: &End| match other.value.cmp(&one.value) {
        Ordering::Equal => End { open: one.open && other.open, ..one },
        order if order == wanted => other.clone(),
        _ => one,
    };
    let (first, rest) = ends.split_first()?;
    Some(rest.iter().fold(first.clone(), better))
}
