//! What the stages of the derivation hand on to each other, and what they say where they end it.

use super::common_turn::BeforeCounting;
use crate::algebra::Facts;
use crate::check::{BrokenLaws, Constraints, Impact, Kind, Motion, Positions, Symmetry};
use crate::choose::{Fate, Ledger};
use crate::geometry::independent_velocities::Choice;
use crate::geometry::{ConstraintDistribution, Manifold, Rank};
use crate::id::{CoordId, ExprId, Id, Origin, SymbolId};
use crate::mechanics::{LagrangianSystem, ReducedEquations, SaddleEquations};
use crate::model::{ForceDirection, Formulation, Model};
use crate::violation::{Law, Violation};

/// What the later stages share.
pub(crate) struct Proved {
    /// The declaration.
    pub(crate) model: Model,
    /// How it moves.
    pub(crate) motion: Motion,
    /// The embedded base.
    pub(crate) base: Manifold,
    /// Facts about the parameters.
    pub(crate) facts: Facts,
    /// What kind of algebroid it moves on.
    pub(crate) kind: Kind,
    /// The structure equations that it breaks.
    pub(crate) broken_laws: BrokenLaws,
    /// The position constraints, and where they hold.
    pub(crate) positions: Positions,
    /// What the coordinates that are named as independent determine, and where.
    pub(crate) chart: Option<Choice<CoordId>>,
    /// The constraints.
    pub(crate) constraints: Constraints,
    /// The rank of their derivatives by the velocities, where it is known.
    pub(crate) constraint_rank: Option<Rank>,
    /// The Lagrangian system without them.
    pub(crate) system: LagrangianSystem,
    /// Its symmetries.
    pub(crate) symmetries: Symmetries,
    /// What velocities jump to.
    pub(crate) impacts: Vec<Impact>,
    /// Momenta on levels.
    pub(crate) levels: Vec<Level>,
    /// The cyclic coordinates that these leave to quadratures.
    pub(crate) quadratures: Vec<SymbolId>,
    /// How D is split by symmetries, where that was asked for.
    pub(crate) split: Option<Split>,
    /// Whether the equations with multipliers are solved with numerical pivots, as (10) would divide by what may vanish where
    /// they are regular.
    pub(crate) is_pivoted: bool,
    /// The motion before its angles were counted from one of them.
    pub(crate) before_counting: Option<BeforeCounting>,
    /// What was chosen, and from what.
    pub(crate) ledger: Ledger,
}

/// What is known of the symmetries of a system.
#[derive(Clone, Debug, Default)]
pub(crate) struct Symmetries {
    /// The declared sections.
    pub(crate) declared: Vec<Symmetry>,
    /// Coordinates that nothing depends on.
    pub(crate) cyclic: Vec<CoordId>,
    /// Their translations, as far as the anchor determines them; those in D, unless levels are declared.
    pub(crate) found: Vec<(CoordId, Symmetry)>,
}

/// A momentum on a level.
#[derive(Clone, Debug)]
pub(crate) struct Level {
    /// The label of the symmetry.
    pub(crate) name: String,
    /// σ.
    pub(crate) section: Vec<ExprId>,
    /// μ.
    pub(crate) value: ExprId,
    /// σ^α p_α − f − μ, on E.
    pub(crate) residual: ExprId,
    /// Where it is declared.
    pub(crate) origin: Origin,
}

/// How D is split, as far as the functions do not say it.
#[derive(Clone, Debug)]
pub(crate) struct Split {
    /// The coordinates of which V is the kernel.
    pub(crate) over: Vec<CoordId>,
    /// Those of the lifts.
    pub(crate) coordinates: Vec<CoordId>,
    /// Sections that span V, where they are those of a group.
    pub(crate) group: Vec<Vec<ExprId>>,
    pub(crate) is_embedded: bool,
}

impl Proved {
    /// The row that makes of y what a force acts along; a section of the frame that spans D, by its velocity, which is one
    /// of the state. D leads nowhere along the others.
    pub(crate) fn along(&mut self, direction: ForceDirection) -> Result<Vec<ExprId>, SymbolId> {
        let algebroid = &self.system.algebroid;
        let symbol = match direction {
            ForceDirection::Coordinate(coordinate) => {
                return Ok(algebroid.anchor.entries[coordinate.index()].clone());
            }
            ForceDirection::Section(symbol) => symbol,
        };
        if let Some(alpha) = algebroid.velocities.iter().position(|velocity| *velocity == symbol) {
            let mut row = vec![self.model.graph.zero(); algebroid.rank()];
            row[alpha] = self.model.graph.one();
            return Ok(row);
        }
        if let Some((_, row)) = self.motion.replaced.iter().find(|(replaced, _)| *replaced == symbol) {
            return Ok(row.clone());
        }
        let mut spanning = self.model.distribution.iter().flatten();
        if spanning.any(|(section, _)| *section == symbol) {
            return Err(symbol);
        }
        Ok(vec![self.model.graph.zero(); algebroid.rank()])
    }
}

/// The derived objects that the report shows.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Derived<'a> {
    /// In a basis of D.
    Adapted {
        /// D.
        distribution: &'a ConstraintDistribution,
        /// Its velocities on the levels of momenta.
        kept: &'a ConstraintDistribution,
        /// Its equations.
        equations: &'a ReducedEquations,
    },
    /// On all of E, with multipliers.
    Projected {
        /// φ^A.
        residuals: &'a [ExprId],
        /// The equations.
        equations: &'a SaddleEquations,
    },
}

impl Derived<'_> {
    /// The form of the state.
    pub(crate) fn formulation(&self) -> Formulation {
        match self {
            Self::Adapted { .. } => Formulation::Adapted,
            Self::Projected { .. } => Formulation::Projected,
        }
    }
}

pub(super) fn fence(violations: Vec<Violation>) -> Result<(), Vec<Violation>> {
    if violations.is_empty() { Ok(()) } else { Err(violations) }
}

/// Reports what two independent checks found in one go.
pub(super) fn both<T>(first: Vec<Violation>, second: Result<T, Vec<Violation>>) -> Result<T, Vec<Violation>> {
    match second {
        Ok(value) => fence(first).map(|()| value),
        Err(more) => Err(first.into_iter().chain(more).collect()),
    }
}

/// No form of the equations could be proved.
pub(super) fn nothing_proved(origin: Origin, ledger: &Ledger) -> Vec<Violation> {
    let reasons = ledger.decisions.iter().flat_map(|decision| &decision.contenders);
    let reason = reasons.rev().find_map(|contender| match &contender.fate {
        Fate::NotAdmitted(reason) => Some(format!("of the form `{}`: {reason}", contender.form)),
        _ => None,
    });
    vec![Violation {
        law: Law::Decidable,
        origin,
        what: "no form of the equations of motion could be proved to be what is declared".into(),
        evidence: reason.unwrap_or_default(),
        way_out:
            "write what is declared in simpler functions; this is a limit of the proof, please report it"
                .into(),
    }]
}
