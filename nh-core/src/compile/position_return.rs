//! The way back to position constraints.

use super::assembly::assembly;
use super::proved::Proved;
use crate::algebra::{Graph, Matrix, Substitution};
use crate::choose::cheapest;
use crate::geometry::Anchor;
use crate::id::{ExprId, SymbolId};
use crate::mechanics::{Definiteness, Procedure, SaddleEquations};
use crate::system::PositionReturn;

/// One Newton step x := x + ρ(δ), where δ makes δᵀWδ stationary under A δ = −f: mathematics (35). Where that does
/// not determine δ, the rows of the other constraints are added, Φ δ = 0. `None` without position constraints.
///
/// `restriction` gives all velocities from those in the state, where W depends on them; `states` are those, `velocity`
/// is all of them, and `residuals` are the constraints that they do not satisfy by themselves.
pub(super) fn position_return(
    proved: &mut Proved,
    saddle: &SaddleEquations,
    restriction: &mut Substitution,
    (states, velocity, residuals): (&[SymbolId], &[ExprId], &[ExprId]),
    judge: impl Fn(&Graph, &Matrix) -> Definiteness,
) -> Option<PositionReturn> {
    if proved.model.positions.is_empty() {
        return None;
    }
    let redundant = proved.positions.redundant.iter().map(|position| position.label.clone()).collect();
    let values: Vec<ExprId> = proved.model.positions.iter().map(|position| position.value).collect();
    let followers = proved.positions.redundant.iter().map(|position| position.value);
    let residual = Procedure::of(values.iter().copied().chain(followers).collect());
    let count = residual.outputs.len();
    let graph = &mut proved.model.graph;
    let mut equations = SaddleEquations {
        mass: saddle.mass.iter().map(|row| restriction.apply_all(graph, row)).collect(),
        force: vec![graph.zero(); saddle.mass.len()],
        jacobian: proved.positions.jacobian.clone(),
        bias: values.iter().map(|value| graph.formula(-*value)).collect(),
        rates: Vec::new(),
    };
    let matrix = equations.matrix(graph);
    let matrix = proved.positions.manifold.restrict_matrix(graph, &matrix);
    if graph.generic_rank(&matrix) != Ok(matrix.len()) {
        for row in saddle.jacobian.iter().skip(values.len()) {
            equations.jacobian.push(restriction.apply_all(graph, row));
            equations.bias.push(graph.zero());
        }
    }
    let step = step(graph, &equations, &proved.system.algebroid.anchor, &judge);
    let assembly = assembly(proved, (states, velocity), residuals);
    Some(PositionReturn {
        redundant,
        count,
        residual,
        step,
        pivots: Procedure::default(),
        assembly,
        slopes: None,
    })
}

/// ρ(δ), by (10), or along free directions where that is cheaper: its digits are those of a correction, which the next
/// one mends.
fn step(
    graph: &mut Graph,
    equations: &SaddleEquations,
    anchor: &Anchor,
    judge: &dyn Fn(&Graph, &Matrix) -> Definiteness,
) -> Procedure {
    let mut by_complement = Procedure::default();
    let (moves, _) = equations.solve(graph, judge, &mut by_complement);
    by_complement.outputs = anchor.vector_field(graph, &moves);
    let mut along = Procedure::default();
    let Some(moves) = equations.solve_along_free_directions(graph, judge, &mut along) else {
        return by_complement;
    };
    along.outputs = anchor.vector_field(graph, &moves);
    let mut ways = [by_complement, along];
    let cheapest = cheapest(graph, &ways);
    core::mem::take(&mut ways[cheapest])
}
