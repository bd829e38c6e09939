//! How a table takes a step.

use super::tableau::{Dense, FEW, Pair, Tableau, interpolate};
use crate::arrays::{all_finite, difference, displaced, first_non_finite, nought};
use crate::integrator::Returned;
use crate::methods::fixed::OneStep;
use crate::methods::{Arrival, Return, Scheme, Spread, Start, Trial, non_finite_derivative};
use crate::tolerance::{Tolerance, norm};
use crate::{Dim, DimOf, Dynamics, IntegrationError, Real, Scalar, ScalarOf, State, Statistics, VecOf};

/// Zeros in the shape of a state.
#[inline]
fn zero<S: Dynamics>() -> VecOf<S> {
    DimOf::<S>::vec(ScalarOf::<S>::ZERO)
}

/// All stages of a step, anew, and its slope, with components that are not finite if any stage has.
#[inline(always)]
#[allow(clippy::inline_always)] // the step in one piece: see `Tableau::slope`
pub(crate) fn stages_of<S: Dynamics, P: Tableau>(
    start: &Start<'_, S>,
    x: &VecOf<S>,
    h: ScalarOf<S>,
) -> (P::Stages<VecOf<S>>, VecOf<S>) {
    let mut stages = P::room(zero::<S>());
    *P::first(&mut stages) =
        if P::STAGES <= FEW { start.derivative_in_line(start.time, *x) } else { start.derivative() };
    let mut slope = P::slope(start, x, h, &mut stages);
    if let Some(unseen) = P::unweighted(&stages) {
        for slope in slope.as_mut() {
            *slope += unseen;
        }
    }
    (stages, slope)
}

/// The same, where it is seldom done.
#[cold]
#[inline(never)]
fn stages_again<S: Dynamics, P: Tableau>(start: &Start<'_, S>, h: ScalarOf<S>) -> P::Stages<VecOf<S>> {
    stages_of::<S, P>(start, &start.state.to_array(), h).0
}

/// The dense output of a step with these stages.
fn dense_of<S: Dynamics, P: Tableau>(
    start: &Start<'_, S>,
    arrival: &Arrival<S>,
    stages: &P::Stages<VecOf<S>>,
) -> Dense<VecOf<S>, P::Bulge<VecOf<S>>> {
    let h = arrival.time - start.time;
    let last = start.derivative_at(arrival.time, arrival.state.to_array());
    let bulge = P::bulge(start, h, stages, &last);
    let mut stages = *stages;
    Dense { first: *P::first(&mut stages), last, bulge }
}

impl<S: Dynamics, P: Tableau> OneStep<S> for P {
    const DIRECT: bool = true;
    type Work = ();
    type Dense = Dense<VecOf<S>, P::Bulge<VecOf<S>>>;

    #[inline]
    fn work(&self) {}

    #[inline]
    fn forget(&self, _work: &mut ()) {}

    #[inline]
    fn increment(
        &self,
        start: &Start<'_, S>,
        x: &VecOf<S>,
        h: ScalarOf<S>,
        _work: &mut (),
        statistics: &mut Statistics,
    ) -> Result<VecOf<S>, IntegrationError> {
        statistics.evaluations += u64::from(P::STAGES);
        let (_, mut increment) = stages_of::<S, P>(start, x, h);
        let scale = h * ScalarOf::<S>::from_f64(P::SCALE);
        for change in increment.as_mut() {
            *change *= scale;
        }
        Ok(increment)
    }

    #[cold]
    fn blame(&self, start: &Start<'_, S>, h: ScalarOf<S>) -> Option<IntegrationError> {
        let stages = stages_again::<S, P>(start, h);
        let (found, fraction) = P::blame::<ScalarOf<S>, _>(&stages)?;
        let time = start.time.to_f64() + fraction * h.to_f64();
        Some(non_finite_derivative::<S::State>(found, time))
    }

    fn dense(&self, _work: &(), start: &Start<'_, S>, arrival: &Arrival<S>) -> Self::Dense {
        let h = arrival.time - start.time;
        let stages = stages_again::<S, P>(start, h);
        dense_of::<S, P>(start, arrival, &stages)
    }

    fn interpolate(
        &self,
        dense: &Self::Dense,
        start: &Start<'_, S>,
        arrival: &Arrival<S>,
        time: ScalarOf<S>,
    ) -> S::State {
        interpolate(dense, start, arrival, time)
    }
}

/// What an explicit method keeps of a step.
pub struct Work<S: Dynamics, P: Tableau> {
    /// The derivative at the start.
    first: VecOf<S>,
    stages: P::Stages<VecOf<S>>,
    /// The derivative at the end of the step, if the error estimate needs it.
    last: VecOf<S>,
    /// Whether that is the derivative at the present state and input.
    current: bool,
    /// The start and the length of the step that the stages belong to.
    step: (ScalarOf<S>, ScalarOf<S>),
    /// Whether the next step is looked at for stiffness.
    is_watched: bool,
    /// State and derivative at the last stage of the step looked at.
    beside: Option<(VecOf<S>, VecOf<S>)>,
    /// The largest components, without signs, at the ends of steps looked at in a row.
    largest: VecOf<S>,
}

impl<S: Dynamics, P: Tableau> Clone for Work<S, P> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<S: Dynamics, P: Tableau> Copy for Work<S, P> {}

/// A step of a pair; `arrive` may move its end before the derivative there is evaluated.
#[inline(always)]
#[allow(clippy::inline_always)] // the step in one piece: see `Tableau::slope`
fn step_of<const KEEP: bool, S: Dynamics, P: Pair, W: Tolerance<S::State>>(
    start: &Start<'_, S>,
    h: ScalarOf<S>,
    tolerance: &W,
    work: &mut Work<S, P>,
    statistics: &mut Statistics,
    arrive: impl FnOnce(&mut VecOf<S>),
) -> Trial<S>
where
    ScalarOf<S>: Real,
{
    let x = start.state.to_array();
    let mut stages = P::room(zero::<S>());
    *P::first(&mut stages) = work.first;
    let slope = P::slope(start, &x, h, &mut stages);
    let mut state = displaced(&x, h * ScalarOf::<S>::from_f64(P::SCALE), &slope);
    statistics.evaluations += u64::from(P::STAGES - 1);
    if P::FIRST_SAME_AS_LAST {
        arrive(&mut state);
        statistics.evaluations += 1;
        work.last = start.derivative_at(start.time + h, state);
    }
    let error = P::error(&stages, &work.last, h, |e| norm(tolerance, e, &x, &state));
    if work.is_watched {
        work.beside = P::last_stage(&x, h, &stages);
    }
    if KEEP {
        work.stages = stages;
    }
    Trial { state, error: error + nought(&state) }
}

impl<S: Dynamics, P: Pair> Scheme<S> for P
where
    ScalarOf<S>: Real,
{
    const ERROR_ORDER: u32 = P::ERROR_ORDER;
    const HELD: f64 = P::HELD;
    type Work = Work<S, P>;
    type Dense = Dense<VecOf<S>, P::Bulge<VecOf<S>>>;

    fn work(&self) -> Work<S, P> {
        let never = ScalarOf::<S>::from_f64(f64::NAN);
        let (first, last) = (zero::<S>(), zero::<S>());
        let step = (never, never);
        Work {
            first,
            stages: P::room(first),
            last,
            current: false,
            step,
            is_watched: false,
            beside: None,
            largest: zero::<S>(),
        }
    }

    #[inline]
    fn forget(&self, work: &mut Work<S, P>) {
        work.current = false;
        work.beside = None;
    }

    #[inline]
    fn moved(&self, work: &mut Work<S, P>) {
        work.current = false;
    }

    fn watch(&self, work: &mut Work<S, P>) {
        work.is_watched = true;
    }

    fn spread(
        &self,
        start: &Start<'_, S>,
        in_a_row: bool,
        work: &mut Work<S, P>,
    ) -> Option<Spread<VecOf<S>>> {
        let (beside, derivative) = work.beside.take()?;
        let x = start.state.to_array();
        if !in_a_row {
            work.largest = zero::<S>();
        }
        for (largest, x) in work.largest.as_mut().iter_mut().zip(x.as_ref()) {
            *largest = largest.max(x.abs());
        }
        Some(Spread {
            states: difference(&x, &beside),
            derivatives: difference(&work.first, &derivative),
            largest: work.largest,
        })
    }

    #[inline]
    fn begin<'w>(
        &self,
        start: &Start<'_, S>,
        work: &'w mut Work<S, P>,
        statistics: &mut Statistics,
    ) -> &'w VecOf<S> {
        // the stages are about to be those of another step
        work.step.0 = ScalarOf::<S>::from_f64(f64::NAN);
        if P::FIRST_SAME_AS_LAST && work.current {
            work.first = work.last;
            work.current = false;
        } else {
            statistics.evaluations += 1;
            work.first = start.derivative();
        }
        &work.first
    }

    #[inline(always)]
    #[allow(clippy::inline_always)] // the step in one piece: see `Tableau::slope`
    fn attempt<const KEEP: bool, W: Tolerance<S::State>>(
        &self,
        start: &Start<'_, S>,
        h: ScalarOf<S>,
        tolerance: &W,
        work: &mut Work<S, P>,
        statistics: &mut Statistics,
    ) -> Trial<S> {
        step_of::<KEEP, S, P, W>(start, h, tolerance, work, statistics, |_| ())
    }

    #[inline]
    fn attempt_and_return<const KEEP: bool, W: Tolerance<S::State>, R: Return<S>>(
        &self,
        start: &Start<'_, S>,
        h: ScalarOf<S>,
        tolerance: &W,
        by: &R,
        work: &mut Work<S, P>,
        statistics: &mut Statistics,
    ) -> (Trial<S>, Option<Returned<S>>) {
        let mut returned = None;
        let trial = step_of::<KEEP, S, P, W>(start, h, tolerance, work, statistics, |state| {
            let mut end = S::State::from_array(*state);
            returned = by.state(start.system, start.time + h, &mut end).ok();
            if returned.is_some() {
                *state = end.to_array();
            }
        });
        (trial, returned)
    }

    #[inline]
    fn accept<const KEEP: bool>(&self, start: &Start<'_, S>, h: ScalarOf<S>, work: &mut Work<S, P>) {
        work.current = P::FIRST_SAME_AS_LAST;
        work.is_watched = false;
        if KEEP {
            work.step = (start.time, h);
        }
    }

    #[cold]
    fn blame(&self, start: &Start<'_, S>, h: ScalarOf<S>, work: &Work<S, P>) -> Option<((usize, f64), f64)> {
        let stages = stages_again::<S, P>(start, h);
        let found = P::blame::<ScalarOf<S>, _>(&stages);
        if P::FIRST_SAME_AS_LAST && !all_finite::<ScalarOf<S>, _>(&work.last) {
            return found
                .or_else(|| first_non_finite::<ScalarOf<S>>(work.last.as_ref()).map(|found| (found, 1.0)));
        }
        found
    }

    fn dense(&self, work: &Work<S, P>, start: &Start<'_, S>, arrival: &Arrival<S>) -> Self::Dense {
        let h = arrival.time - start.time;
        if work.step == (start.time, h) {
            dense_of::<S, P>(start, arrival, &work.stages)
        } else {
            let stages = stages_again::<S, P>(start, h);
            dense_of::<S, P>(start, arrival, &stages)
        }
    }

    fn interpolate(
        &self,
        dense: &Self::Dense,
        start: &Start<'_, S>,
        arrival: &Arrival<S>,
        time: ScalarOf<S>,
    ) -> S::State {
        interpolate(dense, start, arrival, time)
    }
}
