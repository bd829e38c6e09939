//! A Lie algebroid in local coordinates, and the brackets of its sections.

use super::anchor::Anchor;
use super::clock::Clock;
use super::structure::StructureFunctions;
use crate::algebra::{Derivation, Graph};
use crate::id::{ExprId, Id, SectionId, SymbolId};

/// A vector bundle E → M with an anchor and a bracket, whose laws have been proved.
#[derive(Clone, Debug)]
pub struct Algebroid {
    /// ρ.
    pub anchor: Anchor,
    /// C.
    pub structure: StructureFunctions,
    /// The quasi-velocities y^α.
    pub velocities: Vec<SymbolId>,
}

impl Algebroid {
    /// The rank s of E.
    #[must_use]
    pub fn rank(&self) -> usize {
        self.velocities.len()
    }

    /// The sections, in order.
    pub fn sections(&self) -> impl Iterator<Item = SectionId> + use<> {
        (0..self.velocities.len()).map(SectionId::from_index)
    }

    /// The point of E as components: the velocity symbols as expressions.
    pub fn velocity(&self, graph: &mut Graph) -> Vec<ExprId> {
        self.velocities.iter().map(|symbol| graph.symbol(*symbol)).collect()
    }

    /// ẋ^i = ρ^i_α y^α, mathematics (1).
    pub fn rates(&self, graph: &mut Graph, velocity: &[ExprId]) -> Vec<ExprId> {
        self.anchor.vector_field(graph, velocity)
    }

    /// The derivation of functions of (t, x, z) along ẋ = ρ(y), ṫ = 1 and ż; velocities are constants.
    pub fn along(&self, graph: &mut Graph, velocity: &[ExprId], clock: &Clock) -> Derivation {
        let rates = self.rates(graph, velocity);
        let clock = clock.rates(graph);
        let seeds = self.anchor.coordinates.iter().copied().zip(rates).chain(clock);
        Derivation::new(seeds)
    }

    /// The bracket `[σ, τ]` of two sections, by the Leibniz rule:
    /// `[σ, τ]^γ = σ^α τ^β C^γ_{αβ} + ρ(σ)(τ^γ) − ρ(τ)(σ^γ)`.
    pub fn bracket(&self, graph: &mut Graph, sigma: &[ExprId], tau: &[ExprId]) -> Vec<ExprId> {
        let algebraic = self.structure.contract(graph, sigma, tau);
        let mut derive = |direction: &[ExprId], section: &[ExprId]| -> Vec<ExprId> {
            let field = self.anchor.vector_field(graph, direction);
            let mut derivation = Derivation::new(self.anchor.coordinates.iter().copied().zip(field));
            derivation.apply_all(graph, section)
        };
        let (forth, back) = (derive(sigma, tau), derive(tau, sigma));
        algebraic
            .into_iter()
            .zip(forth.into_iter().zip(back))
            .map(|(c, (f, b))| graph.linear_combination(&[(1.into(), c), (1.into(), f), ((-1).into(), b)]))
            .collect()
    }
}
