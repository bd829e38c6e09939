//! The kinetic metric on sections.

use super::euler_lagrange::LagrangianSystem;
use crate::algebra::{Graph, Matrix};

/// σ_a^α W_{αβ} σ_b^β with W = ∂²L/∂y∂y: for a basis of D the matrix C of mathematics (8). It depends on
/// the velocities where L is not quadratic in them.
pub fn kinetic_metric(graph: &mut Graph, system: &LagrangianSystem, sections: &Matrix) -> Matrix {
    let momenta = system.momenta(graph);
    let velocities = &system.algebroid.velocities;
    let mass: Matrix = momenta
        .iter()
        .map(|p| velocities.iter().map(|symbol| graph.partial(*p, *symbol)).collect())
        .collect();
    sections
        .iter()
        .map(|a| {
            let inertia = graph.image(&mass, a);
            sections
                .iter()
                .map(|b| {
                    let entry = graph.inner_product(&inertia, b);
                    graph.simplify(entry)
                })
                .collect()
        })
        .collect()
}
