//! What `emit { … }` asks for, and the words for it.

/// Something to generate beyond the default.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Request {
    /// ∂derivative/∂state and ∂derivative/∂input.
    Jacobian,
    /// Both without their zeros.
    SparseJacobian,
    /// The Jacobian of the derivative times a direction in state and inputs.
    JacobianProduct,
    /// The transpose of that Jacobian times weights of the components of the derivative.
    AdjointProduct,
    /// The derivative of the return to position constraints.
    ReturnJacobian,
    /// ∂derivative/∂parameter.
    ParameterJacobian,
    /// The derivative with what depends on parameters alone computed ahead.
    Prepared,
    /// The derivative with sines and cosines from those of angles nearby.
    AngleCache,
    /// The multipliers λ_A.
    Multipliers,
    /// The reaction forces λ_A ∂φ^A/∂y^α along the sections.
    Reactions,
    /// The momenta of the symmetries, and their rates.
    Momenta,
    /// ⟨J, K⟩ of a Chaplygin system.
    Gyroscopic,
    /// The nonholonomic connection, its curvature, and the momentum equation.
    Splitting,
    /// Momenta, the Legendre transformation, h, Hamilton's equations and the almost-Poisson matrix.
    Hamiltonian,
    /// The nonholonomic brackets of the observables.
    Bracket,
    /// The almost-Poisson form for methods that keep the energy.
    DiscreteGradient,
    /// The equations that a step can keep by itself, with the directions in which they are corrected.
    SymmetricProjection,
    /// The divergence of the motion.
    Divergence,
    /// The density of an invariant volume.
    Volume,
    /// The symbols of the Levi-Civita and of the constrained connection.
    Connection,
    /// The stated first integrals and their gradients.
    Invariants,
    /// The leapfrog method on TQ.
    Leapfrog,
    /// The variational method on TQ with position constraints.
    Rattle,
    /// The discrete Euler–Poincaré–Suslov equations on a Lie algebra.
    EulerPoincareSuslov,
    /// The derivative by the Gibbs–Appell function.
    GibbsAppell,
    /// The Taylor coefficients of solutions.
    Taylor,
    /// The power of each force and constraint.
    Power,
    /// ∂output/∂state and ∂output/∂input.
    OutputJacobian,
    /// How the emitted forms were chosen, as text.
    Explain,
    /// The declaration and what was derived, in TeX.
    Latex,
    /// The generated functions as C.
    C,
}

impl Request {
    /// Whether it asks for derivatives of the right-hand side.
    #[must_use]
    pub fn differentiates_the_motion(self) -> bool {
        matches!(
            self,
            Self::Jacobian
                | Self::SparseJacobian
                | Self::JacobianProduct
                | Self::AdjointProduct
                | Self::ParameterJacobian
        )
    }

    /// Whether derivatives of the right-hand side are computed for it: a divergence is made of them, too.
    #[must_use]
    pub fn computes_slopes(self) -> bool {
        self.differentiates_the_motion() || self == Self::Divergence
    }

    /// Whether it asks for steps that are made of all velocities, so that the state has to keep them.
    #[must_use]
    pub fn keeps_all_velocities(self) -> bool {
        matches!(self, Self::Leapfrog | Self::Rattle)
    }

    /// The words by which `emit` asks for them.
    pub const WORDS: [(&str, Self); 31] = [
        ("jacobian", Self::Jacobian),
        ("taylor", Self::Taylor),
        ("sparse_jacobian", Self::SparseJacobian),
        ("jacobian_product", Self::JacobianProduct),
        ("adjoint_product", Self::AdjointProduct),
        ("return_jacobian", Self::ReturnJacobian),
        ("parameter_jacobian", Self::ParameterJacobian),
        ("output_jacobian", Self::OutputJacobian),
        ("power", Self::Power),
        ("prepared", Self::Prepared),
        ("angle_cache", Self::AngleCache),
        ("multipliers", Self::Multipliers),
        ("reactions", Self::Reactions),
        ("momenta", Self::Momenta),
        ("gyroscopic", Self::Gyroscopic),
        ("splitting", Self::Splitting),
        ("gibbs_appell", Self::GibbsAppell),
        ("hamiltonian", Self::Hamiltonian),
        ("bracket", Self::Bracket),
        ("discrete_gradient", Self::DiscreteGradient),
        ("symmetric_projection", Self::SymmetricProjection),
        ("divergence", Self::Divergence),
        ("volume", Self::Volume),
        ("connection", Self::Connection),
        ("invariants", Self::Invariants),
        ("leapfrog", Self::Leapfrog),
        ("rattle", Self::Rattle),
        ("euler_poincare_suslov", Self::EulerPoincareSuslov),
        ("explain", Self::Explain),
        ("latex", Self::Latex),
        ("c", Self::C),
    ];
}
