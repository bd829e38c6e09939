//! Where an integration has stopped at events, and which of them are still to be reported.

use core::ops::ControlFlow;

use super::start::near;
use super::{Event, EventOf, Events, Side, Station};
use crate::methods::{Method, Start};
use crate::stop::bit;
use crate::{Direction, Dynamics, Integrator, Real, ScalarOf};

impl<S: Dynamics, M: Method<S>> Integrator<S, M>
where
    ScalarOf<S>: Real,
{
    /// Reports what happened where the integration stands and has not been reported: where a function is
    /// still on its way through zero. The event that it stops at.
    pub(super) fn pay_owed<F, const N: usize>(
        &mut self,
        events: &Events<F, N>,
        here: &Station<ScalarOf<S>, N>,
        one: bool,
        visit: &mut impl FnMut(&EventOf<S>) -> ControlFlow<()>,
    ) -> Option<EventOf<S>>
    where
        F: Fn(ScalarOf<S>, &S::State, &S::Input) -> [ScalarOf<S>; N],
    {
        let mut stop = self.stop().filter(|stop| stop.owed != 0)?;
        let start =
            Start { system: self.system(), input: self.input(), time: self.time(), state: self.state() };
        let rates = events.rates(&start, stop.length, &here.values);
        let (time, state) = (self.time(), *self.state());
        let mut stopped = None;
        for (index, (value, rate)) in here.values.iter().zip(rates).enumerate() {
            let Some(direction) = stop.crossed(index) else { continue };
            if stop.owed & bit(index) == 0 || (one && stopped.is_some()) {
                continue;
            }
            stop.owed &= !bit(index);
            let goes = match rate {
                Some(rate) if near(time, *value, rate) => super::side(rate),
                _ => Side::On,
            };
            let goes_on = match direction {
                Direction::Rising => goes == Side::Above,
                _ => goes == Side::Below,
            };
            let event = Event { index, time, state, direction };
            if goes_on && visit(&event).is_break() && stopped.is_none() {
                stopped = Some(event);
            }
        }
        self.set_stop(stop);
        stopped
    }
}
