//! The way of the data: every stage takes a value and returns a value of another type.

use crate::algebra::Substitution;
use crate::check::{self, Chosen, Motion};
use crate::geometry::{Algebroid, ConstraintDistribution, LinearConstraints};
use crate::id::{ExprId, Id, SectionId};
use crate::mechanics::{
    LagrangianSystem, Procedure, definiteness, energy, reduced_equations, saddle_equations, solve_symmetric,
};
use crate::model::{ForceDirection, Formulation, Model};
use crate::report::{Derived, equations_of_motion, report};
use crate::system::{ParameterCheck, System};
use crate::violation::Violation;

/// Checks a declaration and derives its equations.
///
/// # Errors
/// Everything found wrong in the first stage that finds something wrong.
pub fn compile(mut model: Model) -> Result<System, Vec<Violation>> {
    // 1. every expression is defined, and smooth where it is differentiated
    fence(check::declared_expressions(&model))?;
    // 2. the anchor: linear and homogeneous; a coframe is inverted
    let mut motion = check::kinematics(&mut model)?;
    // 3. the brackets: declared or derived
    let structure = check::structure_functions(&mut model, &motion)?;
    let velocities = model.sections.iter().map(|section| section.symbol).collect();
    let algebroid = Algebroid { anchor: motion.anchor.clone(), structure, velocities };
    // 4. the structure equations, and the constraints
    let broken = check::structure_equations(&mut model, &algebroid);
    let constraints = both(broken, check::linear_constraints(&mut model, &mut motion, &algebroid))?;
    // 5. the formulation: a basis of D valid everywhere, or multipliers
    let chosen = check::choose_formulation(&mut model, &constraints)?;
    // 6. the Lagrangian system on E
    let system = lagrangian_system(&mut model, &mut motion, algebroid);
    // 7. the equations, proved regular
    match chosen {
        Chosen::Adapted { distribution, conditions, reason } => {
            adapted(model, &motion, &system, &distribution, &conditions, &reason)
        }
        Chosen::Projected { reason } => projected(model, &motion, &system, &constraints, &reason),
    }
}

fn fence(violations: Vec<Violation>) -> Result<(), Vec<Violation>> {
    if violations.is_empty() { Ok(()) } else { Err(violations) }
}

/// Reports what two independent checks found in one go.
fn both<T>(first: Vec<Violation>, second: Result<T, Vec<Violation>>) -> Result<T, Vec<Violation>> {
    match second {
        Ok(value) => fence(first).map(|()| value),
        Err(more) => Err(first.into_iter().chain(more).collect()),
    }
}

/// Puts ρ(y) for the rates and pulls forces along coordinates back.
fn lagrangian_system(model: &mut Model, motion: &mut Motion, algebroid: Algebroid) -> LagrangianSystem {
    let graph = &mut model.graph;
    let lagrangian = motion.rates.apply(graph, model.lagrangian.value);
    let zero = graph.zero();
    let mut along_sections = vec![zero; algebroid.rank()];
    let mut along_base = vec![zero; model.coordinates.len()];
    for force in &model.forces {
        let value = motion.rates.apply(graph, force.value);
        let slot = match force.direction {
            ForceDirection::Section(section) => &mut along_sections[section.index()],
            ForceDirection::Coordinate(coordinate) => &mut along_base[coordinate.index()],
        };
        *slot = graph.add(*slot, value);
    }
    let pulled_back = algebroid.anchor.pull_back(graph, &along_base);
    let forces = along_sections
        .into_iter()
        .zip(pulled_back)
        .map(|(direct, pulled)| graph.add(direct, pulled))
        .collect();
    LagrangianSystem { algebroid, lagrangian, forces, time: model.time }
}

/// The declared observables with `velocity` put in.
fn observables(model: &mut Model, motion: &Motion, restriction: &mut Substitution) -> Procedure {
    let mut rates = motion.rates.clone();
    let graph = &mut model.graph;
    let outputs = model
        .outputs
        .iter()
        .map(|output| {
            let value = rates.apply(graph, output.value);
            restriction.apply(graph, value)
        })
        .collect();
    Procedure::of(outputs)
}

fn parameter_checks(model: &mut Model, conditions: &[ExprId]) -> Vec<ParameterCheck> {
    let mut checks: Vec<ParameterCheck> = Vec::new();
    for &nonzero in conditions {
        if !checks.iter().any(|check| check.nonzero == nonzero) {
            checks.push(ParameterCheck { nonzero, text: model.graph.text(nonzero) });
        }
    }
    checks
}

fn adapted(
    mut model: Model,
    motion: &Motion,
    system: &LagrangianSystem,
    distribution: &ConstraintDistribution,
    conditions: &[ExprId],
    reason: &str,
) -> Result<System, Vec<Violation>> {
    let equations = reduced_equations(&mut model.graph, system, distribution);
    fence(check::reduced_regularity(&model, &equations).into_iter().collect())?;
    let parameters: Vec<_> = model.parameters.iter().map(|parameter| parameter.symbol).collect();
    let definite = definiteness(&model.graph, &equations.mass, &parameters);
    let graph = &mut model.graph;
    let mut derivative = Procedure::default();
    let accelerations =
        solve_symmetric(graph, &equations.mass, &equations.force, definite, &mut derivative, "v_dot");
    derivative.outputs = equations.rates.iter().copied().chain(accelerations).collect();
    let mut restriction = distribution.restriction(graph, &system.algebroid.velocities);
    let full_energy = energy(graph, system);
    let restricted = restriction.apply(graph, full_energy);
    let restricted = graph.simplify(restricted);
    let observables = observables(&mut model, motion, &mut restriction);
    let derived = Derived::Adapted { distribution, equations: &equations };
    let text = report(&mut model, motion, system, &derived, reason, conditions);
    let lines = equations_of_motion(&model, &derived);
    let checks = parameter_checks(&mut model, conditions);
    Ok(System {
        formulation: Formulation::Adapted,
        state_velocities: distribution.independent.clone(),
        derivative,
        energy: Procedure::of(vec![restricted]),
        velocity: Procedure::of(equations.velocity.clone()),
        observables,
        parameter_checks: checks,
        report: text,
        equations: lines,
        model,
    })
}

fn projected(
    mut model: Model,
    motion: &Motion,
    system: &LagrangianSystem,
    constraints: &LinearConstraints,
    reason: &str,
) -> Result<System, Vec<Violation>> {
    let velocity = system.algebroid.velocity(&mut model.graph);
    let residuals: Vec<ExprId> = constraints
        .annihilator
        .iter()
        .zip(&constraints.drift)
        .map(|(row, drift)| {
            let linear = model.graph.inner_product(row, &velocity);
            model.graph.add(linear, *drift)
        })
        .collect();
    let equations = saddle_equations(&mut model.graph, system, &residuals);
    fence(check::saddle_regularity(&mut model, &equations).into_iter().collect())?;
    let parameters: Vec<_> = model.parameters.iter().map(|parameter| parameter.symbol).collect();
    let definite = definiteness(&model.graph, &equations.mass, &parameters);
    let mut derivative = Procedure::default();
    let (accelerations, _) = equations.solve(&mut model.graph, definite, &mut derivative);
    derivative.outputs = equations.rates.iter().copied().chain(accelerations).collect();
    let energy = energy(&mut model.graph, system);
    let observables = observables(&mut model, motion, &mut Substitution::new([]));
    let derived = Derived::Projected { constraints, equations: &equations };
    let text = report(&mut model, motion, system, &derived, reason, &[]);
    let lines = equations_of_motion(&model, &derived);
    let sections: Vec<SectionId> = model.sections.ids().collect();
    Ok(System {
        formulation: Formulation::Projected,
        state_velocities: sections,
        derivative,
        energy: Procedure::of(vec![energy]),
        velocity: Procedure::of(velocity),
        observables,
        parameter_checks: Vec::new(),
        report: text,
        equations: lines,
        model,
    })
}
