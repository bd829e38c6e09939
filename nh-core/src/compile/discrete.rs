//! Discrete Lagrange–d'Alembert equations: on TQ, and on a Lie algebra.

use super::on_request::{asked, judge};
use super::proved::{Derived, Proved};
use crate::algebra::Graph;
use crate::check::{self, evidence::shown};
use crate::geometry::Algebroid;
use crate::id::{ExprId, Id, Origin, SymbolId};
use crate::mechanics::{Procedure, SaddleEquations};
use crate::model::{Kinematics, Request};
use crate::phase_space::{PhaseSpace, StepForm};
use crate::violation::{Law, Violation};

/// Both, if they are asked for.
pub(super) fn derive(
    proved: &mut Proved,
    derived: &Derived<'_>,
    found: &mut PhaseSpace,
) -> Result<(), Vec<Violation>> {
    if let Some(origin) = asked(&proved.model, Request::Leapfrog) {
        found.leapfrog = Some(leapfrog(proved, derived, origin)?);
    }
    if let Some(origin) = asked(&proved.model, Request::EulerPoincareSuslov) {
        found.euler_poincare_suslov = Some(euler_poincare_suslov(proved, derived, origin)?);
    }
    Ok(())
}

pub(super) fn refusal(origin: Origin, what: &str, evidence: String, way_out: &str) -> Vec<Violation> {
    vec![Violation { law: Law::Hamiltonian, origin, what: what.into(), evidence, way_out: way_out.into() }]
}

/// What no discrete equation can do without.
pub(super) fn conservative(proved: &mut Proved, origin: Origin, what: &str) -> Result<(), Vec<Violation>> {
    let Proved { model, system, constraints, .. } = proved;
    let evidence = match check::not_conservative(model, system, constraints) {
        None if constraints.linear.is_some() => {
            match check::moving_constraint(model, &system.clock, constraints) {
                None => return Ok(()),
                Some(evidence) => evidence,
            }
        }
        None => "the constraints are not linear in the velocities".into(),
        Some(evidence) => evidence,
    };
    Err(refusal(
        origin,
        what,
        evidence,
        "leave it out; `ImplicitMidpoint` is symmetric and takes every system",
    ))
}

/// The kick of the nonholonomic leapfrog at a point of the base, mathematics (26): v⁺ from v⁻ with
/// W (v⁺ − v⁻) = −h ∂V + Jᵀμ, J (v⁺ + v⁻) = 0 (McLachlan, Perlmutter, J. Nonlinear Sci. 16 (2006)).
fn leapfrog(proved: &mut Proved, derived: &Derived<'_>, origin: Origin) -> Result<StepForm, Vec<Violation>> {
    let what = "the leapfrog method needs a system on TQ with constant masses";
    let way_out = "declare it by its coordinates alone, with `formulation { projected }` and L = T - V(q), T with \
                   constant coefficients; or use `DiscreteGradient`";
    conservative(proved, origin, what)?;
    let Derived::Projected { equations, .. } = derived else {
        return Err(refusal(origin, what, "the state has reduced velocities".into(), way_out));
    };
    if !matches!(proved.model.kinematics, Kinematics::Tangent) || !proved.model.frame.is_empty() {
        return Err(refusal(origin, what, "the velocities are not those of the coordinates".into(), way_out));
    }
    let judge = judge(proved);
    let graph = &mut proved.model.graph;
    let system = &proved.system;
    let coordinates = &system.algebroid.anchor.coordinates;
    let variables: Vec<SymbolId> = coordinates.iter().chain(&system.algebroid.velocities).copied().collect();
    if let Some(entry) = equations.mass.iter().flatten().find(|entry| graph.depends_on(**entry, &variables)) {
        let evidence = format!("an entry of the mass matrix is {}", shown(graph, *entry));
        return Err(refusal(origin, what, evidence, way_out));
    }
    let momenta = system.momenta(graph);
    if let Some(momentum) = momenta.iter().find(|momentum| graph.depends_on(**momentum, coordinates)) {
        let evidence = format!("a momentum is {}", shown(graph, *momentum));
        return Err(refusal(origin, what, evidence, way_out));
    }
    // W v⁺ − Jᵀμ = W v⁻ + h ∂L, J v⁺ = −J v⁻
    let length = graph.new_symbol("length");
    let h = graph.symbol(length);
    let velocity = system.algebroid.velocity(graph);
    let mut force = Vec::with_capacity(velocity.len());
    for (row, coordinate) in equations.mass.iter().zip(coordinates) {
        let inertia = graph.inner_product(row, &velocity);
        let slope = graph.partial(system.lagrangian, *coordinate);
        force.push(graph.formula(inertia + h * slope));
    }
    let bias = equations
        .jacobian
        .iter()
        .map(|row| {
            let power = graph.inner_product(row, &velocity);
            graph.formula(-power)
        })
        .collect();
    let kick = SaddleEquations { force, bias, ..(*equations).clone() };
    let mut map = Procedure::default();
    let (after, _) = kick.solve(graph, judge, &mut map);
    map.outputs = after;
    Ok(StepForm { length, map })
}

/// The discrete momentum of the Euler–Poincaré–Suslov equations, mathematics (27):
/// P_a(h, v) = ⟨p, B_a − h/2 [y, B_a] + h²/12 [y, [y, B_a]]⟩ at y = B v, with which a step is
/// P(h, v₁) = P(−h, v₀) (Fedorov, Zenkov, Nonlinearity 18 (2005); the derivative of the exponential map
/// to second order).
fn euler_poincare_suslov(
    proved: &mut Proved,
    derived: &Derived<'_>,
    origin: Origin,
) -> Result<StepForm, Vec<Violation>> {
    let what = "the discrete Euler-Poincare-Suslov equations belong to a Lie algebra";
    let way_out = "declare the reduced system: sections and brackets, and no base";
    conservative(proved, origin, what)?;
    let (Derived::Adapted { distribution, .. }, true) = (derived, proved.model.coordinates.is_empty()) else {
        return Err(refusal(origin, what, "the declaration has base coordinates".into(), way_out));
    };
    // the exponential map is that of a group, whose bracket obeys the Jacobi identity
    if let Some(evidence) = proved.broken_laws.jacobi.clone() {
        return Err(refusal(origin, what, evidence, "leave it out; `ImplicitMidpoint` takes every system"));
    }
    let graph = &mut proved.model.graph;
    let system = &proved.system;
    let length = graph.new_symbol("length");
    let h = graph.symbol(length);
    let mut restriction = distribution.restriction(graph, &system.algebroid.velocities);
    let momenta = system.momenta(graph);
    let momenta = restriction.apply_all(graph, &momenta);
    let velocity = distribution.velocity.clone();
    let square = graph.square(h);
    let outputs = (0..distribution.rank())
        .map(|a| {
            let section = distribution.section(a);
            let once = bracket(graph, &system.algebroid, &velocity, &section);
            let twice = bracket(graph, &system.algebroid, &velocity, &once);
            let [p0, p1, p2] =
                [&section, &once, &twice].map(|section| graph.inner_product(&momenta, section));
            let (first, second) = (graph.formula(h * p1), graph.formula(square * p2));
            let sum = graph.linear_combination(&[
                (1.into(), p0),
                (crate::algebra::Rational::new(-1, 2), first),
                (crate::algebra::Rational::new(1, 12), second),
            ]);
            graph.simplify(sum)
        })
        .collect();
    Ok(StepForm { length, map: Procedure::of(outputs) })
}

/// [σ, τ] on a Lie algebra: constant coefficients, also where the components are functions of v.
fn bracket(graph: &mut Graph, algebroid: &Algebroid, sigma: &[ExprId], tau: &[ExprId]) -> Vec<ExprId> {
    debug_assert!(algebroid.sections().all(|section| section.index() < sigma.len()));
    algebroid.structure.contract(graph, sigma, tau)
}
