//! Real values that satisfy equations and inequalities, looked for in floating point.
//!
//! Equations are met by Gauss–Newton steps of least length, with the damping of Levenberg and Marquardt (J. J. Moré,
//! *The Levenberg–Marquardt algorithm*, 1978), from several places. What is found is met as far as rounding tells, and
//! proves nothing; where nothing is found, it is not known that anything is there, and the report says so.

use super::eliminated::{least_step, product};
use super::evaluate::{Bounded, Evaluator};
use super::graph::Graph;
use super::inequalities::Demand;
use super::zero_test::sample;
use crate::id::{ExprId, SymbolId};
use crate::limits;

/// The places from which points are looked for.
const PLACES: u64 = 24;
/// The places from which points beside others are looked for, and how far these are apart.
const PLACES_BESIDE: u64 = 4;
const BESIDE: f64 = 1e-2;
/// Machines that are tried at each place for one that is as assumed.
const MACHINES: u64 = 40;
/// Steps from each.
const STEPS: usize = 80;
/// The damping at the first step, of the mean square of the rows.
const DAMPING: f64 = 1e-3;
/// The least of the damping: what is dependent does not divide by zero.
const LEAST: f64 = 1e-14;
/// What equations may be beside the bound of their rounding: an end of the iteration is at some roundings of it.
const ROUNDINGS: f64 = 64.0;
/// What is above 0 is so by as many bounds of its rounding: beside it points are met that are none.
const MARGIN: f64 = 1e9;
/// Steps that are so small beside the start lead to a point that is as good as met.
const NEAR: f64 = 1e-12;
/// What is left of a positive number at least, beside its value at the start.
const DISTANCE: f64 = 1e-4;
/// The work that is spent.
const WORK: u64 = 20_000_000;

/// Equations with what moves them.
pub(super) struct Search {
    pub(super) symbols: Vec<SymbolId>,
    equations: Evaluator,
    /// ∂f/∂symbol, a row for each equation.
    slopes: Evaluator,
    inequalities: Evaluator,
    demands: Vec<Demand>,
}

impl Graph {
    /// Whether real values are found that satisfy the demands, as far as rounding tells.
    pub fn real_point_is_found(&mut self, demands: &[(ExprId, Demand)]) -> bool {
        let found = limits::attempt(WORK, || {
            let mut search = Search::of(self, demands);
            (0..PLACES).any(|place| search.point_from(place).is_some())
        });
        found.unwrap_or(false)
    }
}

/// A real point, by its symbols.
pub(crate) type Point = Vec<(SymbolId, f64)>;

/// Real points where demands are met near to points where further functions are zero besides, as far as rounding tells.
pub(crate) fn real_points_beside(
    graph: &mut Graph,
    demands: &[(ExprId, Demand)],
    functions: &[ExprId],
) -> Vec<Point> {
    let zeros = functions.iter().map(|function| (*function, Demand::Zero));
    let there: Vec<(ExprId, Demand)> = demands.iter().copied().chain(zeros).collect();
    let (mut on, mut beside) = (Search::of(graph, &there), Search::of(graph, demands));
    let places = (0..PLACES_BESIDE).filter_map(|place| {
        let met = on.point_from(place)?;
        let moved = |symbol: &SymbolId| {
            let index = on.symbols.iter().position(|known| known == symbol)?;
            Some(met[index] + BESIDE * sample(place + 2, index))
        };
        let start = beside.symbols.iter().map(moved).collect::<Option<Vec<f64>>>()?;
        let point = beside.point_near(&start)?;
        Some(beside.symbols.iter().copied().zip(point).collect())
    });
    places.collect()
}

impl Search {
    /// The search for where demands are met.
    pub(super) fn of(graph: &mut Graph, demands: &[(ExprId, Demand)]) -> Self {
        let (equations, others): (Vec<_>, Vec<_>) =
            demands.iter().copied().partition(|(_, demand)| *demand == Demand::Zero);
        let equations: Vec<ExprId> = equations.into_iter().map(|(equation, _)| equation).collect();
        let (others, demands): (Vec<ExprId>, Vec<Demand>) = others.into_iter().unzip();
        let all: Vec<ExprId> = equations.iter().chain(&others).copied().collect();
        let symbols = graph.symbols_in(&all);
        let mut slopes = Vec::with_capacity(equations.len() * symbols.len());
        for equation in &equations {
            slopes.extend(symbols.iter().map(|symbol| graph.partial(*equation, *symbol)));
        }
        Self {
            equations: graph.evaluator(&equations),
            slopes: graph.evaluator(&slopes),
            inequalities: graph.evaluator(&others),
            symbols,
            demands,
        }
    }

    fn at(evaluator: &mut Evaluator, symbols: &[SymbolId], point: &[f64]) -> Vec<Bounded> {
        evaluator.at(|symbol| symbols.iter().position(|known| *known == symbol).map_or(0.0, |k| point[k]))
    }

    /// Where they are met, looked for from one of the places.
    pub(super) fn point_from(&mut self, place: u64) -> Option<Vec<f64>> {
        let starts = (0..MACHINES).map(|machine| self.start(place, machine)).collect::<Vec<_>>();
        let met = starts.iter().find(|start| self.is_allowed(start)).cloned();
        self.point_near(met.as_ref().or_else(|| starts.first())?)
    }

    /// Where they are met, looked for from a point.
    fn point_near(&mut self, start: &[f64]) -> Option<Vec<f64>> {
        let mut point = start.to_owned();
        let mut size = self.size(&point)?;
        let first = size;
        let mut damping = DAMPING;
        for _ in 0..STEPS {
            if self.is_met(&point) && self.is_allowed(&point) {
                return Some(point);
            }
            let step = self.step(&point, damping)?;
            // where a factor is zero its product is as good as zero near to that
            let is_near = step.iter().zip(start).all(|(dx, x)| dx.abs() <= NEAR * x.abs());
            if is_near && size <= NEAR * NEAR * first && self.keeps_its_distance(&point, start) {
                return Some(point);
            }
            let next: Vec<f64> = point.iter().zip(&step).map(|(x, dx)| x - dx).collect();
            match self.size(&next) {
                Some(smaller) if smaller < size => {
                    (point, size) = (next, smaller);
                    damping = (damping * 0.1).max(LEAST);
                }
                _ => damping *= 10.0,
            }
            if damping > 1e12 {
                break;
            }
        }
        (self.is_met(&point) && self.is_allowed(&point)).then_some(point)
    }

    /// A place to start from: numbers of one or two digits, some of them from other decades.
    fn start(&self, place: u64, machine: u64) -> Vec<f64> {
        let seed = place + PLACES * machine;
        let number = |index: usize| {
            let number = sample(seed, index);
            if machine.is_multiple_of(2) { number.abs() } else { number * [1.0, 8.0, 0.1][(index + 1) % 3] }
        };
        (0..self.symbols.len()).map(number).collect()
    }

    fn size(&mut self, point: &[f64]) -> Option<f64> {
        let values = Self::at(&mut self.equations, &self.symbols, point);
        let size = values.iter().map(|f| f.value * f.value).sum::<f64>();
        size.is_finite().then_some(size)
    }

    fn is_met(&mut self, point: &[f64]) -> bool {
        let values = Self::at(&mut self.equations, &self.symbols, point);
        values.iter().all(|f| f.value.is_finite() && f.value.abs() <= ROUNDINGS * f.error)
    }

    fn is_allowed(&mut self, point: &[f64]) -> bool {
        let values = Self::at(&mut self.inequalities, &self.symbols, point);
        values.iter().zip(&self.demands).all(|(value, demand)| match demand {
            Demand::Positive => value.value > MARGIN * value.error,
            Demand::NotNegative => value.value >= -value.error,
            Demand::Nonzero => value.is_certainly_nonzero(),
            Demand::Zero => value.may_be_zero(),
        })
    }

    /// Whether inequalities are met, and not only by what is left of them on the way to where they are not.
    fn keeps_its_distance(&mut self, point: &[f64], start: &[f64]) -> bool {
        let before = Self::at(&mut self.inequalities, &self.symbols, start);
        let values = Self::at(&mut self.inequalities, &self.symbols, point);
        let keeps =
            values.iter().zip(&before).zip(&self.demands).all(|((value, before), demand)| match demand {
                Demand::Positive => value.value > DISTANCE * before.value.abs(),
                _ => true,
            });
        keeps && self.is_allowed(point)
    }

    /// J, a row for each equation.
    pub(super) fn slopes_at(&mut self, point: &[f64]) -> Vec<Vec<f64>> {
        let slopes = Self::at(&mut self.slopes, &self.symbols, point);
        let rows = slopes.chunks(self.symbols.len().max(1));
        rows.map(|row| row.iter().map(|slope| slope.value).collect()).collect()
    }

    /// Jᵀ (J Jᵀ + μ)⁻¹ f; nothing where there is nothing that could move.
    fn step(&mut self, point: &[f64], damping: f64) -> Option<Vec<f64>> {
        if self.symbols.is_empty() {
            return None;
        }
        let f = Self::at(&mut self.equations, &self.symbols, point);
        let rows = self.slopes_at(point);
        let mean = rows.iter().map(|row| product(row, row)).sum::<f64>()
            / f64::from(u32::try_from(rows.len()).ok()?);
        let (_, step) = least_step(&rows, f.iter().map(|f| f.value), damping * mean);
        Some(step).filter(|step| step.iter().all(|dx| dx.is_finite()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_found_where_there_are_some() {
        let mut g = Graph::new();
        let [x, y, a] = ["x", "y", "a"].map(|name| {
            let symbol = g.new_symbol(name);
            g.symbol(symbol)
        });
        let one = g.one();
        let (sin, cos, exp) = (g.sin(x), g.cos(y), g.apply(crate::algebra::Function::Exp, x));
        for (is_found, equation) in [
            (true, g.formula(x * x + y * y - a * a)),
            (false, g.formula(x * x + y * y + a * a)),
            // points of second order: the derivative vanishes there
            (true, g.formula(sin - one)),
            (true, g.formula(sin + cos - one - one)),
            // where a factor is zero, and beside an equation whose rounding ends the search
            (true, g.formula(x * y)),
            (true, g.formula(x * x * y)),
            // zero at infinity alone
            (false, exp),
            (false, g.formula(exp * exp + y * y)),
        ] {
            let demands = [(equation, Demand::Zero), (a, Demand::Positive)];
            assert_eq!(g.real_point_is_found(&demands), is_found, "{:?}", g.node(equation));
        }
        let (square, five) = (g.square(y), g.number(25));
        let speed = g.formula(square - five);
        assert!(g.real_point_is_found(&[(x, Demand::Zero), (speed, Demand::Zero)]));
        // nothing that could move, and nothing to be met
        assert!(!g.real_point_is_found(&[(five, Demand::Zero)]));
        assert!(g.real_point_is_found(&[(five, Demand::Positive)]) && g.real_point_is_found(&[]));
        assert!(g.real_point_is_found(&[(a, Demand::Positive)]));
        let negative = g.formula(-square - five);
        assert!(!g.real_point_is_found(&[(negative, Demand::Positive)]));
    }
}
