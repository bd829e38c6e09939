//! How much rounding error programs of the same value accumulate.

use super::interpret::{Arithmetic, interpret_in};
use super::step::{Program, Step};
use crate::algebra::{Bounded, Function, Function2, Graph, Rational, Residue};
use crate::id::{ExprId, Id, SymbolId};
use std::borrow::Borrow;
use std::collections::BTreeSet;

/// An error of so many units in the last place counts as none.
pub(super) const FEW: f64 = 8.0;
/// Points at which programs are compared.
const POINTS: u32 = 16;

/// How many times larger the rounding error of each program is than that of the best of them: the
/// geometric mean over some points, for the worst of the outputs.
///
/// An error below a few units in the last place of the value counts as that. The mean, since at a point
/// where a value happens to be small the bounds of any two programs are far apart.
#[must_use]
pub fn error_growth<P: Borrow<Program>>(graph: &Graph, programs: &[P]) -> Vec<f64> {
    let outputs = programs.iter().map(|program| program.borrow().outputs.len()).min().unwrap_or(0);
    let mut logarithms = vec![vec![0.0; outputs]; programs.len()];
    for point in 0..POINTS {
        let on_base = OnBase::at(graph, point);
        let at = |symbol| Bounded { value: on_base.sample(symbol), error: 0.0 };
        let values: Vec<Vec<Bounded>> =
            programs.iter().map(|program| interpret_in(program.borrow(), at)).collect();
        for output in 0..outputs {
            let errors = values.iter().map(|values| values[output].error);
            let least = errors.filter(|error| error.is_finite()).fold(f64::INFINITY, f64::min);
            let floor = FEW * f64::EPSILON * values[0][output].value.abs();
            if !least.is_finite() || !floor.is_normal() {
                continue;
            }
            for (sums, values) in logarithms.iter_mut().zip(&values) {
                sums[output] += logarithm(values[output].error / least.max(floor));
            }
        }
    }
    let mean = |sum: f64| (sum / f64::from(POINTS)).exp();
    logarithms.into_iter().map(|sums| sums.into_iter().map(mean).fold(1.0, f64::max)).collect()
}

/// The logarithm of how many times larger an error is than another; a smaller one counts as equal.
pub(super) fn logarithm(growth: f64) -> f64 {
    if growth.is_nan() { f64::INFINITY } else { growth.max(1.0).ln() }
}

/// Points at which parameters lie far apart.
pub(super) const POINTS_APART: u32 = 32;
/// As many of them count as a program is at its worst at.
const WORST: usize = 3;

/// How many times larger the rounding error of each program is than that of the best of them where symbols lie up to
/// eight decades apart: the geometric mean over the points where it is at its worst, for the worst of the outputs.
/// What arguments of functions depend on stays of ordinary size.
///
/// Programs that are alike at ordinary sizes differ there by as many digits as there are: what forms a small difference
/// of large terms keeps nothing of it.
#[must_use]
pub fn error_growth_apart<P: Borrow<Program>>(graph: &Graph, programs: &[P]) -> Vec<f64> {
    let outputs = programs.iter().map(|program| program.borrow().outputs.len()).min().unwrap_or(0);
    let turning = turning(programs);
    let mut logarithms = vec![vec![Vec::new(); outputs]; programs.len()];
    for point in 0..POINTS_APART {
        let on_base = OnBase::at(graph, point);
        let at = |symbol| on_base.sample_apart(symbol, &turning);
        let values: Vec<Vec<Bounded>> = programs
            .iter()
            .map(|program| interpret_in(program.borrow(), |symbol| Bounded { value: at(symbol), error: 0.0 }))
            .collect();
        for output in 0..outputs {
            let best = values.iter().map(|values| values[output]).filter(|value| value.error.is_finite());
            let Some(best) = best.min_by(|a, b| a.error.total_cmp(&b.error)) else { continue };
            let floor = best.error.max(FEW * f64::EPSILON * best.value.abs());
            if !floor.is_normal() {
                continue;
            }
            for (logarithms, values) in logarithms.iter_mut().zip(&values) {
                logarithms[output].push(logarithm(values[output].error / floor));
            }
        }
    }
    logarithms.into_iter().map(|outputs| outputs.into_iter().map(worst).fold(1.0, f64::max)).collect()
}

/// The geometric mean where a program is at its worst.
pub(super) fn worst(mut logarithms: Vec<f64>) -> f64 {
    logarithms.sort_unstable_by(|a, b| b.total_cmp(a));
    logarithms.truncate(WORST);
    (logarithms.iter().sum::<f64>() / f64::from(u32::try_from(logarithms.len().max(1)).unwrap_or(1))).exp()
}

/// The symbols that arguments of functions depend on.
pub(super) fn turning<P: Borrow<Program>>(programs: &[P]) -> BTreeSet<SymbolId> {
    let mut found = BTreeSet::new();
    for program in programs {
        let marked = under_functions(program.borrow());
        found.extend(program.borrow().steps.iter_ids().filter_map(|(value, step)| match step {
            Step::Load(symbol) if marked[value.index()] => Some(*symbol),
            _ => None,
        }));
    }
    found
}

/// How much larger a symbol is made than all others.
const LARGE: f64 = 1e6;
/// As many steps are run for all symbols together.
const WORK: usize = 40_000;

/// The bound on the rounding error of each output in units in the last place, at the worst of the points where
/// one symbol is a million times its ordinary size. Terms that cancel identically show there. `fixed` symbols
/// are not made large, nor are those that arguments of functions depend on; in large programs only the first.
#[must_use]
pub fn units_lost(program: &Program, fixed: &[SymbolId]) -> Vec<f64> {
    let turned = under_functions(program);
    let loaded = program.steps.iter_ids().filter_map(|(value, step)| match step {
        Step::Load(symbol) if !fixed.contains(symbol) && !turned[value.index()] => Some(*symbol),
        _ => None,
    });
    let mut worst = vec![0.0_f64; program.outputs.len()];
    for large in loaded.take(WORK / program.steps.len().max(1)) {
        let at = |symbol| sample(0, symbol) * if symbol == large { LARGE } else { 1.0 };
        let values = interpret_in(program, |symbol| Bounded { value: at(symbol), error: 0.0 });
        for (worst, Bounded { value, error }) in worst.iter_mut().zip(values) {
            if error > 0.0 && error.is_finite() {
                *worst = worst.max(error / (f64::EPSILON * value.abs()));
            }
        }
    }
    worst
}

/// Whether the program of an output reads a symbol that its value does not depend on, as far as rounding tells.
#[must_use]
pub fn reading_in_vain(program: &Program) -> Vec<bool> {
    let run = |moved: Option<SymbolId>| -> Vec<Bounded> {
        let at = |symbol| sample(0, symbol) * if Some(symbol) == moved { 1.5 } else { 1.0 };
        interpret_in(program, |symbol| Bounded { value: at(symbol), error: 0.0 })
    };
    let before = run(None);
    let mut in_vain = vec![false; program.outputs.len()];
    for (symbol, reading) in read(program).take(WORK / program.steps.len().max(1)) {
        for (index, after) in run(Some(symbol)).into_iter().enumerate() {
            let moved = (after.value - before[index].value).abs();
            let is_read = reading[program.outputs[index].index()];
            in_vain[index] |= is_read && moved <= after.error + before[index].error;
        }
    }
    in_vain
}

/// The symbols of a program, each with the results that depend on it.
fn read(program: &Program) -> impl Iterator<Item = (SymbolId, Vec<bool>)> {
    program.steps.iter_ids().filter_map(|(load, step)| {
        let Step::Load(symbol) = step else { return None };
        let mut reading = vec![false; program.steps.len()];
        reading[load.index()] = true;
        for (value, step) in program.steps.iter_ids().skip(load.index() + 1) {
            step.each_operand(|operand| reading[value.index()] |= reading[operand.index()]);
        }
        Some((*symbol, reading))
    })
}

/// Whether arguments of elementary functions depend on a result.
fn under_functions(program: &Program) -> Vec<bool> {
    let mut marked = vec![false; program.steps.len()];
    for value in program.steps.ids().rev() {
        let step = &program.steps[value];
        if marked[value.index()] || matches!(step, Step::SinCos(_) | Step::Apply(..) | Step::Apply2(..)) {
            step.each_operand(|operand| marked[operand.index()] = true);
        }
    }
    marked
}

/// A number between 1/8 and 8 that the point and the symbol determine: masses and lengths are positive,
/// and signs of states are as good as any.
#[allow(clippy::cast_precision_loss, reason = "a sample needs no more digits")]
pub(super) fn sample(point: u32, symbol: SymbolId) -> f64 {
    let word = Residue::mixed(23_000 + u64::from(point), symbol.index() as u64).word();
    let unit = (word & 0xF_FFFF) as f64 / f64::from(1 << 20);
    2f64.powf(6.0 * unit - 3.0)
}

/// The coordinates of an embedded base at a point.
pub(super) struct OnBase {
    point: u32,
    values: Vec<(SymbolId, f64)>,
}

impl OnBase {
    pub(super) fn at(graph: &Graph, point: u32) -> Self {
        let images = graph.embedded();
        if images.is_empty() {
            return Self { point, values: Vec::new() };
        }
        let roots: Vec<ExprId> = images.iter().map(|(_, image)| *image).collect();
        let values = graph.evaluate(&roots, |symbol| sample(point, symbol));
        let symbols = images.iter().map(|(symbol, _)| *symbol);
        Self { point, values: symbols.zip(values.iter().map(|bounded| bounded.value)).collect() }
    }

    fn known(&self, symbol: SymbolId) -> Option<f64> {
        self.values.iter().find(|(known, _)| *known == symbol).map(|(_, value)| *value)
    }

    /// The value of a symbol at the point, of ordinary size.
    pub(super) fn sample(&self, symbol: SymbolId) -> f64 {
        self.known(symbol).unwrap_or_else(|| sample(self.point, symbol))
    }

    /// The same far from those of others, unless functions depend on it.
    pub(super) fn sample_apart(&self, symbol: SymbolId, turning: &BTreeSet<SymbolId>) -> f64 {
        let is_ordinary = turning.contains(&symbol);
        self.known(symbol).unwrap_or_else(|| {
            if is_ordinary { sample(self.point, symbol) } else { sample_apart(self.point, symbol) }
        })
    }
}

/// A number between 10⁻⁴ and 10⁴ that the point and the symbol determine.
#[allow(clippy::cast_precision_loss, reason = "a sample needs no more digits")]
fn sample_apart(point: u32, symbol: SymbolId) -> f64 {
    let word = Residue::mixed(29_000 + u64::from(point), symbol.index() as u64).word();
    let unit = (word & 0xF_FFFF) as f64 / f64::from(1 << 20);
    10f64.powf(8.0 * unit - 4.0)
}

impl Arithmetic for Bounded {
    fn number(value: &Rational) -> Self {
        Self::of_number(value)
    }
    fn pi() -> Self {
        Self::rounded(std::f64::consts::PI, 0.0)
    }
    fn add(&self, other: &Self) -> Self {
        Self::rounded(self.value + other.value, self.error + other.error)
    }
    fn sub(&self, other: &Self) -> Self {
        Self::rounded(self.value - other.value, self.error + other.error)
    }
    fn mul(&self, other: &Self) -> Self {
        let error = self.error * other.value.abs() + other.error * self.value.abs();
        Self::rounded(self.value * other.value, error)
    }
    fn div(&self, other: &Self) -> Self {
        let value = self.value / other.value;
        Self::rounded(value, (self.error + value.abs() * other.error) / other.value.abs())
    }
    fn sqrt(&self) -> Self {
        let value = self.value.sqrt();
        Self::rounded(value, 0.5 * self.error / value)
    }
    fn cbrt(&self) -> Self {
        let value = self.value.cbrt();
        Self::rounded(value, self.error / (3.0 * value * value))
    }
    fn pow(&self, exponent: &Rational) -> Self {
        let exponent = exponent.to_f64();
        let value = self.value.powf(exponent);
        Self::rounded(value, (exponent * value / self.value).abs() * self.error)
    }
    fn apply(&self, function: Function) -> Self {
        Self::of_function(function, *self)
    }
    fn apply2(&self, function: Function2, other: &Self) -> Self {
        Self::of_function2(function, *self, *other)
    }
    fn magnitude(&self) -> f64 {
        self.value.abs()
    }
}
