//! Where an integration has stopped at events, and which of them are still to be reported.

use core::ops::ControlFlow;

use super::start::near;
use super::{Direction, Event, EventOf, Events, Side, Station};
use crate::methods::{Method, Start};
use crate::{Dynamics, Integrator, Real, ScalarOf};

/// A stop at events: bits of the functions, of the first 128.
#[derive(Clone, Copy)]
pub(crate) struct Stop<T> {
    pub(crate) time: T,
    /// The length of the step that led past it, signed.
    length: T,
    /// Those that have changed their sign there.
    rising: u128,
    falling: u128,
    /// Those among them that have not been reported.
    owed: u128,
    /// How many flights in a row from zero to zero have been hardly longer than time resolves.
    short_flights: u32,
}

/// A flight of at most so many rounding units of time is none.
const NO_FLIGHT: f64 = 64.0;
/// A flight of at most so many is short, and so many in a row do not end: what the rounding of time adds
/// to the speed after each outweighs what an impact takes.
const SHORT_FLIGHT: f64 = 512.0;
const MOST_SHORT_FLIGHTS: u32 = 64;

fn bit(index: usize) -> u128 {
    u32::try_from(index).ok().and_then(|index| 1_u128.checked_shl(index)).unwrap_or(0)
}

impl<T: Real> Stop<T> {
    pub(super) fn new(time: T, length: T) -> Self {
        Self { time, length, rising: 0, falling: 0, owed: 0, short_flights: 0 }
    }

    /// Takes note that this stop ends a flight from zero to zero that began at `start`, at the stop `before`;
    /// whether there will be an end to such flights.
    pub(super) fn ends_flight(&mut self, start: T, before: Option<&Self>) -> bool {
        let length = (self.time - start).abs() / (T::EPSILON * start.abs().max(self.time.abs()));
        if length <= T::from_f64(SHORT_FLIGHT) {
            self.short_flights = before.map_or(0, |stop| stop.short_flights) + 1;
        }
        length > T::from_f64(NO_FLIGHT) && self.short_flights <= MOST_SHORT_FLIGHTS
    }

    /// Takes note of a function that has changed its sign.
    pub(super) fn note(&mut self, index: usize, direction: Direction, is_reported: bool) {
        if direction == Direction::Rising {
            self.rising |= bit(index);
        } else {
            self.falling |= bit(index);
        }
        if !is_reported {
            self.owed |= bit(index);
        }
    }

    /// The way in which a function has changed its sign here.
    pub(super) fn crossed(&self, index: usize) -> Option<Direction> {
        if self.rising & bit(index) != 0 {
            Some(Direction::Rising)
        } else if self.falling & bit(index) != 0 {
            Some(Direction::Falling)
        } else {
            None
        }
    }
}

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
