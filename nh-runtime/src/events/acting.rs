//! Events that act: what happens at them changes the run, which goes on.

use core::ops::ControlFlow;

use super::{Event, EventOf, Events};
use crate::integrator::Spent;
use crate::methods::Method;
use crate::{
    Buffer, Dynamics, IntegrationError, Integrator, Real, RecordingError, ScalarOf, Segment, Trajectory,
};

/// The events of one instant, of `N` functions: at least one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Simultaneous<T, X, const N: usize> {
    /// When.
    pub time: T,
    /// The state then.
    pub state: X,
    events: [Option<Event<T, X>>; N],
}

impl<T, X, const N: usize> Simultaneous<T, X, N> {
    /// The event of a function, if it has one now.
    #[must_use]
    pub fn of(&self, index: usize) -> Option<&Event<T, X>> {
        self.events.get(index).and_then(Option::as_ref)
    }

    /// The events, in the order of their functions.
    pub fn iter(&self) -> impl Iterator<Item = &Event<T, X>> {
        self.events.iter().flatten()
    }
}

/// The events of one instant of a system.
type SimultaneousOf<S, const N: usize> = Simultaneous<ScalarOf<S>, <S as Dynamics>::State, N>;

impl<S: Dynamics, M: Method<S>> Integrator<S, M>
where
    ScalarOf<S>: Real,
{
    /// Takes steps to `target`, and at every instant with events calls `act` with all of them. It may change the state
    /// ([`set_state`](Self::set_state)), the input ([`set_input`](Self::set_input)) and the parameters
    /// ([`system_mut`](Self::system_mut)), and the run goes on from there, with its statistics and the length of its
    /// steps; where it breaks, the run ends there, and the events are returned.
    ///
    /// ```
    /// # use core::ops::ControlFlow;
    /// # use nonholonomic::prelude::*;
    /// # use nonholonomic::D;
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
    /// // a ball that is thrown up and bounces three times
    /// let start = BallState { height: 0.0, speed: 5.0 };
    /// let mut sim = Integrator::new(Ball, Dopri5::new(), 0.0, start);
    /// let ground = Events::new(|_, x: &BallState, (): &()| [x.height]).directions([Direction::Closing]);
    /// let mut bounces = 0;
    /// let ended = sim.advance_acting(100.0, &ground, |sim, impact| {
    ///     bounces += 1;
    ///     sim.set_state(BallState { height: 0.0, speed: -0.8 * impact.state.speed });
    ///     if bounces < 3 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    /// })?;
    /// let last = ended.expect("it was ended at the third");
    /// assert!((last.time - 10.0 / 9.81 * (1.0 + 0.8 + 0.64)).abs() < 1e-12);
    /// assert!((sim.state().speed - 5.0 * 0.8 * 0.8 * 0.8).abs() < 1e-11);
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    /// As [`advance_watching`](Self::advance_watching); the limits on steps and evaluations hold for the whole call.
    #[doc(alias("callback", "hybrid", "jump"))]
    pub fn advance_acting<F, const N: usize>(
        &mut self,
        target: ScalarOf<S>,
        events: &Events<F, N>,
        act: impl FnMut(&mut Self, &SimultaneousOf<S, N>) -> ControlFlow<()>,
    ) -> Result<Option<SimultaneousOf<S, N>>, IntegrationError>
    where
        F: Fn(ScalarOf<S>, &S::State, &S::Input) -> [ScalarOf<S>; N],
    {
        self.act(target, events, act, |_| Ok(()))
    }

    /// As [`advance_acting`](Self::advance_acting), and keeps every step; those with an event up to it.
    ///
    /// # Errors
    /// As [`advance_acting`](Self::advance_acting) and [`record`](Self::record).
    pub fn record_acting<F, B, const N: usize, const P: usize>(
        &mut self,
        target: ScalarOf<S>,
        events: &Events<F, N>,
        motion: &mut Trajectory<S::State, B, P>,
        act: impl FnMut(&mut Self, &SimultaneousOf<S, N>) -> ControlFlow<()>,
    ) -> Result<Option<SimultaneousOf<S, N>>, RecordingError>
    where
        F: Fn(ScalarOf<S>, &S::State, &S::Input) -> [ScalarOf<S>; N],
        B: Buffer<Segment<S::State, P>>,
    {
        self.act(target, events, act, |sim| motion.keep_last_step(sim))
    }

    fn act<E: From<IntegrationError>, F, const N: usize>(
        &mut self,
        target: ScalarOf<S>,
        events: &Events<F, N>,
        mut act: impl FnMut(&mut Self, &SimultaneousOf<S, N>) -> ControlFlow<()>,
        mut kept: impl FnMut(&Self) -> Result<(), E>,
    ) -> Result<Option<SimultaneousOf<S, N>>, E>
    where
        F: Fn(ScalarOf<S>, &S::State, &S::Input) -> [ScalarOf<S>; N],
    {
        let mut spent = Spent::default();
        loop {
            let mut now = [None; N];
            let take_note = |event: &EventOf<S>| {
                if let Some(place) = now.get_mut(event.index) {
                    *place = Some(*event);
                }
                ControlFlow::Break(())
            };
            let Some(event) = self.watch((target, &mut spent), events, false, take_note, &mut kept)? else {
                return Ok(None);
            };
            let happened = Simultaneous { time: event.time, state: event.state, events: now };
            if act(self, &happened).is_break() {
                return Ok(Some(happened));
            }
        }
    }
}
