//! The derivative by the Gibbs–Appell function, where the declaration asks for it.

use super::proved::{Proved, nothing_proved};
use super::velocities_of_state::requested;
use crate::algebra::Substitution;
use crate::choose::{Claim, Contender, Decision, Fate, Reference, fate, prove};
use crate::geometry::ConstraintDistribution;
use crate::mechanics::{GibbsAppell, Procedure, SaddleEquations, definiteness, solve_symmetric};
use crate::model::Request;
use crate::violation::Violation;

/// In a basis of D, with the results of methods and the rates of auxiliary states that are given.
pub(super) fn on_distribution(
    proved: &mut Proved,
    distribution: &ConstraintDistribution,
    given: &Procedure,
) -> Option<Procedure> {
    if !requested(&proved.model, Request::GibbsAppell) {
        return None;
    }
    let parameters: Vec<_> = proved.model.parameters.iter().map(|parameter| parameter.symbol).collect();
    let graph = &mut proved.model.graph;
    let mut restriction = distribution.restriction(graph, &proved.system.algebroid.velocities);
    let appell = GibbsAppell::of(
        graph,
        &proved.system,
        &distribution.velocity,
        &distribution.independent,
        &mut restriction,
    );
    let (mass, force) = appell.equations(graph);
    let definite = definiteness(graph, &mass, &parameters, &proved.facts);
    let mut procedure = given.clone();
    let accelerations = solve_symmetric(graph, &mass, &force, definite, &mut procedure, "acceleration");
    procedure.outputs = appell.rates.into_iter().chain(accelerations).chain(given.outputs.clone()).collect();
    Some(procedure)
}

/// On all of E: the function is stationary among the accelerations that the constraints allow,
/// Gauss's principle, solved as a saddle problem with numerical pivoting.
pub(super) fn with_multipliers(
    proved: &mut Proved,
    equations: &SaddleEquations,
    given: &Procedure,
) -> Option<Procedure> {
    if !requested(&proved.model, Request::GibbsAppell) {
        return None;
    }
    let velocities = proved.system.algebroid.velocities.clone();
    let graph = &mut proved.model.graph;
    let velocity = proved.system.algebroid.velocity(graph);
    let mut everywhere = Substitution::new([]);
    let appell = GibbsAppell::of(graph, &proved.system, &velocity, &velocities, &mut everywhere);
    let (mass, force) = appell.equations(graph);
    let stationary = SaddleEquations { mass, force, ..equations.clone() };
    let mut procedure = given.clone();
    let (accelerations, _) = stationary.solve_pivoted(graph, &mut procedure);
    procedure.outputs = appell.rates.into_iter().chain(accelerations).chain(given.outputs.clone()).collect();
    Some(procedure)
}

/// Proves that it moves the state as declared: it is derived by another function, and proved by the same equations.
///
/// # Errors
/// Where it could not be proved.
pub(super) fn prove_it(
    proved: &mut Proved,
    reference: &Reference,
    procedure: Option<&Procedure>,
) -> Result<(), Vec<Violation>> {
    let Some(procedure) = procedure else { return Ok(()) };
    let fate = fate(prove(&proved.model.graph, reference, &Claim::Motion(procedure)));
    let is_admitted = matches!(fate, Fate::Chosen(_));
    let contenders = vec![Contender { form: "by Gibbs and Appell", cost: None, rounding: None, fate }];
    proved.ledger.decisions.push(Decision { site: "gibbs_appell", contenders, limits: Vec::new() });
    if is_admitted { Ok(()) } else { Err(nothing_proved(proved.model.origin, &proved.ledger)) }
}
