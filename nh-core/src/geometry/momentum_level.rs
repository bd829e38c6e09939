//! The level of a momentum, as a restriction of the velocities in D.

use super::distribution::ConstraintDistribution;
use crate::algebra::{Graph, Matrix, NotLinear, Substitution};
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
    /// The velocities of D on levels, with as many of the independent ones solved for together; `None`
    /// if the levels do not determine these.
    ///
    /// The constraints stay those of D: the sections ∂ŷ/∂v^κ of the remaining velocities lie in D,
    /// and the levels are kept by the motion alone.
    #[must_use]
    pub fn on_levels(
        &self,
        graph: &mut Graph,
        levels: &[MomentumLevel],
        eliminated: &[SymbolId],
    ) -> Option<Self> {
        let position = |symbol: &SymbolId| self.independent.iter().position(|known| known == symbol);
        let gone: Vec<usize> = eliminated.iter().map(position).collect::<Option<_>>()?;
        let kept: Vec<usize> = (0..self.rank()).filter(|a| !gone.contains(a)).collect();
        // v^ρ = −(c_ρ)⁻¹ (c_κ v^κ + c_0)
        let columns = |level: &MomentumLevel, of: &[usize]| -> Vec<ExprId> {
            of.iter().map(|a| level.coefficients[*a]).collect()
        };
        let matrix: Matrix = levels.iter().map(|level| columns(level, &gone)).collect();
        let mut right: Matrix = levels.iter().map(|level| columns(level, &kept)).collect();
        right.iter_mut().zip(levels).for_each(|(row, level)| row.push(level.rest));
        let solved = graph.solve_linear(&matrix, &right)?.values;
        let solved: Matrix = solved
            .into_iter()
            .map(|row| row.into_iter().map(|entry| graph.formula(-entry)).collect())
            .collect();
        let independent: Vec<SymbolId> = kept.iter().map(|a| self.independent[*a]).collect();
        let mut images = Vec::new();
        for (symbol, row) in eliminated.iter().zip(&solved) {
            let mut terms: Vec<ExprId> = row.last().copied().into_iter().collect();
            for (slope, symbol) in row.iter().zip(&independent) {
                let velocity = graph.symbol(*symbol);
                terms.push(graph.formula(slope * velocity));
            }
            images.push((*symbol, graph.sum(&terms)));
        }
        let mut substitution = Substitution::new(images.iter().copied());
        let velocity = substitution.apply_all(graph, &self.velocity);
        // B_κ + B_ρ ∂v^ρ/∂v^κ and y₀ + B_ρ v^ρ|₀
        let (mut basis, mut offset) = (Matrix::new(), Vec::new());
        for (row, origin) in self.basis.iter().zip(&self.offset) {
            let mut entries: Vec<ExprId> = kept.iter().map(|a| row[*a]).chain([*origin]).collect();
            for (a, solution) in gone.iter().zip(&solved) {
                for (entry, slope) in entries.iter_mut().zip(solution) {
                    *entry = graph.formula(*entry + slope * row[*a]);
                }
            }
            offset.extend(entries.pop());
            basis.push(entries);
        }
        Some(Self { independent, basis, offset, velocity, eliminated: images, ..self.clone() })
    }
}
