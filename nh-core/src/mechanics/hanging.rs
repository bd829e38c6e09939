//! Symmetric matrices in which some unknowns touch one other each, as rotors touch the body that they turn in: they leave
//! first, and of what is left no two unknowns are coupled that were not before.

use super::procedure::Procedure;
use super::solved::Hanging;
use crate::algebra::{Graph, Matrix};
use crate::id::ExprId;

impl Hanging<ExprId> {
    /// What is left of the force on j: f_j − C_ij f_i / C_ii.
    pub(crate) fn carried(&self, graph: &mut Graph, right: &mut [ExprId]) {
        right[self.on] = graph.formula(right[self.on] - self.ratio * right[self.place]);
    }

    /// x_i = f_i / C_ii − C_ij x_j / C_ii.
    pub(crate) fn value(&self, graph: &mut Graph, right: &[ExprId], values: &[ExprId]) -> ExprId {
        graph.formula(right[self.place] * self.inverse - self.ratio * values[self.on])
    }
}

/// So many unknowns leave less than three to be coupled, or nothing hangs.
const FEW: usize = 3;

/// A matrix without the unknowns that hang on others.
pub(super) struct Bared {
    pub(super) hanging: Vec<Hanging<ExprId>>,
    /// The places of the other unknowns.
    pub(super) rest: Vec<usize>,
    /// What elimination leaves of the matrix for these.
    pub(super) matrix: Matrix,
}

impl Bared {
    /// A definite matrix, so that no C_ii vanishes.
    pub(super) fn of(graph: &mut Graph, matrix: &Matrix) -> Self {
        let n = matrix.len();
        if n <= FEW {
            return Self { hanging: Vec::new(), rest: (0..n).collect(), matrix: matrix.clone() };
        }
        // two of them tell enough
        let touched = |graph: &Graph, i: usize| -> Vec<usize> {
            (0..n).filter(|j| *j != i && !graph.is_literal_zero(matrix[i][*j])).take(2).collect()
        };
        let touched: Vec<Vec<usize>> = (0..n).map(|i| touched(graph, i)).collect();
        let (mut hanging, mut left) = (Vec::new(), matrix.clone());
        for (place, others) in touched.iter().enumerate() {
            let [on] = others[..] else { continue };
            // of two that touch nothing else one stays
            if touched[on].len() < 2 {
                continue;
            }
            let (pivot, coupling) = (matrix[place][place], matrix[place][on]);
            let one = graph.one();
            let inverse = graph.formula(one / pivot);
            let ratio = graph.formula(coupling / pivot);
            left[on][on] = graph.formula(left[on][on] - ratio * coupling);
            hanging.push(Hanging { place, on, inverse, ratio });
        }
        let rest: Vec<usize> = (0..n).filter(|i| hanging.iter().all(|gone| gone.place != *i)).collect();
        let matrix = Graph::submatrix(&left, &rest);
        Self { hanging, rest, matrix }
    }

    /// The right sides of what is left.
    pub(super) fn carried(&self, graph: &mut Graph, right: &[ExprId]) -> Vec<ExprId> {
        let mut right = right.to_vec();
        for gone in &self.hanging {
            gone.carried(graph, &mut right);
        }
        self.rest.iter().map(|place| right[*place]).collect()
    }

    /// All unknowns, by those of what is left.
    pub(super) fn completed(
        &self,
        graph: &mut Graph,
        right: &[ExprId],
        values: Vec<ExprId>,
        procedure: &mut Procedure,
        name: &str,
    ) -> Vec<ExprId> {
        let mut all = right.to_vec();
        for (place, value) in self.rest.iter().zip(values) {
            let is_used = self.hanging.iter().any(|gone| gone.on == *place);
            all[*place] = if is_used { procedure.define(graph, name, value) } else { value };
        }
        for gone in &self.hanging {
            all[gone.place] = gone.value(graph, right, &all);
        }
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rotors_leave_before_their_body() {
        let mut g = Graph::new();
        let names = ["I", "J", "K", "L", "a", "f", "g", "h"].map(|name| {
            let symbol = g.new_symbol(name);
            g.symbol(symbol)
        });
        let [i, j, k, l, a, f, h, e] = names;
        let zero = g.zero();
        // two bodies that touch each other, with a rotor in each
        let [with_j, with_k] = [g.formula(i + j), g.formula(l + k)];
        let matrix = vec![
            vec![with_j, a, j, zero],
            vec![a, with_k, zero, k],
            vec![j, zero, j, zero],
            vec![zero, k, zero, k],
        ];
        let bared = Bared::of(&mut g, &matrix);
        assert_eq!(bared.rest, [0, 1]);
        assert_eq!(bared.matrix, [[i, a], [a, l]]);
        let carried = bared.carried(&mut g, &[f, h, e, zero]);
        assert_eq!(carried, [g.formula(f - e), h]);
        // nothing hangs where all touch, nor one of a pair
        let pair = vec![vec![i, a], vec![a, j]];
        assert_eq!(Bared::of(&mut g, &pair).rest, [0, 1]);
    }
}
