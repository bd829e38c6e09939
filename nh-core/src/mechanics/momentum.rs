//! The nonholonomic momentum of a section, and its rate.

use super::complete_lift::complete_lift;
use super::euler_lagrange::LagrangianSystem;
use crate::algebra::{Graph, Rational};
use crate::geometry::ConstraintDistribution;
use crate::id::ExprId;

/// The momentum σ^α p_α − f of a section σ, with what it changes by; functions on E.
#[derive(Clone, Debug)]
pub struct Momentum {
    /// σ^α p_α − f.
    pub value: ExprId,
    /// σ^C(L) − ḟ: zero where σ leaves L invariant up to f.
    pub variation: ExprId,
    /// σ^α Υ_α: what the forces do.
    pub work: ExprId,
    /// Whether there is an f that is not 0.
    pub has_gauge: bool,
}

impl Momentum {
    /// The momentum of a section whose components depend on the base and the time; `gauge` is f.
    ///
    /// For σ in D, and on the constraint manifold, mathematics (12), CLMM Theorem 5.3:
    /// `d/dt (σ^α p_α − f) = σ^C(L) − ḟ + σ^α Υ_α`; the term ∂_tσ^α p_α is in σ^C(L).
    /// Forces along sections that span D act along the components of σ in them.
    pub fn of(
        graph: &mut Graph,
        system: &LagrangianSystem,
        section: &[ExprId],
        gauge: Option<ExprId>,
        spanned: Option<&ConstraintDistribution>,
    ) -> Self {
        let algebroid = &system.algebroid;
        let momenta = system.momenta(graph);
        let mut value = graph.inner_product(section, &momenta);
        let mut lift = complete_lift(graph, algebroid, section, &system.clock);
        let mut variation = lift.apply(graph, system.lagrangian);
        if let Some(gauge) = gauge {
            let velocity = algebroid.velocity(graph);
            let change = algebroid.along(graph, &velocity, &system.clock).apply(graph, gauge);
            value = graph.formula(value - gauge);
            variation = graph.formula(variation - change);
        }
        let mut work = graph.inner_product(section, &system.forces);
        if !system.forces_on_distribution.is_empty()
            && let Some(distribution) = spanned
            && let Some(components) = distribution.components(graph, section)
        {
            for (symbol, force) in &system.forces_on_distribution {
                let along = distribution.independent.iter().position(|known| known == symbol);
                if let Some(component) = along.and_then(|a| components.get(a)) {
                    work = graph.formula(work + component * force);
                }
            }
        }
        let has_gauge = gauge.is_some_and(|gauge| !graph.as_number(gauge).is_some_and(Rational::is_zero));
        Self { value, variation, work, has_gauge }
    }

    /// The right side of the momentum equation.
    pub fn rate(&self, graph: &mut Graph) -> ExprId {
        graph.formula(self.variation + self.work)
    }
}
