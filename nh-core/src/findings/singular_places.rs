//! Where the equations do not determine the accelerations, although they do in general.

use crate::algebra::{Demand, Graph};
use crate::check::{on_the_base, saddle_singular_where, singular_where, with_all_roots};
use crate::compile::{Derived, Proved};
use crate::id::{ExprId, SymbolId};

/// The states where a factor of the determinant of the equations vanishes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SingularPlace {
    /// The factor.
    pub(crate) factor: ExprId,
    /// Whether there are such states: real ones were found, where the constraints hold and parameters are as assumed. Of
    /// others it is not known.
    pub(crate) exists: bool,
}

/// Where the mass matrix, or that of the saddle equations, is singular; and the factors of determinants that are made of
/// parameters alone.
pub(super) fn found(proved: &mut Proved, derived: &Derived<'_>) -> (Vec<SingularPlace>, Vec<ExprId>) {
    let parameters: Vec<SymbolId> =
        proved.model.parameters.iter().map(|parameter| parameter.symbol).collect();
    let Proved { model, facts, .. } = &mut *proved;
    let (factors, of_parameters) = match derived {
        Derived::Adapted { equations, .. } => {
            singular_where(&mut model.graph, &equations.mass, &parameters, facts)
        }
        Derived::Projected { equations, .. } => {
            (saddle_singular_where(&mut model.graph, equations, &parameters, facts), Vec::new())
        }
    };
    if factors.is_empty() {
        return (Vec::new(), of_parameters);
    }
    let holding = holding(proved);
    let places = factors.into_iter().filter_map(|factor| place(proved, &holding, &parameters, factor));
    (places.collect(), of_parameters)
}

/// What every state satisfies.
fn holding(proved: &mut Proved) -> Vec<(ExprId, Demand)> {
    let mut holding = on_the_base(&mut proved.model);
    holding.extend(proved.model.positions.iter().map(|position| (position.value, Demand::Zero)));
    if proved.constraints.linear.is_none() {
        holding.extend(proved.constraints.residuals.iter().map(|residual| (*residual, Demand::Zero)));
    }
    holding
}

/// The place where a factor vanishes; `None` where it is proved that there is none.
fn place(
    proved: &mut Proved,
    holding: &[(ExprId, Demand)],
    parameters: &[SymbolId],
    factor: ExprId,
) -> Option<SingularPlace> {
    let Proved { model, facts, constraints, .. } = proved;
    let graph = &mut model.graph;
    let related = graph.related_demands(holding, &[factor]);
    // most do, and it is seen soon
    if related.is_empty() && graph.has_both_signs(factor, parameters) {
        return Some(SingularPlace { factor, exists: true });
    }
    let mut demands = related;
    demands.push((factor, Demand::Zero));
    if graph.contradiction(&demands).is_some() {
        return None;
    }
    let manifold = with_all_roots(model, &mut constraints.generic().clone(), &vec![vec![factor]]);
    let graph = &mut model.graph;
    let vanishes_nowhere = |graph: &mut Graph, value: ExprId| {
        let value = graph.simplify(value);
        graph.vanishes_nowhere(value, facts) || graph.has_no_zeros(value, facts)
    };
    let is_known = manifold.open_parts().is_empty() && !manifold.is_whole();
    let on_parts: Vec<ExprId> = manifold.parts().map(|part| part.restrict(graph, factor)).collect();
    if is_known && on_parts.into_iter().all(|value| vanishes_nowhere(graph, value)) {
        return None;
    }
    let exists = graph.real_point_is_found(&demands)
        || manifold.parts().any(|part| {
            let demands = part.demands(graph, &demands);
            graph.real_point_is_found(&demands)
        });
    Some(SingularPlace { factor, exists })
}
