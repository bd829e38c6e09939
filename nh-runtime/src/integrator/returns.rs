//! The return to position constraints: at the start, after every step.

use super::{Integrator, Spent};
use crate::methods::{Arrival, Method, Start, component};
use crate::{
    Dynamics, IntegrationError, ProjectionError, Real, Scalar, ScalarOf, State, StateFault, Statistics,
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
        let (before, after) = (self.state.to_array(), moved.to_array());
        let permitted = self.method.permitted(&self.state);
        let pairs = before.as_ref().iter().zip(after.as_ref()).zip(permitted.as_ref());
        let mut corrections =
            pairs.map(|((before, after), permitted)| ((*after - *before).abs(), *permitted));
        // what is not a number is beyond it, too
        let found = corrections.position(|(correction, permitted)| !permitted.all_ge(correction));
        let (None, Ok(_)) = (found, returned) else {
            let StateFault { identity, residual } = self.system.worst_constraint(self.time, &self.state);
            let index = found.unwrap_or(0);
            let correction = match (before.as_ref().get(index), after.as_ref().get(index)) {
                (Some(before), Some(after)) if returned.is_ok() => (*after - *before).abs().to_f64(),
                _ => f64::INFINITY,
            };
            let component = component::<S::State>(index);
            let constraint = identity;
            return Err(IntegrationError::OffConstraints { constraint, residual, component, correction });
        };
        Ok(())
    }
}

/// Returns the end of a step; a method forgets what it has stored about a state that is moved.
pub(super) fn correct<S: Dynamics, M: Method<S>>(
    system: &S,
    method: &M,
    arrival: &mut Arrival<S>,
    (memory, statistics): (&mut M::Memory, &mut Statistics),
) -> Result<(), IntegrationError>
where
    ScalarOf<S>: Real,
{
    let before = arrival.state.to_array();
    let time = arrival.time.to_f64();
    let residual = system.return_to_positions(arrival.time, &mut arrival.state);
    let residual = residual.map_err(|error| {
        method.forget(memory);
        IntegrationError::Projection { time, error }
    })?;
    let after = arrival.state.to_array();
    let pairs = before.as_ref().iter().zip(after.as_ref());
    let correction =
        pairs.fold(ScalarOf::<S>::ZERO, |largest, (before, after)| largest.max((*after - *before).abs()));
    if !residual.is_finite() || !correction.is_finite() {
        method.forget(memory);
        let error = ProjectionError { iterations: 0, residual: residual.to_f64() };
        return Err(IntegrationError::Projection { time, error });
    }
    if correction != ScalarOf::<S>::ZERO {
        method.moved(memory);
    }
    statistics.projections += 1;
    statistics.last_residual = residual.to_f64();
    statistics.largest_correction = statistics.largest_correction.max(correction.to_f64());
    Ok(())
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
    if before * after < ScalarOf::<S>::ZERO {
        method.forget(memory);
        let (time, step) = (start.time.to_f64(), (arrival.time - start.time).to_f64());
        return Err(IntegrationError::DeadCentre { time, step });
    }
    Ok(())
}
