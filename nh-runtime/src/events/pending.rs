//! Changes of sign that have been found and are still to be reported.

use super::local::Local;
use super::locate::{find, is_wanted};
use super::start::Sides;
use super::{Side, Station, Within, beyond, crossing, reached};
use crate::{Direction, IntegrationError, Real};

/// The sign changes between two stations that are still to be reported, each with its time.
pub(super) struct Pending<T, const N: usize> {
    found: [Option<(T, Direction)>; N],
    /// On which side each function is before those.
    from: [Side; N],
}

impl<T: Real, const N: usize> Pending<T, N> {
    /// Those of a step; the sides are then those at the second station.
    pub(super) fn between(
        directions: &[Direction; N],
        stations: [Station<T, N>; 2],
        sides: &mut Sides<T, N>,
        values_at: Within<'_, [T; N], T>,
    ) -> Result<Self, IntegrationError> {
        let mut found = [None; N];
        let all = sides.of;
        for (index, (slot, from)) in found.iter_mut().zip(all).enumerate() {
            let change = find(directions, index, stations, sides, values_at)?;
            if change.is_some_and(|(time, _)| sides.is_echo(index, from, time)) {
                sides.of.iter_mut().skip(index).take(1).for_each(|side| *side = from);
            } else {
                *slot = change;
            }
        }
        Ok(Self { found, from: all })
    }

    /// The first time, if there is one; `forwards` says what is early.
    pub(super) fn first(&self, forwards: bool) -> Option<T> {
        let before = |a: T, b: T| if forwards { a < b } else { a > b };
        let times = self.found.iter().flatten().map(|(time, _)| *time);
        times.reduce(|a, b| if before(b, a) { b } else { a })
    }

    /// Whether several functions are still to be reported.
    pub(super) fn are_several(&self) -> bool {
        self.found.iter().flatten().nth(1).is_some()
    }

    /// The time at which the first have happened, where those that the functions do not tell apart from it happen with
    /// it; `unit` is a rounding unit of time.
    pub(super) fn instant(&self, forwards: bool, first: T, local: &[Local<T>; N], unit: T) -> T {
        let before = |a: T, b: T| if forwards { a < b } else { a > b };
        let each = || self.found.iter().zip(local).filter_map(|(found, local)| Some(((*found)?.0, local)));
        let own = |own: T, (time, local): (T, &Local<T>)| {
            if time == first { own.max(local.blur(unit)) } else { own }
        };
        let blur = each().fold(T::ZERO, own);
        let with_it =
            each().filter(|(time, local)| (*time - first).abs() <= blur + local.blur(unit)).map(|one| one.0);
        with_it.fold(first, |a, b| if before(a, b) { b } else { a })
    }

    /// Whether the functions that have changed their sign before a time, where they have these values, may be zero there:
    /// what leaves zero with hardly any speed is soon away from it all the same.
    pub(super) fn may_wait(
        &self,
        (forwards, time): (bool, T),
        values: &[T; N],
        local: &[Local<T>; N],
        unit: T,
    ) -> bool {
        let has_changed = |(found, _): (T, Direction)| if forwards { found < time } else { found > time };
        let mut each = self.found.iter().zip(values).zip(local);
        each.all(|((found, value), local)| !found.is_some_and(has_changed) || local.may_be_zero(unit, *value))
    }

    /// Takes out what happens until then, and what the values at that time show to have happened.
    pub(super) fn take(&mut self, forwards: bool, until: T, values: &[T; N]) -> [Option<Direction>; N] {
        let mut taken = [None; N];
        let each = self.found.iter_mut().zip(&mut self.from).zip(values).zip(&mut taken);
        for (((found, from), value), taken) in each {
            if let Some((time, direction)) = *found
                && ((if forwards { time <= until } else { time >= until })
                    || crossing(*from, *value) == Some(direction))
            {
                *found = None;
                *taken = Some(direction);
                *from = if *value == T::ZERO { reached(direction) } else { beyond(direction) };
            }
        }
        taken
    }

    /// Changes of sign that the values at a stop show beyond doubt although they have not been found: of functions that
    /// have changed it twice since. `unit` is a rounding unit of time.
    pub(super) fn unseen(
        &self,
        directions: &[Direction; N],
        values: &[T; N],
        local: &[Local<T>; N],
        unit: T,
    ) -> [Option<Direction>; N] {
        let mut seen = [None; N];
        let each = self.from.iter().zip(directions).zip(values.iter().zip(local)).zip(&mut seen);
        for (((from, wanted), (value, local)), seen) in each {
            *seen = crossing(*from, *value)
                .filter(|direction| is_wanted(*wanted, *direction) && !local.is_zero(unit, *value));
        }
        seen
    }
}
