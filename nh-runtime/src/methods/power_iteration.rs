//! The largest eigenvalue of a Jacobian, by two steps of power iteration.

use super::Start;
use crate::arrays::{Array, difference};
use crate::tolerance::{Tolerance, norm};
use crate::{Dynamics, Real, Scalar, ScalarOf, State, Statistics, VecOf};

/// So many steps make an estimate: the root of their product is for two.
const IN_A_ROW: u32 = 2;

/// An estimate of the size of the largest eigenvalue at a point, by difference quotients along a direction in units of the
/// tolerance, which is then the one in which the derivative changes most.
///
/// What swings turns its direction by a right angle, which changes the lengths of both by the units of components alone: two
/// steps lead back to it, and in their mean the units are gone.
pub(super) fn largest_rate<S: Dynamics>(
    here: &Start<'_, S>,
    tolerance: &impl Tolerance<S::State>,
    direction: &mut VecOf<S>,
    statistics: &mut Statistics,
) -> ScalarOf<S>
where
    ScalarOf<S>: Real,
{
    let x = here.state.to_array();
    let permitted = tolerance.permitted(&x);
    let slope = here.derivative();
    let size = |e: &VecOf<S>| norm(tolerance, e, &x, &x);
    statistics.evaluations += 1 + u64::from(IN_A_ROW);
    let mut rate = ScalarOf::<S>::ONE;
    for _ in 0..IN_A_ROW {
        let mut beside = x;
        let apart = permitted.as_ref().iter().zip(direction.as_ref());
        for (beside, (&permitted, &direction)) in beside.as_mut().iter_mut().zip(apart) {
            if is_unit(permitted) {
                *beside = direction.mul_add(permitted, *beside);
            }
        }
        let change = difference(&here.derivative_at(here.time, beside), &slope);
        rate *= (size(&change) / size(&difference(&beside, &x))).sqrt();
        *direction = of_length_one(&change, &permitted);
    }
    rate
}

/// Whether a permitted error is a unit: nothing is none, nor is infinity, where a component is not looked at.
fn is_unit<T: Real>(permitted: T) -> bool {
    permitted > T::ZERO && permitted.is_finite()
}

/// A change of the derivative as a direction: in units of the tolerance, its largest component 1, and 0 where that gives
/// none. Where there is no change, all components alike.
pub(super) fn of_length_one<T: Real, V: Array<T>>(change: &V, permitted: &V) -> V {
    let mut direction = *change;
    for (direction, &permitted) in direction.as_mut().iter_mut().zip(permitted.as_ref()) {
        *direction = if is_unit(permitted) { *direction / permitted } else { T::ZERO };
    }
    let largest = direction.as_ref().iter().fold(T::ZERO, |largest, x| largest.max(x.abs()));
    for direction in direction.as_mut() {
        *direction = if largest > T::ZERO && largest.is_finite() { *direction / largest } else { T::ONE };
    }
    direction
}
