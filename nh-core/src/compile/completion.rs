//! What both formulations end with: what is asked for on phase space, what is found for the report, the proof of every
//! function, and the system.

use super::differentiated::requested_slopes_of_return;
use super::embedded::embedding;
use super::on_request::state_velocities;
use super::phase_space_functions;
use super::proved::{Derived, Proved};
use super::proved_functions::{self, Given, Parts};
use super::velocities_of_state::{parameter_divisors, requested};
use crate::check::singular_parameters;
use crate::choose::Reference;
use crate::findings::Findings;
use crate::forms::Registry;
use crate::functions::{GIBBS_APPELL, MULTIPLIERS, OUTPUTS, REACTIONS, VERTICAL_SECTIONS};
use crate::id::ExprId;
use crate::mechanics::Procedure;
use crate::model::{Formulation, Request};
use crate::report::{equations_of_motion, latex, report, suggestion};
use crate::system::System;
use crate::violation::Violation;

/// The motion of a formulation and what was derived with it.
pub(super) struct Derivation<'d> {
    /// The equations.
    pub(super) derived: Derived<'d>,
    /// Why this formulation.
    pub(super) reason: &'d str,
    /// What every proof starts from.
    pub(super) reference: &'d Reference,
    /// What must not vanish beside the divisors of the derivative.
    pub(super) conditions: &'d [ExprId],
    /// The parameters that the derivative divides by.
    pub(super) divisors: Vec<ExprId>,
    /// What the state has to satisfy.
    pub(super) residuals: &'d [ExprId],
    /// The claimed first integrals, in the variables of the state.
    pub(super) claims: &'d [ExprId],
    pub(super) derivative: Procedure,
    /// The motion by which the functions beside it are proved: it has a value where the declared equations are regular.
    pub(super) regular: Procedure,
    pub(super) multipliers: Procedure,
    pub(super) reactions: Procedure,
    pub(super) gibbs_appell: Option<Procedure>,
    pub(super) observables: Procedure,
    /// The rest, with the functions so far.
    pub(super) parts: Parts,
}

/// The system with every function proved.
pub(super) fn complete(
    mut proved: Proved,
    registry: &Registry,
    derivation: Derivation<'_>,
) -> Result<System, Vec<Violation>> {
    let Derivation { derived, derivative, multipliers, observables, mut parts, .. } = derivation;
    parts.embedding = embedding(&mut proved.model, &proved.base);
    let (phase_space, sections) = phase_space_functions::derive(
        &mut proved,
        &derived,
        &derivative,
        &observables,
        derivation.claims,
        &mut parts.functions,
    )?;
    parts.phase_space = phase_space;
    let findings = Findings::of(&mut proved, &derived);
    let text = report(&proved, &derived, &findings, derivation.reason, derivation.conditions, sections);
    let in_tex = requested(&proved.model, Request::Latex)
        .then(|| latex::sections(&proved, &derived, &findings, derivation.reason, derivation.conditions));
    let mut lines = equations_of_motion(&proved.model, &derived);
    if let Some(suggested) = &findings.suggested {
        lines.extend([String::new(), suggestion(&proved.model, suggested)]);
    }
    let mut conditions = [derivation.conditions, &derivation.divisors].concat();
    if let (Derived::Adapted { .. }, Some(vertical)) = (&derived, parts.functions.get(&VERTICAL_SECTIONS)) {
        // the basis of S is a choice, as that of D is
        conditions.extend(parameter_divisors(&mut proved.model, vertical));
    }
    conditions.extend(of_regularity(&mut proved, &derived, (derivation.reference, &findings), &conditions));
    parts.functions.add(&OUTPUTS, observables);
    let velocities = state_velocities(&proved, &derived);
    let (formulation, rows) = match derived {
        Derived::Adapted { kept, .. } => {
            (Formulation::Adapted, Some(kept.constraints.annihilator.as_slice()))
        }
        Derived::Projected { .. } => (Formulation::Projected, None),
    };
    let given = Given {
        formulation,
        reference: derivation.reference,
        derivative: &derivation.regular,
        velocities: &velocities,
        multipliers: (&multipliers, rows),
        residuals: derivation.residuals,
        conditions: &conditions,
    };
    let way_back = parts.positions.as_ref().map(|positions| (positions, parts.projection.as_ref()));
    let slopes = requested_slopes_of_return(&mut proved, way_back, &velocities)?;
    if let Some(positions) = &mut parts.positions {
        positions.slopes = slopes;
    }
    let mut parts = proved_functions::prove(&mut proved, registry, &given, parts)?;
    // these are proved with the motion
    let (model, functions) = (&proved.model, &mut parts.functions);
    functions.add_if(&MULTIPLIERS, requested(model, Request::Multipliers).then_some(multipliers));
    functions.add_if(&REACTIONS, requested(model, Request::Reactions).then_some(derivation.reactions));
    functions.add_if(&GIBBS_APPELL, derivation.gibbs_appell);
    let system = parts.into_system(proved, (formulation, velocities), derivative, &conditions, (text, lines));
    Ok(System { latex: in_tex, derivatives_go_on: findings.of_derivatives.go_on, ..system })
}

/// What of the parameters must not vanish for the equations to determine the accelerations, beside what is known not to.
fn of_regularity(
    proved: &mut Proved,
    derived: &Derived<'_>,
    (reference, findings): (&Reference, &Findings),
    known: &[ExprId],
) -> Vec<ExprId> {
    let Proved { model, facts, positions, constraints, .. } = proved;
    let (matrix, manifold) = match derived {
        Derived::Adapted { equations, .. } => (equations.mass.clone(), &positions.manifold),
        Derived::Projected { equations, .. } => (equations.matrix(&mut model.graph), constraints.generic()),
    };
    let declared = [reference.roots(), model.shortened.clone()].concat();
    let mut candidates: Vec<ExprId> = model.graph.divisors(&declared).into_iter().collect();
    candidates.extend(&findings.parameter_factors);
    singular_parameters(model, facts, (&matrix, manifold), &candidates, known)
}
