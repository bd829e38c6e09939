//! The equations that a step can keep by itself, each with the direction in which it is corrected.

use super::on_request::{judge_beside, whole_state};
use super::proved::{Derived, Proved};
use crate::algebra::{Graph, Matrix};
use crate::geometry::ConstraintDistribution;
use crate::id::ExprId;
use crate::mechanics::{Definiteness, Procedure, SaddleEquations, saddle_equations};
use crate::phase_space::HeldEquations;

/// g: the position constraints and, where the state has all velocities, the constraints on these; ∂g by the state; and
/// directions R with ∂g R = 1 up to the slopes of velocity constraints by positions, mathematics (37): a position
/// constraint is corrected along ρ(w), one on velocities along w, with W w in the span of the rows of J, J w = 1 in its row.
pub(super) fn held_equations(proved: &mut Proved, derived: &Derived<'_>) -> HeldEquations {
    let arguments = whole_state(proved, derived);
    let positions: Vec<ExprId> = proved.model.positions.iter().map(|position| position.value).collect();
    let residuals = proved.constraints.residuals.clone();
    let judge = judge_beside(proved);
    let graph = &mut proved.model.graph;
    let (mut map, mut along_base, mut along_fibre) = (Procedure::default(), Matrix::new(), Matrix::new());
    let (in_state, sections) = match derived {
        Derived::Projected { equations, residuals } => {
            let count = positions.len().max(residuals.len());
            let sections: Matrix =
                (0..count).map(|row| section_on_all(graph, equations, row, &judge, &mut map)).collect();
            (residuals.to_vec(), sections)
        }
        // the velocities of the state satisfy the constraints on velocities by themselves
        Derived::Adapted { .. } if positions.is_empty() => (Vec::new(), Matrix::new()),
        Derived::Adapted { distribution, .. } => {
            let saddle = saddle_equations(graph, &proved.system, &residuals);
            let mut restriction = distribution.restriction(graph, &proved.system.algebroid.velocities);
            let mass: Matrix = saddle.mass.iter().map(|row| restriction.apply_all(graph, row)).collect();
            let lifts = distribution.lifts(graph);
            let sections = lifts
                .iter()
                .take(positions.len())
                .map(|lift| section_beside(graph, distribution, (&mass, lift), &judge, &mut map));
            (Vec::new(), sections.collect())
        }
    };
    let coordinates = proved.system.algebroid.anchor.coordinates.len();
    for (row, section) in sections.into_iter().enumerate() {
        if row < positions.len() {
            let mut direction = proved.system.algebroid.anchor.vector_field(graph, &section);
            direction.resize(arguments.len(), graph.zero());
            along_base.push(direction);
        }
        if row < in_state.len() {
            let mut direction = vec![graph.zero(); coordinates];
            direction.extend(section);
            // auxiliary states stay where they are
            direction.resize(arguments.len(), graph.zero());
            along_fibre.push(direction);
        }
    }
    let values: Vec<ExprId> = positions.into_iter().chain(in_state).collect();
    let mut gradients = Vec::new();
    for value in &values {
        for argument in &arguments {
            let slope = graph.partial(*value, *argument);
            gradients.push(graph.simplify(slope));
        }
    }
    let directions = along_base.into_iter().chain(along_fibre).flatten();
    map.outputs = values.iter().copied().chain(gradients).chain(directions).collect();
    HeldEquations { functions: values, map }
}

/// w by multipliers.
fn section_on_all(
    graph: &mut Graph,
    equations: &SaddleEquations,
    row: usize,
    judge: impl Fn(&Graph, &Matrix) -> Definiteness,
    map: &mut Procedure,
) -> Vec<ExprId> {
    let mut bias = vec![graph.zero(); equations.jacobian.len()];
    bias[row] = graph.one();
    let force = vec![graph.zero(); equations.mass.len()];
    SaddleEquations { force, bias, rates: Vec::new(), ..equations.clone() }.solve(graph, judge, map).0
}

/// w = l + B a with J l = 1 in its row and Bᵀ W w = 0: W is asked on D alone, as by the motion, for which bodies
/// without inertia may be carried along.
fn section_beside(
    graph: &mut Graph,
    distribution: &ConstraintDistribution,
    (mass, lift): (&Matrix, &[ExprId]),
    judge: impl Fn(&Graph, &Matrix) -> Definiteness,
    map: &mut Procedure,
) -> Vec<ExprId> {
    let sections = distribution.sections();
    let mut metric = Matrix::new();
    for section in &sections {
        let momentum = graph.image(mass, section);
        let row = graph.image(&sections, &momentum);
        metric.push(row.into_iter().map(|entry| graph.simplify(entry)).collect());
    }
    let momentum = graph.image(mass, lift);
    let along = graph.image(&sections, &momentum);
    let force = along.into_iter().map(|entry| graph.formula(-entry)).collect();
    let (jacobian, bias, rates) = Default::default();
    let (moves, _) = SaddleEquations { mass: metric, force, jacobian, bias, rates }.solve(graph, judge, map);
    let back = graph.image(&distribution.basis, &moves);
    lift.iter().zip(back).map(|(lift, back)| graph.formula(lift + back)).collect()
}
