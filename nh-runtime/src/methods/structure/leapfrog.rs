//! The nonholonomic leapfrog method on TQ.

use crate::arrays::{difference, displaced};
use crate::methods::{Arrival, Fixed, OneStep, Start};
use crate::{IntegrationError, Leapfrog, Real, Scalar, ScalarOf, State, Statistics, VecOf};

/// The method of McLachlan and Perlmutter with fixed steps, of order 2, explicit but for the linear
/// equations of the constraints: q½ = q₀ + h/2 v₀, a kick with the forces at q½ that reflects what the
/// constraints forbid, A(q½)(v₁ + v₀) = 0, q₁ = q½ + h/2 v₁ (McLachlan, Perlmutter, Integrators for
/// nonholonomic mechanical systems, J. Nonlinear Sci. 16 (2006)).
///
/// Symmetric and reversible; without potential it keeps the energy. The velocities satisfy the
/// constraints up to the square of the step. What they miss is reflected at every kick, so that the step is not
/// near the identity off the constraints, and compositions have order 2 as well: there are none. Between steps of one
/// length it cancels; where the length changes, as where a step lands on a target, the velocities are brought to the
/// constraints first. For systems declared with `emit { leapfrog }`.
pub type ReflectedLeapfrog<T> = Fixed<DriftKickDrift, T>;

/// A step of [`ReflectedLeapfrog`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DriftKickDrift;

impl<T: Real> ReflectedLeapfrog<T> {
    /// The method with steps of length `step`, which has to be positive and finite.
    #[must_use]
    pub fn new(step: T) -> Self {
        Self { step, scheme: DriftKickDrift }
    }
}

/// (q + h v, v): the first half of the components are coordinates, the second their velocities.
fn drifted<T: Scalar, V: Copy + AsRef<[T]> + AsMut<[T]>>(x: &V, h: T) -> V {
    let mut moved = *x;
    let (places, velocities) = moved.as_mut().split_at_mut(x.as_ref().len() / 2);
    for (place, velocity) in places.iter_mut().zip(velocities) {
        *place = velocity.mul_add(h, *place);
    }
    moved
}

impl<T: Real, S: Leapfrog> OneStep<S> for DriftKickDrift
where
    S::State: State<Scalar = T>,
{
    /// The length of the last step, without its sign.
    type Work = Option<T>;
    dense_by_cubic!();

    fn work(&self) -> Option<T> {
        None
    }

    /// What velocities miss after a step of another length stays to be taken away, whatever the input is.
    fn forget(&self, _work: &mut Option<T>) {}

    fn increment(
        &self,
        start: &Start<'_, S>,
        x: &VecOf<S>,
        h: T,
        work: &mut Option<T>,
        statistics: &mut Statistics,
    ) -> Result<VecOf<S>, IntegrationError> {
        let half = h * T::from_f64(0.5);
        // but for the rounding of times
        let other = |last: T| (last - h.abs()).abs() > T::EPSILON.sqrt() * h.abs();
        let is_of_another_length = work.is_some_and(other);
        let from = if is_of_another_length {
            statistics.evaluations += 1;
            onto_constraints(start.system, x)
        } else {
            *x
        };
        let middle = S::State::from_array(drifted(&from, half));
        let kicked = start.system.kick(&middle, h).to_array();
        statistics.evaluations += 1;
        let end = drifted(&kicked, half);
        *work = Some(h.abs());
        Ok(difference(&end, x))
    }
}

/// The mean of velocities and of what a kick without forces reflects them to: they satisfy the constraints.
fn onto_constraints<S: Leapfrog>(system: &S, x: &VecOf<S>) -> VecOf<S> {
    let reflected = system.kick(&S::State::from_array(*x), ScalarOf::<S>::ZERO).to_array();
    let half = ScalarOf::<S>::from_f64(0.5);
    displaced(x, half, &difference(&reflected, x))
}
