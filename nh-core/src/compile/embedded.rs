//! The way back to an embedded base.

use crate::algebra::Matrix;
use crate::check::evidence::shown;
use crate::geometry::Manifold;
use crate::id::ExprId;
use crate::mechanics::{Definiteness, Procedure, solve_symmetric};
use crate::model::Model;
use crate::system::Embedding;

/// The identities of the base, and a Newton step `x − Fᵀ (F Fᵀ)⁻¹ f` with F = ∂f/∂x to the nearest
/// point where they hold; `None` without identities.
pub(super) fn embedding(model: &mut Model, base: &Manifold) -> Option<Embedding> {
    if model.identities.is_empty() {
        return None;
    }
    let graph = &mut model.graph;
    let coordinates: Vec<_> = model.coordinates.iter().map(|coordinate| coordinate.symbol).collect();
    let functions: Vec<ExprId> = model.identities.iter().map(|identity| identity.value).collect();
    let texts = functions.iter().map(|function| format!("{} = 0", shown(graph, *function))).collect();
    let gradients: Matrix = functions
        .iter()
        .map(|function| coordinates.iter().map(|symbol| graph.partial(*function, *symbol)).collect())
        .collect();
    // identities that follow from others take no part
    let independent = base.independent_rows(graph, &gradients).unwrap_or_default();
    let rows: Matrix = independent.iter().map(|row| gradients[*row].clone()).collect();
    let residuals: Vec<ExprId> = independent.iter().map(|row| functions[*row]).collect();
    // F Fᵀ μ = f
    let mut gram: Matrix = Vec::with_capacity(rows.len());
    for (i, row) in rows.iter().enumerate() {
        let entries: Vec<ExprId> = rows
            .iter()
            .enumerate()
            .map(|(j, other)| if j < i { gram[j][i] } else { graph.inner_product(row, other) })
            .collect();
        gram.push(entries);
    }
    let mut step = Procedure::default();
    let weights = solve_symmetric(graph, &gram, &residuals, Definiteness::Definite, &mut step, "mu");
    step.outputs = coordinates
        .iter()
        .enumerate()
        .map(|(index, symbol)| {
            let column: Vec<ExprId> = rows.iter().map(|row| row[index]).collect();
            let correction = graph.inner_product(&column, &weights);
            let coordinate = graph.symbol(*symbol);
            graph.formula(coordinate - correction)
        })
        .collect();
    Some(Embedding { texts, residual: Procedure::of(functions), step })
}
