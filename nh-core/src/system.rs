//! A verified system: what the derivation hands to the back end.

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
    /// One output: E_L; unless it depends on what `track` leaves out.
    pub energy: Option<Procedure>,
    /// Outputs: y^α for every section; unless they depend on what `track` leaves out.
    pub velocity: Option<Procedure>,
    /// Outputs: the declared observables.
    pub observables: Procedure,
    /// Outputs: λ_A for every constraint; if asked for.
    pub multipliers: Option<Procedure>,
    /// Outputs: the reaction force along every section; if asked for.
    pub reactions: Option<Procedure>,
    /// The momenta of the symmetries; if any are declared or asked for.
    pub momenta: Option<Momenta>,
    /// Outputs: as `derivative`, by the Gibbs–Appell function; if asked for.
    pub gibbs_appell: Option<Procedure>,
    /// The gyroscopic force of a Chaplygin system; if asked for.
    pub gyroscopic: Option<Gyroscopic>,
    /// What Routh reduction leaves to quadratures.
    pub quadratures: Option<Quadratures>,
    /// Outputs: ∂derivative/∂(state, input) row by row; if asked for.
    pub jacobian: Option<Procedure>,
    /// Outputs: ∂derivative/∂parameters row by row; if asked for.
    pub parameter_jacobian: Option<Procedure>,
    /// Outputs: φ^A for every constraint; in the projected formulation.
    pub residual: Option<Procedure>,
    /// The way back to the constraint manifold; in the projected formulation.
    pub projection: Option<Projection>,
    /// Brackets, momenta, volume and connections; as far as they are asked for.
    pub phase_space: PhaseSpace,
    /// The identities of an embedded base.
    pub embedding: Option<Embedding>,
    /// What `validate` checks beyond finite parameters.
    pub parameter_checks: Vec<ParameterCheck>,
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
}

/// The force ⟨J, K⟩ on the right of the Euler–Lagrange equations of L̄ (mathematics section 6).
#[derive(Clone, Debug)]
pub struct Gyroscopic {
    /// The coordinates along which it acts.
    pub coordinates: Vec<SymbolId>,
    /// Outputs: its components.
    pub force: Procedure,
}

/// Coordinates that are not in the state, because nothing depends on them.
#[derive(Clone, Debug)]
pub struct Quadratures {
    /// The coordinates.
    pub coordinates: Vec<SymbolId>,
    /// Outputs: their rates.
    pub rates: Procedure,
}

/// The momenta σ^α p_α − f of sections σ, and their rates along the motion.
#[derive(Clone, Debug)]
pub struct Momenta {
    /// The label of each.
    pub names: Vec<String>,
    /// Outputs: the momenta.
    pub values: Procedure,
    /// Outputs: their rates.
    pub rates: Procedure,
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
