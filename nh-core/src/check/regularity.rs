//! Regularity: the equations determine the accelerations (CLMM Theorem 3.12, (7.5)).

use super::evidence::listed;
use crate::algebra::{Echelon, Facts, FieldPoint, Graph, Matrix, Node, Residue};
use crate::geometry::Manifold;
use crate::id::{ExprId, SymbolId};
use crate::mechanics::{ReducedEquations, SaddleEquations, uncoupled};
use crate::model::Model;
use crate::violation::{Law, Violation};

/// C_{ab} is non-singular at generic points of the constraint manifold.
pub fn reduced_regularity(
    model: &mut Model,
    equations: &ReducedEquations,
    base: &Manifold,
) -> Option<Violation> {
    let mass = base.restrict_matrix(&mut model.graph, &equations.mass);
    let names: Vec<&str> =
        equations.independent.iter().map(|symbol| model.graph.symbols()[*symbol].as_str()).collect();
    let size = names.len();
    let what = "the mass matrix is singular on the constraint distribution: its rank is";
    judge(model, &mass, size, what, |vector| {
        let moving: Vec<&str> =
            vector.iter().zip(&names).filter(|(c, _)| **c != Residue::ZERO).map(|(_, name)| *name).collect();
        direction(&moving)
    })
}

/// The saddle matrix is non-singular at generic points of the constraint manifold.
pub fn saddle_regularity(
    model: &mut Model,
    equations: &SaddleEquations,
    manifold: &Manifold,
) -> Option<Violation> {
    let matrix = equations.matrix(&mut model.graph);
    let matrix = manifold.restrict_matrix(&mut model.graph, &matrix);
    let names: Vec<&str> = model.sections.iter().map(|section| section.name.as_str()).collect();
    let what = "the equations for accelerations and multipliers are singular: the rank of their matrix is";
    judge(model, &matrix, matrix.len(), what, |vector| {
        let moving: Vec<&str> =
            vector.iter().zip(&names).filter(|(c, _)| **c != Residue::ZERO).map(|(_, name)| *name).collect();
        direction(&moving)
    })
}

fn direction(moving: &[&str]) -> String {
    match moving {
        [only] => format!("the Lagrangian gives the velocity `{only}` no inertia there"),
        [] => "the constraint forces are not determined".into(),
        several => {
            format!(
                "the Lagrangian gives a combination of the velocities {} no inertia there",
                listed(several)
            )
        }
    }
}

fn judge(
    model: &Model,
    matrix: &Matrix,
    size: usize,
    what: &str,
    evidence: impl Fn(&[Residue]) -> String,
) -> Option<Violation> {
    let graph: &Graph = &model.graph;
    let origin = model.lagrangian.origin;
    let rows = match graph.matrix_in_field(matrix, |seed| FieldPoint::random(9_000 + seed)) {
        Ok(rows) => rows,
        Err(why) => {
            return Some(Violation {
                law: Law::Decidable,
                origin,
                what: "whether the mass matrix is regular could not be decided".into(),
                evidence: why,
                way_out: "write the Lagrangian without roots of negative numbers and divisions by zero"
                    .into(),
            });
        }
    };
    let echelon = Echelon::of(rows);
    if echelon.rank() == size || graph.generic_rank(matrix) == Ok(size) {
        return None;
    }
    let evidence = echelon.kernel_vector(size).map_or_else(String::new, |vector| evidence(&vector));
    Some(Violation {
        law: Law::Regularity,
        origin,
        what: format!("{what} {} of {size}", echelon.rank()),
        evidence,
        way_out: "give that motion a kinetic energy in the Lagrangian, or constrain it".into(),
    })
}

/// Where the mass matrix of a regular system is singular all the same, as far as short
/// determinants tell: their factors of coordinates alone that may vanish.
pub fn singular_where(
    graph: &mut Graph,
    mass: &Matrix,
    parameters: &[SymbolId],
    facts: &Facts,
) -> Vec<ExprId> {
    const SIZE: usize = 3;
    const SHORT: u64 = 300;
    let mut found: Vec<ExprId> = Vec::new();
    for block in uncoupled(graph, mass).into_iter().filter(|block| block.len() <= SIZE) {
        let inner = Graph::submatrix(mass, &block);
        if graph.operation_count(&inner.concat()) > SHORT {
            continue;
        }
        let determinant = graph.small_determinant(&inner);
        let factors = match graph.node(determinant).clone() {
            Node::Product { factors, .. } => factors.to_vec(),
            _ => vec![(determinant, 1.into())],
        };
        for (base, exponent) in factors {
            let symbols = graph.symbols_in(&[base]);
            let of_coordinates = !symbols.is_empty() && !symbols.iter().any(|s| parameters.contains(s));
            let harmless = exponent.is_negative() || graph.vanishes_nowhere(base, facts);
            if of_coordinates && !harmless && !found.contains(&base) {
                found.push(base);
            }
        }
    }
    found
}
