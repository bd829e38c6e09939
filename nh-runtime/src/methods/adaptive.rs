//! What the adaptive methods share: their settings, the first step, acceptance and rejection, and the
//! landing on a target.

use super::explicit::Tableau;
use super::first_step::first_length;
use super::fixed::Fixed;
use super::leg::Leg;
use super::power_iteration::{largest_rate, of_length_one};
use super::trial::{Scheme, Trial};
use super::{Arrival, Method, Place, Return, Start, Step, ToPositions, component, non_finite_derivative};
use crate::arrays::{all_finite, first_non_finite};
use crate::integrator::Returned;
use crate::step_control::{Controller, Past, StepControl};
use crate::stiffness::Stiffness;
use crate::tolerance::{PerComponent, Tolerance, Uniform, norm};
use crate::{Dynamics, IntegrationError, ProjectionError, Real, Scalar, State, Statistics, VecOf};

/// A method that chooses the lengths of its steps from an estimate of their errors: `P` computes the
/// step and the estimate, `T` is the type of numbers, `W` the kind of the tolerances.
///
/// The length of the next step follows from the errors of the last ones by the law of its
/// [`Controller`]. A step with an error beyond the tolerance is rejected and repeated with a shorter one,
/// and the step after that does not grow; how far its end has come off position constraints, or is moved by
/// [`Projected`](super::Projected), counts as error.
/// A step is stretched by up to 1 % or shortened to land on a target, and what a target has cut short does not shorten
/// the steps after it. The first step goes by the time over
/// which the solution varies; at rest, by a millionth of the distance to the target, of the longest step or of the time.
///
/// Named by its methods: [`Bs23`](crate::Bs23), [`Dopri5`](crate::Dopri5), ….
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Adaptive<P, T, W = Uniform<T>> {
    pub(super) scheme: P,
    pub(super) tolerance: W,
    pub(super) control: StepControl<T>,
}

impl<P: Default, T: Real> Adaptive<P, T> {
    /// The method with the default tolerances: 10⁻⁶ in `f64`, 10⁻⁴ in `f32`.
    #[must_use]
    pub fn new() -> Self {
        Self { scheme: P::default(), tolerance: Uniform::new(), control: StepControl::new() }
    }
}

impl<P, T: Real> Adaptive<P, T> {
    /// The relative tolerance: the error that a step may add to a component, as a fraction of it.
    #[must_use]
    pub fn rtol(mut self, rtol: T) -> Self {
        self.tolerance.rtol = rtol;
        self
    }

    /// The absolute tolerance, in the units of the state. A component's permitted error is the absolute plus the
    /// relative one. As `rtol` if not given: the one number that takes the units as they come. Give it where they
    /// are not of ordinary size.
    #[must_use]
    pub fn atol(mut self, atol: T) -> Self {
        self.tolerance.atol = Some(atol);
        self
    }

    /// The relative and the absolute tolerance of each component, as two states.
    ///
    /// ```
    /// # use nonholonomic::prelude::*;
    /// # use nonholonomic::D;
    /// # #[derive(Clone, Copy)] struct Roller { angle: f64, rate: f64 }
    /// # impl State for Roller {
    /// #     type Scalar = f64;
    /// #     type Dim = D<2>;
    /// #     fn to_array(&self) -> [f64; 2] { [self.angle, self.rate] }
    /// #     fn from_array([angle, rate]: [f64; 2]) -> Self { Self { angle, rate } }
    /// #     fn names() -> [&'static str; 2] { ["angle", "rate"] }
    /// # }
    /// // an angle that grows has to be as exact after many turns as in the first
    /// let rtol = Roller { angle: 0.0, rate: 1e-8 };
    /// let atol = Roller { angle: 1e-8, rate: 1e-10 };
    /// let method = Dopri5::new().tolerances(rtol, atol);
    /// # let _ = method;
    /// ```
    #[must_use]
    pub fn tolerances<X: State<Scalar = T>>(self, rtol: X, atol: X) -> Adaptive<P, T, PerComponent<X>> {
        self.tolerance(PerComponent { rtol, atol })
    }

    /// Tolerances of another kind, such as those of a state with its derivatives,
    /// [`ColumnTolerance`](crate::sensitivity::ColumnTolerance).
    #[must_use]
    pub fn tolerance<V>(self, tolerance: V) -> Adaptive<P, T, V> {
        let Self { scheme, control, .. } = self;
        Adaptive { scheme, tolerance, control }
    }
}

impl<P: Tableau, T: Scalar> Adaptive<P, T> {
    /// The same Runge–Kutta method with steps of length `step`, which has to be positive and finite,
    /// and without the error estimate: every step costs the same.
    #[inline]
    #[must_use]
    pub fn fixed(step: T) -> Fixed<P, T> {
        Fixed { scheme: P::default(), step }
    }

    /// One step of length `dt` as a pure function: the state at `t + dt`. A negative `dt` goes back in
    /// time.
    #[inline]
    pub fn step<S>(system: &S, t: T, dt: T, state: &S::State, input: &S::Input) -> S::State
    where
        S: Dynamics,
        S::State: State<Scalar = T>,
    {
        Fixed::<P, T>::step(system, t, dt, state, input)
    }
}

impl<P, T: Real, W> Adaptive<P, T, W> {
    /// The length of the first step that is tried; chosen from the equations if not given.
    #[must_use]
    pub fn first_step(mut self, first_step: T) -> Self {
        self.control.first_step = Some(first_step);
        self
    }

    /// The length of the longest step, which may be a hundredth longer where it lands on a target; unlimited if not
    /// given. Give it where inputs or forces act in short pulses that a long step could miss.
    #[must_use]
    pub fn max_step(mut self, max_step: T) -> Self {
        self.control.max_step = Some(max_step);
        self
    }

    /// The law by which the lengths of the steps follow the errors; if not given, PI control, and predictive
    /// control in [`Radau5`](crate::Radau5).
    #[must_use]
    pub fn controller(mut self, controller: Controller<T>) -> Self {
        self.control.controller = Some(controller);
        self
    }
}

impl<P: Default, T: Real> Default for Adaptive<P, T> {
    fn default() -> Self {
        Self::new()
    }
}

/// The end of a step that was returned to where it belongs.
struct Moved<S: Dynamics> {
    returned: Returned<S>,
    /// Whether the scheme knows where it is.
    is_known: bool,
}

/// What an adaptive method remembers.
#[derive(Clone, Copy)]
pub struct Memory<T, K> {
    /// The length proposed for the next step.
    proposed: Option<T>,
    /// What control remembers.
    past: Past<T>,
    work: K,
    stiffness: Stiffness<T>,
}

impl<T: Real, K> Memory<T, K> {
    /// Whether the equations have been found stiff for the method.
    pub(super) fn is_stiff(&self) -> bool {
        self.stiffness.is_certain()
    }

    /// The length proposed for the next step.
    pub(super) fn proposed(&self) -> Option<T> {
        self.proposed
    }

    /// The same with another proposal.
    pub(super) fn proposing(self, proposed: Option<T>) -> Self {
        Self { proposed, ..self }
    }
}

impl<T: Real, S: Dynamics, P: Scheme<S>, W: Tolerance<S::State>> Method<S> for Adaptive<P, T, W>
where
    S::State: State<Scalar = T>,
{
    type Memory = Memory<T, P::Work>;
    type Dense = P::Dense;

    fn memory(&self) -> Self::Memory {
        let past = self.control.controller.unwrap_or_else(P::usual_controller).no_past();
        Memory { proposed: None, past, work: self.scheme.work(), stiffness: Stiffness::new() }
    }

    #[inline]
    fn forget(&self, memory: &mut Self::Memory) {
        memory.past = self.control.controller.unwrap_or_else(P::usual_controller).no_past();
        self.scheme.forget(&mut memory.work);
    }

    #[inline]
    fn moved(&self, memory: &mut Self::Memory) {
        self.scheme.moved(&mut memory.work);
    }

    #[inline]
    fn judges(&self) -> bool {
        true
    }

    fn check(&self) -> Result<(), IntegrationError> {
        self.tolerance.check()?;
        self.control.check()
    }

    fn permitted(&self, state: &S::State) -> VecOf<S> {
        self.tolerance.permitted(&state.to_array())
    }

    #[inline]
    fn advance(
        &self,
        start: &Start<'_, S>,
        target: Option<T>,
        memory: &mut Self::Memory,
        statistics: &mut Statistics,
    ) -> Result<Arrival<S>, IntegrationError> {
        Ok(self.take::<true, false, S, _>(start, target, &ToPositions, memory, statistics)?.0)
    }

    #[inline]
    fn advance_and_return<R: Return<S>>(
        &self,
        start: &Start<'_, S>,
        target: Option<T>,
        by: &R,
        memory: &mut Self::Memory,
        statistics: &mut Statistics,
    ) -> Result<Step<S>, IntegrationError> {
        self.take::<true, true, S, _>(start, target, by, memory, statistics)
    }

    #[inline]
    fn travel(
        &self,
        system: &S,
        input: &S::Input,
        place: &mut Place<S>,
        (target, limit): (T, u64),
        memory: &mut Self::Memory,
        statistics: &mut Statistics,
    ) -> Result<u64, IntegrationError> {
        let mut steps = 0;
        while place.time != target && steps < limit {
            let start = Start { system, input, time: place.time, state: &place.state };
            let (arrival, _) =
                self.take::<false, false, S, _>(&start, Some(target), &ToPositions, memory, statistics)?;
            place.move_to(arrival);
            statistics.steps += 1;
            steps += 1;
        }
        Ok(steps)
    }

    fn dense(&self, memory: &Self::Memory, start: &Start<'_, S>, arrival: &Arrival<S>) -> P::Dense {
        self.scheme.dense(&memory.work, start, arrival)
    }

    fn interpolate(&self, dense: &P::Dense, start: &Start<'_, S>, arrival: &Arrival<S>, time: T) -> S::State {
        self.scheme.interpolate(dense, start, arrival, time)
    }
}

impl<P, T: Real, W> Adaptive<P, T, W> {
    /// Takes one step with error control, and returns its end `by` this before its last stage if it is to.
    #[inline]
    pub(super) fn take<const KEEP: bool, const RETURN: bool, S: Dynamics, R: Return<S>>(
        &self,
        start: &Start<'_, S>,
        target: Option<T>,
        by: &R,
        memory: &mut Memory<T, P::Work>,
        statistics: &mut Statistics,
    ) -> Result<Step<S>, IntegrationError>
    where
        S::State: State<Scalar = T>,
        P: Scheme<S>,
        W: Tolerance<S::State>,
    {
        let first = self.scheme.begin(start, &mut memory.work, statistics);
        if !all_finite::<T, _>(first)
            && let Some(found) = first_non_finite::<T>(first.as_ref())
        {
            return Err(non_finite_derivative::<S::State>(found, start.time.to_f64()));
        }
        let controller = self.control.controller.unwrap_or_else(P::usual_controller);
        let shortest = self.control.least(start.time)?;
        let proposed = if let Some(h) = memory.proposed.or(self.control.first_step) {
            self.control.limited(h)
        } else {
            let settings = (&self.tolerance, &self.control);
            first_length((start, first), target, P::ERROR_ORDER, settings, statistics)
        };
        let proposed = if proposed > shortest { proposed } else { shortest };
        if memory.stiffness.is_due() {
            self.look_for_stiffness(start, memory, statistics);
        }
        let mut h = proposed;
        let mut rejected = false;
        loop {
            let leg = Leg::new(start.time, h, target);
            if !leg.time.is_finite() {
                return Err(IntegrationError::NonFiniteTime { time: leg.time.to_f64() });
            }
            let (scheme, tolerance, work) = (&self.scheme, &self.tolerance, &mut memory.work);
            let (trial, returned) = if RETURN {
                self.returned::<KEEP, S, R>(start, &leg, by, &mut memory.work, statistics)
            } else {
                (scheme.attempt::<KEEP, _>(start, leg.length, tolerance, work, statistics), Ok(None))
            };
            let length = leg.length.abs();
            if trial.error <= T::ONE
                && let Ok(returned) = returned
            {
                self.scheme.accept::<KEEP>(start, leg.length, &mut memory.work);
                if returned.as_ref().is_some_and(|moved| !moved.is_known) {
                    self.scheme.moved(&mut memory.work);
                }
                let (factor, past) =
                    controller.after_success(length, trial.error, &memory.past, P::ERROR_ORDER);
                let next = length * factor;
                // no growth right after a rejection; no loss from a step that a target cut short
                let next = if rejected { next.min(length) } else { next };
                let next = self.control.limited(self.scheme.continued(length, next, &memory.work));
                let next = if leg.cut && !rejected { next.max(proposed) } else { next };
                memory.proposed = Some(next);
                memory.past = past;
                if memory.stiffness.count(leg.length) {
                    self.scheme.watch(&mut memory.work);
                }
                return Ok((
                    Arrival { time: leg.time, state: S::State::from_array(trial.state) },
                    returned.map(|moved| moved.returned),
                ));
            }
            statistics.rejected += 1;
            if h <= shortest {
                if let Err(error) = returned {
                    return Err(IntegrationError::Projection { time: leg.time.to_f64(), error });
                }
                return Err(self.refusal(start, leg.length, &trial, &memory.work));
            }
            rejected = true;
            let shorter = match self.scheme.retry(&memory.work) {
                Some(share) => length * share,
                None => length * controller.after_rejection(trial.error, P::ERROR_ORDER),
            };
            h = shorter.max(shortest);
        }
    }

    /// A step that ends where its end belongs: how far it had come off is error, too.
    #[inline]
    fn returned<const KEEP: bool, S: Dynamics, R: Return<S>>(
        &self,
        start: &Start<'_, S>,
        leg: &Leg<T>,
        by: &R,
        work: &mut P::Work,
        statistics: &mut Statistics,
    ) -> (Trial<S>, Result<Option<Moved<S>>, ProjectionError>)
    where
        S::State: State<Scalar = T>,
        P: Scheme<S>,
        W: Tolerance<S::State>,
    {
        let (scheme, tolerance) = (&self.scheme, &self.tolerance);
        let (mut trial, returned) =
            scheme.attempt_and_return::<KEEP, _, R>(start, leg.length, tolerance, by, work, statistics);
        // what has no error estimate has no end either
        if !trial.error.is_finite() || trial.error > T::ONE {
            return (trial, Ok(None));
        }
        let moved = if let Some(returned) = returned {
            Moved { returned, is_known: true }
        } else {
            let mut end = S::State::from_array(trial.state);
            match by.state(start.system, leg.time, &mut end) {
                Ok(returned) => {
                    trial.state = end.to_array();
                    Moved { returned, is_known: !returned.is_moved }
                }
                Err(error) => {
                    trial.error = T::from_f64(f64::INFINITY);
                    return (trial, Err(error));
                }
            }
        };
        let off = by.error(tolerance, &moved.returned, start.state, &trial.state);
        trial.error = trial.error.max(off);
        (trial, Ok(Some(moved)))
    }

    /// Looks whether the step before was as long as stability permits: how far derivatives at two states at its end are
    /// apart for the distance of these, both in units of the tolerance, is an estimate of the largest eigenvalue. Where such
    /// estimates tell of stiffness a better one confirms it.
    #[cold]
    #[inline(never)]
    fn look_for_stiffness<S: Dynamics>(
        &self,
        start: &Start<'_, S>,
        memory: &mut Memory<T, P::Work>,
        statistics: &mut Statistics,
    ) where
        S::State: State<Scalar = T>,
        P: Scheme<S>,
        W: Tolerance<S::State>,
    {
        let in_a_row = memory.stiffness.is_suspected();
        let held = T::from_f64(P::HELD);
        let spread = self.scheme.spread(start, in_a_row, &mut memory.work);
        let rate = spread.as_ref().map(|spread| {
            // what swings is small at times, and then less of an error is permitted: by that alone the estimate would be large
            let size = |e| norm(&self.tolerance, e, &spread.largest, &spread.largest);
            size(&spread.derivatives) / size(&spread.states)
        });
        let is_watched = memory.stiffness.judge(rate, held);
        if memory.stiffness.is_to_be_confirmed()
            && let Some(spread) = spread
        {
            let permitted = self.tolerance.permitted(&start.state.to_array());
            let mut direction = of_length_one(&spread.derivatives, &permitted);
            memory.stiffness.confirm(largest_rate(start, &self.tolerance, &mut direction, statistics), held);
        }
        if is_watched && memory.stiffness.is_suspected() {
            self.scheme.watch(&mut memory.work);
        }
        if memory.stiffness.is_certain() && statistics.stiff_at.is_none() {
            statistics.stiff_at = Some(start.time.to_f64());
        }
    }

    /// Explains why not even the shortest step is acceptable.
    #[cold]
    fn refusal<S: Dynamics>(
        &self,
        start: &Start<'_, S>,
        length: T,
        trial: &Trial<S>,
        work: &P::Work,
    ) -> IntegrationError
    where
        S::State: State<Scalar = T>,
        P: Scheme<S>,
    {
        let (time, step) = (start.time.to_f64(), length.to_f64());
        if let Some((found, fraction)) = self.scheme.blame(start, length, work) {
            return non_finite_derivative::<S::State>(found, time + fraction * step);
        }
        if let Some((index, _)) = first_non_finite::<T>(trial.state.as_ref()) {
            let component = component::<S::State>(index);
            return IntegrationError::NonFiniteStep { component, time, step };
        }
        IntegrationError::StepUnderflow { time, step, error: trial.error.to_f64() }
    }
}
