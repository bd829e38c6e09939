//! The functions of a system in the adapted formulation.

use super::competition::{candidates, plain, plain_derivative, proved_derivative, reference, show_proved};
use super::constraint_forces::constraint_forces;
use super::embedded::embedding;
use super::gibbs_appell;
use super::gyroscopic;
use super::levels::Leveled;
use super::momenta::momenta;
use super::phase_space;
use super::restricted::{
    calls, coordinates, in_state, observables, parameter_checks, parameter_divisors, requested,
    requested_jacobian, requested_parameter_jacobian,
};
use super::{Proved, fence, nothing_proved};
use crate::check;
use crate::choose::{Decision, limits};
use crate::forms::Registry;
use crate::functions::{
    ENERGY, GIBBS_APPELL, GYROSCOPIC, MULTIPLIERS, OUTPUTS, PARAMETER_JACOBIAN, REACTIONS, VELOCITY,
};
use crate::geometry::ConstraintDistribution;
use crate::id::ExprId;
use crate::limits::{Subject, about};
use crate::mechanics::{Flow, Procedure, energy};
use crate::model::{Formulation, Request};
use crate::report::{Derived, equations_of_motion, report};
use crate::system::System;
use crate::violation::Violation;

/// Derives everything from a basis of D and the velocities that levels of momenta leave.
pub(super) fn derive(
    mut proved: Proved,
    registry: &Registry,
    (distribution, leveled): (&ConstraintDistribution, &Leveled),
    (conditions, reason): (&[ExprId], &str),
) -> Result<System, Vec<Violation>> {
    let conditions = &[conditions, &leveled.conditions].concat();
    let kept = &leveled.kept;
    // 1. C v̇ = f, proved to be what is declared, and regular
    let reference = reference(&mut proved, distribution, kept);
    let (mut shown, mut chosen) = (Decision::default(), Decision::default());
    let mut candidates = candidates(&mut proved, registry, distribution, kept, &mut chosen);
    show_proved(&proved.model.graph, &reference, kept, &mut candidates, &mut shown);
    if candidates.is_empty() {
        candidates.push(plain(&mut proved, kept));
        show_proved(&proved.model.graph, &reference, kept, &mut candidates, &mut shown);
    }
    proved.ledger.decisions.push(shown);
    let Some(first) = candidates.first() else {
        return Err(nothing_proved(proved.model.origin, &proved.ledger));
    };
    let equations = first.equations.clone();
    let singular = check::reduced_regularity(&mut proved.model, &equations, &proved.base);
    fence(singular.into_iter().collect())?;
    // 2. v̇
    about(Subject::Solution);
    let velocities = &proved.system.algebroid.velocities;
    let mut restriction = kept.restriction(&proved.model.graph, velocities);
    let calls = calls(&mut proved.model, &mut proved.motion, &mut restriction);
    let derivative = proved_derivative(&mut proved, &reference, &candidates, &calls, &mut chosen)
        .or_else(|| plain_derivative(&mut proved, &reference, kept, &calls, &mut chosen));
    proved.ledger.decisions.push(chosen);
    let derivative = derivative.ok_or_else(|| nothing_proved(proved.model.origin, &proved.ledger))?;
    about(Subject::Requests);
    let gibbs_appell = gibbs_appell::on_distribution(&mut proved, kept, &calls);
    gibbs_appell::prove_it(&mut proved, &reference, gibbs_appell.as_ref())?;
    let (multipliers, reactions) =
        if requested(&proved.model, Request::Multipliers) || requested(&proved.model, Request::Reactions) {
            let accelerations = &derivative.outputs[equations.rates.len()..];
            constraint_forces(&mut proved, &reference, kept, &derivative, accelerations)?
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
    about(Subject::Claims);
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
    about(Subject::Requests);
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
        ledger: proved.ledger,
        report: text,
        equations: lines,
        model,
    })
}

/// Whether expressions of the size of the Lagrangian are left as they are.
fn is_large(proved: &Proved) -> bool {
    proved.model.graph.operation_count(&[proved.system.lagrangian]) > limits::EXPANDED
}
