//! Brackets, the Hamiltonian side and the almost-Poisson form, as far as they are asked for.

use super::held_equations::held_equations;
use super::on_request::{
    asked, calls_of, energy_gradient, judge, judge_beside, nonholonomic_bracket, not_differentiable,
    shortened, state, whole_state,
};
use super::proved::{Derived, Proved, fence};
use super::velocities_of_state::requested;
use super::{
    connection_functions, discrete, kept_volume, momentum_equation, observed_brackets, variational_step,
};
use crate::algebra::{Graph, Matrix, Rational, Substitution};
use crate::check::{self, evidence::shown};
use crate::findings::BracketEntries;
use crate::functions::{BRACKET, BRACKET_WITH_ENERGY, DRIFT_OF_OUTPUTS, Functions, HAMILTON_JACOBI};
use crate::id::{ExprId, Origin, SymbolId};
use crate::mechanics::{HamiltonianSide, NoInverse, Procedure, hamiltonian_side, jacobian};
use crate::model::{Model, Request};
use crate::phase_space::{AlmostPoisson, HeldEquations, InvariantForm, PhaseSpace};
use crate::report::hamiltonian_lines;
use crate::violation::{Law, Violation};

/// Sections of the report: a title and lines.
pub(super) type Sections = Vec<(&'static str, Vec<String>)>;

/// Derives what is asked for, the functions among it into `functions`; what the report says about it.
pub(super) fn derive(
    proved: &mut Proved,
    derived: &Derived<'_>,
    derivative: &Procedure,
    observables: &Procedure,
    claims: &[ExprId],
    functions: &mut Functions,
) -> Result<(PhaseSpace, Sections), Vec<Violation>> {
    fence(on_level(proved).into_iter().chain(beyond_phase_space(proved)).collect())?;
    let mut found = PhaseSpace::default();
    let mut sections = Sections::new();
    let mut violations = Vec::new();
    let mut keep = |result: Result<(), Vec<Violation>>| violations.extend(result.err().into_iter().flatten());
    if needs_hamiltonian(&proved.model) {
        keep(hamiltonian(proved, derived, derivative).and_then(|(side, momenta)| {
            let entries = BracketEntries::of(&mut proved.model, &side, &proved.base);
            sections.push(("Hamiltonian side", hamiltonian_lines(&proved.model.graph, &entries)));
            let fields = fields(proved, derived);
            let Proved { model, base, .. } = &mut *proved;
            functions
                .add_if(&HAMILTON_JACOBI, check::hamilton_jacobi(model, &side, &fields, &momenta, base)?);
            found.hamiltonian = requested(&proved.model, Request::Hamiltonian).then_some(side);
            Ok(())
        }));
    }
    if let Some(origin) = asked(&proved.model, Request::Bracket) {
        keep(observed_brackets::of_outputs(proved, derived, observables, origin).map(
            |[bracket, with_energy, drift]| {
                functions.add(&BRACKET, bracket);
                functions.add(&BRACKET_WITH_ENERGY, with_energy);
                functions.add(&DRIFT_OF_OUTPUTS, drift);
            },
        ));
    }
    if let Some(origin) = asked(&proved.model, Request::DiscreteGradient) {
        keep(almost_poisson(proved, derived, origin).map(|form| found.almost_poisson = Some(form)));
    }
    keep(held(proved, derived).map(|form| found.held = form));
    if let Some(origin) = asked(&proved.model, Request::Invariants) {
        keep(invariants(proved, derived, claims, origin).map(|form| found.invariants = Some(form)));
    }
    keep(connection_functions::derive(proved, derived, functions));
    keep(momentum_equation::derive(proved, derived, derivative, functions));
    keep(discrete::derive(proved, derived, &mut found));
    keep(variational_step::derive(proved, derived, &mut found));
    keep(kept_volume::derive(proved, derived, derivative, functions).map(|lines| {
        if !lines.is_empty() {
            sections.push(("Volume", lines));
        }
    }));
    if violations.is_empty() { Ok((found, sections)) } else { Err(violations) }
}

/// Routh reduction leaves velocities with an offset, which the forms derived here do not have.
fn on_level(proved: &Proved) -> Option<Violation> {
    const REQUESTS: [Request; 12] = [
        Request::OutputJacobian,
        Request::Hamiltonian,
        Request::Bracket,
        Request::DiscreteGradient,
        Request::SymmetricProjection,
        Request::Connection,
        Request::Volume,
        Request::Divergence,
        Request::Leapfrog,
        Request::Rattle,
        Request::EulerPoincareSuslov,
        Request::Splitting,
    ];
    let level = proved.levels.first()?;
    let origin = REQUESTS.iter().find_map(|request| asked(&proved.model, *request));
    let origin = origin.or(proved.model.hamilton_jacobi.as_ref().map(|_| level.origin));
    let origin = origin.or(proved.model.volume.as_ref().map(|_| level.origin))?;
    Some(Violation {
        law: Law::Symmetry,
        origin,
        what: "this is not derived on a level of a momentum".into(),
        evidence: format!("`routh` puts the momentum of `{}` on one", level.name),
        way_out: "ask it of the whole system, declared without `routh`".into(),
    })
}

/// Auxiliary states are no part of phase space: what is on it alone, and steps that are made from it, are refused.
fn beyond_phase_space(proved: &Proved) -> Option<Violation> {
    const REQUESTS: [(Request, &str); 6] = [
        (Request::Hamiltonian, "Hamilton's equations are those of (x, π)"),
        (Request::DiscreteGradient, "the step that keeps the energy moves coordinates and velocities"),
        (Request::Volume, "an invariant volume is looked for on the coordinates and velocities"),
        (Request::Leapfrog, "the leapfrog moves coordinates and velocities"),
        (Request::Rattle, "the discrete Lagrangian is one of positions"),
        (Request::EulerPoincareSuslov, "the discrete equations move velocities"),
    ];
    let Proved { model, .. } = proved;
    let state = model.auxiliary.first()?;
    let asked_for = REQUESTS.iter().find_map(|(request, why)| Some((asked(model, *request)?, *why)));
    let of_section =
        model.hamilton_jacobi.as_ref().map(|claim| (claim.origin, "momenta are claimed over the base"));
    let of_volume = model.volume.map(|claim| (claim.origin, "the claim is about coordinates and velocities"));
    let of_level =
        model.routh.first().map(|level| (level.origin, "the reduced equations are those of the base"));
    let (origin, why) = asked_for.or(of_section).or(of_volume).or(of_level)?;
    Some(Violation {
        law: Law::Auxiliary,
        origin,
        what: "this is not derived with auxiliary states".into(),
        evidence: format!("`{}` is one, which is no coordinate and has no momentum; {why}", state.name),
        way_out: "leave it out, or ask it of the machine without `auxiliary`".into(),
    })
}

fn needs_hamiltonian(model: &Model) -> bool {
    asked(model, Request::Hamiltonian).is_some() || model.hamilton_jacobi.is_some()
}

/// The Hamiltonian side with the velocities that its momenta belong to.
fn hamiltonian(
    proved: &mut Proved,
    derived: &Derived<'_>,
    derivative: &Procedure,
) -> Result<(HamiltonianSide, Vec<SymbolId>), Vec<Violation>> {
    let origin = asked(&proved.model, Request::Hamiltonian)
        .or(proved.model.hamilton_jacobi.as_ref().map(|declared| declared.origin))
        .unwrap_or(proved.model.origin);
    let Derived::Adapted { distribution, equations, .. } = derived else {
        return Err(vec![Violation {
            law: Law::Hamiltonian,
            origin,
            what: "there are no momenta on D* in the projected formulation".into(),
            evidence: "they are the components of the momentum in a basis of D, and the state has none"
                .into(),
            way_out:
                "name the velocities to keep with `independent { … }`; `bracket`, `discrete_gradient` and \
                      `divergence` need no basis"
                    .into(),
        }]);
    };
    let judged = judge(proved)(&proved.model.graph, &equations.mass);
    let calls = calls_of(derivative);
    hamiltonian_side(&mut proved.model.graph, &proved.system, distribution, equations, judged, &calls)
        .map(|mut side| {
            side.drift = shortened(&mut proved.model.graph, side.drift);
            (side, distribution.independent.clone())
        })
        .map_err(|NoInverse { momentum, velocity }| {
            let graph = &proved.model.graph;
            vec![Violation {
                law: Law::Hamiltonian,
                origin,
                what: "the Legendre transformation has no inverse in closed form".into(),
                evidence: format!(
                    "the momentum along `{}` is {}, which is not affine in the velocities",
                    graph.symbols()[velocity],
                    shown(graph, momentum)
                ),
                way_out:
                    "leave `hamiltonian` out; `bracket` and `discrete_gradient` take any Lagrangian, in the \
                          velocities: momenta can be declared as `outputs`"
                        .into(),
            }]
        })
}

/// ρ(B_a) for the sections of the state.
fn fields(proved: &mut Proved, derived: &Derived<'_>) -> Matrix {
    let Derived::Adapted { distribution, .. } = derived else { return Matrix::new() };
    let anchor = &proved.system.algebroid.anchor;
    (0..distribution.rank())
        .map(|a| anchor.vector_field(&mut proved.model.graph, &distribution.section(a)))
        .collect()
}

/// ∂E and Π, for a system that moves by Π ∂E.
fn almost_poisson(
    proved: &mut Proved,
    derived: &Derived<'_>,
    origin: Origin,
) -> Result<AlmostPoisson, Vec<Violation>> {
    let Proved { model, system, constraints, .. } = &mut *proved;
    if let Some(evidence) = check::not_conservative(model, system, constraints) {
        return Err(vec![Violation {
            law: Law::Hamiltonian,
            origin,
            what: "a discrete gradient keeps the energy, and this system does not".into(),
            evidence,
            way_out:
                "leave `discrete_gradient` out; `ImplicitMidpoint` is symmetric too and takes every system"
                    .into(),
        }]);
    }
    if let Some(evidence) = check::moving_constraint(model, &system.clock, constraints) {
        return Err(vec![Violation {
            law: Law::Hamiltonian,
            origin,
            what: "a discrete gradient takes autonomous systems".into(),
            evidence,
            way_out: "leave `discrete_gradient` out; `ImplicitMidpoint` takes every system".into(),
        }]);
    }
    let arguments = state(proved, derived);
    let judge = judge_beside(proved);
    let bracket = nonholonomic_bracket(proved, derived);
    let graph = &mut proved.model.graph;
    let gradient = energy_gradient(graph, &proved.system, derived, &arguments);
    let covector: Vec<SymbolId> =
        (0..arguments.len()).map(|index| graph.new_symbol(format!("covector{index}"))).collect();
    let components: Vec<ExprId> = covector.iter().map(|symbol| graph.symbol(*symbol)).collect();
    let mut sharp = Procedure::default();
    let (along_base, along_fibre) = components.split_at(bracket.coordinates.len());
    let (rates, accelerations) = bracket.sharp(graph, judge, (along_base, along_fibre), &mut sharp);
    sharp.outputs = [rates, accelerations].concat();
    Ok(AlmostPoisson { gradient: Procedure::of(gradient), covector, sharp })
}

/// What a step keeps by itself, if that is asked for.
fn held(proved: &mut Proved, derived: &Derived<'_>) -> Result<Option<HeldEquations>, Vec<Violation>> {
    let by_energy = asked(&proved.model, Request::DiscreteGradient).is_some();
    let Some(origin) = asked(&proved.model, Request::SymmetricProjection) else {
        let is_needed = by_energy && !proved.model.positions.is_empty();
        return Ok(is_needed.then(|| held_equations(proved, derived)));
    };
    let refused = |what: &str, evidence: &str, way_out: &str| {
        vec![Violation {
            law: Law::Hamiltonian,
            origin,
            what: what.into(),
            evidence: evidence.into(),
            way_out: way_out.into(),
        }]
    };
    if !proved.model.identities.is_empty() {
        return Err(refused(
            "a symmetric projection is not derived over an embedded base",
            "the directions in which it returns leave the identities of `on`",
            "declare coordinates without identities, or return by `Projected`",
        ));
    }
    let equations = held_equations(proved, derived);
    if equations.functions.is_empty() {
        return Err(refused(
            "there is nothing that a symmetric projection could keep",
            "the velocities of the state satisfy all constraints by themselves",
            "leave it out: every symmetric method keeps them",
        ));
    }
    Ok(Some(equations))
}

/// The claims, which are proved, with their gradients.
fn invariants(
    proved: &mut Proved,
    derived: &Derived<'_>,
    claims: &[ExprId],
    origin: Origin,
) -> Result<InvariantForm, Vec<Violation>> {
    if claims.is_empty() {
        return Err(vec![Violation {
            law: Law::Hamiltonian,
            origin,
            what: "there are no first integrals to stay with".into(),
            evidence: String::new(),
            way_out: "state them: `conserved { spin = …; }`".into(),
        }]);
    }
    let arguments = whole_state(proved, derived);
    let graph = &mut proved.model.graph;
    let values = Procedure::of(claims.to_vec());
    let mut gradients =
        jacobian(graph, &values, &arguments).map_err(|error| vec![not_differentiable(error, origin)])?;
    // what is constant in the state, as a momentum on its level, cannot be left
    let rows: Vec<Vec<ExprId>> =
        gradients.outputs.chunks(arguments.len().max(1)).map(<[ExprId]>::to_vec).collect();
    let varies = |row: &Vec<ExprId>| row.iter().any(|slope| !graph.zero_test(*slope).is_zero());
    let varying: Vec<usize> = (0..rows.len()).filter(|index| varies(&rows[*index])).collect();
    if varying.is_empty() {
        let zero = graph.zero();
        gradients.outputs.fill(zero);
        let constants = claims.iter().map(|claim| at_some_state(graph, *claim, &arguments)).collect();
        return Ok(InvariantForm { values: Procedure::of(constants), gradients });
    }
    gradients.outputs = varying.iter().flat_map(|index| rows[*index].clone()).collect();
    Ok(InvariantForm {
        values: Procedure::of(varying.iter().map(|index| claims[*index]).collect()),
        gradients,
    })
}

/// A function that does not depend on the state, without it.
fn at_some_state(graph: &mut Graph, function: ExprId, state: &[SymbolId]) -> ExprId {
    let places = [(0, 1), (1, 1), (2, 5)].map(|(n, d)| graph.number(Rational::new(n, d)));
    let values = places
        .map(|place| Substitution::new(state.iter().map(|symbol| (*symbol, place))).apply(graph, function));
    values.into_iter().find(|value| !graph.is_undefined(*value)).unwrap_or(function)
}
