//! The functions of a system in the adapted formulation.

use super::competition::{candidates, plain, plain_derivative, proved_derivative, reference, show_proved};
use super::completion::{Derivation, complete};
use super::constraint_forces::constraint_forces;
use super::differentiated::{requested_linearized, requested_output_jacobian, requested_parameter_jacobian};
use super::gibbs_appell_function;
use super::given;
use super::gyroscopic;
use super::impact_functions;
use super::levels::Leveled;
use super::momenta::momenta;
use super::position_return::position_return;
use super::power::{power, work_of_constraints};
use super::proved::{Derived, Proved, fence, nothing_proved};
use super::proved_functions::Parts;
use super::velocities_of_state::{
    claims_in_state, divides_by_free_parameters, observables, parameter_divisors,
};
use crate::algebra::{Graph, Matrix, Substitution};
use crate::check;
use crate::choose::{Decision, sizes};
use crate::forms::Registry;
use crate::functions::{ENERGY, GYROSCOPIC, OUTPUT_JACOBIAN, PARAMETER_JACOBIAN, POWER, RESIDUAL, VELOCITY};
use crate::geometry::ConstraintDistribution;
use crate::id::{ExprId, SymbolId};
use crate::limits::{Subject, about};
use crate::mechanics::{Definiteness, Flow, Procedure, definiteness, energy, saddle_equations};
use crate::system::{PositionReturn, System};
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
    show_proved(&proved.model.graph, &reference, kept, &mut candidates.equations, &mut shown);
    if candidates.equations.is_empty() {
        candidates.equations.push(plain(&mut proved, kept));
        show_proved(&proved.model.graph, &reference, kept, &mut candidates.equations, &mut shown);
    }
    proved.ledger.decisions.push(shown);
    let Some(first) = candidates.equations.first() else {
        return Err(nothing_proved(proved.model.origin, &proved.ledger));
    };
    let equations = first.equations.clone();
    let singular = check::reduced_regularity(&mut proved.model, &equations, proved.constraints.generic_mut());
    fence(singular.into_iter().collect())?;
    // 2. v̇
    about(Subject::Solution);
    let velocities = &proved.system.algebroid.velocities;
    let mut restriction = kept.restriction(&proved.model.graph, velocities);
    let given = given::definitions(&mut proved.model, &mut proved.motion, &mut restriction);
    let derivative = proved_derivative(&mut proved, &reference, &candidates, &given, &mut chosen)
        .or_else(|| plain_derivative(&mut proved, &reference, kept, &given, &mut chosen));
    proved.ledger.decisions.push(chosen);
    let derivative = derivative.ok_or_else(|| nothing_proved(proved.model.origin, &proved.ledger))?;
    about(Subject::Requests);
    let gibbs_appell = gibbs_appell_function::on_distribution(&mut proved, kept, &given);
    gibbs_appell_function::prove_it(&mut proved, &reference, gibbs_appell.as_ref())?;
    let work = work_of_constraints(&mut proved, distribution.constraints.annihilator.len());
    let (multipliers, reactions) =
        constraint_forces(&mut proved, &reference, (kept, &equations), &derivative, &work)?;
    let linearized = requested_linearized(&mut proved, &derivative, &kept.independent)?;
    let (momenta, mut functions) = momenta(&mut proved, &mut restriction, &derivative, &kept.independent);
    functions.add_if(&PARAMETER_JACOBIAN, requested_parameter_jacobian(&mut proved, &derivative)?);
    let (gyroscopic, force) = gyroscopic::derive(&mut proved, Some(distribution))?;
    functions.add_if(&GYROSCOPIC, force);
    let graph = &mut proved.model.graph;
    // 3. E_L, y and the observables on D
    let energy = energy(graph, &proved.system);
    let energy = restriction.apply(graph, energy);
    let energy = if is_large(&proved) { energy } else { proved.model.graph.simplify(energy) };
    let observables = observables(&mut proved.model, &mut proved.motion, &mut restriction);
    let power = power(&mut proved, &mut restriction, &given, &multipliers, &work);
    let output_jacobian = requested_output_jacobian(&mut proved, &observables, &kept.independent)?;
    // 4. the claims, along the flow
    about(Subject::Claims);
    let claims = proved_claims(&mut proved, &mut restriction, &derivative, &equations.independent)?;
    let moving = (kept.independent.as_slice(), kept.velocity.as_slice());
    let divisors = parameter_divisors(&mut proved.model, &derivative);
    let known = [conditions.as_slice(), &divisors].concat();
    let positions = positions(&mut proved, &mut restriction, moving, (&distribution.pivots, &known));
    let impacts = impact_functions::adapted(&mut proved, &mut restriction, kept);
    // 5. what both formulations end with
    about(Subject::Requests);
    functions.add(&ENERGY, Procedure::of(vec![energy]));
    functions.add(&VELOCITY, Procedure::of(kept.velocity.clone()));
    functions.add_if(&POWER, power);
    functions.add_if(&OUTPUT_JACOBIAN, output_jacobian);
    functions.add_if(&RESIDUAL, positions.as_ref().map(|positions| positions.residual.clone()));
    let parts = Parts { linearized, functions, momenta, gyroscopic, positions, impacts, ..Parts::default() };
    let derivation = Derivation {
        derived: Derived::Adapted { distribution, kept, equations: &equations },
        reason,
        reference: &reference,
        conditions,
        divisors,
        residuals: &[],
        claims: &claims,
        regular: derivative.clone(),
        derivative,
        multipliers,
        reactions,
        gibbs_appell,
        observables,
        parts,
    };
    complete(proved, registry, derivation)
}

/// The claimed first integrals on D, proved along the flow.
fn proved_claims(
    proved: &mut Proved,
    restriction: &mut Substitution,
    derivative: &Procedure,
    velocities: &[SymbolId],
) -> Result<Vec<ExprId>, Vec<Violation>> {
    let Proved { model, motion, system, positions, facts, .. } = proved;
    let claims = claims_in_state(model, motion, restriction);
    if !claims.is_empty() {
        let flow = Flow::of(&mut model.graph, derivative, system, velocities);
        fence(check::claims(model, &claims, flow, (&positions.manifold, &positions.unsolved), facts))?;
    }
    Ok(claims)
}

/// The way back to position constraints: the velocities of the state stay, and what D makes of them holds at
/// the new place. Parameters that the motion may have at 0 are no divisors: where the kinetic energy is not definite
/// without them, pivots are numerical.
fn positions(
    proved: &mut Proved,
    restriction: &mut Substitution,
    (states, velocity): (&[SymbolId], &[ExprId]),
    (pivots, known): (&[ExprId], &[ExprId]),
) -> Option<PositionReturn> {
    if proved.model.positions.is_empty() {
        return None;
    }
    let residuals = proved.constraints.residuals.clone();
    let saddle = saddle_equations(&mut proved.model.graph, &proved.system, &residuals);
    let parameters: Vec<_> = proved.model.parameters.iter().map(|parameter| parameter.symbol).collect();
    let facts = proved.facts.clone();
    let judge = |graph: &Graph, matrix: &Matrix| definiteness(graph, matrix, &parameters, &facts);
    let moving = (states, velocity, [].as_slice());
    let mut found = position_return(proved, (&saddle, None), restriction, moving, judge)?;
    if divides_by_free_parameters(&mut proved.model, &found.step, known, &facts) {
        found = position_return(proved, (&saddle, None), restriction, moving, |_, _| Definiteness::Unknown)?;
    }
    let graph = &proved.model.graph;
    let varies = |pivot: &&ExprId| graph.symbols_in(&[**pivot]).iter().any(|s| !parameters.contains(s));
    found.pivots = Procedure::of(pivots.iter().filter(varies).copied().collect());
    Some(found)
}

/// Whether expressions of the size of the Lagrangian are left as they are.
fn is_large(proved: &Proved) -> bool {
    proved.model.graph.operation_count(&[proved.system.lagrangian]) > sizes::EXPANDED
}
