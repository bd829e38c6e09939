//! Events: where functions of time and state change their sign.

use core::ops::ControlFlow;

use crate::methods::Method;
use crate::{Dynamics, IntegrationError, Integrator, Real, Scalar, ScalarOf};

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

/// `N` event functions, given as one closure of time, state and input, and what to look for.
///
/// A function that is zero has changed its sign when it reaches zero; where it starts from zero, it
/// takes the sign that it moves to, which is no event. Every step is looked at where it ends and at
/// some [`samples`](Self::samples) within it, so that a function which changes its sign twice between
/// two of these points goes unnoticed: give more samples, or the method a `max_step`.
#[derive(Clone, Copy, Debug)]
pub struct Events<F, const N: usize> {
    functions: F,
    directions: [Direction; N],
    samples: u32,
}

/// A change of sign.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Event<T, X> {
    /// Which of the functions.
    pub index: usize,
    /// When: the function still has its old sign at the resolution of time before.
    pub time: T,
    /// The state then.
    pub state: X,
    /// Whether the function rises or falls.
    pub direction: Direction,
}

/// An event of a system.
type EventOf<S> = Event<ScalarOf<S>, <S as Dynamics>::State>;

impl<F, const N: usize> Events<F, N> {
    /// Events of all these functions, in either direction.
    #[must_use]
    pub fn new<T, X, U>(functions: F) -> Self
    where
        F: Fn(T, &X, &U) -> [T; N],
    {
        Self { functions, directions: [Direction::Either; N], samples: 3 }
    }

    /// The events of each function are changes of its sign in this direction only.
    #[must_use]
    pub fn directions(mut self, directions: [Direction; N]) -> Self {
        self.directions = directions;
        self
    }

    /// How many points within each step are looked at; 3 if not given. With 0, only the ends of steps
    /// are, and the dense output is prepared in steps with an event alone.
    #[must_use]
    pub fn samples(mut self, samples: u32) -> Self {
        // one more is counted to
        self.samples = samples.min(u32::MAX - 1);
        self
    }
}

/// A sign.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Side {
    Below,
    On,
    Above,
}

/// A place in a step with the signs of the functions there.
#[derive(Clone, Copy)]
struct Station<T, const N: usize> {
    time: T,
    values: [T; N],
}

fn side<T: Real>(value: T) -> Side {
    if value > T::ZERO {
        Side::Above
    } else if value < T::ZERO {
        Side::Below
    } else {
        Side::On
    }
}

/// The direction in which a value has left a side, if it has.
fn crossing<T: Real>(from: Side, value: T) -> Option<Direction> {
    match (from, side(value)) {
        (Side::Below, Side::On | Side::Above) => Some(Direction::Rising),
        (Side::Above, Side::On | Side::Below) => Some(Direction::Falling),
        _ => None,
    }
}

impl<F, const N: usize> Events<F, N> {
    /// The values of the functions.
    fn station<S: Dynamics>(
        &self,
        time: ScalarOf<S>,
        state: &S::State,
        input: &S::Input,
    ) -> Result<Station<ScalarOf<S>, N>, IntegrationError>
    where
        F: Fn(ScalarOf<S>, &S::State, &S::Input) -> [ScalarOf<S>; N],
    {
        let values = (self.functions)(time, state, input);
        match values.iter().enumerate().find(|(_, value)| !value.is_finite()) {
            None => Ok(Station { time, values }),
            Some((event, value)) => {
                Err(IntegrationError::NonFiniteEvent { event, time: time.to_f64(), value: value.to_f64() })
            }
        }
    }
}

/// The sign changes between two stations that are still to be reported, each with its time.
struct Pending<T, const N: usize> {
    found: [Option<(T, Direction)>; N],
}

impl<T: Real, const N: usize> Pending<T, N> {
    /// Takes out the earliest, if it is not after `limit`; `forwards` says what is early.
    fn next(&mut self, forwards: bool, limit: Option<T>) -> Option<(usize, T, Direction)> {
        let before = |a: T, b: T| if forwards { a < b } else { a > b };
        let mut first: Option<(usize, T, Direction)> = None;
        for (index, found) in self.found.iter().enumerate() {
            if let Some((time, direction)) = *found
                && first.is_none_or(|(_, earliest, _)| before(time, earliest))
            {
                first = Some((index, time, direction));
            }
        }
        let (index, time, _) = first?;
        if limit.is_some_and(|limit| before(limit, time)) {
            return None;
        }
        if let Some(found) = self.found.get_mut(index) {
            *found = None;
        }
        first
    }
}

impl<S: Dynamics, M: Method<S>> Integrator<S, M>
where
    ScalarOf<S>: Real,
{
    /// Takes steps to `target` and reports the events on the way to `visit`, in the order in which
    /// they happen. Where `visit` breaks, the integration stands at that event, and it is returned.
    ///
    /// An event is located in the dense output to the resolution of time; state and time afterwards
    /// are the first ones with the new sign, so that going on from there does not meet the event
    /// again. Events at the same time are all reported before the integration stops.
    ///
    /// ```
    /// # use nonholonomic::prelude::*;
    /// # use nonholonomic::{D, Direction, Events};
    /// # struct Ball;
    /// # #[derive(Clone, Copy)] struct BallState { height: f64, speed: f64 }
    /// # impl State for BallState {
    /// #     type Scalar = f64;
    /// #     type Dim = D<2>;
    /// #     fn to_array(&self) -> [f64; 2] { [self.height, self.speed] }
    /// #     fn from_array([height, speed]: [f64; 2]) -> Self { Self { height, speed } }
    /// #     fn names() -> [&'static str; 2] { ["height", "speed"] }
    /// # }
    /// # impl Dynamics for Ball {
    /// #     type State = BallState;
    /// #     type Input = ();
    /// #     fn derivative(&self, _t: f64, x: &BallState, (): &()) -> BallState {
    /// #         BallState { height: x.speed, speed: -9.81 }
    /// #     }
    /// # }
    /// # fn main() -> Result<(), IntegrationError> {
    /// // a ball that is thrown up and bounces
    /// let start = BallState { height: 0.0, speed: 5.0 };
    /// let mut sim = Integrator::new(Ball, Dopri5::new(), 0.0, start);
    /// let ground = Events::new(|_, x: &BallState, (): &()| [x.height]).directions([Direction::Falling]);
    /// let mut bounces = 0;
    /// while let Some(impact) = sim.advance_until(3.0, &ground)? {
    ///     bounces += 1;
    ///     sim.reset(impact.time, BallState { height: 0.0, speed: -0.8 * impact.state.speed });
    /// }
    /// assert_eq!(bounces, 3);
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    /// As [`advance_to`](Self::advance_to), and [`IntegrationError::NonFiniteEvent`]; the integration
    /// then stands at the start of the step that could not be looked at, or where it was.
    pub fn advance_watching<F, const N: usize>(
        &mut self,
        target: ScalarOf<S>,
        events: &Events<F, N>,
        mut visit: impl FnMut(&EventOf<S>) -> ControlFlow<()>,
    ) -> Result<Option<EventOf<S>>, IntegrationError>
    where
        F: Fn(ScalarOf<S>, &S::State, &S::Input) -> [ScalarOf<S>; N],
    {
        let mut here = events.station::<S>(self.time(), self.state(), self.input())?;
        let mut sides = here.values.map(side);
        let mut steps = 0;
        while self.time() != target {
            self.limit_steps(steps, target)?;
            self.step_towards(target)?;
            steps += 1;
            match self.look_back(events, &mut here, &mut sides, &mut visit) {
                Ok(None) => {}
                Ok(stop) => return Ok(stop),
                Err(error) => {
                    self.take_back();
                    return Err(error);
                }
            }
        }
        Ok(None)
    }

    /// Takes steps to `target`, or to the first event before it, which is returned. Otherwise as
    /// [`advance_watching`](Self::advance_watching).
    ///
    /// # Errors
    /// As there.
    pub fn advance_until<F, const N: usize>(
        &mut self,
        target: ScalarOf<S>,
        events: &Events<F, N>,
    ) -> Result<Option<EventOf<S>>, IntegrationError>
    where
        F: Fn(ScalarOf<S>, &S::State, &S::Input) -> [ScalarOf<S>; N],
    {
        self.advance_watching(target, events, |_| ControlFlow::Break(()))
    }

    /// Looks for events in the last step, from the station `here` at its start.
    fn look_back<F, const N: usize>(
        &mut self,
        events: &Events<F, N>,
        here: &mut Station<ScalarOf<S>, N>,
        sides: &mut [Side; N],
        visit: &mut impl FnMut(&EventOf<S>) -> ControlFlow<()>,
    ) -> Result<Option<EventOf<S>>, IntegrationError>
    where
        F: Fn(ScalarOf<S>, &S::State, &S::Input) -> [ScalarOf<S>; N],
    {
        let (start, end) = (here.time, self.time());
        let forwards = start < end;
        let last = events.station::<S>(end, self.state(), self.input())?;
        let changes = |sides: &[Side; N], values: &[ScalarOf<S>; N]| {
            sides
                .iter()
                .zip(values)
                .any(|(from, value)| *from == Side::On || crossing(*from, *value).is_some())
        };
        if events.samples == 0 && !changes(sides, &last.values) {
            *here = last;
            return Ok(None);
        }
        let dense = self.dense();
        let evaluate = |time: ScalarOf<S>| -> Result<_, IntegrationError> {
            let state = dense.at(time)?;
            Ok((state, events.station::<S>(time, &state, self.input())?))
        };
        let mut stop: Option<EventOf<S>> = None;
        // where a function starts from zero, it shows its sign soon after
        if sides.contains(&Side::On) {
            let soon = start + (end - start) * ScalarOf::<S>::from_f64(1e-3);
            let (_, station) = evaluate(soon)?;
            for (from, value) in sides.iter_mut().zip(station.values) {
                if *from == Side::On {
                    *from = side(value);
                }
            }
        }
        for part in 1..=events.samples + 1 {
            let there = if part > events.samples {
                last
            } else {
                let share = ScalarOf::<S>::from_u32(part) / ScalarOf::<S>::from_u32(events.samples + 1);
                evaluate(start + (end - start) * share)?.1
            };
            let mut pending = Pending { found: [None; N] };
            for (index, found) in pending.found.iter_mut().enumerate() {
                let (Some(from), Some(&value), Some(&old), Some(wanted)) = (
                    sides.get_mut(index),
                    there.values.get(index),
                    here.values.get(index),
                    events.directions.get(index),
                ) else {
                    break;
                };
                if let Some(direction) = crossing(*from, value)
                    && (*wanted == Direction::Either || *wanted == direction)
                {
                    let value_at = |time| -> Result<_, IntegrationError> {
                        Ok(evaluate(time)?.1.values.get(index).copied().unwrap_or(value))
                    };
                    let ends = ((here.time, old), (there.time, value));
                    *found = Some((locate(*from, ends, value_at)?, direction));
                }
                if side(value) != Side::On {
                    *from = side(value);
                } else if let Some(direction) = crossing(*from, value) {
                    // what has reached zero has crossed
                    *from = if direction == Direction::Rising { Side::Above } else { Side::Below };
                }
            }
            while let Some((index, time, direction)) = pending.next(forwards, stop.map(|event| event.time)) {
                let event = Event { index, time, state: evaluate(time)?.0, direction };
                if visit(&event).is_break() && stop.is_none() {
                    stop = Some(event);
                }
            }
            if let Some(event) = stop {
                self.stand_at(event.time, event.state);
                return Ok(stop);
            }
            *here = there;
        }
        Ok(None)
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
    let resolution = T::EPSILON * after.0.abs().max(before.0.abs());
    let mut kept_after = false;
    for count in 1_u32.. {
        if (after.0 - before.0).abs() <= resolution || after.1 == T::ZERO {
            break;
        }
        let middle = before.0 + (after.0 - before.0) * half;
        let chord = after.0 - after.1 * (after.0 - before.0) / (after.1 - before.1);
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
