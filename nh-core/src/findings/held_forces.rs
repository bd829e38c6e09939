//! Forces that do not act on the motion, as constraints hold what they act along.

use crate::compile::{Derived, Proved};
use crate::id::{ExprId, Id, SymbolId};
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
    let spanning: Vec<SymbolId> =
        proved.model.distribution.iter().flatten().map(|(symbol, _)| *symbol).collect();
    let mut found: Vec<String> = Vec::new();
    for force in forces {
        let (name, row) = match force.direction {
            ForceDirection::Coordinate(coordinate) => (
                proved.model.coordinates[coordinate].name.clone(),
                proved.system.algebroid.anchor.entries[coordinate.index()].clone(),
            ),
            ForceDirection::Section(symbol) => {
                let replaced = proved.motion.replaced.iter().find(|(replaced, _)| *replaced == symbol);
                let unit = |y| if y == symbol { one } else { zero };
                let row = match replaced {
                    _ if velocities.contains(&symbol) => velocities.iter().copied().map(unit).collect(),
                    Some((_, row)) => row.clone(),
                    // of the frame: one of those that span D, or another
                    None if spanning.contains(&symbol) => continue,
                    None => vec![zero; velocities.len()],
                };
                (proved.model.graph.symbols()[symbol].clone(), row)
            }
        };
        let graph = &mut proved.model.graph;
        let is_held = sections.iter().all(|section| {
            // mostly seen without a product
            let pairs = row.iter().zip(section).filter(|(a, b)| **a != zero && **b != zero);
            match pairs.map(|(a, b)| (*a, *b)).collect::<Vec<_>>().as_slice() {
                [] => true,
                [(a, b)] if *a == one || *b == one => {
                    let along = if *a == one { *b } else { *a };
                    !graph.is_nonzero(along) && proved.base.zero_test(graph, along).is_zero()
                }
                _ => {
                    let along = graph.inner_product(&row, section);
                    proved.base.zero_test(graph, along).is_zero()
                }
            }
        });
        if is_held && !found.contains(&name) {
            found.push(name);
        }
    }
    found
}
