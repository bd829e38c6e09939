//! Velocities on D, perhaps by intermediate results, and their derivatives.

use super::procedure::{Definition, Procedure};
use crate::algebra::{Derivation, Graph, Matrix, Substitution};
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
        for (partial, symbol) in partials.iter_mut().zip(independent) {
            let suffix = format!("per_{}", graph.symbols()[*symbol]);
            differentiate_all(graph, &mut definitions, partial, &suffix, false);
        }
        let sections = partials.iter_mut().map(|partial| partial.apply_all(graph, &velocity)).collect();
        let (eliminated, forms, simplified) = (Vec::new(), None, false);
        Self { definitions, velocity, eliminated, sections, partials, forms, simplified }
    }
}

/// Intermediate results that are multiples of a single velocity, û = θ(B_a) v^a, by their partial velocities:
/// the chain of these along bodies is that of velocities and of partial velocities at once.
pub(super) fn by_multiples(
    graph: &mut Graph,
    definitions: Procedure,
    independent: &[SymbolId],
) -> (Procedure, Substitution) {
    let (mut result, mut images) = (Procedure::default(), Substitution::new([]));
    let mut kept: Vec<SymbolId> = Vec::new();
    for definition in definitions.definitions {
        let Definition::Value { symbol, value } = definition else {
            result.definitions.push(definition);
            continue;
        };
        let value = images.apply(graph, value);
        let multiple =
            (!graph.depends_on(value, &kept)).then(|| multiple(graph, value, independent)).flatten();
        if let Some((velocity, partial)) = multiple {
            let name = format!("{}_per_{}", graph.symbols()[symbol], graph.symbols()[velocity]);
            let partial = result.define(graph, &name, partial);
            let velocity = graph.symbol(velocity);
            images.insert(symbol, graph.formula(partial * velocity));
        } else {
            kept.push(symbol);
            result.definitions.push(Definition::Value { symbol, value });
        }
    }
    (result, images)
}

/// v^a and c, where a value is c v^a.
fn multiple(graph: &mut Graph, value: ExprId, independent: &[SymbolId]) -> Option<(SymbolId, ExprId)> {
    let moving: Vec<SymbolId> =
        independent.iter().copied().filter(|symbol| graph.depends_on(value, &[*symbol])).collect();
    let [velocity] = moving.as_slice() else { return None };
    let partial = graph.partial(value, *velocity);
    let rest = graph.at_zero(value, &[*velocity]);
    let is_multiple = !graph.depends_on(partial, &[*velocity]) && graph.vanishes_by_identity(rest);
    is_multiple.then_some((*velocity, partial))
}

/// Makes the derivatives of intermediate results known to a derivation, as further ones, whose names have
/// the suffix.
pub(super) fn differentiate_all(
    graph: &mut Graph,
    definitions: &mut Procedure,
    along: &mut Derivation,
    suffix: &str,
    simplified: bool,
) {
    for definition in definitions.definitions.clone() {
        if let Definition::Value { symbol, value } = definition {
            let mut change = along.apply(graph, value);
            if simplified {
                change = graph.simplify(change);
            }
            let name = format!("{}_{suffix}", graph.symbols()[symbol]);
            let change = definitions.define(graph, &name, change);
            along.insert(symbol, change);
        }
    }
}
