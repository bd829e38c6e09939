//! The gradient of a cost of many explicit steps, by one sweep forwards and one backwards.

use nalgebra::SMatrix;

use super::checkpoints::{Checkpoint, reversed};
use super::motion::NoParameters;
use super::no_derivative::SensitivityError;
use super::pull_back::{PulledBack, add};
use super::steps::knows_its_return;
use crate::arrays::{all_finite, first_non_finite};
use crate::methods::{Fixed, Tableau};
use crate::{D, Dynamics, IntegrationError, Jacobian, Scalar, ScalarOf, State};

/// A value with its derivatives by the state and the inputs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slope<T, const N: usize, const M: usize> {
    /// The value.
    pub value: T,
    /// Its derivatives by the components of the state.
    pub by_state: [T; N],
    /// Its derivatives by the inputs.
    pub by_input: [T; M],
}

impl<T: Scalar, const N: usize, const M: usize> Slope<T, N, M> {
    /// Nothing.
    #[must_use]
    pub const fn zero() -> Self {
        Self { value: T::ZERO, by_state: [T::ZERO; N], by_input: [T::ZERO; M] }
    }
}

/// What steps cost: g(x(T)) + Σ hₖ ℓ(k, tₖ, xₖ, uₖ), with xₖ the state before step k and hₖ the length of the step.
pub trait Objective<S: Dynamics, const N: usize, const M: usize> {
    /// ℓ, the cost per time. None unless said otherwise.
    fn running(
        &self,
        tick: usize,
        t: ScalarOf<S>,
        state: &S::State,
        input: &S::Input,
    ) -> Slope<ScalarOf<S>, N, M> {
        let _ = (tick, t, state, input);
        Slope::zero()
    }

    /// g, the cost at the end; its derivatives by inputs are not read.
    fn end(&self, t: ScalarOf<S>, state: &S::State) -> Slope<ScalarOf<S>, N, M>;
}

/// The gradient of a cost; that by the inputs stands in the slice that was given for it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Gradient<X, T, const N: usize, const Q: usize = 0> {
    /// The cost.
    pub value: T,
    /// The state at the end.
    pub end: X,
    /// By the components of the state at the start.
    pub by_start: [T; N],
    /// By the parameters, through the motion.
    pub by_parameters: [T; Q],
}

/// Steps of an explicit method, and the gradient of what they cost: the **exact derivative of the steps that are taken**,
/// to round-off, for the cost of about as many evaluations of the Jacobian as the steps have stages, whatever the number
/// of inputs and parameters.
///
/// What is differentiated are the steps of [`Fixed::step`], from tick to tick with an input each. An optimiser that is
/// given it finds the same cost lower along it, to the last digit, however long the steps are. It is an approximation of
/// the derivative of the exact motion, of the order of the method; see [`Variational`](super::Variational) for that.
///
/// Going backwards needs the states on the way. Some are kept, in places that the caller gives, and the steps between
/// them are taken again: with s places at most r times each, where r is the least number with C(s + 1 + r, r) at least the number of
/// steps. For 1000 steps 999 places need no step twice but for its own stages, 43 at most 2, 16 at most 3, 9 at most 4; none at all 500 on
/// average.
///
/// ```
/// use nonholonomic::prelude::*;
/// use nonholonomic::sensitivity::{Adjoint, Checkpoint, Objective, Slope};
///
/// /// A mass on a spring, pushed.
/// #[nonholonomic(
///     base       { x }
///     lagrangian { m / 2 * der(x)^2 - k / 2 * x^2 }
///     forces     { x: push; }
///     inputs     { push }
///     emit       { jacobian, parameter_jacobian }
/// )]
/// #[derive(Clone, Copy, Debug)]
/// struct Oscillator { m: f64, k: f64 }
///
/// /// Half the square of the place at the end, and of the push all the way.
/// struct Arrive;
///
/// impl Objective<Oscillator, 2, 1> for Arrive {
///     fn running(&self, _tick: usize, _t: f64, _x: &OscillatorState, u: &OscillatorInput) -> Slope<f64, 2, 1> {
///         Slope { value: 0.5 * u.push * u.push, by_input: [u.push], ..Slope::zero() }
///     }
///     fn end(&self, _t: f64, x: &OscillatorState) -> Slope<f64, 2, 1> {
///         Slope { value: 0.5 * x.x * x.x, by_state: [x.x, 0.0], ..Slope::zero() }
///     }
/// }
///
/// # fn main() -> Result<(), Box<dyn core::error::Error>> {
/// let oscillator = Oscillator { m: 1.0, k: 4.0 };
/// let start = OscillatorState { x: 1.0, x_dot: 0.0 };
/// let mut pushes = [OscillatorInput { push: 0.0 }; 100];
/// let mut by_push = [[0.0]; 100];
/// let mut places = [Checkpoint::room(start); 10];
/// let steps = Adjoint::new(&oscillator, Rk4::new(0.02))
///     .by_parameters(|oscillator: &Oscillator, t, x, u| oscillator.parameter_jacobian(t, x, u));
/// let before = steps.gradient(0.0, &start, &pushes, &Arrive, &mut places, &mut by_push)?;
/// // downhill
/// pushes.iter_mut().zip(by_push).for_each(|(u, [slope])| u.push -= 30.0 * slope);
/// let after = steps.gradient(0.0, &start, &pushes, &Arrive, &mut places, &mut by_push)?;
/// assert!(after.value < 0.9 * before.value);
/// # Ok(())
/// # }
/// ```
#[doc(alias(
    "adjoint",
    "backpropagation",
    "reverse-mode differentiation",
    "optimal control",
    "checkpointing"
))]
#[derive(Clone, Copy, Debug)]
pub struct Adjoint<'a, S, P, T, F> {
    system: &'a S,
    method: Fixed<P, T>,
    parameters: F,
}

impl<'a, S, P, T, const N: usize> Adjoint<'a, S, P, T, NoParameters<S, T, N>>
where
    T: Scalar,
    P: Tableau,
    S: Dynamics<State: State<Scalar = T, Dim = D<N>>>,
{
    /// Steps of this method, with derivatives by start and inputs. An adaptive method has steps of fixed length as
    /// `Dop853::fixed(h)`.
    #[must_use]
    pub fn new(system: &'a S, method: Fixed<P, T>) -> Self {
        Self { system, method, parameters: |_, _, _, _| SMatrix::from([[T::ZERO; N]; 0]) }
    }

    /// Gives the derivatives of F by the parameters too, as the generated `parameter_jacobian` does.
    #[must_use]
    pub fn by_parameters<G, const Q: usize>(self, parameters: G) -> Adjoint<'a, S, P, T, G>
    where
        G: Fn(&S, T, &S::State, &S::Input) -> SMatrix<T, N, Q>,
    {
        Adjoint { system: self.system, method: self.method, parameters }
    }
}

impl<S, P, T, F, const N: usize, const M: usize, const Q: usize> Adjoint<'_, S, P, T, F>
where
    T: Scalar,
    P: Tableau,
    S: Jacobian<InputDim = D<M>, State: State<Scalar = T, Dim = D<N>>>,
    F: Fn(&S, T, &S::State, &S::Input) -> SMatrix<T, N, Q>,
{
    /// The gradient of a cost of as many steps as there are inputs, all of the method's length, by the state at the start,
    /// the parameters and, in `by_inputs`, the inputs of each step.
    ///
    /// # Errors
    /// As [`gradient_at`](Self::gradient_at), and [`SensitivityError::Integration`] for a length that is not positive.
    pub fn gradient(
        &self,
        t0: T,
        start: &S::State,
        inputs: &[S::Input],
        objective: &impl Objective<S, N, M>,
        places: &mut [Checkpoint<S::State>],
        by_inputs: &mut [[T; M]],
    ) -> Result<Gradient<S::State, T, N, Q>, SensitivityError> {
        let step = self.method.step;
        if !step.is_finite() || T::ZERO.all_ge(step) {
            return Err(SensitivityError::Integration(IntegrationError::Setting {
                setting: "step",
                value: step.to_f64(),
                expected: "positive and finite",
            }));
        }
        self.gradient_at(
            |tick| count::<T>(tick).mul_add(step, t0),
            start,
            inputs,
            objective,
            places,
            by_inputs,
        )
    }

    /// The same with step k from `times(k)` to `times(k + 1)`: those that an adaptive method has chosen, say.
    ///
    /// # Errors
    /// [`SensitivityError::Length`] if `by_inputs` has not the length of `inputs`; [`SensitivityError::Returned`] if the
    /// system has position constraints, and derivatives by parameters are asked for or the return has none; [`SensitivityError::NotFinite`].
    pub fn gradient_at(
        &self,
        times: impl Fn(usize) -> T,
        start: &S::State,
        inputs: &[S::Input],
        objective: &impl Objective<S, N, M>,
        places: &mut [Checkpoint<S::State>],
        by_inputs: &mut [[T; M]],
    ) -> Result<Gradient<S::State, T, N, Q>, SensitivityError> {
        let (ticks, length) = (inputs.len(), by_inputs.len());
        if length != ticks {
            return Err(SensitivityError::Length { slice: "by_inputs", length, expected: ticks });
        }
        if self.system.has_positions() && (Q > 0 || !knows_its_return(self.system, times(0), start)) {
            return Err(SensitivityError::Returned);
        }
        let not_finite = |what, time: T| SensitivityError::NotFinite { what, time: time.to_f64() };
        if first_non_finite::<T>(start.to_array().as_ref()).is_some() {
            return Err(not_finite("start", times(0)));
        }
        if let Some(time) = (0..=ticks).map(&times).find(|time| !time.is_finite()) {
            return Err(not_finite("time of a tick", time));
        }
        let step = |tick: usize, state: &S::State| {
            let (Some(input), t) = (inputs.get(tick), times(tick)) else { return *state };
            Fixed::<P, T>::step(self.system, t, times(tick + 1) - t, state, input)
        };
        let finish = |state: &S::State| objective.end(times(ticks), state);
        let begun = (ticks == 0).then(|| finish(start));
        let mut gradient = Gradient {
            value: begun.as_ref().map_or(T::ZERO, |end| end.value),
            end: *start,
            by_start: begun.map_or([T::ZERO; N], |end| end.by_state),
            by_parameters: [T::ZERO; Q],
        };
        if !gradient.value.is_finite() || !all_finite::<T, _>(&gradient.by_start) {
            return Err(not_finite("cost or its gradient", times(0)));
        }
        reversed(ticks, start, places, step, |tick, state| {
            let (Some(input), Some(slot)) = (inputs.get(tick), by_inputs.get_mut(tick)) else {
                return Ok(());
            };
            let (t, h) = (times(tick), times(tick + 1) - times(tick));
            let Gradient { value, end, by_start, by_parameters } = &mut gradient;
            let covector = |reached: &S::State| {
                if tick + 1 == ticks {
                    let last = finish(reached);
                    (*end, *value) = (*reached, last.value);
                    last.by_state
                } else {
                    *by_start
                }
            };
            let parameters = |t: T, x: &S::State, u: &S::Input| (self.parameters)(self.system, t, x, u);
            let back: PulledBack<_, T, N, M, Q> =
                Fixed::<P, T>::pulled_back_step(self.system, t, h, state, input, covector, parameters);
            let running = objective.running(tick, t, state, input);
            *value = running.value.mul_add(h, *value);
            *by_start = back.by_state;
            add(by_start, h, &running.by_state);
            *slot = back.by_input;
            add(slot, h, &running.by_input);
            add(by_parameters, T::ONE, &back.by_parameters);
            let is_finite = all_finite(slot) && all_finite(by_start) && all_finite(by_parameters);
            if is_finite && value.is_finite() { Ok(()) } else { Err(not_finite("cost or its gradient", t)) }
        })?;
        Ok(gradient)
    }
}

/// A count as a number.
#[allow(clippy::cast_precision_loss)] // beyond 2⁵³ ticks
fn count<T: Scalar>(tick: usize) -> T {
    T::from_f64(tick as f64)
}
