//! What assembling a machine from a rough start solves.

use super::proved::Proved;
use crate::algebra::{Graph, Matrix};
use crate::id::{ExprId, SymbolId};
use crate::mechanics::Procedure;
use crate::system::{Assembly, Linearized};

/// The equations of positions by the coordinates, and those of velocities with the rates of the coordinates by the
/// velocities of the state: mathematics (35).
///
/// `velocity` gives all velocities from those in the state, `residuals` are the constraints on these.
pub(super) fn assembly(
    proved: &mut Proved,
    (states, velocity): (&[SymbolId], &[ExprId]),
    residuals: &[ExprId],
) -> Assembly {
    let model = &mut proved.model;
    let coordinates: Vec<SymbolId> = model.coordinates.iter().map(|coordinate| coordinate.symbol).collect();
    let functions: Vec<ExprId> = model.identities.iter().map(|identity| identity.value).collect();
    let gradients = slopes(&mut model.graph, &functions, &coordinates);
    let identities = proved.base.independent_rows(&mut model.graph, &gradients).unwrap_or_default();
    let declared = model.positions.iter().map(|position| position.value);
    let mut equations: Vec<ExprId> = declared.collect();
    equations.extend(identities.iter().map(|index| functions[*index]));
    let independent = equations.len();
    equations.extend(proved.positions.redundant.iter().map(|position| position.value));
    let rates = proved.system.algebroid.anchor.vector_field(&mut model.graph, velocity);
    let motion: Vec<ExprId> = residuals.iter().copied().chain(rates).collect();
    Assembly {
        identities,
        independent,
        positions: linearized(&mut model.graph, &equations, &coordinates),
        constraints: residuals.len(),
        velocities: linearized(&mut model.graph, &motion, states),
    }
}

fn linearized(graph: &mut Graph, values: &[ExprId], by: &[SymbolId]) -> Linearized {
    let slopes = slopes(graph, values, by);
    let outputs = values.iter().copied().chain(slopes.into_iter().flatten()).collect();
    Linearized { rows: values.len(), by: by.to_vec(), procedure: Procedure::of(outputs) }
}

fn slopes(graph: &mut Graph, values: &[ExprId], by: &[SymbolId]) -> Matrix {
    let row = |value: &ExprId| by.iter().map(|symbol| graph.partial(*value, *symbol)).collect();
    values.iter().map(row).collect()
}
