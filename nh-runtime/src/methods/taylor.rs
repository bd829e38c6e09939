//! The Taylor method.

mod step_series;

use step_series::Series;

use super::first_step::first_length;
use super::fixed::rounding;
use super::leg::Leg;
use super::{Arrival, Method, Return, Start, Step, ToPositions, component, non_finite_derivative};
use crate::arrays::{all_finite, difference, displaced, first_non_finite};
use crate::step_control::StepControl;
use crate::tolerance::{PerComponent, Tolerance, Uniform, norm};
use crate::{Dim, Dynamics, IntegrationError, Real, Scalar, State, Statistics, TaylorSeries, VecOf};

/// The Taylor method: each step is a partial sum of the Taylor series of the solution, of an order
/// that the tolerance chooses and over a length that the last two coefficients do.
///
/// The method of choice near round-off: the cost of a step grows with the square of the order, and
/// the order with the logarithm of the tolerance. Near the end of a step the sum is compared with the
/// equation, and a step that the last two coefficients make too long is shortened without another expansion. The
/// dense output is the sum itself. The system has to have its recurrences: `emit { taylor }`. Source: Jorba, Zou, A
/// software package for the numerical integration of ODEs by means of high-order Taylor methods,
/// Experimental Mathematics 14 (2005), section 3.
///
/// `P` is the number of coefficients that there is room for: with the default, orders up to 24.
/// [`Statistics::evaluations`] counts expansions.
///
/// ```
/// use nonholonomic::Taylor;
///
/// let method: Taylor<f64> = Taylor::new().rtol(1e-15);
/// assert_eq!(method.order(), 19);
/// // order 30 at every tolerance
/// let method = Taylor::<f64, 31>::of_order(30).rtol(1e-14).max_step(0.5);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Taylor<T, const P: usize = 25, W = Uniform<T>> {
    tolerance: W,
    /// What bounds the lengths of steps.
    control: StepControl<T>,
    order: usize,
    is_fixed: bool,
}

impl<T: Real> Taylor<T> {
    /// The method with the default tolerances: 10⁻⁶ in `f64`, 10⁻⁴ in `f32`; the order follows from
    /// the relative one.
    #[must_use]
    pub fn new() -> Self {
        let tolerance = Uniform::new();
        let order = best_order(tolerance.rtol);
        Self { tolerance, control: StepControl::new(), order, is_fixed: false }
    }
}

impl<T: Real> Default for Taylor<T> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T: Real, const P: usize> Taylor<T, P> {
    /// The method with an order of its own, from 2 to `P − 1`.
    #[must_use]
    pub fn of_order(order: usize) -> Self {
        Self { tolerance: Uniform::new(), control: StepControl::new(), order, is_fixed: true }
    }

    /// The relative tolerance: the size that the last term but one of a step's sum may have, as a
    /// fraction of a component. What is left out is smaller by two more factors of e², and by further three for a
    /// tolerance of less than 32 rounding units: what is left out has the same sign from step to step, and would
    /// be seen before the rounding errors are, which do not.
    #[must_use]
    pub fn rtol(mut self, rtol: T) -> Self {
        self.tolerance.rtol = rtol;
        self.adapted_to(rtol)
    }

    /// The absolute tolerance, in the units of the state; as `rtol` if not given.
    #[must_use]
    pub fn atol(mut self, atol: T) -> Self {
        self.tolerance.atol = Some(atol);
        self
    }

    /// The relative and the absolute tolerance of each component, as two states.
    #[must_use]
    pub fn tolerances<X: State<Scalar = T>>(self, rtol: X, atol: X) -> Taylor<T, P, PerComponent<X>> {
        let least = rtol.to_array().as_ref().iter().fold(T::ONE, |least, rtol| least.min(*rtol));
        let Self { control, order, is_fixed, .. } = self.adapted_to(least);
        Taylor { tolerance: PerComponent { rtol, atol }, control, order, is_fixed }
    }

    /// Chooses the order, unless it has been given.
    fn adapted_to(mut self, rtol: T) -> Self {
        if !self.is_fixed {
            self.order = best_order(rtol).min(P.saturating_sub(1));
        }
        self
    }
}

impl<T: Real, const P: usize, W> Taylor<T, P, W> {
    /// The length of the longest step, which may be a hundredth longer where it lands on a target; unlimited if not
    /// given.
    #[must_use]
    pub fn max_step(mut self, max_step: T) -> Self {
        self.control.max_step = Some(max_step);
        self
    }

    /// The order: that of the last coefficient that is computed.
    #[must_use]
    pub fn order(&self) -> usize {
        self.order
    }
}

/// The order at which a given length of time costs least, −½ ln ε + 1 (Jorba, Zou, section 3.1).
fn best_order<T: Real>(rtol: T) -> usize {
    let rtol = rtol.max(T::EPSILON).min(T::from_f64(0.1)).to_f64();
    let mut order = 2;
    // a logarithm by counting: the next order pays for itself while ε e^(2 (p − 1)) < 1
    let mut bound = rtol * E_SQUARED;
    while bound < 1.0 {
        order += 1;
        bound *= E_SQUARED;
    }
    order
}

/// e²
const E_SQUARED: f64 = 7.389_056_098_930_65;
/// How far a step may exceed the last one.
const GROW: f64 = 10.0;
/// Where in a step the sum is compared with the equation.
const NEAR_THE_END: f64 = 0.9375;
/// A defect of this many rounding units of the derivative is no more than rounding.
const NOISE: f64 = 1e3;
/// A step whose sum misses the equation is shortened to this share of its length, at least and at most.
const SHORTER: [f64; 2] = [0.1, 0.8];
/// A tolerance of this many rounding units of the state is near round-off.
const NEAR_ROUND_OFF: f64 = 32.0;
/// Twice the exponent of e by which the terms are smaller there.
const MARGIN: f64 = 12.0;
/// By how much the unit of time shrinks if a coefficient is beyond the range of the numbers.
const SHRINK: f64 = 1e-3;

/// What the method remembers.
#[derive(Clone, Copy)]
pub struct Memory<X: State, W, const P: usize> {
    /// The last series, and the one that the next step writes.
    series: [Series<X, P>; 2],
    /// Where in time the last one begins.
    begun: X::Scalar,
    /// The unit of the next series: the length of the last step as the series would have it.
    next: Option<X::Scalar>,
    /// What rounding has taken from the state.
    carry: <X::Dim as Dim>::Vec<X::Scalar>,
    workspace: W,
}

impl<T: Real, S: TaylorSeries, const P: usize, W: Tolerance<S::State>> Method<S> for Taylor<T, P, W>
where
    S::State: State<Scalar = T>,
{
    type Memory = Memory<S::State, S::Workspace<P>, P>;
    type Dense = Series<S::State, P>;

    fn memory(&self) -> Self::Memory {
        let zero = S::State::from_array(crate::DimOf::<S>::vec(T::ZERO));
        let empty = Series { terms: [zero; P], unit: T::ONE };
        Memory {
            series: [empty; 2],
            begun: T::from_f64(f64::NAN),
            next: None,
            carry: zero.to_array(),
            workspace: S::Workspace::default(),
        }
    }

    /// The series belongs to the last step, of which the dense output is asked for later.
    #[inline]
    fn forget(&self, memory: &mut Self::Memory) {
        memory.carry = crate::DimOf::<S>::vec(T::ZERO);
    }

    #[inline]
    fn judges(&self) -> bool {
        true
    }

    fn check(&self) -> Result<(), IntegrationError> {
        self.tolerance.check()?;
        self.control.check()?;
        if (2..P).contains(&self.order) {
            return Ok(());
        }
        Err(IntegrationError::Setting {
            setting: "order",
            value: u32::try_from(self.order).unwrap_or(u32::MAX).into(),
            expected: "at least 2, and less than the number of coefficients that there is room for, \
                       the second parameter of `Taylor`",
        })
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
        Ok(self.take::<false, S, _>(start, target, &ToPositions, memory, statistics)?.0)
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
        self.take::<true, S, _>(start, target, by, memory, statistics)
    }

    fn dense(&self, memory: &Self::Memory, start: &Start<'_, S>, arrival: &Arrival<S>) -> Self::Dense {
        let [last, _] = memory.series;
        if memory.begun == start.time {
            return last;
        }
        // another step has been computed since, and was not taken
        let mut again = Series { unit: (arrival.time - start.time).abs(), ..last };
        let Start { system, input, time, state } = *start;
        let terms = again.terms.get_mut(..=self.order).unwrap_or_default();
        system.expand(time, state, input, again.unit, terms, &mut S::Workspace::<P>::default());
        again
    }

    /// The sum, and in proportion to the time what the arrival has been corrected by.
    fn interpolate(
        &self,
        dense: &Self::Dense,
        start: &Start<'_, S>,
        arrival: &Arrival<S>,
        time: T,
    ) -> S::State {
        let (length, elapsed) = (arrival.time - start.time, time - start.time);
        let mut x = dense.at::<S>(self.order, elapsed);
        let end = dense.at::<S>(self.order, length);
        let corrected = arrival.state.to_array();
        for (x, (end, corrected)) in x.as_mut().iter_mut().zip(end.as_ref().iter().zip(corrected.as_ref())) {
            *x += (*corrected - *end) * (elapsed / length);
        }
        S::State::from_array(x)
    }
}

impl<T: Real, const P: usize, W> Taylor<T, P, W> {
    /// Takes one step, and returns its end `by` this if it is to.
    #[inline]
    fn take<const RETURN: bool, S: TaylorSeries, R: Return<S>>(
        &self,
        start: &Start<'_, S>,
        target: Option<T>,
        by: &R,
        memory: &mut Memory<S::State, S::Workspace<P>, P>,
        statistics: &mut Statistics,
    ) -> Result<Step<S>, IntegrationError>
    where
        S::State: State<Scalar = T>,
        W: Tolerance<S::State>,
    {
        let shortest = self.control.least(start.time)?;
        let mut unit = match memory.next {
            Some(unit) => unit,
            None => self.first_unit(start, target, statistics)?,
        };
        let [_, next] = &mut memory.series;
        let length = loop {
            statistics.evaluations += 1;
            next.unit = unit;
            let Start { system, input, time, state } = *start;
            let terms = next.terms.get_mut(..=self.order).unwrap_or_default();
            system.expand(time, state, input, unit, terms, &mut memory.workspace);
            if let Some(length) = self.length(next) {
                break length;
            }
            if unit <= shortest {
                return Err(refusal(start, &next.terms, unit));
            }
            statistics.rejected += 1;
            unit = (unit * T::from_f64(SHRINK)).max(shortest);
        };
        let mut proposed = self.control.limited(length).max(shortest);
        let x = start.state.to_array();
        let (leg, change, reached, returned) = loop {
            let leg = Leg::new(start.time, proposed, target);
            if !leg.time.is_finite() {
                return Err(IntegrationError::NonFiniteTime { time: leg.time.to_f64() });
            }
            let change = displaced(&next.change::<S>(self.order, leg.length), T::ONE, &memory.carry);
            let reached = displaced(&x, T::ONE, &change);
            if !all_finite::<T, _>(&reached) {
                return Err(refusal(start, &next.terms, leg.length));
            }
            let mut excess = self.excess(start, next, leg.length);
            let (mut end, mut returned) = (S::State::from_array(reached), Ok(None));
            if RETURN && excess <= T::ONE {
                returned = by.state(start.system, leg.time, &mut end).map(Some);
                excess = match &returned {
                    Ok(Some(returned)) => {
                        excess.max(by.error(&self.tolerance, returned, start.state, &end.to_array()))
                    }
                    _ => T::from_f64(f64::INFINITY),
                };
            }
            if excess <= T::ONE
                && let Ok(returned) = returned
            {
                break (leg, change, reached, returned.map(|returned| (end, returned)));
            }
            if proposed <= shortest {
                if let Err(error) = returned {
                    return Err(IntegrationError::Projection { time: leg.time.to_f64(), error });
                }
                let (time, step) = (start.time.to_f64(), leg.length.to_f64());
                return Err(IntegrationError::StepUnderflow { time, step, error: excess.to_f64() });
            }
            statistics.rejected += 1;
            let share = (excess.ln() * per(self.order + 1)).exp().recip();
            let [least, most] = SHORTER.map(T::from_f64);
            let share = if share >= least { share.min(most) } else { least };
            proposed = (proposed.min(leg.length.abs()) * share).max(shortest);
        };
        memory.carry = rounding(&x, &change, &reached);
        memory.series.swap(0, 1);
        memory.begun = start.time;
        memory.next = Some(proposed);
        let Some((state, returned)) = returned else {
            return Ok((Arrival { time: leg.time, state: S::State::from_array(reached) }, None));
        };
        if returned.is_moved {
            memory.carry = crate::DimOf::<S>::vec(T::ZERO);
        }
        Ok((Arrival { time: leg.time, state }, Some(returned)))
    }

    /// The unit of time of the very first series.
    #[cold]
    fn first_unit<S: Dynamics>(
        &self,
        start: &Start<'_, S>,
        target: Option<T>,
        statistics: &mut Statistics,
    ) -> Result<T, IntegrationError>
    where
        S::State: State<Scalar = T>,
        W: Tolerance<S::State>,
    {
        let rate = start.derivative();
        if let Some(found) = first_non_finite(rate.as_ref()) {
            return Err(non_finite_derivative::<S::State>(found, start.time.to_f64()));
        }
        let order = u32::try_from(self.order).unwrap_or(u32::MAX);
        let settings = (&self.tolerance, &self.control);
        let length = first_length((start, &rate), target, order, settings, statistics);
        Ok(length.max(StepControl::shortest(start.time)))
    }

    /// By how much the sum misses the differential equation near the end of a step, as a multiple of what is
    /// permitted: terms that vanish, as of x″ = −x³ from x = 0, tell nothing of those left out, nor does
    /// anything in a series tell of a kink or a pole farther ahead. What rounding explains is none.
    #[inline]
    fn excess<S: Dynamics>(&self, start: &Start<'_, S>, series: &Series<S::State, P>, length: T) -> T
    where
        S::State: State<Scalar = T>,
        W: Tolerance<S::State>,
    {
        // not at the end itself, where the equation may already be another one
        let elapsed = length * T::from_f64(NEAR_THE_END);
        let there = series.at::<S>(self.order, elapsed);
        let rate = start.derivative_at(start.time + elapsed, there);
        let by_series = series.rate_at::<S>(self.order, elapsed);
        let x = start.state.to_array();
        let change = |rate: &VecOf<S>| length.abs() * norm(&self.tolerance, rate, &x, &there);
        let noise = T::from_f64(NOISE) * T::EPSILON * (change(&rate) + change(&by_series));
        let defect = change(&difference(&by_series, &rate));
        // that of the first term left out, at a share of its length and divided by its order
        let share = T::from_f64(NEAR_THE_END).powi(i32::try_from(self.order).unwrap_or(i32::MAX));
        if defect <= noise { T::ZERO } else { defect * per(self.order + 1) / share }
    }

    /// The length at which the last term is e⁻² of the tolerance and the one before it the tolerance,
    /// whichever is shorter (Jorba, Zou, section 3.2), and at most ten times the last one; none if a coefficient is
    /// not finite.
    #[inline]
    fn length<X: State<Scalar = T>>(&self, series: &Series<X, P>) -> Option<T>
    where
        W: Tolerance<X>,
    {
        let state = series.terms.first()?.to_array();
        let square = |order: usize| -> Option<T> {
            let term = series.terms.get(order)?.to_array();
            let square = self.tolerance.mean_square(&term, &state, &state);
            if square.is_finite() {
                return Some(square);
            }
            // a component that starts at zero, with a relative tolerance alone
            Some(self.tolerance.mean_square(&term, &state, &series.sizes(self.order)))
        };
        let before = self.order.checked_sub(1)?;
        let (last, before_last) = (square(self.order)?, square(before)?);
        // a NaN or an infinity in between shows in one of these
        if !(last.is_finite() && before_last.is_finite()) {
            return None;
        }
        let half = T::from_f64(0.5);
        let tiny = T::MIN_POSITIVE;
        // near round-off what is left out would add up faster than what is rounded
        let resolution = self.tolerance.mean_square(&state, &state, &state);
        let is_near =
            resolution * T::from_f64(NEAR_ROUND_OFF * NEAR_ROUND_OFF) * T::EPSILON * T::EPSILON >= T::ONE;
        let margin = if is_near { T::from_f64(MARGIN) } else { T::ZERO };
        let by_last = (T::from_f64(-4.0) - margin - last.max(tiny).ln()) * half * per(self.order);
        let by_before = (-margin - before_last.max(tiny).ln()) * half * per(before);
        let factor = by_last.min(by_before).exp();
        Some(series.unit * factor.min(T::from_f64(GROW)))
    }
}

/// One over a number of terms.
fn per<T: Real>(terms: usize) -> T {
    u32::try_from(terms).map_or(T::ONE, |terms| T::from_u32(terms).recip())
}

/// Explains why there is no step.
#[cold]
fn refusal<S: Dynamics, const P: usize>(
    start: &Start<'_, S>,
    series: &[S::State; P],
    step: <S::State as State>::Scalar,
) -> IntegrationError {
    let time = start.time.to_f64();
    if let Some(found) = first_non_finite(start.derivative().as_ref()) {
        return non_finite_derivative::<S::State>(found, time);
    }
    let index = series.iter().find_map(|term| first_non_finite(term.to_array().as_ref()));
    let component = component::<S::State>(index.map_or(0, |(index, _)| index));
    IntegrationError::NonFiniteStep { component, time, step: step.to_f64() }
}
