//! The return to position constraints: at the start, after every step.

use core::fmt;

use super::{Integrator, Spent};
use crate::arrays::first_non_finite;
use crate::methods::{Arrival, Method, Return, Start, ToPositions, component};
use crate::newton_return::product_of_signs;
use crate::{
    Dynamics, IntegrationError, ProjectionError, Real, Scalar, ScalarOf, State, StateFault, Statistics, VecOf,
};

impl<S: Dynamics, M: Method<S>> Integrator<S, M>
where
    ScalarOf<S>: Real,
{
    /// Whether states are returned to position constraints.
    pub(crate) fn is_returned(&self) -> bool {
        self.returns && self.system.has_positions()
    }

    /// Steps to `target`, each with its return.
    pub(super) fn travel_with_returns(
        &mut self,
        target: ScalarOf<S>,
        spent: &mut Spent,
    ) -> Result<(), IntegrationError> {
        while self.time != target {
            self.step_within(spent, target)?;
        }
        Ok(())
    }

    /// Refuses a start that a return would move by more than the method's tolerance.
    pub(super) fn admit_positions(&self) -> Result<(), IntegrationError> {
        if !self.system.has_positions() {
            return Ok(());
        }
        let mut moved = self.state;
        let returned = self.system.return_to_positions(self.time, &mut moved);
        let corrections = self.system.correction(&self.state, &moved);
        let permitted = self.method.permitted(&self.state);
        let mut pairs = corrections.as_ref().iter().zip(permitted.as_ref());
        // what is not a number is beyond it, too
        let found = pairs.position(|(correction, permitted)| !permitted.all_ge(*correction));
        let (None, Ok(_)) = (found, returned) else {
            let StateFault { identity, residual } = self.system.worst_constraint(self.time, &self.state);
            let index = found.unwrap_or(0);
            let correction = match corrections.as_ref().get(index) {
                Some(correction) if returned.is_ok() => correction.to_f64(),
                _ => f64::INFINITY,
            };
            let component = component::<S::State>(index);
            let constraint = identity;
            return Err(IntegrationError::OffConstraints { constraint, residual, component, correction });
        };
        Ok(())
    }
}

/// How a state was returned to where it belongs.
pub struct Returned<S: Dynamics> {
    /// The largest residual that was found.
    pub residual: ScalarOf<S>,
    /// How far each component was moved.
    pub corrections: VecOf<S>,
    /// Whether anything was moved, what goes beside the state included.
    pub is_moved: bool,
}

impl<S: Dynamics> Clone for Returned<S> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<S: Dynamics> Copy for Returned<S> {}

impl<S: Dynamics> fmt::Debug for Returned<S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { residual, corrections, is_moved } = self;
        let mut named = f.debug_struct("Returned");
        named.field("residual", residual).field("corrections", &corrections.as_ref());
        named.field("is_moved", is_moved).finish()
    }
}

impl<S: Dynamics> Returned<S>
where
    ScalarOf<S>: Real,
{
    /// Returns a state by a function that moves it and gives the largest residual that it found.
    ///
    /// # Errors
    /// If the function says so, or leads to what is no number.
    #[inline]
    pub(crate) fn of(
        system: &S,
        state: &mut S::State,
        go: impl FnOnce(&mut S::State) -> Result<ScalarOf<S>, ProjectionError>,
    ) -> Result<Self, ProjectionError> {
        let before = *state;
        let residual = go(state)?;
        let corrections = system.correction(&before, state);
        let after = state.to_array();
        let before = before.to_array();
        let is_moved = before.as_ref() != after.as_ref();
        let is_finite =
            first_non_finite(corrections.as_ref()).is_none() && first_non_finite(after.as_ref()).is_none();
        if !residual.is_finite() || !is_finite {
            return Err(ProjectionError { iterations: 0, residual: residual.to_f64() });
        }
        Ok(Self { residual, corrections, is_moved })
    }

    /// How far the component was moved that was moved farthest.
    #[must_use]
    pub fn correction(&self) -> ScalarOf<S> {
        self.corrections.as_ref().iter().copied().fold(ScalarOf::<S>::ZERO, ScalarOf::<S>::max)
    }
}

/// A step whose end is returned; a method forgets what it has stored about a state that is moved.
pub(super) fn advance<S: Dynamics, M: Method<S>>(
    start: &Start<S>,
    method: &M,
    target: Option<ScalarOf<S>>,
    (memory, statistics): (&mut M::Memory, &mut Statistics),
) -> Result<Arrival<S>, IntegrationError>
where
    ScalarOf<S>: Real,
{
    let (mut arrival, returned) =
        method.advance_and_return(start, target, &ToPositions, memory, statistics)?;
    let returned = if let Some(returned) = returned {
        returned
    } else {
        let returned = ToPositions.state(start.system, arrival.time, &mut arrival.state);
        let returned = returned.map_err(|error| {
            method.stand(memory);
            IntegrationError::Projection { time: arrival.time.to_f64(), error }
        })?;
        if returned.is_moved {
            method.moved(memory);
        }
        returned
    };
    statistics.projections += 1;
    statistics.last_residual = returned.residual.to_f64();
    statistics.largest_correction = statistics.largest_correction.max(returned.correction().to_f64());
    Ok(arrival)
}

/// That a step has not led past a configuration where the velocities in the state do not determine the others.
pub(super) fn stays_on_its_side<S: Dynamics, M: Method<S>>(
    start: &Start<S>,
    method: &M,
    arrival: &Arrival<S>,
    memory: &mut M::Memory,
) -> Result<(), IntegrationError>
where
    ScalarOf<S>: Real,
{
    let before = start.system.side(start.time, start.state);
    let after = start.system.side(arrival.time, &arrival.state);
    // the product of the numbers themselves may be too small to have a sign; what is not a number is on neither side
    if !product_of_signs([before, after]).all_ge(ScalarOf::<S>::ZERO) {
        method.stand(memory);
        let (time, step) = (start.time.to_f64(), (arrival.time - start.time).to_f64());
        return Err(IntegrationError::DeadCentre { time, step });
    }
    Ok(())
}
