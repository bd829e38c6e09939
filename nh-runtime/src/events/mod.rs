//! Events: where functions of time and state change their sign.

mod acting;
mod local;
mod locate;
mod pending;
mod search;
mod standing;
mod start;
mod turns;

pub use acting::Simultaneous;

use core::ops::ControlFlow;

use crate::integrator::Spent;
use crate::methods::Method;
use crate::stop::{MOST_FUNCTIONS, Stop};
use crate::{Direction, Dynamics, IntegrationError, Integrator, Real, Scalar, ScalarOf};

/// `N` event functions, given as one closure of time, state and input, and what to look for.
///
/// A function that is zero has changed its sign when it reaches zero. Where it starts from zero, it takes the
/// sign that it moves to, which is no event: the sign of its rate of change, or the first sign that it shows if
/// that vanishes. It has left zero where it shows that by more than rounding, in this step or a later one.
/// A function that reaches zero and stays there has one event, and another one where it turns back.
/// After a [`reset`](Integrator::reset), zero is whatever a function leaves or passes
/// within the resolution of time, so that a state that was put onto a contact starts from it. What rests on the contact
/// falls from there without an event, unless its gap is looked at as [`Direction::Closing`].
///
/// Every step is looked at where it ends and at some [`samples`](Self::samples) within it, and where these show
/// that a function comes near to zero and turns, there too. A function that changes its sign twice without
/// that goes unnoticed: give more samples, or the method a `max_step`.
#[derive(Clone, Copy, Debug)]
pub struct Events<F, const N: usize> {
    functions: F,
    directions: [Direction; N],
    samples: u32,
}

/// A change of sign.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Event<T, X> {
    /// Which of the functions.
    pub index: usize,
    /// When: the function still has its old sign at the resolution of time before. Functions that change
    /// theirs within that resolution do so at the same time.
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
        const { assert!(N <= MOST_FUNCTIONS, "at most 128 event functions are told apart: give fewer to one run") };
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

/// Functions of events behind one type, so that what looks for their zeros is compiled once for all of them.
type Watched<'a, S, const N: usize> = Events<FunctionsOf<'a, S, N>, N>;

type FunctionsOf<'a, S, const N: usize> =
    &'a dyn Fn(ScalarOf<S>, &<S as Dynamics>::State, &<S as Dynamics>::Input) -> [ScalarOf<S>; N];

/// Who is told of events, and may stop there.
type Visit<'a, S> = &'a mut dyn FnMut(&EventOf<S>) -> ControlFlow<()>;

/// What functions are at a time within a step, behind one type as well.
type Within<'a, V, T> = &'a dyn Fn(T) -> Result<V, IntegrationError>;

/// A sign. A function that has reached zero has changed it, and stays zero or goes on, or turns back, which is another
/// change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Side {
    Below,
    On,
    OnFromBelow,
    OnFromAbove,
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
        (Side::Below, Side::On | Side::Above) | (Side::OnFromAbove, Side::Above) => Some(Direction::Rising),
        (Side::Above, Side::On | Side::Below) | (Side::OnFromBelow, Side::Below) => Some(Direction::Falling),
        _ => None,
    }
}

/// The side on which a function is that comes from another one with this value.
fn settled<T: Real>(from: Side, value: T) -> Side {
    match (from, side(value)) {
        (Side::Above, Side::On) => Side::OnFromAbove,
        (Side::Below, Side::On) => Side::OnFromBelow,
        (from, Side::On) => from,
        (_, side) => side,
    }
}

/// The side that a change of sign leads to.
fn beyond(direction: Direction) -> Side {
    if direction == Direction::Rising { Side::Above } else { Side::Below }
}

/// The side that it comes from.
fn before(direction: Direction) -> Side {
    if direction == Direction::Rising { Side::Below } else { Side::Above }
}

/// Zero, reached by a change of sign in this direction.
fn reached(direction: Direction) -> Side {
    if direction == Direction::Rising { Side::OnFromBelow } else { Side::OnFromAbove }
}

impl<F, const N: usize> Events<F, N> {
    fn watched<S: Dynamics>(&self) -> Watched<'_, S, N>
    where
        F: Fn(ScalarOf<S>, &S::State, &S::Input) -> [ScalarOf<S>; N],
    {
        Events { functions: &self.functions, directions: self.directions, samples: self.samples }
    }

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
    /// let ground = Events::new(|_, x: &BallState, (): &()| [x.height]).directions([Direction::Closing]);
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
    /// As [`advance_to`](Self::advance_to); [`IntegrationError::NonFiniteEvent`]; and
    /// [`IntegrationError::EventsAccumulate`] where a function that starts from zero is back there within the
    /// resolution of time, as the impacts of the ball above would be in the end. The integration then stands
    /// at the start of the step that could not be looked at, or where it was.
    pub fn advance_watching<F, const N: usize>(
        &mut self,
        target: ScalarOf<S>,
        events: &Events<F, N>,
        visit: impl FnMut(&EventOf<S>) -> ControlFlow<()>,
    ) -> Result<Option<EventOf<S>>, IntegrationError>
    where
        F: Fn(ScalarOf<S>, &S::State, &S::Input) -> [ScalarOf<S>; N],
    {
        self.watch((target, &mut Spent::default()), events, false, visit, |_| Ok(()))
    }

    /// Takes steps to `target`, or to the first event before it, which is returned. Otherwise as
    /// [`advance_watching`](Self::advance_watching).
    ///
    /// Of several events at the same time the next calls return the others, as long as the integration stands
    /// there: after a [`reset`](Self::reset) to the same time only those whose function is still on its way
    /// through zero.
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
        let stops = |_: &EventOf<S>| ControlFlow::Break(());
        self.watch((target, &mut Spent::default()), events, true, stops, |_| Ok(()))
    }

    /// Takes steps and looks back at each, then hands it to `kept`; of simultaneous events `one` alone may be visited.
    pub(crate) fn watch<E: From<IntegrationError>, F, const N: usize>(
        &mut self,
        (target, spent): (ScalarOf<S>, &mut Spent),
        events: &Events<F, N>,
        one: bool,
        mut visit: impl FnMut(&EventOf<S>) -> ControlFlow<()>,
        mut kept: impl FnMut(&Self) -> Result<(), E>,
    ) -> Result<Option<EventOf<S>>, E>
    where
        F: Fn(ScalarOf<S>, &S::State, &S::Input) -> [ScalarOf<S>; N],
    {
        self.admit_target(target)?;
        let mut here = events.station::<S>(self.time(), self.state(), self.input())?;
        if let Some(event) = self.pay_owed(&events.watched::<S>(), &here, one, &mut visit) {
            return Ok(Some(event));
        }
        let is_given = self.last_step().is_none();
        let (begun, stop) = (self.time(), self.stop());
        let mut sides = None;
        while self.time() != target {
            let sight = self.in_sight(begun, stop, target);
            self.step_in_sight(spent, [target, sight])?;
            let sides =
                sides.get_or_insert_with(|| self.beginning(&events.watched::<S>(), &here, stop, is_given));
            let looked = self.look_back(events, &mut here, sides, one, &mut visit);
            match looked.map_err(E::from).and_then(|event| kept(self).map(|()| event)) {
                Ok(None) => {}
                Ok(event) => {
                    if let Some(mut stop) = self.stop() {
                        stop.flight = (stop.time - begun).abs();
                        self.set_stop(stop);
                    }
                    return Ok(event);
                }
                Err(error) => {
                    self.take_back();
                    return Err(error);
                }
            }
        }
        Ok(None)
    }
}

impl<S: Dynamics, M: Method<S>> Integrator<S, M>
where
    ScalarOf<S>: Real,
{
    /// How far a step may lead, of methods that choose its length, after a stop at which this call began.
    fn in_sight(
        &self,
        begun: ScalarOf<S>,
        stop: Option<Stop<ScalarOf<S>>>,
        target: ScalarOf<S>,
    ) -> ScalarOf<S> {
        let zero = ScalarOf::<S>::ZERO;
        let flight = stop.map_or(zero, |stop| stop.flight);
        let (time, is_chosen) = (self.time(), self.method().judges());
        let sight = ScalarOf::<S>::from_f64(SIGHT) * flight.max((time - begun).abs());
        if !is_chosen || flight == zero || (target - time).abs() <= sight {
            return target;
        }
        if time < target { time + sight } else { time - sight }
    }
}

/// A step after a stop leads at most so many times as far as the motion before it did, or the motion since then. Where the error
/// leaves a step any length, as in free fall, its end would be so far off that what it rounds is seen at the next stop.
const SIGHT: f64 = 4.0;

/// What tells functions from others: their values somewhere.
fn print<T: Real, const N: usize>(values: &[T; N]) -> u64 {
    values.iter().fold(0, |print: u64, value| print.rotate_left(7) ^ value.to_f64().to_bits())
}
