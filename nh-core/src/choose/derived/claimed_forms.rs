//! What several procedures together are claimed to be.

use crate::id::{CoordId, ExprId, SymbolId};
use crate::mechanics::Procedure;

/// Π applied to a covector, and the covector of the energy.
#[derive(Clone, Copy)]
pub(crate) struct AlmostPoissonForm<'p> {
    pub(crate) gradient: &'p Procedure,
    pub(crate) covector: &'p [SymbolId],
    pub(crate) sharp: &'p Procedure,
    pub(crate) energy: &'p Procedure,
}

/// The brackets of outputs with each other and with the energy, and what is left of their rates.
#[derive(Clone, Copy)]
pub(crate) struct BracketForm<'p> {
    pub(crate) outputs: &'p Procedure,
    pub(crate) bracket: &'p Procedure,
    pub(crate) with_energy: &'p Procedure,
    pub(crate) drift: &'p Procedure,
    pub(crate) energy: &'p Procedure,
}

/// The functions of the splitting: an array without entries is none.
#[derive(Clone, Copy)]
pub(crate) struct SplittingForm<'p> {
    pub(crate) vertical: Option<&'p Procedure>,
    pub(crate) lifts: Option<&'p Procedure>,
    pub(crate) inertia: Option<&'p Procedure>,
    pub(crate) coefficients: Option<&'p Procedure>,
    pub(crate) curvature: Option<&'p Procedure>,
    pub(crate) momenta: Option<&'p Procedure>,
    pub(crate) velocities: Option<&'p Procedure>,
    pub(crate) force: Option<&'p Procedure>,
    /// The coordinates of which V is the kernel.
    pub(crate) over: &'p [CoordId],
    /// Those of the lifts.
    pub(crate) coordinates: &'p [CoordId],
    /// Sections that span V, where a group is declared.
    pub(crate) group: &'p [Vec<ExprId>],
    pub(crate) is_embedded: bool,
}

/// The force of the curvature, with the coordinates along which it acts.
#[derive(Clone, Copy)]
pub(crate) struct GyroscopicForm<'p> {
    pub(crate) force: &'p Procedure,
    pub(crate) over: &'p [CoordId],
}

/// The power of each force, then of each constraint.
#[derive(Clone, Copy)]
pub(crate) struct PowerForm<'p> {
    pub(crate) power: &'p Procedure,
    pub(crate) energy: &'p Procedure,
    pub(crate) forces: &'p [AppliedForce],
    /// What may stand in the forces.
    pub(crate) names: VelocityNames<'p>,
    /// λ, where it is known, with the rows Φ unless these are those of the reference.
    pub(crate) multipliers: Option<&'p Procedure>,
    pub(crate) rows: Option<&'p [Vec<ExprId>]>,
}

/// A declared force.
#[derive(Clone, Debug)]
pub(crate) struct AppliedForce {
    pub(crate) value: ExprId,
    /// The velocity along which it acts: a combination of y, or one of the state.
    pub(crate) along: Result<Vec<ExprId>, SymbolId>,
}

/// Declared functions, in which rates and replaced velocities may stand.
#[derive(Clone, Copy)]
pub(crate) struct ValuesForm<'p> {
    pub(crate) values: &'p Procedure,
    pub(crate) declared: &'p [ExprId],
    pub(crate) names: VelocityNames<'p>,
}

/// What stands for velocities in declared functions, beside y.
#[derive(Clone, Copy)]
pub(crate) struct VelocityNames<'p> {
    /// The symbols of ẋ.
    pub(crate) rates: &'p [SymbolId],
    /// Further velocities, by the rows that make them of y.
    pub(crate) replaced: &'p [(SymbolId, Vec<ExprId>)],
}
