//! Position constraints, and the constraints on velocities that they imply.

use super::{ConstraintDecl, Coordinate};
use crate::algebra::{Derivation, Graph};
use crate::id::{CoordId, ExprId, Origin, SymbolId, Table};

/// One position constraint `lhs = rhs`, as f = lhs − rhs.
#[derive(Clone, Debug)]
pub struct PositionDecl {
    /// The user's label.
    pub label: Option<String>,
    /// f(t, x).
    pub value: ExprId,
    /// Whether it is an entry of an equation between vectors.
    pub is_entry: bool,
    /// Where it stands.
    pub origin: Origin,
}

impl PositionDecl {
    /// The constraint on velocities that it implies, ẋ^i ∂_i f + ∂_t f = 0: with ẋ = ρ(y) it reads
    /// Φ^a_α y^α + b^a = 0, Φ^a_α = ρ^i_α ∂_i f^a and b^a = ∂_t f^a, mathematics (34).
    pub fn velocity_form(
        &self,
        graph: &mut Graph,
        coordinates: &Table<CoordId, Coordinate>,
        time: SymbolId,
    ) -> ConstraintDecl {
        let mut seeds = vec![(time, graph.one())];
        for coordinate in coordinates {
            seeds.push((coordinate.symbol, graph.symbol(coordinate.rate)));
        }
        let residual = Derivation::new(seeds).apply(graph, self.value);
        let Self { label, is_entry, origin, .. } = self;
        ConstraintDecl {
            label: label.clone(),
            residual,
            solved_for: None,
            is_entry: *is_entry,
            origin: *origin,
        }
    }
}
