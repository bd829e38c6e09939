//! The functions of a system in the adapted formulation.

use super::embedded::embedding;
use super::restricted::{calls, in_state, observables, parameter_checks, requested};
use super::{Proved, fence};
use crate::algebra::Graph;
use crate::check;
use crate::geometry::ConstraintDistribution;
use crate::id::{ExprId, Id};
use crate::mechanics::{
    Flow, Procedure, ReducedEquations, definiteness, energy, reduced_equations, solve_symmetric,
};
use crate::model::{Formulation, Request};
use crate::report::{Derived, equations_of_motion, report};
use crate::system::System;
use crate::violation::Violation;

/// Derives everything from a basis of D.
pub(super) fn derive(
    mut proved: Proved,
    distribution: &ConstraintDistribution,
    conditions: &[ExprId],
    reason: &str,
) -> Result<System, Vec<Violation>> {
    // 1. C v̇ = f, proved regular
    let equations = reduced_equations(&mut proved.model.graph, &proved.system, distribution);
    let singular = check::reduced_regularity(&mut proved.model, &equations, &proved.base);
    fence(singular.into_iter().collect())?;
    // 2. v̇
    let parameters: Vec<_> = proved.model.parameters.iter().map(|parameter| parameter.symbol).collect();
    let definite = definiteness(&proved.model.graph, &equations.mass, &parameters, &proved.facts);
    let velocities = &proved.system.algebroid.velocities;
    let mut restriction = distribution.restriction(&mut proved.model.graph, velocities);
    let mut derivative = calls(&mut proved.model, &mut proved.motion, &mut restriction);
    let graph = &mut proved.model.graph;
    let accelerations =
        solve_symmetric(graph, &equations.mass, &equations.force, definite, &mut derivative, "v_dot");
    let (multipliers, reactions) =
        constraint_forces(graph, distribution, &equations, &derivative, &accelerations);
    derivative.outputs = equations.rates.iter().chain(&accelerations).copied().collect();
    // 3. E_L, y and the observables on D
    let energy = energy(graph, &proved.system);
    let energy = restriction.apply(graph, energy);
    let energy = graph.simplify(energy);
    let observables = observables(&mut proved.model, &mut proved.motion, &mut restriction);
    // 4. the claims, along the flow
    let claims: Vec<ExprId> = proved
        .model
        .claims
        .iter()
        .map(|claim| in_state(&mut proved.model.graph, &mut proved.motion, &mut restriction, claim.value))
        .collect();
    let flow = Flow::of(&mut proved.model.graph, &derivative, &proved.system, &equations.independent);
    fence(check::claims(&mut proved.model, &claims, flow, &proved.base))?;
    // 5. the report
    let embedding = embedding(&mut proved.model, &proved.base);
    let derived = Derived::Adapted { distribution, equations: &equations };
    let text = report(&mut proved, &derived, reason, conditions);
    let lines = equations_of_motion(&proved.model, &derived);
    let model = proved.model;
    Ok(System {
        formulation: Formulation::Adapted,
        state_velocities: distribution.independent.clone(),
        derivative,
        energy: Procedure::of(vec![energy]),
        velocity: Procedure::of(equations.velocity.clone()),
        observables,
        multipliers: requested(&model, Request::Multipliers).then_some(multipliers),
        reactions: requested(&model, Request::Reactions).then_some(reactions),
        residual: None,
        projection: None,
        embedding,
        parameter_checks: parameter_checks(&model, conditions),
        report: text,
        equations: lines,
        model,
    })
}

/// λ and λ_A Φ^A_α from δL_α − Υ_α = λ_A Φ^A_α, mathematics (7), at the accelerations found.
fn constraint_forces(
    graph: &mut Graph,
    distribution: &ConstraintDistribution,
    equations: &ReducedEquations,
    derivative: &Procedure,
    accelerations: &[ExprId],
) -> (Procedure, Procedure) {
    // 1. δL_α − Υ_α = rest_α + ∂p̂_α/∂v^b v̇^b
    let reactions: Vec<ExprId> = equations
        .rest
        .iter()
        .enumerate()
        .map(|(alpha, rest)| {
            let column: Vec<ExprId> = equations.inertia.iter().map(|row| row[alpha]).collect();
            let inertial = graph.inner_product(&column, accelerations);
            graph.add(*rest, inertial)
        })
        .collect();
    // 2. the dependent rows determine λ
    let annihilator = &distribution.constraints.annihilator;
    let matrix: Vec<Vec<ExprId>> = distribution
        .dependent
        .iter()
        .map(|section| annihilator.iter().map(|row| row[section.index()]).collect())
        .collect();
    let right: Vec<Vec<ExprId>> =
        distribution.dependent.iter().map(|section| vec![reactions[section.index()]]).collect();
    let solved = graph.solve_linear(&matrix, &right).map(|solution| solution.values).unwrap_or_default();
    let multipliers = solved.into_iter().map(|row| row[0]).collect();
    (derivative.with_outputs(multipliers), derivative.with_outputs(reactions))
}
