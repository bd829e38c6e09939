//! Constraints that leave one direction of two or three velocities free: (9) solved along it; in `free_plane`, two of four.
//!
//! With n across both rows of J, `J n = 0`, (9) is solved by
//!
//! `(n·Wn) ẏ = n (n·f) + (b₁ J₂ − b₂ J₁) × Wn`, mathematics (10″).
//!
//! Nothing is factorised, W may be singular across n, and the one divisor is the determinant of the saddle matrix. Rows
//! that are nearly dependent, at an angle δ, leave n and b₁ J₂ − b₂ J₁ of order δ with errors of round-off: the solution
//! loses δ⁻¹ of these, which is what the constraints themselves explain, where (10) loses δ⁻².

use super::procedure::Procedure;
use super::projected::SaddleEquations;
use super::solved::{Equations, Factors, Solved};
use super::symmetric_solve::{Definiteness, uncoupled};
use crate::algebra::{Graph, Matrix};
use crate::id::{ExprId, SymbolId};

/// Velocities and constraints that nothing couples to others.
struct Part {
    velocities: Vec<usize>,
    constraints: Vec<usize>,
}

impl Part {
    /// The directions that are left free, where they are one of two or three, or two of four.
    fn free_directions(&self) -> Option<usize> {
        match (self.velocities.len(), self.constraints.len()) {
            (2, 1) | (3, 2) => Some(1),
            (4, 2) => Some(2),
            _ => None,
        }
    }
}

impl SaddleEquations {
    /// ẏ by mathematics (10″) where a part of the equations, which nothing couples to the rest, leaves one or two
    /// directions free, and as in [`Self::solve`] elsewhere; `None` where there is no such part.
    pub fn solve_along_free_directions(
        &self,
        graph: &mut Graph,
        definiteness: &dyn Fn(&Graph, &Matrix) -> Definiteness,
        procedure: &mut Procedure,
    ) -> Option<Vec<ExprId>> {
        let parts = self.parts(graph);
        if parts.iter().all(|part| part.free_directions().is_none()) {
            return None;
        }
        let mut accelerations = self.force.clone();
        for part in parts {
            let own = self.restricted(&part);
            let (values, rows) = match part.free_directions() {
                Some(1) => own.along_free_direction(graph, procedure),
                Some(_) => own.in_free_plane(graph, procedure),
                None => (own.solve(graph, definiteness, procedure).0, Vec::new()),
            };
            own.note_inverse(graph, &values, rows, procedure);
            for (alpha, value) in part.velocities.iter().zip(values) {
                accelerations[*alpha] = value;
            }
        }
        Some(accelerations)
    }

    /// The parts that the saddle matrix does not couple.
    fn parts(&self, graph: &mut Graph) -> Vec<Part> {
        let velocities = self.mass.len();
        let matrix = self.matrix(graph);
        let symmetric: Matrix = (0..matrix.len())
            .map(|i| (0..matrix.len()).map(|j| matrix[i.max(j)][i.min(j)]).collect())
            .collect();
        let part = |members: Vec<usize>| {
            let (velocities, constraints): (Vec<usize>, Vec<usize>) =
                members.into_iter().partition(|index| *index < velocities);
            Part {
                velocities,
                constraints: constraints.iter().map(|index| index - self.mass.len()).collect(),
            }
        };
        uncoupled(graph, &symmetric).into_iter().map(part).collect()
    }

    /// The equations of a part.
    fn restricted(&self, part: &Part) -> Self {
        let Part { velocities, constraints } = part;
        let pick = |row: &[ExprId]| velocities.iter().map(|alpha| row[*alpha]).collect::<Vec<ExprId>>();
        Self {
            mass: velocities.iter().map(|alpha| pick(&self.mass[*alpha])).collect(),
            force: pick(&self.force),
            jacobian: constraints.iter().map(|a| pick(&self.jacobian[*a])).collect(),
            bias: constraints.iter().map(|a| self.bias[*a]).collect(),
            rates: Vec::new(),
        }
    }

    /// ẏ, as intermediate results, and the rows of what f and b are mapped to it by.
    fn along_free_direction(&self, graph: &mut Graph, procedure: &mut Procedure) -> (Vec<ExprId>, Matrix) {
        // 1. n
        let free = self.free_direction(graph);
        let free = named(graph, procedure, "free", free);
        // 2. Wn, n·Wn and n·f
        let carried: Vec<ExprId> = self.mass.iter().map(|row| graph.inner_product(row, &free)).collect();
        let carried = named(graph, procedure, "carried", carried);
        let inertia = graph.inner_product(&free, &carried);
        let inertia = procedure.define(graph, "inertia", inertia);
        let push = graph.inner_product(&free, &self.force);
        let push = procedure.define(graph, "push", push);
        // 3. ẏ
        let asked = self.asked(graph, &carried, procedure);
        let one = graph.one();
        let over = graph.formula(one / inertia);
        let over = procedure.define(graph, "over", over);
        let solution = |graph: &mut Graph, push: ExprId, asked: Vec<ExprId>| {
            let pairs = free.iter().zip(asked);
            pairs.map(|(free, asked)| graph.formula((free * push + asked) * over)).collect::<Vec<ExprId>>()
        };
        let values = solution(graph, push, asked);
        // 4. of each component of f and b by itself
        let mut columns = Vec::new();
        for unit in self.units(graph) {
            let push = graph.inner_product(&free, &unit.force);
            let asked = unit.asked(graph, &carried, &mut Procedure::inline());
            columns.push(solution(graph, push, asked));
        }
        (named(graph, procedure, "y_dot", values), Graph::transposed(&columns))
    }

    /// The equations with a 1 in the place of each component of f and b, and else zeros.
    pub(super) fn units(&self, graph: &mut Graph) -> Vec<Self> {
        let (velocities, constraints) = (self.force.len(), self.bias.len());
        let unit = |mut components: Vec<ExprId>| {
            let bias = components.split_off(velocities);
            Self { force: components, bias, ..self.clone() }
        };
        graph.identity(velocities + constraints).into_iter().map(unit).collect()
    }

    /// Notes the rows G, H that f and b are mapped to ẏ by, so that it can be differentiated without its solution:
    /// J H = 1, so that `λ = Hᵀ (W ẏ − f)`.
    pub(super) fn note_inverse(
        &self,
        graph: &mut Graph,
        values: &[ExprId],
        rows: Matrix,
        procedure: &mut Procedure,
    ) {
        let unknowns: Option<Vec<SymbolId>> = values.iter().map(|value| graph.as_symbol(*value)).collect();
        let Some(mut unknowns) = unknowns.filter(|_| !rows.is_empty()) else { return };
        let carried = graph.image(&self.mass, values);
        let pairs = carried.into_iter().zip(&self.force);
        let reaction: Vec<ExprId> = pairs.map(|(carried, force)| graph.formula(carried - *force)).collect();
        let others = graph.image(&Graph::transposed(&rows)[values.len()..], &reaction);
        unknowns.extend(others.iter().map(|_| graph.new_symbol("")));
        let right = [self.force.as_slice(), &self.bias].concat();
        let factors = Factors::Rows { rows, others };
        let equations = Equations::System { matrix: self.matrix(graph), right };
        procedure.solved.push(Solved { unknowns, equations, factors });
    }

    /// n: the row turned by a quarter, or the product of both.
    fn free_direction(&self, graph: &mut Graph) -> Vec<ExprId> {
        let free = match self.jacobian.as_slice() {
            [row] => vec![graph.formula(-row[1]), row[0]],
            rows => cross(graph, &rows[0], &rows[1]).to_vec(),
        };
        graph.simplify_all(&free)
    }

    /// What is added for b, times the inertia: of one row, b Wn turned back; of two, (b₁ J₂ − b₂ J₁) × Wn.
    fn asked(&self, graph: &mut Graph, carried: &[ExprId], procedure: &mut Procedure) -> Vec<ExprId> {
        if let [bias] = self.bias.as_slice() {
            return vec![graph.formula(*bias * carried[1]), graph.formula(-(*bias * carried[0]))];
        }
        let between = between(graph, (&self.jacobian, &self.bias), procedure);
        cross(graph, &between, carried).to_vec()
    }
}

/// b₁ J₂ − b₂ J₁.
pub(super) fn between(
    graph: &mut Graph,
    (jacobian, bias): (&Matrix, &[ExprId]),
    procedure: &mut Procedure,
) -> Vec<ExprId> {
    let pairs = jacobian[0].iter().zip(&jacobian[1]);
    let values: Vec<ExprId> =
        pairs.map(|(first, second)| graph.formula(bias[0] * second - bias[1] * first)).collect();
    let values = graph.simplify_all(&values);
    named(graph, procedure, "between", values)
}

/// The values as intermediate results.
pub(super) fn named(
    graph: &mut Graph,
    procedure: &mut Procedure,
    name: &str,
    values: Vec<ExprId>,
) -> Vec<ExprId> {
    values.into_iter().map(|value| procedure.define(graph, name, value)).collect()
}

pub(super) fn cross(graph: &mut Graph, a: &[ExprId], b: &[ExprId]) -> [ExprId; 3] {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| graph.formula(a[i] * b[j] - a[j] * b[i]))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn symbols(g: &mut Graph, count: usize, name: &str) -> Vec<ExprId> {
        let one = |g: &mut Graph, k| {
            let symbol = g.new_symbol(format!("{name}{k}"));
            g.symbol(symbol)
        };
        (0..count).map(|k| one(g, k)).collect()
    }

    /// Equations of so many velocities and constraints, whose entries are all symbols, and a velocity beside them.
    fn equations(g: &mut Graph, velocities: usize, constraints: usize) -> SaddleEquations {
        let zero = g.zero();
        let entries = symbols(g, velocities * velocities, "w");
        // nothing couples the last to the others
        let entry = |i: usize, j: usize| {
            if j == velocities { zero } else { entries[i * velocities + j] }
        };
        let mut mass: Matrix =
            (0..=velocities).map(|i| (0..=velocities).map(|j| entry(i.min(j), i.max(j))).collect()).collect();
        mass[velocities][velocities] = g.one();
        let jacobian = (0..constraints)
            .map(|a| symbols(g, velocities, &format!("j{a}")).into_iter().chain([zero]).collect())
            .collect();
        let (force, bias) = (symbols(g, velocities + 1, "f"), symbols(g, constraints, "b"));
        SaddleEquations { mass, force, jacobian, bias, rates: Vec::new() }
    }

    /// Mathematics (10″) is (10): J ẏ = b, and what is left of W ẏ − f is a reaction.
    #[test]
    fn what_is_found_along_free_directions_solves_the_equations() {
        for (velocities, constraints) in [(2, 1), (3, 2), (4, 2)] {
            let mut g = Graph::new();
            let saddle = equations(&mut g, velocities, constraints);
            let mut procedure = Procedure::default();
            let judge = |_: &Graph, _: &Matrix| Definiteness::Definite;
            let found =
                saddle.solve_along_free_directions(&mut g, &judge, &mut procedure).expect("they exist");
            let found = procedure.with_outputs(found).written_out(&mut g);
            let mut procedure = Procedure::default();
            let (expected, _) = saddle.solve(&mut g, judge, &mut procedure);
            let expected = procedure.with_outputs(expected).written_out(&mut g);
            assert_eq!(found[velocities], saddle.force[velocities], "a part by itself");
            for (found, expected) in found.iter().zip(&expected) {
                let defect = g.formula(*found - *expected);
                assert!(g.zero_test(defect).is_zero(), "{velocities} velocities, {constraints} constraints");
            }
        }
    }

    /// Rows that are noted are those of the inverse, and the multipliers balance what is left.
    #[test]
    fn what_is_noted_solves_the_equations_for_other_right_hand_sides() {
        for (velocities, constraints) in [(2, 1), (3, 2), (4, 2)] {
            let mut g = Graph::new();
            let saddle = equations(&mut g, velocities, constraints);
            let mut procedure = Procedure::default();
            let judge = |_: &Graph, _: &Matrix| Definiteness::Definite;
            let _ = saddle.solve_along_free_directions(&mut g, &judge, &mut procedure);
            let [
                Solved {
                    unknowns,
                    equations: Equations::System { matrix, right },
                    factors: Factors::Rows { rows, others },
                },
            ] = procedure.solved.as_slice()
            else {
                panic!("one part leaves directions free");
            };
            // 1. rows of the inverse
            let columns = Graph::transposed(matrix);
            for (i, row) in rows.iter().enumerate() {
                for (j, column) in columns.iter().enumerate() {
                    let entry = g.inner_product(row, column);
                    let unit = if i == j { g.one() } else { g.zero() };
                    let defect = g.formula(entry - unit);
                    let defect = procedure.with_outputs(vec![defect]).written_out(&mut g)[0];
                    assert!(g.zero_test(defect).is_zero(), "{velocities} velocities: {i}, {j}");
                }
            }
            // 2. all unknowns
            let mut solution: Vec<ExprId> =
                unknowns[..velocities].iter().map(|unknown| g.symbol(*unknown)).collect();
            solution.extend(others);
            for (row, right) in matrix.iter().zip(right) {
                let left = g.inner_product(row, &solution);
                let defect = g.formula(left - *right);
                let defect = procedure.with_outputs(vec![defect]).written_out(&mut g)[0];
                assert!(g.zero_test(defect).is_zero(), "{velocities} velocities");
            }
        }
    }

    #[test]
    fn other_numbers_of_constraints_are_left_to_others() {
        for (velocities, constraints) in [(3, 1), (4, 1), (3, 3), (5, 2)] {
            let mut g = Graph::new();
            let saddle = equations(&mut g, velocities, constraints);
            let judge = |_: &Graph, _: &Matrix| Definiteness::Definite;
            let found = saddle.solve_along_free_directions(&mut g, &judge, &mut Procedure::default());
            assert!(found.is_none(), "{velocities} velocities, {constraints} constraints");
        }
    }
}
