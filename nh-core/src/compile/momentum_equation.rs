//! The nonholonomic connection and the momentum equation as functions, as far as they are asked for:
//! mathematics (25), CM Propositions 8 and 9.

use super::on_request::{asked, judge};
use super::proved::{Derived, Proved, Split};
use super::vertical_splitting::Reduced;
use crate::algebra::{Graph, Matrix, Substitution};
use crate::functions::{
    CONNECTION_COEFFICIENTS, CURVATURE, Functions, HORIZONTAL_FORCE, HORIZONTAL_LIFTS, LOCKED_INERTIA,
    VERTICAL_MOMENTA, VERTICAL_MOMENTUM_RATES, VERTICAL_SECTIONS, VERTICAL_VELOCITIES,
};
use crate::geometry::ConstraintDistribution;
use crate::id::{ExprId, Id, SymbolId};
use crate::mechanics::{Momentum, NonholonomicConnection, Procedure, solve_symmetric};
use crate::model::Request;
use crate::violation::{Law, Violation};

/// The functions, if they are asked for.
pub(super) fn derive(
    proved: &mut Proved,
    derived: &Derived<'_>,
    derivative: &Procedure,
    found: &mut Functions,
) -> Result<(), Vec<Violation>> {
    let Some(origin) = asked(&proved.model, Request::Splitting) else { return Ok(()) };
    let blame = |evidence: String, way_out: &str| {
        vec![Violation {
            law: Law::Symmetry,
            origin,
            what: "D is not split by symmetries".into(),
            evidence,
            way_out: way_out.into(),
        }]
    };
    let distribution = match derived {
        Derived::Adapted { distribution, .. } => Some(*distribution),
        Derived::Projected { .. } => None,
    };
    let reduced = Reduced::of(proved, distribution).map_err(|reason| {
        blame(
            reason,
            "declare the symmetries, sections that leave L and D invariant, in `symmetries`, or leave `splitting` out",
        )
    })?;
    let facts = proved.facts.clone();
    let (system, basis) = (&reduced.system, &reduced.distribution);
    let Some(connection) =
        NonholonomicConnection::of(&mut proved.model.graph, system, basis, &reduced.splitting, &facts)
    else {
        return Err(blame(
            "its sections could not be solved for".into(),
            "choose other velocities by `independent`",
        ));
    };
    found.extend(functions(proved, distribution, &reduced, &connection, derivative));
    proved.split = Some(Split {
        over: reduced.splitting.coordinates.clone(),
        coordinates: connection.coordinates,
        is_embedded: reduced.splitting.embedded,
        group: reduced.group,
    });
    Ok(())
}

/// A momentum less what it is at rest, where L has terms linear in the velocities.
fn without_rest(graph: &mut Graph, momentum: ExprId, velocities: &[SymbolId]) -> ExprId {
    let at_rest = graph.at_zero(momentum, velocities);
    let moving = graph.formula(momentum - at_rest);
    graph.simplify(moving)
}

/// [h_κ, h_λ] and [h_κ, S_ρ] in the declared basis, a row of brackets for each κ.
fn brackets(graph: &mut Graph, reduced: &Reduced, connection: &NonholonomicConnection) -> [Vec<Matrix>; 2] {
    let algebroid = &reduced.system.algebroid;
    let (s, h) = (connection.vertical.len(), connection.lifts.len());
    let zero = vec![graph.zero(); algebroid.rank()];
    let mut curvature = vec![vec![zero; h]; h];
    let mut coefficients = vec![Matrix::new(); h];
    for (kappa, lambda) in (0..h).flat_map(|kappa| (kappa + 1..h).map(move |lambda| (kappa, lambda))) {
        let bracket = connection.curvature(graph, algebroid, kappa, lambda);
        let bracket = reduced.declared(graph, &bracket);
        curvature[lambda][kappa] = bracket.iter().map(|component| graph.formula(-component)).collect();
        curvature[kappa][lambda] = bracket;
    }
    for (kappa, row) in coefficients.iter_mut().enumerate() {
        for rho in 0..s {
            let bracket = connection.coefficients(graph, algebroid, kappa, rho);
            row.push(reduced.declared(graph, &bracket));
        }
    }
    [curvature, coefficients]
}

fn functions(
    proved: &mut Proved,
    distribution: Option<&ConstraintDistribution>,
    reduced: &Reduced,
    connection: &NonholonomicConnection,
    derivative: &Procedure,
) -> Functions {
    let judge = judge(proved);
    let graph = &mut proved.model.graph;
    // 1. sections and brackets in the declared basis
    let declared = |graph: &mut _, sections: &Matrix| -> Matrix {
        sections.iter().map(|section| reduced.declared(graph, section)).collect()
    };
    let (vertical, lifts) = (declared(graph, &connection.vertical), declared(graph, &connection.lifts));
    let [curvature, coefficients] = brackets(graph, reduced, connection);
    // 2. p, P_ρ and its rate where the constraints hold
    let velocities = proved.system.algebroid.velocities.clone();
    let mut restriction = match distribution {
        Some(distribution) => distribution.restriction(graph, &velocities),
        None => Substitution::new([]),
    };
    let momenta = proved.system.momenta(graph);
    let momenta = restriction.apply_all(graph, &momenta);
    let spanned = proved.model.distribution.is_some().then_some(distribution).flatten();
    let (mut values, mut rates) = (Vec::new(), Vec::new());
    for section in &vertical {
        let momentum = Momentum::of(graph, &proved.system, section, None, spanned);
        let rate = momentum.rate(graph);
        for (function, list) in [(momentum.value, &mut values), (rate, &mut rates)] {
            let function = restriction.apply(graph, function);
            list.push(graph.simplify(function));
        }
    }
    // 3. ẋ^κ, and v^ρ by the locked inertia or as components
    let velocity = proved.system.algebroid.velocity(graph);
    let all = proved.system.algebroid.rates(graph, &velocity);
    let all = restriction.apply_all(graph, &all);
    let speeds: Vec<ExprId> = connection.coordinates.iter().map(|id| all[id.index()]).collect();
    let mut procedure = Procedure::default();
    let along_vertical = if let Some(inertia) = &connection.inertia {
        let at_rest = distribution.map_or(&velocities, |distribution| &distribution.independent);
        let moving: Vec<ExprId> = values.iter().map(|value| without_rest(graph, *value, at_rest)).collect();
        solve_symmetric(graph, inertia, &moving, judge(graph, inertia), &mut procedure, "locked")
    } else {
        let symbols: Vec<ExprId> =
            reduced.distribution.independent.iter().map(|symbol| graph.symbol(*symbol)).collect();
        let components = graph.image(&connection.components, &symbols);
        let components: Vec<ExprId> =
            components.into_iter().map(|v| reduced.at_declared_velocities(proved, v)).collect();
        components.into_iter().map(|v| restriction.apply(&mut proved.model.graph, v)).collect()
    };
    // 4. −p([h_κ, h_λ]) ẋ^λ − p([h_κ, S_ρ]) v^ρ
    let graph = &mut proved.model.graph;
    let mut force = Vec::new();
    for (curvature, coefficients) in curvature.iter().zip(&coefficients) {
        let brackets: Vec<ExprId> = curvature
            .iter()
            .chain(coefficients)
            .map(|bracket| graph.inner_product(bracket, &momenta))
            .collect();
        let speeds: Vec<ExprId> = speeds.iter().chain(&along_vertical).copied().collect();
        let sum = graph.inner_product(&brackets, &speeds);
        let sum = graph.formula(-sum);
        force.push(graph.simplify(sum));
    }
    let mut found = Functions::default();
    found.add(&VERTICAL_SECTIONS, Procedure::of(vertical.concat()));
    found.add(&HORIZONTAL_LIFTS, Procedure::of(lifts.concat()));
    found.add_if(&LOCKED_INERTIA, connection.inertia.as_ref().map(|inertia| Procedure::of(inertia.concat())));
    found.add(&CONNECTION_COEFFICIENTS, Procedure::of(coefficients.concat().concat()));
    found.add(&CURVATURE, Procedure::of(curvature.concat().concat()));
    found.add(&VERTICAL_MOMENTA, Procedure::of(values));
    found.add(&VERTICAL_MOMENTUM_RATES, derivative.with_outputs(rates));
    found.add(&VERTICAL_VELOCITIES, procedure.with_outputs(along_vertical));
    found.add(&HORIZONTAL_FORCE, procedure.with_outputs(force));
    // an array without entries is none
    found.retain(|function| !function.procedure.outputs.is_empty());
    found
}
