//! What reduction theory calls a system, and the quantities that it names.

use super::{Derived, combination, section_names, shown};
use crate::algebra::Graph;
use crate::compile::{Proved, chaplygin, splitting};
use crate::geometry::ConstraintDistribution;
use crate::id::{ExprId, SymbolId};
use crate::mechanics::{MomentumFrame, Splitting};

/// Lagrangians with more operations than this are classified, but their splitting is not shown.
const SHOWN_UP_TO: u64 = 150;

/// The name of the reduced equations, and their quantities.
pub(super) fn lines(proved: &mut Proved, derived: &Derived<'_>) -> (Option<String>, Vec<String>) {
    let distribution = match derived {
        Derived::Adapted { distribution, .. } => Some((*distribution).clone()),
        Derived::Projected { .. } => {
            let velocities = proved.system.algebroid.velocities.clone();
            proved.constraints.generic_distribution(&mut proved.model.graph, &velocities)
        }
    };
    let Some(distribution) = distribution else { return (None, Vec::new()) };
    let is_free = distribution.constraints.annihilator.is_empty();
    if proved.model.coordinates.is_empty() {
        let name = if is_free { "Euler–Poincaré" } else { "Euler–Poincaré–Suslov" };
        return (Some(format!("equations: {name}")), Vec::new());
    }
    let Some(splitting) = splitting(proved, &distribution) else { return (None, Vec::new()) };
    let name = name(proved, &splitting, is_free);
    let small = proved.model.graph.operation_count(&[proved.system.lagrangian]) <= SHOWN_UP_TO;
    let adapted = matches!(derived, Derived::Adapted { .. });
    let lines = if small && adapted && !is_free && splitting.horizontal > 0 {
        quantities(proved, &distribution, &splitting)
    } else {
        Vec::new()
    };
    (Some(name), lines)
}

fn name(proved: &Proved, splitting: &Splitting, is_free: bool) -> String {
    let coordinates: Vec<&str> =
        splitting.coordinates.iter().map(|id| proved.model.coordinates[*id].name.as_str()).collect();
    let coordinates = coordinates.join(", ");
    let Splitting { vertical, horizontal, .. } = splitting;
    let (shared, m) = (splitting.shared(), splitting.coordinates.len());
    let name = if is_free {
        format!("Lagrange–Poincaré, with momentum equations of rank {vertical}")
    } else if splitting.is_chaplygin() {
        format!("of a Chaplygin system: the anchor maps D one to one onto the rates of {coordinates}")
    } else if shared == 0 {
        format!("purely kinematic: D meets V = ker ρ in 0 only; ρ(D) has rank {horizontal} of {m}")
    } else if *horizontal == 0 {
        format!("momentum equations of rank {shared} alone: D lies in V = ker ρ")
    } else {
        let assumption = if splitting.spans() {
            "D + V = E (the dimension assumption)"
        } else {
            "D + V is not E (no dimension assumption)"
        };
        format!("Lagrange–d'Alembert–Poincaré: S = D ∩ V, V = ker ρ, has rank {shared}; {assumption}")
    };
    let group =
        if splitting.by_cyclic { "; the group: translations along the cyclic coordinates" } else { "" };
    format!("equations: {name}{group}")
}

/// CM Propositions 8 and 9.
fn quantities(
    proved: &mut Proved,
    distribution: &ConstraintDistribution,
    splitting: &Splitting,
) -> Vec<String> {
    let names = section_names(&proved.model);
    let mut lines = Vec::new();
    if let Some(found) = chaplygin(proved, distribution, splitting) {
        let model = &proved.model;
        let name = |i: usize| model.coordinates[splitting.coordinates[i]].name.as_str();
        for (i, lift) in found.lifts.iter().enumerate() {
            lines.push(format!(
                "horizontal lift of d/d{}: {}",
                name(i),
                combination(&model.graph, lift, &names)
            ));
        }
        let mut pairs = found.curvature.iter();
        for i in 0..found.lifts.len() {
            for (j, curvature) in (i + 1..found.lifts.len()).zip(&mut pairs) {
                let value = combination(&model.graph, curvature, &names);
                lines.push(format!("curvature K(d/d{}, d/d{}) = {value}", name(i), name(j)));
            }
        }
        lines.push(format!("reduced Lagrangian: {}", shown(&model.graph, found.lagrangian)));
        for (i, force) in found.force.iter().enumerate() {
            lines.push(format!("gyroscopic force <J, K> along {}: {}", name(i), shown(&model.graph, *force)));
        }
        return lines;
    }
    let graph = &mut proved.model.graph;
    let Some(frame) = MomentumFrame::of(graph, &proved.system, distribution, splitting) else { return lines };
    for (symbol, section) in &frame.vertical {
        let name = &graph.symbols()[*symbol];
        lines.push(format!("S, along {name}: {}", combination(graph, section, &names)));
    }
    let mut bracket =
        |graph: &mut Graph, what: &str, a: &(SymbolId, Vec<ExprId>), b: &(SymbolId, Vec<ExprId>)| {
            let bracket = proved.system.algebroid.bracket(graph, &a.1, &b.1);
            let bracket: Vec<ExprId> = bracket.into_iter().map(|c| graph.simplify(c)).collect();
            if bracket.iter().any(|c| !graph.is_literal_zero(*c)) {
                let (first, second) = (&graph.symbols()[a.0], &graph.symbols()[b.0]);
                lines.push(format!("{what} [{first}, {second}] = {}", combination(graph, &bracket, &names)));
            }
        };
    for (index, along) in frame.horizontal.iter().enumerate() {
        for other in &frame.horizontal[index + 1..] {
            bracket(graph, "curvature", along, other);
        }
        for vertical in &frame.vertical {
            bracket(graph, "connection", along, vertical);
        }
    }
    for (index, vertical) in frame.vertical.iter().enumerate() {
        for other in &frame.vertical[index + 1..] {
            bracket(graph, "bracket in S", vertical, other);
        }
    }
    lines
}
