//! Whether a mass matrix is definite for physical parameters.

use super::symmetric_solve::Definiteness;
use crate::algebra::{Bounded, Evaluator, Facts, Graph, Range, Residue};
use crate::id::{ExprId, Id, SymbolId};
use crate::limits;
use rustc_hash::FxHashMap;

/// Parameter sets tried.
const PARAMETER_SETS: u64 = 120;
/// Parameter sets tried for the sign of an expression, with each of them zero in turn.
const SIGN_SETS: u64 = 24;
/// Configurations at which the matrix has to be definite.
const CONFIGURATIONS: u64 = 12;

/// Samples: definite if there are parameters for which the matrix is definite, of one sign, at
/// every configuration tried.
///
/// Parameters that violate this can make a pivot vanish; then the result is not finite, which the
/// integrators report. A wrong answer here never makes a finite result wrong.
#[must_use]
pub fn definiteness(
    graph: &Graph,
    matrix: &[Vec<ExprId>],
    parameters: &[SymbolId],
    facts: &Facts,
) -> Definiteness {
    if matrix.is_empty() {
        return Definiteness::Definite;
    }
    let mut samples = Samples::of(graph, matrix);
    let is_definite = |set| {
        samples.have_one_sign(|configuration, symbol| {
            if parameters.contains(&symbol) {
                parameter_sample(set, symbol, facts)
            } else {
                configuration_sample(configuration, symbol)
            }
        })
    };
    if (0..PARAMETER_SETS).any(is_definite) { Definiteness::Definite } else { Definiteness::Unknown }
}

/// Samples: whether an expression has one sign wherever a matrix is definite, parameters at zero included.
///
/// At the parameters for which the matrix is definite at every configuration tried, and at those with one
/// of them zero for which it still is: a form that divides by the expression then asks for no more than the
/// matrix does.
#[must_use]
pub fn keeps_its_sign(
    graph: &Graph,
    (matrix, known): (&[Vec<ExprId>], &mut DefiniteSets),
    expression: ExprId,
    parameters: &[SymbolId],
    facts: &Facts,
) -> bool {
    let mut signs = [false; 2];
    let mut given: Vec<bool> = graph.symbols().iter().map(|_| false).collect();
    for parameter in parameters {
        given[parameter.index()] = true;
    }
    let (mut samples, mut asked) = (Samples::of(graph, matrix), graph.evaluator(&[expression]));
    let occurring = graph.symbols_in(&[expression]);
    let zeroed = occurring.into_iter().filter(|symbol| parameters.contains(symbol)).map(Some);
    for zero in std::iter::once(None).chain(zeroed) {
        let may_be_zero = zero.is_none_or(|symbol| {
            facts
                .symbols
                .get(&symbol)
                .is_none_or(|range| !range.nonzero && range.low <= 0.0 && range.high >= 0.0)
        });
        for set in (0..SIGN_SETS).filter(|_| may_be_zero) {
            let value = |configuration: u64, symbol: SymbolId| match given[symbol.index()] {
                true if zero == Some(symbol) => 0.0,
                true => parameter_sample(set, symbol, facts),
                false => configuration_sample(configuration, symbol),
            };
            let is_definite = known.0.entry((zero, set)).or_insert_with(|| samples.have_one_sign(value));
            if !*is_definite {
                continue;
            }
            for configuration in 0..CONFIGURATIONS {
                let found = asked.at(|symbol| value(configuration, symbol))[0];
                if !found.is_certainly_nonzero() {
                    return false;
                }
                signs[usize::from(found.value < 0.0)] = true;
            }
        }
    }
    signs[0] != signs[1]
}

/// At which parameter sets, with which parameter zero, a matrix is definite: found once for all that
/// [`keeps_its_sign`] is asked of.
#[derive(Debug, Default)]
pub struct DefiniteSets(FxHashMap<(Option<SymbolId>, u64), bool>);

/// Between 1/16 and 8, evenly on a logarithmic scale, from the bound that is known of the parameter.
fn parameter_sample(set: u64, symbol: SymbolId, facts: &Facts) -> f64 {
    let unit = unit(set, symbol);
    let size = 2f64.powf(unit * 7.0 - 4.0);
    let range = facts.symbols.get(&symbol).copied().unwrap_or(Range::ALL);
    match (range.low.is_finite(), range.high.is_finite()) {
        (false, false) => size,
        (true, false) => range.low + size,
        (false, true) => range.high - size,
        (true, true) => range.low + (range.high - range.low) * unit,
    }
}

/// Between −3 and 3.
fn configuration_sample(configuration: u64, symbol: SymbolId) -> f64 {
    unit(1_000 + configuration, symbol) * 6.0 - 3.0
}

/// A number in [0, 1) that the seed and the symbol determine.
#[allow(clippy::cast_precision_loss, reason = "a sample needs no more digits")]
fn unit(seed: u64, symbol: SymbolId) -> f64 {
    let word = Residue::mixed(seed, symbol.index() as u64).word();
    (word % (1 << 20)) as f64 / (1u64 << 20) as f64
}

/// A matrix that is evaluated at many points.
struct Samples {
    /// Where the rows below the diagonal begin: before their first entry elimination fills nothing in.
    begin: Vec<usize>,
    /// These rows, one after the other.
    lower: Evaluator,
}

impl Samples {
    fn of(graph: &Graph, matrix: &[Vec<ExprId>]) -> Self {
        let first =
            |row: &Vec<ExprId>| row.iter().position(|entry| !graph.is_literal_zero(*entry)).unwrap_or(0);
        let begin: Vec<usize> = matrix.iter().enumerate().map(|(i, row)| first(row).min(i)).collect();
        let entries = matrix.iter().enumerate().flat_map(|(i, row)| &row[begin[i]..=i]).copied();
        let lower = graph.evaluator(&entries.collect::<Vec<_>>());
        Self { begin, lower }
    }

    /// Whether the matrix is positive definite at every configuration, or negative definite at every one.
    fn have_one_sign(&mut self, value: impl Fn(u64, SymbolId) -> f64) -> bool {
        let mut signs = vec![1.0, -1.0];
        for configuration in 0..CONFIGURATIONS {
            let values = self.lower.at(|symbol| value(configuration, symbol));
            signs.retain(|sign| is_positive(&self.begin, &values, *sign));
            if signs.is_empty() {
                return false;
            }
        }
        true
    }
}

/// Whether `sign · matrix` is positive definite, by its rows below the diagonal: Cholesky in floating point.
fn is_positive(begin: &[usize], values: &[Bounded], sign: f64) -> bool {
    let mut values = values.iter().map(|bounded| sign * bounded.value);
    let mut factor: Vec<Vec<f64>> = Vec::with_capacity(begin.len());
    for i in 0..begin.len() {
        let mut row: Vec<f64> = values.by_ref().take(i + 1 - begin[i]).collect();
        for j in begin[i]..=i {
            let from = begin[i].max(begin[j]);
            limits::spend((j - from) / 64);
            let own = &row[from - begin[i]..j - begin[i]];
            let other = if j == i { own } else { &factor[j][from - begin[j]..j - begin[j]] };
            let sum: f64 = own.iter().zip(other).map(|(a, b)| a * b).sum();
            let whole = row[j - begin[i]];
            let rest = whole - sum;
            row[j - begin[i]] = if i == j {
                if rest.is_nan() || rest <= whole.abs() * 1e-12 {
                    return false;
                }
                rest.sqrt()
            } else {
                rest / factor[j][j - begin[j]]
            };
        }
        factor.push(row);
    }
    true
}
