//! The constraint distribution D, by its annihilator and by a basis.

use super::algebroid::Algebroid;
use crate::algebra::{Graph, Matrix, Substitution, Verdict};
use crate::id::{ExprId, Id, SectionId, SymbolId};

/// Constraints that are linear or affine in the velocities: Φ^A_α(t, x) y^α + b^A(t, x) = 0.
#[derive(Clone, Debug)]
pub struct LinearConstraints {
    /// Φ: a row for each constraint. The rows span the annihilator D°.
    pub annihilator: Matrix,
    /// b: zero for linear constraints.
    pub drift: Vec<ExprId>,
}

/// D with a basis adapted to a choice of independent velocities: y = B v + y₀.
#[derive(Clone, Debug)]
pub struct ConstraintDistribution {
    /// The constraints.
    pub constraints: LinearConstraints,
    /// The velocities v that the state keeps, in declared order.
    pub independent: Vec<SymbolId>,
    /// The velocities that the constraints determine.
    pub dependent: Vec<SectionId>,
    /// B^α_a: a row for each section, a column for each independent velocity.
    pub basis: Matrix,
    /// y₀.
    pub offset: Vec<ExprId>,
    /// What the solution of the constraints was divided by.
    pub pivots: Vec<ExprId>,
}

impl ConstraintDistribution {
    /// All of E.
    pub fn unconstrained(graph: &mut Graph, velocities: &[SymbolId]) -> Self {
        let constraints = LinearConstraints { annihilator: Vec::new(), drift: Vec::new() };
        let (independent, rank) = (velocities.to_vec(), velocities.len());
        let (zero, one) = (graph.zero(), graph.one());
        let basis =
            (0..rank).map(|row| (0..rank).map(|column| if row == column { one } else { zero }).collect());
        Self {
            constraints,
            independent,
            dependent: Vec::new(),
            basis: basis.collect(),
            offset: vec![zero; rank],
            pivots: Vec::new(),
        }
    }

    /// Solves the constraints for the dependent velocities. `None` if they do not determine them.
    pub fn solved_for(
        graph: &mut Graph,
        constraints: LinearConstraints,
        dependent: &[SectionId],
        velocities: &[SymbolId],
    ) -> Option<Self> {
        let rank = velocities.len();
        let independent: Vec<SectionId> =
            (0..rank).map(SectionId::from_index).filter(|section| !dependent.contains(section)).collect();
        let columns = |sections: &[SectionId]| -> Matrix {
            constraints
                .annihilator
                .iter()
                .map(|row| sections.iter().map(|s| row[s.index()]).collect())
                .collect()
        };
        let matrix = columns(dependent);
        let mut right = columns(&independent);
        for (row, drift) in right.iter_mut().zip(&constraints.drift) {
            row.push(*drift);
        }
        let solution = graph.solve_linear(&matrix, &right)?;
        let (zero, one) = (graph.zero(), graph.one());
        let mut basis = vec![vec![zero; independent.len()]; rank];
        let mut offset = vec![zero; rank];
        for (column, section) in independent.iter().enumerate() {
            basis[section.index()][column] = one;
        }
        for (section, row) in dependent.iter().zip(&solution.values) {
            let mut negated: Vec<ExprId> = row.iter().map(|entry| graph.neg(*entry)).collect();
            offset[section.index()] = negated.pop().unwrap_or(zero);
            basis[section.index()] = negated;
        }
        let (dependent, pivots) = (dependent.to_vec(), solution.divisors);
        let independent = independent.iter().map(|section| velocities[section.index()]).collect();
        Some(Self { constraints, independent, dependent, basis, offset, pivots })
    }

    /// The rank r of D.
    #[must_use]
    pub fn rank(&self) -> usize {
        self.independent.len()
    }

    /// B_a, the section of D that belongs to an independent velocity.
    #[must_use]
    pub fn section(&self, a: usize) -> Vec<ExprId> {
        self.basis.iter().map(|row| row[a]).collect()
    }

    /// y = B v + y₀ in the velocity symbols of the independent velocities.
    pub fn velocity(&self, graph: &mut Graph) -> Vec<ExprId> {
        let independent: Vec<ExprId> = self.independent.iter().map(|symbol| graph.symbol(*symbol)).collect();
        let linear: Vec<ExprId> =
            self.basis.iter().map(|row| graph.inner_product(row, &independent)).collect();
        linear.into_iter().zip(&self.offset).map(|(y, offset)| graph.add(y, *offset)).collect()
    }

    /// The restriction of functions on E to the constraint manifold: every quasi-velocity is
    /// replaced by its value there.
    pub fn restriction(&self, graph: &mut Graph, velocities: &[SymbolId]) -> Substitution {
        let velocity = self.velocity(graph);
        let changed = velocities.iter().copied().zip(velocity);
        Substitution::new(changed.filter(|(symbol, value)| graph.as_symbol(*value) != Some(*symbol)))
    }

    /// Whether D is closed under the bracket, that is C^A_{ab} = 0 in an adapted frame
    /// (CLMM Remark 3.3). `None` where that could not be decided.
    pub fn is_holonomic(&self, graph: &mut Graph, algebroid: &Algebroid) -> Option<bool> {
        let mut undecided = false;
        for a in 0..self.rank() {
            for b in a + 1..self.rank() {
                let bracket = algebroid.bracket(graph, &self.section(a), &self.section(b));
                for row in &self.constraints.annihilator {
                    let component = graph.inner_product(row, &bracket);
                    match graph.zero_test(component) {
                        Verdict::Zero => {}
                        Verdict::NonZero(_) => return Some(false),
                        Verdict::Unknown(_) => undecided = true,
                    }
                }
            }
        }
        (!undecided).then_some(true)
    }
}
