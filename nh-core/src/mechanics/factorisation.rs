//! Definite matrices as L D Lᵀ with unit lower triangular L, unrolled and without pivoting.

use super::elimination_order::elimination_order;
use super::procedure::Procedure;
use super::symmetric_solve::uncoupled;
use crate::algebra::{Graph, Matrix, Rational};
use crate::id::ExprId;

/// A definite matrix factorised block by block, for several right-hand sides.
#[derive(Clone, Debug)]
pub struct Factorisation {
    blocks: Vec<Block>,
}

/// Unknowns that are coupled, in the order of their elimination.
#[derive(Clone, Debug)]
struct Block {
    members: Vec<usize>,
    factors: Ldl,
    /// The same factors without intermediate results, of small blocks.
    written_out: Option<Ldl>,
}

impl Factorisation {
    /// Factorises.
    pub fn of(graph: &mut Graph, matrix: &[Vec<ExprId>], procedure: &mut Procedure, name: &str) -> Self {
        let blocks = uncoupled(graph, matrix)
            .into_iter()
            .map(|block| {
                let block = elimination_order(graph, matrix, &block);
                let inner = Graph::submatrix(matrix, &block);
                let factors = Ldl::of(graph, &inner, procedure, name);
                let is_small = block.len() <= SMALL && graph.operation_count(&inner.concat()) <= SIMPLIFIED;
                let written_out = is_small.then(|| Ldl::of(graph, &inner, &mut Procedure::inline(), name));
                Block { members: block, factors, written_out }
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
        for block in &self.blocks {
            let outer: Vec<ExprId> = block.members.iter().map(|i| right[*i]).collect();
            if outer.iter().all(|entry| graph.is_literal_zero(*entry)) {
                continue;
            }
            for (index, value) in block.members.iter().zip(block.solve(graph, &outer, procedure, name)) {
                solution[*index] = value;
            }
        }
        solution
    }
}

impl Block {
    /// Substitution from one intermediate result to the next hides what cancels identically in the
    /// solution. Where that is short when written out and simplified, and the way there loses digits
    /// against it, it is used instead.
    fn solve(
        &self,
        graph: &mut Graph,
        right: &[ExprId],
        procedure: &mut Procedure,
        name: &str,
    ) -> Vec<ExprId> {
        let mut solution = self.factors.solve(graph, right, procedure, name);
        let Some(written_out) = &self.written_out else { return solution };
        let short = written_out.solve(graph, right, &mut Procedure::inline(), name);
        if graph.operation_count(&short) > SIMPLIFIED {
            return solution;
        }
        let long = procedure.with_outputs(solution.clone()).written_out(graph);
        let growth = graph.accuracy().growth();
        for ((value, short), long) in solution.iter_mut().zip(short).zip(long) {
            if graph.error_growth(long, short) > growth {
                *value = procedure.define(graph, name, short);
            }
        }
        solution
    }
}

/// `L D Lᵀ` with unit lower triangular L.
#[derive(Clone, Debug)]
pub(super) struct Ldl {
    /// Below the diagonal: L.
    lower: Matrix,
    /// D.
    diagonal: Vec<ExprId>,
}

/// Entries of the factorisation with more operations than this are not simplified.
const SIMPLIFIED: u64 = 40;
/// Blocks of no more unknowns than this are also written out.
const SMALL: usize = 3;
/// Simplified entries with no more operations than this stay in place, so that later ones simplify.
const IN_PLACE: u64 = 6;

/// An entry of the factorisation as an intermediate result. Short ones are simplified: where a pivot is
/// a mass, say, much of what follows cancels.
fn named(graph: &mut Graph, procedure: &mut Procedure, name: &str, value: ExprId) -> ExprId {
    if graph.operation_count(&[value]) > SIMPLIFIED {
        return procedure.define(graph, name, value);
    }
    let short = graph.simplify(value);
    let is_accurate = short == value || graph.error_growth(short, value) <= graph.accuracy().growth();
    let value = if is_accurate { short } else { value };
    if graph.operation_count(&[value]) <= IN_PLACE {
        return value;
    }
    procedure.define(graph, name, value)
}

impl Ldl {
    pub(super) fn of(
        graph: &mut Graph,
        matrix: &[Vec<ExprId>],
        procedure: &mut Procedure,
        name: &str,
    ) -> Self {
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
            let pivot = named(graph, procedure, &format!("{name}_d{j}"), pivot);
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
                lower[i][j] = named(graph, procedure, &format!("{name}_l{i}{j}"), quotient);
            }
        }
        Self { lower, diagonal }
    }

    pub(super) fn solve(
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
            forward.push(named(graph, procedure, &format!("{name}_z{i}"), value));
        }
        // Lᵀ x = D⁻¹ z
        let mut solution = forward.clone();
        for i in (0..n).rev() {
            let column: Vec<ExprId> = (i + 1..n).map(|k| self.lower[k][i]).collect();
            let known = graph.inner_product(&column, &solution[i + 1..]);
            let scaled = graph.div(forward[i], self.diagonal[i]);
            let value = graph.sub(scaled, known);
            solution[i] = named(graph, procedure, &format!("{name}_x{i}"), value);
        }
        solution
    }
}
