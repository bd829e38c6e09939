//! Velocities on D, perhaps by intermediate results, and their derivatives.

use super::procedure::{Definition, Procedure};
use crate::algebra::{Derivation, Graph, Matrix};
use crate::geometry::ConstraintDistribution;
use crate::id::{ExprId, SymbolId};

/// The velocities on D.
pub(super) struct Restricted {
    /// Intermediate results.
    pub(super) definitions: Procedure,
    /// y = B v + y₀.
    pub(super) velocity: Vec<ExprId>,
    /// Velocities of D that levels of momenta determine.
    pub(super) eliminated: Vec<(SymbolId, ExprId)>,
    /// B_a.
    pub(super) sections: Matrix,
    /// ∂/∂v^a.
    pub(super) partials: Vec<Derivation>,
}

impl Restricted {
    /// The velocities as the distribution has them.
    pub(super) fn of(graph: &mut Graph, distribution: &ConstraintDistribution) -> Self {
        let rank = distribution.rank();
        Self {
            definitions: Procedure::default(),
            velocity: distribution.velocity.clone(),
            eliminated: distribution.eliminated.clone(),
            sections: (0..rank).map(|a| distribution.section(a)).collect(),
            partials: distribution.independent.iter().map(|v| Derivation::partial(graph, *v)).collect(),
        }
    }

    /// Velocities in terms of intermediate results, which are differentiated one by one.
    pub(super) fn by(
        graph: &mut Graph,
        mut definitions: Procedure,
        velocity: Vec<ExprId>,
        independent: &[SymbolId],
    ) -> Self {
        let mut partials: Vec<Derivation> =
            independent.iter().map(|symbol| Derivation::partial(graph, *symbol)).collect();
        for partial in &mut partials {
            differentiate_all(graph, &mut definitions, partial);
        }
        let sections = partials.iter_mut().map(|partial| partial.apply_all(graph, &velocity)).collect();
        Self { definitions, velocity, eliminated: Vec::new(), sections, partials }
    }
}

/// Makes the derivatives of intermediate results known to a derivation, as further ones.
pub(super) fn differentiate_all(graph: &mut Graph, definitions: &mut Procedure, along: &mut Derivation) {
    for definition in definitions.definitions.clone() {
        if let Definition::Value { symbol, value } = definition {
            let change = along.apply(graph, value);
            let name = format!("d_{}", graph.symbols()[symbol]);
            let change = definitions.define(graph, &name, change);
            along.insert(symbol, change);
        }
    }
}
