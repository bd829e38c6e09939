//! What an integration has cost.

/// What an integration has cost.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Statistics {
    /// The steps taken.
    pub steps: u64,
    /// The steps tried and rejected, because of the error estimate, of a correction beyond the tolerance or of a stage that
    /// is not finite.
    pub rejected: u64,
    /// The evaluations of the derivative in steps that were tried, those for Jacobians included. Not counted is what
    /// dense output, events and the words of an error take beside these.
    pub evaluations: u64,
    /// The Jacobians formed.
    pub jacobians: u64,
    /// The factorizations of matrices.
    pub factorizations: u64,
    /// The iterations of implicit methods.
    pub iterations: u64,
    /// The time at which an explicit adaptive method has noticed that the equations are stiff: fifteen times its steps were
    /// about as long as stability permits, and not as the tolerance does, and a better estimate of the largest eigenvalue has
    /// confirmed it. An implicit method, or
    /// [`Auto`](crate::methods::Auto), takes longer steps then. [`Bs23`](crate::Bs23) and methods of fixed step do not look.
    pub stiff_at: Option<f64>,
    /// How often [`Auto`](crate::methods::Auto) has gone from explicit to implicit steps, or back.
    pub switches: u64,
    /// The projections to the constraints, or to the level of a [`Conserving`](crate::Conserving) method, those included that
    /// found nothing to correct.
    pub projections: u64,
    /// The largest change that a projection has made to a component of the state. Methods that choose their steps keep what
    /// each adds to it to their tolerance; where steps are fixed, or a level is returned to, nothing bounds it, and it is to be
    /// looked at.
    pub largest_correction: f64,
    /// The largest constraint residual that the last projection to constraints found, before it corrected it.
    pub last_residual: f64,
}
