//! What linearising a motion on the constraint manifold takes.

use super::proved::fence;
use crate::functions::RESIDUAL;
use crate::id::{Origin, SymbolId};
use crate::mechanics::{NotDifferentiable, Procedure, jacobian};
use crate::model::{Formulation, Kept, Kinematics};
use crate::system::{Linearization, System};
use crate::violation::{Law, Violation};

/// What vanishes on the manifold, from whose derivatives the tangent T of mathematics (36) follows at a state, and the
/// places of what is kept.
///
/// # Errors
/// Where something is kept that is not in the state, or a method of the user's has no derivative; where nothing is named
/// and the independent variables are not known.
pub(super) fn derive(system: &mut System) -> Result<(), Vec<Violation>> {
    let Some(Kept { variables, origin }) = system.model.linearization.clone() else { return Ok(()) };
    let named = if variables.is_empty() { independent_variables(system, origin)? } else { variables };
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

/// The coordinates and velocities that the declaration names as independent, or leaves all of them independent, and the
/// auxiliary states.
fn independent_variables(
    system: &System,
    section: Origin,
) -> Result<Vec<(SymbolId, Origin)>, Vec<Violation>> {
    let model = &system.model;
    let chart = model.chart.as_ref();
    let origin = chart.and_then(|named| named.first()).map_or(section, |(_, origin)| *origin);
    let open = |what: &str, way_out: &str| Violation {
        law: Law::Linearization,
        origin,
        what: format!("which {what} the linearisation keeps is open"),
        evidence: "it names no variables, and neither does `independent`".into(),
        way_out: way_out.into(),
    };
    let is_open = !model.positions.is_empty() || !model.identities.is_empty();
    let coordinates: Vec<SymbolId> = match chart {
        Some(named) => named.iter().map(|(symbol, _)| *symbol).collect(),
        None if is_open => {
            let way_out = "name coordinates in `independent { x, der(x) }`, or variables in `keep`";
            return Err(vec![open("coordinates", way_out)]);
        }
        None => system.state_coordinates.clone(),
    };
    let are_bound = !model.constraints.is_empty() || !model.routh.is_empty();
    let velocities = if are_bound && system.formulation == Formulation::Projected {
        // where only positions are constrained the rates of a chart of N are coordinates of the velocities on it
        let rates_do = matches!(model.kinematics, Kinematics::Tangent)
            && model.constraints.len() == model.positions.len()
            && model.routh.is_empty()
            && chart.is_some();
        if !rates_do {
            let way_out = "name velocities in `independent { x, der(x) }`, or variables in `keep`";
            return Err(vec![open("velocities", way_out)]);
        }
        let kept = model.coordinates.iter().filter(|coordinate| coordinates.contains(&coordinate.symbol));
        kept.map(|coordinate| coordinate.rate).collect()
    } else {
        system.state_velocities.clone()
    };
    let all = [coordinates, velocities, system.state_auxiliary.clone()].concat();
    Ok(all.into_iter().map(|symbol| (symbol, origin)).collect())
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
