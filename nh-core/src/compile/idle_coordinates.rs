//! Lagrangians without coordinates that they hold and do not depend on.
//!
//! Where all positions turn with an angle, as those of a machine on a turning base do, kinetic energies hold its sine and
//! cosine in every term, and their squares add up to one when all is multiplied out. A number in place of the angle leaves the
//! same function without them, and nothing has to be multiplied out to find that.

use crate::id::{ExprId, SymbolId};
use crate::model::Model;

/// The Lagrangian, and the energies of bodies in it, where coordinates of which each is proved to be independent vanish.
pub(super) fn without_idle_coordinates(model: &mut Model, lagrangian: ExprId, energies: &mut [ExprId]) -> ExprId {
    let coordinates: Vec<SymbolId> = model.coordinates.iter().map(|coordinate| coordinate.symbol).collect();
    let graph = &mut model.graph;
    let freed: Vec<Option<ExprId>> =
        energies.iter().map(|energy| graph.freed_of(*energy, &coordinates)).collect();
    if freed.iter().all(Option::is_none) {
        return graph.freed_of(lagrangian, &coordinates).unwrap_or(lagrangian);
    }
    let kinetic = graph.sum(energies);
    let rest = graph.formula(lagrangian - kinetic);
    // energies that are factors, or that are subtracted, are no terms of it
    if graph.operation_count(&[rest]) >= graph.operation_count(&[lagrangian]) {
        return graph.freed_of(lagrangian, &coordinates).unwrap_or(lagrangian);
    }
    let rest = graph.freed_of(rest, &coordinates).unwrap_or(rest);
    for (energy, freed) in energies.iter_mut().zip(freed) {
        *energy = freed.unwrap_or(*energy);
    }
    let kinetic = graph.sum(energies);
    graph.formula(rest + kinetic)
}
