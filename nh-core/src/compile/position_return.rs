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
/// is all of them, and `residuals` are the constraints that they do not satisfy by themselves. `rates` are the equations
/// of a change of velocities that satisfies these.
pub(super) fn position_return(
    proved: &mut Proved,
    (saddle, rates): (&SaddleEquations, Option<SaddleEquations>),
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
    let (way, step) = step(graph, &equations, &proved.system.algebroid.anchor, &judge);
    let velocities = rates.map(|rates| way.solution(graph, &rates, &judge));
    let assembly = assembly(proved, (states, velocity), residuals);
    let pivots = Procedure::default();
    Some(PositionReturn { redundant, count, residual, step, velocities, pivots, assembly, slopes: None })
}

/// ρ(δ), and the way that takes least.
fn step(
    graph: &mut Graph,
    equations: &SaddleEquations,
    anchor: &Anchor,
    judge: &dyn Fn(&Graph, &Matrix) -> Definiteness,
) -> (Way, Procedure) {
    let mut by_complement = Way::ByComplement.solution(graph, equations, judge);
    by_complement.outputs = anchor.vector_field(graph, &by_complement.outputs);
    let mut along = Procedure::default();
    let Some(moves) = equations.solve_along_free_directions(graph, judge, &mut along) else {
        return (Way::ByComplement, by_complement);
    };
    along.outputs = anchor.vector_field(graph, &moves);
    let mut steps = [by_complement, along];
    let cheapest = cheapest(graph, &steps);
    ([Way::ByComplement, Way::AlongFreeDirections][cheapest], core::mem::take(&mut steps[cheapest]))
}

/// How (9) is solved for a correction, whose digits the next one mends. Changes of positions and of velocities that are
/// found in one way share what they are divided by where they are computed at one place.
#[derive(Clone, Copy)]
enum Way {
    /// By (10).
    ByComplement,
    /// Where there are any.
    AlongFreeDirections,
}

impl Way {
    fn solution(
        self,
        graph: &mut Graph,
        equations: &SaddleEquations,
        judge: &dyn Fn(&Graph, &Matrix) -> Definiteness,
    ) -> Procedure {
        let mut solution = Procedure::default();
        let along = match self {
            Self::ByComplement => None,
            Self::AlongFreeDirections => equations.solve_along_free_directions(graph, judge, &mut solution),
        };
        solution.outputs = along.unwrap_or_else(|| equations.solve(graph, judge, &mut solution).0);
        solution
    }
}
