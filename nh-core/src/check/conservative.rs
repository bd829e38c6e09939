//! Whether the energy is conserved, term by term of mathematics (41):
//! dE_L/dt = Υ_α y^α + λ_A y^α ∂φ^A/∂y^α − ∂_tL (CLMM Theorems 3.4, 7.6).

use super::constraints::Constraints;
use super::evidence::shown;
use crate::geometry::Clock;
use crate::id::ExprId;
use crate::mechanics::{LagrangianSystem, fibre_derivative};
use crate::model::Model;

/// What keeps the energy from being conserved, in words; `None` if every term of its rate vanishes.
pub fn not_conservative(
    model: &mut Model,
    system: &LagrangianSystem,
    constraints: &Constraints,
) -> Option<String> {
    let graph = &mut model.graph;
    // 1. ∂_tL
    let change = graph.partial(system.lagrangian, system.clock.time);
    if !constraints.generic().zero_test(graph, change).is_zero() {
        return Some(format!("the Lagrangian depends on the time: its rate is {}", shown(graph, change)));
    }
    // 2. Υ
    let on_distribution = system.forces_on_distribution.iter().map(|(_, value)| *value);
    let forces: Vec<ExprId> = system.forces.iter().copied().chain(on_distribution).collect();
    if let Some(force) =
        forces.iter().find(|force| !constraints.generic().zero_test(graph, **force).is_zero())
    {
        return Some(format!("a force acts: {}", shown(graph, *force)));
    }
    // 3. y^α ∂φ^A/∂y^α, which is −b^A where φ^A = 0 is affine
    for (index, residual) in constraints.residuals.iter().enumerate() {
        let power = if let Some(linear) = &constraints.linear {
            linear.drift[index]
        } else {
            fibre_derivative(graph, *residual, &system.algebroid.velocities)
        };
        if !constraints.generic().zero_test(graph, power).is_zero() {
            let text = shown(graph, *residual);
            return Some(format!(
                "the constraint {text} = 0 is not homogeneous in the velocities: it does work"
            ));
        }
    }
    None
}

/// The constraint that depends on the time or an auxiliary state, in words: then the motion is not that of the bracket with
/// the energy, even where it is conserved, mathematics (28).
pub fn moving_constraint(model: &mut Model, clock: &Clock, constraints: &Constraints) -> Option<String> {
    let graph = &mut model.graph;
    constraints.residuals.iter().find_map(|residual| {
        let mover = clock.symbols().into_iter().find(|symbol| {
            let change = graph.partial(*residual, *symbol);
            !constraints.generic().zero_test(graph, change).is_zero()
        })?;
        let on = match &graph.symbols()[mover] {
            _ if mover == clock.time => "the time".to_owned(),
            name => format!("the auxiliary state `{name}`"),
        };
        Some(format!("the constraint {} = 0 depends on {on}", shown(graph, *residual)))
    })
}
