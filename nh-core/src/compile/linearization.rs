//! What linearising a motion on the constraint manifold takes.

use super::proved::{Proved, fence};
use crate::algebra::{Graph, Matrix};
use crate::check::evidence::listed;
use crate::functions::RESIDUAL;
use crate::geometry::Manifold;
use crate::id::{ExprId, Origin, SymbolId};
use crate::limits;
use crate::mechanics::{NotDifferentiable, Procedure, jacobian};
use crate::model::{Formulation, Kept, Kinematics};
use crate::system::{Linearization, System};
use crate::violation::{Law, Violation};

/// What vanishes on the manifold, from whose derivatives the tangent T of mathematics (36) follows at a state, and the
/// places of what is kept.
///
/// # Errors
/// Where something is kept that is not in the state or follows from the rest that is kept, or a method of the user's has no derivative; where nothing is named
/// and the independent variables are not known.
pub(super) fn derive(system: &mut System, constrained: Option<&Manifold>) -> Result<(), Vec<Violation>> {
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
    let dependent = constrained.and_then(|manifold| {
        limits::attempt(limits::REMARK, || dependent(system, manifold, &residuals, (&state, &named)))
            .flatten()
    });
    fence(dependent.into_iter().collect())?;
    system.linearization = Some(Linearization { kept, residuals });
    Ok(())
}

/// Where the constraints hold, if a linearisation is declared and that is found.
pub(super) fn manifold(proved: &mut Proved) -> Option<Manifold> {
    let Proved { model, constraints, system, .. } = proved;
    if model.linearization.is_none() || !model.routh.is_empty() {
        return None;
    }
    let (graph, velocities) = (&mut model.graph, &system.algebroid.velocities);
    limits::attempt(limits::REMARK, || constraints.manifold(graph, velocities))
}

/// A variable that follows from those that are kept before it wherever the constraints hold: T of mathematics (36) exists
/// nowhere. Its rows beside the derivatives R of the constraints have rank R + 1 less than they are, which is asked for
/// at generic points of every part, where ranks are as large as they get.
fn dependent(
    system: &mut System,
    manifold: &Manifold,
    residuals: &Procedure,
    (state, named): (&[SymbolId], &[(SymbolId, Origin)]),
) -> Option<Violation> {
    let graph = &mut system.model.graph;
    let is_on_it = |graph: &mut Graph, residual: &ExprId| manifold.zero_test(graph, *residual).is_zero();
    let is_known = !residuals.outputs.is_empty() && manifold.open_parts().is_empty();
    if !is_known || !residuals.outputs.iter().all(|residual| is_on_it(graph, residual)) {
        return None;
    }
    let rows = jacobian(graph, residuals, state).ok()?.outputs;
    let rows: Matrix = rows.chunks(state.len()).map(<[ExprId]>::to_vec).collect();
    let on_parts: Vec<Matrix> = manifold.parts().map(|part| part.restrict_matrix(graph, &rows)).collect();
    let whole: Vec<usize> =
        on_parts.iter().map(|rows| graph.generic_rank(rows)).collect::<Result<_, _>>().ok()?;
    for count in 1..=named.len() {
        let kept = &named[..count];
        let is_open = |column: &usize| !kept.iter().any(|(symbol, _)| state.get(*column) == Some(symbol));
        let open: Vec<usize> = (0..state.len()).filter(is_open).collect();
        let mut is_dependent = true;
        for (rows, rank) in on_parts.iter().zip(&whole) {
            let others: Matrix =
                rows.iter().map(|row| open.iter().map(|column| row[*column]).collect()).collect();
            let left = if open.is_empty() { 0 } else { graph.generic_rank(&others).ok()? };
            is_dependent &= left < *rank;
        }
        if is_dependent {
            return Some(follows(system, kept, state.len() - whole.iter().max()?));
        }
    }
    None
}

/// The last of some variables follows from the others.
fn follows(system: &System, kept: &[(SymbolId, Origin)], independent: usize) -> Violation {
    let symbols = system.model.graph.symbols();
    let names: Vec<String> = kept.iter().map(|(symbol, _)| format!("`{}`", symbols[*symbol])).collect();
    let origin = kept.last().map_or(system.model.origin, |(_, origin)| *origin);
    let (what, evidence, way_out) = match names.as_slice() {
        [last] => (
            format!("{last} cannot be kept: the constraints determine it"),
            "where the constraints hold it does not change by itself, in no state",
            "leave it out".to_owned(),
        ),
        [before @ .., last] => (
            format!("{last} cannot be kept beside {}: the constraints relate them", listed(before)),
            "where the constraints hold they do not change each by itself, in no state",
            format!("leave one of them out: {independent} variables of the state are independent"),
        ),
        [] => (String::new(), "", String::new()),
    };
    Violation { law: Law::Linearization, origin, what, evidence: evidence.into(), way_out }
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
