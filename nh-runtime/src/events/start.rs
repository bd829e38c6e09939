//! On which side of zero event functions start.

use super::local::Local;
use super::{Side, Station, Watched, Within, before, beyond, print, reached, side};
use crate::methods::Method;
use crate::stop::Stop;
use crate::{Direction, Dynamics, IntegrationError, Integrator, Real, Scalar, ScalarOf};

/// The sides of the functions at the start of a step.
#[derive(Clone, Copy)]
pub(super) struct Sides<T, const N: usize> {
    pub(super) of: [Side; N],
    /// Those that have just left zero.
    pub(super) leaving: [bool; N],
    /// Those among them that have shown where they have gone.
    shown: [bool; N],
    /// Where they left.
    pub(super) begin: Station<T, N>,
    /// The length of the first step from there.
    length: T,
    /// Whether the state there was given, rather than reached.
    pub(super) is_given: bool,
    /// The gaps that were closed there.
    closed: [bool; N],
    /// How far below zero these were, until they are out of that.
    depths: [T; N],
    /// The stop there.
    pub(super) stop: Option<Stop<T>>,
    /// The functions there.
    pub(super) local: [Local<T>; N],
}

impl<T: Real, const N: usize> Sides<T, N> {
    /// Forgets the start of the run, unless a function has yet to show where it has gone from there.
    pub(super) fn go_on(&mut self, values: &[T; N]) {
        self.leave_contacts(values);
        self.leaving.iter_mut().zip(&self.shown).for_each(|(leaving, shown)| *leaving &= !shown);
        if !self.leaving.contains(&true) {
            self.is_given = false;
            self.stop = None;
            self.local = [Local::UNKNOWN; N];
        }
    }

    /// Whether the value of a function at a time tells a side: it does not where the function has left zero and is no
    /// farther from there than it was, but for rounding.
    pub(super) fn tells(&mut self, index: usize, (time, value): (T, T)) -> bool {
        let share = (time - self.begin.time).abs() / self.length;
        let is_hidden = self.local(index).hides(share, self.begin.values.get(index).copied(), value);
        match (self.leaving.get(index), self.shown.get_mut(index)) {
            (Some(true), Some(shown)) => {
                *shown |= !is_hidden;
                *shown
            }
            _ => true,
        }
    }

    /// Whether a function has left zero where a state was given, or a gap that was closed.
    pub(super) fn is_flight(&self, index: usize) -> bool {
        (self.is_given || self.was_closed(index)) && self.leaving.get(index) == Some(&true)
    }

    /// Whether it is a gap that was closed at the start.
    fn was_closed(&self, index: usize) -> bool {
        self.closed.get(index) == Some(&true)
    }

    /// How far below zero the gaps are that were closed.
    pub(super) fn contacts(&self) -> Contacts<T, N> {
        Contacts(self.depths)
    }

    /// Gaps that are open count from zero again; what is left of the others.
    pub(super) fn leave_contacts(&mut self, values: &[T; N]) -> Contacts<T, N> {
        let depths = self.depths.iter_mut().zip(values);
        depths.filter(|(_, value)| **value > T::ZERO).for_each(|(depth, _)| *depth = T::ZERO);
        self.contacts()
    }

    /// Whether it is a gap that closes from the start, where it has not been met.
    pub(super) fn is_first_contact(&self, index: usize) -> bool {
        let is_met = self.stop.is_some_and(|stop| stop.crossed(index).is_some());
        self.was_closed(index) && !is_met && self.local(index).rate.is_some_and(|rate| rate < T::ZERO)
    }

    /// The function at the start.
    pub(super) fn local(&self, index: usize) -> Local<T> {
        self.local.get(index).copied().unwrap_or(Local::UNKNOWN)
    }

    /// Whether a change from this side so soon after the start is round-off that follows an event which has been
    /// reported.
    pub(super) fn is_echo(&self, index: usize, from: Side, time: T) -> bool {
        let just_left = !self.is_given && !self.was_closed(index) && self.leaving.get(index) == Some(&true);
        let stays = matches!(from, Side::OnFromBelow | Side::OnFromAbove);
        let unit = self.stop.map_or(Stop::resolution(self.begin.time, time), |stop| stop.unit);
        just_left && !stays && (time - self.begin.time).abs() <= self.local(index).blur(unit)
    }
}

/// How far below zero gaps were where they were closed, until they open beyond that.
#[derive(Clone, Copy)]
pub(super) struct Contacts<T, const N: usize>([T; N]);

impl<T: Real, const N: usize> Contacts<T, N> {
    /// The functions, of which gaps count from where they were closed.
    pub(super) fn over(&self, mut station: Station<T, N>) -> Station<T, N> {
        station.values.iter_mut().zip(self.0).for_each(|(value, depth)| *value -= depth);
        station
    }

    /// For each gap that was closed below zero, a time between two stations at which it is open, if it has closed again at
    /// the second: nearer and nearer to the first, as far as time resolves it.
    pub(super) fn left(
        &self,
        [here, there]: [&Station<T, N>; 2],
        values_at: Within<'_, [T; N], T>,
    ) -> Result<[Option<T>; N], IntegrationError> {
        let mut times = [None; N];
        for (index, (time, depth)) in times.iter_mut().zip(self.0).enumerate() {
            let is_closed = there.values.get(index).is_some_and(|value| *value <= T::ZERO);
            if depth >= T::ZERO || !is_closed {
                continue;
            }
            let mut distance = there.time - here.time;
            while here.time + distance != here.time {
                distance *= T::from_f64(0.5);
                let values = values_at(here.time + distance)?;
                if values.get(index).is_some_and(|value| *value > T::ZERO) {
                    *time = Some(here.time + distance);
                    break;
                }
            }
        }
        Ok(times)
    }
}

/// The value of a function midway between two times.
pub(super) fn midway<T: Real, const N: usize>(
    index: usize,
    (start, end): (T, T),
    values_at: Within<'_, [T; N], T>,
) -> Result<T, IntegrationError> {
    let values = values_at(start + (end - start) * T::from_f64(0.5))?;
    Ok(values.get(index).copied().unwrap_or(T::ZERO))
}

impl<S: Dynamics, M: Method<S>> Integrator<S, M>
where
    ScalarOf<S>: Real,
{
    /// The sides at the start of the last step, the first of a run. The state there was given, or reached.
    pub(super) fn beginning<const N: usize>(
        &self,
        events: &Watched<'_, S, N>,
        here: &Station<ScalarOf<S>, N>,
        stop: Option<Stop<ScalarOf<S>>>,
        is_given: bool,
    ) -> Sides<ScalarOf<S>, N> {
        let mut sides = Sides {
            of: here.values.map(side),
            leaving: [false; N],
            shown: [false; N],
            begin: *here,
            length: (self.time() - here.time).abs(),
            is_given,
            closed: [false; N],
            depths: [ScalarOf::<S>::ZERO; N],
            stop,
            local: [Local::UNKNOWN; N],
        };
        let mut gaps = sides.of.iter().zip(&events.directions);
        let is_within = gaps.any(|(side, wanted)| *wanted == Direction::Closing && *side == Side::Below);
        let on_its_way = !is_given && stop.is_none() && !is_within && !sides.of.contains(&Side::On);
        let Some((start, arrival)) = self.last_step().filter(|_| !on_its_way) else { return sides };
        let unit = stop.map_or(Stop::resolution(start.time, start.time), |stop| stop.unit);
        sides.local = events.local(&start, (arrival.time - start.time, &arrival.state), &here.values);
        // what has been left where it changed its sign is at zero, whatever rounding shows
        let is_unmoved = stop.is_some_and(|stop| stop.print == print(&here.values));
        let each = sides.of.iter_mut().zip(&mut sides.leaving).zip(here.values.iter().zip(&sides.local));
        for (index, ((side_of, leaving), (value, local))) in each.enumerate() {
            let is_gap = events.directions.get(index) == Some(&Direction::Closing);
            let crossed = stop.and_then(|stop| stop.crossed(index));
            let is_zero = local.is_zero(unit, *value) || (is_unmoved && crossed.is_some());
            // what has changed its sign here may show the old one by round-off
            let has_crossed = match crossed {
                Some(Direction::Rising) => *side_of == Side::Below,
                Some(_) => *side_of == Side::Above,
                None => false,
            };
            // what was on its way to zero at a stop, and goes on from there, has its event to come
            let coming = stop.and_then(|stop| stop.coming(index)).filter(|_| is_given && is_zero);
            if let Some(coming) = coming
                && local.rate.is_none_or(|rate| side(rate) == beyond(coming))
            {
                *side_of = before(coming);
                continue;
            }
            // how far below zero a gap is does not matter: it is closed, and leaves from there
            let is_closed = is_gap && (is_zero || *side_of != Side::Above);
            *leaving = *side_of == Side::On || (is_zero && (is_given || has_crossed)) || is_closed;
            if !*leaving {
                continue;
            }
            *side_of = match (local.rate, crossed) {
                _ if is_closed => Side::Above,
                (Some(rate), _) => side(rate),
                (None, Some(direction)) if !is_given && *side_of == Side::On => reached(direction),
                (None, _) => Side::On,
            };
            if is_closed {
                sides.closed.iter_mut().skip(index).take(1).for_each(|closed| *closed = true);
                let below = value.min(ScalarOf::<S>::ZERO);
                sides.depths.iter_mut().skip(index).take(1).for_each(|depth| *depth = below);
            }
        }
        sides.begin = sides.contacts().over(sides.begin);
        sides
    }
}
