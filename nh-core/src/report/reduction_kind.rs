//! What reduction theory calls a system, and the quantities that it names, as lines of text.

use super::{combination, section_names, shown};
use crate::algebra::Graph;
use crate::check::evidence::places;
use crate::compile::{Proved, Reduced};
use crate::findings::{Connection, Quantities, ReducedForm, Split};
use crate::geometry::Drops;
use crate::id::ExprId;
use crate::mechanics::{Chaplygin, Splitting};
use crate::model::Model;

/// What stands in the place of quantities that are not shown.
const TOO_LONG: &str = "not shown: the quantities of this splitting are too long";

/// The name of the reduced equations.
pub(super) fn name(proved: &Proved, form: &ReducedForm) -> Option<String> {
    match form {
        ReducedForm::OverAPoint { is_free: true } => Some("equations: Euler–Poincaré".into()),
        ReducedForm::OverAPoint { is_free: false } => Some("equations: Euler–Poincaré–Suslov".into()),
        ReducedForm::Split(split) => Some(name_of_split(proved, split)),
        ReducedForm::Unnamed => None,
    }
}

fn name_of_split(proved: &Proved, split: &Split) -> String {
    let splitting = &split.reduced.splitting;
    let more = more_shared(&proved.model.graph, &split.larger);
    let coordinates: Vec<&str> =
        splitting.coordinates.iter().map(|id| proved.model.coordinates[*id].name.as_str()).collect();
    let coordinates = coordinates.join(", ");
    let Splitting { vertical, horizontal, .. } = splitting;
    let (shared, m) = (splitting.shared(), splitting.dimension);
    let v = if splitting.by_group { "V along the group" } else { "V = ker ρ" };
    let name = if split.is_free {
        format!("Lagrange–Poincaré, with momentum equations of rank {vertical}")
    } else if splitting.is_chaplygin() {
        let shown = |factor: &ExprId| format!("{} != 0", shown(&proved.model.graph, *factor));
        let conditions = split.singular.iter().map(shown).collect::<Vec<_>>().join(" and ");
        let only = if conditions.is_empty() { "" } else { " where " };
        format!(
            "of a Chaplygin system: the anchor maps D one to one onto the rates of {coordinates}{only}{conditions}"
        )
    } else if shared == 0 {
        format!("purely kinematic: D meets {v} in 0 only{more}; ρ(D) has rank {horizontal} of {m}")
    } else if *horizontal == 0 {
        format!("momentum equations of rank {shared}{more} alone: D lies in {v}")
    } else {
        let assumption = if splitting.spans() {
            "D + V = E (the dimension assumption)"
        } else {
            "D + V is not E (no dimension assumption)"
        };
        format!("Lagrange–d'Alembert–Poincaré: S = D ∩ V, {v}, has rank {shared}{more}; {assumption}")
    };
    let declared = proved.symmetries.declared.iter().any(|symmetry| symmetry.keeps_constraints);
    let group = match splitting.by_group {
        false if declared => "; the declared symmetries are left aside".into(),
        false => String::new(),
        true => format!("; the group: {}", split.reduced.group_in_words(proved)),
    };
    format!("equations: {name}{group}")
}

/// Where S = D ∩ V is larger than at generic points.
fn more_shared(graph: &Graph, larger: &Drops) -> String {
    match larger {
        Drops::Nowhere => String::new(),
        Drops::Where(_) => {
            places(graph, larger).map_or_else(String::new, |places| format!(" (more where {places})"))
        }
        Drops::Undecided => ", at generic points".into(),
    }
}

/// CM Propositions 8 and 9.
pub(super) fn quantities(model: &Model, form: &ReducedForm) -> Vec<String> {
    let ReducedForm::Split(split) = form else { return Vec::new() };
    let reduced = &split.reduced;
    let mut lines = match split.quantities {
        Quantities::NotAsked => return Vec::new(),
        Quantities::TooLong => return vec![TOO_LONG.into()],
        Quantities::Chaplygin(_) | Quantities::Connection(_) => frame(model, reduced),
    };
    match &split.quantities {
        Quantities::Chaplygin(found) => lines.extend(chaplygin(model, reduced, found)),
        Quantities::Connection(Some(found)) => lines.extend(connection(model, &reduced.names, found)),
        _ => {}
    }
    lines
}

/// The velocities of the invariant frame.
fn frame(model: &Model, reduced: &Reduced) -> Vec<String> {
    let Some(frame) = &reduced.frame else { return Vec::new() };
    let declared = section_names(model);
    let velocities = reduced.names.iter().zip(&frame.change.velocities);
    let changed = velocities.filter(|(name, _)| !declared.contains(name));
    changed
        .map(|(name, row)| {
            format!("velocity in the invariant frame: {name} = {}", combination(&model.graph, row, &declared))
        })
        .collect()
}

/// Lifts, curvature, the reduced Lagrangian and the gyroscopic force.
fn chaplygin(model: &Model, Reduced { splitting, names, .. }: &Reduced, found: &Chaplygin) -> Vec<String> {
    let graph = &model.graph;
    let name = |i: usize| model.coordinates[splitting.coordinates[i]].name.as_str();
    let mut lines = Vec::new();
    for (i, lift) in found.lifts.iter().enumerate() {
        lines.push(format!("horizontal lift of d/d{}: {}", name(i), combination(graph, lift, names)));
    }
    let mut pairs = found.curvature.iter();
    for i in 0..found.lifts.len() {
        for (j, curvature) in (i + 1..found.lifts.len()).zip(&mut pairs) {
            let value = combination(graph, curvature, names);
            lines.push(format!("curvature K(d/d{}, d/d{}) = {value}", name(i), name(j)));
        }
    }
    lines.push(format!("reduced Lagrangian: {}", shown(graph, found.lagrangian)));
    for (i, force) in found.force.iter().enumerate() {
        lines.push(format!("gyroscopic force <J, K> along {}: {}", name(i), shown(graph, *force)));
    }
    lines
}

/// S = D ∩ V, the lifts orthogonal to it, and their brackets.
fn connection(model: &Model, names: &[String], found: &Connection) -> Vec<String> {
    let (graph, sections) = (&model.graph, &found.sections);
    let vertical: Vec<String> = sections
        .named
        .iter()
        .map(|symbol| graph.free_name(&format!("S_{}", graph.symbols()[*symbol])))
        .collect();
    let lifts: Vec<String> = sections
        .coordinates
        .iter()
        .map(|id| graph.free_name(&format!("h_{}", model.coordinates[*id].name)))
        .collect();
    let mut lines = Vec::new();
    for (name, section) in vertical.iter().zip(&sections.vertical) {
        lines.push(format!("momentum section {name} = {}", combination(graph, section, names)));
    }
    for (name, section) in lifts.iter().zip(&sections.lifts) {
        lines.push(format!("horizontal lift {name} = {}", combination(graph, section, names)));
    }
    let inertia = sections.inertia.as_ref().into_iter().flatten().enumerate();
    for (rho, row) in inertia {
        for (sigma, entry) in row.iter().enumerate().skip(rho) {
            if !graph.is_literal_zero(*entry) {
                let (first, second) = (&vertical[rho], &vertical[sigma]);
                lines.push(format!("locked inertia <{first}, {second}> = {}", shown(graph, *entry)));
            }
        }
    }
    let mut bracket = |what: &str, first: &str, second: &str, value: &[ExprId]| {
        lines.push(format!("{what} [{first}, {second}] = {}", combination(graph, value, names)));
    };
    for kappa in 0..lifts.len() {
        for (_, lambda, value) in found.curvature.iter().filter(|(first, ..)| *first == kappa) {
            bracket("curvature", &lifts[kappa], &lifts[*lambda], value);
        }
        for (_, rho, value) in found.coefficients.iter().filter(|(first, ..)| *first == kappa) {
            bracket("connection", &lifts[kappa], &vertical[*rho], value);
        }
    }
    for (rho, sigma, value) in &found.brackets {
        bracket("bracket in S", &vertical[*rho], &vertical[*sigma], value);
    }
    lines
}
