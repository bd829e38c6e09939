//! The exterior derivative of one-forms on the algebroid, mathematics section 5.

use super::euler_lagrange::LagrangianSystem;
use crate::algebra::{Derivation, Graph, Substitution};
use crate::id::{ExprId, SymbolId};

/// `dθ(σ, τ) = ρ(σ)θ(τ) − ρ(τ)θ(σ) − θ([σ, τ])` for two sections whose components are held constant,
/// with `∂_tθ(τ)` where θ depends on the time: along a motion, t goes with σ.
///
/// For any number of forms θ(y): what they have in common is differentiated once.
pub(super) struct ExteriorDerivative {
    /// Along a section whose components are symbols, so that they are not differentiated themselves.
    along: Derivation,
    /// Those symbols by ρ(σ), the velocities by τ.
    forth: Substitution,
    /// Those symbols by ρ(τ), the velocities by σ.
    back: Substitution,
    /// The velocities by [σ, τ].
    bracket: Substitution,
    /// The velocities by τ.
    second: Substitution,
    in_time: Derivation,
}

impl ExteriorDerivative {
    /// On σ and τ.
    pub(super) fn of(graph: &mut Graph, system: &LagrangianSystem, sigma: &[ExprId], tau: &[ExprId]) -> Self {
        let algebroid = &system.algebroid;
        let coordinates = algebroid.anchor.coordinates.iter().copied();
        let symbols: Vec<SymbolId> =
            (0..coordinates.len()).map(|index| graph.new_symbol(format!("direction{index}"))).collect();
        let seeds: Vec<ExprId> = symbols.iter().map(|symbol| graph.symbol(*symbol)).collect();
        let velocities = algebroid.velocities.iter().copied();
        let mut images = |direction: &[ExprId], section: &[ExprId]| {
            let field = algebroid.anchor.vector_field(graph, direction);
            Substitution::new(
                symbols.iter().copied().zip(field).chain(velocities.clone().zip(section.iter().copied())),
            )
        };
        let (forth, back) = (images(sigma, tau), images(tau, sigma));
        let bracket = algebroid.structure.contract(graph, sigma, tau);
        Self {
            along: Derivation::new(coordinates.zip(seeds)),
            forth,
            back,
            bracket: Substitution::new(velocities.clone().zip(bracket)),
            second: Substitution::new(velocities.zip(tau.iter().copied())),
            in_time: {
                let clock = system.clock.rates(graph);
                Derivation::new(clock)
            },
        }
    }

    /// On y, and a section whose components are symbols.
    pub(super) fn anywhere(graph: &mut Graph, system: &LagrangianSystem) -> Self {
        let first = system.algebroid.velocity(graph);
        let second: Vec<ExprId> = (0..first.len())
            .map(|index| {
                let symbol = graph.new_symbol(format!("z{index}"));
                graph.symbol(symbol)
            })
            .collect();
        Self::of(graph, system, &first, &second)
    }

    /// dθ(σ, τ) for θ(y) = `form`.
    pub(super) fn apply(&mut self, graph: &mut Graph, form: ExprId) -> ExprId {
        let change = self.along.apply(graph, form);
        let (forth, back) = (self.forth.apply(graph, change), self.back.apply(graph, change));
        let of_bracket = self.bracket.apply(graph, form);
        let change = self.in_time.apply(graph, form);
        let in_time = self.second.apply(graph, change);
        graph.linear_combination(&[
            (1.into(), forth),
            ((-1).into(), back),
            ((-1).into(), of_bracket),
            (1.into(), in_time),
        ])
    }

    /// θ(τ).
    pub(super) fn on_second(&mut self, graph: &mut Graph, form: ExprId) -> ExprId {
        self.second.apply(graph, form)
    }

    /// Whether dθ = 0, and θ does not depend on the time.
    pub(super) fn vanishes(&mut self, graph: &mut Graph, form: ExprId) -> bool {
        let curl = self.apply(graph, form);
        graph.zero_test(curl).is_zero()
    }
}
