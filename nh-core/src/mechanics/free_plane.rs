//! Two constraints that leave two directions of four velocities free: (9) solved in the plane of these.
//!
//! N is antisymmetric and made of the minors of J, so that `J N = 0` and the plane is what N maps to; M = W N W, * takes
//! the complementary components. Then
//!
//! `(Σ_{i<j} N_ij M_ij) ẏ = −N W N f + (*M) (b₁ J₂ − b₂ J₁)`, mathematics (10″).

use super::free_direction::{between, named};
use super::procedure::Procedure;
use super::projected::SaddleEquations;
use crate::algebra::{Graph, Matrix};
use crate::id::ExprId;

impl SaddleEquations {
    /// ẏ, as intermediate results, and the rows of what f and b are mapped to it by.
    pub(super) fn in_free_plane(
        &self,
        graph: &mut Graph,
        procedure: &mut Procedure,
    ) -> (Vec<ExprId>, Matrix) {
        // 1. N, M = W N W by the minors of W, and their product
        let pairs = pairs();
        let plane = self.plane(graph);
        let plane = named(graph, procedure, "plane", plane);
        let both = self.minors_of_inertia(graph);
        let both = graph.image(&both, &plane);
        let both = named(graph, procedure, "both", both);
        let plane = antisymmetric(graph, &pairs, &plane);
        let minors: Vec<ExprId> = pairs.iter().map(|(i, j)| plane[*i][*j]).collect();
        let inertia = graph.inner_product(&minors, &both);
        let inertia = procedure.define(graph, "inertia", inertia);
        let one = graph.one();
        let over = graph.formula(one / inertia);
        let over = procedure.define(graph, "over", over);
        let dual = complementary(graph, &both);
        let dual = antisymmetric(graph, &pairs, &dual);
        // 2. of f and b, and of each of their components by itself
        let solution = |graph: &mut Graph, equations: &Self, procedure: &mut Procedure| {
            let along = equations.along(graph, &plane, procedure);
            let between = between(graph, (&equations.jacobian, &equations.bias), procedure);
            let asked = graph.image(&dual, &between);
            let pairs = along.into_iter().zip(asked);
            pairs.map(|(along, asked)| graph.formula((along + asked) * over)).collect::<Vec<ExprId>>()
        };
        let values = solution(graph, self, procedure);
        let columns: Matrix =
            self.units(graph).iter().map(|unit| solution(graph, unit, &mut Procedure::inline())).collect();
        (named(graph, procedure, "y_dot", values), Graph::transposed(&columns))
    }

    /// −N W N f.
    fn along(&self, graph: &mut Graph, plane: &Matrix, procedure: &mut Procedure) -> Vec<ExprId> {
        let push = graph.image(&Graph::transposed(plane), &self.force);
        let push = named(graph, procedure, "push", push);
        let momentum = graph.image(&self.mass, &push);
        let momentum = named(graph, procedure, "momentum", momentum);
        graph.image(plane, &momentum)
    }

    /// N_ij for i < j.
    fn plane(&self, graph: &mut Graph) -> Vec<ExprId> {
        let [first, second] = [&self.jacobian[0], &self.jacobian[1]];
        let minor = |(i, j): (usize, usize)| graph.formula(first[i] * second[j] - first[j] * second[i]);
        let minors: Vec<ExprId> = pairs().into_iter().map(minor).collect();
        let minors = graph.simplify_all(&minors);
        complementary(graph, &minors)
    }

    /// W_ik W_jl − W_il W_jk, a row for each pair i < j, simplified: what a body carries besides cancels in them.
    fn minors_of_inertia(&self, graph: &mut Graph) -> Matrix {
        let (pairs, mass) = (pairs(), &self.mass);
        let mut minors: Matrix = Vec::with_capacity(pairs.len());
        for (row, (i, j)) in pairs.iter().enumerate() {
            let entries = pairs.iter().enumerate().map(|(column, (k, l))| {
                // they are symmetric
                if column < row {
                    return minors[column][row];
                }
                let minor = graph.formula(mass[*i][*k] * mass[*j][*l] - mass[*i][*l] * mass[*j][*k]);
                graph.simplify(minor)
            });
            let entries = entries.collect();
            minors.push(entries);
        }
        minors
    }
}

/// i < j, in order.
fn pairs() -> [(usize, usize); 6] {
    [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)]
}

/// The complementary components: 34 of 12, and so on.
fn complementary(graph: &mut Graph, entries: &[ExprId]) -> Vec<ExprId> {
    let mut found: Vec<ExprId> = entries.iter().rev().copied().collect();
    for index in [1, 4] {
        found[index] = graph.formula(-found[index]);
    }
    found
}

fn antisymmetric(graph: &mut Graph, pairs: &[(usize, usize)], entries: &[ExprId]) -> Matrix {
    let mut matrix = vec![vec![graph.zero(); 4]; 4];
    for ((i, j), entry) in pairs.iter().zip(entries) {
        matrix[*i][*j] = *entry;
        matrix[*j][*i] = graph.formula(-*entry);
    }
    matrix
}
