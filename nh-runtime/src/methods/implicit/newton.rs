//! What the iterations of implicit methods share: bounds, matrices, and what they say if they fail.

use crate::arrays::{Array, displaced, first_non_finite};
use crate::methods::fixed::OneStep;
use crate::methods::{Start, explain_non_finite, non_finite_derivative};
use crate::{Dim, Dynamics, IntegrationError, MatOf, Real, Scalar, ScalarOf, State, Statistics, VecOf};

/// The iterations after which a solution is given up.
pub(super) const MOST_ITERATIONS: u32 = 50;
/// The ratio of successive corrections from which a new Jacobian is formed.
pub(in crate::methods) const SLOW: f64 = 0.1;

/// The share of half a rounding unit that an iteration may leave.
const NEGLIGIBLE: f64 = 1.0 / 64.0;

/// Up to this multiple of the least number 1/h has no room.
const SHORT: f64 = 8.0;

/// Whether a step is so short that its first term is all of it: none, for the length zero.
pub(in crate::methods) fn is_first_term<T: Real>(h: T) -> bool {
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
    let mut state = S::State::from_array(displaced(&x, T::ONE, &increment));
    start.system.correct_positions(start.time + dt, &mut state);
    Ok(state)
}

/// How far rounding of a state reaches into each component of a correction: by the terms h |∂f/∂x| |x| of its rate, and what
/// these are divided by.
pub(super) fn reach<S: Dynamics>(jacobian: &MatOf<S>, x: &VecOf<S>, h: ScalarOf<S>) -> VecOf<S>
where
    ScalarOf<S>: Real,
{
    let mut reach = *x;
    for (i, (reach, row)) in reach.as_mut().iter_mut().zip(jacobian.as_ref()).enumerate() {
        let terms = row.as_ref().iter().zip(x.as_ref());
        let sum = terms.fold(ScalarOf::<S>::ZERO, |sum, (entry, x)| sum + (h * *entry * *x).abs());
        let own = row.as_ref().get(i).copied().unwrap_or(ScalarOf::<S>::ZERO);
        *reach = sum / Scalar::max(ScalarOf::<S>::ONE, (h * own).abs());
    }
    reach
}

/// The largest correction of a component, relative to its |x| + |increment|, or to what rounding reaches it by, or to the
/// least number that has all its digits; NaN if there is one. No two components are compared.
pub(in crate::methods) fn size<T: Real, V: AsRef<[T]>>(correction: &V, x: &V, increment: &V, reach: &V) -> T {
    let sizes = x.as_ref().iter().zip(increment.as_ref()).zip(reach.as_ref());
    let mut most = T::ZERO;
    for (c, ((x, d), reach)) in correction.as_ref().iter().zip(sizes) {
        let scale = Scalar::max(Scalar::max(x.abs() + d.abs(), *reach), T::MIN_POSITIVE);
        most = most.max(if *c == T::ZERO { T::ZERO } else { c.abs() / scale });
    }
    most
}

/// Whether a component of a correction is more than the same measures permit.
pub(in crate::methods) fn exceeds<T: Real, V: AsRef<[T]>>(
    row: usize,
    (correction, x, increment, reach): (&V, &V, &V, &V),
    tolerance: T,
) -> bool {
    let of = |list: &V| list.as_ref().get(row).map_or(T::ZERO, |entry| entry.abs());
    of(correction) > tolerance * Scalar::max(Scalar::max(of(x) + of(increment), of(reach)), T::MIN_POSITIVE)
}

/// The share of a correction that has to be within rounding, where corrections shrink by a ratio: what is missing after
/// this one is the rest of a geometric series, which may come to a hundredth of a rounding unit. The whole, where the
/// ratio is not known yet.
pub(super) fn still_missing<T: Real>(ratio: Option<T>) -> T {
    let missing = ratio.map_or(T::ONE, |ratio| T::from_f64(NEGLIGIBLE.recip()) * ratio / (T::ONE - ratio));
    if missing >= T::ZERO && missing < T::ONE { missing } else { T::ONE }
}

/// Which components of a correction have come down to round-off: what is still missing vanishes next to what they
/// correct, or the correction shrinks no longer, neither as a whole nor in that component. An iteration that ends before
/// all of them have leaves an error that has the same sign from step to step (Hairer, McLachlan, Razakarivony,
/// Achieving Brouwer's law with implicit Runge–Kutta methods, BIT 48 (2008)); a component alone may grow once for
/// another reason, when its correction has just passed through zero.
#[derive(Clone, Copy)]
pub(in crate::methods) struct Settling<D: Dim, T: Real> {
    before: Option<D::Vec<T>>,
    settled: D::Vec<bool>,
}

impl<D: Dim, T: Real> Settling<D, T> {
    /// Before the first correction.
    pub(in crate::methods) fn new() -> Self {
        Self { before: None, settled: D::vec(false) }
    }

    /// Whether all components of a correction that is small as a whole have settled, now or before.
    pub(in crate::methods) fn after(
        &mut self,
        correction: &D::Vec<T>,
        corrected: &D::Vec<T>,
        is_small: bool,
        ratio: Option<T>,
    ) -> bool {
        let half = T::from_f64(0.5);
        let (share, stagnates) = (still_missing(ratio), ratio.is_some_and(|ratio| ratio >= half));
        let half_unit = T::EPSILON * half;
        let sizes =
            correction.as_ref().iter().zip(corrected.as_ref()).map(|(c, x)| (c.abs(), half_unit * x.abs()));
        let Some(before) = &mut self.before else {
            self.before = Some(*correction);
            let mut sizes = sizes;
            return is_small && sizes.all(|(c, unit)| share * c <= unit);
        };
        let marks = self.settled.as_mut().iter_mut().zip(before.as_ref());
        let mut all = true;
        for ((settled, before), (c, unit)) in marks.zip(sizes) {
            *settled = is_small && (*settled || share * c <= unit || (stagnates && c >= before.abs() * half));
            all &= *settled;
        }
        *before = *correction;
        all
    }
}

/// The sizes of the components.
pub(in crate::methods) fn sizes<T: Real, V: Array<T>>(vector: &V) -> V {
    let mut sizes = *vector;
    sizes.as_mut().iter_mut().for_each(|size| *size = size.abs());
    sizes
}

/// Whether some correction is less than half of the least one so far, which is kept: where none is, round-off is left.
/// Each is compared with itself, since they have units of their own.
pub(in crate::methods) fn falls<T: Real>(least: &mut [T], now: &[T]) -> bool {
    let mut is_less = false;
    for (least, now) in least.iter_mut().zip(now) {
        is_less |= *now < T::from_f64(0.5) * *least;
        *least = least.min(*now);
    }
    is_less
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

/// The first derivative within a step that is not finite, with the share of the step at which it is: at finite ones among
/// the states that the stages had or, as these may be lost, on the way that the derivative at the start leads.
#[cold]
pub(super) fn blamed<S: Dynamics>(
    start: &Start<'_, S>,
    h: ScalarOf<S>,
    nodes: &[f64],
    state: impl Fn(usize) -> VecOf<S>,
) -> Option<((usize, f64), f64)> {
    let (x, slope) = (start.state.to_array(), start.derivative());
    let along = |node: f64| displaced(&x, ScalarOf::<S>::from_f64(node) * h, &slope);
    let had = nodes.iter().enumerate().map(|(stage, node)| (*node, state(stage)));
    had.chain(nodes.iter().map(|node| (*node, along(*node)))).find_map(|(node, state)| {
        if first_non_finite(state.as_ref()).is_some() {
            return None;
        }
        let there = start.derivative_at(start.time + ScalarOf::<S>::from_f64(node) * h, state);
        first_non_finite(there.as_ref()).map(|found| (found, node))
    })
}

/// Explains why the equations were not solved: by a derivative that is not finite at the start or, where a correction is
/// not, at one of the places with their times that it was found from.
#[cold]
pub(in crate::methods) fn refusal<S: Dynamics>(
    start: &Start<'_, S>,
    length: ScalarOf<S>,
    (iterations, residual): (u32, ScalarOf<S>),
    reached: &[ScalarOf<S>],
    from: impl IntoIterator<Item = (ScalarOf<S>, VecOf<S>)>,
) -> IntegrationError
where
    ScalarOf<S>: Real,
{
    let explained = explain_non_finite(start, length, reached);
    if matches!(explained, IntegrationError::NonFiniteDerivative { .. }) {
        return explained;
    }
    if !residual.is_finite() {
        let finite = from.into_iter().filter(|(_, x)| first_non_finite(x.as_ref()).is_none());
        let mut found = finite.map(|(t, x)| (t, first_non_finite(start.derivative_at(t, x).as_ref())));
        if let Some((t, found)) = found.find_map(|(t, found)| Some((t, found?))) {
            return non_finite_derivative::<S::State>(found, t.to_f64());
        }
    }
    IntegrationError::NoConvergence {
        time: start.time.to_f64(),
        step: length.to_f64(),
        iterations,
        residual: residual.to_f64(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::D;

    #[test]
    fn what_is_missing_is_the_rest_of_a_geometric_series() {
        assert!((still_missing(Some(1e-3_f64)) - 64.0 * 1e-3 / 0.999).abs() < 1e-15);
        for unknown in [None, Some(0.5), Some(1.0), Some(3.0), Some(f64::NAN), Some(f64::INFINITY)] {
            assert!((still_missing(unknown) - 1.0_f64).abs() < 1e-15, "{unknown:?}");
        }
        assert!(still_missing(Some(0.0_f64)) < f64::MIN_POSITIVE);
    }

    #[test]
    fn a_component_that_grows_alone_has_not_settled() {
        let corrected = [1.0, 1.0];
        let mut settling = Settling::<D<2>, f64>::new();
        assert!(!settling.after(&[1e-10, 1e-15], &corrected, true, None));
        // passed through zero, and is moved by the other
        assert!(!settling.after(&[1e-13, 1e-14], &corrected, true, Some(1e-3)));
        assert!(settling.after(&[1e-16, 1e-17], &corrected, true, Some(1e-3)));
        // rounding alone is left
        let mut settling = Settling::<D<2>, f64>::new();
        assert!(!settling.after(&[1e-14, 2e-14], &corrected, true, None));
        assert!(settling.after(&[1e-14, 1e-14], &corrected, true, Some(0.5)));
    }
}
