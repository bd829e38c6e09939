//! What is derived about the flow on phase space, on request.

use crate::id::{ExprId, SymbolId};
use crate::mechanics::{HamiltonianSide, Procedure};

/// What has a form of its own: each only if it is asked for.
#[derive(Clone, Debug, Default)]
pub struct PhaseSpace {
    /// The Hamiltonian side on D*.
    pub hamiltonian: Option<HamiltonianSide>,
    /// The equations as Π ∇E.
    pub almost_poisson: Option<AlmostPoisson>,
    /// The equations that a step can keep by itself.
    pub held: Option<HeldEquations>,
    /// The stated first integrals.
    pub invariants: Option<InvariantForm>,
    /// The kick of the leapfrog method on TQ: outputs are the velocities after it.
    pub leapfrog: Option<StepForm>,
    /// What a step of the variational method is made of.
    pub variational: Option<VariationalForm>,
    /// The discrete momentum of the Euler–Poincaré–Suslov equations, a component for each velocity.
    pub euler_poincare_suslov: Option<StepForm>,
}

/// Equations g = 0 that a step can keep by itself, mathematics (37).
#[derive(Clone, Debug)]
pub struct HeldEquations {
    /// g.
    pub functions: Vec<ExprId>,
    /// Outputs: g, the derivatives of each by the variables of the state, and of each the direction in which it is
    /// corrected.
    pub map: Procedure,
}

/// First integrals and their gradients.
#[derive(Clone, Debug)]
pub struct InvariantForm {
    /// Outputs: the integrals.
    pub values: Procedure,
    /// Outputs: the derivatives of each by the variables of the state.
    pub gradients: Procedure,
}

/// A function of the state and of the length of a step.
#[derive(Clone, Debug)]
pub struct StepForm {
    /// The length of the step.
    pub length: SymbolId,
    /// The function.
    pub map: Procedure,
}

/// What a step with a discrete Lagrangian and position constraints is made of, mathematics (62), on all of TQ.
#[derive(Clone, Debug)]
pub struct VariationalForm {
    /// Outputs: ∂L/∂q, then ∂L/∂q̇.
    pub slopes: Procedure,
    /// Outputs: g, what the position constraints say is zero.
    pub residual: Procedure,
    /// A covector r, then as many numbers c as there are constraints.
    pub given: Vec<SymbolId>,
    /// Outputs: a with W a − r in the span of the rows of G = ∂g, and G a = c.
    pub change: Procedure,
}

/// The almost-Poisson form of a system that conserves its energy.
#[derive(Clone, Debug)]
pub struct AlmostPoisson {
    /// Outputs: ∂E/∂(state).
    pub gradient: Procedure,
    /// The components of a covector.
    pub covector: Vec<SymbolId>,
    /// Outputs: Π applied to it.
    pub sharp: Procedure,
}
