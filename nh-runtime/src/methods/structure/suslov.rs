//! Discrete Euler–Poincaré–Suslov equations.

use crate::arrays::{all_finite, displaced, first_non_finite};
use crate::linear::Factors;
use crate::methods::implicit::newton::Settling;
use crate::methods::{Arrival, Fixed, OneStep, Start, Symmetric, explain_non_finite};
use crate::projection::largest;
use crate::{Dim, DimOf, EulerPoincareSuslov, IntegrationError, Real, ScalarOf, State, Statistics, VecOf};

/// The discrete Euler–Poincaré–Suslov equations with fixed steps, of order 2: P(h, v₁) = P(−h, v₀) with
/// the discrete momentum P of the constrained velocities on a Lie algebra (Fedorov, Zenkov, Discrete
/// nonholonomic LL systems on Lie groups, Nonlinearity 18 (2005)).
///
/// Symmetric; the velocities stay in the constraint distribution. For systems declared without a base
/// and with `emit { euler_poincare_suslov }`. Newton's iteration runs until it stagnates.
/// [`Statistics::evaluations`] counts those of P.
pub type DiscreteSuslov<T> = Fixed<DiscreteMomentum<T>, T>;

/// A step of [`DiscreteSuslov`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DiscreteMomentum<T> {
    tolerance: T,
}

impl<T> Symmetric for DiscreteMomentum<T> {}

impl<T: Real> DiscreteSuslov<T> {
    /// The method with steps of length `step`, which has to be positive and finite.
    #[must_use]
    pub fn new(step: T) -> Self {
        Self { step, scheme: DiscreteMomentum { tolerance: T::from_f64(1e3) * T::EPSILON } }
    }
}

/// The iterations after which a solution is given up.
const MOST_ITERATIONS: u32 = 40;

impl<T: Real, S: EulerPoincareSuslov> OneStep<S> for DiscreteMomentum<T>
where
    S::State: State<Scalar = T>,
{
    type Work = ();
    dense_by_cubic!();

    fn work(&self) {}

    fn forget(&self, (): &mut ()) {}

    fn increment(
        &self,
        start: &Start<'_, S>,
        x: &VecOf<S>,
        h: T,
        (): &mut (),
        statistics: &mut Statistics,
    ) -> Result<VecOf<S>, IntegrationError> {
        let momentum = |v: &VecOf<S>, h: T| start.system.discrete_momentum(&S::State::from_array(*v), h);
        let wanted = momentum(x, -h);
        statistics.evaluations += 1;
        let mut change: VecOf<S> = DimOf::<S>::vec(T::ZERO);
        let (mut best, mut before) = (T::EPSILON.recip(), None);
        let mut settling = Settling::<DimOf<S>, T>::new();
        for _ in 0..MOST_ITERATIONS {
            let v = displaced(x, T::ONE, &change);
            let here = momentum(&v, h);
            statistics.evaluations += 1;
            statistics.jacobians += 1;
            statistics.factorizations += 1;
            statistics.iterations += 1;
            // ∂P/∂v by central difference quotients: a P of second degree has no error in them, however large δ is
            // beside velocities of other units. P changes with h v, if there is no other measure
            let measure = largest(v.as_ref());
            let delta = T::EPSILON.sqrt() * if measure > T::ZERO { measure } else { h.abs().recip() };
            let mut matrix = DimOf::<S>::mat(T::ZERO);
            for j in 0..DimOf::<S>::N {
                let [mut before, mut after] = [v; 2];
                let ends = before.as_mut().get_mut(j).zip(after.as_mut().get_mut(j));
                let Some((lower, upper)) = ends else { break };
                *lower -= delta;
                *upper += delta;
                let between = *upper - *lower;
                let [before, after] = [momentum(&before, h), momentum(&after, h)];
                statistics.evaluations += 2;
                for (row, (a, b)) in
                    matrix.as_mut().iter_mut().zip(after.as_ref().iter().zip(before.as_ref()))
                {
                    if let Some(entry) = row.as_mut().get_mut(j) {
                        *entry = (*a - *b) / between;
                    }
                }
            }
            // a derivative that is not finite would make corrections vanish
            if !matrix.as_ref().iter().all(all_finite::<T, _>) {
                best = T::from_f64(f64::NAN);
                break;
            }
            let defect = displaced(&wanted, -T::ONE, &here);
            let correction = Factors::<DimOf<S>, T>::new(&matrix).solve(&defect);
            change = displaced(&change, T::ONE, &correction);
            let moved = largest(correction.as_ref());
            let size = if moved == T::ZERO { moved } else { moved / measure.max(largest(change.as_ref())) };
            let ratio = before.map(|before| size / before);
            let corrected = displaced(x, T::ONE, &change);
            if size == T::ZERO || settling.after(&correction, &corrected, size <= self.tolerance, ratio) {
                return Ok(change);
            }
            if !size.is_finite() {
                break;
            }
            (best, before) = (best.min(size), Some(size));
        }
        let reached = displaced(x, T::ONE, &change);
        if first_non_finite(reached.as_ref()).is_some() {
            return Err(explain_non_finite(start, h, reached.as_ref()));
        }
        Err(IntegrationError::NoConvergence {
            time: start.time.to_f64(),
            step: h.to_f64(),
            iterations: MOST_ITERATIONS,
            residual: (best / self.tolerance).to_f64(),
        })
    }
}
