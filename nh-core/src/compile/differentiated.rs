//! Jacobians that are asked for, by the cheapest of several ways.

use super::common_turn::BeforeCounting;
use super::proved::Proved;
use crate::algebra::Graph;
use crate::choose::{Contender, Decision, Fate, ranking, rate_derivatives, sizes};
use crate::id::{ExprId, Origin, SymbolId};
use crate::mechanics::{Definition, NotDifferentiable, Procedure, jacobian};
use crate::model::{Model, Request};
use crate::program::{Systems, Wanted, accumulated};
use crate::system::{PositionReturn, Projection, SlopesOfReturn};
use crate::violation::{Law, Violation};

// the ways, as the ledger names them
pub(super) const BY_EXPRESSIONS: &str = "differentiated as expressions";
pub(super) const BY_STEPS: &str = "differentiated step by step";
pub(super) const BY_RESIDUALS: &str = "differentiated step by step, with the factors of C";

// the two derivatives of a return, as the ledger names them
pub(super) const SLOPES_OF_POSITIONS: &str = "slopes of the position return";
pub(super) const SLOPES_OF_VELOCITIES: &str = "slopes of the velocity return";

/// The fate of the winner until it is proved.
const UNPROVED: Fate = Fate::Lost("it could not be proved");

/// The derivative, then ∂derivative/∂(coordinates, velocities of the state, auxiliary states, inputs), if the
/// declaration asks for it.
///
/// # Errors
/// Where the derivative of a method of the user's is missing.
pub(super) fn requested_linearized(
    proved: &mut Proved,
    derivative: &Procedure,
    velocities: &[SymbolId],
) -> Result<Option<Procedure>, Vec<Violation>> {
    let model = &proved.model;
    let is_asked =
        |(request, _): &&(Request, Origin)| matches!(request, Request::Jacobian | Request::SparseJacobian);
    let Some((request, origin)) = model.requests.iter().find(is_asked).copied() else {
        return Ok(None);
    };
    let word = if request == Request::Jacobian { "jacobian" } else { "sparse_jacobian" };
    let arguments = state_and_inputs(model, velocities);
    let before = proved.before_counting.take();
    let function = (derivative, "jacobian", Wanted::Linearized);
    let linearized =
        differentiated_from(proved, (function, before.as_ref()), &arguments, (origin, "a force", word));
    proved.before_counting = before;
    linearized
}

/// ∂outputs/∂(coordinates, velocities of the state, auxiliary states, inputs), if the declaration asks for it.
///
/// # Errors
/// Where there are no outputs, or the derivative of a method of the user's is missing.
pub(super) fn requested_output_jacobian(
    proved: &mut Proved,
    observables: &Procedure,
    velocities: &[SymbolId],
) -> Result<Option<Procedure>, Vec<Violation>> {
    let model = &proved.model;
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
    let asked = (origin, "an output", "output_jacobian");
    differentiated(proved, (observables, "output_jacobian", Wanted::Jacobian), &arguments, asked)
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
    proved: &mut Proved,
    derivative: &Procedure,
) -> Result<Option<Procedure>, Vec<Violation>> {
    let model = &proved.model;
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
    let asked = (origin, "a force", "parameter_jacobian");
    differentiated(proved, (derivative, "parameter_jacobian", Wanted::Jacobian), &arguments, asked)
}

/// What the steps back to position constraints depend on: the coordinates, the velocities where a projection starts, and
/// the rest of the state. Constraints may contain auxiliary states, and masses velocities.
pub(super) fn returned(model: &Model, started: &[SymbolId], velocities: &[SymbolId]) -> Vec<SymbolId> {
    let coordinates = model.coordinates.iter().map(|coordinate| coordinate.symbol);
    let auxiliary = model.auxiliary.iter().map(|state| state.symbol);
    let velocities = started.iter().chain(velocities).copied();
    coordinates.chain(velocities).chain(auxiliary).collect()
}

/// The derivatives of one step back to position constraints, if the declaration asks for them.
///
/// # Errors
/// Where there is no return, or no Jacobian beside them.
pub(super) fn requested_slopes_of_return(
    proved: &mut Proved,
    way_back: Option<(&PositionReturn, Option<&Projection>)>,
    velocities: &[SymbolId],
) -> Result<Option<SlopesOfReturn>, Vec<Violation>> {
    let model = &proved.model;
    let asked = |wanted: Request| model.requests.iter().find(|(request, _)| *request == wanted);
    let Some((_, origin)) = asked(Request::ReturnJacobian).copied() else { return Ok(None) };
    let refused = |what: &str, way_out: &str| {
        let (what, way_out, evidence) = (what.into(), way_out.into(), String::new());
        Err(vec![Violation { law: Law::Force, origin, what, evidence, way_out }])
    };
    let Some((positions, projection)) = way_back else {
        let way_out = "leave it out: without `holonomic` no step ends with a return";
        return refused("there is no return to position constraints to differentiate", way_out);
    };
    if asked(Request::Jacobian).is_none() {
        let way_out = "write `emit { jacobian, return_jacobian }`";
        return refused("the derivative of the return goes with that of the motion", way_out);
    }
    let started: Vec<SymbolId> =
        projection.iter().flat_map(|projection| projection.start.iter().copied()).collect();
    let [state, moved] = [&[][..], started.as_slice()].map(|started| returned(model, started, velocities));
    let mut slopes = |step: &Procedure, site, arguments: &[SymbolId]| {
        let asked = (origin, "a position constraint", "return_jacobian");
        differentiated(proved, (step, site, Wanted::Jacobian), arguments, asked)
    };
    let of_positions = slopes(&positions.step, SLOPES_OF_POSITIONS, &state)?;
    let of_velocities = match projection.map(|projection| &projection.step).or(positions.velocities.as_ref())
    {
        None => None,
        Some(step) => slopes(step, SLOPES_OF_VELOCITIES, &moved)?,
    };
    Ok(of_positions.map(|positions| SlopesOfReturn { positions, velocities: of_velocities }))
}

/// The derivatives of a function by its arguments: `word` asks for them.
fn differentiated(
    proved: &mut Proved,
    function: (&Procedure, &'static str, Wanted),
    arguments: &[SymbolId],
    asked: (Origin, &str, &str),
) -> Result<Option<Procedure>, Vec<Violation>> {
    differentiated_from(proved, (function, None), arguments, asked)
}

/// The same, where it is known how the function was before its angles were counted from one of them.
fn differentiated_from(
    proved: &mut Proved,
    ((function, site, wanted), before): ((&Procedure, &'static str, Wanted), Option<&BeforeCounting>),
    arguments: &[SymbolId],
    (origin, what, word): (Origin, &str, &str),
) -> Result<Option<Procedure>, Vec<Violation>> {
    match cheapest_jacobian(&mut proved.model, (function, wanted, before), arguments, site) {
        Ok((found, decision)) => {
            proved.ledger.decisions.push(decision);
            Ok(Some(found))
        }
        Err(NotDifferentiable { method }) => Err(vec![Violation {
            law: Law::Force,
            origin,
            what: "the Jacobian cannot be derived".into(),
            evidence: format!(
                "{what} calls `self.{method}`, which is no formula, with arguments that change"
            ),
            way_out: format!(
                "give its derivatives in `derivative {{ {method}: […]; }}`, or leave `{word}` out"
            ),
        }]),
    }
}

/// The derivatives of all outputs by all `arguments`, row by row, with the outputs before them or without: the way is the
/// same. The decision is left in the ledger's form, to be completed by the proof.
///
/// # Errors
/// Where an output depends on an argument through a method of the user's whose derivative is missing.
fn cheapest_jacobian(
    model: &mut Model,
    (procedure, wanted, before): (&Procedure, Wanted, Option<&BeforeCounting>),
    arguments: &[SymbolId],
    site: &'static str,
) -> Result<(Procedure, Decision), NotDifferentiable> {
    let parameters: Vec<SymbolId> = model.parameters.iter().map(|parameter| parameter.symbol).collect();
    let graph = &mut model.graph;
    let mut decision = Decision { site, ..Decision::default() };
    // without what only the solution for other right-hand sides is made of
    let alone = procedure.as_far_as(graph, &procedure.outputs);
    let size = graph.operation_count(&alone.values(graph));
    let mut ways: Vec<(&'static str, Procedure)> = Vec::new();
    for (name, systems) in [(BY_RESIDUALS, Systems::All), (BY_STEPS, Systems::Pivoted)] {
        // of what is large one way is enough
        if size > sizes::DIFFERENTIATED_ONCE && !ways.is_empty() {
            continue;
        }
        let before = before.filter(|_| systems == Systems::All);
        let function = before.map_or(procedure, |before| &before.motion);
        if let Some(found) = accumulated(graph, function, (arguments, &parameters), systems, wanted)? {
            ways.push((name, before.map(|before| before.counted(graph, &found)).unwrap_or(found)));
        }
    }
    if size <= sizes::DIFFERENTIATED_AS_EXPRESSIONS || ways.is_empty() {
        let mut found = jacobian(graph, &alone, arguments)?;
        if let Wanted::Linearized = wanted {
            found.outputs.splice(0..0, procedure.outputs.iter().copied());
        }
        ways.push((BY_EXPRESSIONS, found));
    } else {
        let most = sizes::DIFFERENTIATED_AS_EXPRESSIONS;
        decision
            .limits
            .push(format!("{BY_EXPRESSIONS}: the function has {size} operations, more than {most}"));
    }
    let outputs = if let Wanted::Linearized = wanted { procedure.outputs.len() } else { 0 };
    let values: Vec<Vec<ExprId>> =
        ways.iter_mut().map(|(_, way)| way.outputs.drain(..outputs).collect()).collect();
    let names: Vec<&str> = ways.iter().map(|(name, _)| *name).collect();
    let (mut found, favoured) = favourite(graph, ways, site);
    let best = favoured.contenders.first().map(|contender| contender.form);
    let values = names.into_iter().zip(values).find(|(name, _)| Some(*name) == best);
    found.outputs.splice(0..0, values.map(|(_, values)| values).unwrap_or_default());
    decision.contenders = favoured.contenders;
    Ok((found, decision))
}

/// The best of several ways to the same function, each with its name.
pub(super) fn favourite(
    graph: &Graph,
    mut ways: Vec<(&'static str, Procedure)>,
    site: &'static str,
) -> (Procedure, Decision) {
    let mut decision = Decision { site, ..Decision::default() };
    if ways.len() == 1 {
        let (form, found) = ways.remove(0);
        decision.contenders.push(Contender { form, cost: None, rounding: None, fate: UNPROVED });
        return (found, decision);
    }
    let (names, mut procedures): (Vec<&'static str>, Vec<Procedure>) = ways.into_iter().unzip();
    let ratings = rate_derivatives(graph, &procedures);
    let ranking = ranking(&ratings);
    for (place, index) in ranking.iter().enumerate() {
        let fate = if place == 0 { UNPROVED } else { ratings[*index].loss() };
        decision.contenders.push(ratings[*index].contender(names[*index], fate));
    }
    (procedures.swap_remove(ranking.first().copied().unwrap_or_default()), decision)
}
