//! Where the equations do not determine the accelerations, although they do in general.

use super::has_turns;
use crate::algebra::{Demand, Graph};
use crate::check::{
    changes_signature, is_sum_of_squares, on_the_base, saddle_singular_where, singular_where, with_all_roots,
    with_positive,
};
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

/// Rows of the equations that hang together, with a determinant that is too long to be written out and varies with the
/// state.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LongBlock {
    /// How many they are.
    pub(crate) rows: usize,
    /// Whether they are singular in some states of some machine.
    pub(crate) is_singular: bool,
}

/// Rows of a block up to which the signs of its eigenvalues are looked at.
const ROWS: usize = 8;

/// What is known of where the equations are singular.
#[derive(Clone, Debug)]
pub(crate) struct SingularPlaces {
    /// Where the mass matrix is, or that of the saddle equations.
    pub(crate) places: Vec<SingularPlace>,
    /// The factors of determinants that are made of parameters alone.
    pub(crate) of_parameters: Vec<ExprId>,
    /// What was not looked at in this way.
    pub(crate) long: Vec<LongBlock>,
}

/// Where the mass matrix, or that of the saddle equations, is singular, of equations that have values everywhere or not.
pub(super) fn found(proved: &mut Proved, derived: &Derived<'_>, has_values: bool) -> SingularPlaces {
    let parameters: Vec<SymbolId> =
        proved.model.parameters.iter().map(|parameter| parameter.symbol).collect();
    let Proved { model, facts, system, .. } = &mut *proved;
    let graph = &mut model.graph;
    let found = match derived {
        Derived::Adapted { equations, .. } => singular_where(graph, &equations.mass, &parameters, facts),
        Derived::Projected { equations, .. } => saddle_singular_where(graph, equations, &parameters, facts),
    };
    let usual = with_positive(facts, &parameters);
    let (lagrangian, velocities) = (system.lagrangian, &system.algebroid.velocities);
    // 1. what is continuous in states that are connected, and may have another signature elsewhere
    let matrix = match derived {
        Derived::Adapted { equations, .. }
            if has_values
                && found.long.iter().any(|block| block.len() <= ROWS)
                && !is_sum_of_squares(graph, lagrangian, velocities, &usual)
                && !has_turns(graph, lagrangian)
                && holding(proved).is_empty() =>
        {
            Some(&equations.mass)
        }
        _ => None,
    };
    let Proved { model, facts, .. } = &*proved;
    let is_singular = |block: &Vec<usize>| {
        let matrix = matrix.filter(|_| block.len() <= ROWS);
        let inner = matrix.map(|matrix| Graph::submatrix(matrix, block));
        inner.is_some_and(|inner| changes_signature(&model.graph, &inner, &parameters, facts))
    };
    let blocks = found.long.iter();
    let long = blocks.map(|block| LongBlock { rows: block.len(), is_singular: is_singular(block) }).collect();
    // 2. factors of short determinants
    if found.varying.is_empty() {
        return SingularPlaces { places: Vec::new(), of_parameters: found.of_parameters, long };
    }
    let holding = holding(proved);
    let places = found.varying.into_iter().filter_map(|factor| place(proved, &holding, &parameters, factor));
    SingularPlaces { places: places.collect(), of_parameters: found.of_parameters, long }
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
    // what images divide by may vanish where the constraints hold, on a part that no chart reaches
    let images = manifold.parts().flat_map(|part| part.images().iter().map(|(_, image)| *image));
    let images: Vec<ExprId> = images.collect();
    let is_reached = graph.divisors(&images).into_iter().all(|divisor| {
        let left_out = [demands.as_slice(), &[(divisor, Demand::Zero)]].concat();
        vanishes_nowhere(graph, divisor) || graph.contradiction(&left_out).is_some()
    });
    let is_known = manifold.open_parts().is_empty() && !manifold.is_whole() && is_reached;
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
