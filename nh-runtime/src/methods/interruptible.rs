//! Any method, asked before each step whether to go on.

use super::{Arrival, Method, Place, Return, Start, Step};
use crate::{Dynamics, IntegrationError, Real, Scalar, ScalarOf, Statistics, VecOf};

/// A method that asks, before each of its steps, whether it may go on: for limits that the crate knows nothing of,
/// such as of the time that a computation takes, or a button that is pressed.
///
/// The function is given what the integration has cost so far. Where it says no the run ends with
/// [`IntegrationError::Interrupted`], with the state and time of the last good step, and the next call asks again.
/// The steps are those of the method itself. All that takes steps obeys it alike.
///
/// ```
/// use nonholonomic::prelude::*;
/// use nonholonomic::methods::Interruptible;
/// use std::time::{Duration, Instant};
/// # use nonholonomic::D;
/// # #[derive(Clone, Copy)] struct Spring;
/// # #[derive(Clone, Copy)] struct SpringState { x: f64, v: f64 }
/// # impl State for SpringState {
/// #     type Scalar = f64;
/// #     type Dim = D<2>;
/// #     fn to_array(&self) -> [f64; 2] { [self.x, self.v] }
/// #     fn from_array([x, v]: [f64; 2]) -> Self { Self { x, v } }
/// #     fn names() -> [&'static str; 2] { ["x", "v"] }
/// # }
/// # impl Dynamics for Spring {
/// #     type State = SpringState;
/// #     type Input = ();
/// #     fn derivative(&self, _t: f64, s: &SpringState, (): &()) -> SpringState { SpringState { x: s.v, v: -s.x } }
/// # }
///
/// let started = Instant::now();
/// let in_time = |_: &Statistics| started.elapsed() < Duration::from_millis(5);
/// let method = Interruptible::new(Dopri5::new(), in_time);
/// let mut sim = Integrator::new(Spring, method, 0.0, SpringState { x: 1.0, v: 0.0 }).max_steps(u64::MAX);
/// let ended = sim.advance_to(1e15);
/// assert!(matches!(ended, Err(IntegrationError::Interrupted { .. })));
/// assert!(sim.statistics().steps > 0);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Interruptible<M, F> {
    method: M,
    goes_on: F,
}

impl<M, F: Fn(&Statistics) -> bool> Interruptible<M, F> {
    /// The method, which takes a step only if `goes_on` says so.
    #[must_use]
    pub fn new(method: M, goes_on: F) -> Self {
        Self { method, goes_on }
    }

    fn ask<T: Scalar>(&self, time: T, statistics: &Statistics) -> Result<(), IntegrationError> {
        if (self.goes_on)(statistics) {
            Ok(())
        } else {
            Err(IntegrationError::Interrupted { time: time.to_f64() })
        }
    }
}

/// What the method remembers.
#[derive(Clone, Copy)]
pub struct Memory<K> {
    method: K,
}

impl<S: Dynamics, M: Method<S>, F: Fn(&Statistics) -> bool> Method<S> for Interruptible<M, F> {
    type Memory = Memory<M::Memory>;

    handed_on!(forget {} restart {} keeps_positions { |this| this.method.keeps_positions() });

    fn memory(&self) -> Self::Memory {
        Memory { method: self.method.memory() }
    }

    fn check(&self) -> Result<(), IntegrationError> {
        self.method.check()
    }

    fn advance(
        &self,
        start: &Start<'_, S>,
        target: Option<ScalarOf<S>>,
        memory: &mut Self::Memory,
        statistics: &mut Statistics,
    ) -> Result<Arrival<S>, IntegrationError> {
        self.ask(start.time, statistics)?;
        self.method.advance(start, target, &mut memory.method, statistics)
    }

    fn advance_and_return<R: Return<S>>(
        &self,
        start: &Start<'_, S>,
        target: Option<ScalarOf<S>>,
        by: &R,
        memory: &mut Self::Memory,
        statistics: &mut Statistics,
    ) -> Result<Step<S>, IntegrationError> {
        self.ask(start.time, statistics)?;
        self.method.advance_and_return(start, target, by, &mut memory.method, statistics)
    }

    fn travel(
        &self,
        system: &S,
        input: &S::Input,
        place: &mut Place<S>,
        (target, limit): (ScalarOf<S>, u64),
        memory: &mut Self::Memory,
        statistics: &mut Statistics,
    ) -> Result<u64, IntegrationError> {
        let mut steps = 0;
        while place.time != target && steps < limit {
            self.ask(place.time, statistics)?;
            steps += self.method.travel(system, input, place, (target, 1), &mut memory.method, statistics)?;
        }
        Ok(steps)
    }
}
