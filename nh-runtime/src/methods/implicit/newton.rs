//! What the iterations of implicit methods share: bounds, matrices, and what they say if they fail.

use crate::arrays::displaced;
use crate::methods::fixed::OneStep;
use crate::methods::{Start, explain_non_finite};
use crate::{Dim, Dynamics, IntegrationError, Real, Scalar, ScalarOf, State, Statistics};

/// The iterations after which a solution is given up.
pub(super) const MOST_ITERATIONS: u32 = 50;
/// The ratio of successive corrections from which a new Jacobian is formed.
pub(in crate::methods) const SLOW: f64 = 0.1;

/// Up to this multiple of the least number 1/h has no room.
const SHORT: f64 = 8.0;

/// Whether a step is so short that its first term is all of it: none, for the length zero.
pub(super) fn is_first_term<T: Real>(h: T) -> bool {
    h.abs() <= T::from_f64(SHORT) * T::MIN_POSITIVE
}

/// Checks the tolerance of an iteration.
pub(in crate::methods) fn check_tolerance<T: Real>(tolerance: T) -> Result<(), IntegrationError> {
    if tolerance > T::ZERO && tolerance.is_finite() {
        return Ok(());
    }
    Err(IntegrationError::Setting {
        setting: "tolerance",
        value: tolerance.to_f64(),
        expected: "positive and finite",
    })
}

/// Checks the length of a single step.
pub(in crate::methods) fn check_length<T: Real>(dt: T) -> Result<(), IntegrationError> {
    if dt.is_finite() {
        return Ok(());
    }
    Err(IntegrationError::Setting { setting: "dt", value: dt.to_f64(), expected: "finite" })
}

/// One step that nothing is remembered of.
pub(in crate::methods) fn once<T: Real, S: Dynamics, P: OneStep<S>>(
    scheme: &P,
    start: &Start<'_, S>,
    dt: T,
) -> Result<S::State, IntegrationError>
where
    S::State: State<Scalar = T>,
{
    check_length(dt)?;
    let x = start.state.to_array();
    let increment = scheme.increment(start, &x, dt, &mut scheme.work(), &mut Statistics::default())?;
    Ok(S::State::from_array(displaced(&x, T::ONE, &increment)))
}

/// The largest correction, relative to the largest |x| + |increment|; NaN if there is one.
pub(super) fn size<T: Real, V: AsRef<[T]>>(correction: &V, x: &V, increment: &V) -> T {
    let sizes = x.as_ref().iter().zip(increment.as_ref()).map(|(x, d)| x.abs() + d.abs());
    let scale = sizes.fold(T::ZERO, T::max);
    let largest = correction.as_ref().iter().fold(T::ZERO, |largest, c| largest.max(c.abs()));
    if largest == T::ZERO { largest } else { largest / scale }
}

/// 1 − h A.
pub(in crate::methods) fn one_less<D: Dim, T: Scalar>(h: T, a: D::Mat<T>) -> D::Mat<T> {
    let mut matrix = a;
    for (i, row) in matrix.as_mut().iter_mut().enumerate() {
        for (j, entry) in row.as_mut().iter_mut().enumerate() {
            let moved = h * *entry;
            *entry = if i == j { T::ONE - moved } else { -moved };
        }
    }
    matrix
}

/// Explains why the equations were not solved.
#[cold]
pub(in crate::methods) fn refusal<S: Dynamics>(
    start: &Start<'_, S>,
    length: ScalarOf<S>,
    iterations: u32,
    residual: ScalarOf<S>,
    reached: &[ScalarOf<S>],
) -> IntegrationError
where
    ScalarOf<S>: Real,
{
    let explained = explain_non_finite(start, length, reached);
    if matches!(explained, IntegrationError::NonFiniteDerivative { .. }) {
        return explained;
    }
    IntegrationError::NoConvergence {
        time: start.time.to_f64(),
        step: length.to_f64(),
        iterations,
        residual: residual.to_f64(),
    }
}
