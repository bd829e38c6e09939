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
    /// û^k, where they are known.
    pub(super) forms: Option<Vec<ExprId>>,
    /// Whether derivatives of intermediate results are simplified.
    pub(super) simplified: bool,
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
            forms: None,
            simplified: false,
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
            differentiate_all(graph, &mut definitions, partial, false);
        }
        let sections = partials.iter_mut().map(|partial| partial.apply_all(graph, &velocity)).collect();
        let (eliminated, forms, simplified) = (Vec::new(), None, false);
        Self { definitions, velocity, eliminated, sections, partials, forms, simplified }
    }
}

/// Makes the derivatives of intermediate results known to a derivation, as further ones.
pub(super) fn differentiate_all(
    graph: &mut Graph,
    definitions: &mut Procedure,
    along: &mut Derivation,
    simplified: bool,
) {
    for definition in definitions.definitions.clone() {
        if let Definition::Value { symbol, value } = definition {
            let mut change = along.apply(graph, value);
            if simplified {
                change = graph.simplify(change);
            }
            let name = format!("d_{}", graph.symbols()[symbol]);
            let change = definitions.define(graph, &name, change);
            along.insert(symbol, change);
        }
    }
}
