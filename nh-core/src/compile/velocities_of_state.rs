//! What the declaration says in quasi-velocities, put into the velocities of the state.

use super::given;
use crate::algebra::{Facts, Graph, Substitution};
use crate::check::Motion;
use crate::check::evidence::shown;
use crate::id::{ExprId, SymbolId};
use crate::mechanics::{Definition, Procedure};
use crate::model::{Model, Request};
use crate::system::ParameterCheck;

/// The base coordinates.
pub(super) fn coordinates(model: &Model) -> Vec<SymbolId> {
    model.coordinates.iter().map(|coordinate| coordinate.symbol).collect()
}

/// The declared observables.
pub(super) fn observables(
    model: &mut Model,
    motion: &mut Motion,
    restriction: &mut Substitution,
) -> Procedure {
    let given = given::definitions(model, motion, restriction);
    let graph = &mut model.graph;
    let mut outputs = Vec::with_capacity(model.outputs.len());
    for output in &model.outputs {
        let value = in_state(graph, motion, restriction, output.value);
        outputs.push(without_what_cancels(graph, value));
    }
    given.with_outputs(outputs)
}

/// Expressions with more operations than this are left as they are declared.
const SHORT: u64 = 240;

/// A value by fewer variables, where some cancel: the length of a velocity does not depend on the heading in whose axes it
/// is declared.
fn without_what_cancels(graph: &mut Graph, value: ExprId) -> ExprId {
    if graph.operation_count(&[value]) > SHORT {
        return value;
    }
    let simplified = graph.simplify(value);
    let is_shorter = graph.operation_count(&[simplified]) < graph.operation_count(&[value])
        && graph.symbols_in(&[simplified]).len() < graph.symbols_in(&[value]).len();
    if is_shorter && graph.error_growth(simplified, value) <= 4.0 { simplified } else { value }
}

/// A declared expression in the coordinates and velocities of the state.
pub(super) fn in_state(
    graph: &mut Graph,
    motion: &mut Motion,
    restriction: &mut Substitution,
    value: ExprId,
) -> ExprId {
    let value = motion.rates.apply(graph, value);
    restriction.apply(graph, value)
}

/// The claimed first integrals in the variables of the state.
pub(super) fn claims_in_state(
    model: &mut Model,
    motion: &mut Motion,
    restriction: &mut Substitution,
) -> Vec<ExprId> {
    let Model { graph, claims, .. } = model;
    claims.iter().map(|claim| in_state(graph, motion, restriction, claim.value)).collect()
}

/// Whether a procedure divides by what is made of parameters, and may be 0 for the motion, which divides by `known`.
pub(super) fn divides_by_free_parameters(
    model: &mut Model,
    procedure: &Procedure,
    known: &[ExprId],
    facts: &Facts,
) -> bool {
    let divisors = parameter_divisors(model, procedure);
    let graph = &model.graph;
    divisors.iter().any(|divisor| !known.contains(divisor) && !graph.vanishes_nowhere(*divisor, facts))
}

/// The expressions of parameters alone by which a function divides.
pub(super) fn parameter_divisors(model: &mut Model, procedure: &Procedure) -> Vec<ExprId> {
    let parameters: Vec<SymbolId> = model.parameters.iter().map(|parameter| parameter.symbol).collect();
    let graph = &mut model.graph;
    let is_fixed = |graph: &Graph, value: ExprId| {
        let symbols = graph.symbols_in(&[value]);
        !symbols.is_empty() && symbols.iter().all(|symbol| parameters.contains(symbol))
    };
    // intermediate results of parameters alone are written out
    let mut fixed = Substitution::new([]);
    let mut roots = Vec::new();
    for definition in &procedure.definitions {
        match definition {
            Definition::Value { symbol, value } => {
                let value = fixed.apply(graph, *value);
                if is_fixed(graph, value) {
                    fixed.insert(*symbol, value);
                }
                roots.push(value);
            }
            Definition::Call { arguments, .. } => roots.extend(arguments),
            Definition::Solve { matrix, right, .. } => roots.extend(matrix.iter().flatten().chain(right)),
        }
    }
    for output in &procedure.outputs {
        roots.push(fixed.apply(graph, *output));
    }
    graph.divisors(&roots).into_iter().filter(|divisor| is_fixed(graph, *divisor)).collect()
}

/// The conditions on the parameters, each once.
pub(super) fn parameter_checks(model: &Model, conditions: &[ExprId]) -> Vec<ParameterCheck> {
    let mut checks: Vec<ParameterCheck> = Vec::new();
    for &nonzero in conditions {
        if !checks.iter().any(|check| check.nonzero == nonzero) {
            checks.push(ParameterCheck { nonzero, text: shown(&model.graph, nonzero) });
        }
    }
    checks
}

/// Whether the declaration asks for something.
pub(super) fn requested(model: &Model, request: Request) -> bool {
    model.requests.iter().any(|(asked, _)| *asked == request)
}
