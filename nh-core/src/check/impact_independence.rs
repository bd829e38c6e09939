//! Whether the rows of an impact are independent of each other and of the constraints, where they act.

use super::assumptions::{demand, on_the_base};
use super::dependence::{combination_of, place_of, where_they_hold};
use super::evidence::{name_of, shown};
use super::formulation::Chosen;
use super::impact_rows::{Between, ImpactRow, refused};
use super::no_force::{multiples_without_slope, without_slope};
use crate::algebra::{Demand, Matrix};
use crate::geometry::Manifold;
use crate::id::{ExprId, SymbolId};
use crate::model::Model;
use crate::violation::Violation;

/// A row that follows from others where they act.
pub(super) fn dependent(model: &mut Model, between: &Between, rows: &[ImpactRow]) -> Option<Violation> {
    let (holding, names) = holding(model, between);
    let bilateral: Vec<usize> = (0..rows.len()).filter(|row| !rows[*row].is_unilateral).collect();
    let mut kept: Vec<usize> = Vec::new();
    for row in &bilateral {
        if let Some(violation) = follows(model, between, (&holding, &names), rows, &kept, *row) {
            return Some(violation);
        }
        kept.push(*row);
    }
    let unilateral: Vec<usize> = (0..rows.len()).filter(|row| rows[*row].is_unilateral).collect();
    // few rows together first, so that a combination is shown by the rows that it takes
    let mut choices: Vec<u32> = (1..1_u32 << unilateral.len()).collect();
    choices.sort_by_key(|choice| choice.count_ones());
    let mut apart: Vec<u32> = Vec::new();
    for choice in choices {
        if apart.iter().any(|known| known & choice == *known) {
            continue;
        }
        let chosen = unilateral.iter().enumerate().filter(|(bit, _)| choice >> bit & 1 == 1);
        let mut together: Vec<usize> = chosen.map(|(_, row)| *row).collect();
        let Some(last) = together.pop() else { continue };
        let before = [kept.as_slice(), &together].concat();
        let Some(violation) = follows(model, between, (&holding, &names), rows, &before, last) else {
            continue;
        };
        together.push(last);
        if together.len() > 1 && never_together(model, rows, &together) {
            apart.push(choice);
        } else {
            return Some(violation);
        }
    }
    None
}

/// The rows of the constraints along the velocities of the state, with what they are called; none where the state
/// satisfies them by itself.
fn holding(model: &Model, between: &Between) -> (Matrix, Vec<String>) {
    match (between.chosen, &between.constraints.linear) {
        (Chosen::Projected { .. }, Some(linear)) => {
            let names = model.constraints.ids().map(|id| name_of(model, id));
            (linear.annihilator.clone(), names.collect())
        }
        _ => (Matrix::new(), Vec::new()),
    }
}

/// What to do about a row that takes no impulse.
fn without_impulse(model: &mut Model, velocities: &[SymbolId], row: &ImpactRow) -> &'static str {
    let graph = &mut model.graph;
    if row.coefficients.iter().all(|entry| graph.zero_test(*entry).is_zero()) {
        let is_constant = velocities.iter().all(|velocity| {
            let along = graph.partial(row.form, *velocity);
            graph.zero_test(along).is_zero()
        });
        return if row.is_unilateral && is_constant {
            "write a gap between positions, which motions open and close: `h >= 0`"
        } else {
            "leave it out"
        };
    }
    "leave it out, or write it without a power: `a - b >= 0` instead of `(a - b)^2 >= 0`"
}

/// That a row is a combination of others where all of them act.
fn follows(
    model: &mut Model,
    between: &Between,
    (holding, names): (&Matrix, &[String]),
    rows: &[ImpactRow],
    before: &[usize],
    row: usize,
) -> Option<Violation> {
    let others = before.iter().map(|other| &rows[*other]);
    let matrix: Matrix =
        holding.iter().cloned().chain(others.clone().map(|other| other.coefficients.clone())).collect();
    let names: Vec<String> =
        names.iter().cloned().chain(others.clone().map(|other| format!("`{}`", other.name))).collect();
    let closed: Vec<ExprId> = others.chain([&rows[row]]).filter_map(|row| row.position).collect();
    let manifold = where_closed(model, between, &closed);
    let whole: Matrix = matrix.iter().cloned().chain([rows[row].coefficients.clone()]).collect();
    let mut found = Vec::new();
    for part in manifold.parts() {
        let restricted = part.restrict_matrix(&mut model.graph, &whole);
        match model.graph.generic_rank(&restricted) {
            Ok(rank) => found.push((part, restricted, rank)),
            Err(why) => {
                return Some(refused(
                    rows[row].origin,
                    format!(
                        "whether `{}` follows from what holds already could not be decided",
                        rows[row].name
                    ),
                    why,
                    "write it without roots of negative numbers and divisions by zero",
                ));
            }
        }
    }
    let Some((part, restricted, rank)) = found.iter().find(|(_, restricted, rank)| *rank < restricted.len())
    else {
        let why = touching(model, &rows[row], &closed, &manifold)?;
        let what = format!("`{}` only touches where it is closed: it takes no impulse there", rows[row].name);
        return Some(refused(rows[row].origin, what, why, "correct it, or leave it out"));
    };
    let (restricted, rank) = (restricted.clone(), *rank);
    let is_everywhere = found.iter().all(|(_, restricted, rank)| *rank < restricted.len());
    let place =
        if is_everywhere { String::new() } else { format!(": so it is{}", place_of(model, &manifold, part)) };
    let name = format!("`{}`", rows[row].name);
    let last = restricted.last().cloned().unwrap_or_default();
    if rank < matrix.len() {
        // those before it are reported by themselves
        return None;
    }
    if last.iter().all(|entry| model.graph.zero_test(*entry).is_zero()) {
        return Some(refused(
            rows[row].origin,
            format!("{name} takes no impulse: the constraints permit no velocity that changes it{place}"),
            format!("the rate of {name} is 0 for all velocities that they permit where it acts"),
            without_impulse(model, &between.system.algebroid.velocities, &rows[row]),
        ));
    }
    let may_be_apart = rows[row].is_unilateral && before.iter().any(|other| rows[*other].is_unilateral);
    let way_out = if may_be_apart {
        "leave it out; or, if they cannot be closed together, say in `assume` what keeps them apart"
    } else {
        "leave it out"
    };
    let evidence = combination_of(&mut model.graph, &restricted[..matrix.len()], &last, &names, &name);
    Some(refused(
        rows[row].origin,
        format!("{name} follows from what holds already where it acts{place}"),
        evidence,
        way_out,
    ))
}

/// Why the gap of a row only touches 0, by itself or where constraints hold and others are closed, in words.
fn touching(model: &mut Model, row: &ImpactRow, closed: &[ExprId], manifold: &Manifold) -> Option<String> {
    let gap = row.position?;
    let coordinates: Vec<SymbolId> = model.coordinates.iter().map(|c| c.symbol).collect();
    if let Some((why, _)) = without_slope(&mut model.graph, gap, &coordinates) {
        return Some(why);
    }
    let demands = on_the_base(model);
    if let Some(radicand) = manifold.touching(&mut model.graph, &demands) {
        let radicand = shown(&model.graph, radicand);
        return Some(format!(
            "solved for coordinates, what holds there contains the root of {radicand}, which is positive nowhere"
        ));
    }
    let positions = model.positions.iter().map(|position| position.value);
    let values: Vec<ExprId> = positions.chain(closed.iter().copied()).collect();
    let why = multiples_without_slope(model, &values)?;
    Some(format!("multiples of gaps and position constraints add up to what has no slope: {why}"))
}

/// Where the position constraints hold and gaps are closed, as far as that is solved for coordinates: parameters keep
/// their freedom, since what is refused has to be wrong for all of them.
fn where_closed(model: &mut Model, between: &Between, gaps: &[ExprId]) -> Manifold {
    let coordinates: Vec<SymbolId> = model.coordinates.iter().map(|c| c.symbol).collect();
    let positions = &between.positions.manifold;
    let parameters: Vec<SymbolId> = model.parameters.iter().map(|parameter| parameter.symbol).collect();
    let mut closed = None;
    if positions.images().iter().any(|(symbol, _)| parameters.contains(symbol)) {
        let values = model.positions.iter().map(|position| position.value);
        let values: Vec<ExprId> = values.chain(gaps.iter().copied()).collect();
        let base = between.positions.base();
        let found = Manifold::of_positions(&mut model.graph, base, &values, [&coordinates, &[]]);
        closed = found.unsolved.is_empty().then_some(found.manifold);
    }
    let mut closed = closed.unwrap_or_else(|| {
        Manifold::of_positions(&mut model.graph, positions, gaps, [&coordinates, &[]]).manifold
    });
    let mut demands = where_they_hold(model);
    demands.extend(gaps.iter().map(|gap| (*gap, Demand::Zero)));
    closed.keep_parts_with_points(&mut model.graph, &demands);
    closed
}

/// Whether what is assumed keeps gaps from being closed together.
fn never_together(model: &mut Model, rows: &[ImpactRow], together: &[usize]) -> bool {
    let mut demands: Vec<(ExprId, Demand)> = Vec::new();
    for assumption in model.assumptions.clone() {
        demands.push(demand(&mut model.graph, &assumption));
    }
    let positions = model.positions.iter().map(|position| position.value);
    let gaps = together.iter().filter_map(|row| rows[*row].position);
    demands.extend(positions.chain(gaps).map(|value| (value, Demand::Zero)));
    model.graph.contradiction(&demands).is_some()
}
