//! What the adaptive methods share: the first step, acceptance and rejection, the landing on a
//! target, and the derivative that one step hands to the next.

use super::{Arrival, Start, component, non_finite_derivative};
use crate::arrays::{all_finite, difference, displaced, first_non_finite};
use crate::step_control::StepControl;
use crate::{DimOf, Dynamics, IntegrationError, Real, Scalar, ScalarOf, State, Statistics, VecOf};

/// An explicit method with an error estimate.
pub(super) trait Embedded<S: Dynamics> {
    /// One more than the order of the error estimate.
    const ORDER: u32;
    /// What a trial has computed besides its end.
    type Stages;
    /// What the dense output needs besides the derivatives at both ends.
    type Bulge: Copy;

    /// Computes a step of length `length` with the derivative `first` at its start.
    fn attempt(
        &self,
        start: &Start<'_, S>,
        first: &VecOf<S>,
        length: ScalarOf<S>,
        control: &StepControl<ScalarOf<S>>,
        statistics: &mut Statistics,
    ) -> Attempt<S, Self::Stages>;

    /// After acceptance: the derivative at the end of the step, and the dense output.
    fn conclude(
        &self,
        start: &Start<'_, S>,
        first: &VecOf<S>,
        length: ScalarOf<S>,
        attempt: &Attempt<S, Self::Stages>,
    ) -> (VecOf<S>, Self::Bulge);

    /// A derivative that is not finite among the stages: component, value, and the time of the
    /// stage as a fraction of the step.
    fn blame(&self, stages: &Self::Stages) -> Option<((usize, f64), f64)>;
}

/// A step that may be accepted.
pub(super) struct Attempt<S: Dynamics, Stages> {
    /// Its end.
    pub(super) state: VecOf<S>,
    /// The norm of its error in units of the tolerance; not finite if a stage is not.
    pub(super) error: ScalarOf<S>,
    /// The rest.
    pub(super) stages: Stages,
}

/// What an adaptive method remembers.
pub struct Memory<S: Dynamics, Bulge> {
    /// The length proposed for the next step.
    proposed: Option<ScalarOf<S>>,
    /// The logarithm of the error of the last step.
    log_error: ScalarOf<S>,
    /// The derivatives at both ends of the last step.
    pub(super) ends: (VecOf<S>, VecOf<S>),
    /// The rest of its dense output.
    pub(super) bulge: Option<Bulge>,
    /// Whether the second of `ends` is the derivative at the current state and input.
    current: bool,
}

impl<S: Dynamics, Bulge: Copy> Clone for Memory<S, Bulge> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<S: Dynamics, Bulge: Copy> Copy for Memory<S, Bulge> {}

impl<S: Dynamics, Bulge> Memory<S, Bulge>
where
    ScalarOf<S>: Real,
{
    pub(super) fn new() -> Self {
        use crate::Dim;
        let zero = DimOf::<S>::vec(ScalarOf::<S>::ZERO);
        Self {
            proposed: None,
            log_error: StepControl::first_log_error(),
            ends: (zero, zero),
            bulge: None,
            current: false,
        }
    }

    pub(super) fn forget(&mut self) {
        self.current = false;
        self.log_error = StepControl::first_log_error();
    }
}

/// Takes one step with error control.
#[inline]
pub(super) fn advance<S: Dynamics, M: Embedded<S>>(
    method: &M,
    control: &StepControl<ScalarOf<S>>,
    start: &Start<'_, S>,
    target: Option<ScalarOf<S>>,
    memory: &mut Memory<S, M::Bulge>,
    statistics: &mut Statistics,
) -> Result<Arrival<S>, IntegrationError>
where
    ScalarOf<S>: Real,
{
    let first = if memory.current {
        memory.ends.1
    } else {
        statistics.evaluations += 1;
        let first = start.derivative();
        if let Some(found) = first_non_finite(first.as_ref()) {
            return Err(non_finite_derivative::<S::State>(found, start.time.to_f64()));
        }
        first
    };
    let shortest = StepControl::shortest(start.time);
    let proposed = match memory.proposed.or(control.first_step) {
        Some(h) => control.limited(h),
        None => first_step(start, &first, control, target, M::ORDER, statistics),
    }
    .max(shortest);
    let mut h = proposed;
    let mut rejected = false;
    loop {
        let leg = Leg::new(start.time, h, target);
        if !leg.time.is_finite() {
            return Err(IntegrationError::NonFiniteTime { time: leg.time.to_f64() });
        }
        let attempt = method.attempt(start, &first, leg.length, control, statistics);
        let length = leg.length.abs();
        if attempt.error <= ScalarOf::<S>::ONE && all_finite::<ScalarOf<S>, _>(&attempt.state) {
            let (last, bulge) = method.conclude(start, &first, leg.length, &attempt);
            let (next, log_error) = control.after_success(length, attempt.error, memory.log_error, M::ORDER);
            // no growth right after a rejection; no loss from a step that a target cut short
            let next = if rejected { next.min(length) } else { next };
            let next = if leg.cut && !rejected { next.max(proposed) } else { next };
            *memory = Memory {
                proposed: Some(next),
                log_error,
                ends: (first, last),
                bulge: Some(bulge),
                current: true,
            };
            return Ok(Arrival { time: leg.time, state: S::State::from_array(attempt.state) });
        }
        statistics.rejected += 1;
        if h <= shortest {
            return Err(refusal(method, start, leg.length, &attempt));
        }
        rejected = true;
        h = StepControl::after_rejection(length, attempt.error, M::ORDER).max(shortest);
    }
}

/// Explains why not even the shortest step is acceptable.
#[cold]
fn refusal<S: Dynamics, M: Embedded<S>>(
    method: &M,
    start: &Start<'_, S>,
    length: ScalarOf<S>,
    attempt: &Attempt<S, M::Stages>,
) -> IntegrationError
where
    ScalarOf<S>: Real,
{
    let (time, step) = (start.time.to_f64(), length.to_f64());
    if let Some((found, fraction)) = method.blame(&attempt.stages) {
        return non_finite_derivative::<S::State>(found, time + fraction * step);
    }
    if let Some((index, _)) = first_non_finite(attempt.state.as_ref()) {
        let component = component::<S::State>(index);
        return IntegrationError::NonFiniteStep { component, time, step };
    }
    IntegrationError::StepUnderflow { time, step, error: attempt.error.to_f64() }
}

/// A step on the way to the target.
struct Leg<T> {
    /// Its length, with the sign of its direction.
    length: T,
    /// The time at its end.
    time: T,
    /// Whether the target has shortened it.
    cut: bool,
}

impl<T: Real> Leg<T> {
    /// The step of length h: stretched by up to 1 % or cut to land on the target, and halved where
    /// otherwise a sliver would be left.
    #[inline]
    fn new(now: T, h: T, target: Option<T>) -> Self {
        let mut length = h;
        let mut cut = false;
        if let Some(target) = target {
            let remaining = (target - now).abs();
            if h * T::from_f64(1.01) >= remaining {
                return Self { length: target - now, time: target, cut: remaining < h };
            }
            if h * T::from_f64(2.0) > remaining {
                length = remaining * T::from_f64(0.5);
                cut = true;
            }
            if target < now {
                length = -length;
            }
        }
        let time = now + length;
        // the length that the time has really moved by
        Self { length: time - now, time, cut }
    }
}

/// The length of the very first step (Hairer, Nørsett, Wanner I, section II.4, "Starting Step
/// Size"): it lets an explicit Euler step change the solution by about 1 %, and then the estimated
/// second derivative too.
fn first_step<S: Dynamics>(
    start: &Start<'_, S>,
    first: &VecOf<S>,
    control: &StepControl<ScalarOf<S>>,
    target: Option<ScalarOf<S>>,
    order: u32,
    statistics: &mut Statistics,
) -> ScalarOf<S>
where
    ScalarOf<S>: Real,
{
    let c = ScalarOf::<S>::from_f64;
    let x = start.state.to_array();
    let size = control.norm(&x, &x, &x);
    let slope = control.norm(first, &x, &x);
    let negligible = c(1e-5);
    let mut h = if size < negligible || slope < negligible { c(1e-6) } else { c(0.01) * size / slope };
    let mut direction = ScalarOf::<S>::ONE;
    if let Some(target) = target {
        h = h.min((target - start.time).abs());
        direction = (target - start.time).sign();
    }
    h = control.limited(h);
    statistics.evaluations += 1;
    let ahead = displaced(&x, direction * h, first);
    let slope_ahead = start.derivative_at(start.time + direction * h, ahead);
    let curvature = control.norm(&difference(&slope_ahead, first), &x, &x) / h;
    let largest = slope.max(curvature);
    let refined = if largest <= c(1e-15) {
        c(1e-6).max(h * c(1e-3))
    } else {
        ((c(0.01) / largest).ln() / ScalarOf::<S>::from_u32(order)).exp()
    };
    // a derivative ahead that is not finite says nothing
    let refined = if refined.is_finite() { refined } else { h };
    control.limited(refined.min(h * c(100.0)))
}
