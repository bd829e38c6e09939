//! Intervals through functions, and back.

use super::images::{
    arccosine, arcsine, at, cosh, exactly, inverse_cosh, inverse_sinh, inverse_tanh, near_pi,
    sine_of_an_angle, sinh, tangent, tanh,
};
use super::{End, Interval, extreme};
use crate::algebra::ball::{Ball, Enclosed};
use crate::algebra::node::Function;
use crate::algebra::number::Rational;
use std::cmp::Ordering;

/// Angles beyond have sines that are not looked at.
const LARGEST_ANGLE: f64 = 1000.0;

impl Interval {
    /// The image under a function.
    pub(in super::super) fn function(&self, function: Function) -> Self {
        let one = || Rational::ONE;
        match function {
            Function::Sin => self.of_sine(&Rational::new(1, 2)),
            Function::Cos => self.of_sine(&Rational::ZERO),
            Function::Tanh => self.monotone(tanh, 0).meet(&Self::symmetric(one(), true)),
            Function::Sign => {
                let sign =
                    if self.is_positive() { Self::point(&one()) } else { Self::symmetric(one(), false) };
                Self { nonzero: self.is_nonzero(), ..sign }
            }
            Function::Exp => self.monotone(Ball::exp, 1).meet(&Self::positive()),
            Function::Sinh => self.monotone(sinh, 0),
            Function::Cosh => self
                .magnitude()
                .increasing(|x| if x.is_zero() { Some(exactly(1)) } else { at(x, cosh) })
                .meet(&Self::at_least(one()))
                .without_exclusion(),
            Function::Abs => self.magnitude(),
            Function::Atan => self.monotone(Ball::arctangent, 0).meet(&right_angle()),
            Function::Ln => {
                let domain = self.meet(&Self::positive());
                let image = |x: &Rational| match x {
                    x if x.is_one() => Some(exactly(0)),
                    x if x.is_zero() => None,
                    x => at(x, Ball::ln),
                };
                domain.increasing(image).without_exclusion()
            }
            Function::Asin => {
                let domain = self.meet(&Self::symmetric(one(), false));
                Self { nonzero: self.is_nonzero(), ..domain.increasing(arcsine).meet(&right_angle()) }
            }
            Function::Acos => {
                let falling = self.meet(&Self::symmetric(one(), false)).negative().without_exclusion();
                let image = falling.increasing(|x| arccosine(&-x.clone()));
                image.meet(&Self::not_negative().meet(&Self::below(Rational::new(16, 5), true)))
            }
        }
    }

    /// The image under an increasing function with a value at 0 that is known exactly.
    fn monotone(&self, f: fn(&Ball) -> Enclosed, at_zero: i64) -> Self {
        let image = self.increasing(|x| if x.is_zero() { Some(exactly(at_zero)) } else { at(x, f) });
        Self { nonzero: self.is_nonzero() && at_zero == 0, ..image }
    }

    /// The image under cos(x − turns π): values at the ends, and 1 and −1 where the interval may contain an angle that
    /// has them.
    fn of_sine(&self, turns: &Rational) -> Self {
        let all = Self::symmetric(Rational::ONE, false);
        let (Some(low), Some(high)) = (&self.low, &self.high) else { return all };
        let ends = [low.value.to_f64(), high.value.to_f64()];
        if !ends.iter().all(|end| end.abs() < LARGEST_ANGLE) {
            return all;
        }
        let (mut lowest, mut highest) = (Vec::new(), Vec::new());
        for end in [low, high] {
            let Some((below, above)) = sine_of_an_angle(&end.value, turns) else { return all };
            let open = end.open && below == above;
            lowest.push(End { value: below, open });
            highest.push(End { value: above, open });
        }
        let [first, last] = ends.map(|end| (end / std::f64::consts::PI).floor());
        if last - first > 3.0 {
            return all;
        }
        #[allow(clippy::cast_possible_truncation, reason = "small by the test above")]
        let (first, last) = (first as i64 - 2, last as i64 + 2);
        for multiple in first..=last {
            let (below, above) = near_pi(&(Rational::from(multiple) + turns.clone()));
            if above < low.value || below > high.value {
                continue;
            }
            let end = |value| End { value, open: false };
            match multiple % 2 {
                0 => highest.push(end(Rational::ONE)),
                _ => lowest.push(end(Rational::MINUS_ONE)),
            }
        }
        let (low, high) = (extreme(&lowest, Ordering::Less), extreme(&highest, Ordering::Greater));
        Self { low, high, nonzero: false }.rounded().meet(&all)
    }

    fn without_exclusion(self) -> Self {
        Self { nonzero: false, ..self }
    }

    /// Where a function takes values in `self`, for arguments in `known`.
    pub(in super::super) fn argument_of(&self, function: Function, known: &Self) -> Self {
        let unit = || Self::symmetric(Rational::ONE, false);
        match function {
            Function::Exp => self.meet(&Self::positive()).function(Function::Ln),
            Function::Ln => self.function(Function::Exp).meet(&Self::positive()),
            Function::Asin => {
                let angles = self.meet(&right_angle());
                Self { nonzero: self.is_nonzero(), ..angles.increasing(tame(Ball::sine)).meet(&unit()) }
            }
            Function::Acos => {
                let angles = self.meet(&Self::not_negative()).negative().without_exclusion();
                let mirrored = |x: &Rational| if x.is_zero() { Some(exactly(1)) } else { cosine_below_pi(x) };
                angles.increasing(mirrored).meet(&unit())
            }
            Function::Abs => self.unsigned(known),
            Function::Atan => self.back(tangent),
            Function::Sinh => self.back(|x| at(x, inverse_sinh)),
            Function::Tanh => self.back(inverse_tanh),
            Function::Cosh => {
                let size = self.meet(&Self::at_least(Rational::ONE)).without_exclusion();
                size.increasing(inverse_cosh).unsigned(known)
            }
            Function::Sign if self.is_positive() => Self::positive(),
            Function::Sign if self.negative().is_positive() => Self::positive().negative(),
            _ => Self::ALL,
        }
    }

    /// Where an increasing odd function takes values in `self`, by its inverse.
    fn back(&self, inverse: impl Fn(&Rational) -> Option<(Rational, Rational)>) -> Self {
        let image = self.increasing(|x| if x.is_zero() { Some(exactly(0)) } else { inverse(x) });
        Self { nonzero: self.is_nonzero(), ..image }
    }

    /// Where |x| is in `self`.
    fn unsigned(&self, known: &Self) -> Self {
        let size = self.meet(&Self::not_negative());
        match (&size.high, known.is_not_negative()) {
            _ if size.is_empty() => size,
            (_, true) => size,
            (Some(high), _) => Self::symmetric(high.value.clone(), high.open),
            _ => Self { nonzero: size.is_nonzero(), ..Self::ALL },
        }
    }
}

/// A little more than the angles from −π/2 to π/2.
fn right_angle() -> Interval {
    Interval::symmetric(Rational::new(157_079_633, 100_000_000), true)
}

/// A function that increases between −3/2 and 3/2, with 0 at 0; nothing is said beyond.
fn tame(f: fn(&Ball) -> Enclosed) -> impl Fn(&Rational) -> Option<(Rational, Rational)> {
    move |x| match x {
        x if x.is_zero() => Some(exactly(0)),
        x if x.abs() < Rational::new(3, 2) => at(x, f),
        _ => None,
    }
}

/// cos x for x from −3 to 0; nothing is said beyond.
fn cosine_below_pi(x: &Rational) -> Option<(Rational, Rational)> {
    if x.abs() < Rational::from(3) { at(x, Ball::cosine) } else { None }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::Residue;

    type Value = fn(f64) -> f64;

    fn values() -> [(Function, Value); 12] {
        [
            (Function::Sin, f64::sin),
            (Function::Cos, f64::cos),
            (Function::Asin, f64::asin),
            (Function::Acos, f64::acos),
            (Function::Atan, f64::atan),
            (Function::Sinh, f64::sinh),
            (Function::Cosh, f64::cosh),
            (Function::Tanh, f64::tanh),
            (Function::Exp, f64::exp),
            (Function::Ln, f64::ln),
            (Function::Abs, f64::abs),
            (Function::Sign, f64::signum),
        ]
    }

    fn around(x: f64, by: f64) -> Interval {
        let number = |x: f64| Rational::of_f64(x).expect("finite");
        Interval::above(number(x - by), false).meet(&Interval::below(number(x + by), false))
    }

    fn contains(interval: &Interval, x: f64) -> bool {
        let (low, high) = interval.to_f64();
        let margin = 1e-12 * (1.0 + x.abs());
        !interval.is_empty() && low - margin <= x && x <= high + margin
    }

    /// Values of points of an interval are in its image, and the points are where functions have these values.
    #[test]
    fn no_point_is_lost() {
        let random = |k: u64, scale: f64| {
            let word = Residue::mixed(k, 77).word() % 2_000_001;
            #[allow(clippy::cast_precision_loss, reason = "below 2^21")]
            let unit = word as f64 / 1_000_000.0 - 1.0;
            unit * scale
        };
        for (k, scale) in (0..400).zip([1.0, 3.0, 12.0].into_iter().cycle()) {
            let (x, by) = (random(4 * k, scale), random(4 * k + 1, scale / 2.0).abs());
            let inside = x + by * random(4 * k + 2, 1.0);
            for (function, f) in values() {
                let value = f(inside);
                if !value.is_finite() || inside == 0.0 {
                    continue;
                }
                let image = around(x, by).function(function);
                assert!(contains(&image, value), "{function:?} of {x} ± {by}: {value} in {image:?}");
                let back = around(value, by).argument_of(function, &Interval::ALL);
                assert!(contains(&back, inside), "{function:?}: {inside} where {value} ± {by}: {back:?}");
            }
        }
    }

    #[test]
    fn images_are_narrow() {
        for (function, [low, high], expected) in [
            (Function::Sin, [0.5, 2.5], [0.5_f64.sin(), 1.0]),
            (Function::Sin, [4.0, 6.0], [-1.0, 6.0_f64.sin()]),
            (Function::Cos, [-1.0, 0.5], [1.0_f64.cos(), 1.0]),
            (Function::Cos, [3.0, 9.0], [-1.0, 1.0]),
            (Function::Asin, [-2.0, 0.5], [-1.570_796_4, 0.5_f64.asin()]),
            (Function::Acos, [0.5, 3.0], [0.0, 0.5_f64.acos()]),
        ] {
            let image = around(f64::midpoint(low, high), (high - low) / 2.0).function(function).to_f64();
            let near = |a: f64, b: f64| (a - b).abs() < 1e-6;
            assert!(near(image.0, expected[0]) && near(image.1, expected[1]), "{function:?}: {image:?}");
        }
    }
}
