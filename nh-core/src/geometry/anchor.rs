//! The anchor ρ: E → TM.

use crate::algebra::{Derivation, Graph, Matrix};
use crate::id::{CoordId, ExprId, Id, SectionId, SymbolId};

/// The anchor ρ(e_α) = ρ^i_α(x) ∂/∂x^i.
#[derive(Clone, Debug)]
pub struct Anchor {
    /// ρ^i_α: a row for each coordinate, a column for each section.
    pub entries: Matrix,
    /// The coordinates x^i.
    pub coordinates: Vec<SymbolId>,
    /// The number of sections, also where there is no coordinate.
    pub rank: usize,
}

impl Anchor {
    /// ρ^i_α.
    #[must_use]
    pub fn entry(&self, coordinate: CoordId, section: SectionId) -> ExprId {
        self.entries[coordinate.index()][section.index()]
    }

    /// The vector field ρ(σ) of a section σ = σ^α e_α: its components along the coordinates.
    pub fn vector_field(&self, graph: &mut Graph, section: &[ExprId]) -> Vec<ExprId> {
        graph.image(&self.entries, section)
    }

    /// The derivation ρ(e_α) of functions on M.
    #[must_use]
    pub fn along(&self, section: SectionId) -> Derivation {
        let column = self.entries.iter().map(|row| row[section.index()]);
        Derivation::new(self.coordinates.iter().copied().zip(column))
    }

    /// `(ρ^i_α Q_i)`: the pull-back of a covector on M, CNS section 3.
    pub fn pull_back(&self, graph: &mut Graph, covector: &[ExprId]) -> Vec<ExprId> {
        (0..self.rank)
            .map(|alpha| {
                let column: Vec<ExprId> = self.entries.iter().map(|row| row[alpha]).collect();
                graph.inner_product(&column, covector)
            })
            .collect()
    }
}
