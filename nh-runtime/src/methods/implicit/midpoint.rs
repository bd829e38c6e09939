//! The implicit midpoint rule.

use super::linearization::{Analytic, FiniteDifferences, Linearization};
use super::newton::{
    MOST_ITERATIONS, SLOW, check_tolerance, exceeds, once, one_less, reach, refusal, size, still_missing,
};
use super::starting_values::Misses;
use crate::arrays::displaced;
use crate::linear::Factors;
use crate::methods::fixed::{Fixed, OneStep};
use crate::methods::plateau::Plateau;
use crate::methods::{Arrival, Start};
use crate::{
    Dim, DimOf, Dynamics, IntegrationError, Jacobian, Real, Scalar, ScalarOf, State, Statistics, VecOf,
};

/// The implicit midpoint rule x₁ = x₀ + h f(t₀ + h/2, (x₀ + x₁)/2) with fixed steps, of order 2.
///
/// Symmetric and A-stable; it keeps every quadratic invariant (Hairer, Lubich, Wanner, Geometric
/// Numerical Integration, theorem IV.2.1) to the accuracy to which its equations are solved. They
/// are solved by Newton's iteration, from the last increments, continued, with a Jacobian that is kept as long
/// as it converges well, until what is missing vanishes or the corrections stagnate in round-off. The Jacobian
/// comes from difference quotients, or [from the system](Self::with_jacobian).
pub type ImplicitMidpoint<T, J = FiniteDifferences> = Fixed<Midpoint<T, J>, T>;

/// The share of the state that an increment need not be smaller than.
const SMALL: f64 = 1.0 / 64.0;

/// The computation of a step of [`ImplicitMidpoint`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Midpoint<T, J> {
    tolerance: T,
    linearization: J,
}

impl<T: Real> ImplicitMidpoint<T> {
    /// The method with steps of length `step`, which has to be positive and finite.
    #[must_use]
    pub fn new(step: T) -> Self {
        Self::linearized(step, FiniteDifferences)
    }

    /// The same method with the system's own Jacobian, for systems that have one: declared with
    /// `emit { jacobian }`.
    #[must_use]
    pub fn with_jacobian(self) -> ImplicitMidpoint<T, Analytic> {
        let Self { step, scheme: Midpoint { tolerance, .. } } = self;
        Fixed { step, scheme: Midpoint { tolerance, linearization: Analytic } }
    }

    /// One step of length `dt` as a pure function: the state at `t + dt`.
    ///
    /// # Errors
    /// [`IntegrationError::NoConvergence`] if the equations are not solved,
    /// [`IntegrationError::NonFiniteDerivative`] if the derivative at `state` is not finite,
    /// [`IntegrationError::Setting`] if `dt` is not.
    pub fn step<S>(
        system: &S,
        t: T,
        dt: T,
        state: &S::State,
        input: &S::Input,
    ) -> Result<S::State, IntegrationError>
    where
        S: Dynamics,
        S::State: State<Scalar = T>,
    {
        once(&Self::new(dt.abs()).scheme, &Start { system, input, time: t, state }, dt)
    }
}

impl<T: Real> ImplicitMidpoint<T, Analytic> {
    /// As [`step`](ImplicitMidpoint::step), with the system's own Jacobian.
    ///
    /// # Errors
    /// As there.
    pub fn step_with_jacobian<S>(
        system: &S,
        t: T,
        dt: T,
        state: &S::State,
        input: &S::Input,
    ) -> Result<S::State, IntegrationError>
    where
        S: Jacobian,
        S::State: State<Scalar = T>,
    {
        once(&Self::linearized(dt.abs(), Analytic).scheme, &Start { system, input, time: t, state }, dt)
    }
}

impl<T: Real, J> ImplicitMidpoint<T, J> {
    fn linearized(step: T, linearization: J) -> Self {
        Self { step, scheme: Midpoint { tolerance: T::from_f64(1e3) * T::EPSILON, linearization } }
    }

    /// The largest correction of a component, relative to it or to the terms of its rate, at which the iteration may
    /// stagnate; 1000 rounding units if not given. A larger one does not make it stop earlier.
    #[must_use]
    pub fn tolerance(mut self, tolerance: T) -> Self {
        self.scheme.tolerance = tolerance;
        self
    }
}

impl<T: Real, J> Midpoint<T, J> {
    /// Solves d = h/2 f(t₀ + h/2, x₀ + rest + d) for half the increment, and gives the whole.
    fn solve<S>(
        &self,
        (start, rest): (&Start<'_, S>, &VecOf<S>),
        length: T,
        work: &mut Work<S>,
        statistics: &mut Statistics,
    ) -> Result<VecOf<S>, IntegrationError>
    where
        S: Dynamics,
        S::State: State<Scalar = T>,
        J: Linearization<S>,
    {
        let half = length * T::from_f64(0.5);
        let zero = DimOf::<S>::vec(T::ZERO);
        if work.half != half {
            *work = Work { half, ..Work::none() };
        }
        let mut found = work.last.unwrap_or(zero);
        work.misses.mend(&mut found);
        if let Err(error) = self.iterate((start, rest), &mut found, work, length, statistics) {
            *work = Work::none();
            return Err(error);
        }
        if let Some(last) = &work.last {
            work.misses.note(&found, last);
        }
        work.last = Some(found);
        Ok(displaced(&found, T::ONE, &found))
    }

    /// The same from a starting value of half the increment.
    fn iterate<S>(
        &self,
        (start, rest): (&Start<'_, S>, &VecOf<S>),
        half_increment: &mut VecOf<S>,
        work: &mut Work<S>,
        length: T,
        statistics: &mut Statistics,
    ) -> Result<(), IntegrationError>
    where
        S: Dynamics,
        S::State: State<Scalar = T>,
        J: Linearization<S>,
    {
        let half = work.half;
        let middle = start.time + half;
        let x = start.state.to_array();
        let mut preceding: Option<T> = None;
        // a stored matrix and a starting value that fail get one chance more with new ones
        let mut retry = work.last.is_some() || work.newton.is_some();
        let mut iterations = 0;
        // before the first correction: the larger of the state, and of what the slope there moves it
        let mut usual: Option<T> = None;
        let mut plateau = Plateau::new();
        loop {
            let point = displaced(&x, T::ONE, &displaced(half_increment, T::ONE, rest));
            let slope = start.derivative_at(middle, point);
            statistics.evaluations += 1;
            let usual = *usual.get_or_insert_with(|| largest(&x).max(half.abs() * largest(&slope)));
            if work.newton.is_none() {
                let jacobian =
                    self.linearization.state_jacobian(start, middle, &point, &slope, length, statistics);
                statistics.jacobians += 1;
                statistics.factorizations += 1;
                let reach = reach::<S>(&jacobian, &x, half);
                work.newton = Some((Factors::new(&one_less::<DimOf<S>, _>(half, jacobian)), reach));
            }
            let Some((newton, reach)) = &work.newton else { continue };
            let correction = corrected(newton, half, &slope, half_increment);
            let before = *half_increment;
            *half_increment = displaced(half_increment, T::ONE, &correction);
            iterations += 1;
            statistics.iterations += 1;
            let residual = size(&correction, &x, half_increment, reach) / self.tolerance;
            let ratio = preceding.map(|preceding| residual / preceding);
            let vanishes = vanishes(&correction, &x, half_increment, still_missing(ratio));
            let stagnates = ratio.is_some_and(|ratio| ratio >= T::from_f64(0.5));
            if vanishes || (stagnates && residual <= T::ONE) {
                if is_elsewhere(largest(half_increment), usual) {
                    let reached = displaced(&x, T::from_f64(2.0), half_increment);
                    let from = [(middle, point)];
                    return Err(refusal(start, length, (iterations, residual), reached.as_ref(), from));
                }
                return Ok(());
            }
            if plateau.is_level(&correction, residual) && residual > T::ONE {
                let ahead = |part: T| {
                    statistics.evaluations += 1;
                    let there = displaced(&before, part, &correction);
                    let slope =
                        start.derivative_at(middle, displaced(&x, T::ONE, &displaced(&there, T::ONE, rest)));
                    corrected(newton, half, &slope, &there)
                };
                let is_open = |row| exceeds(row, (&correction, &x, &before, reach), self.tolerance);
                let permitted = T::EPSILON.sqrt() * usual;
                if plateau.is_rounding(&correction, permitted, is_open, ahead) {
                    return Ok(());
                }
            }
            if !residual.is_finite() || iterations >= MOST_ITERATIONS {
                if !retry {
                    let reached = displaced(&x, T::from_f64(2.0), half_increment);
                    let from = [(middle, point)];
                    return Err(refusal(start, length, (iterations, residual), reached.as_ref(), from));
                }
                retry = false;
                *half_increment = DimOf::<S>::vec(T::ZERO);
                work.newton = None;
                preceding = None;
                plateau = Plateau::new();
                iterations = 0;
                continue;
            }
            if ratio.is_some_and(|ratio| ratio >= T::from_f64(SLOW)) && residual > T::ONE {
                work.newton = None;
            }
            preceding = Some(residual);
        }
    }
}

/// What half an increment is to be changed by, where this is the slope.
fn corrected<D: Dim, T: Real>(
    newton: &Factors<D, T>,
    half: T,
    slope: &D::Vec<T>,
    increment: &D::Vec<T>,
) -> D::Vec<T> {
    let mut defect = *slope;
    for (r, d) in defect.as_mut().iter_mut().zip(increment.as_ref()) {
        *r = half * *r - *d;
    }
    newton.solve(&defect)
}

/// The largest absolute value of a component; NaN if there is one.
fn largest<T: Real, V: AsRef<[T]>>(vector: &V) -> T {
    vector.as_ref().iter().fold(T::ZERO, |largest, x| largest.max(x.abs()))
}

/// Whether an increment belongs to another solution of the equation than that of a small step: so much larger than
/// the state and than what the slope moves it that less than half of their digits are left in the sum. Equations
/// have such solutions where the slope is infinite near by.
fn is_elsewhere<T: Real>(increment: T, usual: T) -> bool {
    increment * T::EPSILON.sqrt() > usual
}

/// Whether a share of a correction is below half a rounding unit of the increment, or of a small share of the state, in every
/// component. What is below that of the whole state, which increments are small beside, has the same sign from step to step.
fn vanishes<T: Real, V: AsRef<[T]>>(correction: &V, x: &V, increment: &V, share: T) -> bool {
    let (half_unit, small) = (T::EPSILON * T::from_f64(0.5), T::from_f64(SMALL));
    let terms = correction.as_ref().iter().zip(x.as_ref().iter().zip(increment.as_ref()));
    terms.fold(true, |all, (c, (x, d))| {
        all & (share * c.abs() <= half_unit * Scalar::max(d.abs(), small * x.abs()))
    })
}

/// The matrix of an iteration, and what rounding reaches by it.
type Newton<S> = (Factors<DimOf<S>, ScalarOf<S>>, VecOf<S>);

/// What the midpoint rule keeps while its steps have one length.
pub struct Work<S: Dynamics> {
    /// Half that length.
    half: ScalarOf<S>,
    /// Half the increment of the last step.
    last: Option<VecOf<S>>,
    /// By how much the steps differed from those before.
    misses: Misses<VecOf<S>>,
    /// The factorized matrix 1 − h/2 ∂f/∂x of Newton's iteration, and what rounding reaches by it.
    newton: Option<Newton<S>>,
}

impl<S: Dynamics> Clone for Work<S> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<S: Dynamics> Copy for Work<S> {}

impl<S: Dynamics> Work<S> {
    /// Before any step.
    fn none() -> Self {
        let zero = ScalarOf::<S>::ZERO;
        Self { half: zero, last: None, misses: Misses::none(DimOf::<S>::vec(zero)), newton: None }
    }
}

impl<T: Real, S: Dynamics, J: Linearization<S>> OneStep<S> for Midpoint<T, J>
where
    S::State: State<Scalar = T>,
{
    type Work = Work<S>;
    dense_by_cubic!();

    fn work(&self) -> Work<S> {
        Work::none()
    }

    #[inline]
    fn forget(&self, work: &mut Work<S>) {
        *work = Work::none();
    }

    /// The matrix of an iteration, and what it starts from, serve states beside theirs.
    fn moved(&self, _work: &mut Work<S>) {}

    fn check(&self) -> Result<(), IntegrationError> {
        check_tolerance(self.tolerance)
    }

    fn increment(
        &self,
        start: &Start<'_, S>,
        x: &VecOf<S>,
        h: T,
        work: &mut Work<S>,
        statistics: &mut Statistics,
    ) -> Result<VecOf<S>, IntegrationError> {
        self.increment_beyond(start, (x, &DimOf::<S>::vec(T::ZERO)), h, work, statistics)
    }

    fn increment_beyond(
        &self,
        start: &Start<'_, S>,
        (_, rest): (&VecOf<S>, &VecOf<S>),
        h: T,
        work: &mut Work<S>,
        statistics: &mut Statistics,
    ) -> Result<VecOf<S>, IntegrationError> {
        self.solve((start, rest), h, work, statistics)
    }
}
