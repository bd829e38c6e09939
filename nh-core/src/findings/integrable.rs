//! Whether constraints on velocities are the rates of equations between positions.

use super::Closure;
use crate::algebra::Matrix;
use crate::compile::Proved;
use crate::geometry::Involution;
use crate::id::SymbolId;

/// Whether constraints on velocities say what equations between positions would.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Integrable {
    /// They are the rates of such equations.
    Yes,
    /// They are not, or that is not known.
    NotKnown,
}

/// Whether they are.
pub(super) fn found(proved: &mut Proved, closure: Option<Closure>) -> Integrable {
    if are_rates_of_positions(proved, closure) { Integrable::Yes } else { Integrable::NotKnown }
}

/// That the constraints on velocities can be written as position constraints: D is closed, and all rows are differentials of
/// functions on the base. A row of its own on the kernel of the anchor is the rate of no position: a body that turns about one
/// axis has no angle in the base. Nor has one with an auxiliary state an equation between positions, as `der(x) = rate`.
fn are_rates_of_positions(proved: &mut Proved, closure: Option<Closure>) -> bool {
    let Proved { model, system, constraints, broken_laws, .. } = proved;
    let of_velocities = model.constraints.len() > model.positions.len()
        && model.distribution.is_none()
        && model.routh.is_empty();
    let closed =
        broken_laws.homomorphism.is_none() && matches!(closure, Some(Closure::Decided(Involution::Closed)));
    let Some(linear) = &constraints.linear else { return false };
    let states: Vec<SymbolId> = system.clock.auxiliary.iter().map(|(state, _)| *state).collect();
    let graph = &mut model.graph;
    let with_states = constraints.residuals.iter().any(|residual| graph.depends_on(*residual, &states));
    if !of_velocities || !closed || with_states {
        return false;
    }
    // every row is a differential where the velocities are those of the coordinates
    let anchor = &system.algebroid.anchor.entries;
    if *anchor == graph.identity(system.algebroid.rank()) {
        return true;
    }
    let with_rows: Matrix = anchor.iter().chain(&linear.annihilator).cloned().collect();
    constraints.base().parts().all(|part| {
        let [alone, together] = [anchor, &with_rows].map(|rows| {
            let restricted = part.restrict_matrix(graph, rows);
            graph.generic_rank(&restricted)
        });
        alone.is_ok() && alone == together
    })
}
