//! Lagrange–d'Alembert equations in a basis of D: mathematics (8), CLMM (3.5) and (3.7).

use super::euler_lagrange::LagrangianSystem;
use super::procedure::{Definition, Procedure};
use crate::algebra::{Graph, Matrix};
use crate::count::Count;
use crate::geometry::ConstraintDistribution;
use crate::id::{ExprId, SymbolId};

/// `mass · v̇ = force` in the velocities v of D.
#[derive(Clone, Debug)]
pub struct ReducedEquations {
    /// Intermediate results of the following.
    pub definitions: Procedure,
    /// C_{ab} = B^α_a W_{αβ} B^β_b.
    pub mass: Matrix,
    /// −B^α_a ( W (Ḃ v + ẏ₀) + h − Υ )_α.
    pub force: Vec<ExprId>,
    /// ẋ^i = ρ^i_α (B v + y₀)^α.
    pub rates: Vec<ExprId>,
    /// y = B v + y₀.
    pub velocity: Vec<ExprId>,
    /// The velocities v.
    pub independent: Vec<SymbolId>,
}

impl ReducedEquations {
    /// The work of evaluating all parts before anything is solved, as [`Graph::operation_count`].
    #[must_use]
    pub fn length(&self, graph: &Graph) -> Count {
        let mut parts = self.definitions.values(graph);
        parts.extend(self.mass.iter().flatten().chain(&self.force).chain(&self.rates));
        graph.operation_count(&parts)
    }
}

/// Derives the equations.
///
/// The momenta are restricted to the constraint manifold first, p̂_α(t, x, v) = p_α(t, x, Bv + y₀).
/// Then d/dt p̂_α holds every term of (8): ∂p̂_α/∂v^b v̇^b = W_{αβ} B^β_b v̇^b, and the derivative of
/// p̂ along the full ẋ at fixed v is W (Ḃ v + ẏ₀) together with the first term of h.
pub fn reduced_equations(
    graph: &mut Graph,
    system: &LagrangianSystem,
    distribution: &ConstraintDistribution,
) -> ReducedEquations {
    reduced_equations_by(graph, system, distribution, &mut Procedure::inline())
}

/// The equations with momenta as intermediate results where brackets turn them: C^γ_{αβ} y^β p_γ of a body with
/// wheels, or in a fluid, is longer in differences of inertias. `None` where no bracket contains a momentum with
/// several terms.
pub fn equations_by_momenta(
    graph: &mut Graph,
    system: &LagrangianSystem,
    distribution: &ConstraintDistribution,
) -> Option<ReducedEquations> {
    let mut definitions = Procedure::default();
    let equations = reduced_equations_by(graph, system, distribution, &mut definitions);
    let mut names = definitions.definitions.iter().filter_map(|definition| match definition {
        Definition::Value { symbol, .. } => Some(*symbol),
        _ => None,
    });
    let is_used = names.any(|name| equations.force.iter().any(|force| graph.depends_on(*force, &[name])));
    is_used.then_some(ReducedEquations { definitions, ..equations })
}

fn reduced_equations_by(
    graph: &mut Graph,
    system: &LagrangianSystem,
    distribution: &ConstraintDistribution,
    names: &mut Procedure,
) -> ReducedEquations {
    let velocities = &system.algebroid.velocities;
    let velocity = distribution.velocity.clone();
    let mut restriction = distribution.restriction(graph, velocities);
    let balance = system.force_balance_by(graph, &velocity, &mut restriction, names);
    let independent = distribution.independent.clone();

    // ∂p̂_α/∂v^b
    let mut inertia: Matrix = Vec::with_capacity(independent.len());
    for symbol in &independent {
        inertia.push(balance.momenta.iter().map(|p| graph.partial(*p, *symbol)).collect());
    }
    let sections = distribution.sections();
    let mut mass: Matrix = Vec::with_capacity(sections.len());
    for (a, section) in sections.iter().enumerate() {
        // C is symmetric: the lower triangle repeats the upper
        let row: Vec<ExprId> = (0..inertia.len())
            .map(|b| {
                if b < a {
                    return mass[b][a];
                }
                let entry = graph.inner_product(section, &inertia[b]);
                graph.simplify(entry)
            })
            .collect();
        mass.push(row);
    }
    let mut force: Vec<ExprId> = Vec::with_capacity(sections.len());
    for (section, symbol) in sections.iter().zip(&independent) {
        let projected = graph.inner_product(section, &balance.rest);
        let mut along = graph.formula(-projected);
        for value in system.forces_along(*symbol) {
            let value = restriction.apply(graph, value);
            along = graph.formula(along + value);
        }
        force.push(graph.simplify(along));
    }
    let rates = system.algebroid.rates(graph, &velocity);
    let rates = rates.into_iter().map(|rate| graph.simplify(rate)).collect();
    let definitions = Procedure::default();
    ReducedEquations { definitions, mass, force, rates, velocity, independent }
}

/// δL_α − Υ_α on D at given accelerations v̇: the force with which the constraints act along each
/// section, mathematics (7).
pub fn reaction_forces(
    graph: &mut Graph,
    system: &LagrangianSystem,
    distribution: &ConstraintDistribution,
    accelerations: &[ExprId],
) -> Vec<ExprId> {
    let mut restriction = distribution.restriction(graph, &system.algebroid.velocities);
    let balance = system.force_balance(graph, &distribution.velocity, &mut restriction);
    balance
        .momenta
        .iter()
        .zip(&balance.rest)
        .map(|(momentum, rest)| {
            let mut total = vec![*rest];
            for (symbol, acceleration) in distribution.independent.iter().zip(accelerations) {
                let inertia = graph.partial(*momentum, *symbol);
                total.push(graph.formula(inertia * acceleration));
            }
            graph.sum(&total)
        })
        .collect()
}
