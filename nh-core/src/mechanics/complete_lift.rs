//! The complete lift of a section: the infinitesimal symmetry that it generates on E.

use crate::algebra::{Derivation, Graph};
use crate::geometry::{Algebroid, Clock};
use crate::id::ExprId;

/// `σ^C = σ^α ρ^i_α ∂_i + (ρ^i_β ∂_iσ^γ − σ^α C^γ_{αβ}) y^β ∂/∂y^γ`, mathematics (11), M (2.3),
/// as a derivation of functions on E. A section that depends on the time has `∂_tσ^γ ∂/∂y^γ` besides:
/// it is the variation of velocities along the flow of σ.
pub fn complete_lift(
    graph: &mut Graph,
    algebroid: &Algebroid,
    section: &[ExprId],
    clock: &Clock,
) -> Derivation {
    let field = algebroid.anchor.vector_field(graph, section);
    let velocity = algebroid.velocity(graph);
    // the vertical part is minus the bracket of σ with the section y of constant components
    let mut along = algebroid.along(graph, &velocity, clock);
    let bracket = algebroid.structure.contract(graph, section, &velocity);
    let vertical: Vec<ExprId> = section
        .iter()
        .zip(bracket)
        .map(|(component, bracket)| {
            let change = along.apply(graph, *component);
            graph.formula(change - bracket)
        })
        .collect();
    let base = algebroid.anchor.coordinates.iter().copied().zip(field);
    let fibre = algebroid.velocities.iter().copied().zip(vertical);
    Derivation::new(base.chain(fibre))
}
