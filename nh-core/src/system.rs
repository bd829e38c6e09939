//! A verified system: what the derivation hands to the back end.

use crate::choose::Ledger;
use crate::functions::{self, Functions, Sizes};
use crate::id::{ExprId, SymbolId};
use crate::mechanics::Procedure;
use crate::model::{Formulation, Model};
use crate::phase_space::PhaseSpace;

/// A system that has passed every check, with its functions derived.
#[derive(Clone, Debug)]
pub struct System {
    /// The declaration; its graph holds every derived expression.
    pub model: Model,
    /// The form of the equations.
    pub formulation: Formulation,
    /// The coordinates in the state, in declared order: all of them, unless `track` leaves some out.
    pub state_coordinates: Vec<SymbolId>,
    /// The velocities in the state, in declared order: all of them in the projected formulation.
    pub state_velocities: Vec<SymbolId>,
    /// Outputs: ẋ^i for each coordinate in the state, then v̇ for each velocity in the state.
    pub derivative: Procedure,
    /// The functions that are generated beside the derivative.
    pub functions: Functions,
    /// The labels of the symmetries whose momenta are among them.
    pub momenta: Vec<String>,
    /// The coordinates along which the gyroscopic force acts, if that is among them.
    pub gyroscopic: Vec<SymbolId>,
    /// The coordinates that are left to quadratures, since nothing depends on them.
    pub quadratures: Vec<SymbolId>,
    /// Outputs: ∂derivative/∂(state, input) row by row; if asked for.
    pub jacobian: Option<Procedure>,
    /// The way back to the constraint manifold; in the projected formulation.
    pub projection: Option<Projection>,
    /// Brackets, momenta, volume and connections; as far as they are asked for.
    pub phase_space: PhaseSpace,
    /// The identities of an embedded base.
    pub embedding: Option<Embedding>,
    /// What `validate` checks beyond finite parameters.
    pub parameter_checks: Vec<ParameterCheck>,
    /// What was chosen among forms, and how it was proved.
    pub ledger: Ledger,
    /// What was derived, as text.
    pub report: String,
    /// The equations of motion as lines of text for the documentation of the struct.
    pub equations: Vec<String>,
}

impl System {
    /// The state: coordinates, then velocities.
    #[must_use]
    pub fn state(&self) -> Vec<SymbolId> {
        [self.state_coordinates.as_slice(), &self.state_velocities].concat()
    }

    /// The numbers that the shapes of its functions are made of.
    #[must_use]
    pub fn sizes(&self) -> Sizes {
        let count = |signature| self.functions.get(signature).map_or(0, |f: &Procedure| f.outputs.len());
        let sections = self.model.sections.len();
        Sizes {
            state: self.state_coordinates.len() + self.state_velocities.len(),
            velocities: self.state_velocities.len(),
            sections,
            outputs: self.model.outputs.len(),
            parameters: self.model.parameters.len(),
            vertical: count(&functions::VERTICAL_MOMENTA),
            lifted: count(&functions::HORIZONTAL_LIFTS) / sections.max(1),
        }
    }
}

/// An expression of parameters alone by which the equations divide.
#[derive(Clone, Debug)]
pub struct ParameterCheck {
    /// The expression that must not vanish.
    pub nonzero: ExprId,
    /// Its text in the declaration's syntax.
    pub text: String,
}

/// A Newton iteration for the point of the constraint manifold nearest to where it starts, in the
/// kinetic metric.
#[derive(Clone, Debug)]
pub struct Projection {
    /// The symbols of the velocities where the iteration started.
    pub start: Vec<SymbolId>,
    /// Outputs: the next velocities, from the present and the starting ones.
    pub step: Procedure,
}

/// Identities that embedded base coordinates satisfy, and the way back to them.
#[derive(Clone, Debug)]
pub struct Embedding {
    /// Each identity as text.
    pub texts: Vec<String>,
    /// Outputs: what should be zero, for each identity.
    pub residual: Procedure,
    /// Outputs: the base coordinates after one Newton step.
    pub step: Procedure,
}
