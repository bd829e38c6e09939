//! What kind of system it is.

use super::{Derived, combination, shown};
use crate::algebra::Graph;
use crate::check::{Condition, Constraints, domain, not_conservative, singular_where};
use crate::compile::Proved;
use crate::geometry::Manifold;
use crate::id::{ExprId, SymbolId};
use crate::mechanics::{LagrangianSystem, moving_energy_section};
use crate::model::{Kinematics, Model};

/// The classification, a line for each property.
pub(super) fn lines(proved: &mut Proved, derived: &Derived<'_>, reason: &str) -> Vec<String> {
    let Proved { model, motion, system, constraints: declared, facts, base, .. } = proved;
    let mut lines = vec![algebroid(model, system, base), constraints(model, system, declared, derived)];
    let (name, size) = match derived {
        Derived::Adapted { kept, .. } => ("adapted", kept.rank()),
        Derived::Projected { .. } => ("projected", model.sections.len()),
    };
    let coordinates = model.coordinates.len();
    lines.push(format!("formulation: {name}, {coordinates} coordinates and {size} velocities; {reason}"));
    if let Derived::Adapted { equations, .. } = derived {
        let parameters: Vec<SymbolId> = model.parameters.iter().map(|parameter| parameter.symbol).collect();
        for factor in singular_where(&mut model.graph, &equations.mass, &parameters, facts) {
            let text = shown(&model.graph, factor);
            lines.push(format!("the mass matrix is singular where {text} = 0"));
        }
    }
    for condition in domain(model, facts) {
        lines.push(format!("the declaration has a value only where {}", stated(&model.graph, condition)));
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
    }
}

/// The kind of algebroid.
fn algebroid(model: &mut Model, system: &LagrangianSystem, base: &Manifold) -> String {
    let (n, s) = (model.coordinates.len(), model.sections.len());
    let dimension = dimension(model, base);
    let anchor = base.restrict_matrix(&mut model.graph, &system.algebroid.anchor.entries);
    let rank = model.graph.generic_rank(&anchor).unwrap_or(0);
    let constant = is_constant(model, system);
    let frame = if is_holonomic(model, system) {
        "the tangent bundle TM in a holonomic frame: all brackets vanish"
    } else {
        "the tangent bundle TM in an anholonomic frame"
    };
    let kind = match &model.kinematics {
        Kinematics::Tangent => "the tangent bundle TM in its coordinate frame".to_owned(),
        Kinematics::Coframe(_) => format!("{frame}, by its coframe"),
        Kinematics::Anchor(_) if n == 0 => "a Lie algebra".to_owned(),
        Kinematics::Anchor(_) if dimension == s && rank == s => frame.to_owned(),
        Kinematics::Anchor(_) if rank == dimension && dimension == n => {
            format!("a transitive Lie algebroid (Atiyah type) with isotropy of rank {}", s - n)
        }
        Kinematics::Anchor(_) if rank == dimension && constant => {
            format!("a transitive action Lie algebroid with isotropy of rank {}", s - dimension)
        }
        Kinematics::Anchor(_) if constant => {
            "an action Lie algebroid: constant structure functions".to_owned()
        }
        Kinematics::Anchor(_) => "a Lie algebroid".to_owned(),
    };
    let almost = if model.almost { ", almost: the Jacobi identity is not demanded" } else { "" };
    let embedded = if dimension == n { String::new() } else { format!(", embedded in {n} coordinates") };
    format!("algebroid: {kind}, rank {s} over a base of dimension {dimension}{embedded}{almost}")
}

/// The dimension of the base: the coordinates less the independent identities between them.
fn dimension(model: &mut Model, base: &Manifold) -> usize {
    let coordinates: Vec<SymbolId> = model.coordinates.iter().map(|coordinate| coordinate.symbol).collect();
    let graph = &mut model.graph;
    let identities: Vec<ExprId> = model.identities.iter().map(|identity| identity.value).collect();
    let slopes: Vec<Vec<ExprId>> = identities
        .iter()
        .map(|identity| coordinates.iter().map(|symbol| graph.partial(*identity, *symbol)).collect())
        .collect();
    let slopes = base.restrict_matrix(graph, &slopes);
    coordinates.len() - graph.generic_rank(&slopes).unwrap_or(0).min(coordinates.len())
}

fn is_holonomic(model: &Model, system: &LagrangianSystem) -> bool {
    system
        .algebroid
        .structure
        .nonzero(&model.graph)
        .all(|(.., components)| components.iter().all(|c| model.graph.zero_test(*c).is_zero()))
}

fn is_constant(model: &Model, system: &LagrangianSystem) -> bool {
    let entries: Vec<ExprId> =
        system.algebroid.structure.nonzero(&model.graph).flat_map(|(.., c)| c.to_vec()).collect();
    let coordinates: Vec<SymbolId> = model.coordinates.iter().map(|c| c.symbol).collect();
    entries.iter().all(|entry| !model.graph.depends_on(*entry, &coordinates))
}

fn constraints(
    model: &mut Model,
    system: &LagrangianSystem,
    declared: &Constraints,
    derived: &Derived<'_>,
) -> String {
    let (count, rank) = (model.constraints.len(), model.distribution.as_ref().map(Vec::len));
    let kind = match &declared.linear {
        None => "nonlinear",
        Some(linear) if linear.drift.iter().all(|drift| model.graph.zero_test(*drift).is_zero()) => "linear",
        Some(_) => "affine",
    };
    let what = match (count, rank) {
        (_, Some(rank)) => format!("constraints: D is the span of {rank} sections"),
        (0, None) => return "constraints: none".into(),
        (_, None) => format!("constraints: {count}, {kind} in the velocities"),
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
    let holonomic =
        match distribution.is_holonomic(&mut model.graph, &system.algebroid, model.time, declared.base()) {
            Some(true) => {
                let constant = constant_coordinates(model, derived);
                format!("; D is closed under the bracket (holonomic){constant}")
            }
            Some(false) => "; D is not closed under the bracket (nonholonomic)".to_owned(),
            None => String::new(),
        };
    format!("{what}{holonomic}")
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
    let autonomous = !graph.symbols_in(&constraints.residuals).contains(&system.time)
        && !graph.depends_on(system.lagrangian, &[system.time]);
    let free = system.is_free(graph);
    if !autonomous || !free {
        return None;
    }
    let parameters: Vec<SymbolId> = model.parameters.iter().map(|parameter| parameter.symbol).collect();
    let manifold = constraints.manifold(graph, &system.algebroid.velocities);
    let section = moving_energy_section(graph, system, linear, &parameters, &manifold)?;
    let names: Vec<String> = model.sections.iter().map(|section| section.name.clone()).collect();
    let section = combination(&model.graph, &section, &names);
    Some(format!("the moving energy E - xi.p with xi = {section} (Fassò, Sansonetto)"))
}
