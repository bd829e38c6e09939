//! What the declaration says in quasi-velocities, put into the velocities of the state.

use crate::algebra::{Graph, Substitution};
use crate::check::Motion;
use crate::id::{ExprId, SymbolId};
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
    let calls = calls(model, motion, restriction);
    let graph = &mut model.graph;
    let mut outputs = Vec::with_capacity(model.outputs.len());
    for output in &model.outputs {
        outputs.push(in_state(graph, motion, restriction, output.value));
    }
    calls.with_outputs(outputs)
}

/// The calls of the user's methods, with arguments in the variables of the state.
pub(super) fn calls(model: &mut Model, motion: &mut Motion, restriction: &mut Substitution) -> Procedure {
    let graph = &mut model.graph;
    let mut procedure = Procedure::default();
    for call in &model.calls {
        let arguments =
            call.arguments.iter().map(|value| in_state(graph, motion, restriction, *value)).collect();
        let (symbol, method, derivatives) = (call.symbol, call.method.clone(), call.derivatives.clone());
        procedure.definitions.push(Definition::Call { symbol, method, arguments, derivatives });
    }
    procedure
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

/// The conditions on the parameters, each once.
pub(super) fn parameter_checks(model: &Model, conditions: &[ExprId]) -> Vec<ParameterCheck> {
    let mut checks: Vec<ParameterCheck> = Vec::new();
    for &nonzero in conditions {
        if !checks.iter().any(|check| check.nonzero == nonzero) {
            checks.push(ParameterCheck { nonzero, text: model.graph.text(nonzero) });
        }
    }
    checks
}

/// Whether the declaration asks for something.
pub(super) fn requested(model: &Model, request: Request) -> bool {
    model.requests.iter().any(|(asked, _)| *asked == request)
}

/// ∂derivative/∂(coordinates, velocities of the state, inputs), if the declaration asks for it.
///
/// # Errors
/// Where the derivative of a method of the user's is missing.
pub(super) fn requested_jacobian(
    model: &mut Model,
    derivative: &Procedure,
    velocities: &[SymbolId],
) -> Result<Option<Procedure>, Violation> {
    let Some((_, origin)) = model.requests.iter().find(|(request, _)| *request == Request::Jacobian) else {
        return Ok(None);
    };
    let coordinates = model.coordinates.iter().map(|coordinate| coordinate.symbol);
    let inputs = model.inputs.iter().map(|input| input.symbol);
    let arguments: Vec<SymbolId> = coordinates.chain(velocities.iter().copied()).chain(inputs).collect();
    let origin = *origin;
    jacobian(&mut model.graph, derivative, &arguments).map(Some).map_err(|NotDifferentiable { method }| {
        Violation {
            law: Law::Force,
            origin,
            what: "the Jacobian cannot be derived".into(),
            evidence: format!(
                "a force calls `self.{method}`, which is no formula, with arguments that change"
            ),
            way_out: format!(
                "give its derivatives in `derivative {{ {method}: […]; }}`, or leave `jacobian` out"
            ),
        }
    })
}
