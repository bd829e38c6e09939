//! Lagrangians without coordinates that they hold and do not depend on.
//!
//! Where all positions turn with an angle, as those of a machine on a turning base do, kinetic energies hold its sine and
//! cosine in every term, and their squares add up to one when all is multiplied out. A number in place of the angle leaves the
//! same function without them, and nothing has to be multiplied out to find that.

use crate::id::{ExprId, SymbolId};
use crate::model::Model;

/// Operations of a Lagrangian, for each coordinate, beyond which none is tried.
const TRIED: u64 = 10_000;

/// The Lagrangian, and the energies of bodies in it, where coordinates vanish of which it is proved to be independent.
///
/// What only the kinetic energy is independent of stays, as the first angle of an arm that has weight: chains are found by
/// what carries what, and their first link would be missing.
pub(super) fn without_idle_coordinates(
    model: &mut Model,
    lagrangian: ExprId,
    energies: &mut [ExprId],
) -> ExprId {
    let coordinates: Vec<SymbolId> = model.coordinates.iter().map(|coordinate| coordinate.symbol).collect();
    let graph = &mut model.graph;
    let tried = graph.operation_count(&[lagrangian]) * coordinates.len() as u64;
    if tried > TRIED {
        return lagrangian;
    }
    let Some((freed, idle)) = graph.freed_of(lagrangian, &coordinates) else { return lagrangian };
    let mut images: Vec<ExprId> = Vec::with_capacity(energies.len());
    for energy in energies.iter() {
        match graph.freed_of(*energy, &idle) {
            Some((freed, _)) if !graph.depends_on(freed, &idle) => images.push(freed),
            None if !graph.depends_on(*energy, &idle) => images.push(*energy),
            // it belongs with something else
            _ => return lagrangian,
        }
    }
    energies.copy_from_slice(&images);
    freed
}
