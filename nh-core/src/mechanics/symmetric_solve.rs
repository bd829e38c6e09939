//! Symmetric linear systems as straight-line arithmetic.
//!
//! The matrix is taken apart into blocks that do not touch. Blocks of size one and two are solved
//! in closed form; larger ones by an unrolled LDLᵀ factorisation without pivoting where the matrix
//! is definite, else with numerical pivoting.

use super::procedure::{Definition, Procedure};
use crate::algebra::{Graph, Matrix, Rational};
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
            if low != high && !graph.zero_test(*entry).is_zero() {
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

pub(super) fn submatrix(matrix: &[Vec<ExprId>], block: &[usize]) -> Matrix {
    block.iter().map(|i| block.iter().map(|j| matrix[*i][*j]).collect()).collect()
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
        let inner = submatrix(matrix, &block);
        let outer: Vec<ExprId> = block.iter().map(|i| right[*i]).collect();
        let values = match (inner.len(), definiteness) {
            (1, _) => vec![graph.div(outer[0], inner[0][0])],
            (2, _) => solve_pair(graph, &inner, &outer, procedure, name),
            (_, Definiteness::Definite) => {
                Ldl::of(graph, &inner, procedure, name).solve(graph, &outer, procedure, name)
            }
            (_, Definiteness::Unknown) => solve_pivoted(graph, inner, outer, procedure, name),
        };
        for (index, value) in block.iter().zip(values) {
            solution[*index] = procedure.define(graph, &format!("{name}_{index}"), value);
        }
    }
    solution
}

/// Systems whose entries have more operations than this are not simplified as a whole.
const SIMPLIFIED_WHOLE: u64 = 240;

/// Two equations by Cramer's rule, simplified as a whole where that pays.
fn solve_pair(
    graph: &mut Graph,
    matrix: &[Vec<ExprId>],
    right: &[ExprId],
    procedure: &mut Procedure,
    name: &str,
) -> Vec<ExprId> {
    if let Some(whole) = simplified_pair(graph, matrix, right) {
        return whole;
    }
    let entries = matrix.iter().flatten().chain(right);
    let named: Vec<ExprId> = entries
        .enumerate()
        .map(|(index, entry)| procedure.define(graph, &format!("{name}_entry{index}"), *entry))
        .collect();
    cramer(graph, &named)
}

/// The solution of two equations simplified as a whole.
///
/// Terms of the determinant often cancel identically (the sleigh's m²b², say). Where the solution
/// takes no more operations than the arithmetic of Cramer's rule, it is used: it is cheaper, and nothing
/// is lost to that cancellation. A form with more rounding error is not.
pub(super) fn simplified_pair(
    graph: &mut Graph,
    matrix: &[Vec<ExprId>],
    right: &[ExprId],
) -> Option<Vec<ExprId>> {
    let entries: Vec<ExprId> = matrix.iter().flatten().chain(right).copied().collect();
    let written_out = graph.operation_count(&entries) + PAIR_OPERATIONS;
    if written_out > SIMPLIFIED_WHOLE {
        return None;
    }
    let rule = cramer(graph, &entries);
    let whole: Vec<ExprId> = rule.iter().map(|value| graph.simplify(*value)).collect();
    let growth = graph.accuracy().growth();
    let accurate = whole.iter().zip(&rule).all(|(new, old)| graph.error_growth(*new, *old) <= growth);
    (accurate && graph.operation_count(&whole) <= written_out).then_some(whole)
}

/// What the rule costs on top of the entries: six products, three differences and two quotients,
/// in the units of `operation_count`.
const PAIR_OPERATIONS: u64 = 21;

/// The solution of `a x + b y = f`, `c x + d y = g`.
fn cramer(graph: &mut Graph, entries: &[ExprId]) -> Vec<ExprId> {
    let [a, b, c, d, f, g] = *entries else { return Vec::new() };
    let determinant = difference_of_products(graph, (a, d), (b, c));
    let determinant = graph.simplify(determinant);
    let first = difference_of_products(graph, (d, f), (b, g));
    let second = difference_of_products(graph, (a, g), (c, f));
    vec![graph.div(first, determinant), graph.div(second, determinant)]
}

fn difference_of_products(graph: &mut Graph, first: (ExprId, ExprId), second: (ExprId, ExprId)) -> ExprId {
    let (x, y) = (graph.mul(first.0, first.1), graph.mul(second.0, second.1));
    graph.sub(x, y)
}

fn solve_pivoted(
    graph: &mut Graph,
    matrix: Matrix,
    right: Vec<ExprId>,
    procedure: &mut Procedure,
    name: &str,
) -> Vec<ExprId> {
    let unknowns: Vec<SymbolId> =
        (0..matrix.len()).map(|index| graph.new_symbol(format!("{name}_solved{index}"))).collect();
    let solution = unknowns.iter().map(|symbol| graph.symbol(*symbol)).collect();
    procedure.definitions.push(Definition::Solve { unknowns, matrix, right });
    solution
}

/// A definite matrix factorised block by block, for several right-hand sides.
#[derive(Clone, Debug)]
pub struct Factorisation {
    blocks: Vec<(Vec<usize>, Ldl)>,
}

impl Factorisation {
    /// Factorises.
    pub fn of(graph: &mut Graph, matrix: &[Vec<ExprId>], procedure: &mut Procedure, name: &str) -> Self {
        let blocks = uncoupled(graph, matrix)
            .into_iter()
            .map(|block| {
                let inner = submatrix(matrix, &block);
                let factors = Ldl::of(graph, &inner, procedure, name);
                (block, factors)
            })
            .collect();
        Self { blocks }
    }

    /// Solves for one right-hand side.
    pub fn solve(
        &self,
        graph: &mut Graph,
        right: &[ExprId],
        procedure: &mut Procedure,
        name: &str,
    ) -> Vec<ExprId> {
        let mut solution = right.to_vec();
        for (block, factors) in &self.blocks {
            let outer: Vec<ExprId> = block.iter().map(|i| right[*i]).collect();
            if outer.iter().all(|entry| graph.is_literal_zero(*entry)) {
                continue;
            }
            for (index, value) in block.iter().zip(factors.solve(graph, &outer, procedure, name)) {
                solution[*index] = value;
            }
        }
        solution
    }
}

/// `L D Lᵀ` with unit lower triangular L.
#[derive(Clone, Debug)]
struct Ldl {
    /// Below the diagonal: L.
    lower: Matrix,
    /// D.
    diagonal: Vec<ExprId>,
}

impl Ldl {
    fn of(graph: &mut Graph, matrix: &[Vec<ExprId>], procedure: &mut Procedure, name: &str) -> Self {
        let n = matrix.len();
        let zero = graph.zero();
        let mut lower = vec![vec![zero; n]; n];
        let mut diagonal = Vec::with_capacity(n);
        for j in 0..n {
            // d_j = a_jj − Σ_k l_jk² d_k
            let mut terms: Vec<(Rational, ExprId)> = vec![(1.into(), matrix[j][j])];
            for k in 0..j {
                let square = graph.square(lower[j][k]);
                terms.push(((-1).into(), graph.mul(square, diagonal[k])));
            }
            let pivot = graph.linear_combination(&terms);
            let pivot = procedure.define(graph, &format!("{name}_d{j}"), pivot);
            diagonal.push(pivot);
            // l_ij = (a_ij − Σ_k l_ik d_k l_jk) / d_j
            for i in j + 1..n {
                let mut terms: Vec<(Rational, ExprId)> = vec![(1.into(), matrix[i][j])];
                for k in 0..j {
                    let product = graph.mul(lower[i][k], diagonal[k]);
                    terms.push(((-1).into(), graph.mul(product, lower[j][k])));
                }
                let numerator = graph.linear_combination(&terms);
                let quotient = graph.div(numerator, pivot);
                lower[i][j] = procedure.define(graph, &format!("{name}_l{i}{j}"), quotient);
            }
        }
        Self { lower, diagonal }
    }

    fn solve(
        &self,
        graph: &mut Graph,
        right: &[ExprId],
        procedure: &mut Procedure,
        name: &str,
    ) -> Vec<ExprId> {
        let n = right.len();
        // L z = right
        let mut forward: Vec<ExprId> = Vec::with_capacity(n);
        for (i, entry) in right.iter().enumerate() {
            let known = graph.inner_product(&self.lower[i][..i], &forward);
            let value = graph.sub(*entry, known);
            forward.push(procedure.define(graph, &format!("{name}_z{i}"), value));
        }
        // Lᵀ x = D⁻¹ z
        let mut solution = forward.clone();
        for i in (0..n).rev() {
            let column: Vec<ExprId> = (i + 1..n).map(|k| self.lower[k][i]).collect();
            let known = graph.inner_product(&column, &solution[i + 1..]);
            let scaled = graph.div(forward[i], self.diagonal[i]);
            let value = graph.sub(scaled, known);
            solution[i] = procedure.define(graph, &format!("{name}_x{i}"), value);
        }
        solution
    }
}
