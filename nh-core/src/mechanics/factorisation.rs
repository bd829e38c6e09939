//! Definite matrices factorised once, for several right-hand sides.

use super::elimination_order::elimination_order;
use super::ldl::{Ldl, Numerators, SIMPLIFIED};
use super::procedure::Procedure;
use super::symmetric_solve::uncoupled;
use crate::algebra::Graph;
use crate::id::ExprId;

/// Blocks of no more unknowns than this are also written out.
const SMALL: usize = 3;

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
                let factors = Ldl::of(graph, &inner, Numerators::Divided, procedure, name);
                let is_small = block.len() <= SMALL && graph.operation_count(&inner.concat()) <= SIMPLIFIED;
                let written_out = is_small
                    .then(|| Ldl::of(graph, &inner, Numerators::Divided, &mut Procedure::inline(), name));
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
        if short == solution || graph.operation_count(&short) > SIMPLIFIED {
            return solution;
        }
        let long = procedure.written_out_alone(graph, &solution);
        let growth = graph.accuracy().growth();
        for ((value, short), long) in solution.iter_mut().zip(short).zip(long) {
            if graph.error_growth(long, short) > growth {
                *value = procedure.define(graph, name, short);
            }
        }
        solution
    }
}
