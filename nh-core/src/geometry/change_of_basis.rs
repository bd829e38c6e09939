//! Change of the basis of sections, mathematics (5), CNS section 6.

use super::algebroid::Algebroid;
use super::anchor::Anchor;
use super::distribution::ConstraintDistribution;
use super::structure::StructureFunctions;
use crate::algebra::{Graph, Matrix};
use crate::id::{ExprId, Id, SectionId, SymbolId};

/// New sections f_α = Ψ^β_α e_β with quasi-velocities w = Φ y, Φ = Ψ⁻¹.
#[derive(Clone, Debug)]
pub struct ChangeOfBasis {
    /// Ψ^β_α: a row for each old section, a column for each new one.
    pub sections: Matrix,
    /// Φ^α_β: a row for each new velocity, a column for each old one.
    pub velocities: Matrix,
}

impl ChangeOfBasis {
    /// The frame {e_a, e_A} adapted to D: e_a = B_a, and e_A the sections of the dependent
    /// velocities, so that w^A = y^A − B^A_a y^a vanishes on D (CLMM section 3).
    pub fn adapted(graph: &mut Graph, distribution: &ConstraintDistribution) -> Self {
        let rank = distribution.basis.len();
        let (zero, one) = (graph.zero(), graph.one());
        let mut sections = vec![vec![zero; rank]; rank];
        let mut velocities = vec![vec![zero; rank]; rank];
        for index in 0..rank {
            sections[index][index] = one;
            velocities[index][index] = one;
        }
        for section in &distribution.dependent {
            let row = section.index();
            let kept = (0..rank).filter(|index| distribution.dependent.iter().all(|s| s.index() != *index));
            for (a, column) in kept.enumerate() {
                let entry = distribution.basis[row][a];
                sections[row][column] = entry;
                velocities[row][column] = graph.formula(-entry);
            }
        }
        Self { sections, velocities }
    }

    /// The algebroid in the new basis: `ρ'_α = Ψ^β_α ρ_β` and
    /// `C'^ε_{αβ} = Φ^ε_γ ( Ψ^μ_α Ψ^ν_β C^γ_{μν} + ρ'^i_α ∂_iΨ^γ_β − ρ'^i_β ∂_iΨ^γ_α )`.
    pub fn apply(&self, graph: &mut Graph, old: &Algebroid, velocities: Vec<SymbolId>) -> Algebroid {
        let columns = Graph::transposed(&self.sections);
        let entries: Matrix = old.anchor.entries.iter().map(|row| graph.image(&columns, row)).collect();
        let anchor = Anchor { entries, ..old.anchor.clone() };
        let mut structure = StructureFunctions::commuting(old.rank());
        for (alpha, first) in columns.iter().enumerate() {
            for (beta, second) in columns.iter().enumerate().skip(alpha + 1) {
                let bracket = old.bracket(graph, first, second);
                let components: Vec<ExprId> = self
                    .velocities
                    .iter()
                    .map(|row| {
                        let component = graph.inner_product(row, &bracket);
                        graph.simplify(component)
                    })
                    .collect();
                structure.set(graph, SectionId::from_index(alpha), SectionId::from_index(beta), components);
            }
        }
        Algebroid { anchor, structure, velocities }
    }

    /// y = Ψ w.
    pub fn old_velocity(&self, graph: &mut Graph, new: &[ExprId]) -> Vec<ExprId> {
        graph.image(&self.sections, new)
    }
}
