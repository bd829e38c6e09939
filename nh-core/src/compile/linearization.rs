//! What linearising a motion on the constraint manifold takes.

use super::proved::fence;
use crate::functions::RESIDUAL;
use crate::id::{Origin, SymbolId};
use crate::mechanics::{NotDifferentiable, Procedure, jacobian};
use crate::system::{Linearization, System};
use crate::violation::{Law, Violation};

/// What vanishes on the manifold, from whose derivatives the tangent T of mathematics (36) follows at a state, and the
/// places of what is kept.
///
/// # Errors
/// Where something is kept that is not in the state, or a method of the user's has no derivative.
pub(super) fn derive(system: &mut System) -> Result<(), Vec<Violation>> {
    let Some(named) = system.model.linearization.clone() else { return Ok(()) };
    let state = system.state();
    let mut kept = Vec::with_capacity(named.len());
    let mut refused = Vec::new();
    for (symbol, origin) in &named {
        match state.iter().position(|other| other == symbol) {
            Some(place) => kept.push(place),
            None => refused.push(not_in_the_state(system, &state, *symbol, *origin)),
        }
    }
    if let Some((_, origin)) = named.first().filter(|_| !system.model.calls.is_empty()) {
        refused.extend(not_differentiable(system, &state, *origin));
    }
    fence(refused)?;
    let on_constraints = system.functions.get(&RESIDUAL).map(|residual| residual.outputs.clone());
    let on_base = system.embedding.as_ref().map(|embedding| embedding.residual.outputs.clone());
    let residuals = Procedure::of(on_constraints.into_iter().chain(on_base).flatten().collect());
    system.linearization = Some(Linearization { kept, residuals });
    Ok(())
}

fn not_in_the_state(system: &System, state: &[SymbolId], symbol: SymbolId, origin: Origin) -> Violation {
    let symbols = system.model.graph.symbols();
    let known: Vec<String> = state.iter().map(|symbol| format!("`{}`", symbols[*symbol])).collect();
    Violation {
        law: Law::Linearization,
        origin,
        what: format!("`{}` is not in the state", symbols[symbol]),
        evidence: format!("the state is {}", known.join(", ")),
        way_out: "keep what is in the state, or have it there: `independent { … }` names the velocities"
            .into(),
    }
}

/// Refuses methods of the user's whose derivative is not declared.
fn not_differentiable(system: &mut System, state: &[SymbolId], origin: Origin) -> Option<Violation> {
    let inputs = system.model.inputs.iter().map(|input| input.symbol);
    let arguments: Vec<SymbolId> = state.iter().copied().chain(inputs).collect();
    let graph = &mut system.model.graph;
    let NotDifferentiable { method } = jacobian(graph, &system.derivative, &arguments).err()?;
    Some(Violation {
        law: Law::Linearization,
        origin,
        what: "the motion cannot be linearised".into(),
        evidence: format!("a force calls `self.{method}`, which is no formula, with arguments that change"),
        way_out: format!("give its derivatives in `derivative {{ {method}: […]; }}`"),
    })
}
