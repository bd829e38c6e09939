//! What is wrong with a declaration, in the words of the field.

use crate::id::Origin;

/// The law that a declaration breaks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum Law {
    /// Every declared expression is defined.
    Defined,
    /// The anchor is linear and homogeneous in the quasi-velocities, a line per coordinate.
    Anchor,
    /// A coframe is square, linear and invertible.
    Coframe,
    /// Brackets are declared where they cannot be derived, consistently.
    Brackets,
    /// The anchor is a homomorphism of brackets, mathematics (2): CLMM (2.1), CNS (6).
    Homomorphism,
    /// The Jacobi identity, mathematics (3): CLMM (2.1), CNS (7).
    Jacobi,
    /// Identities of embedded base coordinates, which the anchor keeps.
    Embedding,
    /// An axis has length 1, and an attitude is a rotation matrix.
    Attitude,
    /// Facts about parameters are about parameters and do not contradict each other.
    Assumption,
    /// A frame is a basis of sections at most points.
    Frame,
    /// A claimed first integral is one.
    Conservation,
    /// A section of `symmetries` lies in D, or leaves L and D invariant: CLMM Theorems 3.5 and 5.3.
    Symmetry,
    /// The Lagrangian is smooth.
    Smooth,
    /// The shape of a constraint.
    Constraint,
    /// Constraints are independent, and fewer than the sections.
    Independence,
    /// The choice of the independent velocities.
    Choice,
    /// The mass matrix is regular on the constraint distribution: CLMM Theorem 3.12.
    Regularity,
    /// Auxiliary states: their rates do not go round in a circle, and nothing is asked of them that they have not.
    Auxiliary,
    /// A force acts along a declared direction and depends on what it may.
    Force,
    /// What is asked for depends on nothing that `track` leaves out.
    Tracking,
    /// What a linearisation keeps is in the state, each once.
    Linearization,
    /// Impacts: what velocities jump to is linear in them, and independent of what holds all the time.
    Impact,
    /// A map between two systems is a reduction: mathematics (13), (14), CLMM Theorem 4.6.
    Morphism,
    /// What a quotient drops, nothing depends on: CM section 4, CLMM 4.8–4.12.
    Invariance,
    /// What is asked of the Hamiltonian side exists.
    Hamiltonian,
    /// A claimed invariant volume is one: M 2.5.
    Volume,
    /// A section of D* solves the Hamilton–Jacobi equation: M 2.4.
    HamiltonJacobi,
    /// Sums, equations and arguments of functions are homogeneous in their units.
    Units,
    /// What has to have a Taylor series is analytic.
    Analytic,
    /// Numbers of the equations are numbers of the scalar type.
    Representable,
    /// The limits on the work that a declaration may take.
    Size,
    /// A question that the algebra could not decide.
    Decidable,
}

/// One broken law: what is wrong, the evidence, and a way out.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Violation {
    /// Which law.
    pub law: Law,
    /// Where it is broken.
    pub origin: Origin,
    /// What is wrong.
    pub what: String,
    /// The offending symbol and the expression that should have been zero; may be empty.
    pub evidence: String,
    /// What the user can do.
    pub way_out: String,
}

impl Violation {
    /// What is wrong, evidence and way out, a line each.
    #[must_use]
    pub fn message(&self) -> String {
        let mut text = self.what.clone();
        if !self.evidence.is_empty() {
            text.push('\n');
            text.push_str(&self.evidence);
        }
        if !self.way_out.is_empty() {
            text.push_str("\nhelp: ");
            text.push_str(&self.way_out);
        }
        text
    }
}
