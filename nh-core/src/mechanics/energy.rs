//! The energy E_L = y^α ∂L/∂y^α − L.

use super::euler_lagrange::LagrangianSystem;
use crate::algebra::{Graph, Rational};
use crate::id::{ExprId, SymbolId};

/// E_L, summand by summand: a summand homogeneous of degree d in the velocities contributes
/// (d − 1) times itself (Euler's theorem), so that no difference of equal terms is ever computed.
pub fn energy(graph: &mut Graph, system: &LagrangianSystem) -> ExprId {
    let velocities = system.algebroid.velocities.clone();
    let one = graph.one();
    let (constant, terms) = graph.as_linear(system.lagrangian);
    let mut summands = vec![(-constant, one)];
    for (term, coefficient) in terms {
        let fibre = fibre_derivative(graph, term, &velocities);
        if let Some(degree) = degree(graph, term, fibre) {
            summands.push((coefficient * Rational::from(degree - 1), term));
        } else {
            summands.push((coefficient.clone(), fibre));
            summands.push((-coefficient, term));
        }
    }
    graph.linear_combination(&summands)
}

/// y^α ∂f/∂y^α, the derivative along the fibre.
pub fn fibre_derivative(graph: &mut Graph, function: ExprId, velocities: &[SymbolId]) -> ExprId {
    let summands: Vec<ExprId> = velocities
        .iter()
        .map(|symbol| {
            let partial = graph.partial(function, *symbol);
            let velocity = graph.symbol(*symbol);
            graph.formula(velocity * partial)
        })
        .collect();
    graph.sum(&summands)
}

/// The degree d with `y ∂f/∂y = d f`, for the small d that occur.
fn degree(graph: &mut Graph, function: ExprId, fibre: ExprId) -> Option<i64> {
    [2, 0, 1, 4, 3].into_iter().find(|degree| {
        let defect = graph.linear_combination(&[(1.into(), fibre), (Rational::from(-*degree), function)]);
        graph.vanishes_by_identity(defect)
    })
}
