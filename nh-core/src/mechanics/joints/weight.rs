//! The Lagrangian without the kinetic energies of bodies, and without their weight.

use super::sheet::Vector;
use crate::algebra::{Graph, Node, Substitution};
use crate::id::{ExprId, SymbolId};
use crate::mechanics::{Body, LagrangianSystem};

/// L = Σ (T_b + m_b γ·p_b) + rest.
pub(super) struct Fall {
    /// γ, the acceleration of free fall.
    pub(super) acceleration: Vector,
    pub(super) rest: ExprId,
}

impl Fall {
    /// `None` where the kinetic energies of the bodies are no terms of L.
    pub(super) fn of(graph: &mut Graph, system: &LagrangianSystem, bodies: &[Body]) -> Option<Self> {
        let energies: Vec<ExprId> = bodies.iter().map(|body| body.energy).collect();
        let kinetic = graph.sum(&energies);
        let mut rest = graph.formula(system.lagrangian - kinetic);
        if graph.operation_count(&[rest]) * 2 > graph.operation_count(&[system.lagrangian]) {
            return None;
        }
        let mut acceleration = [graph.zero(); 3];
        for (k, fall) in acceleration.iter_mut().enumerate() {
            if let Some((found, left)) = without_weight(graph, system, bodies, (k, rest)) {
                *fall = found;
                rest = graph.simplify(left);
            }
        }
        Some(Self { acceleration, rest })
    }
}

/// γ along one axis, and what is left; `None` where no body has a weight along it.
fn without_weight(
    graph: &mut Graph,
    system: &LagrangianSystem,
    bodies: &[Body],
    (axis, lagrangian): (usize, ExprId),
) -> Option<(ExprId, ExprId)> {
    let coordinates = &system.algebroid.anchor.coordinates;
    // heights as symbols, where they are sums
    let mut named = Substitution::new([]);
    let mut heights: Vec<(SymbolId, ExprId)> = Vec::new();
    for body in bodies {
        let height = *body.position.get(axis)?;
        let is_sum = matches!(graph.node(height), Node::Sum { .. }) && graph.depends_on(height, coordinates);
        if is_sum && heights.iter().all(|(_, known)| *known != height) {
            let symbol = graph.new_symbol("height");
            named.insert_node(height, graph.symbol(symbol));
            heights.push((symbol, height));
        }
    }
    let written = named.apply(graph, lagrangian);
    let mut moving: Vec<SymbolId> = heights.iter().map(|(symbol, _)| *symbol).collect();
    moving.extend(coordinates.iter().chain(&system.algebroid.velocities));
    moving.extend(system.clock.symbols());
    let mut found: Option<ExprId> = None;
    let mut images = Substitution::new([]);
    let mut fallen: Vec<ExprId> = Vec::new();
    for (symbol, height) in heights {
        let masses: Vec<ExprId> =
            bodies.iter().filter(|body| body.position[axis] == height).map(|body| body.mass).collect();
        let mass = graph.sum(&masses);
        let slope = graph.partial(written, symbol);
        let slope = graph.formula(slope / mass);
        let falls = !graph.is_literal_zero(slope)
            && !graph.depends_on(slope, &moving)
            && found.is_none_or(|known| known == slope);
        if falls {
            found = Some(slope);
            fallen.push(height);
        }
        images.insert(symbol, if falls { graph.zero() } else { height });
    }
    let slope = found?;
    // what does not fall so is given back the weight that it has not
    let mut left = images.apply(graph, written);
    for body in bodies.iter().filter(|body| !fallen.contains(&body.position[axis])) {
        left = graph.formula(left - body.mass * slope * body.position[axis]);
    }
    Some((slope, left))
}
