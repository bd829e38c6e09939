//! The explicit Euler method.

use super::fixed::{self, Grid, Slopes};
use super::{Arrival, Method, Start};
use crate::arrays::displaced;
use crate::{Dynamics, IntegrationError, Real, Scalar, State, Statistics, VecOf};

/// The explicit Euler method x₁ = x₀ + h f(t₀, x₀) with fixed steps, of order 1
/// (Euler, Institutionum calculi integralis, 1768, § 650).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Euler<T> {
    step: T,
}

impl<T: Scalar> Euler<T> {
    /// The method with steps of length `step`, which has to be positive and finite.
    #[inline]
    #[must_use]
    pub fn new(step: T) -> Self {
        Self { step }
    }

    /// One step of length `dt` as a pure function: the state at `t + dt`.
    #[inline]
    pub fn step<S>(system: &S, t: T, dt: T, state: &S::State, input: &S::Input) -> S::State
    where
        S: Dynamics + ?Sized,
        S::State: State<Scalar = T>,
    {
        let slope = system.derivative(t, state, input).to_array();
        S::State::from_array(displaced(&state.to_array(), dt, &slope))
    }
}

impl<T: Real, S: Dynamics> Method<S> for Euler<T>
where
    S::State: State<Scalar = T>,
{
    type Memory = Grid<T>;
    type Dense = Slopes<VecOf<S>>;

    #[inline]
    fn memory(&self) -> Grid<T> {
        Grid::new()
    }

    #[inline]
    fn forget(&self, _memory: &mut Grid<T>) {}

    fn check(&self) -> Result<(), IntegrationError> {
        fixed::check_step(self.step)
    }

    #[inline]
    fn advance(
        &self,
        start: &Start<'_, S>,
        target: Option<T>,
        memory: &mut Grid<T>,
        statistics: &mut Statistics,
    ) -> Result<Arrival<S>, IntegrationError> {
        let leg = memory.next(start.time, self.step, target);
        let state = Self::step(start.system, start.time, leg.length, start.state, start.input);
        statistics.evaluations += 1;
        let arrival = fixed::arrive(start, &leg, state)?;
        *memory = leg.grid;
        Ok(arrival)
    }

    fn dense(&self, _memory: &Grid<T>, start: &Start<'_, S>, arrival: &Arrival<S>) -> Slopes<VecOf<S>> {
        fixed::slopes(start, arrival)
    }

    fn interpolate(
        &self,
        dense: &Slopes<VecOf<S>>,
        start: &Start<'_, S>,
        arrival: &Arrival<S>,
        time: T,
    ) -> S::State {
        fixed::interpolate(dense, start, arrival, time)
    }
}
