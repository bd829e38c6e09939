//! Symmetric linear systems as straight-line arithmetic.
//!
//! The matrix is taken apart into blocks that do not touch. Blocks of size one and two are solved
//! in closed form; larger ones by an unrolled LDLᵀ factorisation where the matrix is definite, else
//! with numerical pivoting.

use super::elimination_order::elimination_order;
use super::hanging::Bared;
use super::ldl::{Ldl, Numerators};
use super::pair::Pair;
use super::procedure::{Definition, Procedure};
use super::rank_one::RankOne;
use super::solved::{Equations, Factors, Solved};
use crate::algebra::{Graph, Matrix};
use crate::id::{ExprId, SymbolId};

/// Whether elimination may go down the diagonal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Definiteness {
    /// Definite for physical parameters in every configuration, so that no leading minor vanishes.
    Definite,
    /// Known to be regular only.
    Unknown,
}

/// Sets of indices that the matrix does not couple, ascending.
#[must_use]
pub fn uncoupled(graph: &Graph, matrix: &[Vec<ExprId>]) -> Vec<Vec<usize>> {
    let n = matrix.len();
    let mut block_of: Vec<usize> = (0..n).collect();
    for (i, row) in matrix.iter().enumerate() {
        for (j, entry) in row.iter().enumerate().skip(i + 1) {
            let (low, high) = (block_of[i].min(block_of[j]), block_of[i].max(block_of[j]));
            if low != high && !graph.vanishes_by_identity(*entry) {
                for block in &mut block_of {
                    if *block == high {
                        *block = low;
                    }
                }
            }
        }
    }
    (0..n)
        .filter(|i| block_of[*i] == *i)
        .map(|first| (0..n).filter(|i| block_of[*i] == first).collect())
        .collect()
}

/// Solves `matrix · x = right`.
pub fn solve_symmetric(
    graph: &mut Graph,
    matrix: &[Vec<ExprId>],
    right: &[ExprId],
    definiteness: Definiteness,
    procedure: &mut Procedure,
    name: &str,
) -> Vec<ExprId> {
    let mut solution = right.to_vec();
    for block in uncoupled(graph, matrix) {
        let block = elimination_order(graph, matrix, &block);
        let inner = Graph::submatrix(matrix, &block);
        let outer: Vec<ExprId> = block.iter().map(|i| right[*i]).collect();
        let mut factors = None;
        let values = match (inner.len(), definiteness) {
            (1, _) => vec![graph.formula(outer[0] / inner[0][0])],
            (2, _) => {
                let names = [0, 1].map(|k| format!("{name}_{}", block[k]));
                let pair =
                    Pair { matrix: [inner[0][0], inner[0][1], inner[1][1]], right: [outer[0], outer[1]] };
                let values = pair.solve(graph, definiteness, procedure, &names).to_vec();
                factors = Some(Factors::Rows { rows: pair.inverse(graph), others: Vec::new() });
                values
            }
            (_, Definiteness::Definite) => {
                let (values, found) = solve_definite(graph, &inner, &outer, procedure, name);
                factors = Some(found);
                values
            }
            (_, Definiteness::Unknown) => solve_pivoted(graph, &inner, &outer, procedure, name),
        };
        for (index, value) in block.iter().zip(values) {
            solution[*index] = procedure.define(graph, &format!("{name}_{index}"), value);
        }
        let unknowns = block.iter().map(|index| graph.as_symbol(solution[*index]));
        if let Some((factors, unknowns)) = factors.zip(unknowns.collect()) {
            let equations = Equations::System { matrix: inner, right: outer };
            procedure.solved.push(Solved { unknowns, equations, factors });
        }
    }
    solution
}

/// By L D Lᵀ, or by a form that takes less work and loses no more digits than the level of accuracy
/// allows against it; with the factors.
fn solve_definite(
    graph: &mut Graph,
    matrix: &Matrix,
    right: &[ExprId],
    procedure: &mut Procedure,
    name: &str,
) -> (Vec<ExprId>, Factors) {
    let bared = Bared::of(graph, matrix);
    let rank_one = RankOne::of(graph, &bared.matrix);
    let mut by_factors = procedure.clone();
    let factors = Ldl::of(graph, matrix, Numerators::Kept, &mut by_factors, name);
    let values = factors.solve(graph, right, &mut by_factors, name);
    if let Some(rank_one) = rank_one {
        let mut way = procedure.clone();
        let carried = bared.carried(graph, right);
        let (rest, inverse) = rank_one.solve(graph, &carried, &mut way, name);
        let solution = bared.completed(graph, right, rest, &mut way, name);
        let ways = [(&way, &solution), (&by_factors, &values)];
        let [short, long] = ways.map(|(way, values)| {
            let values = way.with_outputs(values.clone()).values(graph);
            graph.operation_count(&values)
        });
        if short < long {
            let [short, long] = ways.map(|(way, values)| way.with_outputs(values.clone()).written_out(graph));
            if graph.is_as_accurate(&short, &long) {
                *procedure = way;
                let Bared { hanging, rest, .. } = bared;
                return (solution, Factors::DiagonalAndOne { hanging, rest, inverse });
            }
        }
    }
    *procedure = by_factors;
    let (lower, diagonal) = factors.into_factors();
    (values, Factors::Triangular { lower, diagonal })
}

fn solve_pivoted(
    graph: &mut Graph,
    matrix: &Matrix,
    right: &[ExprId],
    procedure: &mut Procedure,
    name: &str,
) -> Vec<ExprId> {
    let unknowns: Vec<SymbolId> =
        (0..matrix.len()).map(|index| graph.new_symbol(format!("{name}_solved{index}"))).collect();
    let solution = unknowns.iter().map(|symbol| graph.symbol(*symbol)).collect();
    let (matrix, right) = (matrix.clone(), right.to_vec());
    procedure.definitions.push(Definition::Solve { unknowns, matrix, right });
    solution
}
