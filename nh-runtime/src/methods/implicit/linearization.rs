//! Where an implicit method takes ∂f/∂x from.

use crate::arrays::all_finite;
use crate::methods::Start;
use crate::{Dim, DimOf, Dynamics, Jacobian, MatOf, Real, Scalar, ScalarOf, State, Statistics, VecOf};

/// How a method finds the Jacobian ∂f/∂x of its system: [`FiniteDifferences`] or [`Analytic`].
pub trait Linearization<S: Dynamics>: Copy {
    /// ∂f/∂x at a time and a point, where f is `slope`; in row i, the derivatives of component i.
    fn state_jacobian(
        &self,
        start: &Start<'_, S>,
        time: ScalarOf<S>,
        point: &VecOf<S>,
        slope: &VecOf<S>,
        statistics: &mut Statistics,
    ) -> MatOf<S>;
}

/// The Jacobian by difference quotients: one evaluation of the derivative for each component.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FiniteDifferences;

/// The system's own Jacobian.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Analytic;

impl<S: Jacobian> Linearization<S> for Analytic {
    #[inline]
    fn state_jacobian(
        &self,
        start: &Start<'_, S>,
        time: ScalarOf<S>,
        point: &VecOf<S>,
        _slope: &VecOf<S>,
        _statistics: &mut Statistics,
    ) -> MatOf<S> {
        start.system.state_jacobian(time, &S::State::from_array(*point), start.input)
    }
}

impl<S: Dynamics> Linearization<S> for FiniteDifferences
where
    ScalarOf<S>: Real,
{
    fn state_jacobian(
        &self,
        start: &Start<'_, S>,
        time: ScalarOf<S>,
        point: &VecOf<S>,
        slope: &VecOf<S>,
        statistics: &mut Statistics,
    ) -> MatOf<S> {
        let mut matrix: MatOf<S> = DimOf::<S>::mat(ScalarOf::<S>::ZERO);
        for j in 0..DimOf::<S>::N {
            let Some(&x) = point.as_ref().get(j) else { break };
            // the increment of the code RADAU5 (Hairer, Wanner II, section IV.8)
            let least = ScalarOf::<S>::from_f64(1e-5);
            let delta = (ScalarOf::<S>::EPSILON * x.abs().max(least)).sqrt();
            let mut column = quotient(start, time, point, slope, j, delta);
            if !all_finite::<ScalarOf<S>, _>(&column) {
                column = quotient(start, time, point, slope, j, -delta);
                statistics.evaluations += 1;
            }
            for (row, q) in matrix.as_mut().iter_mut().zip(column.as_ref()) {
                if let Some(entry) = row.as_mut().get_mut(j) {
                    *entry = *q;
                }
            }
            statistics.evaluations += 1;
        }
        matrix
    }
}

/// The difference quotient of f in direction `j`.
fn quotient<S: Dynamics>(
    start: &Start<'_, S>,
    time: ScalarOf<S>,
    point: &VecOf<S>,
    slope: &VecOf<S>,
    j: usize,
    delta: ScalarOf<S>,
) -> VecOf<S>
where
    ScalarOf<S>: Real,
{
    let mut moved = *point;
    let mut really = delta;
    if let Some(x) = moved.as_mut().get_mut(j) {
        let before = *x;
        *x += delta;
        // the distance that rounding has left
        really = *x - before;
    }
    let mut ahead = start.derivative_at(time, moved);
    for (a, f) in ahead.as_mut().iter_mut().zip(slope.as_ref()) {
        *a = (*a - *f) / really;
    }
    ahead
}
