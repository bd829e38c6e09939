//! What maps forces and the rates that constraints ask for to accelerations, mathematics (10‴).
//!
//! With constraints J' = L⁻¹ J that are orthogonal in the metric W⁻¹, and s_a the squares of their lengths,
//!
//! `ẏ = G f + H b`, `G = W⁻¹ − Σ_a r_a r_aᵀ / s_a`, `H = Σ_a r_a (L⁻¹)_a / s_a`, `r_a = W⁻¹ J'_aᵀ`.
//!
//! Derivatives of ẏ are these of those of the equations where ẏ and λ are held, which have few entries each, so that no
//! step of the elimination is differentiated. Weights in W change neither.

use super::factorisation::Factorisation;
use super::orthogonal_constraints::Orthogonal;
use super::procedure::Procedure;
use crate::algebra::{Graph, Matrix};
use crate::id::ExprId;

/// Of more entries than those of some twenty velocities nothing is noted.
const LARGEST: usize = 16_000;

/// G and H.
pub(super) struct ConstrainedInverse {
    forces: Matrix,
    asked: Matrix,
}

impl ConstrainedInverse {
    /// W⁻¹, of so many velocities and constraints, before any constraint; `None` for what is not differentiated, and where the
    /// rows would take more than what they are for.
    pub(super) fn of(
        graph: &mut Graph,
        factors: &Factorisation,
        [velocities, constraints]: [usize; 2],
        procedure: &mut Procedure,
    ) -> Option<Self> {
        if !procedure.is_differentiated || velocities * velocities * (velocities + constraints) > LARGEST {
            return None;
        }
        let units = graph.identity(velocities);
        let forces = units.iter().map(|unit| factors.solve(graph, unit, procedure, "inverse")).collect();
        Some(Self { forces, asked: vec![vec![graph.zero(); constraints]; velocities] })
    }

    /// With a block of constraints that touches no other.
    pub(super) fn without(
        mut self,
        graph: &mut Graph,
        block: &[usize],
        Orthogonal { reach, squares, lower }: &Orthogonal,
        procedure: &mut Procedure,
    ) -> Self {
        // 1. r_a / s_a, and the rows of L⁻¹
        let mut shares: Matrix = Vec::with_capacity(block.len());
        let mut inverse: Matrix = Vec::with_capacity(block.len());
        for (a, (row, square)) in reach.iter().zip(squares).enumerate() {
            let share = |graph: &mut Graph, procedure: &mut Procedure, entry: &ExprId| {
                let share = graph.formula(*entry / square);
                procedure.define(graph, "share", share)
            };
            shares.push(row.iter().map(|entry| share(graph, procedure, entry)).collect());
            let mut whole = graph.unit_vector(block.len(), a);
            for (c, entry) in whole.iter_mut().enumerate().take(a) {
                let column: Vec<ExprId> = inverse[..a].iter().map(|row: &Vec<ExprId>| row[c]).collect();
                let known = graph.inner_product(&lower[a][..a], &column);
                let negative = graph.formula(-known);
                *entry = procedure.define(graph, "back", negative);
            }
            inverse.push(whole);
        }
        // 2. G and H
        for i in 0..self.forces.len() {
            let share: Vec<ExprId> = shares.iter().map(|row| row[i]).collect();
            for j in i..self.forces.len() {
                let column: Vec<ExprId> = reach.iter().map(|row| row[j]).collect();
                let lost = graph.inner_product(&share, &column);
                let left = graph.formula(self.forces[i][j] - lost);
                self.forces[i][j] = left;
                self.forces[j][i] = left;
            }
            for (c, place) in block.iter().enumerate() {
                let column: Vec<ExprId> = inverse.iter().map(|row| row[c]).collect();
                self.asked[i][*place] = graph.inner_product(&share, &column);
            }
        }
        self
    }

    /// The rows (G, H), entries as intermediate results.
    pub(super) fn rows(mut self, graph: &mut Graph, procedure: &mut Procedure) -> Matrix {
        for i in 0..self.forces.len() {
            for j in i..self.forces.len() {
                let entry = procedure.define(graph, "row", self.forces[i][j]);
                self.forces[i][j] = entry;
                self.forces[j][i] = entry;
            }
        }
        let rows = self.forces.into_iter().zip(self.asked);
        rows.map(|(forces, asked)| {
            let asked = asked.into_iter().map(|entry| procedure.define(graph, "row", entry));
            forces.into_iter().chain(asked).collect()
        })
        .collect()
    }
}

#[cfg(test)]
mod tests {
    use crate::algebra::{Graph, Matrix};
    use crate::id::ExprId;
    use crate::mechanics::solved::{Equations, Factors, Solved};
    use crate::mechanics::{Definiteness, Procedure, SaddleEquations};

    fn symbols(g: &mut Graph, count: usize, name: &str) -> Vec<ExprId> {
        let symbols: Vec<_> = (0..count).map(|k| g.new_symbol(format!("{name}{k}"))).collect();
        symbols.into_iter().map(|symbol| g.symbol(symbol)).collect()
    }

    /// Equations of so many velocities, whose constraints touch each other in blocks of these sizes.
    fn equations(g: &mut Graph, velocities: usize, blocks: &[usize], is_diagonal: bool) -> SaddleEquations {
        let (zero, own) = (g.zero(), symbols(g, velocities * velocities, "w"));
        let entry = |i: usize, j: usize| {
            if i == j || !is_diagonal { own[i.min(j) * velocities + i.max(j)] } else { zero }
        };
        let mass = (0..velocities).map(|i| (0..velocities).map(|j| entry(i, j)).collect()).collect();
        let each = velocities / blocks.len();
        let mut jacobian: Matrix = Vec::new();
        for (place, rows) in blocks.iter().enumerate() {
            for row in 0..*rows {
                let filled = symbols(g, velocities, &format!("j{place}{row}"));
                let is_own = |alpha: &usize| alpha / each == place;
                let row = (0..velocities).map(|alpha| if is_own(&alpha) { filled[alpha] } else { zero });
                jacobian.push(row.collect());
            }
        }
        let (force, bias) = (symbols(g, velocities, "f"), symbols(g, jacobian.len(), "b"));
        SaddleEquations { mass, force, jacobian, bias, rates: Vec::new() }
    }

    /// Mathematics (10‴): the rows are those of the inverse of the saddle matrix, of W as it is and with constraints weighed
    /// into it, and with the multipliers that are noted they solve the equations.
    #[test]
    fn what_is_noted_is_the_inverse() {
        for (velocities, blocks, is_diagonal) in
            [(4, vec![3], true), (6, vec![2, 2], true), (3, vec![2], false)]
        {
            let mut g = Graph::new();
            let saddle = equations(&mut g, velocities, &blocks, is_diagonal);
            let mut procedure = Procedure::default().differentiated(true);
            let judge = |_: &Graph, _: &Matrix| Definiteness::Definite;
            let (values, _) = saddle.solve(&mut g, judge, &mut procedure);
            let [
                Solved {
                    unknowns,
                    equations: Equations::System { matrix, right },
                    factors: Factors::Rows { rows, others },
                },
            ] = procedure.solved.as_slice()
            else {
                panic!("{blocks:?}: {} systems are noted", procedure.solved.len());
            };
            let vanishes = |g: &mut Graph, defect: ExprId| {
                let defect = procedure.with_outputs(vec![defect]).written_out(g)[0];
                g.zero_test(defect).is_zero()
            };
            let columns = Graph::transposed(matrix);
            for (i, row) in rows.iter().enumerate() {
                for (j, column) in columns.iter().enumerate() {
                    let entry = g.inner_product(row, column);
                    let unit = if i == j { g.one() } else { g.zero() };
                    let defect = g.formula(entry - unit);
                    assert!(vanishes(&mut g, defect), "{blocks:?}: {i}, {j}");
                }
            }
            let results = unknowns[..velocities].iter().map(|unknown| g.symbol(*unknown));
            let solution: Vec<ExprId> =
                results.collect::<Vec<_>>().into_iter().chain(others.clone()).collect();
            assert_eq!(solution[..velocities], values);
            for (row, right) in matrix.iter().zip(right) {
                let left = g.inner_product(row, &solution);
                let defect = g.formula(left - *right);
                assert!(vanishes(&mut g, defect), "{blocks:?}");
            }
        }
    }

    #[test]
    fn nothing_is_noted_of_what_is_not_differentiated() {
        let mut g = Graph::new();
        let saddle = equations(&mut g, 4, &[3], true);
        let mut procedure = Procedure::default();
        let judge = |_: &Graph, _: &Matrix| Definiteness::Definite;
        let _ = saddle.solve(&mut g, judge, &mut procedure);
        assert!(procedure.solved.is_empty());
    }
}
