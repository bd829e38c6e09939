//! The length of the very first step.

use super::Start;
use crate::arrays::{difference, displaced};
use crate::projection::largest;
use crate::step_control::StepControl;
use crate::tolerance::{Tolerance, norm as norm_of};
use crate::{Dynamics, Real, Scalar, ScalarOf, State, Statistics, VecOf};

/// The share of its size by which an explicit Euler step changes the solution where it is probed, and the error in
/// units of the tolerance that is aimed at.
const SHARE: f64 = 0.01;
/// The share of what is known of the times that is tried where the equations say nothing: at rest, say.
const UNGUIDED: f64 = 1e-6;

/// The length of the very first step, in the manner of Hairer, Nørsett, Wanner I, section II.4, "Starting Step
/// Size", but by ratios alone.
///
/// Mathematics (30): with sizes in units of the tolerance, the solution d₀ (at least 1: less is negligible), its slope
/// d₁ and its second derivative d₂, estimated over an Euler step that changes the solution by 1 %, it varies over the
/// time T = min(d₀/d₁, √(d₀/d₂)), and an error d₀ (h/T)^q of 0.01 is aimed at.
#[cold]
pub(super) fn first_length<S: Dynamics>(
    (start, first): (&Start<'_, S>, &VecOf<S>),
    target: Option<ScalarOf<S>>,
    order: u32,
    (tolerance, control): (&impl Tolerance<S::State>, &StepControl<ScalarOf<S>>),
    statistics: &mut Statistics,
) -> ScalarOf<S>
where
    ScalarOf<S>: Real,
{
    let c = ScalarOf::<S>::from_f64;
    let one = ScalarOf::<S>::ONE;
    let x = start.state.to_array();
    let norm = |v: &VecOf<S>| {
        let norm = norm_of(tolerance, v, &x, &x);
        if norm.is_finite() {
            return norm;
        }
        // a component at zero tells of no scale if its tolerance is relative alone
        let mut judged = *v;
        for (v, x) in judged.as_mut().iter_mut().zip(x.as_ref()) {
            *v = if *x == ScalarOf::<S>::ZERO { *x } else { *v };
        }
        norm_of(tolerance, &judged, &x, &x)
    };
    let size = norm(&x).max(one);
    let slope = norm(first);
    let is_length = |h: ScalarOf<S>| h > ScalarOf::<S>::ZERO && h.is_finite();
    let by_slope = size / slope;
    let is_guided = is_length(c(SHARE) * by_slope);
    let distance = target.map(|target| target - start.time);
    let mut h = if is_guided {
        c(SHARE) * by_slope
    } else {
        // the unit of time itself is the last resort
        let largest_by_slope = largest(x.as_ref()) / largest(first.as_ref());
        let known =
            [distance.map(Scalar::abs), control.max_step, Some(start.time.abs()), Some(largest_by_slope)];
        let known = known.into_iter().flatten().find(|h| is_length(c(UNGUIDED) * *h));
        c(UNGUIDED) * known.unwrap_or(one)
    };
    if let Some(distance) = distance {
        h = h.min(distance.abs());
    }
    h = control.limited(h);
    let ahead = distance.map_or(h, |distance| distance.sign() * h);
    statistics.evaluations += 1;
    let slope_ahead = start.derivative_at(start.time + ahead, displaced(&x, ahead, first));
    // h² d₂; at rest, what acts soon
    let bend = h * norm(&difference(&slope_ahead, first));
    let by_bend = h * (size / bend).sqrt();
    let scale = if is_guided { by_slope.min(by_bend) } else { by_bend.min(h / c(SHARE)) };
    let refined = scale * ((c(SHARE) / size).ln() / ScalarOf::<S>::from_u32(order)).exp();
    // a derivative ahead that is not finite says nothing, nor does a tolerance of zero
    control.limited(if is_length(refined) { refined } else { h })
}
