//! The events within a step.

use core::ops::ControlFlow;

use super::start::Sides;
use super::turns::double_changes;
use super::{Event, EventOf, Events, Side, Station, crossing, side};
use crate::methods::Method;
use crate::stop::Stop;
use crate::{Direction, Dynamics, IntegrationError, Integrator, Real, Scalar, ScalarOf};

/// Changes of sign within so many rounding units of time happen at the same time.
const SAME_TIME: f64 = 4.0;

/// The sign changes between two stations that are still to be reported, each with its time.
struct Pending<T, const N: usize> {
    found: [Option<(T, Direction)>; N],
}

impl<T: Real, const N: usize> Pending<T, N> {
    /// Those of a step that begins at `start`; the sides are then those at the second station.
    fn between<F>(
        events: &Events<F, N>,
        stations: [Station<T, N>; 2],
        start: T,
        sides: &mut Sides<T, N>,
        values_at: impl Fn(T) -> Result<[T; N], IntegrationError>,
    ) -> Result<Self, IntegrationError> {
        let mut found = [None; N];
        for (index, slot) in found.iter_mut().enumerate() {
            let from = sides.of;
            let change = find(events, index, stations, &mut sides.of, &values_at)?;
            if change.is_some_and(|(time, _)| sides.is_echo(index, start, time)) {
                sides.of = from;
            } else {
                *slot = change;
            }
        }
        Ok(Self { found })
    }

    /// The time at which the earliest have happened, if there is one; `forwards` says what is early.
    fn time(&self, forwards: bool) -> Option<T> {
        let before = |a: T, b: T| if forwards { a < b } else { a > b };
        let times = || self.found.iter().flatten().map(|(time, _)| *time);
        let earliest = times().reduce(|a, b| if before(b, a) { b } else { a })?;
        let round_off = T::from_f64(SAME_TIME) * T::EPSILON * earliest.abs();
        let same = times().filter(|time| (*time - earliest).abs() <= round_off);
        same.reduce(|a, b| if before(a, b) { b } else { a })
    }

    /// Takes out what happens until then, and calls `visit` for it.
    fn take(&mut self, forwards: bool, until: T, mut visit: impl FnMut(usize, Direction)) {
        for (index, found) in self.found.iter_mut().enumerate() {
            if let Some((time, direction)) = *found
                && (if forwards { time <= until } else { time >= until })
            {
                *found = None;
                visit(index, direction);
            }
        }
    }
}

impl<S: Dynamics, M: Method<S>> Integrator<S, M>
where
    ScalarOf<S>: Real,
{
    /// Looks for events in the last step, from the station `here` and the sides at its start, which become those
    /// at its end; gives the event that a visit stopped at.
    pub(super) fn look_back<F, const N: usize>(
        &mut self,
        events: &Events<F, N>,
        here: &mut Station<ScalarOf<S>, N>,
        sides: &mut Sides<ScalarOf<S>, N>,
        one: bool,
        visit: &mut impl FnMut(&EventOf<S>) -> ControlFlow<()>,
    ) -> Result<Option<EventOf<S>>, IntegrationError>
    where
        F: Fn(ScalarOf<S>, &S::State, &S::Input) -> [ScalarOf<S>; N],
    {
        let (start, end) = (here.time, self.time());
        let forwards = start < end;
        let last = events.station::<S>(end, self.state(), self.input())?;
        let mut ends = sides.of.iter().zip(&last.values);
        if events.samples == 0
            && !ends.any(|(from, value)| *from == Side::On || crossing(*from, *value).is_some())
        {
            *here = last;
            sides.go_on();
            return Ok(None);
        }
        let dense = self.dense();
        let evaluate = |time: ScalarOf<S>| -> Result<_, IntegrationError> {
            let state = dense.at(time)?;
            Ok((state, events.station::<S>(time, &state, self.input())?))
        };
        let values_at = |time| Ok(evaluate(time)?.1.values);
        let parts = events.samples + 1;
        let sampled = |part: u32| -> Result<Option<Station<_, N>>, IntegrationError> {
            if part >= parts {
                return Ok((part == parts).then_some(last));
            }
            let share = ScalarOf::<S>::from_u32(part) / ScalarOf::<S>::from_u32(parts);
            Ok(Some(evaluate(start + (end - start) * share)?.1))
        };
        let mut before = None;
        let mut next = sampled(1)?;
        for part in 1..=parts {
            let Some(there) = next else { break };
            next = sampled(part + 1)?;
            let around = [before.as_ref(), Some(&*here), Some(&there), next.as_ref()];
            let mut turns = Turns(double_changes(&sides.of, around, values_at)?);
            before = Some(*here);
            // from turn to turn of the functions between the two
            loop {
                let turn = turns.next(forwards);
                let to = match turn {
                    Some(time) => evaluate(time)?.1,
                    None => there,
                };
                let mut pending = Pending::between(events, [*here, to], start, sides, values_at)?;
                while let Some(time) = pending.time(forwards) {
                    let state = evaluate(time)?.0;
                    let mut stop = Stop::new(time, end - start);
                    let mut stopped = None;
                    let mut accumulating = None;
                    pending.take(forwards, time, |index, direction| {
                        let is_reported = !one || stopped.is_none();
                        stop.note(index, direction, is_reported);
                        if sides.is_flight(index) && !stop.ends_flight(start, sides.stop.as_ref()) {
                            accumulating = accumulating.or(Some(index));
                            return;
                        }
                        let event = Event { index, time, state, direction };
                        if is_reported && visit(&event).is_break() && stopped.is_none() {
                            stopped = Some(event);
                        }
                    });
                    if let Some(event) = accumulating {
                        return Err(IntegrationError::EventsAccumulate {
                            event,
                            time: start.to_f64(),
                            flight: (time - start).abs().to_f64(),
                            resolution: Stop::resolution(start, time).to_f64(),
                        });
                    }
                    if stopped.is_some() {
                        self.stand_at(time, state);
                        self.set_stop(stop);
                        return Ok(stopped);
                    }
                }
                *here = to;
                if turn.is_none() {
                    break;
                }
            }
        }
        sides.go_on();
        Ok(None)
    }
}

/// The change of sign of a function between two stations, if it is wanted; its side is then that at the second.
fn find<T: Real, F, const N: usize>(
    events: &Events<F, N>,
    index: usize,
    [here, there]: [Station<T, N>; 2],
    sides: &mut [Side; N],
    values_at: &impl Fn(T) -> Result<[T; N], IntegrationError>,
) -> Result<Option<(T, Direction)>, IntegrationError> {
    let (Some(from), Some(&old), Some(&value), Some(wanted)) =
        (sides.get_mut(index), here.values.get(index), there.values.get(index), events.directions.get(index))
    else {
        return Ok(None);
    };
    let Some(direction) = crossing(*from, value) else {
        if *from == Side::On {
            *from = side(value);
        }
        return Ok(None);
    };
    let before = *from;
    // what has reached zero has crossed
    *from = if direction == Direction::Rising { Side::Above } else { Side::Below };
    if *wanted != Direction::Either && *wanted != direction {
        return Ok(None);
    }
    let value_at = |time| values_at(time).map(|values| values.get(index).copied().unwrap_or(value));
    let start = in_flight(before, ((here.time, old), there.time), &value_at)?;
    let time = locate(before, (start, (there.time, value)), value_at)?;
    Ok(Some((time, direction)))
}

/// A point at which a function that leaves zero shows the side that it moves to: nearer and nearer to where it left,
/// as far as time resolves it, and that place itself if there is none.
fn in_flight<T: Real>(
    to: Side,
    ((time, value), end): ((T, T), T),
    value_at: &impl Fn(T) -> Result<T, IntegrationError>,
) -> Result<(T, T), IntegrationError> {
    let half = T::from_f64(0.5);
    let mut distance = end - time;
    while side(value) != to && time + distance != time {
        distance *= half;
        let there = value_at(time + distance)?;
        if side(there) == to {
            return Ok((time + distance, there));
        }
    }
    Ok((time, value))
}

/// Times that are taken one after the other.
struct Turns<T, const N: usize>([Option<T>; N]);

impl<T: Real, const N: usize> Turns<T, N> {
    /// Takes out the first of them.
    fn next(&mut self, forwards: bool) -> Option<T> {
        let before = |a: T, b: T| if forwards { a < b } else { a > b };
        let first = self.0.iter().flatten().copied().reduce(|a, b| if before(b, a) { b } else { a })?;
        for time in &mut self.0 {
            if *time == Some(first) {
                *time = None;
            }
        }
        Some(first)
    }
}

impl<T: Real, const N: usize> Sides<T, N> {
    /// Forgets the start of the run.
    fn go_on(&mut self) {
        *self = Self { of: self.of, leaving: [false; N], is_given: false, stop: None };
    }

    /// Whether a function has left zero where a state was given.
    fn is_flight(&self, index: usize) -> bool {
        self.is_given && self.leaving.get(index) == Some(&true)
    }

    /// Whether a change so soon after the start is round-off that follows an event which has been reported.
    fn is_echo(&self, index: usize, start: T, time: T) -> bool {
        let resolution = T::from_f64(SAME_TIME) * T::EPSILON * start.abs().max(time.abs());
        !self.is_given && self.leaving.get(index) == Some(&true) && (time - start).abs() <= resolution
    }
}

/// The first time with a new sign between two, to the resolution of time: by the Illinois variant of
/// the regula falsi (Dowell, Jarratt, BIT 11 (1971) 168), and every third time by bisection, which
/// halves the interval at least.
fn locate<T: Real>(
    from: Side,
    (mut before, mut after): ((T, T), (T, T)),
    value_at: impl Fn(T) -> Result<T, IntegrationError>,
) -> Result<T, IntegrationError> {
    let half = T::from_f64(0.5);
    let mut kept_after = false;
    for count in 1_u32.. {
        let resolution = T::EPSILON * after.0.abs().max(before.0.abs());
        if (after.0 - before.0).abs() <= resolution || after.1 == T::ZERO {
            break;
        }
        let middle = before.0 + (after.0 - before.0) * half;
        let chord = after.0 - (after.0 - before.0) * (after.1 / (after.1 - before.1));
        let inside = (before.0 < chord && chord < after.0) || (after.0 < chord && chord < before.0);
        let time = if count % 3 != 0 && inside { chord } else { middle };
        if time == before.0 || time == after.0 {
            break;
        }
        let value = value_at(time)?;
        if crossing(from, value).is_some() {
            after = (time, value);
            if kept_after {
                before.1 *= half;
            }
            kept_after = true;
        } else {
            before = (time, value);
            if !kept_after {
                after.1 *= half;
            }
            kept_after = false;
        }
    }
    Ok(after.0)
}
