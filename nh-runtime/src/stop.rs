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
    /// The same of a gap, which nothing takes below zero: where a state is given at zero or below it, it comes down from
    /// there too, unless it rises, and that is an event. What rests on the ground meets it at once.
    Closing,
}

/// A stop at events: bits of the functions, of the first 128.
#[derive(Clone, Copy)]
pub(crate) struct Stop<T> {
    pub(crate) time: T,
    /// The length of the step that led past it, signed.
    pub(crate) length: T,
    /// A rounding unit of time in that step.
    pub(crate) unit: T,
    /// How long the motion to it was, from where the call began that came to it: at the stop before, for the most part.
    pub(crate) flight: T,
    /// Those that have changed their sign there.
    rising: u128,
    falling: u128,
    /// Those among them that have not been reported.
    pub(crate) owed: u128,
    /// Those that have not, and are so near to zero that they may there.
    coming: [u128; 2],
    /// What tells the functions from others, by their values here.
    pub(crate) print: u64,
    /// How many flights in a row from zero to zero have been hardly longer than time resolves.
    short_flights: u32,
}

/// A flight of at most so many rounding units of time is none.
const NO_FLIGHT: f64 = 64.0;
/// A flight of at most so many is short, and so many in a row do not end: what the rounding of time adds
/// to the speed after each outweighs what an impact takes.
const SHORT_FLIGHT: f64 = 512.0;
const MOST_SHORT_FLIGHTS: u32 = 64;
/// The same for how far a function gets from zero, in its own roundings.
pub(crate) const NO_HEIGHT: f64 = 8.0;
pub(crate) const SHORT_HEIGHT: f64 = 128.0;

/// The functions that a stop has bits for.
pub(crate) const MOST_FUNCTIONS: usize = 128;

/// How long a function that left zero was away, and how far.
#[derive(Clone, Copy)]
pub(crate) struct Flight<T> {
    /// When it left.
    pub(crate) start: T,
    /// Whether it got no farther than rounding shows it: by [`NO_HEIGHT`] and [`SHORT_HEIGHT`].
    pub(crate) is_hidden: [bool; 2],
    /// Whether it was no flight, but begins with a contact that has not been met yet.
    pub(crate) is_contact: bool,
}

pub(crate) fn bit(index: usize) -> u128 {
    u32::try_from(index).ok().and_then(|index| 1_u128.checked_shl(index)).unwrap_or(0)
}

impl<T: Real> Stop<T> {
    pub(crate) fn new(time: T, [start, end]: [T; 2]) -> Self {
        let (length, unit) = (end - start, Self::resolution(start, end));
        Self {
            time,
            length,
            unit,
            flight: T::ZERO,
            rising: 0,
            falling: 0,
            owed: 0,
            coming: [0; 2],
            print: 0,
            short_flights: 0,
        }
    }

    /// Takes note that this stop ends a flight from zero to zero that began at the stop `before`; whether there will be
    /// an end to such flights.
    pub(crate) fn ends_flight(&mut self, flight: Flight<T>, before: Option<&Self>) -> bool {
        let length = (self.time - flight.start).abs();
        let unit = Self::resolution(flight.start, self.time);
        let [is_none, is_short] = flight.is_hidden;
        if is_short || length <= T::from_f64(SHORT_FLIGHT) * unit {
            self.short_flights = before.map_or(0, |stop| stop.short_flights) + 1;
        }
        let is_flight = !is_none && length > T::from_f64(NO_FLIGHT) * unit;
        (is_flight || flight.is_contact) && self.short_flights <= MOST_SHORT_FLIGHTS
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

    /// Takes note of a function that has not, but is at zero for all that one can tell and on its way in this direction.
    pub(crate) fn await_change(&mut self, index: usize, direction: Direction) {
        let [rising, falling] = &mut self.coming;
        *(if direction == Direction::Rising { rising } else { falling }) |= bit(index);
    }

    /// The change of sign that may have to come here.
    pub(crate) fn coming(&self, index: usize) -> Option<Direction> {
        let [rising, falling] = self.coming;
        if rising & bit(index) != 0 {
            Some(Direction::Rising)
        } else {
            (falling & bit(index) != 0).then_some(Direction::Falling)
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
