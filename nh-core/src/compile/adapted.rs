//! The functions of a system in the adapted formulation.

use super::cancellation::without_needless_cancellation;
use super::embedded::embedding;
use super::gibbs_appell;
use super::gyroscopic;
use super::levels::{Leveled, again};
use super::momenta::momenta;
use super::phase_space;
use super::restricted::{
    calls, coordinates, in_state, observables, parameter_checks, parameter_divisors, requested,
    requested_jacobian, requested_parameter_jacobian,
};
use super::{Proved, fence};
use crate::algebra::{Accuracy, Graph};
use crate::check;
use crate::count::Count;
use crate::functions::{
    ENERGY, GIBBS_APPELL, GYROSCOPIC, MULTIPLIERS, OUTPUTS, PARAMETER_JACOBIAN, REACTIONS, VELOCITY,
};
use crate::geometry::ConstraintDistribution;
use crate::id::{ExprId, Id};
use crate::mechanics::{
    Definiteness, Definition, Flow, Procedure, ReducedEquations, definiteness, energy, equations_by_momenta,
    equations_by_partial_velocities, equations_by_velocity_forms, equations_in_wheel_frames, reaction_forces,
    reduced_equations, solve_symmetric,
};
use crate::model::{Formulation, Request};
use crate::program::{Program, error_growth, order, schedule_roughly};
use crate::report::{Derived, equations_of_motion, report};
use crate::system::System;
use crate::violation::Violation;

/// Derives everything from a basis of D and the velocities that levels of momenta leave.
pub(super) fn derive(
    mut proved: Proved,
    distribution: &ConstraintDistribution,
    leveled: &Leveled,
    conditions: &[ExprId],
    reason: &str,
) -> Result<System, Vec<Violation>> {
    let conditions = &[conditions, &leveled.conditions].concat();
    // 1. C v̇ = f, proved regular
    let mut candidates = candidates(&mut proved, distribution, leveled);
    let singular = check::reduced_regularity(&mut proved.model, &candidates[0], &proved.base);
    fence(singular.into_iter().collect())?;
    // 2. v̇
    let velocities = &proved.system.algebroid.velocities;
    let kept = &leveled.kept;
    let mut restriction = kept.restriction(&proved.model.graph, velocities);
    let calls = calls(&mut proved.model, &mut proved.motion, &mut restriction);
    let derivative = cheapest_derivative(&mut proved, &candidates, &calls);
    let gibbs_appell = gibbs_appell::on_distribution(&mut proved, kept, &calls);
    let equations = candidates.swap_remove(0);
    let (multipliers, reactions) =
        if requested(&proved.model, Request::Multipliers) || requested(&proved.model, Request::Reactions) {
            let accelerations = &derivative.outputs[equations.rates.len()..];
            constraint_forces(&mut proved, kept, &derivative, accelerations)
        } else {
            Default::default()
        };
    let jacobian = requested_jacobian(&mut proved.model, &derivative, &kept.independent)
        .map_err(|violation| vec![violation])?;
    let parameter_jacobian =
        requested_parameter_jacobian(&mut proved.model, &derivative).map_err(|violation| vec![violation])?;
    let (momenta, mut functions) = momenta(&mut proved, &mut restriction, &derivative, &kept.independent);
    let (gyroscopic, gyroscopic_force) = gyroscopic::derive(&mut proved, Some(distribution))?;
    let graph = &mut proved.model.graph;
    // 3. E_L, y and the observables on D
    let energy = energy(graph, &proved.system);
    let energy = restriction.apply(graph, energy);
    let energy = if is_large(&proved) { energy } else { proved.model.graph.simplify(energy) };
    let observables = observables(&mut proved.model, &mut proved.motion, &mut restriction);
    // 4. the claims, along the flow
    let claims: Vec<ExprId> = proved
        .model
        .claims
        .iter()
        .map(|claim| in_state(&mut proved.model.graph, &mut proved.motion, &mut restriction, claim.value))
        .collect();
    if !claims.is_empty() {
        let flow = Flow::of(&mut proved.model.graph, &derivative, &proved.system, &equations.independent);
        fence(check::claims(&mut proved.model, &claims, flow, &proved.base))?;
    }
    // 5. the report
    let embedding = embedding(&mut proved.model, &proved.base);
    let derived = Derived::Adapted { distribution, kept, equations: &equations };
    let (phase_space, sections) =
        phase_space::derive(&mut proved, &derived, &derivative, &observables, &claims, &mut functions)?;
    let text = report(&mut proved, &derived, reason, conditions, sections);
    let lines = equations_of_motion(&proved.model, &derived);
    let divisors = parameter_divisors(&mut proved.model, &derivative);
    let conditions = [conditions.as_slice(), &divisors].concat();
    let model = proved.model;
    functions.add(&ENERGY, Procedure::of(vec![energy]));
    functions.add(&VELOCITY, Procedure::of(equations.velocity.clone()));
    functions.add(&OUTPUTS, observables);
    functions.add_if(&MULTIPLIERS, requested(&model, Request::Multipliers).then_some(multipliers));
    functions.add_if(&REACTIONS, requested(&model, Request::Reactions).then_some(reactions));
    functions.add_if(&GIBBS_APPELL, gibbs_appell);
    functions.add_if(&PARAMETER_JACOBIAN, parameter_jacobian);
    functions.add_if(&GYROSCOPIC, gyroscopic_force);
    Ok(System {
        formulation: Formulation::Adapted,
        state_coordinates: coordinates(&model),
        state_velocities: kept.independent.clone(),
        derivative,
        functions,
        momenta,
        gyroscopic,
        quadratures: Vec::new(),
        jacobian,
        projection: None,
        phase_space,
        embedding,
        parameter_checks: parameter_checks(&model, &conditions),
        report: text,
        equations: lines,
        model,
    })
}

/// Lagrangians with more operations than this are not expanded: the equations are derived in
/// velocity forms alone.
const EXPANDED: u64 = 250;
/// The same where points are carried by wheels: the recursion from wheel to wheel is shorter than what
/// expansion comes to as soon as there are several bodies.
const EXPANDED_ON_WHEELS: u64 = 60;

/// The coefficients of longer velocities on D are not named one by one: expressions of that size are those of
/// chains, which are shorter from wheel to wheel.
const NAMED: u64 = 60;

/// Whether expressions of the size of the Lagrangian are left as they are.
fn is_large(proved: &Proved) -> bool {
    proved.model.graph.operation_count(&[proved.system.lagrangian]) > EXPANDED
}

/// The equations in the forms worth comparing, the one to show first.
fn candidates(
    proved: &mut Proved,
    distribution: &ConstraintDistribution,
    leveled: &Leveled,
) -> Vec<ReducedEquations> {
    if proved.model.orthonormal.is_some() {
        return in_orthonormal_basis(proved, distribution);
    }
    let is_large = is_large(proved);
    let (system, graph) = (&proved.system, &mut proved.model.graph);
    let chained = distribution.chained(graph, &proved.constraints.residuals, &system.algebroid.velocities);
    let chained = again(proved, &chained, &leveled.kept.eliminated);
    let (system, graph) = (&proved.system, &mut proved.model.graph);
    let distribution = &leveled.kept;
    let by_chain = equations_by_velocity_forms(graph, system, &chained);
    // these solve the constraints anew, and know nothing of levels
    let residuals = proved.levels.is_empty().then_some(&proved.constraints.residuals);
    let on_wheels =
        residuals.and_then(|residuals| equations_in_wheel_frames(graph, system, distribution, residuals));
    // careful code carries the errors of divisions along, and every quotient put in place has its own
    let is_short = !is_large && graph.operation_count(&distribution.velocity) <= NAMED;
    let by_parts = match graph.accuracy() {
        Accuracy::Fast | Accuracy::Balanced if is_short => {
            equations_by_partial_velocities(graph, system, distribution)
        }
        _ => None,
    };
    if is_large || (on_wheels.is_some() && graph.operation_count(&[system.lagrangian]) > EXPANDED_ON_WHEELS) {
        return std::iter::once(by_chain).chain(on_wheels).chain(by_parts).collect();
    }
    let by_forms = equations_by_velocity_forms(graph, system, distribution);
    let expanded = reduced_equations(graph, system, distribution);
    let by_momenta = equations_by_momenta(graph, system, distribution);
    let written_out = [expanded, by_forms, by_chain].into_iter();
    written_out.chain(by_momenta).chain(on_wheels).chain(by_parts).collect()
}

/// Where the basis was made orthonormal, C is the identity: what is proved to be 0 or 1 is written so.
fn in_orthonormal_basis(proved: &mut Proved, distribution: &ConstraintDistribution) -> Vec<ReducedEquations> {
    let (system, graph) = (&proved.system, &mut proved.model.graph);
    let by_forms = equations_by_velocity_forms(graph, system, distribution);
    let expanded = reduced_equations(graph, system, distribution);
    let mut candidates = vec![expanded, by_forms];
    for candidate in &mut candidates {
        for (a, row) in candidate.mass.iter_mut().enumerate() {
            for (b, entry) in row.iter_mut().enumerate() {
                let unit = if a == b { graph.one() } else { graph.zero() };
                let defect = graph.sub(*entry, unit);
                if graph.zero_test(defect).is_zero() {
                    *entry = unit;
                }
            }
        }
    }
    candidates
}

/// Forms whose equations take so much more work than the shortest, before they are solved, are not
/// solved: they have never been the cheapest.
const LONGER: u64 = 40;

/// The derivative by whichever form of the equations takes less work, unless that loses more accuracy
/// than is allowed.
fn cheapest_derivative(proved: &mut Proved, candidates: &[ReducedEquations], calls: &Procedure) -> Procedure {
    let parameters: Vec<_> = proved.model.parameters.iter().map(|parameter| parameter.symbol).collect();
    // the mass matrix is the same in all forms, and the first is written out
    let definite = candidates.first().map_or(Definiteness::Unknown, |first| {
        definiteness(&proved.model.graph, &first.mass, &parameters, &proved.facts)
    });
    let graph = &mut proved.model.graph;
    let lengths: Vec<Count> = candidates.iter().map(|candidate| candidate.length(graph)).collect();
    let shortest = lengths.iter().copied().min().unwrap_or_default();
    let mut procedures = Vec::with_capacity(candidates.len());
    let mut compared: Vec<Vec<ExprId>> = Vec::new();
    for (candidate, length) in candidates.iter().zip(lengths) {
        if length > shortest + LONGER && length * 2 > shortest * 3 {
            continue;
        }
        let mut procedure = calls.clone();
        procedure.definitions.extend(candidate.definitions.definitions.iter().cloned());
        let accelerations =
            solve_symmetric(graph, &candidate.mass, &candidate.force, definite, &mut procedure, "v_dot");
        procedure.outputs = candidate.rates.iter().chain(&accelerations).copied().collect();
        // different ways often lead to the same equations
        let values = procedure.values(graph);
        if !compared.contains(&values) {
            compared.push(values);
            procedures.push(procedure);
        }
    }
    // a single candidate needs no comparison
    let best = if procedures.len() < 2 { 0 } else { cheapest(graph, &procedures) };
    let best = procedures.into_iter().nth(best).unwrap_or_default();
    without_needless_cancellation(graph, best, &proved.system.algebroid.anchor.coordinates)
}

/// The cheapest of several procedures of the same value, among those whose rounding error the level of
/// accuracy allows.
pub(super) fn cheapest(graph: &Graph, procedures: &[Procedure]) -> usize {
    let programs: Vec<Program> =
        procedures.iter().map(|procedure| schedule_roughly(graph, procedure)).collect();
    let growth = error_growth(&programs).into_iter();
    let growth: Vec<f64> = match graph.accuracy() {
        Accuracy::Fast => growth.map(|growth| if growth.is_finite() { 1.0 } else { growth }).collect(),
        Accuracy::Balanced | Accuracy::Careful => growth.collect(),
    };
    let least = growth.iter().copied().fold(f64::INFINITY, f64::min);
    let allowed = graph.accuracy().growth().max(least);
    let sound = programs.iter().zip(growth).enumerate().filter(|(_, (_, growth))| *growth <= allowed);
    sound.min_by_key(|(_, (program, _))| order(program)).map_or(0, |(index, _)| index)
}

/// Forces of constraint are differences of inertial and applied forces, which may cancel. Where the
/// accelerations put in and simplified give short expressions with no more rounding error, these
/// are evaluated instead.
fn without_cancellation(graph: &mut Graph, derivative: &Procedure, outputs: Vec<ExprId>) -> Procedure {
    const SHORT: u64 = 240;
    let procedure = derivative.with_outputs(outputs);
    let written_out = procedure.written_out(graph);
    if graph.operation_count(&written_out) > 2 * SHORT {
        return procedure;
    }
    let simplified = graph.simplify_all(&written_out);
    let accurate =
        simplified.iter().zip(&written_out).all(|(short, long)| graph.error_growth(*short, *long) <= 1.0);
    if accurate && graph.operation_count(&simplified) <= SHORT {
        let mut short = Procedure::of(simplified);
        let is_call = |definition: &&Definition| matches!(definition, Definition::Call { .. });
        short.definitions.extend(derivative.definitions.iter().filter(is_call).cloned());
        return short;
    }
    procedure
}

/// λ and λ_A Φ^A_α from δL_α − Υ_α = λ_A Φ^A_α, mathematics (7), at the accelerations found.
fn constraint_forces(
    proved: &mut Proved,
    distribution: &ConstraintDistribution,
    derivative: &Procedure,
    accelerations: &[ExprId],
) -> (Procedure, Procedure) {
    let graph = &mut proved.model.graph;
    // 1. δL_α − Υ_α
    let reactions = reaction_forces(graph, &proved.system, distribution, accelerations);
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
    (without_cancellation(graph, derivative, multipliers), without_cancellation(graph, derivative, reactions))
}
