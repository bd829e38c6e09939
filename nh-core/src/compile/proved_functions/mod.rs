//! Functions beside the motion, proved to be what their definitions say.

mod claimed_functions;
mod declared_data;

use super::differentiated::{SLOPES_OF_POSITIONS, SLOPES_OF_VELOCITIES};
use super::proved::Proved;
use super::velocities_of_state::{coordinates, parameter_checks};
use super::{given, levels};
use crate::algebra::{Graph, Substitution};
use crate::choose::{
    Allowed, Contender, Decision, Defect, DerivedFunction, Fate, Motion, Proof, Reference, VelocityNames,
    prove_derived,
};
use crate::forms::Registry;
use crate::functions::Functions;
use crate::geometry::Manifold;
use crate::id::{ExprId, SymbolId};
use crate::limits::attempt;
use crate::mechanics::Procedure;
use crate::model::Formulation;
use crate::phase_space::PhaseSpace;
use crate::system::{Embedding, ImpactForm, PositionReturn, Projection, System};
use crate::violation::{Law, Violation};
use claimed_functions::{of_geometry, of_motion, of_phase_space, of_state};
use declared_data::Declared;
use std::ptr;

/// What functions are derived from.
pub(super) struct Given<'d> {
    pub(super) formulation: Formulation,
    pub(super) reference: &'d Reference,
    pub(super) derivative: &'d Procedure,
    /// The velocities of the state.
    pub(super) velocities: &'d [SymbolId],
    /// λ_A, where something asks for them, with the rows Φ^A where D has a basis.
    pub(super) multipliers: (&'d Procedure, Option<&'d [Vec<ExprId>]>),
    /// What the state has to satisfy.
    pub(super) residuals: &'d [ExprId],
    /// What `validate` checks not to be 0.
    pub(super) conditions: &'d [ExprId],
}

/// What was derived.
#[derive(Default)]
pub(super) struct Parts {
    pub(super) linearized: Option<Procedure>,
    pub(super) functions: Functions,
    /// The names of the momenta.
    pub(super) momenta: Vec<String>,
    /// The coordinates along which the gyroscopic force acts.
    pub(super) gyroscopic: Vec<SymbolId>,
    pub(super) projection: Option<Projection>,
    pub(super) positions: Option<PositionReturn>,
    pub(super) impacts: Vec<ImpactForm>,
    pub(super) embedding: Option<Embedding>,
    pub(super) phase_space: PhaseSpace,
}

/// Both.
struct Derivatives<'d> {
    given: &'d Given<'d>,
    parts: &'d Parts,
}

impl Parts {
    /// The system: `divisors` are the parameters that it divides by; with its report, and the equations as text.
    pub(super) fn into_system(
        self,
        proved: Proved,
        (formulation, velocities): (Formulation, Vec<SymbolId>),
        derivative: Procedure,
        divisors: &[ExprId],
        (report, equations): (String, Vec<String>),
    ) -> System {
        let model = proved.model;
        System {
            impacts: self.impacts,
            linearization: None,
            formulation,
            state_coordinates: coordinates(&model),
            state_velocities: velocities,
            state_auxiliary: given::auxiliary_states(&model),
            derivative,
            functions: self.functions,
            momenta: self.momenta,
            gyroscopic: self.gyroscopic,
            quadratures: Vec::new(),
            linearized: self.linearized,
            products: Vec::new(),
            projection: self.projection,
            positions: self.positions,
            phase_space: self.phase_space,
            embedding: self.embedding,
            parameter_checks: parameter_checks(&model, divisors),
            ledger: proved.ledger,
            report,
            equations,
            latex: None,
            derivatives_go_on: false,
            model,
        }
    }

    /// Every procedure as the registry finishes it, each with the name of its function.
    fn finished(&mut self, graph: &mut Graph, registry: &Registry) {
        let Some(finish) = registry.finish() else { return };
        let mut finish = |name: &str, procedure: &mut Procedure| finish(graph, name, procedure);
        self.functions.iter_mut().for_each(|f| finish(f.signature.name, &mut f.procedure));
        self.linearized.iter_mut().for_each(|linearized| finish("jacobian", linearized));
        self.projection.iter_mut().for_each(|projection| finish("projection", &mut projection.step));
        if let Some(positions) = &mut self.positions {
            finish("position_return", &mut positions.step);
            positions.velocities.iter_mut().for_each(|velocities| finish("velocity_return", velocities));
            if let Some(slopes) = &mut positions.slopes {
                finish(SLOPES_OF_POSITIONS, &mut slopes.positions);
                slopes.velocities.iter_mut().for_each(|by| finish(SLOPES_OF_VELOCITIES, by));
            }
        }
        self.impacts.iter_mut().for_each(|impact| finish("impact", &mut impact.jump));
        self.embedding.iter_mut().for_each(|embedding| finish("normalize", &mut embedding.step));
        let PhaseSpace {
            hamiltonian,
            almost_poisson,
            held,
            invariants,
            leapfrog,
            variational,
            euler_poincare_suslov,
        } = &mut self.phase_space;
        if let Some(side) = hamiltonian {
            finish("legendre", &mut side.legendre);
            finish("inverse", &mut side.inverse);
            finish("hamiltonian", &mut side.hamiltonian);
            finish("equations", &mut side.equations);
            finish("bracket_of_momenta", &mut side.bracket);
            finish("drift_of_momenta", &mut side.drift);
        }
        if let Some(form) = almost_poisson {
            finish("energy_gradient", &mut form.gradient);
            finish("sharp", &mut form.sharp);
        }
        if let Some(form) = held {
            finish("held_equations", &mut form.map);
        }
        if let Some(form) = invariants {
            finish("invariant_gradients", &mut form.gradients);
        }
        if let Some(form) = leapfrog {
            finish("leapfrog", &mut form.map);
        }
        if let Some(form) = variational {
            finish("lagrangian_slopes", &mut form.slopes);
            finish("rattle", &mut form.change);
        }
        if let Some(form) = euler_poincare_suslov {
            finish("euler_poincare_suslov", &mut form.map);
        }
    }
}

/// The parameters that nothing forbids to be 0: no assumption, and no check of `validate`.
fn parameters_that_may_vanish(
    proved: &mut Proved,
    parameters: &[SymbolId],
    conditions: &[ExprId],
) -> Vec<SymbolId> {
    let graph = &mut proved.model.graph;
    let zero = graph.zero();
    let mut may_vanish = parameters.to_vec();
    may_vanish.retain(|&parameter| {
        let value = graph.symbol(parameter);
        let mut at_zero = Substitution::new([(parameter, zero)]);
        !graph.vanishes_nowhere(value, &proved.facts)
            && at_zero
                .apply_all(graph, conditions)
                .iter()
                .all(|condition| !graph.zero_test(*condition).is_zero())
    });
    may_vanish
}

/// What one proof may take. A function whose proof would take more is named in the ledger as not proved.
const WORK: u64 = 4_000_000;

/// Claims, each with the name of the function.
type Claims<'d> = Vec<(&'static str, DerivedFunction<'d>)>;

/// Proves the functions against their definitions, in numbers, with the motion that is proved already: everywhere, or
/// else where the constraints and the identities of the base hold, if that is where they are claimed.
///
/// # Errors
/// A function that is something else.
pub(super) fn prove(
    proved: &mut Proved,
    registry: &Registry,
    given: &Given,
    mut parts: Parts,
) -> Result<Parts, Vec<Violation>> {
    parts.finished(&mut proved.model.graph, registry);
    let found = &Derivatives { given, parts: &parts };
    let declared = Declared::of(proved, found);
    let Given { reference, derivative, .. } = given;
    let motion = Motion { derivative, state: &declared.state, time: proved.model.time };
    let replaced = proved.motion.replaced.clone();
    let names = VelocityNames { rates: &declared.rates, replaced: &replaced };
    let split = proved.split.clone();
    let may_vanish = parameters_that_may_vanish(proved, &declared.parameters, given.conditions);
    let mut claims = of_state(found, &declared, names);
    claims.extend(of_motion(found, &declared, names));
    claims.extend(of_phase_space(found, &declared));
    claims.extend(of_geometry(found, &declared, split.as_ref()));
    let unclaimed = unclaimed(&parts.functions, &claims);
    let mut manifold: Option<Manifold> = None;
    let mut refuted = Vec::new();
    for (site, claim) in claims {
        let mut decision = proved.ledger.take(site).unwrap_or(Decision { site, ..Decision::default() });
        let prove = |proved: &Proved, images: &[(SymbolId, ExprId)]| {
            let Proved { model, facts, .. } = proved;
            let (parameters, conditions) = (&declared.parameters, given.conditions);
            let allowed = Allowed { parameters, may_vanish: &may_vanish, facts, conditions };
            let about = (*reference, motion);
            let proof = attempt(WORK, || prove_derived(&model.graph, about, &claim, images, &allowed));
            proof.unwrap_or_else(|| Err(Defect::Unknown("that would take too many steps".into())))
        };
        let solution = match claim {
            DerivedFunction::Section(lifted, _) => lifted.written_out(&mut proved.model.graph),
            _ => Vec::new(),
        };
        let at: Vec<(SymbolId, ExprId)> = given.velocities.iter().copied().zip(solution).collect();
        let mut form = "derived";
        let mut proof: Result<(Proof, Option<String>), Defect> = prove(proved, &at);
        if claim.is_about_constraints()
            && let Err(Defect::Wrong(_)) = proof
        {
            let on = manifold.get_or_insert_with(|| where_claimed(proved, given.formulation));
            if !on.is_whole() {
                form = "derived, where the constraints hold";
                let images = [on.images(), at.as_slice()].concat();
                proof = prove(proved, &images);
            }
        }
        let base = proved.model.graph.embedded();
        if let Err(Defect::Wrong(_)) = proof
            && !base.is_empty()
        {
            let images = [&base, at.as_slice()].concat();
            proof = prove(proved, &images).map(|(found, limit)| (Proof { is_on_base: true, ..found }, limit));
        }
        let fate = match proof {
            Ok((proof, undecided)) => {
                decision.limits.extend(undecided);
                Some(Fate::Chosen(proof))
            }
            Err(defect @ Defect::Wrong(_)) => {
                refuted.push(is_something_else(proved, site, &defect));
                Some(Fate::NotAdmitted(defect.to_string()))
            }
            Err(defect) => {
                decision.limits.push(format!("not proved: {defect}"));
                None
            }
        };
        // the best of several ways is there already
        match (fate, decision.contenders.first_mut()) {
            (Some(fate), Some(best)) => best.fate = fate,
            (Some(fate), None) => decision.contenders.push(contender(form, fate)),
            (None, _) => {}
        }
        proved.ledger.decisions.push(decision);
    }
    let limit = || vec!["not proved: no definition is given for it".to_owned()];
    let without = unclaimed.into_iter().map(|site| Decision { site, limits: limit(), ..Decision::default() });
    proved.ledger.decisions.extend(without);
    if refuted.is_empty() { Ok(parts) } else { Err(refuted) }
}

/// The functions that no claim is about.
fn unclaimed(functions: &Functions, claims: &Claims) -> Vec<&'static str> {
    let claimed: Vec<&Procedure> = claims.iter().flat_map(|(_, claim)| claim.procedures()).collect();
    let is_claimed = |procedure: &Procedure| claimed.iter().any(|one| ptr::eq(*one, procedure));
    let without = functions.iter().filter(|function| !is_claimed(&function.procedure));
    without.map(|function| function.signature.name).collect()
}

/// A function that is not what its definition says.
fn is_something_else(proved: &Proved, site: &str, defect: &Defect) -> Violation {
    Violation {
        law: Law::Decidable,
        origin: proved.model.origin,
        what: format!("`{site}` was not derived as what its definition says"),
        evidence: format!("compared in exact numbers with the declared equations and the motion: {defect}"),
        way_out: "leave it out if it was asked for; this is a defect of the derivation, please report it"
            .into(),
    }
}

fn contender(form: &'static str, fate: Fate) -> Contender {
    Contender { form, cost: None, rounding: None, fate }
}

/// Where the state satisfies what is declared of it.
fn where_claimed(proved: &mut Proved, formulation: Formulation) -> Manifold {
    match formulation {
        Formulation::Adapted => proved.positions.manifold.clone(),
        Formulation::Projected => levels::manifold(proved),
    }
}
