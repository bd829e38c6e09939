//! One point of the field: the declared data there as numbers, and what definitions are made of.

use super::super::proof::{Defect, run};
use super::super::reference::{Instant, Reference, inner};
use super::Motion;
use super::procedure_derivative::tangent;
use crate::algebra::{
    Direction, Dual, Echelon, FieldPass, FieldPoint, Residue, TangentPass, determinant_in_field,
};
use crate::id::{ExprId, Id, SymbolId};
use crate::mechanics::{LagrangianSystem, Procedure};

/// The declared data at a point, with the motion that is proved.
pub(super) struct Place<'a, 's> {
    pub(super) reference: &'s Reference,
    pub(super) instant: Instant<'a, 's>,
    pub(super) motion: Motion<'s>,
    /// The symbols that are chosen there.
    pub(super) point: FieldPoint,
    pub(super) division: i64,
}

/// A vector that is tangent to the constraint manifold along D: a point of 𝒯ᴰD.
#[derive(Clone)]
pub(super) struct Arrow {
    /// Its section σ in D.
    pub(super) section: Vec<Residue>,
    /// ẋ = ρ(σ), and the rates of the velocities of the state.
    pub(super) state: Direction,
    /// The derivatives of p_α along it.
    pub(super) momenta: Vec<Residue>,
}

impl<'a, 's> Place<'a, 's> {
    pub(super) fn system(&self) -> &'s LagrangianSystem {
        self.reference.system()
    }

    /// An evaluation at the point of its own.
    pub(super) fn pass(&self) -> FieldPass<'a> {
        self.instant.pass.clone()
    }

    pub(super) fn values(&self, expressions: &[ExprId]) -> Result<Vec<Residue>, Defect> {
        Ok(self.pass().evaluate(expressions)?)
    }

    /// The outputs of a procedure.
    pub(super) fn run(&self, procedure: &Procedure) -> Result<Vec<Residue>, Defect> {
        run(&mut self.pass(), procedure)
    }

    /// The derivatives of its outputs along a direction.
    pub(super) fn slopes(&self, procedure: &Procedure, along: &Direction) -> Result<Vec<Residue>, Defect> {
        let duals = tangent(&mut self.pass(), procedure, along.clone())?;
        Ok(duals.into_iter().map(|dual| dual.rate).collect())
    }

    /// The direction in which the state and the time move.
    pub(super) fn flow(&self) -> Result<Direction, Defect> {
        self.motion.direction(&mut self.pass())
    }

    /// The base coordinates.
    pub(super) fn coordinates(&self) -> &'s [SymbolId] {
        &self.system().algebroid.anchor.coordinates
    }

    /// ρ(σ), as a direction.
    pub(super) fn anchored(&self, section: &[Residue]) -> Result<Direction, Defect> {
        let rows = self.matrix(&self.system().algebroid.anchor.entries)?;
        let rates = rows.iter().map(|row| inner(row, section));
        Ok(self.coordinates().iter().copied().zip(rates).collect())
    }

    pub(super) fn matrix(&self, rows: &[Vec<ExprId>]) -> Result<Vec<Vec<Residue>>, Defect> {
        let mut pass = self.pass();
        rows.iter().map(|row| Ok(pass.evaluate(row)?)).collect()
    }

    /// p_α, and their derivatives along a direction of coordinates and all velocities.
    pub(super) fn momenta(&self, along: Direction) -> Result<Vec<Dual>, Defect> {
        let LagrangianSystem { algebroid, lagrangian, .. } = self.system();
        Ok(TangentPass::new(&mut self.pass(), along).gradient(*lagrangian, &algebroid.velocities)?)
    }

    /// ∂²L/∂y^α∂y^β.
    pub(super) fn mass(&self) -> Result<Vec<Vec<Residue>>, Defect> {
        let velocities = &self.system().algebroid.velocities;
        let row = |velocity: &SymbolId| {
            let along = Direction::from_iter([(*velocity, Residue::ONE)]);
            Ok(self.momenta(along)?.into_iter().map(|dual| dual.rate).collect())
        };
        velocities.iter().map(row).collect()
    }

    /// The gradients of a function by symbols, with their derivatives along a direction.
    pub(super) fn gradient(
        &self,
        function: ExprId,
        symbols: &[SymbolId],
        along: &Direction,
    ) -> Result<Vec<Dual>, Defect> {
        Ok(TangentPass::new(&mut self.pass(), along.clone()).gradient(function, symbols)?)
    }

    /// J = ∂φ/∂y, a row for each constraint that the state does not solve.
    pub(super) fn jacobian(&self) -> Result<Vec<Vec<Residue>>, Defect> {
        self.slopes_of_residuals(&self.system().algebroid.velocities)
    }

    fn slopes_of_residuals(&self, symbols: &[SymbolId]) -> Result<Vec<Vec<Residue>>, Defect> {
        let row = |residual: &ExprId| {
            let row = self.gradient(*residual, symbols, &Direction::default())?;
            Ok(row.into_iter().map(|dual| dual.value).collect())
        };
        self.reference.residuals().iter().map(row).collect()
    }

    /// A basis of D, or of ker J.
    pub(super) fn distribution(&self) -> Result<Vec<Vec<Residue>>, Defect> {
        if let Some(sections) = self.reference.sections() {
            return self.matrix(&sections.iter().map(|(_, section)| section.clone()).collect::<Vec<_>>());
        }
        let s = self.system().algebroid.rank();
        Ok(Echelon::of(self.jacobian()?).kernel(s).collect())
    }

    /// C^γ_{αβ} σ^α τ^β p_γ for each of several covectors p: the bracket of sections with constant components.
    pub(super) fn contraction(&self, sigma: &[Residue], tau: &[Residue]) -> Result<Vec<Residue>, Defect> {
        let mut pass = self.pass();
        let algebroid = &self.system().algebroid;
        let mut found = vec![Residue::ZERO; algebroid.rank()];
        for (alpha, beta, gamma, component) in algebroid.structure.terms() {
            let (alpha, beta, gamma) = (alpha.index(), beta.index(), gamma.index());
            let weight = sigma[alpha] * tau[beta] - sigma[beta] * tau[alpha];
            found[gamma] = found[gamma] + pass.evaluate(&[component])?[0] * weight;
        }
        Ok(found)
    }

    /// A basis of 𝒯ᴰD: what constraints that the state does not solve leave of (σ, τ) is J τ + ρ(σ)φ = 0, σ in ker J.
    pub(super) fn arrows(&self) -> Result<Vec<Arrow>, Defect> {
        let algebroid = &self.system().algebroid;
        let none = vec![Residue::ZERO; algebroid.rank()];
        let sections = self.distribution()?;
        if self.reference.sections().is_some() {
            let along_base = sections.iter().map(|section| self.arrow(section, Direction::default()));
            let fibres = self
                .reference
                .state()
                .iter()
                .map(|velocity| self.arrow(&none, Direction::from_iter([(*velocity, Residue::ONE)])));
            return along_base.chain(fibres).collect();
        }
        let jacobian = self.jacobian()?;
        let inclines = self.slopes_of_residuals(self.coordinates())?;
        let mut arrows = Vec::new();
        for section in &sections {
            let rates = self.anchored(section)?;
            let rates: Vec<Residue> = self.coordinates().iter().map(|x| rates[x]).collect();
            let with = jacobian
                .iter()
                .zip(&inclines)
                .map(|(row, incline)| row.iter().copied().chain([-inner(incline, &rates)]).collect());
            let lifted = Echelon::of(with.collect()).solution(none.len()).ok_or(Defect::Here)?;
            let lifted = algebroid.velocities.iter().copied().zip(lifted).collect();
            arrows.push(self.arrow(section, lifted)?);
            let vertical = algebroid.velocities.iter().copied().zip(section.iter().copied()).collect();
            arrows.push(self.arrow(&none, vertical)?);
        }
        Ok(arrows)
    }

    fn arrow(&self, section: &[Residue], velocities: Direction) -> Result<Arrow, Defect> {
        let mut state = self.anchored(section)?;
        state.extend(velocities);
        let along = self.with_all_velocities(&state)?;
        let momenta = self.momenta(along)?.into_iter().map(|dual| dual.rate).collect();
        Ok(Arrow { section: section.to_vec(), state, momenta })
    }

    /// A direction of the state with the rates of all velocities that it means.
    pub(super) fn with_all_velocities(&self, state: &Direction) -> Result<Direction, Defect> {
        let all = self.reference.all_velocities();
        let duals = TangentPass::new(&mut self.pass(), state.clone()).duals(all)?;
        let rates = duals.into_iter().map(|dual| dual.rate);
        let mut along = state.clone();
        along.extend(self.system().algebroid.velocities.iter().copied().zip(rates));
        Ok(along)
    }
}

/// Whether vectors lie in the span of others.
pub(super) fn spans(rows: &[Vec<Residue>], vectors: &[Vec<Residue>]) -> bool {
    let with: Vec<Vec<Residue>> = rows.iter().chain(vectors).cloned().collect();
    rank(&with) == rank(rows)
}

/// The rank of a matrix.
pub(super) fn rank(rows: &[Vec<Residue>]) -> usize {
    let rows: Vec<Vec<Residue>> = rows.iter().filter(|row| !row.is_empty()).cloned().collect();
    Echelon::of(rows).rank()
}

/// A metric on sections.
pub(super) fn gram(metric: &[Vec<Residue>], sections: &[Vec<Residue>]) -> Vec<Vec<Residue>> {
    let lowered =
        |section: &[Residue]| metric.iter().map(|row| inner(row, section)).collect::<Vec<Residue>>();
    let lowered: Vec<Vec<Residue>> = sections.iter().map(|section| lowered(section)).collect();
    sections.iter().map(|a| lowered.iter().map(|b| inner(a, b)).collect()).collect()
}

/// Whether a metric is regular on the span of sections.
pub(super) fn is_regular_on(metric: &[Vec<Residue>], sections: &[Vec<Residue>]) -> bool {
    determinant_in_field(gram(metric, sections)) != Residue::ZERO
}
