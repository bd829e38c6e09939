//! The equations by the Gibbs–Appell function, CNS (17): another derivation of the same equations.

use super::euler_lagrange::LagrangianSystem;
use super::projected::saddle_equations;
use crate::algebra::{Derivation, Graph, Matrix, Substitution};
use crate::id::{ExprId, SymbolId};

/// The function of the accelerations that the motion makes stationary.
///
/// With the free acceleration F, W F + h = 0, the Gibbs–Appell function is ½ (ẏ−F)ᵀ W (ẏ−F). Here it
/// stands without the term ½ FᵀWF, in which no acceleration occurs, and with the forces:
/// `½ ẏᵀ W ẏ + (h − Υ)ᵀ ẏ`, so that W need not be invertible. On the constraint manifold, with
/// y = ŷ(t, x, v) and its time derivative, ∂/∂v̇^a = 0 are the equations of motion.
#[derive(Clone, Debug)]
pub struct GibbsAppell {
    /// The function.
    pub function: ExprId,
    /// The accelerations v̇ that occur in it.
    pub accelerations: Vec<SymbolId>,
    /// ẋ^i = ρ^i_α ŷ^α.
    pub rates: Vec<ExprId>,
}

impl GibbsAppell {
    /// On curves with the velocity `velocity`, a function of (t, x) and the `independent` velocities;
    /// `restriction` puts it into functions on E.
    pub fn of(
        graph: &mut Graph,
        system: &LagrangianSystem,
        velocity: &[ExprId],
        independent: &[SymbolId],
        restriction: &mut Substitution,
    ) -> Self {
        // 1. W and h − Υ on E, then at y = ŷ
        let free = saddle_equations(graph, system, &[]);
        let mass: Matrix = free.mass.iter().map(|row| restriction.apply_all(graph, row)).collect();
        let force = restriction.apply_all(graph, &free.force);
        // 2. ẏ = dŷ/dt, with symbols for v̇
        let mut accelerations = Vec::new();
        for symbol in independent {
            let name = format!("{}_dot", graph.symbols()[*symbol]);
            accelerations.push(graph.new_symbol(name));
        }
        let rates = system.algebroid.rates(graph, velocity);
        let clock = system.clock.rates(graph);
        let along: Vec<ExprId> = accelerations.iter().map(|symbol| graph.symbol(*symbol)).collect();
        let coordinates = system.algebroid.anchor.coordinates.iter().copied();
        let seeds = coordinates.zip(rates.iter().copied()).chain(independent.iter().copied().zip(along));
        let mut time_derivative = Derivation::new(seeds.chain(clock));
        let acceleration = time_derivative.apply_all(graph, velocity);
        // 3. ½ ẏᵀ W ẏ + (h − Υ)ᵀ ẏ
        let inertia = graph.image(&mass, &acceleration);
        let (quadratic, work) =
            (graph.inner_product(&acceleration, &inertia), graph.inner_product(&force, &acceleration));
        let half = graph.scale(crate::algebra::Rational::new(1, 2), quadratic);
        let mut function = graph.formula(half - work);
        // forces along the sections that span D act on their accelerations
        for (direction, value) in &system.forces_on_distribution {
            if let Some(index) = independent.iter().position(|symbol| symbol == direction) {
                let value = restriction.apply(graph, *value);
                let acceleration = graph.symbol(accelerations[index]);
                function = graph.formula(function - value * acceleration);
            }
        }
        Self { function, accelerations, rates }
    }

    /// `mass · v̇ = force`: the derivatives of the function by v̇ vanish.
    pub fn equations(&self, graph: &mut Graph) -> (Matrix, Vec<ExprId>) {
        let (mut mass, mut force) = (Matrix::new(), Vec::new());
        for symbol in &self.accelerations {
            let slope = graph.partial(self.function, *symbol);
            mass.push(self.accelerations.iter().map(|other| graph.partial(slope, *other)).collect());
            let rest = graph.at_zero(slope, &self.accelerations);
            force.push(graph.formula(-rest));
        }
        (mass, force)
    }
}
