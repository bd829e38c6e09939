//! The level of a momentum, as a restriction of the velocities in D.

use super::distribution::ConstraintDistribution;
use crate::algebra::{Graph, NotLinear, Substitution};
use crate::id::{ExprId, SymbolId};

/// A momentum on D less its level, `c_a v^a + c_0`; it vanishes along the motion.
#[derive(Clone, Debug)]
pub struct MomentumLevel {
    /// c_a, for each independent velocity.
    pub coefficients: Vec<ExprId>,
    /// c_0.
    pub rest: ExprId,
}

impl MomentumLevel {
    /// The level of `residual`, a function on E that is affine in the velocities on D.
    ///
    /// # Errors
    /// Why it is not affine.
    pub fn of(
        graph: &mut Graph,
        distribution: &ConstraintDistribution,
        residual: ExprId,
        velocities: &[SymbolId],
    ) -> Result<Self, String> {
        let restricted = distribution.restriction(graph, velocities).apply(graph, residual);
        let form = graph.linear_form(restricted, &distribution.independent).map_err(|error| match error {
            NotLinear::Curved(..) => "it is not linear in the velocities".to_owned(),
            NotLinear::Unknown(why) => why,
        })?;
        let coefficients = form.coefficients.into_iter().map(|c| graph.simplify(c)).collect();
        Ok(Self { coefficients, rest: graph.simplify(form.rest) })
    }
}

impl ConstraintDistribution {
    /// The coefficient of an independent velocity in the momentum; `None` where that is zero.
    #[must_use]
    pub fn pivot(&self, graph: &Graph, level: &MomentumLevel, velocity: SymbolId) -> Option<ExprId> {
        let a = self.independent.iter().position(|symbol| *symbol == velocity)?;
        let pivot = *level.coefficients.get(a)?;
        graph.zero_test(pivot).is_nonzero().then_some(pivot)
    }

    /// The velocities of D on the level, with one of the independent ones solved for.
    ///
    /// The constraints stay those of D: the sections ∂ŷ/∂v^κ of the remaining velocities lie in D,
    /// and the level is kept by the motion alone.
    #[must_use]
    pub fn on_level(&self, graph: &mut Graph, level: &MomentumLevel, eliminated: SymbolId) -> Self {
        let Some(position) = self.independent.iter().position(|symbol| *symbol == eliminated) else {
            return self.clone();
        };
        // v^ρ = −(c_κ v^κ + c_0) / c_ρ
        let pivot = level.coefficients[position];
        let quotient = |graph: &mut Graph, numerator: ExprId| {
            let quotient = graph.div(numerator, pivot);
            graph.neg(quotient)
        };
        let mut independent = self.independent.clone();
        independent.remove(position);
        let slopes: Vec<ExprId> = level.coefficients.iter().map(|c| quotient(graph, *c)).collect();
        let offset_along = quotient(graph, level.rest);
        let mut solved = vec![offset_along];
        for (a, symbol) in self.independent.iter().enumerate().filter(|(a, _)| *a != position) {
            let velocity = graph.symbol(*symbol);
            solved.push(graph.mul(slopes[a], velocity));
        }
        let solved = graph.sum(&solved);
        let mut substitution = Substitution::new([(eliminated, solved)]);
        let velocity = substitution.apply_all(graph, &self.velocity);
        // B_κ − (c_κ / c_ρ) B_ρ and y₀ − (c_0 / c_ρ) B_ρ
        let (mut basis, mut offset) = (Vec::new(), Vec::new());
        for (row, origin) in self.basis.iter().zip(&self.offset) {
            let along = row[position];
            let mut entries = Vec::with_capacity(independent.len());
            for (a, entry) in row.iter().enumerate().filter(|(a, _)| *a != position) {
                let share = graph.mul(slopes[a], along);
                entries.push(graph.add(*entry, share));
            }
            basis.push(entries);
            let share = graph.mul(offset_along, along);
            offset.push(graph.add(*origin, share));
        }
        let mut gone: Vec<(SymbolId, ExprId)> = self
            .eliminated
            .iter()
            .map(|(symbol, value)| (*symbol, substitution.apply(graph, *value)))
            .collect();
        gone.push((eliminated, solved));
        Self { independent, basis, offset, velocity, eliminated: gone, ..self.clone() }
    }
}
