//! Carrying a state through time.

mod returns;
mod sampling;

pub use returns::Returned;

use core::fmt;

use crate::arrays::{all_finite, first_non_finite};
use crate::methods::{Arrival, Method, Place, Start, component};
use crate::stop::Stop;
use crate::{Dynamics, IntegrationError, Real, Scalar, ScalarOf, State, Statistics};

/// A system, a method, and a state that moves through time.
///
/// The system is owned or borrowed: `Integrator::new(sleigh, …)` and `Integrator::new(&sleigh, …)`
/// both work. After an error the state and the time are those of the last good step, and the
/// integration can go on, say with another input.
///
/// ```
/// # use nonholonomic::prelude::*;
/// # use nonholonomic::D;
/// # #[derive(Clone, Copy)] struct Car;
/// # #[derive(Clone, Copy)] struct CarState { x: f64, v: f64 }
/// # #[derive(Clone, Copy, Default)] struct CarInput { force: f64 }
/// # impl State for CarState {
/// #     type Scalar = f64;
/// #     type Dim = D<2>;
/// #     fn to_array(&self) -> [f64; 2] { [self.x, self.v] }
/// #     fn from_array([x, v]: [f64; 2]) -> Self { Self { x, v } }
/// #     fn names() -> [&'static str; 2] { ["x", "v"] }
/// # }
/// # impl Dynamics for Car {
/// #     type State = CarState;
/// #     type Input = CarInput;
/// #     fn derivative(&self, _t: f64, s: &CarState, u: &CarInput) -> CarState { CarState { x: s.v, v: u.force } }
/// # }
/// # fn main() -> Result<(), IntegrationError> {
/// let mut sim = Integrator::new(Car, Rk4::new(0.01), 0.0, CarState { x: 0.0, v: 0.0 });
/// sim.set_input(CarInput { force: 2.0 });
/// sim.advance_to(1.0)?;
/// assert!((sim.state().x - 1.0).abs() < 1e-12);
/// sim.set_input(CarInput { force: -2.0 });
/// sim.advance_to(2.0)?;
/// assert!(sim.state().v.abs() < 1e-12);
/// assert_eq!(sim.statistics().steps, 200);
/// # Ok(())
/// # }
/// ```
pub struct Integrator<S: Dynamics, M: Method<S>> {
    system: S,
    method: M,
    memory: M::Memory,
    input: S::Input,
    time: ScalarOf<S>,
    state: S::State,
    /// Where the last step came from.
    origin: Option<Origin<S>>,
    /// Where it has led to, if the integration stands at an event within it.
    beyond: Option<Arrival<S>>,
    /// The events that it has stopped at.
    stop: Option<Stop<ScalarOf<S>>>,
    statistics: Statistics,
    max_steps: u64,
    max_evaluations: u64,
    /// Whether states are returned to position constraints.
    returns: bool,
    /// Whether the parameters and settings have been checked.
    validated: bool,
    /// Whether the state, the time and the input as the user gave them have been checked.
    admitted: bool,
}

/// What a call has spent of its limits.
#[derive(Clone, Copy, Default)]
pub(crate) struct Spent {
    steps: u64,
    evaluations: u64,
}

/// The start of a step, with the input that acted during it.
struct Origin<S: Dynamics> {
    time: ScalarOf<S>,
    state: S::State,
    input: S::Input,
}

impl<S: Dynamics> Clone for Origin<S> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<S: Dynamics> Copy for Origin<S> {}

impl<S: Dynamics, M: Method<S>> Integrator<S, M> {
    /// The integration of `system` by `method` from `state` at time `t0`, with the default input.
    ///
    /// Everything given is checked when the first step is taken.
    pub fn new(system: S, method: M, t0: ScalarOf<S>, state: S::State) -> Self {
        let memory = method.memory();
        Self {
            system,
            method,
            memory,
            input: S::Input::default(),
            time: t0,
            state,
            origin: None,
            beyond: None,
            stop: None,
            statistics: Statistics::default(),
            max_steps: 10_000_000,
            max_evaluations: u64::MAX,
            returns: true,
            validated: false,
            admitted: false,
        }
    }

    /// Permits at most `limit` steps in one call of [`advance_to`](Self::advance_to) and of whatever
    /// else takes steps: [`step_towards`](Self::step_towards), [`advance_through`](Self::advance_through),
    /// [`sample`](Self::sample), [`advance_until`](Self::advance_until),
    /// [`advance_watching`](Self::advance_watching). Ten million if not given.
    #[must_use]
    pub fn max_steps(mut self, limit: u64) -> Self {
        self.max_steps = limit;
        self
    }

    /// Permits no further step in a call once it has evaluated the derivative `limit` times: the calls are those of
    /// [`max_steps`](Self::max_steps). The step that has begun is ended, so that a call may evaluate it some more
    /// times. Unlimited if not given.
    ///
    /// For limits of other kinds, such as of the time that a computation may take, see
    /// [`Interruptible`](crate::methods::Interruptible).
    #[must_use]
    pub fn max_evaluations(mut self, limit: u64) -> Self {
        self.max_evaluations = limit;
        self
    }

    /// Leaves the states as the method computes them. Otherwise they are returned to position constraints, where
    /// the system has any, after every step and within it, positions first, then velocities: the method's
    /// order stays, [`Statistics`] say how far they were moved, and what the method has stored of that state alone
    /// is computed anew. Methods whose steps are taken on the constraints, such as
    /// [`Conserving`](crate::methods::Conserving), [`SymmetricProjection`](crate::methods::SymmetricProjection) and
    /// [`DiscreteGradient`](crate::methods::DiscreteGradient), stay there.
    #[must_use]
    pub fn without_return(mut self) -> Self {
        self.returns = false;
        self
    }

    /// Gives the input that acts from now on, and drops what the method has stored of the old one.
    pub fn set_input(&mut self, input: S::Input) {
        self.input = input;
        self.admitted = false;
        self.method.forget(&mut self.memory);
    }

    /// Starts anew from another state and time, with the same system, method and input. The
    /// statistics start anew too. At the time of an event at which the integration has stopped, other events of that
    /// instant that have not been reported are, if their functions still go through zero there.
    pub fn reset(&mut self, t0: ScalarOf<S>, state: S::State) {
        self.time = t0;
        self.state = state;
        self.memory = self.method.memory();
        self.origin = None;
        self.beyond = None;
        self.statistics = Statistics::default();
        self.admitted = false;
    }

    /// Goes on from another state at the same time, with the statistics, the length of the step and the limits as they
    /// are: after an impact, say. The state is checked as one that [`new`](Self::new) is given.
    pub fn set_state(&mut self, state: S::State) {
        self.state = state;
        self.method.restart(&mut self.memory);
        self.origin = None;
        self.beyond = None;
        self.admitted = false;
    }

    /// The state now.
    #[inline]
    #[must_use]
    pub fn state(&self) -> &S::State {
        &self.state
    }

    /// The time now.
    #[inline]
    #[must_use]
    pub fn time(&self) -> ScalarOf<S> {
        self.time
    }

    /// The input that acts.
    #[inline]
    #[must_use]
    pub fn input(&self) -> &S::Input {
        &self.input
    }

    /// The system.
    #[inline]
    #[must_use]
    pub fn system(&self) -> &S {
        &self.system
    }

    /// The system, to change its parameters: they act from now on, and are checked before the next step. What the
    /// method has stored of the old ones is dropped, the dense output of the last step included.
    #[must_use]
    pub fn system_mut(&mut self) -> &mut S {
        self.validated = false;
        self.admitted = false;
        self.origin = None;
        self.beyond = None;
        self.method.restart(&mut self.memory);
        &mut self.system
    }

    /// The method.
    #[inline]
    #[must_use]
    pub fn method(&self) -> &M {
        &self.method
    }

    /// What the integration has cost since it was started or [`reset`](Self::reset).
    #[inline]
    #[must_use]
    pub fn statistics(&self) -> Statistics {
        self.statistics
    }
}

impl<S: Dynamics, M: Method<S>> Integrator<S, M>
where
    ScalarOf<S>: Real,
{
    /// Takes one step forwards in time, of the length that the method chooses.
    ///
    /// # Errors
    /// What was given is not valid, or there is no good step; state and time are then unchanged.
    #[inline]
    pub fn step(&mut self) -> Result<(), IntegrationError> {
        self.admit()?;
        self.advance(None)
    }

    /// Takes one step towards `target`, forwards or backwards in time, and lands on it exactly
    /// rather than passing it. At the target already, it does nothing.
    ///
    /// # Errors
    /// As [`step`](Self::step), and [`IntegrationError::TooManySteps`] where none is permitted.
    #[inline]
    pub fn step_towards(&mut self, target: ScalarOf<S>) -> Result<(), IntegrationError> {
        self.admit()?;
        check_time(target)?;
        if self.time == target {
            return Ok(());
        }
        self.permit(&Spent::default(), target)?;
        self.advance(Some(target))
    }

    /// Takes as many steps as lead to `target`, forwards or backwards in time, and lands on it
    /// exactly: afterwards [`time`](Self::time) equals it. A method of fixed step shortens its last
    /// step for that.
    ///
    /// # Errors
    /// As [`step`](Self::step), and [`IntegrationError::TooManySteps`]. State and time are those of
    /// the last good step; a further call continues from there.
    #[inline]
    pub fn advance_to(&mut self, target: ScalarOf<S>) -> Result<(), IntegrationError> {
        self.travel(target, &mut Spent::default())
    }

    /// As [`advance_to`](Self::advance_to) in a call that has spent something already, and adds to that.
    #[inline]
    pub(crate) fn travel(&mut self, target: ScalarOf<S>, spent: &mut Spent) -> Result<(), IntegrationError> {
        self.admit()?;
        check_time(target)?;
        if self.is_returned() {
            return self.travel_with_returns(target, spent);
        }
        let mut place = Place { time: self.time, state: self.state, before: None };
        let steps = self.max_steps.saturating_sub(spent.steps);
        let evaluations = self.max_evaluations.saturating_sub(spent.evaluations);
        let Self { method, system, input, memory, statistics, .. } = self;
        let begun = *statistics;
        let result = if self.max_evaluations == u64::MAX {
            method.travel(system, input, &mut place, (target, steps), memory, statistics)
        } else {
            let mut done = 0;
            loop {
                let is_spent = statistics.evaluations - begun.evaluations >= evaluations;
                if is_spent || done >= steps || place.time == target {
                    break Ok(done);
                }
                match method.travel(system, input, &mut place, (target, 1), memory, statistics) {
                    Ok(taken) => done += taken,
                    Err(error) => break Err(error),
                }
            }
        };
        spent.steps += statistics.steps - begun.steps;
        spent.evaluations += statistics.evaluations - begun.evaluations;
        if let Some((time, state)) = place.before {
            self.stop = None;
            self.origin = Some(Origin { time, state, input: self.input });
            self.beyond = None;
        }
        self.time = place.time;
        self.state = place.state;
        result?;
        if self.time == target { Ok(()) } else { Err(self.exceeded(spent, target)) }
    }

    /// Refuses a step beyond the limits of a call that has spent this much.
    #[inline]
    pub(crate) fn permit(&self, spent: &Spent, target: ScalarOf<S>) -> Result<(), IntegrationError> {
        if spent.steps < self.max_steps && spent.evaluations < self.max_evaluations {
            Ok(())
        } else {
            Err(self.exceeded(spent, target))
        }
    }

    /// As [`step_towards`](Self::step_towards) in a call that has spent something already, and adds to that.
    #[inline]
    pub(crate) fn step_within(
        &mut self,
        spent: &mut Spent,
        target: ScalarOf<S>,
    ) -> Result<(), IntegrationError> {
        self.step_in_sight(spent, [target; 2])
    }

    /// The same on the way to a target with a step that leads no farther than to a time before it.
    #[inline]
    pub(crate) fn step_in_sight(
        &mut self,
        spent: &mut Spent,
        [target, sight]: [ScalarOf<S>; 2],
    ) -> Result<(), IntegrationError> {
        self.permit(spent, target)?;
        let begun = self.statistics;
        self.step_towards(sight)?;
        spent.steps += self.statistics.steps - begun.steps;
        spent.evaluations += self.statistics.evaluations - begun.evaluations;
        Ok(())
    }

    #[cold]
    fn exceeded(&self, spent: &Spent, target: ScalarOf<S>) -> IntegrationError {
        let (time, target) = (self.time.to_f64(), target.to_f64());
        if spent.steps < self.max_steps {
            return IntegrationError::TooManyEvaluations { time, target, limit: self.max_evaluations };
        }
        IntegrationError::TooManySteps { time, target, limit: self.max_steps }
    }

    /// Checks what the user gave, and a target.
    pub(crate) fn admit_target(&mut self, target: ScalarOf<S>) -> Result<(), IntegrationError> {
        self.admit()?;
        check_time(target)
    }

    /// The events that the integration has stopped at, if it still stands there.
    pub(crate) fn stop(&self) -> Option<Stop<ScalarOf<S>>> {
        self.stop.filter(|stop| stop.time == self.time)
    }

    /// Takes note of the events that the integration stands at.
    pub(crate) fn set_stop(&mut self, stop: Stop<ScalarOf<S>>) {
        self.stop = Some(stop);
    }

    /// Checks what the user gave, unless that has been done.
    #[inline]
    fn admit(&mut self) -> Result<(), IntegrationError> {
        if self.admitted { Ok(()) } else { self.check() }
    }

    #[cold]
    fn check(&mut self) -> Result<(), IntegrationError> {
        if !self.validated {
            self.system.validate()?;
            self.method.check()?;
            self.validated = true;
        }
        check_time(self.time)?;
        let x = self.state.to_array();
        if !all_finite(&x)
            && let Some((index, value)) = first_non_finite(x.as_ref())
        {
            let component = component::<S::State>(index);
            return Err(IntegrationError::NonFiniteState { component, value });
        }
        self.system.check_input(&self.input).map_err(IntegrationError::Input)?;
        if self.origin.is_none() {
            let checked = self.system.check_state(self.time, &self.state);
            checked.map_err(IntegrationError::InvalidState)?;
            self.admit_positions()?;
        }
        self.admitted = true;
        Ok(())
    }

    /// Takes a step from an admitted state.
    #[inline]
    fn advance(&mut self, target: Option<ScalarOf<S>>) -> Result<(), IntegrationError> {
        let start = Start { system: &self.system, input: &self.input, time: self.time, state: &self.state };
        let (memory, statistics) = (&mut self.memory, &mut self.statistics);
        let is_returned = self.returns && self.system.has_positions();
        let arrival = if is_returned && !self.method.keeps_positions() {
            returns::advance(&start, &self.method, target, (memory, statistics))?
        } else {
            self.method.advance(&start, target, memory, statistics)?
        };
        if is_returned {
            returns::stays_on_its_side(&start, &self.method, &arrival, &mut self.memory)?;
        }
        let Arrival { time, state } = arrival;
        self.beyond = None;
        self.stop = None;
        self.origin = Some(Origin { time: self.time, state: self.state, input: self.input });
        self.time = time;
        self.state = state;
        self.statistics.steps += 1;
        Ok(())
    }
}

/// Refuses a time that cannot be reached.
#[inline]
fn check_time<T: Scalar>(time: T) -> Result<(), IntegrationError> {
    if time.is_finite() { Ok(()) } else { Err(IntegrationError::NonFiniteTime { time: time.to_f64() }) }
}

impl<S: Dynamics + Clone, M: Method<S> + Clone> Clone for Integrator<S, M> {
    fn clone(&self) -> Self {
        Self { system: self.system.clone(), method: self.method.clone(), ..*self }
    }
}

impl<S: Dynamics, M: Method<S>> fmt::Debug for Integrator<S, M>
where
    S::State: fmt::Debug,
{
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Integrator")
            .field("time", &self.time)
            .field("state", &self.state)
            .field("statistics", &self.statistics)
            .finish_non_exhaustive()
    }
}
