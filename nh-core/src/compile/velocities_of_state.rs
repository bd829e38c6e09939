//! What the declaration says in quasi-velocities, put into the velocities of the state.

use super::given;
use crate::algebra::{Graph, Substitution};
use crate::check::Motion;
use crate::check::evidence::shown;
use crate::id::{ExprId, Origin, SymbolId};
use crate::mechanics::{Definition, NotDifferentiable, Procedure, jacobian};
use crate::model::{Model, Request};
use crate::system::ParameterCheck;
use crate::violation::{Law, Violation};

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
        outputs.push(in_state(graph, motion, restriction, output.value));
    }
    given.with_outputs(outputs)
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

/// ∂derivative/∂(coordinates, velocities of the state, auxiliary states, inputs), if the declaration asks for it.
///
/// # Errors
/// Where the derivative of a method of the user's is missing.
pub(super) fn requested_jacobian(
    model: &mut Model,
    derivative: &Procedure,
    velocities: &[SymbolId],
) -> Result<Option<Procedure>, Vec<Violation>> {
    let Some((_, origin)) = model.requests.iter().find(|(request, _)| *request == Request::Jacobian) else {
        return Ok(None);
    };
    let origin = *origin;
    let arguments = state_and_inputs(model, velocities);
    differentiated(model, derivative, &arguments, (origin, "a force", "jacobian"))
}

/// ∂outputs/∂(coordinates, velocities of the state, auxiliary states, inputs), if the declaration asks for it.
///
/// # Errors
/// Where there are no outputs, or the derivative of a method of the user's is missing.
pub(super) fn requested_output_jacobian(
    model: &mut Model,
    observables: &Procedure,
    velocities: &[SymbolId],
) -> Result<Option<Procedure>, Vec<Violation>> {
    let asked = model.requests.iter().find(|(request, _)| *request == Request::OutputJacobian);
    let Some((_, origin)) = asked.copied() else { return Ok(None) };
    if observables.outputs.is_empty() {
        return Err(vec![Violation {
            law: Law::Force,
            origin,
            what: "there are no outputs to differentiate".into(),
            evidence: String::new(),
            way_out: "declare them: `outputs { speed = …; }`, or leave this out".into(),
        }]);
    }
    let arguments = state_and_inputs(model, velocities);
    differentiated(model, observables, &arguments, (origin, "an output", "output_jacobian"))
}

/// The variables of the state, then the inputs.
fn state_and_inputs(model: &Model, velocities: &[SymbolId]) -> Vec<SymbolId> {
    let coordinates = model.coordinates.iter().map(|coordinate| coordinate.symbol);
    let auxiliary = model.auxiliary.iter().map(|state| state.symbol);
    let state = coordinates.chain(velocities.iter().copied()).chain(auxiliary);
    state.chain(model.inputs.iter().map(|input| input.symbol)).collect()
}

/// ∂derivative/∂parameters, if the declaration asks for it.
///
/// # Errors
/// Where a method of the user's is called: it may depend on any parameter.
pub(super) fn requested_parameter_jacobian(
    model: &mut Model,
    derivative: &Procedure,
) -> Result<Option<Procedure>, Vec<Violation>> {
    let asked = model.requests.iter().find(|(request, _)| *request == Request::ParameterJacobian);
    let Some((_, origin)) = asked else { return Ok(None) };
    let origin = *origin;
    let called = derivative.definitions.iter().find_map(|definition| match definition {
        Definition::Call { method, .. } => Some(method.clone()),
        _ => None,
    });
    if let Some(method) = called {
        return Err(vec![Violation {
            law: Law::Force,
            origin,
            what: "the derivative by the parameters cannot be derived".into(),
            evidence: format!("a force calls `self.{method}`, which may depend on any of them"),
            way_out: "write the force as a formula, or leave `parameter_jacobian` out".into(),
        }]);
    }
    let arguments: Vec<SymbolId> = model.parameters.iter().map(|parameter| parameter.symbol).collect();
    differentiated(model, derivative, &arguments, (origin, "a force", "jacobian"))
}

/// The derivatives of a function by its arguments.
fn differentiated(
    model: &mut Model,
    derivative: &Procedure,
    arguments: &[SymbolId],
    (origin, what, word): (Origin, &str, &str),
) -> Result<Option<Procedure>, Vec<Violation>> {
    jacobian(&mut model.graph, derivative, arguments).map(Some).map_err(|NotDifferentiable { method }| {
        vec![Violation {
            law: Law::Force,
            origin,
            what: "the Jacobian cannot be derived".into(),
            evidence: format!(
                "{what} calls `self.{method}`, which is no formula, with arguments that change"
            ),
            way_out: format!(
                "give its derivatives in `derivative {{ {method}: […]; }}`, or leave `{word}` out"
            ),
        }]
    })
}
