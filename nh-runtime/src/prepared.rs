//! Systems with what depends on their parameters alone computed ahead.

use core::fmt;

use crate::dynamics::{Dynamics, ScalarOf};

/// A system whose derivative has a part that depends on parameters alone: declared with `emit { prepared }`.
#[diagnostic::on_unimplemented(
    message = "`{Self}` computes nothing ahead",
    label = "needs the trait `Prepare`",
    note = "add `emit {{ prepared }}` to its declaration"
)]
pub trait Prepare: Dynamics {
    /// What is computed ahead.
    type Ahead: Copy;

    /// What the derivative needs of the parameters alone.
    fn computed_ahead(&self) -> Self::Ahead;

    /// The derivative from what was computed ahead.
    fn derivative_from(
        &self,
        ahead: &Self::Ahead,
        t: ScalarOf<Self>,
        state: &Self::State,
        input: &Self::Input,
    ) -> Self::State;
}

/// A system with what depends on its parameters alone computed ahead, parameters included: the same system, which does
/// less at every evaluation.
#[derive(Clone, Copy)]
pub struct Prepared<S: Prepare> {
    system: S,
    ahead: S::Ahead,
}

impl<S: Prepare> Prepared<S> {
    /// Computes it ahead.
    #[inline]
    #[must_use]
    pub fn new(system: S) -> Self {
        let ahead = system.computed_ahead();
        Self { system, ahead }
    }

    /// The system, with the parameters that it was prepared with.
    #[inline]
    pub const fn system(&self) -> &S {
        &self.system
    }

    pub(crate) const fn ahead(&self) -> &S::Ahead {
        &self.ahead
    }
}

impl<S: Prepare + fmt::Debug> fmt::Debug for Prepared<S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Prepared").field(&self.system).finish()
    }
}
