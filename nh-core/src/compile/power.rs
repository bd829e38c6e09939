//! The power of forces and constraints, mathematics (41): dE_L/dt = Υ_α y^α + λ_A y^α ∂φ^A/∂y^α − ∂_tL.

use super::proved::Proved;
use super::velocities_of_state::{in_state, requested};
use crate::algebra::Substitution;
use crate::id::ExprId;
use crate::mechanics::{Definition, Procedure};
use crate::model::Request;

/// y^α ∂φ^A/∂y^α of each constraint, −b^A where φ^A is affine: 0 where it is homogeneous. Empty where nobody asks
/// for the power.
pub(super) fn work_of_constraints(proved: &mut Proved, rows: usize) -> Vec<ExprId> {
    if !requested(&proved.model, Request::Power) {
        return Vec::new();
    }
    let Proved { model, system, constraints, .. } = proved;
    let graph = &mut model.graph;
    let velocity = system.algebroid.velocity(graph);
    let mut found: Vec<ExprId> = match &constraints.linear {
        Some(linear) => linear.drift.iter().map(|drift| graph.formula(-drift)).collect(),
        None => constraints
            .residuals
            .iter()
            .map(|residual| {
                let row: Vec<ExprId> =
                    system.algebroid.velocities.iter().map(|y| graph.partial(*residual, *y)).collect();
                graph.inner_product(&row, &velocity)
            })
            .collect(),
    };
    for work in &mut found {
        if constraints.generic().zero_test(graph, *work).is_zero() {
            *work = graph.zero();
        }
    }
    found.resize(rows, graph.zero());
    found
}

/// Outputs: the power of each declared force, then of each constraint; if it is asked for.
pub(super) fn power(
    proved: &mut Proved,
    restriction: &mut Substitution,
    given: &Procedure,
    multipliers: &Procedure,
    work: &[ExprId],
) -> Option<Procedure> {
    if !requested(&proved.model, Request::Power) {
        return None;
    }
    let forces = proved.model.forces.clone();
    let mut outputs = Vec::with_capacity(forces.len() + work.len());
    // 1. Υ_α y^α, or Q_i ẋ^i
    for force in forces {
        let along = proved.along(force.direction);
        let Proved { model, motion, system, .. } = &mut *proved;
        let graph = &mut model.graph;
        let velocity = match along {
            Ok(row) => {
                let velocity = system.algebroid.velocity(graph);
                graph.inner_product(&row, &velocity)
            }
            Err(velocity) => graph.symbol(velocity),
        };
        let power = graph.formula(force.value * velocity);
        outputs.push(in_state(graph, motion, restriction, power));
    }
    // 2. λ_A y^α ∂φ^A/∂y^α
    let graph = &mut proved.model.graph;
    for (index, work) in work.iter().enumerate() {
        let work = restriction.apply(graph, *work);
        let multiplier = multipliers.outputs.get(index).copied().unwrap_or_else(|| graph.zero());
        outputs.push(graph.formula(multiplier * work));
    }
    let known: Vec<_> = multipliers.definitions.iter().map(defined).collect();
    let missing = given.definitions.iter().filter(|definition| !known.contains(&defined(definition)));
    let mut procedure = multipliers.with_outputs(outputs);
    procedure.definitions = missing.cloned().chain(std::mem::take(&mut procedure.definitions)).collect();
    Some(procedure)
}

/// The symbols of an intermediate result.
fn defined(definition: &Definition) -> Vec<crate::id::SymbolId> {
    match definition {
        Definition::Value { symbol, .. } | Definition::Call { symbol, .. } => vec![*symbol],
        Definition::Solve { unknowns, .. } => unknowns.clone(),
    }
}
