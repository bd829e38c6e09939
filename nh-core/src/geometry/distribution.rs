//! The constraint distribution D, by its annihilator and by a basis.

use super::algebroid::Algebroid;
use super::clock::Clock;
use super::manifold::Manifold;
use crate::algebra::{Derivation, Graph, Matrix, Solution, Substitution, Verdict};
use crate::id::{ExprId, Id, SectionId, SymbolId};
use crate::limits;

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
    /// B v + y₀ at the velocity symbols.
    pub velocity: Vec<ExprId>,
    /// Velocities of D that levels of momenta determine, in terms of the independent ones.
    pub eliminated: Vec<(SymbolId, ExprId)>,
    /// What the solution of the constraints was divided by.
    pub pivots: Vec<ExprId>,
    /// The constraints and dependent velocities of each block of the solution, by position.
    pub(super) blocks: Vec<(Vec<usize>, Vec<usize>)>,
}

/// More constraints than this are solved in a chain where possible.
const LARGE: usize = 4;

/// B v + y₀.
fn linear_velocity(
    graph: &mut Graph,
    independent: &[SymbolId],
    basis: &Matrix,
    offset: &[ExprId],
) -> Vec<ExprId> {
    let symbols: Vec<ExprId> = independent.iter().map(|symbol| graph.symbol(*symbol)).collect();
    let linear = graph.image(basis, &symbols);
    linear.into_iter().zip(offset).map(|(y, offset)| graph.formula(y + offset)).collect()
}

/// How D lies to the brackets of its sections.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Involution {
    /// They are in D.
    Closed,
    /// One is not.
    NotClosed,
    /// The bracket of one with ∂_t + y₀ is not.
    NotClosedInTime,
}

impl ConstraintDistribution {
    /// All of E.
    pub fn unconstrained(graph: &mut Graph, velocities: &[SymbolId]) -> Self {
        let constraints = LinearConstraints { annihilator: Vec::new(), drift: Vec::new() };
        let rank = velocities.len();
        let basis = graph.identity(rank);
        Self::spanned(graph, constraints, velocities.to_vec(), basis)
    }

    /// D spanned by the columns of `basis`, without drift.
    pub fn spanned(
        graph: &mut Graph,
        constraints: LinearConstraints,
        independent: Vec<SymbolId>,
        basis: Matrix,
    ) -> Self {
        let offset = vec![graph.zero(); basis.len()];
        let velocity = linear_velocity(graph, &independent, &basis, &offset);
        Self {
            constraints,
            independent,
            dependent: Vec::new(),
            basis,
            offset,
            velocity,
            eliminated: Vec::new(),
            pivots: Vec::new(),
            blocks: Vec::new(),
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
        // many constraints are solved one after the other where that is possible; see `chained`
        let blocks = graph.solve_linear(&matrix, &vec![Vec::new(); matrix.len()])?;
        if matrix.len() > LARGE && blocks.blocks.iter().all(|(rows, _)| rows.len() == 1) {
            return Some(Self::in_chain(graph, constraints, dependent, velocities, blocks));
        }
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
            let mut negated: Vec<ExprId> = row.iter().map(|entry| graph.formula(-entry)).collect();
            offset[section.index()] = negated.pop().unwrap_or(zero);
            basis[section.index()] = negated;
        }
        let (dependent, pivots) = (dependent.to_vec(), solution.divisors);
        let independent: Vec<SymbolId> =
            independent.iter().map(|section| velocities[section.index()]).collect();
        let velocity = linear_velocity(graph, &independent, &basis, &offset);
        let (blocks, eliminated) = (solution.blocks, Vec::new());
        Some(Self {
            constraints,
            independent,
            dependent,
            basis,
            offset,
            velocity,
            eliminated,
            pivots,
            blocks,
        })
    }

    /// D by the chain of its constraints alone.
    fn in_chain(
        graph: &mut Graph,
        constraints: LinearConstraints,
        dependent: &[SectionId],
        velocities: &[SymbolId],
        solution: Solution,
    ) -> Self {
        let symbols: Vec<ExprId> = velocities.iter().map(|symbol| graph.symbol(*symbol)).collect();
        let linear = graph.image(&constraints.annihilator, &symbols);
        let residuals: Vec<ExprId> = linear
            .into_iter()
            .zip(&constraints.drift)
            .map(|(row, drift)| graph.formula(row + drift))
            .collect();
        let is_dependent = |index: &usize| dependent.contains(&SectionId::from_index(*index));
        let independent = (0..velocities.len()).filter(|index| !is_dependent(index)).map(|i| velocities[i]);
        let unsolved = Self {
            constraints,
            independent: independent.collect(),
            dependent: dependent.to_vec(),
            basis: Matrix::new(),
            offset: Vec::new(),
            velocity: symbols,
            eliminated: Vec::new(),
            pivots: solution.divisors,
            blocks: solution.blocks,
        };
        unsolved.chained(graph, &residuals, velocities)
    }

    /// The same D in the basis of the columns of B T, with names for its velocities.
    #[must_use]
    pub fn rebased(&self, graph: &mut Graph, change: &Matrix, velocities: Vec<SymbolId>) -> Self {
        let columns = Graph::transposed(change);
        let mut basis = Matrix::new();
        for row in &self.basis {
            let mut entries = Vec::new();
            for column in &columns {
                let entry = graph.inner_product(row, column);
                entries.push(graph.simplify(entry));
            }
            basis.push(entries);
        }
        let velocity = linear_velocity(graph, &velocities, &basis, &self.offset);
        Self { independent: velocities, basis, velocity, blocks: Vec::new(), ..self.clone() }
    }

    /// The rank r of D.
    #[must_use]
    pub fn rank(&self) -> usize {
        self.independent.len()
    }

    /// The constraints and the dependent velocities that are solved for together, by position, in the
    /// order in which they are solved.
    #[must_use]
    pub fn blocks(&self) -> &[(Vec<usize>, Vec<usize>)] {
        &self.blocks
    }

    /// B_a, the section of D that belongs to an independent velocity.
    #[must_use]
    pub fn section(&self, a: usize) -> Vec<ExprId> {
        self.basis.iter().map(|row| row[a]).collect()
    }

    /// All B_a.
    #[must_use]
    pub fn sections(&self) -> Matrix {
        (0..self.rank()).map(|a| self.section(a)).collect()
    }

    /// For each constraint a section of dependent velocities l with Φ l = 1 in its row and 0 in the others.
    pub fn lifts(&self, graph: &mut Graph) -> Matrix {
        let rows = &self.constraints.annihilator;
        let matrix: Matrix =
            rows.iter().map(|row| self.dependent.iter().map(|s| row[s.index()]).collect()).collect();
        let unit = graph.identity(rows.len());
        let Some(solution) = graph.solve_linear(&matrix, &unit) else { return Matrix::new() };
        let zero = graph.zero();
        (0..rows.len())
            .map(|row| {
                let mut lift = vec![zero; self.basis.len()];
                for (section, values) in self.dependent.iter().zip(&solution.values) {
                    lift[section.index()] = values[row];
                }
                lift
            })
            .collect()
    }

    /// The components along the B_a of a section that lies in D.
    pub fn components(&self, graph: &mut Graph, section: &[ExprId]) -> Option<Vec<ExprId>> {
        graph.solve_overdetermined(&self.basis, section)
    }

    /// The same D with the dependent velocities solved for one after the other, each in terms of
    /// those before it: `residuals` are the constraints as they were written, so that a chain of
    /// bodies stays a chain. B and y₀ are read off by differentiation.
    #[must_use]
    pub fn chained(&self, graph: &mut Graph, residuals: &[ExprId], velocities: &[SymbolId]) -> Self {
        let mut velocity = self.velocity.clone();
        let mut images: Vec<(SymbolId, ExprId)> = Vec::new();
        let zero = graph.zero();
        for (rows, unknowns) in &self.blocks {
            for unknown in unknowns {
                let section = self.dependent[*unknown].index();
                if let ([row], [_]) = (rows.as_slice(), unknowns.as_slice()) {
                    // what is solved for later has no part in this constraint, though it may occur in it, with a
                    // coefficient that cancels
                    let is_open = |later: &SymbolId| images.iter().all(|(solved, _)| solved != later);
                    let open = self.dependent.iter().map(|section| velocities[section.index()]);
                    let open = open.filter(is_open).map(|later| (later, zero));
                    let without = images.iter().copied().chain(open);
                    let rest = Substitution::new(without).apply(graph, residuals[*row]);
                    velocity[section] = graph.formula(-(rest / self.constraints.annihilator[*row][section]));
                }
                images.push((velocities[section], velocity[section]));
            }
        }
        let mut basis: Matrix = vec![Vec::new(); velocity.len()];
        for symbol in &self.independent {
            let mut along = Derivation::partial(graph, *symbol);
            for (row, component) in basis.iter_mut().zip(&velocity) {
                row.push(along.apply(graph, *component));
            }
        }
        let offset = velocity.iter().map(|component| graph.at_zero(*component, &self.independent)).collect();
        Self { basis, offset, velocity, ..self.clone() }
    }

    /// The restriction of functions on E to the constraint manifold: every quasi-velocity is
    /// replaced by its value there.
    #[must_use]
    pub fn restriction(&self, graph: &Graph, velocities: &[SymbolId]) -> Substitution {
        let changed = velocities.iter().copied().zip(self.velocity.iter().copied());
        let changed = self.eliminated.iter().copied().chain(changed);
        Substitution::new(changed.filter(|(symbol, value)| graph.as_symbol(*value) != Some(*symbol)))
    }

    /// Whether the constraints are integrable: D is closed under the bracket, that is
    /// C^A_{ab} = 0 in an adapted frame (CLMM Remark 3.3), and, where there is a drift or a
    /// dependence on time, under the bracket with ∂_t + y₀ as well. `None` where that could not be
    /// decided.
    pub fn involution(
        &self,
        graph: &mut Graph,
        algebroid: &Algebroid,
        clock: &Clock,
        base: &Manifold,
    ) -> Option<Involution> {
        limits::attempt(limits::REMARK, || self.decided(graph, algebroid, clock, base)).flatten()
    }

    fn decided(
        &self,
        graph: &mut Graph,
        algebroid: &Algebroid,
        clock: &Clock,
        base: &Manifold,
    ) -> Option<Involution> {
        let mut undecided = false;
        for a in 0..self.rank() {
            let section = self.section(a);
            for b in a + 1..=self.rank() {
                let bracket = if b < self.rank() {
                    algebroid.bracket(graph, &section, &self.section(b))
                } else {
                    // [∂_t + y₀, B_a]
                    let along = algebroid.bracket(graph, &self.offset, &section);
                    let drift = along.into_iter().zip(&section).map(|(component, entry)| {
                        let change = clock.rate(graph, *entry);
                        graph.formula(component + change)
                    });
                    drift.collect()
                };
                for row in &self.constraints.annihilator {
                    let component = graph.inner_product(row, &bracket);
                    match base.zero_test(graph, component) {
                        Verdict::Zero => {}
                        Verdict::NonZero(_) if b < self.rank() => return Some(Involution::NotClosed),
                        Verdict::NonZero(_) => return Some(Involution::NotClosedInTime),
                        Verdict::Unknown(_) => undecided = true,
                    }
                }
            }
        }
        (!undecided).then_some(Involution::Closed)
    }
}
