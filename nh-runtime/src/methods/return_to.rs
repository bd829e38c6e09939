//! Where the state at the end of a step is returned to.

use super::Returned;
use crate::tolerance::{Tolerance, norm};
use crate::{Dynamics, ProjectionError, Real, ScalarOf, State, VecOf};

/// Where the state at the end of a step belongs, and what the way there says of the step.
pub trait Return<S: Dynamics> {
    /// Moves a state to where it belongs at a time.
    ///
    /// # Errors
    /// If it does not get there.
    fn state(&self, system: &S, t: ScalarOf<S>, state: &mut S::State) -> Result<Returned<S>, ProjectionError>
    where
        ScalarOf<S>: Real;

    /// How far a step has come off, in units of the tolerance: beyond 1 the step is refused. The end is the one that was
    /// returned.
    #[inline]
    fn error<W: Tolerance<S::State>>(
        &self,
        tolerance: &W,
        returned: &Returned<S>,
        start: &S::State,
        end: &VecOf<S>,
    ) -> ScalarOf<S>
    where
        ScalarOf<S>: Real,
    {
        norm(tolerance, &returned.corrections, &start.to_array(), end)
    }
}

/// The return to position constraints.
#[derive(Clone, Copy, Debug)]
pub struct ToPositions;

impl<S: Dynamics> Return<S> for ToPositions {
    #[inline]
    fn state(&self, system: &S, t: ScalarOf<S>, state: &mut S::State) -> Result<Returned<S>, ProjectionError>
    where
        ScalarOf<S>: Real,
    {
        Returned::of(system, state, |state| system.return_to_positions(t, state))
    }
}
