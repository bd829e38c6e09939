//! The classical Runge–Kutta method.

use super::fixed::{self, Grid, Slopes};
use super::{Arrival, Method, Start, non_finite_derivative};
use crate::arrays::{combined, displaced, first_non_finite};
use crate::{Dynamics, IntegrationError, Real, Scalar, State, Statistics, VecOf};

/// The classical Runge–Kutta method with fixed steps, of order 4
/// (Kutta 1901; Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I, table II.1.2).
///
/// ```
/// use nh_runtime::{D, Dynamics, Rk4, State};
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
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rk4<T> {
    step: T,
}

impl<T: Scalar> Rk4<T> {
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
        let half = dt * T::from_f64(0.5);
        let x = state.to_array();
        let k1 = system.derivative(t, state, input).to_array();
        let x2 = S::State::from_array(displaced(&x, half, &k1));
        let k2 = system.derivative(t + half, &x2, input).to_array();
        let x3 = S::State::from_array(displaced(&x, half, &k2));
        let k3 = system.derivative(t + half, &x3, input).to_array();
        let x4 = S::State::from_array(displaced(&x, dt, &k3));
        let k4 = system.derivative(t + dt, &x4, input).to_array();
        let inner = combined((T::ONE, &k2), [(T::ONE, &k3)]);
        let slope = combined((T::ONE, &k1), [(T::ONE, &k4), (T::from_f64(2.0), &inner)]);
        S::State::from_array(displaced(&x, dt * T::from_f64(1.0 / 6.0), &slope))
    }
}

impl<T: Real, S: Dynamics> Method<S> for Rk4<T>
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
        statistics.evaluations += 4;
        let arrival = fixed::arrive(start, &leg, state).map_err(|error| blame(start, leg.length, error))?;
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

/// Explains an infinite step by the first stage whose derivative is not finite, if there is one.
#[cold]
fn blame<T: Real, S: Dynamics>(start: &Start<'_, S>, h: T, error: IntegrationError) -> IntegrationError
where
    S::State: State<Scalar = T>,
{
    if !matches!(error, IntegrationError::NonFiniteStep { .. }) {
        return error;
    }
    let x = start.state.to_array();
    let mut slope = start.derivative();
    for ahead in [h * T::from_f64(0.5), h * T::from_f64(0.5), h] {
        let time = start.time + ahead;
        slope = start.derivative_at(time, displaced(&x, ahead, &slope));
        if let Some(found) = first_non_finite(slope.as_ref()) {
            return non_finite_derivative::<S::State>(found, time.to_f64());
        }
    }
    error
}
