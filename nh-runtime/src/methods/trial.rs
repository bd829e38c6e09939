//! What an adaptive method leaves to its scheme.

use core::fmt;

use super::{Arrival, Return, Start};
use crate::integrator::Returned;
use crate::step_control::Controller;
use crate::tolerance::Tolerance;
use crate::{Dynamics, Real, ScalarOf, Statistics, VecOf};

/// How far apart two states are, for an estimate of the largest eigenvalue.
#[derive(Clone, Copy, Debug)]
pub struct Spread<V> {
    /// Their difference.
    pub states: V,
    /// That of the derivatives there.
    pub derivatives: V,
    /// The largest components, without signs, at the steps that were looked at in a row until now.
    pub largest: V,
}

/// How an adaptive method computes a step and its error.
#[diagnostic::on_unimplemented(
    message = "`{Self}` takes no steps of `{S}`",
    label = "not a method for this system",
    note = "a method `.with_jacobian()` needs the trait `Jacobian`: add `emit {{ jacobian }}` to the declaration of the system"
)]
pub trait Scheme<S: Dynamics>: Copy {
    /// One more than the order of the error estimate.
    const ERROR_ORDER: u32;
    /// As [`Pair::HELD`](super::Pair::HELD); infinite for a method that stability does not hold back.
    const HELD: f64 = f64::INFINITY;
    /// What is kept of a step.
    type Work: Copy;
    /// What the states within a step are computed from.
    type Dense: Copy;

    /// The law of control where the user has given none.
    #[must_use]
    fn usual_controller() -> Controller<ScalarOf<S>>
    where
        ScalarOf<S>: Real,
    {
        Controller::default()
    }

    /// What there is before the first step.
    fn work(&self) -> Self::Work;

    /// Drops what depends on the input or on the state at the end of the last step.
    fn forget(&self, work: &mut Self::Work);

    /// As [`Method::moved`](super::Method::moved).
    fn moved(&self, work: &mut Self::Work) {
        self.forget(work);
    }

    /// Prepares steps from a new start, and gives the derivative there.
    fn begin<'w>(
        &self,
        start: &Start<'_, S>,
        work: &'w mut Self::Work,
        statistics: &mut Statistics,
    ) -> &'w VecOf<S>;

    /// Computes a step of length `h`, which may be negative, and keeps what dense output needs if it is to
    /// `KEEP` it; otherwise that is computed anew if it should be asked for.
    fn attempt<const KEEP: bool, W: Tolerance<S::State>>(
        &self,
        start: &Start<'_, S>,
        h: ScalarOf<S>,
        tolerance: &W,
        work: &mut Self::Work,
        statistics: &mut Statistics,
    ) -> Trial<S>;

    /// The same, with its end returned to where it belongs, if the method has to evaluate the derivative there: then
    /// that is the one that the next step starts with.
    fn attempt_and_return<const KEEP: bool, W: Tolerance<S::State>, R: Return<S>>(
        &self,
        start: &Start<'_, S>,
        h: ScalarOf<S>,
        tolerance: &W,
        by: &R,
        work: &mut Self::Work,
        statistics: &mut Statistics,
    ) -> (Trial<S>, Option<Returned<S>>) {
        let _ = by;
        (self.attempt::<KEEP, W>(start, h, tolerance, work, statistics), None)
    }

    /// Takes note that the step just computed is accepted.
    fn accept<const KEEP: bool>(&self, start: &Start<'_, S>, h: ScalarOf<S>, work: &mut Self::Work);

    /// The share of its length to try next after the step just computed has failed before there was
    /// an error to estimate; the least that control permits if it is not known.
    fn retry(&self, work: &Self::Work) -> Option<ScalarOf<S>> {
        let _ = work;
        None
    }

    /// The length of the step after one of length `h` that was accepted, where control proposes `next`: the same
    /// for a method to which a new length costs nothing.
    fn continued(&self, h: ScalarOf<S>, next: ScalarOf<S>, work: &Self::Work) -> ScalarOf<S> {
        let _ = (h, work);
        next
    }

    /// Asks the next step that is accepted for what [`spread`](Self::spread) gives, if the method has it.
    fn watch(&self, work: &mut Self::Work) {
        let _ = work;
    }

    /// How far apart two states at the start are, one of which was a stage of the step before: once, after a step that was
    /// watched, the last of several `in_a_row`, or the first.
    fn spread(
        &self,
        start: &Start<'_, S>,
        in_a_row: bool,
        work: &mut Self::Work,
    ) -> Option<Spread<VecOf<S>>> {
        let _ = (start, in_a_row, work);
        None
    }

    /// A derivative that was not finite in the step just computed: component, value, and its time as
    /// a fraction of the step.
    fn blame(&self, start: &Start<'_, S>, h: ScalarOf<S>, work: &Self::Work) -> Option<((usize, f64), f64)>;

    /// As [`Method::dense`](super::Method::dense).
    fn dense(&self, work: &Self::Work, start: &Start<'_, S>, arrival: &Arrival<S>) -> Self::Dense;

    /// As [`Method::interpolate`](super::Method::interpolate).
    fn interpolate(
        &self,
        dense: &Self::Dense,
        start: &Start<'_, S>,
        arrival: &Arrival<S>,
        time: ScalarOf<S>,
    ) -> S::State;
}

/// A step that may be accepted.
pub struct Trial<S: Dynamics> {
    /// Its end.
    pub state: VecOf<S>,
    /// The norm of its error in units of the tolerance; NaN or infinite if anything in the step is
    /// not finite.
    pub error: ScalarOf<S>,
}

impl<S: Dynamics> fmt::Debug for Trial<S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let state = self.state.as_ref();
        f.debug_struct("Trial").field("state", &state).field("error", &self.error).finish()
    }
}
