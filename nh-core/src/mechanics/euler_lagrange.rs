//! The Euler–Lagrange side of the equations: momenta and the force balance without ẏ.

use super::procedure::Procedure;
use crate::algebra::{Derivation, Graph, Node, Substitution};
use crate::geometry::{Algebroid, Clock};
use crate::id::{ExprId, SymbolId};

/// A Lagrangian system on an algebroid, before constraints.
#[derive(Clone, Debug)]
pub struct LagrangianSystem {
    /// E with its anchor and bracket.
    pub algebroid: Algebroid,
    /// L(t, x, y).
    pub lagrangian: ExprId,
    /// The generalized force Υ_α(t, x, y, u), a component for each section.
    pub forces: Vec<ExprId>,
    /// Forces along sections that span D, by their velocities: they act on D alone.
    pub forces_on_distribution: Vec<(SymbolId, ExprId)>,
    /// The time t and auxiliary states.
    pub clock: Clock,
}

/// The Euler–Lagrange equations along curves with velocity `ŷ(t, x, v)`:
/// `d/dt p_α |_{v̇ = 0} + C^γ_{αβ} ŷ^β p_γ − ρ^i_α ∂_iL − Υ_α`, and the momenta.
#[derive(Clone, Debug)]
pub struct ForceBalance {
    /// p_α = ∂L/∂y^α at y = ŷ.
    pub momenta: Vec<ExprId>,
    /// What is left of δL_α − Υ_α when the terms with v̇ are taken away.
    pub rest: Vec<ExprId>,
}

impl LagrangianSystem {
    /// Whether no force acts.
    #[must_use]
    pub fn is_free(&self, graph: &Graph) -> bool {
        let on_distribution = self.forces_on_distribution.iter().map(|(_, value)| value);
        self.forces.iter().chain(on_distribution).all(|force| graph.zero_test(*force).is_zero())
    }

    /// The forces along the section that spans D with a velocity.
    pub fn forces_along(&self, velocity: SymbolId) -> impl Iterator<Item = ExprId> {
        let along = self.forces_on_distribution.iter().filter(move |(direction, _)| *direction == velocity);
        along.map(|(_, force)| *force)
    }

    /// p_α = ∂L/∂y^α.
    pub fn momenta(&self, graph: &mut Graph) -> Vec<ExprId> {
        self.algebroid
            .velocities
            .iter()
            .map(|velocity| {
                let momentum = graph.partial(self.lagrangian, *velocity);
                graph.simplify(momentum)
            })
            .collect()
    }

    /// ∂_iL.
    fn base_gradient(&self, graph: &mut Graph) -> Vec<ExprId> {
        let coordinates = self.algebroid.anchor.coordinates.clone();
        coordinates.iter().map(|symbol| graph.partial(self.lagrangian, *symbol)).collect()
    }

    /// The force balance on curves whose velocity is `velocity`; `restriction` puts that velocity
    /// into functions on E. Mathematics (6) and (8), CLMM (2.7).
    pub fn force_balance(
        &self,
        graph: &mut Graph,
        velocity: &[ExprId],
        restriction: &mut Substitution,
    ) -> ForceBalance {
        self.force_balance_by(graph, velocity, restriction, &mut Procedure::inline())
    }

    /// The same with momenta that are sums as intermediate results of the procedure where C^γ_{αβ} y^β p_γ
    /// contains them.
    pub(super) fn force_balance_by(
        &self,
        graph: &mut Graph,
        velocity: &[ExprId],
        restriction: &mut Substitution,
        names: &mut Procedure,
    ) -> ForceBalance {
        let momenta = self.momenta(graph);
        let momenta = restriction.apply_all(graph, &momenta);
        let gradient = self.base_gradient(graph);
        let gradient = restriction.apply_all(graph, &gradient);

        // 1. ρ^i_β y^β ∂p_α/∂x^i + ∂p_α/∂t + ż ∂p_α/∂z
        let mut along: Derivation = self.algebroid.along(graph, velocity, &self.clock);
        let drift = along.apply_all(graph, &momenta);
        // 2. C^γ_{αβ} y^β p_γ
        let named: Vec<ExprId> = momenta
            .iter()
            .zip(&self.algebroid.velocities)
            .map(|(momentum, symbol)| match graph.node(*momentum) {
                Node::Sum { .. } => {
                    let name = format!("momentum_{}", graph.symbols()[*symbol]);
                    names.define(graph, &name, *momentum)
                }
                _ => *momentum,
            })
            .collect();
        let bracket = self.algebroid.structure.bracket_term(graph, velocity, &named);
        // 3. ρ^i_α ∂_iL
        let potential = self.algebroid.anchor.pull_back(graph, &gradient);
        // 4. Υ_α
        let forces = restriction.apply_all(graph, &self.forces);

        let rest = (0..momenta.len())
            .map(|alpha| {
                graph.linear_combination(&[
                    (1.into(), drift[alpha]),
                    (1.into(), bracket[alpha]),
                    ((-1).into(), potential[alpha]),
                    ((-1).into(), forces[alpha]),
                ])
            })
            .collect();
        ForceBalance { momenta, rest }
    }
}
