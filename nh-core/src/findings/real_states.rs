//! Whether real states are known at all that satisfy what is declared.

use crate::algebra::Demand;
use crate::check::on_the_base;
use crate::compile::Proved;
use crate::id::ExprId;

/// Whether no real positions and velocities were found that satisfy identities, position constraints and nonlinear
/// constraints, for parameters as they are assumed. Nothing contradicts them then, and they are accepted undecided.
pub(super) fn undecided(proved: &mut Proved) -> bool {
    let Proved { model, positions, constraints, .. } = proved;
    let nonlinear = if constraints.linear.is_none() { constraints.residuals.as_slice() } else { &[] };
    let equations: Vec<ExprId> = positions.values.iter().chain(nonlinear).copied().collect();
    if equations.is_empty() && model.identities.is_empty() {
        return false;
    }
    let mut demands = on_the_base(model);
    demands.extend(equations.into_iter().map(|equation| (equation, Demand::Zero)));
    let graph = &mut model.graph;
    // what is solved for is found where a search does not come near, as a single value is
    !graph.real_point_is_found(&demands)
        && !constraints.generic().parts().any(|part| {
            let demands = part.demands(graph, &demands);
            graph.real_point_is_found(&demands)
        })
}
