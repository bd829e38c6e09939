//! A stop at events: which functions have changed their sign, and which of them are still to be reported.

use crate::Real;

/// Which changes of sign are events.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Direction {
    /// Both.
    #[default]
    Either,
    /// From negative to positive, in the direction in which the integration goes.
    Rising,
    /// From positive to negative.
    Falling,
}

/// A stop at events: bits of the functions, of the first 128.
#[derive(Clone, Copy)]
pub(crate) struct Stop<T> {
    pub(crate) time: T,
    /// The length of the step that led past it, signed.
    pub(crate) length: T,
    /// Those that have changed their sign there.
    rising: u128,
    falling: u128,
    /// Those among them that have not been reported.
    pub(crate) owed: u128,
    /// How many flights in a row from zero to zero have been hardly longer than time resolves.
    short_flights: u32,
}

/// A flight of at most so many rounding units of time is none.
const NO_FLIGHT: f64 = 64.0;
/// A flight of at most so many is short, and so many in a row do not end: what the rounding of time adds
/// to the speed after each outweighs what an impact takes.
const SHORT_FLIGHT: f64 = 512.0;
const MOST_SHORT_FLIGHTS: u32 = 64;

pub(crate) fn bit(index: usize) -> u128 {
    u32::try_from(index).ok().and_then(|index| 1_u128.checked_shl(index)).unwrap_or(0)
}

impl<T: Real> Stop<T> {
    pub(crate) fn new(time: T, length: T) -> Self {
        Self { time, length, rising: 0, falling: 0, owed: 0, short_flights: 0 }
    }

    /// Takes note that this stop ends a flight from zero to zero that began at `start`, at the stop `before`;
    /// whether there will be an end to such flights.
    pub(crate) fn ends_flight(&mut self, start: T, before: Option<&Self>) -> bool {
        let length = (self.time - start).abs() / Self::resolution(start, self.time);
        if length <= T::from_f64(SHORT_FLIGHT) {
            self.short_flights = before.map_or(0, |stop| stop.short_flights) + 1;
        }
        length > T::from_f64(NO_FLIGHT) && self.short_flights <= MOST_SHORT_FLIGHTS
    }

    /// A rounding unit of time on a flight.
    pub(crate) fn resolution(start: T, end: T) -> T {
        T::EPSILON * start.abs().max(end.abs())
    }

    /// Takes note of a function that has changed its sign.
    pub(crate) fn note(&mut self, index: usize, direction: Direction, is_reported: bool) {
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
    pub(crate) fn crossed(&self, index: usize) -> Option<Direction> {
        if self.rising & bit(index) != 0 {
            Some(Direction::Rising)
        } else if self.falling & bit(index) != 0 {
            Some(Direction::Falling)
        } else {
            None
        }
    }
}
