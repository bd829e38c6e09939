//! Connections of a metric on an algebroid: Levi-Civita's, and the constrained one
//! (CLMM Example 3.6; M 2.1).

use super::algebroid::Algebroid;
use crate::algebra::{Derivation, Graph, Matrix, Rational};

/// Christoffel symbols Γ^c_{ab} of ∇_{e_a} e_b = Γ^c_{ab} e_c, by the first index a, then b, then c.
pub type Christoffel = Vec<Matrix>;

/// The covariant components G(∇_{σ_a}σ_b, σ_c) of the Levi-Civita connection for sections σ, by mathematics (21), Koszul's
/// formula
///
/// `2G(∇_XY, Z) = ρ(X)G(Y, Z) + ρ(Y)G(X, Z) − ρ(Z)G(X, Y) − G(X, [Y, Z]) − G(Y, [X, Z]) + G(Z, [X, Y])`.
///
/// For a basis of D these are also those of the constrained connection ∇̌ = P∇ on D.
pub fn koszul(graph: &mut Graph, algebroid: &Algebroid, metric: &Matrix, sections: &Matrix) -> Christoffel {
    let r = sections.len();
    // G(σ_a, ·), the gram matrix, and the brackets with their inner products
    let lowered: Matrix = sections.iter().map(|s| graph.image(metric, s)).collect();
    let gram: Matrix = sections.iter().map(|s| graph.image(&lowered, s)).collect();
    let mut along: Vec<Derivation> = Vec::with_capacity(r);
    for section in sections {
        let field = algebroid.anchor.vector_field(graph, section);
        along.push(Derivation::new(algebroid.anchor.coordinates.iter().copied().zip(field)));
    }
    // products[a][b][c] = G([σ_a, σ_b], σ_c)
    let mut products: Vec<Matrix> = Vec::with_capacity(r);
    for first in sections {
        let mut rows = Matrix::with_capacity(r);
        for second in sections {
            let bracket = algebroid.bracket(graph, first, second);
            rows.push(graph.image(&lowered, &bracket));
        }
        products.push(rows);
    }
    let half = || Rational::new(1, 2);
    let mut symbols = Christoffel::with_capacity(r);
    for a in 0..r {
        let mut rows = Matrix::with_capacity(r);
        for b in 0..r {
            let mut entries = Vec::with_capacity(r);
            for c in 0..r {
                let terms = [
                    (half(), along[a].apply(graph, gram[b][c])),
                    (half(), along[b].apply(graph, gram[a][c])),
                    (-half(), along[c].apply(graph, gram[a][b])),
                    (-half(), products[b][c][a]),
                    (-half(), products[a][c][b]),
                    (half(), products[a][b][c]),
                ];
                let sum = graph.linear_combination(&terms);
                entries.push(graph.simplify(sum));
            }
            rows.push(entries);
        }
        symbols.push(rows);
    }
    symbols
}
