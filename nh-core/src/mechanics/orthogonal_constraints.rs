//! Multipliers of constraints that are made orthogonal first.
//!
//! J W⁻¹ Jᵀ squares the condition of the constraints: where they are nearly dependent, at an angle δ,
//! its determinant is of order δ², and what is left of it in floating point has lost δ⁻² units of
//! round-off. Rows that are made orthogonal in the metric W⁻¹ one after the other (the modified method of
//! Gram and Schmidt; Å. Björck, *Numerics of Gram–Schmidt orthogonalization*, Linear Algebra Appl.
//! 197/198 (1994)) lose δ⁻¹, which is what the constraints themselves explain.
//!
//! Of many constraints along a chain, each row that is made orthogonal contains all before it, where J W⁻¹ Jᵀ couples
//! neighbours alone. Where that makes them many times as long, they stay as they are.

use super::procedure::Procedure;
use crate::algebra::{Graph, Matrix};
use crate::id::ExprId;
use crate::limits;

/// Constraints J ẏ = bias that touch each other, with their directions W⁻¹ Jᵀ.
#[derive(Debug)]
pub(super) struct Touching {
    /// The rows of J.
    pub(super) jacobian: Matrix,
    /// The rows of J W⁻¹.
    pub(super) reach: Matrix,
    /// What J ẏ has to be.
    pub(super) bias: Vec<ExprId>,
}

/// Constraints that are orthogonal in the metric W⁻¹: J' with L J' = J.
#[derive(Debug)]
pub(super) struct Orthogonal {
    /// The rows of J' W⁻¹.
    pub(super) reach: Matrix,
    /// The diagonal of J' W⁻¹ J'ᵀ.
    pub(super) squares: Vec<ExprId>,
    /// L, below its diagonal of ones.
    pub(super) lower: Matrix,
}

/// As few constraints are made orthogonal, whatever they touch.
const FEW: usize = 6;
/// Rows stay as they are where they would have so many times as many entries.
const LONGER: usize = 2;

impl Touching {
    /// Whether there are many of them, with entries that are zero in J and J W⁻¹ and not in rows that are orthogonal.
    pub(super) fn is_sparse(&self, graph: &Graph) -> bool {
        if self.jacobian.len() <= FEW {
            return false;
        }
        let filled = |row: &Vec<ExprId>| -> Vec<bool> {
            row.iter().map(|entry| !graph.is_literal_zero(*entry)).collect()
        };
        let mut rows: Vec<[Vec<bool>; 2]> =
            self.jacobian.iter().zip(&self.reach).map(|(row, reach)| [filled(row), filled(reach)]).collect();
        let entries = |rows: &[[Vec<bool>; 2]]| rows.iter().flatten().flatten().filter(|is| **is).count();
        let before = entries(&rows);
        for b in 1..rows.len() {
            limits::spend(b * rows[b][0].len() / 64);
            let (orthogonal, rest) = rows.split_at_mut(b);
            for row in orthogonal {
                if rest[0][0].iter().zip(&row[1]).any(|(one, other)| *one && *other) {
                    for (own, other) in rest[0].iter_mut().zip(row) {
                        own.iter_mut().zip(other).for_each(|(own, other)| *own |= *other);
                    }
                }
            }
        }
        entries(&rows) > LONGER * before
    }

    /// Moves the accelerations, which are free of these constraints, to where they hold, and returns λ, and the constraints
    /// as they were made orthogonal.
    ///
    /// With L J' = J, L unit lower triangular, the rows of J' orthogonal: μ = Lᵀλ are the multipliers of
    /// J' ẏ = L⁻¹ bias, each by itself.
    pub(super) fn impose(
        mut self,
        graph: &mut Graph,
        accelerations: &mut [ExprId],
        procedure: &mut Procedure,
    ) -> (Vec<ExprId>, Orthogonal) {
        let rows = self.jacobian.len();
        let zero = graph.zero();
        let mut lower = vec![vec![zero; rows]; rows];
        let mut squares = Vec::with_capacity(rows);
        let mut multipliers = Vec::with_capacity(rows);
        for a in 0..rows {
            // 1. every later row loses its part along this one
            let square = graph.inner_product(&self.jacobian[a], &self.reach[a]);
            let square = procedure.define(graph, "square", square);
            squares.push(square);
            for (b, factors) in lower.iter_mut().enumerate().skip(a + 1) {
                let along = graph.inner_product(&self.jacobian[b], &self.reach[a]);
                if graph.is_literal_zero(along) {
                    continue;
                }
                let factor = graph.formula(along / square);
                let factor = procedure.define(graph, "along", factor);
                factors[a] = factor;
                for matrix in [&mut self.jacobian, &mut self.reach] {
                    let (before, after) = matrix.split_at_mut(b);
                    without(graph, &mut after[0], factor, &before[a], procedure);
                }
                let rest = graph.formula(self.bias[b] - factor * self.bias[a]);
                self.bias[b] = procedure.define(graph, "bias", rest);
            }
            // 2. its multiplier, and the accelerations
            let reached = graph.inner_product(&self.jacobian[a], accelerations);
            let multiplier = graph.formula((self.bias[a] - reached) / square);
            let multiplier = procedure.define(graph, "mu", multiplier);
            let negative = graph.formula(-multiplier);
            without(graph, accelerations, negative, &self.reach[a], procedure);
            multipliers.push(multiplier);
        }
        // 3. λ = L⁻ᵀ μ
        for a in (0..rows).rev() {
            let column: Vec<ExprId> = (a + 1..rows).map(|b| lower[b][a]).collect();
            let known = graph.inner_product(&column, &multipliers[a + 1..]);
            multipliers[a] = graph.formula(multipliers[a] - known);
        }
        (multipliers, Orthogonal { reach: self.reach, squares, lower })
    }
}

/// `row − factor · other`, entries named.
fn without(
    graph: &mut Graph,
    row: &mut [ExprId],
    factor: ExprId,
    other: &[ExprId],
    procedure: &mut Procedure,
) {
    for (entry, other) in row.iter_mut().zip(other) {
        if !graph.is_literal_zero(*other) {
            let rest = graph.formula(*entry - factor * other);
            *entry = procedure.define(graph, "rest", rest);
        }
    }
}
