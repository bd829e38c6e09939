//! Whether equations and inequalities are met near a point, where that is seen at once: then no proof that they contradict
//! each other is looked for.
//!
//! Newton's steps of least length, in floating point, in each symbol's own measure. A point counts where the equations
//! hold as far as rounding tells, their slopes are independent and not small beside their terms, and the inequalities are
//! met by more than a last step could change: a solution is then near it (L. V. Kantorovich's theorem, of which the second
//! derivatives are not bounded here). It refuses nothing and is told nowhere.

use super::eliminated::eliminated;
use super::evaluate::{Bounded, Evaluator};
use super::graph::Graph;
use super::inequalities::Demand;
use super::zero_test::sample;
use crate::id::{ExprId, SymbolId};
use crate::limits;

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
    /// Whether a regular point is found where demands are met that are equations, or among which there are some.
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
        (0..PLACES).any(|place| search.succeeds_from(place).is_some())
    }
}

impl Search<'_> {
    fn at(&mut self, point: &[f64]) -> Vec<Bounded> {
        let symbols = &self.symbols;
        self.all.at(|symbol| symbols.iter().position(|known| *known == symbol).map_or(0.0, |k| point[k]))
    }

    fn succeeds_from(&mut self, place: u64) -> Option<()> {
        let starts = (0..STARTS).map(|attempt| {
            let seed = place + PLACES * attempt;
            let number = |index| sample(seed, index);
            let signed = |index| if attempt.is_multiple_of(2) { number(index).abs() } else { number(index) };
            (0..self.symbols.len()).map(signed).collect::<Vec<f64>>()
        });
        let starts: Vec<Vec<f64>> = starts.collect();
        let mut point = starts.into_iter().find(|start| {
            let values = self.at(start);
            self.are_met_well(&values)
        })?;
        self.start.clone_from(&point);
        let mut last = f64::INFINITY;
        for _ in 0..STEPS {
            let values = self.at(&point);
            let equations = &values[..self.equations];
            if !equations.iter().all(|f| f.value.is_finite() && f.error > 0.0 && f.error.is_finite()) {
                return None;
            }
            let are_met = equations.iter().all(|f| f.value.abs() <= ROUNDINGS * f.error);
            let left = equations.iter().map(|f| (f.value / terms_of(f)).abs()).fold(0.0, f64::max);
            // what does not come nearer in a step is given up, unless it is only at its first
            if !are_met && left > 0.9 * last {
                return None;
            }
            last = if last.is_infinite() { 2.0 * left } else { left };
            let step = self.step(&point, &values)?;
            if are_met {
                return self.are_met_well(&values).then_some(());
            }
            for (x, dx) in point.iter_mut().zip(step) {
                *x -= dx;
            }
        }
        None
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

    /// Jᵀ (J Jᵀ)⁻¹ f where the slopes are steep and independent.
    fn step(&mut self, point: &[f64], values: &[Bounded]) -> Option<Vec<f64>> {
        let size = self.equations;
        let mut slopes = vec![vec![0.0; self.symbols.len()]; size];
        for k in 0..self.symbols.len() {
            let mut moved = point.to_vec();
            moved[k] += MOVED * self.start[k];
            let there = self.at(&moved);
            for ((row, f), g) in slopes.iter_mut().zip(values).zip(&there) {
                row[k] = (g.value - f.value) / MOVED;
            }
        }
        let length = |row: &[f64]| row.iter().map(|slope| slope * slope).sum::<f64>().sqrt();
        let lengths: Vec<f64> = slopes.iter().map(|row| length(row)).collect();
        if !lengths.iter().zip(values).all(|(length, f)| *length > STEEP * terms_of(f)) {
            return None;
        }
        for (row, length) in slopes.iter_mut().zip(&lengths) {
            for slope in row {
                *slope /= length;
            }
        }
        let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
        let with_value = |(row, (f, length)): (&Vec<f64>, (&Bounded, &f64))| {
            let products = slopes.iter().map(|other| product(row, other));
            products.chain([f.value / length]).collect::<Vec<f64>>()
        };
        limits::spend(size.pow(3));
        let (determinant, weights) =
            eliminated(slopes.iter().zip(values.iter().zip(&lengths)).map(with_value).collect());
        if determinant.is_nan() || determinant <= INDEPENDENT {
            return None;
        }
        let along =
            |k: usize| slopes.iter().zip(&weights).map(|(row, w)| row[k] * w).sum::<f64>() * self.start[k];
        Some((0..self.symbols.len()).map(along).collect::<Vec<f64>>())
            .filter(|step| step.iter().all(|dx| dx.is_finite()))
    }
}

/// The size of the terms of a value, by the bound of its rounding.
fn terms_of(value: &Bounded) -> f64 {
    value.error / f64::EPSILON
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_met_regularly_is_seen_and_nothing_else_is() {
        let mut g = Graph::new();
        let [x, y, a] = ["x", "y", "a"].map(|name| {
            let symbol = g.new_symbol(name);
            g.symbol(symbol)
        });
        let (one, two, tiny) =
            (g.one(), g.number(2), g.number(crate::algebra::Rational::new(1, 10_i64.pow(17))));
        let (sin, cos, exp) = (g.sin(x), g.cos(y), g.apply(crate::algebra::Function::Exp, x));
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
        ] {
            let mut demands: Vec<(ExprId, Demand)> =
                equations.iter().map(|equation| (*equation, Demand::Zero)).collect();
            demands.push((a, Demand::Positive));
            assert_eq!(g.are_met_at_a_regular_point(&demands), is_found, "{:?}", g.text(equations[0]));
        }
    }
}
