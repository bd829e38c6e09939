//! The events within a step.

use core::cell::Cell;

use super::local::Local;
use super::pending::Pending;
use super::start::{Contacts, Sides, midway};
use super::turns::double_changes;
use super::{Event, EventOf, Events, Side, Station, Visit, Watched, Within, crossing, print, side};
use crate::methods::{Method, Start};
use crate::stop::{Flight, NO_HEIGHT, SHORT_HEIGHT, Stop};
use crate::{Direction, Dynamics, IntegrationError, Integrator, Real, ScalarOf};

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
        visit: Visit<'_, S>,
    ) -> Result<Option<EventOf<S>>, IntegrationError>
    where
        F: Fn(ScalarOf<S>, &S::State, &S::Input) -> [ScalarOf<S>; N],
    {
        let reached = events.station::<S>(self.time(), self.state(), self.input())?;
        let over = sides.contacts().over(reached);
        let mut ends = sides.of.iter().zip(over.values);
        let is_looked_into = events.samples > 0
            || ends.any(|(from, value)| *from == Side::On || crossing(*from, value).is_some());
        if is_looked_into {
            let stopped = self.look_into(&events.watched::<S>(), [*here, reached], sides, one, visit)?;
            if stopped.is_some() {
                return Ok(stopped);
            }
        }
        *here = reached;
        sides.go_on(&reached.values);
        Ok(None)
    }

    /// Looks for events in the last step, between these stations.
    fn look_into<const N: usize>(
        &mut self,
        events: &Watched<'_, S, N>,
        [here, reached]: [Station<ScalarOf<S>, N>; 2],
        sides: &mut Sides<ScalarOf<S>, N>,
        one: bool,
        visit: Visit<'_, S>,
    ) -> Result<Option<EventOf<S>>, IntegrationError> {
        let (start, end) = (here.time, reached.time);
        let forwards = start < end;
        let contacts = Cell::new(sides.contacts());
        let over = |station| contacts.get().over(station);
        let dense = self.dense();
        let evaluate = |time: ScalarOf<S>| -> Result<_, IntegrationError> {
            let state = dense.at(time)?;
            Ok((state, events.station::<S>(time, &state, self.input())?))
        };
        let station_at = |time| -> Result<_, IntegrationError> { Ok(evaluate(time)?.1) };
        let raw_at = |time| Ok(station_at(time)?.values);
        let values_at = |time| Ok(over(station_at(time)?).values);
        let parts = events.samples + 1;
        let sampled = |part: u32| -> Result<Option<Station<_, N>>, IntegrationError> {
            if part >= parts {
                return Ok((part == parts).then_some(reached));
            }
            let share = ScalarOf::<S>::from_u32(part) / ScalarOf::<S>::from_u32(parts);
            Ok(Some(station_at(start + (end - start) * share)?))
        };
        let mut before = None;
        let mut begun = here;
        let mut next = sampled(1)?;
        for part in 1..=parts {
            let Some(there) = next else { break };
            next = sampled(part + 1)?;
            let around = [before, Some(begun), Some(there), next];
            let mut turns = Turns::between(&sides.of, &contacts.get(), around, &raw_at)?;
            before = Some(begun);
            // from turn to turn of the functions between the two
            loop {
                let turn = turns.next(forwards);
                let to = match turn {
                    Some(time) => station_at(time)?,
                    None => there,
                };
                let mut pending =
                    Pending::between(&events.directions, [begun, to].map(over), sides, &values_at)?;
                while let Some(first) = pending.first(forwards) {
                    let mut time = first;
                    if pending.are_several() {
                        let (state, station) = evaluate(first)?;
                        let local = self.local_at(events, &state, &station, end - start);
                        let unit = Stop::resolution(start, end);
                        let last = pending.instant(forwards, first, &local, unit);
                        if pending.may_wait((forwards, last), &values_at(last)?, &local, unit) {
                            time = last;
                        }
                    }
                    let (state, station) = evaluate(time)?;
                    let there = over(station);
                    let mut stop = Stop::new(time, [start, end]);
                    let mut stopped = None;
                    let mut report = |changes: [Option<Direction>; N], stop: &mut Stop<_>| {
                        for (index, direction) in changes.iter().enumerate() {
                            let Some(direction) = *direction else { continue };
                            let is_reported = !one || stopped.is_none();
                            stop.note(index, direction, is_reported);
                            let event = Event { index, time, state, direction };
                            if is_reported && visit(&event).is_break() && stopped.is_none() {
                                stopped = Some(event);
                            }
                        }
                        stopped
                    };
                    let taken = pending.take(forwards, time, &there.values);
                    for index in (0..N).filter(|index| taken.get(*index).is_some_and(Option::is_some)) {
                        if sides.is_flight(index) {
                            ends_flight(&mut stop, (index, start), sides, &values_at)?;
                        }
                    }
                    if report(taken, &mut stop).is_some() {
                        if N > 1 {
                            let local = self.local_at(events, &state, &station, end - start);
                            report(
                                pending.unseen(&events.directions, &there.values, &local, stop.unit),
                                &mut stop,
                            );
                            note_coming(&mut stop, &local, &there);
                        }
                        stop.print = print(&station.values);
                        self.stand_at(time, state);
                        self.set_stop(stop);
                        return Ok(stopped);
                    }
                }
                begun = to;
                contacts.set(sides.leave_contacts(&to.values));
                if turn.is_none() {
                    break;
                }
            }
        }
        Ok(None)
    }

    /// The functions at a state within the last step.
    fn local_at<const N: usize>(
        &self,
        events: &Watched<'_, S, N>,
        state: &S::State,
        here: &Station<ScalarOf<S>, N>,
        length: ScalarOf<S>,
    ) -> [Local<ScalarOf<S>>; N] {
        let start = Start { system: self.system(), input: self.input(), time: here.time, state };
        events.local(&start, (length, self.state()), &here.values)
    }
}

/// Takes note at a stop of the functions that have not changed their sign, but are at zero for all that one can tell,
/// and on their way through it.
fn note_coming<T: Real, const N: usize>(stop: &mut Stop<T>, local: &[Local<T>; N], here: &Station<T, N>) {
    for (index, (value, local)) in here.values.iter().zip(local).enumerate() {
        let Some(rate) = local.rate.filter(|_| stop.crossed(index).is_none()) else { continue };
        if local.is_zero(stop.unit, *value) {
            match (side(*value), side(rate)) {
                (Side::Above, Side::Below) => stop.await_change(index, Direction::Falling),
                (Side::Below, Side::Above) => stop.await_change(index, Direction::Rising),
                _ => {}
            }
        }
    }
}

/// Takes note at a stop, in a step with this beginning, of a function that has left zero where a state was given, and is
/// back: an error where such flights do not end.
fn ends_flight<T: Real, const N: usize>(
    stop: &mut Stop<T>,
    (index, step): (usize, T),
    sides: &Sides<T, N>,
    values_at: Within<'_, [T; N], T>,
) -> Result<(), IntegrationError> {
    let start = sides.begin.time;
    let flight = (stop.time - start).abs();
    let rounding = sides.local(index).rounding(flight / stop.length.abs());
    // a step before this one has shown nothing of the flight
    let height = midway(index, (step, stop.time), values_at)?.abs();
    let is_contact = sides.is_first_contact(index);
    let is_hidden = [NO_HEIGHT, SHORT_HEIGHT].map(|roundings| height <= T::from_f64(roundings) * rounding);
    if stop.ends_flight(Flight { start, is_hidden, is_contact }, sides.stop.as_ref()) {
        return Ok(());
    }
    // a parabola's slope where it leaves zero is four times its height over its length
    let share = T::from_f64(0.25) * rounding / height;
    let blur =
        if rounding == T::ZERO { T::ZERO } else { flight * if share < T::ONE { share } else { T::ONE } };
    Err(IntegrationError::EventsAccumulate {
        event: index,
        time: start.to_f64(),
        flight: flight.to_f64(),
        resolution: Stop::resolution(start, stop.time).max(blur).to_f64(),
    })
}

/// Times that are taken one after the other.
struct Turns<T, const N: usize>([Option<T>; N]);

impl<T: Real, const N: usize> Turns<T, N> {
    /// Those between the second and the third of these stations: where functions change their sign twice, and where gaps are
    /// open that were closed below zero and have closed again.
    fn between(
        sides: &[Side; N],
        contacts: &Contacts<T, N>,
        around: [Option<Station<T, N>>; 4],
        values_at: Within<'_, [T; N], T>,
    ) -> Result<Self, IntegrationError> {
        let over = |station| contacts.over(station);
        let counted = around.map(|station| station.map(over));
        let counted_at = |time| values_at(time).map(|values| over(Station { time, values }).values);
        let mut times = double_changes(sides, counted.each_ref().map(Option::as_ref), &counted_at)?;
        if let [_, Some(here), Some(there), _] = &around {
            let left = contacts.left([here, there], values_at)?;
            times.iter_mut().zip(left).for_each(|(time, left)| *time = time.or(left));
        }
        Ok(Self(times))
    }

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
