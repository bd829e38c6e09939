//! The Taylor method.

use super::leg::Leg;
use super::{Arrival, Method, Start, component, non_finite_derivative};
use crate::arrays::{all_finite, first_non_finite};
use crate::step_control::StepControl;
use crate::tolerance::{PerComponent, Tolerance, Uniform};
use crate::{Dim, Dynamics, IntegrationError, Real, Scalar, State, Statistics, TaylorSeries, VecOf};

/// The Taylor method: each step is a partial sum of the Taylor series of the solution, of an order
/// that the tolerance chooses and over a length that the last two coefficients do.
///
/// The method of choice near round-off: the cost of a step grows with the square of the order, and
/// the order with the logarithm of the tolerance. No step is tried in vain, and the dense output is
/// the sum itself. The system has to have its recurrences: `emit { taylor }`. Source: Jorba, Zou, A
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
    /// The length of the longest step.
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
    /// fraction of a component. What is left out is smaller by two more factors of e².
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
    /// The length of the longest step; unlimited if not given.
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
/// How far a step may exceed the last one where the series ends, so that nothing limits it.
const GROW: f64 = 10.0;
/// By how much the unit of time shrinks if a coefficient is beyond the range of the numbers.
const SHRINK: f64 = 1e-3;

/// A series with the unit of time that its coefficients are in.
#[derive(Clone, Copy)]
pub struct Series<X: State, const P: usize> {
    terms: [X; P],
    unit: X::Scalar,
}

/// What the method remembers.
#[derive(Clone, Copy)]
pub struct Memory<X: State, W, const P: usize> {
    /// The last series, and the one that the next step writes.
    series: [Series<X, P>; 2],
    /// The unit of the next series: the length of the last step as the series would have it.
    next: Option<X::Scalar>,
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
        Memory { series: [empty; 2], next: None, workspace: S::Workspace::default() }
    }

    /// What is stored belongs to the last step, of which the dense output is asked for later.
    #[inline]
    fn forget(&self, _memory: &mut Self::Memory) {}

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
        let shortest = StepControl::shortest(start.time);
        let mut unit = match memory.next {
            Some(unit) => unit,
            None => first_unit(start, &self.tolerance)?,
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
        let proposed = self.control.limited(length).max(shortest);
        let leg = Leg::new(start.time, proposed, target);
        if !leg.time.is_finite() {
            return Err(IntegrationError::NonFiniteTime { time: leg.time.to_f64() });
        }
        let reached = next.at::<S>(self.order, leg.length);
        if !all_finite::<T, _>(&reached) {
            return Err(refusal(start, &next.terms, leg.length));
        }
        memory.series.swap(0, 1);
        memory.next = Some(proposed);
        Ok(Arrival { time: leg.time, state: S::State::from_array(reached) })
    }

    fn dense(&self, memory: &Self::Memory, _start: &Start<'_, S>, _arrival: &Arrival<S>) -> Self::Dense {
        let [last, _] = memory.series;
        last
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
    /// The length at which the last term is e⁻² of the tolerance and the one before it the tolerance,
    /// whichever is shorter (Jorba, Zou, section 3.2); none if a coefficient is not finite.
    #[inline]
    fn length<X: State<Scalar = T>>(&self, series: &Series<X, P>) -> Option<T>
    where
        W: Tolerance<X>,
    {
        let state = series.terms.first()?.to_array();
        let square = |order: usize| -> Option<T> {
            let term = series.terms.get(order)?.to_array();
            Some(self.tolerance.mean_square(&term, &state, &state))
        };
        let before = self.order.checked_sub(1)?;
        let (last, before_last) = (square(self.order)?, square(before)?);
        // a NaN or an infinity in between shows in one of these
        if !(last.is_finite() && before_last.is_finite()) {
            return None;
        }
        if last == T::ZERO && before_last == T::ZERO {
            return Some(series.unit * T::from_f64(GROW));
        }
        let half_over =
            |order: usize| u32::try_from(order).map_or(T::ONE, |order| T::from_u32(2 * order).recip());
        let tiny = T::MIN_POSITIVE;
        let by_last = (T::from_f64(-4.0) - last.max(tiny).ln()) * half_over(self.order);
        let by_before = -before_last.max(tiny).ln() * half_over(before);
        Some(series.unit * by_last.min(by_before).exp())
    }
}

impl<X: State, const P: usize> Series<X, P> {
    /// Σ x_k (τ/unit)ᵏ by Horner's rule.
    #[inline]
    fn at<S: Dynamics<State = X>>(&self, order: usize, elapsed: X::Scalar) -> VecOf<S> {
        let s = elapsed / self.unit;
        let mut terms = self.terms.get(..=order).unwrap_or(&self.terms).iter().rev();
        let mut sum = match terms.next() {
            Some(last) => last.to_array(),
            None => crate::DimOf::<S>::vec(Scalar::ZERO),
        };
        for term in terms {
            let term = term.to_array();
            for (sum, term) in sum.as_mut().iter_mut().zip(term.as_ref()) {
                *sum = sum.mul_add(s, *term);
            }
        }
        sum
    }
}

/// The unit of time of the very first series: the time in which the state changes by its own size,
/// or by the tolerance if it is zero.
#[cold]
fn first_unit<S: Dynamics>(
    start: &Start<'_, S>,
    tolerance: &impl Tolerance<S::State>,
) -> Result<<S::State as State>::Scalar, IntegrationError>
where
    <S::State as State>::Scalar: Real,
{
    let rate = start.derivative();
    if let Some(found) = first_non_finite(rate.as_ref()) {
        return Err(non_finite_derivative::<S::State>(found, start.time.to_f64()));
    }
    let x = start.state.to_array();
    let one = <S::State as State>::Scalar::ONE;
    let size = tolerance.mean_square(&x, &x, &x).max(one);
    let unit = (size / tolerance.mean_square(&rate, &x, &x)).sqrt();
    Ok(if unit.is_finite() && unit > Scalar::ZERO { unit } else { one })
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
