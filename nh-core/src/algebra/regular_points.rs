//! Whether equations and inequalities are met near a point, where that is seen at once: then no proof that they contradict
//! each other is looked for.
//!
//! Newton's steps of least length, in floating point, in each symbol's own measure. A point counts where the equations
//! hold as far as rounding tells, their slopes are independent and not small beside their terms, and the inequalities are
//! met by more than a last step could change: a solution is then near it (L. V. Kantorovich's theorem, of which the second
//! derivatives are not bounded here). It refuses nothing and is told nowhere.

use super::eliminated::{least_step, product};
use super::evaluate::{Bounded, Evaluator};
use super::graph::Graph;
use super::inequalities::Demand;
use super::zero_test::sample;
use crate::id::{ExprId, SymbolId};

/// The places that Newton's steps start from.
const PLACES: u64 = 2;
/// Points that are tried for one where the inequalities are met.
const STARTS: u64 = 12;
/// Steps from each.
const STEPS: usize = 8;
/// What a symbol is moved by to see the slopes, beside its value at the start: half of the digits.
const MOVED: f64 = 1.0 / (1 << 26) as f64;
/// What equations may be beside the bound of their rounding.
const ROUNDINGS: f64 = 64.0;
/// The least length of a slope beside the terms of its equation.
const STEEP: f64 = 1e-4;
/// The least determinant of the products of slopes of length 1.
const INDEPENDENT: f64 = 1e-6;
/// What is not 0 is so by as many bounds of its rounding.
const MARGIN: f64 = 1e9;

struct Search<'a> {
    symbols: Vec<SymbolId>,
    /// The equations, and what is demanded to be positive and the like behind them.
    all: Evaluator,
    equations: usize,
    demands: &'a [Demand],
    /// The value of each symbol at the start, which is its measure.
    start: Vec<f64>,
}

impl Graph {
    /// Whether a regular point is found where demands are met of which some are equations.
    pub(super) fn are_met_at_a_regular_point(&self, demands: &[(ExprId, Demand)]) -> bool {
        let (equations, others): (Vec<_>, Vec<_>) =
            demands.iter().copied().partition(|(_, demand)| *demand == Demand::Zero);
        let (all, wanted): (Vec<ExprId>, Vec<Demand>) = equations.iter().chain(&others).copied().unzip();
        let symbols = self.symbols_in(&all);
        if equations.is_empty() || equations.len() > symbols.len() {
            return false;
        }
        let mut search = Search {
            all: self.evaluator(&all),
            equations: equations.len(),
            demands: &wanted[equations.len()..],
            start: vec![0.0; symbols.len()],
            symbols,
        };
        (0..PLACES).any(|place| search.succeeds_from(place))
    }
}

impl Search<'_> {
    fn at(&mut self, point: &[f64]) -> Vec<Bounded> {
        let symbols = &self.symbols;
        self.all.at(|symbol| symbols.iter().position(|known| *known == symbol).map_or(0.0, |k| point[k]))
    }

    fn succeeds_from(&mut self, place: u64) -> bool {
        let Some((mut point, mut values)) = self.begun(place) else { return false };
        self.start.clone_from(&point);
        let mut permitted = f64::INFINITY;
        for step in 0..STEPS {
            let equations = &values[..self.equations];
            if !equations.iter().all(|f| f.value.is_finite() && f.error > 0.0 && f.error.is_finite()) {
                return false;
            }
            let are_met = equations.iter().all(|f| f.value.abs() <= ROUNDINGS * f.error);
            let left = equations.iter().map(|f| (f.value / terms_of(f)).abs()).fold(0.0, f64::max);
            if !are_met && left > permitted {
                return false;
            }
            // from far away the first one may lead beyond
            permitted = if step == 0 { 1.8 * left } else { 0.9 * left };
            let Some(change) = self.step(&point, &values) else { return false };
            if are_met {
                return self.are_met_well(&values);
            }
            for (x, dx) in point.iter_mut().zip(change) {
                *x -= dx;
            }
            values = self.at(&point);
        }
        false
    }

    /// A point where the inequalities are met, with the values there.
    fn begun(&mut self, place: u64) -> Option<(Vec<f64>, Vec<Bounded>)> {
        (0..STARTS).find_map(|attempt| {
            let number = |index| sample(place + PLACES * attempt, index);
            let signed = |index| if attempt.is_multiple_of(2) { number(index).abs() } else { number(index) };
            let point: Vec<f64> = (0..self.symbols.len()).map(signed).collect();
            let values = self.at(&point);
            self.are_met_well(&values).then_some((point, values))
        })
    }

    /// Whether inequalities are met by more than what is near could change.
    fn are_met_well(&self, values: &[Bounded]) -> bool {
        values[self.equations..].iter().zip(self.demands).all(|(value, demand)| {
            let far = MARGIN * value.error;
            match demand {
                Demand::Positive | Demand::NotNegative => value.value > far,
                Demand::Nonzero => value.value.abs() > far,
                Demand::Zero => false,
            }
        })
    }

    /// The least step that leads to where the equations hold, if their slopes are steep and independent.
    fn step(&mut self, point: &[f64], values: &[Bounded]) -> Option<Vec<f64>> {
        let mut slopes = vec![vec![0.0; self.symbols.len()]; self.equations];
        for k in 0..self.symbols.len() {
            let mut moved = point.to_vec();
            moved[k] += MOVED * self.start[k];
            let there = self.at(&moved);
            for ((row, f), g) in slopes.iter_mut().zip(values).zip(&there) {
                row[k] = (g.value - f.value) / MOVED;
            }
        }
        let lengths: Vec<f64> = slopes.iter().map(|row| product(row, row).sqrt()).collect();
        if !lengths.iter().zip(values).all(|(length, f)| *length > STEEP * terms_of(f)) {
            return None;
        }
        for (row, length) in slopes.iter_mut().zip(&lengths) {
            for slope in row {
                *slope /= length;
            }
        }
        let along_slopes = values.iter().zip(&lengths).map(|(f, length)| f.value / length);
        let (determinant, step) = least_step(&slopes, along_slopes, 0.0);
        let step: Vec<f64> = step.iter().zip(&self.start).map(|(dx, measure)| dx * measure).collect();
        (determinant > INDEPENDENT && step.iter().all(|dx| dx.is_finite())).then_some(step)
    }
}

/// The size of the terms of a value, by the bound of its rounding.
fn terms_of(value: &Bounded) -> f64 {
    value.error / f64::EPSILON
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::{Function, Rational};

    #[test]
    fn what_is_met_regularly_is_seen_and_nothing_else_is() {
        let mut g = Graph::new();
        let [x, y, a] = ["x", "y", "a"].map(|name| {
            let symbol = g.new_symbol(name);
            g.symbol(symbol)
        });
        let (one, two, tiny) = (g.one(), g.number(2), g.number(Rational::new(1, 10_i64.pow(17))));
        let (sin, cos, exp) = (g.sin(x), g.cos(y), g.apply(Function::Exp, x));
        for (is_found, equations) in [
            (true, vec![g.formula(x * x + y * y - a * a)]),
            (true, vec![g.formula(x * x + y * y - a * a), g.formula(x - y)]),
            (true, vec![g.formula(sin - cos * a)]),
            // where one follows from the other, nothing is seen
            (false, vec![g.formula(x - y), g.formula(two * x - two * y)]),
            (false, vec![g.formula(x - y), g.formula(x - y - tiny)]),
            // there is no point
            (false, vec![g.formula(x * x + y * y + a * a)]),
            (false, vec![g.formula(x * x - two * x + one + tiny)]),
            (false, vec![g.formula(sin - one - tiny)]),
            (false, vec![exp]),
            (false, vec![g.formula(exp - one + a * a), g.formula(x - y * y)]),
            // there is, and it is not regular
            (false, vec![g.formula(sin - one)]),
            // what is near to it does not meet a > 0
            (false, vec![g.formula(a + one)]),
            // one that is, however small
            (true, vec![g.formula(a - tiny * x * x)]),
        ] {
            let mut demands: Vec<(ExprId, Demand)> =
                equations.iter().map(|equation| (*equation, Demand::Zero)).collect();
            demands.push((a, Demand::Positive));
            assert_eq!(g.are_met_at_a_regular_point(&demands), is_found, "{:?}", g.text(equations[0]));
        }
    }

    /// At the very points that are tried, by less than rounding shows.
    #[test]
    fn what_nearly_holds_at_a_singular_point_is_not_taken_for_met() {
        let mut g = Graph::new();
        let [x, y] = ["x", "y"].map(|name| {
            let symbol = g.new_symbol(name);
            g.symbol(symbol)
        });
        let number = |value: f64| Rational::of_f64(value).unwrap();
        let tiny = Rational::new(1, 10_i64.pow(17));
        for place in 0..PLACES {
            let [a, b] = [0, 1].map(|index| number(sample(place, index).abs()));
            // (x − a)² + 10⁻¹⁷
            let (square, middle) = (g.square(x), g.scale(a.clone() + a.clone(), x));
            let above = g.number(a.clone() * a.clone() + tiny.clone());
            let touching = g.formula(square - middle + above);
            assert!(!g.are_met_at_a_regular_point(&[(touching, Demand::Zero)]));
            // x − y = a − b, and nearly the same once more
            let (near, difference) = (Rational::new(10_001, 10_000), a.clone() - b.clone());
            let (scaled, other) = (g.scale(near.clone(), y), g.number(a - near * b + tiny.clone()));
            let difference = g.number(difference);
            let lines = [g.formula(x - y - difference), g.formula(x - scaled - other)];
            assert!(!g.are_met_at_a_regular_point(&lines.map(|line| (line, Demand::Zero))));
            assert!(g.are_met_at_a_regular_point(&[(lines[0], Demand::Zero)]));
        }
    }
}
