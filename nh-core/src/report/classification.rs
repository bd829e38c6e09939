//! What kind of system it is.

use super::{combination, shown};
use crate::algebra::Graph;
use crate::check::evidence::{counted, places};
use crate::check::{
    BrokenLaws, Condition, Constraints, Positions, domain, not_conservative, singular_where, undecided,
};
use crate::compile::{Derived, Proved};
use crate::geometry::{Drops, Rank};
use crate::id::SymbolId;
use crate::mechanics::{LagrangianSystem, moving_energy_section};
use crate::model::{Kinematics, Model};

/// The classification, a line for each property.
pub(super) fn lines(proved: &mut Proved, derived: &Derived<'_>, reason: &str) -> Vec<String> {
    let kind = algebroid(proved);
    let almost = structure_equations(proved);
    let integrable = proved.broken_laws.homomorphism.is_none();
    let Proved { model, motion, system, positions: on_positions, constraints: declared, .. } = proved;
    let (rank, facts) = (&proved.constraint_rank, &proved.facts);
    let mut lines = vec![kind];
    lines.extend(almost);
    lines.extend(positions(model, on_positions));
    lines.push(constraints(model, system, declared, rank.as_ref(), derived, integrable));
    let (name, size) = match derived {
        Derived::Adapted { kept, .. } => ("adapted", kept.rank()),
        Derived::Projected { .. } => ("projected", model.sections.len()),
    };
    let coordinates = model.coordinates.len();
    let (coordinates, velocities) =
        (counted(coordinates, "coordinate", "coordinates"), counted(size, "velocity", "velocities"));
    let auxiliary = match model.auxiliary.len() {
        0 => String::new(),
        count => format!(", with {}", counted(count, "auxiliary state", "auxiliary states")),
    };
    lines.push(format!("formulation: {name}, {coordinates} and {velocities}{auxiliary}; {reason}"));
    if let Derived::Adapted { equations, .. } = derived {
        let parameters: Vec<SymbolId> = model.parameters.iter().map(|parameter| parameter.symbol).collect();
        for factor in singular_where(&mut model.graph, &equations.mass, &parameters, facts) {
            let of_parameters = model.graph.depends_on(factor, &parameters);
            let whom =
                if of_parameters { "for some parameters the mass matrix is" } else { "the mass matrix is" };
            let text = shown(&model.graph, factor);
            let place = if text.contains('…') { "its determinant" } else { text.as_str() };
            lines.push(format!("{whom} singular where {place} = 0"));
        }
    }
    if undecided(model, facts) {
        let doubt = "whether the assumptions can hold together was not decided: no parameters were found that satisfy \
                     all of them, and no contradiction";
        lines.push(doubt.into());
    }
    for condition in domain(model, facts) {
        lines.push(format!("the equations have a value only where {}", stated(&model.graph, condition)));
    }
    for divisor in &motion.divisors {
        if model.graph.value_of(*divisor).is_none() {
            let text = shown(&model.graph, *divisor);
            lines.push(format!("the quasi-velocities are a chart only where {text} != 0"));
        }
    }
    lines
}

fn stated(graph: &Graph, condition: Condition) -> String {
    match condition {
        Condition::Nonzero(e) => format!("{} != 0", shown(graph, e)),
        Condition::Positive(e) => format!("{} > 0", shown(graph, e)),
        Condition::NotNegative(e) => format!("{} >= 0", shown(graph, e)),
        Condition::InUnitInterval(e) => format!("|{}| <= 1", shown(graph, e)),
        Condition::InsideUnitInterval(e) => format!("|{}| < 1", shown(graph, e)),
    }
}

/// The kind of algebroid.
fn algebroid(proved: &Proved) -> String {
    let Proved { model, kind, .. } = proved;
    let (n, s, dimension) = (model.coordinates.len(), model.sections.len(), kind.dimension);
    let embedded = if dimension == n { String::new() } else { format!(", embedded in {n} coordinates") };
    let name = if proved.broken_laws.is_none() {
        name_of_kind(proved)
    } else if n == 0 {
        "an almost Lie algebra".into()
    } else {
        "an almost Lie algebroid".into()
    };
    format!("algebroid: {name}, rank {s} over a base of dimension {dimension}{embedded}")
}

/// Which of the structure equations hold where none is demanded.
fn structure_equations(proved: &Proved) -> Vec<String> {
    if !proved.model.almost {
        return Vec::new();
    }
    let BrokenLaws { homomorphism, jacobi } = &proved.broken_laws;
    let first = match homomorphism {
        None => "the anchor is a homomorphism of brackets, (2)".to_owned(),
        Some(evidence) => format!("(2) does not hold: {evidence}"),
    };
    let second = match (homomorphism, jacobi) {
        (None, None) => "the Jacobi identity, (3), holds: it is a Lie algebroid all the same".to_owned(),
        (Some(_), None) => {
            "the Jacobi identity, (3), holds for the sections of the basis, not for all, since (2) does not"
                .to_owned()
        }
        (_, Some(evidence)) => format!("(3) does not hold: {evidence}"),
    };
    [first, second].into_iter().map(|line| format!("declared almost: {line}")).collect()
}

/// By the rank of the anchor, with the places where it drops.
fn name_of_kind(proved: &Proved) -> String {
    let Proved { model, kind, .. } = proved;
    let (s, dimension) = (model.sections.len(), kind.dimension);
    if model.coordinates.is_empty() {
        return "a Lie algebra".into();
    }
    let action = if kind.is_action { "action Lie algebroid" } else { "Lie algebroid" };
    let article = if kind.is_action { "an" } else { "a" };
    let Some(anchor) = &kind.anchor else { return format!("{article} {action}") };
    let rank = anchor.generic;
    let nonzero = match &anchor.drops {
        Drops::Nowhere => String::new(),
        Drops::Undecided => " at generic points (whether everywhere was not decided)".into(),
        Drops::Where(_) => places(&model.graph, &anchor.drops)
            .map_or_else(String::new, |places| format!(", but not where {places}")),
    };
    if rank == dimension && rank == s {
        let frame = match (&model.kinematics, kind.commutes) {
            (Kinematics::Tangent, true) if model.frame.is_empty() => "in its coordinate frame",
            (_, true) => "in a holonomic frame: all brackets vanish",
            (_, false) => "in an anholonomic frame",
        };
        let coframe =
            if matches!(model.kinematics, Kinematics::Coframe(_)) { ", by its coframe" } else { "" };
        let singular = match places(&model.graph, &anchor.drops) {
            None if nonzero.is_empty() => return format!("the tangent bundle TM {frame}{coframe}"),
            None => return format!("the tangent bundle TM {frame}{coframe}{nonzero}"),
            Some(places) => places,
        };
        return if model.brackets_declared {
            format!("{article} {action} with an anchor that is one to one and onto, but not where {singular}")
        } else {
            format!("the tangent bundle TM {frame}{coframe}, which is singular where {singular}")
        };
    }
    if rank == 0 {
        return "a bundle of Lie algebras: the anchor is 0".into();
    }
    if rank == dimension {
        let isotropy = s - rank;
        return format!("a transitive {action} with isotropy of rank {isotropy}{nonzero}");
    }
    if rank == s {
        return format!("{article} {action} with an injective anchor{nonzero}: orbits of dimension {rank}");
    }
    format!("{article} {action} with orbits of dimension {rank}{nonzero}")
}

/// The position constraints: how many, what was left out, and what was not solved.
fn positions(model: &Model, positions: &Positions) -> Vec<String> {
    if model.positions.is_empty() {
        return Vec::new();
    }
    let count = model.positions.len();
    let mut lines = vec![format!("position constraints: {count}, whose rates are among the constraints")];
    lines.extend(positions.dropped.iter().cloned());
    for position in &positions.redundant {
        let name = position.label.as_ref().map_or("an equation without a label".into(), |l| format!("`{l}`"));
        lines.push(format!("{name} follows from the other position constraints: it has no multiplier"));
    }
    for value in &positions.unsolved {
        lines.push(format!(
            "no points were found where {} = 0: what is said to hold there was asked without it",
            shown(&model.graph, *value)
        ));
    }
    lines
}

fn constraints(
    model: &mut Model,
    system: &LagrangianSystem,
    declared: &Constraints,
    rank: Option<&Rank>,
    derived: &Derived<'_>,
    integrable: bool,
) -> String {
    let (count, spanned) = (model.constraints.len(), model.distribution.as_ref().map(Vec::len));
    let dependent = dependent(model, rank);
    let kind = match &declared.linear {
        None => "nonlinear",
        Some(linear) if linear.drift.iter().all(|drift| model.graph.zero_test(*drift).is_zero()) => "linear",
        Some(_) => "affine",
    };
    let what = match (count, spanned) {
        (_, Some(sections)) => format!("constraints: D is the span of {sections} sections{dependent}"),
        (0, None) => return "constraints: none".into(),
        (_, None) => format!("constraints: {count}, {kind} in the velocities{dependent}"),
    };
    let generic;
    let distribution = match derived {
        Derived::Adapted { distribution, .. } => *distribution,
        Derived::Projected { .. } => {
            match declared.generic_distribution(&mut model.graph, &system.algebroid.velocities) {
                None => return what,
                Some(found) => {
                    generic = found;
                    &generic
                }
            }
        }
    };
    let holonomic = match distribution.is_holonomic(
        &mut model.graph,
        &system.algebroid,
        &system.clock,
        declared.base(),
    ) {
        Some(true) => {
            let constant = constant_coordinates(model, derived);
            // the fields of closed sections are in involution where (2) holds
            let holonomic = if integrable { " (holonomic)" } else { "" };
            format!("; D is closed under the bracket{holonomic}{constant}")
        }
        Some(false) if integrable => "; D is not closed under the bracket (nonholonomic)".to_owned(),
        Some(false) => "; D is not closed under the bracket".to_owned(),
        None => String::new(),
    };
    format!("{what}{holonomic}")
}

/// Where the constraints are dependent.
fn dependent(model: &Model, rank: Option<&Rank>) -> String {
    match rank.map(|rank| &rank.drops) {
        Some(Drops::Nowhere) => String::new(),
        Some(drops @ Drops::Where(_)) => places(&model.graph, drops)
            .map_or_else(String::new, |places| format!("; they are dependent where {places}")),
        Some(Drops::Undecided) | None => {
            "; they are independent at generic points, where else was not decided".into()
        }
    }
}

/// The integrals of a holonomic D that are coordinates.
fn constant_coordinates(model: &Model, derived: &Derived<'_>) -> String {
    let Derived::Adapted { equations, .. } = derived else { return String::new() };
    let constant: Vec<&str> = model
        .coordinates
        .iter()
        .zip(&equations.rates)
        .filter(|(_, rate)| model.graph.zero_test(**rate).is_zero())
        .map(|(coordinate, _)| coordinate.name.as_str())
        .collect();
    if constant.is_empty() { String::new() } else { format!("; constant: {}", constant.join(", ")) }
}

/// What is conserved by the theorems that need no search.
pub(super) fn conserved(proved: &mut Proved) -> Vec<String> {
    let mut lines: Vec<String> =
        proved.model.claims.iter().map(|claim| format!("{} (claimed, and proved)", claim.name)).collect();
    let Proved { model, system, constraints, .. } = &mut *proved;
    if not_conservative(model, system, constraints).is_none() {
        let reason =
            "CLMM Theorems 3.4 and 7.6: L does not depend on time, no power of constraints and forces";
        lines.push(format!("the energy ({reason})"));
    } else {
        lines.extend(moving_energy(proved));
    }
    lines
}

/// E_L − ξ^α p_α, where a section ξ for it is found (mathematics section 4).
fn moving_energy(proved: &mut Proved) -> Option<String> {
    let Proved { model, system, constraints, .. } = proved;
    let linear = constraints.linear.as_ref()?;
    let graph = &mut model.graph;
    let autonomous = !system.clock.occurs_in(graph, &constraints.residuals)
        && !system.clock.moves(graph, system.lagrangian);
    let free = system.is_free(graph);
    if !autonomous || !free {
        return None;
    }
    let parameters: Vec<SymbolId> = model.parameters.iter().map(|parameter| parameter.symbol).collect();
    let manifold = constraints.manifold(graph, &system.algebroid.velocities);
    let section = moving_energy_section(graph, system, linear, &parameters, &manifold)?;
    let names: Vec<String> = model.sections.iter().map(|section| section.name.clone()).collect();
    let section = combination(&model.graph, &section, &names);
    let [energy, along, momentum] = ["E", "xi", "p"].map(|name| model.graph.free_name(name));
    Some(format!(
        "the moving energy {energy} - {along}.{momentum} with {along} = {section} (Fassò, Sansonetto)"
    ))
}
