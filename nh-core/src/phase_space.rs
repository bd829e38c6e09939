//! What is derived about the flow on phase space, on request.

use crate::id::SymbolId;
use crate::mechanics::{HamiltonianSide, Procedure};

/// Brackets, momenta, volume and connections: each only if it is asked for.
#[derive(Clone, Debug, Default)]
pub struct PhaseSpace {
    /// The Hamiltonian side on D*.
    pub hamiltonian: Option<HamiltonianSide>,
    /// Outputs: the brackets {f_i, f_j}_nh of the declared observables, row by row.
    pub bracket: Option<Procedure>,
    /// Outputs: the brackets {f_i, E_L}_nh of the declared observables with the energy.
    pub bracket_with_energy: Option<Procedure>,
    /// Outputs: R_L(f_i) + ∂_tf_i, the rest of the rates of the declared observables.
    pub drift_of_outputs: Option<Procedure>,
    /// The equations as Π ∇E.
    pub almost_poisson: Option<AlmostPoisson>,
    /// The stated first integrals.
    pub invariants: Option<InvariantForm>,
    /// The kick of the leapfrog method on TQ: outputs are the velocities after it.
    pub leapfrog: Option<StepForm>,
    /// The discrete momentum of the Euler–Poincaré–Suslov equations, a component for each velocity.
    pub euler_poincare_suslov: Option<StepForm>,
    /// One output: the divergence of the vector field in the coordinates of the state.
    pub divergence: Option<Procedure>,
    /// One output: the density of the invariant volume.
    pub density: Option<Procedure>,
    /// Outputs: the symbols of the constrained connection, Γ^c_{ab} with c fastest.
    pub connection: Option<Procedure>,
    /// Outputs: the Christoffel symbols of the metric on E, Γ^γ_{αβ} with γ fastest.
    pub christoffel: Option<Procedure>,
    /// Outputs: the velocities of the state that the declared section of D* gives.
    pub hamilton_jacobi: Option<Procedure>,
    /// The nonholonomic connection and the momentum equation.
    pub splitting: Option<SplitFunctions>,
}

/// The functions of the basis {S_ρ, h_κ} of D (mathematics (25)); sections by their components in the
/// declared basis.
#[derive(Clone, Debug)]
pub struct SplitFunctions {
    /// The coordinates of the lifts.
    pub coordinates: Vec<SymbolId>,
    /// Outputs: S_ρ.
    pub vertical: Procedure,
    /// Outputs: h_κ.
    pub lifts: Procedure,
    /// Outputs: ⟨S_ρ, S_σ⟩; where there is a kinetic metric.
    pub inertia: Option<Procedure>,
    /// Outputs: [h_κ, S_ρ], with ρ faster than κ.
    pub coefficients: Procedure,
    /// Outputs: [h_κ, h_λ].
    pub curvature: Procedure,
    /// Outputs: P_ρ = p(S_ρ).
    pub momenta: Procedure,
    /// Outputs: their rates.
    pub rates: Procedure,
    /// Outputs: v^ρ.
    pub velocities: Procedure,
    /// Outputs: −p([h_κ, h_λ]) ẋ^λ − p([h_κ, S_ρ]) v^ρ.
    pub force: Procedure,
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
