//! The functions of a proved reduction: the map of states, and the way back.

use super::bundle_map::BundleMap;
use super::side::Side;
use super::{Reconstruction, Reduction};
use crate::algebra::{Graph, Matrix, Substitution, Transplant};
use crate::compile::Proved;
use crate::geometry::PivotSetting;
use crate::geometry::independent_velocities::search;
use crate::id::{ExprId, Id, SymbolId};
use crate::mechanics::Procedure;
use crate::model::Located;
use crate::violation::{Law, Violation};

/// Derives the functions.
///
/// # Errors
/// Where the state of the target depends on what the source does not track.
pub(super) fn functions(
    mut source: Side,
    target: &Side,
    map: &BundleMap,
    undecided: &[String],
) -> Result<Reduction, Violation> {
    // 1. parameters, state, inputs
    let values = |list: &[Located]| list.iter().map(|located| located.value).collect::<Vec<_>>();
    let parameters = values(&map.parameters);
    let reduced: Vec<ExprId> =
        reduced_state(&mut source, target, map).into_iter().map(|(_, value)| value).collect();
    let reduced: Vec<ExprId> = reduced.into_iter().map(|value| in_state(&mut source, value)).collect();
    let inputs: Vec<ExprId> =
        values(&map.inputs).into_iter().map(|value| in_state(&mut source, value)).collect();
    all_tracked(&source, map, &reduced, &inputs)?;
    // 2. the way back, where the state is whole
    let is_whole = |side: &Side| side.proved.model.tracked.is_none();
    let reconstruction =
        if is_whole(&source) && is_whole(target) { reconstruction(&mut source, target, map) } else { None };
    let mut report = report(&mut source, target, map, reconstruction.as_ref());
    for line in undecided {
        report += line;
        report += "\n";
    }
    Ok(Reduction {
        state: source.state.clone(),
        target_state: target.state.clone(),
        parameters: Procedure::of(parameters),
        reduced: Procedure::of(reduced),
        inputs: Procedure::of(inputs),
        reconstruction,
        report,
        source: source.proved.model,
    })
}

/// A function on E in the variables of the state.
pub(super) fn in_state(source: &mut Side, value: ExprId) -> ExprId {
    let value = source.restricted(value);
    source.graph().simplify(value)
}

/// The velocities in the state of the target before anything is left out of it, as functions on E.
pub(super) fn reduced_velocities(source: &mut Side, target: &Side, map: &BundleMap) -> Vec<ExprId> {
    let velocity: Vec<ExprId> = map.velocity.iter().map(|located| located.value).collect();
    let Some(distribution) = &target.distribution else { return velocity };
    let place = |symbol: &SymbolId| target.velocities().iter().position(|known| known == symbol);
    let places: Option<Vec<usize>> = distribution.independent.iter().map(place).collect();
    if let Some(places) = places {
        return places.into_iter().map(|place| velocity[place]).collect();
    }
    // sections that span D': B' v' = Φ y, on rows that determine v'
    let mut pull_back = map.pull_back(target);
    let graph = source.graph();
    let basis: Matrix = distribution.basis.iter().map(|row| pull_back.apply_all(graph, row)).collect();
    solved(source, &basis, &velocity).unwrap_or_default()
}

/// The unknowns of an overdetermined linear system that has a solution, by rows that determine them.
fn solved(side: &mut Side, matrix: &Matrix, right: &[ExprId]) -> Option<Vec<ExprId>> {
    let Proved { model, positions, .. } = &mut side.proved;
    let rows = positions.manifold.independent_rows(&mut model.graph, matrix).ok()?;
    model.graph.solve_by_rows(matrix, right, &rows)
}

/// Rows that determine the unknowns wherever all of them do: position constraints leave more rows than unknowns, of
/// which some may say nothing where the motion goes on.
fn rows_everywhere(side: &mut Side, matrix: &Matrix) -> Option<Vec<usize>> {
    let Proved { model, positions, facts, .. } = &mut side.proved;
    let parameters: Vec<SymbolId> = model.parameters.iter().map(|parameter| parameter.symbol).collect();
    let graph = &mut model.graph;
    let columns = Graph::transposed(matrix);
    let on_base = positions.manifold.restrict_matrix(graph, &columns);
    let setting =
        PivotSetting { annihilator: &columns, on_base: &on_base, parameters: &parameters, facts: &*facts };
    let choice = search(graph, &setting, &[], matrix.len()).ok()?.ok()?;
    Some(choice.dependent.iter().map(|row| row.index()).collect())
}

/// The state of the target, each variable with its value as a function on E.
pub(super) fn reduced_state(source: &mut Side, target: &Side, map: &BundleMap) -> Vec<(SymbolId, ExprId)> {
    let velocities = reduced_velocities(source, target, map);
    let kept = target.distribution.as_ref().map_or(target.velocities(), |d| d.independent.as_slice());
    let model = &target.proved.model;
    let coordinates = model.coordinates.iter().map(|coordinate| coordinate.symbol);
    let values = map.coordinates.iter().map(|located| located.value).chain(velocities);
    let along_base = coordinates.chain(kept.iter().copied()).zip(values);
    let auxiliary = model.auxiliary.iter().map(|state| state.symbol).zip(map.auxiliary.iter().copied());
    let all: Vec<(SymbolId, ExprId)> = along_base.chain(auxiliary).collect();
    let find = |symbol: &SymbolId| all.iter().find(|(known, _)| known == symbol).copied();
    target.state.iter().filter_map(find).collect()
}

/// What the source tracks determines the state of the target.
pub(super) fn all_tracked(
    source: &Side,
    map: &BundleMap,
    reduced: &[ExprId],
    inputs: &[ExprId],
) -> Result<(), Violation> {
    let model = &source.proved.model;
    let all: Vec<ExprId> = reduced.iter().chain(inputs).copied().collect();
    let variables = model.coordinates.iter().map(|c| c.symbol).chain(source.velocities().iter().copied());
    let left_out: Vec<SymbolId> = variables.filter(|symbol| !source.state.contains(symbol)).collect();
    let Some(symbol) = model.graph.symbols_in(&all).into_iter().find(|symbol| left_out.contains(symbol))
    else {
        return Ok(());
    };
    let name = &model.graph.symbols()[symbol];
    Err(Violation {
        law: Law::Tracking,
        origin: map.origin,
        what: format!("the reduced state depends on `{name}`, which is not in the state of `{}`", model.name),
        evidence: format!("`track` leaves `{name}` out"),
        way_out: format!("track `{name}` too, or leave `track` out"),
    })
}

/// ġ and the state of the source from the state of the target and the dropped coordinates g. `None`
/// where the velocities of the target do not determine those of the source.
fn reconstruction(source: &mut Side, target: &Side, map: &BundleMap) -> Option<Reconstruction> {
    // 1. symbols for the state of the target; coordinates that are some of the source's are kept
    let model = &target.proved.model;
    let time = source.proved.model.time;
    let graph = source.graph();
    let reduced: Vec<SymbolId> =
        target.state.iter().map(|symbol| graph.new_symbol(model.graph.symbols()[*symbol].clone())).collect();
    let mut kept: Vec<(SymbolId, ExprId)> = Vec::new();
    for (located, symbol) in map.coordinates.iter().zip(&reduced) {
        if let Some(coordinate) = graph.as_symbol(located.value) {
            kept.push((coordinate, graph.symbol(*symbol)));
        }
    }
    let velocities_end = reduced.len() - map.auxiliary.len();
    for (value, symbol) in map.auxiliary.iter().zip(&reduced[velocities_end..]) {
        kept.extend(graph.as_symbol(*value).map(|state| (state, graph.symbol(*symbol))));
    }
    let auxiliary: Vec<SymbolId> = source.proved.model.auxiliary.iter().map(|state| state.symbol).collect();
    if auxiliary.iter().any(|state| kept.iter().all(|(known, _)| known != state)) {
        return None;
    }
    // 2. y' from the state of the target
    let graph = source.graph();
    let values: Vec<ExprId> = reduced.iter().map(|symbol| graph.symbol(*symbol)).collect();
    let parameters = model.parameters.iter().map(|p| p.symbol).zip(map.parameters.iter().map(|l| l.value));
    let images = target.state.iter().copied().zip(values).chain([(model.time, graph.symbol(time))]);
    let images: Vec<(SymbolId, ExprId)> = images.chain(parameters).collect();
    let mut in_reduced = Transplant::new(&model.graph, images);
    let kept_velocities = &reduced[map.coordinates.len()..velocities_end];
    let velocity = match &target.distribution {
        Some(distribution) => in_reduced.apply_all(source.graph(), &distribution.velocity),
        None => kept_velocities.iter().map(|symbol| source.graph().symbol(*symbol)).collect(),
    };
    // 3. y and v from y'
    let on_positions = !target.proved.model.positions.is_empty();
    let (velocity, state_velocities) = velocities(source, map, &velocity, on_positions)?;
    let coordinates: Vec<SymbolId> = source.proved.model.coordinates.iter().map(|c| c.symbol).collect();
    let dropped: Vec<SymbolId> =
        coordinates.iter().copied().filter(|symbol| kept.iter().all(|(known, _)| known != symbol)).collect();
    // 4. ġ = ρ(y)
    let algebroid = &source.proved.system.algebroid;
    let graph = &mut source.proved.model.graph;
    let all_rates = algebroid.rates(graph, &velocity);
    let mut put_in = Substitution::new(kept);
    let mut finished = |graph: &mut Graph, value: ExprId| {
        let value = put_in.apply(graph, value);
        graph.simplify(value)
    };
    let rates = coordinates.iter().zip(all_rates).filter(|(symbol, _)| dropped.contains(symbol));
    let rates = rates.map(|(_, rate)| finished(graph, rate)).collect();
    let mut state = Vec::new();
    for symbol in &coordinates {
        let value = graph.symbol(*symbol);
        state.push(finished(graph, value));
    }
    for value in state_velocities {
        state.push(finished(graph, value));
    }
    for symbol in &auxiliary {
        let value = graph.symbol(*symbol);
        state.push(finished(graph, value));
    }
    let (rates, state) = (Procedure::of(rates), Procedure::of(state));
    Some(Reconstruction { dropped, reduced, rates, state })
}

/// y and the velocities of the source's state from y'.
fn velocities(
    source: &mut Side,
    map: &BundleMap,
    reduced: &[ExprId],
    on_positions: bool,
) -> Option<(Vec<ExprId>, Vec<ExprId>)> {
    let on_positions = on_positions || !source.proved.model.positions.is_empty();
    let rank = source.velocities().len();
    if map.fibre.len() == rank && !on_positions {
        // an isomorphism on the fibres: y = Φ⁻¹ y'
        let right: Matrix = reduced.iter().map(|value| vec![*value]).collect();
        let solution = source.graph().solve_linear(&map.fibre, &right)?;
        let velocity: Vec<ExprId> = solution.values.into_iter().map(|row| row[0]).collect();
        let Some(distribution) = &source.distribution else { return Some((velocity.clone(), velocity)) };
        let place = |symbol: &SymbolId| source.velocities().iter().position(|known| known == symbol);
        let places: Option<Vec<usize>> = distribution.independent.iter().map(place).collect();
        if let Some(places) = places {
            let state = places.into_iter().map(|place| velocity[place]).collect();
            return Some((velocity, state));
        }
    }
    // Φ (B v + y₀) = y' on D
    let distribution = source.distribution.clone()?;
    let sections = distribution.sections();
    let images: Matrix = sections.iter().map(|section| map.image(source, section)).collect();
    let offset = map.image(source, &distribution.offset);
    let graph = source.graph();
    let matrix = Graph::transposed(&images);
    let right: Vec<ExprId> =
        reduced.iter().zip(offset).map(|(value, offset)| graph.formula(value - offset)).collect();
    let state = if on_positions {
        let rows = rows_everywhere(source, &matrix)?;
        source.graph().solve_by_rows(&matrix, &right, &rows)?
    } else {
        solved(source, &matrix, &right)?
    };
    let graph = source.graph();
    let mut velocity = Vec::new();
    for (row, offset) in distribution.basis.iter().zip(&distribution.offset) {
        let linear = graph.inner_product(row, &state);
        velocity.push(graph.formula(linear + offset));
    }
    Some((velocity, state))
}

/// What the map is one of: where a side breaks (2) or (3) it is no Lie algebroid.
pub(super) fn algebroids(source: &Side, target: &Side) -> &'static str {
    let are_lie = [source, target].iter().all(|side| side.proved.broken_laws.is_none());
    if are_lie { "Lie algebroids" } else { "almost Lie algebroids" }
}

/// What was proved, as text.
fn report(source: &mut Side, target: &Side, map: &BundleMap, back: Option<&Reconstruction>) -> String {
    let (from, to) = (source.name(), target.name());
    let (rank, image) = (source.tangent.len(), target.tangent.len());
    let kind = if rank == image { "an isomorphism on every fibre" } else { "onto on every fibre" };
    let mut lines = vec![
        format!("{from} -> {to}"),
        String::new(),
        format!(
            "A morphism of {}, {kind} (rank {rank} to {image}): CLMM 2.3, (13) and (14).",
            algebroids(source, target)
        ),
        "L = L' after the map, D goes onto D', the forces are related: motions go to motions, CLMM \
         Theorems 4.6 and 7.8."
            .to_owned(),
        String::new(),
    ];
    let on_positions = [&*source, target].map(|side| !side.proved.model.positions.is_empty());
    if on_positions.contains(&true) {
        lines.insert(
            4,
            "All of it where the position constraints hold, for velocities tangent to them.".to_owned(),
        );
    }
    let graph = &mut source.proved.model.graph;
    let model = &target.proved.model;
    let names = model.coordinates.iter().map(|c| &c.name).chain(model.sections.iter().map(|s| &s.name));
    for (name, located) in names.zip(map.coordinates.iter().chain(&map.velocity)) {
        let value = graph.simplify(located.value);
        lines.push(format!("  {name} = {}", crate::check::evidence::shown(graph, value)));
    }
    lines.push(String::new());
    lines.push(match back {
        None if on_positions.contains(&true) => {
            "No way back was found by rates that hold wherever the motion does.".to_owned()
        }
        None => "The motion cannot be reconstructed from the reduced one by quadratures alone.".to_owned(),
        Some(back) if back.dropped.is_empty() => "No coordinate is dropped.".to_owned(),
        Some(back) => {
            let names: Vec<&str> = back.dropped.iter().map(|s| graph.symbols()[*s].as_str()).collect();
            format!("Dropped coordinates, which follow from the reduced motion: {}.", names.join(", "))
        }
    });
    if let Some(back) = back {
        for (symbol, rate) in back.dropped.iter().zip(&back.rates.outputs) {
            let text = crate::check::evidence::shown(graph, *rate);
            lines.push(format!("  {}' = {text}", graph.symbols()[*symbol]));
        }
    }
    lines.push(String::new());
    lines.join("\n")
}
