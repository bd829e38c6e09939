//! Forces that do not act on the motion, as constraints hold what they act along.

use crate::compile::{Derived, Proved};
use crate::id::ExprId;
use crate::model::ForceDirection;

/// What declared forces act along that no section of D has a component along: Υ vanishes on D, and multipliers
/// alone depend on it.
pub(super) fn found(proved: &mut Proved, derived: &Derived<'_>) -> Vec<String> {
    let velocities = proved.system.algebroid.velocities.clone();
    let forces = proved.model.forces.clone();
    if forces.is_empty() {
        return Vec::new();
    }
    let graph = &mut proved.model.graph;
    let (zero, one) = (graph.zero(), graph.one());
    let distribution = match derived {
        Derived::Adapted { distribution, .. } => Some((*distribution).clone()),
        Derived::Projected { .. } => proved.constraints.generic_distribution(graph, &velocities),
    };
    let Some(distribution) = distribution else { return Vec::new() };
    if distribution.rank() == velocities.len() {
        return Vec::new();
    }
    let sections: Vec<Vec<ExprId>> = (0..distribution.rank()).map(|a| distribution.section(a)).collect();
    let mut found: Vec<String> = Vec::new();
    for force in forces {
        let Ok(row) = proved.along(force.direction) else { continue };
        let name = match force.direction {
            ForceDirection::Coordinate(coordinate) => &proved.model.coordinates[coordinate].name,
            ForceDirection::Section(symbol) => &proved.model.graph.symbols()[symbol],
        };
        let name = name.clone();
        let graph = &mut proved.model.graph;
        let is_held = sections.iter().all(|section| {
            // mostly one entry, without a product
            let met: Vec<_> = row.iter().zip(section).filter(|(a, b)| **a != zero && **b != zero).collect();
            let along = match met.as_slice() {
                [] => return true,
                [(a, b)] if **a == one => **b,
                [(a, b)] if **b == one => **a,
                _ => graph.inner_product(&row, section),
            };
            proved.base.zero_test(graph, along).is_zero()
        });
        if is_held && !found.contains(&name) {
            found.push(name);
        }
    }
    found
}
