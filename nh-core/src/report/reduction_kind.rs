//! What reduction theory calls a system, and the quantities that it names.

use super::{combination, shown};
use crate::algebra::{Graph, Matrix};
use crate::check::evidence::places;
use crate::check::singular_where;
use crate::compile::{Derived, Proved, Reduced};
use crate::geometry::{ConstraintDistribution, Manifold};
use crate::geometry::{Drops, RankSetting};
use crate::id::{ExprId, SymbolId};
use crate::limits::attempt;
use crate::mechanics::{NonholonomicConnection, Splitting};

/// Lagrangians with more operations than this are classified, but their splitting is not shown.
const SHOWN_UP_TO: u64 = 150;
/// What the quantities of a splitting may take, in steps of work: what takes more fills pages, and nothing else
/// depends on it.
const SHOWN: u64 = 40_000;
/// What stands in their place.
const TOO_LONG: &str = "not shown: the quantities of this splitting are too long";

/// The name of the reduced equations, and their quantities.
pub(super) fn lines(proved: &mut Proved, derived: &Derived<'_>) -> (Option<String>, Vec<String>) {
    let is_free = match derived {
        Derived::Adapted { distribution, .. } => distribution.constraints.annihilator.is_empty(),
        Derived::Projected { residuals, .. } => residuals.is_empty(),
    };
    if proved.model.coordinates.is_empty() {
        let name = if is_free { "Euler–Poincaré" } else { "Euler–Poincaré–Suslov" };
        return (Some(format!("equations: {name}")), Vec::new());
    }
    let distribution = match derived {
        Derived::Adapted { distribution, .. } => Some(*distribution),
        Derived::Projected { .. } => None,
    };
    let Ok(reduced) = Reduced::of(proved, distribution) else { return (None, Vec::new()) };
    let singular = if reduced.splitting.is_chaplygin() { not_onto(proved, &reduced) } else { Vec::new() };
    let more = more_shared(proved, &reduced);
    let name = name(proved, &reduced.splitting, is_free, reduced.frame.is_some(), &singular, &more);
    let small = proved.model.graph.operation_count(&[proved.system.lagrangian]) <= SHOWN_UP_TO;
    let has_basis = distribution.is_some() || reduced.frame.is_some();
    let is_horizontal = reduced.splitting.horizontal > 0 || reduced.frame.is_some();
    let lines = if small && has_basis && is_horizontal {
        attempt(SHOWN, || quantities(proved, &reduced)).unwrap_or_else(|| vec![TOO_LONG.into()])
    } else {
        Vec::new()
    };
    (Some(name), lines)
}

/// Where the projection of a Chaplygin system is singular all the same: where constraints on V are
/// dependent, or rates along a basis of D. The basis alone does not tell: where D meets V, its own
/// coefficients may be infinite.
fn not_onto(proved: &mut Proved, reduced: &Reduced) -> Vec<ExprId> {
    let Proved { model, facts, .. } = proved;
    let parameters: Vec<SymbolId> = model.parameters.iter().map(|parameter| parameter.symbol).collect();
    let Reduced { system, distribution, splitting, .. } = reduced;
    if let Some(on_vertical) = splitting.constraints_on_vertical(&model.graph, system, distribution) {
        let found = singular_where(&mut model.graph, &on_vertical, &parameters, facts);
        if !found.is_empty() {
            return found;
        }
    }
    if splitting.coordinates.len() != splitting.rank {
        return not_onto_embedded(proved, reduced);
    }
    let projection = splitting.projection(&mut model.graph, system, distribution);
    singular_where(&mut model.graph, &projection, &parameters, facts)
}

/// Where S = D ∩ V is larger than at generic points: where the constraints and the rates of the coordinates
/// together have less rank.
fn more_shared(proved: &mut Proved, reduced: &Reduced) -> String {
    let Proved { model, facts, base, .. } = proved;
    let parameters: Vec<SymbolId> = model.parameters.iter().map(|parameter| parameter.symbol).collect();
    let together = reduced.splitting.constraints_and_rates(&reduced.system, &reduced.distribution);
    let setting = RankSetting { manifold: base, residuals: &[], facts, parameters: &parameters };
    match setting.rank(&mut model.graph, &together).map(|rank| rank.drops) {
        Ok(Drops::Nowhere) => String::new(),
        Ok(drops @ Drops::Where(_)) => {
            places(&model.graph, &drops).map_or_else(String::new, |places| format!(" (more where {places})"))
        }
        Ok(Drops::Undecided) | Err(_) => " at generic points".into(),
    }
}

/// The same over an embedded base, where V has sections of its own, as γ for the anchor γ × ω.
fn not_onto_embedded(proved: &mut Proved, reduced: &Reduced) -> Vec<ExprId> {
    let Proved { model, facts, base, .. } = proved;
    let parameters: Vec<SymbolId> = model.parameters.iter().map(|parameter| parameter.symbol).collect();
    let Reduced { system, distribution, .. } = reduced;
    let graph = &mut model.graph;
    let whole = ConstraintDistribution::unconstrained(graph, &system.algebroid.velocities);
    let Ok(splitting) = Splitting::of(graph, system, &whole, &[], base) else { return Vec::new() };
    let Some(vertical) = NonholonomicConnection::of(graph, system, &whole, &splitting, facts) else {
        return Vec::new();
    };
    let rows = &distribution.constraints.annihilator;
    let on_vertical: Matrix = vertical.vertical.iter().map(|section| graph.image(rows, section)).collect();
    let mut found = singular_where(graph, &on_vertical, &parameters, facts);
    found.retain(|factor| !is_constant_on(graph, base, *factor));
    found
}

/// Whether a function has one value on the base, as |γ|² on the sphere.
fn is_constant_on(graph: &mut Graph, base: &Manifold, function: ExprId) -> bool {
    let restricted = base.restrict(graph, function);
    graph.symbols_in(&[restricted]).into_iter().all(|symbol| {
        let slope = graph.partial(restricted, symbol);
        graph.zero_test(slope).is_zero()
    })
}

fn name(
    proved: &Proved,
    splitting: &Splitting,
    is_free: bool,
    in_frame: bool,
    singular: &[ExprId],
    more: &str,
) -> String {
    let coordinates: Vec<&str> =
        splitting.coordinates.iter().map(|id| proved.model.coordinates[*id].name.as_str()).collect();
    let coordinates = coordinates.join(", ");
    let Splitting { vertical, horizontal, .. } = splitting;
    let (shared, m) = (splitting.shared(), splitting.dimension);
    let v = if splitting.by_group { "V along the group" } else { "V = ker ρ" };
    let name = if is_free {
        format!("Lagrange–Poincaré, with momentum equations of rank {vertical}")
    } else if splitting.is_chaplygin() {
        let shown = |factor: &ExprId| format!("{} != 0", shown(&proved.model.graph, *factor));
        let conditions = singular.iter().map(shown).collect::<Vec<_>>().join(" and ");
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
    let group = match (splitting.by_group, in_frame) {
        (false, _) if declared => "; the declared symmetries are left aside",
        (false, _) => "",
        (true, false) => "; the group: translations along the cyclic coordinates",
        (true, true) => {
            "; the group: the declared symmetries of L and D, with the cyclic coordinates that they move"
        }
    };
    format!("equations: {name}{group}")
}

/// CM Propositions 8 and 9.
fn quantities(proved: &mut Proved, reduced: &Reduced) -> Vec<String> {
    let names = &reduced.names;
    let mut lines = frame(proved, reduced);
    if let Some(found) = reduced.chaplygin(proved) {
        let model = &proved.model;
        let name = |i: usize| model.coordinates[reduced.splitting.coordinates[i]].name.as_str();
        for (i, lift) in found.lifts.iter().enumerate() {
            lines.push(format!(
                "horizontal lift of d/d{}: {}",
                name(i),
                combination(&model.graph, lift, names)
            ));
        }
        let mut pairs = found.curvature.iter();
        for i in 0..found.lifts.len() {
            for (j, curvature) in (i + 1..found.lifts.len()).zip(&mut pairs) {
                let value = combination(&model.graph, curvature, names);
                lines.push(format!("curvature K(d/d{}, d/d{}) = {value}", name(i), name(j)));
            }
        }
        lines.push(format!("reduced Lagrangian: {}", shown(&model.graph, found.lagrangian)));
        for (i, force) in found.force.iter().enumerate() {
            lines.push(format!("gyroscopic force <J, K> along {}: {}", name(i), shown(&model.graph, *force)));
        }
        return lines;
    }
    lines.extend(connection(proved, reduced));
    lines
}

/// The velocities of the invariant frame.
fn frame(proved: &mut Proved, reduced: &Reduced) -> Vec<String> {
    let Some(frame) = &reduced.frame else { return Vec::new() };
    let declared: Vec<String> = proved.model.sections.iter().map(|section| section.name.clone()).collect();
    let velocities = reduced.names.iter().zip(&frame.change.velocities);
    let changed = velocities.filter(|(name, _)| !declared.contains(name));
    changed
        .map(|(name, row)| {
            format!("invariant frame: {name} = {}", combination(&proved.model.graph, row, &declared))
        })
        .collect()
}

/// S = D ∩ V, the lifts orthogonal to it, and their brackets.
fn connection(proved: &mut Proved, reduced: &Reduced) -> Vec<String> {
    let Reduced { system, distribution, splitting, names, .. } = reduced;
    let (graph, facts) = (&mut proved.model.graph, &proved.facts);
    let Some(found) = NonholonomicConnection::of(graph, system, distribution, splitting, facts) else {
        return Vec::new();
    };
    let mut lines = Vec::new();
    let vertical: Vec<String> = found
        .named
        .iter()
        .map(|symbol| graph.free_name(&format!("S_{}", graph.symbols()[*symbol])))
        .collect();
    let lifts: Vec<String> = found
        .coordinates
        .iter()
        .map(|id| graph.free_name(&format!("h_{}", proved.model.coordinates[*id].name)))
        .collect();
    for (name, section) in vertical.iter().zip(&found.vertical) {
        lines.push(format!("momentum section {name} = {}", combination(graph, section, names)));
    }
    for (name, section) in lifts.iter().zip(&found.lifts) {
        lines.push(format!("horizontal lift {name} = {}", combination(graph, section, names)));
    }
    let inertia = found.inertia.as_ref().into_iter().flatten().enumerate();
    for (rho, row) in inertia {
        for (sigma, entry) in row.iter().enumerate().skip(rho) {
            if !graph.is_literal_zero(*entry) {
                let (first, second) = (&vertical[rho], &vertical[sigma]);
                lines.push(format!("locked inertia <{first}, {second}> = {}", shown(graph, *entry)));
            }
        }
    }
    let algebroid = &system.algebroid;
    let mut brackets: Vec<(&str, &str, &str, Vec<ExprId>)> = Vec::new();
    for kappa in 0..lifts.len() {
        for lambda in kappa + 1..lifts.len() {
            let value = found.curvature(graph, algebroid, kappa, lambda);
            brackets.push(("curvature", &lifts[kappa], &lifts[lambda], value));
        }
        for (rho, section) in vertical.iter().enumerate() {
            let value = found.coefficients(graph, algebroid, kappa, rho);
            brackets.push(("connection", &lifts[kappa], section, value));
        }
    }
    for rho in 0..vertical.len() {
        for sigma in rho + 1..vertical.len() {
            let value = found.bracket(graph, algebroid, rho, sigma);
            brackets.push(("bracket in S", &vertical[rho], &vertical[sigma], value));
        }
    }
    for (what, first, second, value) in brackets {
        if value.iter().any(|component| !graph.is_literal_zero(*component)) {
            lines.push(format!("{what} [{first}, {second}] = {}", combination(graph, &value, names)));
        }
    }
    lines
}
