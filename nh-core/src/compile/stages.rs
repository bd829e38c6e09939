//! The way of the data: every stage takes a value and returns a value of another type.

use super::idle_coordinates::without_idle_coordinates;
use super::levels::OnLevels;
use super::proved::{Proved, both, fence};
use super::{
    adapted_functions, analytic, folded_constants, levels, linearization, momenta, projected_functions,
    routh, slice, strangers, vector_products,
};
use crate::algebra::Facts;
use crate::check::BrokenLaws;
use crate::check::{self, Chosen, Constraints, Kind, Motion, Positions};
use crate::choose::Ledger;
use crate::forms::Registry;
use crate::geometry::{Algebroid, ConstraintDistribution, Manifold};
use crate::id::{ExprId, Id};
use crate::limits::{Subject, about, within_limits};
use crate::mechanics::LagrangianSystem;
use crate::model::{ForceDirection, Model};
use crate::system::System;
use crate::violation::{Law, Violation};

/// Checks a declaration and derives its equations.
///
/// # Errors
/// Everything found wrong in the first stage that finds something wrong.
pub fn compile(model: Model) -> Result<System, Vec<Violation>> {
    compile_with(model, &Registry::standard())
}

/// The same with the forms of a registry.
///
/// # Errors
/// As [`compile`].
pub fn compile_with(model: Model, registry: &Registry) -> Result<System, Vec<Violation>> {
    let origin = model.lagrangian.origin;
    within_limits(|| compiled(model, registry)).unwrap_or_else(|too_large| {
        let (what, way_out) = (too_large.what(), too_large.way_out().to_owned());
        Err(vec![Violation { law: Law::Size, origin, what, evidence: String::new(), way_out }])
    })
}

fn compiled(model: Model, registry: &Registry) -> Result<System, Vec<Violation>> {
    let (mut proved, chosen) = prove(model)?;
    let quadratures = proved.quadratures.clone();
    let constrained = linearization::manifold(&mut proved);
    // 7. the equations, proved regular, and the claims about them
    about(Subject::Equations);
    let system = match chosen {
        Chosen::Adapted { distribution, conditions, reason } => {
            match levels::on_levels(&mut proved, &distribution)? {
                OnLevels::Adapted(leveled) => {
                    let reason = reason + &leveled.remark;
                    adapted_functions::derive(
                        proved,
                        registry,
                        (&distribution, &leveled),
                        (&conditions, &reason),
                    )?
                }
                OnLevels::Projected { reason } => projected_functions::derive(proved, registry, &reason)?,
            }
        }
        Chosen::Projected { reason } => projected_functions::derive(proved, registry, &reason)?,
    };
    let system = strangers::without_strangers(system)?;
    // 8. what is tracked
    about(Subject::Requests);
    let mut system = slice::slice(routh::without(system, &quadratures))?;
    folded_constants::in_numbers(&mut system);
    linearization::derive(&mut system, constrained.as_ref())?;
    vector_products::derive(&mut system)?;
    // 9. Taylor series exist where they are asked for
    fence(analytic::check(&system).err().into_iter().collect())?;
    Ok(system)
}

/// The first stages: a declaration that is checked, and the form that its equations will have.
///
/// # Errors
/// As [`compile`].
pub(crate) fn prove(mut model: Model) -> Result<(Proved, Chosen), Vec<Violation>> {
    // 1. every expression is defined, and smooth where it is differentiated; facts do not contradict
    let facts = check::facts(&mut model);
    let broken = check::declared_expressions(&mut model, facts.as_ref().unwrap_or(&Facts::default()));
    let broken = [broken, check::rates_in_a_circle(&model)].concat();
    let facts = both(broken, facts)?;
    model.assume(&facts);
    // 2. the anchor: linear and homogeneous; a coframe is inverted
    about(Subject::Kinematics);
    let mut motion = check::kinematics(&mut model)?;
    // 3. the embedded base, which the anchor keeps; the brackets, declared or derived
    about(Subject::Embedding);
    let base = check::embedding(&mut model, &motion)?;
    model.graph.set_embedded(base.rational_chart().unwrap_or_default());
    fence(check::declared_on(&mut model, &facts, &base, &[]))?;
    fence(check::claimed(&mut model, &base))?;
    about(Subject::Brackets);
    let structure = check::structure_functions(&mut model, &motion, &base)?;
    let velocities = model.sections.iter().map(|section| section.symbol).collect();
    let algebroid = Algebroid { anchor: motion.anchor.clone(), structure, velocities };
    // 4. the structure equations, and D: by constraints or by sections, in the basis of the frame
    let laws = check::structure_equations(&mut model, &algebroid, &base);
    let kind = Kind::of(&mut model, &algebroid, &base, &facts);
    about(Subject::Constraints);
    let described = describe(&mut model, &mut motion, algebroid, &base, &facts);
    let (broken_laws, broken) =
        laws.map_or_else(|broken| (BrokenLaws::default(), broken), |laws| (laws, Vec::new()));
    let Described { algebroid, positions, constraints, spanned } = both(broken, described)?;
    fence(check::declared_on(&mut model, &facts, &positions.manifold, &positions.values))?;
    let kind = kind.in_basis(&model, &algebroid);
    let constraint_rank = constraints.rank(&mut model, &algebroid, spanned.as_ref(), &facts);
    // 5. the Lagrangian system on E, and its symmetries
    about(Subject::Kinematics);
    let system = lagrangian_system(&mut model, &mut motion, algebroid);
    // without symmetries it is the Lagrangian that is searched for cyclic coordinates
    let is_declared = !model.symmetries.is_empty() || !model.routh.is_empty();
    about(if is_declared { Subject::Symmetries } else { Subject::Equations });
    let symmetries = momenta::symmetries(&mut model, &motion, &system, &constraints, spanned.as_ref())?;
    let levels = routh::levels(&mut model, &symmetries)?;
    let quadratures = routh::quadratures(&mut model, &system, &symmetries, &levels);
    // 6. the formulation: a basis of D valid everywhere, or multipliers
    about(Subject::Constraints);
    let chart = check::chart(&mut model, &positions, &facts)?;
    let chosen = match spanned {
        Some(distribution) => {
            let reason = "the declared sections span D".into();
            Chosen::Adapted { distribution: Box::new(distribution), conditions: Vec::new(), reason }
        }
        None => check::choose_formulation(&mut model, &constraints, &facts, &positions.manifold)?,
    };
    let chosen = check::orthonormal(&mut model, &system, chosen, &facts)?;
    let between = &mut check::Between {
        motion: &mut motion,
        system: &system,
        constraints: &constraints,
        positions: &positions,
        chosen: &chosen,
    };
    let impacts = check::impacts(&mut model, between)?;
    let proved = Proved {
        impacts,
        chart,
        model,
        motion,
        base,
        facts,
        kind,
        broken_laws,
        positions,
        constraints,
        constraint_rank,
        system,
        symmetries,
        levels,
        quadratures,
        split: None,
        is_pivoted: false,
        before_counting: None,
        ledger: Ledger::default(),
    };
    Ok((proved, chosen))
}

/// What the constraints say.
struct Described {
    /// In the basis that the frame makes.
    algebroid: Algebroid,
    positions: Positions,
    constraints: Constraints,
    /// D, where sections span it.
    spanned: Option<ConstraintDistribution>,
}

/// The constraints on positions and velocities, or the distribution that sections span.
fn describe(
    model: &mut Model,
    motion: &mut Motion,
    algebroid: Algebroid,
    base: &Manifold,
    facts: &Facts,
) -> Result<Described, Vec<Violation>> {
    if let Some(spanned) = check::spanned_distribution(model, motion, &algebroid, base)? {
        let positions = check::positions(model, motion, &algebroid, base)?;
        let constraints = Constraints::spanned(&mut model.graph, base, &spanned, &algebroid.velocities);
        return Ok(Described { algebroid, positions, constraints, spanned: Some(spanned) });
    }
    let algebroid = check::change_to_frame(model, motion, algebroid, base, facts)?;
    let positions = check::positions(model, motion, &algebroid, base)?;
    let constraints = check::constraints(model, motion, &algebroid, &positions)?;
    Ok(Described { algebroid, positions, constraints, spanned: None })
}

/// Puts ρ(y) for the rates and pulls forces along coordinates back.
fn lagrangian_system(model: &mut Model, motion: &mut Motion, algebroid: Algebroid) -> LagrangianSystem {
    let lagrangian = motion.rates.apply(&mut model.graph, model.lagrangian.value);
    let mut energies: Vec<ExprId> =
        model.bodies.iter().map(|body| motion.rates.apply(&mut model.graph, body.energy)).collect();
    let lagrangian = without_idle_coordinates(model, lagrangian, &mut energies);
    for (body, energy) in model.bodies.iter_mut().zip(energies) {
        body.energy = energy;
    }
    let graph = &mut model.graph;
    let zero = graph.zero();
    let mut forces = vec![zero; algebroid.rank()];
    let mut along_base = vec![zero; model.coordinates.len()];
    let mut forces_on_distribution = Vec::new();
    for force in &model.forces {
        let value = motion.rates.apply(graph, force.value);
        let symbol = match force.direction {
            ForceDirection::Section(symbol) => symbol,
            ForceDirection::Coordinate(coordinate) => {
                let slot = &mut along_base[coordinate.index()];
                *slot = graph.formula(*slot + value);
                continue;
            }
        };
        if let Some(index) = algebroid.velocities.iter().position(|velocity| *velocity == symbol) {
            forces[index] = graph.formula(forces[index] + value);
        } else if let Some((_, row)) = motion.replaced.iter().find(|(replaced, _)| *replaced == symbol) {
            // Υ(f_k) = Ψ^α_k Υ_α
            for (slot, component) in forces.iter_mut().zip(row) {
                *slot = graph.formula(*slot + component * value);
            }
        } else {
            forces_on_distribution.push((symbol, value));
        }
    }
    let pulled_back = algebroid.anchor.pull_back(graph, &along_base);
    let forces =
        forces.into_iter().zip(pulled_back).map(|(direct, pulled)| graph.formula(direct + pulled)).collect();
    LagrangianSystem { algebroid, lagrangian, forces, forces_on_distribution, clock: model.clock() }
}
