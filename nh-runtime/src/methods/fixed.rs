//! What the methods of fixed step share.

use super::explicit::{Tableau, stages_of};
use super::grid::{self, Grid, Leg, Stride};
use super::{Arrival, Method, Place, Start, explain_non_finite};
use crate::arrays::{Array, all_finite, displaced};
use crate::{Dim, DimOf, Dynamics, IntegrationError, Real, Scalar, ScalarOf, State, Statistics, VecOf};

/// A method with steps of a given length: `P` computes a step, `T` is the type of numbers.
///
/// Named by its methods: [`Euler`](crate::Euler), [`Rk4`](crate::Rk4), …; and adaptive explicit methods
/// have it too, `Dop853::fixed(0.1)`. Times are n h from where the integration started or last
/// landed, computed from n, so that they do not accumulate round-off. The last step before a target is
/// shortened to end there. Steps that time is too coarse for, as of a millisecond at t = 10¹⁵ s, are refused:
/// [`IntegrationError::UnresolvedStep`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fixed<P, T> {
    pub(in crate::methods) scheme: P,
    pub(crate) step: T,
}

/// How a method of fixed step computes a step.
#[diagnostic::on_unimplemented(
    message = "`{Self}` takes no steps of `{S}`",
    label = "not a method for this system",
    note = "a method `.with_jacobian()` needs the trait `Jacobian`: add `emit {{ jacobian }}` to the declaration of the system"
)]
pub trait OneStep<S: Dynamics>: Copy {
    /// What is kept from step to step.
    type Work: Copy;
    /// What the states within a step are computed from.
    type Dense: Copy;

    /// Whether every step is computed in the same way, without a search for a solution.
    const DIRECT: bool = false;

    /// What there is before the first step.
    fn work(&self) -> Self::Work;

    /// Drops what depends on the input or on the state at the end of the last step.
    fn forget(&self, work: &mut Self::Work);

    /// As [`Method::moved`].
    fn moved(&self, work: &mut Self::Work) {
        self.forget(work);
    }

    /// As [`Method::stand`].
    fn stand(&self, work: &mut Self::Work) {
        self.forget(work);
    }

    /// Checks the settings beside the length of the step.
    ///
    /// # Errors
    /// [`IntegrationError::Setting`] for the first setting that is out of its range.
    fn check(&self) -> Result<(), IntegrationError> {
        Ok(())
    }

    /// As [`Method::keeps_positions`].
    #[inline]
    fn keeps_positions(&self) -> bool {
        false
    }

    /// The change of the state, which is `x` at the start, over a step of length `h`; components that
    /// are not finite if there is none.
    ///
    /// # Errors
    /// Why the equations of an implicit method were not solved.
    fn increment(
        &self,
        start: &Start<'_, S>,
        x: &VecOf<S>,
        h: ScalarOf<S>,
        work: &mut Self::Work,
        statistics: &mut Statistics,
    ) -> Result<VecOf<S>, IntegrationError>;

    /// The same from `x + rest`, where `rest` is what rounding has taken from the state: for methods that are so
    /// exact that it matters.
    ///
    /// # Errors
    /// As there.
    fn increment_beyond(
        &self,
        start: &Start<'_, S>,
        (x, rest): (&VecOf<S>, &VecOf<S>),
        h: ScalarOf<S>,
        work: &mut Self::Work,
        statistics: &mut Statistics,
    ) -> Result<VecOf<S>, IntegrationError> {
        let _ = rest;
        self.increment(start, x, h, work, statistics)
    }

    /// Explains an increment that is not finite, if the derivative at the start is; `None` where no more is known.
    fn blame(&self, start: &Start<'_, S>, h: ScalarOf<S>) -> Option<IntegrationError> {
        let _ = (start, h);
        None
    }

    /// As [`Method::dense`].
    fn dense(&self, work: &Self::Work, start: &Start<'_, S>, arrival: &Arrival<S>) -> Self::Dense;

    /// As [`Method::interpolate`].
    fn interpolate(
        &self,
        dense: &Self::Dense,
        start: &Start<'_, S>,
        arrival: &Arrival<S>,
        time: ScalarOf<S>,
    ) -> S::State;
}

impl<P: Tableau, T: Scalar> Fixed<P, T> {
    /// The method with steps of length `step`, which has to be positive and finite.
    #[inline]
    #[must_use]
    pub fn new(step: T) -> Self {
        Self { scheme: P::default(), step }
    }

    /// One step of length `dt` as a pure function: the state at `t + dt`. A negative `dt` goes back in
    /// time. Where the system has position constraints, one correction towards these and one of the velocities
    /// is part of the step.
    ///
    /// ```
    /// use nonholonomic::{D, Dynamics, Rk4, State};
    ///
    /// /// x' = −x.
    /// struct Decay;
    /// #[derive(Clone, Copy)]
    /// struct DecayState { x: f64 }
    /// impl State for DecayState {
    ///     type Scalar = f64;
    ///     type Dim = D<1>;
    ///     fn to_array(&self) -> [f64; 1] { [self.x] }
    ///     fn from_array([x]: [f64; 1]) -> Self { Self { x } }
    ///     fn names() -> [&'static str; 1] { ["x"] }
    /// }
    /// impl Dynamics for Decay {
    ///     type State = DecayState;
    ///     type Input = ();
    ///     fn derivative(&self, _t: f64, state: &DecayState, (): &()) -> DecayState {
    ///         DecayState { x: -state.x }
    ///     }
    /// }
    ///
    /// let next = Rk4::step(&Decay, 0.0, 0.1, &DecayState { x: 1.0 }, &());
    /// assert!((next.x - (-0.1_f64).exp()).abs() < 1e-7);
    /// ```
    #[inline]
    pub fn step<S>(system: &S, t: T, dt: T, state: &S::State, input: &S::Input) -> S::State
    where
        S: Dynamics,
        S::State: State<Scalar = T>,
    {
        let start = Start { system, input, time: t, state };
        let x = state.to_array();
        let (_, slope) = stages_of::<S, P>(&start, &x, dt);
        let mut state = S::State::from_array(displaced(&x, dt * T::from_f64(P::SCALE), &slope));
        system.correct_positions(t + dt, &mut state);
        state
    }
}

impl<P, T> Fixed<P, T> {
    /// The same method with compensated summation of the state (Kahan 1965; Hairer, Lubich, Wanner,
    /// Geometric Numerical Integration, VIII.5): what rounding takes from x + Δx is kept and added to
    /// the next Δx. In long integrations the state's round-off then no longer accumulates.
    #[must_use]
    pub fn compensated(self) -> Compensated<P, T> {
        Compensated { method: self }
    }
}

/// What a method of fixed step remembers.
#[derive(Clone, Copy)]
pub struct Memory<T, K> {
    grid: Grid<T>,
    work: K,
}

impl<T: Real, S: Dynamics, P: OneStep<S>> Method<S> for Fixed<P, T>
where
    S::State: State<Scalar = T>,
{
    type Memory = Memory<T, P::Work>;
    type Dense = P::Dense;

    #[inline]
    fn memory(&self) -> Self::Memory {
        Memory { grid: Grid::new(), work: self.scheme.work() }
    }

    #[inline]
    fn forget(&self, memory: &mut Self::Memory) {
        self.scheme.forget(&mut memory.work);
    }

    #[inline]
    fn moved(&self, memory: &mut Self::Memory) {
        self.scheme.moved(&mut memory.work);
    }

    fn stand(&self, memory: &mut Self::Memory) {
        self.scheme.stand(&mut memory.work);
    }

    fn check(&self) -> Result<(), IntegrationError> {
        grid::check_step(self.step)?;
        self.scheme.check()
    }

    #[inline]
    fn keeps_positions(&self) -> bool {
        self.scheme.keeps_positions()
    }

    #[inline]
    fn advance(
        &self,
        start: &Start<'_, S>,
        target: Option<T>,
        memory: &mut Self::Memory,
        statistics: &mut Statistics,
    ) -> Result<Arrival<S>, IntegrationError> {
        let leg = memory.grid.next(start.time, self.step, target)?;
        let x = start.state.to_array();
        let increment = self.scheme.increment(start, &x, leg.length, &mut memory.work, statistics)?;
        let arrival = self.arrive(start, &leg, &displaced(&x, T::ONE, &increment))?;
        memory.grid = leg.grid;
        Ok(arrival)
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
        // within so many steps from here is one that fails, once a stride has: halving them finds it
        let mut failing = u64::MAX;
        // strides grow, so that one that fails has not been much longer than the way to it
        let mut longest = FIRST_STRIDE;
        while place.time != target && steps < limit {
            let most = (limit - steps - 1).min(if failing == u64::MAX { longest } else { (failing - 1) / 2 });
            let mut leapt = None;
            if P::DIRECT
                && let Some(stride) = memory.grid.stride(place.time, self.step, target, most)
            {
                let work = &mut memory.work;
                let reached = stride_along(&stride, (system, input), place, |start, x| {
                    let increment = self.scheme.increment(start, x, stride.step, work, statistics)?;
                    Ok(displaced(x, T::ONE, &increment))
                });
                let length = u64::from(stride.steps);
                let Some(reached) = reached else {
                    failing = length;
                    continue;
                };
                leapt = Some((place.time, place.state, memory.grid, length));
                memory.grid = stride.end();
                (place.time, place.state) = (stride.time(stride.steps), reached);
                steps += length;
                failing = left(failing, length);
                longest = longest.saturating_mul(2);
            }
            let start = Start { system, input, time: place.time, state: &place.state };
            match (self.advance(&start, Some(target), memory, statistics), leapt) {
                (Ok(arrival), leapt) => {
                    place.move_to(arrival);
                    statistics.steps += leapt.map_or(1, |(.., length)| length + 1);
                    steps += 1;
                    failing = left(failing, 1);
                }
                // the step before is to be known: the way is gone again, and ends in single steps
                (Err(_), Some((time, state, grid, length))) => {
                    (place.time, place.state, memory.grid) = (time, state, grid);
                    steps -= length;
                    failing = length + 1;
                }
                (Err(error), None) => return Err(error),
            }
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

/// The steps of the first stride of a run.
const FIRST_STRIDE: u64 = 64;

/// Within how many steps one fails after some of them did not: within any number, if it was none of those.
#[inline]
fn left(failing: u64, done: u64) -> u64 {
    let left = failing.saturating_sub(done);
    if failing == u64::MAX || left == 0 { u64::MAX } else { left }
}

/// The state after several steps, which is not looked at before their end: what is not finite stays so
/// where increments are added to it. None if it is, for the steps to be repeated one by one.
#[inline]
fn stride_along<S: Dynamics>(
    stride: &Stride<ScalarOf<S>>,
    (system, input): (&S, &S::Input),
    place: &Place<S>,
    mut step: impl FnMut(&Start<'_, S>, &VecOf<S>) -> Result<VecOf<S>, IntegrationError>,
) -> Option<S::State>
where
    ScalarOf<S>: Real,
{
    let mut x = place.state.to_array();
    let mut time = place.time;
    for done in 1..=stride.steps {
        let state = S::State::from_array(x);
        x = step(&Start { system, input, time, state: &state }, &x).ok()?;
        time = stride.time(done);
    }
    (all_finite::<ScalarOf<S>, _>(&x) && time.is_finite()).then(|| S::State::from_array(x))
}

impl<P, T: Real> Fixed<P, T> {
    /// Accepts the end of a step if it is finite, and explains it otherwise.
    #[inline]
    fn arrive<S: Dynamics>(
        &self,
        start: &Start<'_, S>,
        leg: &Leg<T>,
        reached: &VecOf<S>,
    ) -> Result<Arrival<S>, IntegrationError>
    where
        S::State: State<Scalar = T>,
        P: OneStep<S>,
    {
        if !all_finite::<T, _>(reached) {
            let error = explain_non_finite(start, leg.length, reached.as_ref());
            let by_start = matches!(error, IntegrationError::NonFiniteDerivative { .. });
            let blamed = if by_start { None } else { self.scheme.blame(start, leg.length) };
            return Err(blamed.unwrap_or(error));
        }
        if !leg.time.is_finite() {
            return Err(IntegrationError::NonFiniteTime { time: leg.time.to_f64() });
        }
        Ok(Arrival { time: leg.time, state: S::State::from_array(*reached) })
    }
}

/// A method of fixed step with compensated summation of the state: see [`Fixed::compensated`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Compensated<P, T> {
    method: Fixed<P, T>,
}

/// What a compensated method remembers.
pub struct Carried<S: Dynamics, K> {
    memory: Memory<ScalarOf<S>, K>,
    /// What rounding has taken from the state.
    carry: VecOf<S>,
}

impl<S: Dynamics, K: Copy> Clone for Carried<S, K> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<S: Dynamics, K: Copy> Copy for Carried<S, K> {}

impl<T: Real, S: Dynamics, P: OneStep<S>> Method<S> for Compensated<P, T>
where
    S::State: State<Scalar = T>,
{
    type Memory = Carried<S, P::Work>;
    type Dense = P::Dense;

    fn memory(&self) -> Self::Memory {
        Carried { memory: self.method.memory(), carry: DimOf::<S>::vec(T::ZERO) }
    }

    #[inline]
    fn forget(&self, memory: &mut Self::Memory) {
        self.method.forget(&mut memory.memory);
    }

    /// What rounding has taken from one state is nothing of another.
    fn restart(&self, memory: &mut Self::Memory) {
        self.method.restart(&mut memory.memory);
        memory.carry = DimOf::<S>::vec(T::ZERO);
    }

    #[inline]
    fn moved(&self, memory: &mut Self::Memory) {
        self.method.moved(&mut memory.memory);
        memory.carry = DimOf::<S>::vec(T::ZERO);
    }

    fn stand(&self, memory: &mut Self::Memory) {
        self.method.stand(&mut memory.memory);
        memory.carry = DimOf::<S>::vec(T::ZERO);
    }

    fn check(&self) -> Result<(), IntegrationError> {
        Method::<S>::check(&self.method)
    }

    #[inline]
    fn keeps_positions(&self) -> bool {
        Method::<S>::keeps_positions(&self.method)
    }

    #[inline]
    fn advance(
        &self,
        start: &Start<'_, S>,
        target: Option<T>,
        memory: &mut Self::Memory,
        statistics: &mut Statistics,
    ) -> Result<Arrival<S>, IntegrationError> {
        let Carried { memory, carry } = memory;
        let leg = memory.grid.next(start.time, self.method.step, target)?;
        let x = start.state.to_array();
        let scheme = &self.method.scheme;
        let increment =
            scheme.increment_beyond(start, (&x, carry), leg.length, &mut memory.work, statistics)?;
        let increment = displaced(&increment, T::ONE, carry);
        let reached = displaced(&x, T::ONE, &increment);
        let arrival = self.method.arrive(start, &leg, &reached)?;
        *carry = rounding(&x, &increment, &reached);
        memory.grid = leg.grid;
        Ok(arrival)
    }

    fn dense(&self, memory: &Self::Memory, start: &Start<'_, S>, arrival: &Arrival<S>) -> P::Dense {
        self.method.dense(&memory.memory, start, arrival)
    }

    fn interpolate(&self, dense: &P::Dense, start: &Start<'_, S>, arrival: &Arrival<S>, time: T) -> S::State {
        self.method.interpolate(dense, start, arrival, time)
    }
}

/// What rounding has taken from a + b, exactly (Møller 1965, Knuth, The Art of Computer Programming 2,
/// 4.2.2, theorem B).
#[inline]
pub(super) fn rounding<T: Scalar, V: Array<T>>(a: &V, b: &V, sum: &V) -> V {
    let mut lost = *sum;
    for ((lost, &a), &b) in lost.as_mut().iter_mut().zip(a.as_ref()).zip(b.as_ref()) {
        let added = *lost - a;
        *lost = (a - (*lost - added)) + (b - added);
    }
    lost
}
