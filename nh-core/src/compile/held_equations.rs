//! The equations that a step can keep by itself, each with the direction in which it is corrected.

use super::on_request::{judge, state};
use super::proved::{Derived, Proved};
use crate::algebra::Matrix;
use crate::id::ExprId;
use crate::mechanics::{Procedure, SaddleEquations, saddle_equations};
use crate::phase_space::HeldEquations;

/// g: the position constraints and, where the state has all velocities, the constraints on these; ∂g by the state; and
/// directions R with ∂g R = 1 up to the slopes of velocity constraints by positions, mathematics (37): a position
/// constraint is corrected along ρ(w), one on velocities along w, with W w in the span of the rows of J, J w = 1 in its row.
pub(super) fn held_equations(proved: &mut Proved, derived: &Derived<'_>) -> HeldEquations {
    let arguments = state(proved, derived);
    let positions: Vec<ExprId> = proved.model.positions.iter().map(|position| position.value).collect();
    let residuals = proved.constraints.residuals.clone();
    let judge = judge(proved);
    let graph = &mut proved.model.graph;
    let (saddle, in_state, mut restriction) = match derived {
        Derived::Projected { equations, residuals } => ((*equations).clone(), residuals.to_vec(), None),
        Derived::Adapted { distribution, .. } => {
            let saddle = saddle_equations(graph, &proved.system, &residuals);
            let restriction = distribution.restriction(graph, &proved.system.algebroid.velocities);
            (saddle, Vec::new(), Some(restriction))
        }
    };
    let mut in_velocities = |graph: &mut _, matrix: &Matrix| -> Matrix {
        let Some(restriction) = &mut restriction else { return matrix.clone() };
        matrix.iter().map(|row| restriction.apply_all(graph, row)).collect()
    };
    let mass = in_velocities(graph, &saddle.mass);
    let jacobian = in_velocities(graph, &saddle.jacobian);
    let coordinates = proved.system.algebroid.anchor.coordinates.len();
    let mut map = Procedure::default();
    let (mut along_base, mut along_fibre) = (Matrix::new(), Matrix::new());
    for row in 0..positions.len().max(in_state.len()) {
        let mut bias = vec![graph.zero(); jacobian.len()];
        bias[row] = graph.one();
        let force = vec![graph.zero(); mass.len()];
        let equations = SaddleEquations {
            mass: mass.clone(),
            force,
            jacobian: jacobian.clone(),
            bias,
            rates: Vec::new(),
        };
        let (section, _) = equations.solve(graph, &judge, &mut map);
        if row < positions.len() {
            let mut direction = proved.system.algebroid.anchor.vector_field(graph, &section);
            direction.resize(arguments.len(), graph.zero());
            along_base.push(direction);
        }
        if row < in_state.len() {
            let mut direction = vec![graph.zero(); coordinates];
            direction.extend(section);
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
