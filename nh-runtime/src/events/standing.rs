//! Where an integration has stopped at events, and which of them are still to be reported.

use super::{Event, EventOf, Side, Station, Visit, Watched, print};
use crate::methods::{Method, Start};
use crate::stop::bit;
use crate::{Direction, Dynamics, Integrator, Real, ScalarOf};

impl<S: Dynamics, M: Method<S>> Integrator<S, M>
where
    ScalarOf<S>: Real,
{
    /// Reports what happened where the integration stands and has not been reported; where another state has been given
    /// there, of that only where a function is still on its way through zero. The event that it stops at.
    pub(super) fn pay_owed<const N: usize>(
        &mut self,
        events: &Watched<'_, S, N>,
        here: &Station<ScalarOf<S>, N>,
        one: bool,
        visit: Visit<'_, S>,
    ) -> Option<EventOf<S>> {
        let mut stop = self.stop().filter(|stop| stop.owed != 0)?;
        let start =
            Start { system: self.system(), input: self.input(), time: self.time(), state: self.state() };
        let is_given = self.last_step().is_none();
        // other functions have nothing to do with what these were owed
        if !is_given && stop.print != print(&here.values) {
            return None;
        }
        let beyond = self.last_step().map_or(*start.state, |(_, arrival)| arrival.state);
        let local = events.local(&start, (stop.length, &beyond), &here.values);
        let (time, state) = (self.time(), *self.state());
        let mut stopped = None;
        for (index, (value, local)) in here.values.iter().zip(local).enumerate() {
            let Some(direction) = stop.crossed(index) else { continue };
            if stop.owed & bit(index) == 0 || (one && stopped.is_some()) {
                continue;
            }
            stop.owed &= !bit(index);
            let goes = match local.rate {
                Some(rate) if local.is_zero(stop.unit, *value) => super::side(rate),
                _ => Side::On,
            };
            let goes_on = match direction {
                Direction::Rising => goes == Side::Above,
                _ => goes == Side::Below,
            };
            let event = Event { index, time, state, direction };
            if (goes_on || !is_given) && visit(&event).is_break() && stopped.is_none() {
                stopped = Some(event);
            }
        }
        self.set_stop(stop);
        stopped
    }
}
