//! Linear-quadratic regulation: the discrete-time Riccati equation.

#[cfg(test)]
mod cheap_inputs;

use nalgebra::{SMatrix, SVector};

use super::cholesky::{Cholesky, semidefinite, semidefinite_beside};
use super::{ControlError, Entry, finite, norm, symmetrized};
use crate::linear::Factors;
use crate::{D, Scalar};

/// A doubling covers twice the horizon of the one before. Beyond this horizon, in ticks, nothing decays: an
/// eigenvalue 1 that belongs to two modes is known to the root of the rounding error.
fn longest_horizon<T: Entry>() -> T {
    (T::from_f64(16.0) / T::EPSILON.sqrt()).max(T::from_f64(131_072.0))
}

/// A linear state feedback u = −K e with the cost eᵀ P e that it leaves.
///
/// For e' = a e + b u and the cost Σ eᵀ q e + uᵀ r u, with q symmetric and positive semidefinite and
/// r symmetric and positive definite.
#[doc(alias("LQR", "DARE", "Riccati"))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Regulator<T, const N: usize, const M: usize> {
    /// K.
    pub gain: SMatrix<T, M, N>,
    /// P.
    pub cost: SMatrix<T, N, N>,
}

impl<T: Entry, const N: usize, const M: usize> Regulator<T, N, M> {
    /// The regulator of an unending horizon:
    /// P = q + aᵀP a − aᵀP b (r + bᵀP b)⁻¹ bᵀP a, K = (r + bᵀP b)⁻¹ bᵀP a.
    ///
    /// By the structure-preserving doubling algorithm (Chu, Fan, Lin, Wang, Int. J. Control 77
    /// (2004) 767–788), which converges quadratically where the pair (a, b) is stabilizable and
    /// (a, q) is detectable, and at worst linearly where modes on the unit circle are undetectable.
    ///
    /// A mode that neither decays nor answers to the input has no regulator if it costs anything; in `f64` it is
    /// refused if it decays slower than in some 10⁷ ticks. In `f32` rounding makes such a mode decay, or grow, within
    /// some thousand ticks, which cannot always be told from a slow one: gains are better computed in `f64`.
    ///
    /// What costs nothing is left alone: a place that is not weighed may drift. It is refused where it grows so that
    /// it leaves the range of the scalar within that time.
    ///
    /// Both are said of modes that rounding leaves alone, as coordinates do that are such modes. In coordinates that mix
    /// them with others it makes what neither decays nor grows do either, or cost something: some of those that are to be
    /// refused are accepted there, and of places that may drift many are refused.
    ///
    /// ```
    /// use nalgebra::matrix;
    /// use nonholonomic::control::Regulator;
    ///
    /// // x' = x + u: the golden section
    /// let one = matrix![1.0];
    /// let regulator = Regulator::stationary(&one, &one, &one, &one).unwrap();
    /// assert!((regulator.cost[0] - (1.0 + 5.0_f64.sqrt()) / 2.0).abs() < 1e-15);
    /// ```
    ///
    /// # Errors
    /// [`ControlError::NotFinite`], [`ControlError::NotDefinite`] for `q` and `r`, which stand for their symmetric
    /// parts, and [`ControlError::NotStabilizable`] or [`ControlError::Residual`] if there is no such regulator to
    /// the precision of the scalar.
    pub fn stationary(
        a: &SMatrix<T, N, N>,
        b: &SMatrix<T, N, M>,
        q: &SMatrix<T, N, N>,
        r: &SMatrix<T, M, M>,
    ) -> Result<Self, ControlError> {
        finite("a", a)?;
        finite("b", b)?;
        finite("q", q)?;
        finite("r", r)?;
        semidefinite("q", q)?;
        Self::doubled(a, b, q, r)
    }

    /// The regulator of weights that have been checked.
    fn doubled(
        a: &SMatrix<T, N, N>,
        b: &SMatrix<T, N, M>,
        q: &SMatrix<T, N, N>,
        r: &SMatrix<T, M, M>,
    ) -> Result<Self, ControlError> {
        let one = SMatrix::<T, N, N>::identity();
        let mut transition = *a;
        let mut reach = symmetrized(&(b * Cholesky::new("r", &symmetrized(r))?.solve(&b.transpose())));
        let mut cost = symmetrized(q);
        let settled = T::from_f64(8.0) * T::EPSILON;
        let mut change = T::ONE;
        // the cost to which least was added
        let mut calmest = (T::ONE, cost);
        let mut iterations = 0;
        let (mut horizon, longest) = (T::ONE, longest_horizon::<T>());
        while horizon < longest && change.is_finite() {
            horizon += horizon;
            let inverse = inverse(&(one + reach * cost));
            let through = transition * inverse;
            let more = symmetrized(&(transition.transpose() * cost * inverse * transition));
            reach += symmetrized(&(through * reach * transition.transpose()));
            transition = through * transition;
            cost += more;
            iterations += 1;
            change = most_added(&more, &cost);
            if change <= settled {
                return Self::checked(a, b, q, r, &cost);
            }
            if change < calmest.0 {
                calmest = (change, cost);
            }
        }
        // at once, rather than by growing: beyond the range of the scalar, or 1 + reach · cost had no inverse in its digits
        let has_ended_at_once = iterations == 1;
        let has_no_inverse = has_ended_at_once && cost.iter().any(|entry| entry.to_f64().is_nan());
        if has_ended_at_once && !has_no_inverse {
            finite("the cost of the regulator", &cost)?;
        }
        // rounding of what cheap inputs reach hides that what they do not reach decays, if slowly: with the gain it shows
        if let Ok(regulator) = Self::checked(a, b, q, r, &calmest.1)
            && regulator.followed(a, b, q, r).is_some()
        {
            return Ok(regulator);
        }
        if has_no_inverse {
            return Err(ControlError::Residual { residual: f64::INFINITY });
        }
        Err(ControlError::NotStabilizable { iterations, change: change.to_f64() })
    }

    /// The same for a cost Σ eᵀ q e + 2 eᵀ cross u + uᵀ r u, such as that of outputs which the input acts on at
    /// once, or an integral over a tick in continuous time.
    ///
    /// With v = u + r⁻¹crossᵀ e it is that of [`stationary`](Self::stationary) for a − b r⁻¹crossᵀ and the weight
    /// q − cross r⁻¹crossᵀ (Anderson, Moore, Optimal Control, 1990, 3.4).
    ///
    /// ```
    /// use nalgebra::matrix;
    /// use nonholonomic::control::Regulator;
    ///
    /// // the cost (x + u)² + u²/2 of x' = x + u
    /// let one = matrix![1.0_f64];
    /// let regulator = Regulator::stationary_with_cross(&one, &one, &one, &matrix![1.5], &one).unwrap();
    /// let (p, k) = (regulator.cost[0], regulator.gain[0]);
    /// assert!((k - (1.0 + p) / (1.5 + p)).abs() < 1e-15);
    /// assert!((p - (1.0 + p - k * (1.0 + p))).abs() < 1e-15);
    /// ```
    ///
    /// # Errors
    /// As [`stationary`](Self::stationary); [`ControlError::NotDefinite`] also for the second weight, which is
    /// positive semidefinite where the whole cost is.
    pub fn stationary_with_cross(
        a: &SMatrix<T, N, N>,
        b: &SMatrix<T, N, M>,
        q: &SMatrix<T, N, N>,
        r: &SMatrix<T, M, M>,
        cross: &SMatrix<T, N, M>,
    ) -> Result<Self, ControlError> {
        finite("a", a)?;
        finite("b", b)?;
        finite("q", q)?;
        finite("r", r)?;
        finite("cross", cross)?;
        let at_once = Cholesky::new("r", &symmetrized(r))?.solve(&cross.transpose());
        let transition = a - b * at_once;
        finite("a − b r⁻¹crossᵀ", &transition)?;
        let weight = symmetrized(&(q - cross * at_once));
        semidefinite_beside(q, "q − cross r⁻¹crossᵀ", &weight)?;
        let Self { cost, .. } = Self::doubled(&transition, b, &weight, r)?;
        // from the cost: in the sum of its own gain and r⁻¹crossᵀ most of both may go
        let weighed = b.transpose() * cost;
        let heavy = Cholesky::new("r", &symmetrized(&(r + weighed * b)))?;
        let gain = heavy.solve(&(weighed * a + cross.transpose()));
        finite("the gain of the regulator", &gain)?;
        Ok(Self { gain, cost })
    }

    /// The first step of a longer horizon, from the cost `next` of the rest: iterated backwards, the
    /// regulator along a trajectory with its own a, b, q and r at every tick.
    ///
    /// ```
    /// use nalgebra::{Matrix2, matrix, vector};
    /// use nonholonomic::control::Regulator;
    ///
    /// let (a, b) = (matrix![1.0, 0.1; 0.0, 1.0], vector![0.0, 0.1]);
    /// let (q, r) = (Matrix2::identity(), matrix![1.0]);
    /// let mut regulator = Regulator::before(&Matrix2::zeros(), &a, &b, &q, &r).unwrap();
    /// for _ in 0..1000 {
    ///     regulator = Regulator::before(&regulator.cost, &a, &b, &q, &r).unwrap();
    /// }
    /// let stationary = Regulator::stationary(&a, &b, &q, &r).unwrap();
    /// assert!((regulator.gain - stationary.gain).norm() < 1e-12);
    /// ```
    ///
    /// # Errors
    /// [`ControlError::NotFinite`], and [`ControlError::NotDefinite`] for `r + bᵀ next b`.
    pub fn before(
        next: &SMatrix<T, N, N>,
        a: &SMatrix<T, N, N>,
        b: &SMatrix<T, N, M>,
        q: &SMatrix<T, N, N>,
        r: &SMatrix<T, M, M>,
    ) -> Result<Self, ControlError> {
        finite("next", next)?;
        finite("a", a)?;
        finite("b", b)?;
        finite("q", q)?;
        finite("r", r)?;
        let weighed = b.transpose() * next;
        let gain = Cholesky::new("r", &symmetrized(&(r + weighed * b)))?.solve(&(weighed * a));
        // Joseph's form: a sum of terms that cannot be negative
        let closed = a - b * gain;
        let cost = q + gain.transpose() * r * gain + closed.transpose() * next * closed;
        finite("the gain of the regulator", &gain)?;
        finite("the cost of the regulator", &cost)?;
        Ok(Self { gain, cost: symmetrized(&cost) })
    }

    /// The input for a deviation e of the state from where it should be: −K e, without looking at it: a
    /// deviation with NaN gives NaN. An [`Estimate`](super::Estimate) from the filters of this module has none.
    #[inline]
    #[must_use]
    pub fn input(&self, deviation: &SVector<T, N>) -> SVector<T, M> {
        -(self.gain * deviation)
    }

    /// One more step of the horizon leaves the cost as it is, or the solution is none. What doubling has lost of it, as
    /// where inputs cost next to nothing and 1 + reach · cost has no digits left, Newton's iteration brings back: the
    /// cost of the gain that there is, and the gain for that cost (Kleinman, Hewer; IEEE Trans. Automatic Control 16
    /// (1971) 382–384).
    fn checked(
        a: &SMatrix<T, N, N>,
        b: &SMatrix<T, N, M>,
        q: &SMatrix<T, N, N>,
        r: &SMatrix<T, M, M>,
        cost: &SMatrix<T, N, N>,
    ) -> Result<Self, ControlError> {
        // a cost with which the inputs would gain is none: it is not r that is wrong
        let nothing_of_it = |error| match error {
            ControlError::NotDefinite { .. } => ControlError::Residual { residual: f64::INFINITY },
            other => other,
        };
        let mut regulator = Self::before(cost, a, b, q, r).map_err(nothing_of_it)?;
        let mut residual = most_added(&(regulator.cost - cost), cost);
        // half of it at least in each: there is an end to that
        while let Some(cost) = regulator.followed(a, b, q, r) {
            let Ok(next) = Self::before(&cost, a, b, q, r) else { break };
            let left = most_added(&(next.cost - cost), &cost);
            let is_less = left + left < residual;
            if !is_less {
                break;
            }
            (regulator, residual) = (next, left);
        }
        // half the digits of the scalar
        if residual > T::EPSILON.sqrt() {
            return Err(ControlError::Residual { residual: residual.to_f64() });
        }
        regulator.bounded(a, b)
    }

    /// What it costs to follow this gain for ever: Σ (aᵀ − Kᵀbᵀ)ᵏ (q + Kᵀ r K) (a − b K)ᵏ, by doubling. None where that
    /// does not end within the longest horizon.
    fn followed(
        &self,
        a: &SMatrix<T, N, N>,
        b: &SMatrix<T, N, M>,
        q: &SMatrix<T, N, N>,
        r: &SMatrix<T, M, M>,
    ) -> Option<SMatrix<T, N, N>> {
        let mut closed = a - b * self.gain;
        let mut cost = symmetrized(&(q + self.gain.transpose() * r * self.gain));
        let (mut horizon, longest) = (T::ONE, longest_horizon::<T>());
        while horizon < longest {
            let more = symmetrized(&(closed.transpose() * cost * closed));
            cost += more;
            if most_added(&more, &cost) <= T::EPSILON {
                return Some(cost);
            }
            closed *= closed;
            horizon += horizon;
        }
        None
    }

    /// Refuses a closed loop that leaves the range of the scalar within the longest horizon: what costs nothing is
    /// not held, and may grow.
    fn bounded(self, a: &SMatrix<T, N, N>, b: &SMatrix<T, N, M>) -> Result<Self, ControlError> {
        let mut closed = a - b * self.gain;
        let (mut horizon, longest) = (T::ONE, longest_horizon::<T>());
        let mut iterations = 0;
        while horizon < longest && norm(&closed) > T::from_f64(0.5) {
            closed *= closed;
            horizon += horizon;
            iterations += 1;
            if !norm(&closed).is_finite() {
                return Err(ControlError::NotStabilizable { iterations, change: f64::INFINITY });
            }
        }
        Ok(self)
    }
}

/// The largest share of the cost of a component that is added to it: components have units of their own, and a part of a
/// semidefinite matrix is bounded by its diagonal. Not finite where a cost is not.
fn most_added<T: Entry, const N: usize>(more: &SMatrix<T, N, N>, cost: &SMatrix<T, N, N>) -> T {
    more.diagonal().zip_fold(&cost.diagonal(), T::ZERO, |most, more, cost| {
        let (more, cost) = (Scalar::abs(more), Scalar::abs(cost));
        // nothing costs anything if the cost is zero; infinity beside infinity is no number
        let share = if more == T::ZERO && cost.is_finite() { T::ZERO } else { more / cost };
        Scalar::max(most, share)
    })
}

/// The inverse of a square matrix, with entries that are not finite if there is none.
fn inverse<T: Entry, const N: usize>(a: &SMatrix<T, N, N>) -> SMatrix<T, N, N> {
    let rows: [[T; N]; N] = core::array::from_fn(|i| core::array::from_fn(|j| a[(i, j)]));
    let factors = Factors::<D<N>, T>::new(&rows);
    let mut inverse = SMatrix::<T, N, N>::zeros();
    for j in 0..N {
        let unit: [T; N] = core::array::from_fn(|i| if i == j { T::ONE } else { T::ZERO });
        inverse.set_column(j, &SVector::from(factors.solve(&unit)));
    }
    inverse
}

#[cfg(test)]
mod tests {
    use super::super::draws::Draws;
    use super::*;
    use nalgebra::{Matrix2, Matrix3, matrix, vector};

    /// The solution in closed loop is stable and satisfies the equation to round-off; the numbers
    /// are those of a fixed-point iteration with mpmath at 60 digits.
    #[test]
    fn it_agrees_with_high_precision() {
        let a = matrix![1.0, 0.1, 0.0; 0.0, 0.98, 0.2; 0.05, 0.0, 1.1];
        let b = matrix![0.0, 0.01; 0.1, 0.0; 0.0, 0.3];
        let q = Matrix3::from_diagonal(&vector![1.0, 0.1, 10.0]);
        let r = matrix![0.5, 0.1; 0.1, 0.2];
        let regulator = Regulator::stationary(&a, &b, &q, &r).unwrap();
        let expected = matrix![
            1.145_417_307_182_808_2, 1.335_991_602_604_318_8, -0.291_604_182_582_093_3;
            0.442_242_103_336_067_3, 0.346_958_962_898_267_66, 3.234_590_406_549_289
        ];
        assert!(
            (regulator.gain - expected).norm() < 1e-13 * expected.norm(),
            "{}",
            regulator.gain - expected
        );
    }

    /// The gain is the best among its neighbours: the cost of a run from any state is the least.
    #[test]
    fn a_cross_term_is_part_of_the_cost() {
        let a = matrix![1.0, 0.1; 0.3, 1.05];
        let b = vector![0.02, 0.1];
        let (q, r, cross) = (matrix![2.0, 0.1; 0.1, 1.0], matrix![0.6], vector![0.3, -0.4]);
        let regulator = Regulator::stationary_with_cross(&a, &b, &q, &r, &cross).unwrap();
        let run = |gain: SMatrix<f64, 1, 2>| {
            let (mut x, mut sum) = (vector![0.7, -0.2], 0.0);
            for _ in 0..3000 {
                let u = -(gain * x)[0];
                sum += x.dot(&(q * x)) + 2.0 * x.dot(&cross) * u + r[0] * u * u;
                x = a * x + b * u;
            }
            sum
        };
        let best = run(regulator.gain);
        let start = vector![0.7, -0.2];
        assert!((best - start.dot(&(regulator.cost * start))).abs() < 1e-11 * best);
        for change in [matrix![0.05, 0.0], matrix![-0.05, 0.0], matrix![0.0, 0.05], matrix![0.0, -0.05]] {
            assert!(run(regulator.gain + change) > best);
        }
        let indefinite = Regulator::stationary_with_cross(&a, &b, &q, &r, &vector![30.0, 0.0]);
        assert!(matches!(indefinite, Err(ControlError::NotDefinite { .. })));
    }

    /// The square of outputs that the inputs act on at once costs nothing with u = −D⁻¹C e: what rounding leaves of
    /// q − cross r⁻¹crossᵀ has either sign.
    #[test]
    fn a_cost_that_the_input_removes_at_once() {
        let mut draws = Draws(1);
        let mut number = || draws.draw() - 0.5;
        let mut decaying = 0;
        for _ in 0..1000 {
            let c = SMatrix::<f64, 2, 3>::from_fn(|_, _| number());
            let d = SMatrix::<f64, 2, 2>::from_fn(|_, _| number()) + Matrix2::identity();
            let a = SMatrix::<f64, 3, 3>::from_fn(|_, _| 0.2 * number());
            let b = SMatrix::<f64, 3, 2>::from_fn(|_, _| 0.2 * number());
            let gain = d.try_inverse().unwrap() * c;
            if (a - b * gain).norm() > 0.9 {
                continue;
            }
            decaying += 1;
            let (q, r, cross) = (c.transpose() * c, d.transpose() * d, c.transpose() * d);
            let regulator = Regulator::stationary_with_cross(&a, &b, &q, &r, &cross).unwrap();
            assert!((regulator.gain - gain).norm() < 1e-10 * gain.norm(), "{} {gain}", regulator.gain);
            assert!(regulator.cost.norm() < 1e-12 * q.norm(), "{}", regulator.cost);
        }
        assert!(decaying > 500, "{decaying}");
    }

    #[test]
    fn what_costs_nothing_may_drift_but_not_grow() {
        let speed_alone = Matrix2::from_diagonal(&vector![0.0, 1.0]);
        let (a, b) = (matrix![1.0, 0.1; 0.0, 1.0], vector![0.0, 0.1]);
        let drifting = Regulator::stationary(&a, &b, &speed_alone, &matrix![1.0]).unwrap();
        assert!(drifting.gain[0] == 0.0 && drifting.gain[1] > 0.5);
        for growth in [1.2, 1.000_01] {
            let a = matrix![growth, 0.0; 0.0, 0.5];
            let refused = Regulator::stationary(&a, &vector![1.0, 1.0], &speed_alone, &matrix![1.0]);
            assert!(matches!(refused, Err(ControlError::NotStabilizable { .. })), "{refused:?}");
            let free = Regulator::stationary(&a, &vector![1.0, 1.0], &Matrix2::zeros(), &matrix![1.0]);
            assert!(matches!(free, Err(ControlError::NotStabilizable { .. })), "{free:?}");
        }
    }

    #[test]
    fn single_precision_serves() {
        let a = matrix![1.0_f32, 0.01; 0.0, 1.0];
        let b = vector![0.0_f32, 0.01];
        let regulator = Regulator::stationary(&a, &b, &Matrix2::identity(), &matrix![1.0]).unwrap();
        let (a, b) = (a.cast::<f64>(), b.cast::<f64>());
        let exact = Regulator::stationary(&a, &b, &Matrix2::identity(), &matrix![1.0]).unwrap();
        assert!((regulator.gain.cast::<f64>() - exact.gain).norm() < 1e-3);
    }

    #[test]
    fn what_cannot_be_steered_is_refused() {
        let a = matrix![1.2, 0.0; 0.0, 0.5];
        let refused = Regulator::stationary(&a, &vector![0.0, 1.0], &Matrix2::identity(), &matrix![1.0]);
        assert!(matches!(refused, Err(ControlError::NotStabilizable { .. })), "{refused:?}");
        let flat = Regulator::stationary(&a, &vector![1.0, 1.0], &Matrix2::identity(), &matrix![0.0]);
        assert_eq!(flat, Err(ControlError::NotDefinite { matrix: "r", pivot: 0.0 }));
        let nan = Regulator::stationary(&a, &vector![f64::NAN, 1.0], &Matrix2::identity(), &matrix![1.0]);
        assert!(matches!(nan, Err(ControlError::NotFinite { argument: "b", .. })));
    }

    /// The spin of a disk about the vertical, θ̇ + 16 lean, which no motor inside of it changes: it costs something
    /// for ever, however small the rounding error that makes it decay.
    #[test]
    fn what_no_input_changes_is_not_held_by_round_off() {
        let a = matrix![
            0.0, 0.0, 1.0, 0.0;
            0.0, 0.0, 0.0, 1.0;
            0.0, 0.0, 0.0, -16.0;
            0.0, 24.525, 2.5, 0.0
        ];
        let b = vector![0.0, 0.0, 0.0, -5.0 / 3.0];
        let weights = nalgebra::Matrix4::identity();
        for dt in [0.001, 0.005, 0.02, 0.1] {
            let (step, held) = super::super::zero_order_hold(&a, &b, dt).unwrap();
            let refused = Regulator::stationary(&step, &held, &weights, &matrix![1.0]);
            assert!(matches!(refused, Err(ControlError::NotStabilizable { .. })), "{dt} {refused:?}");
        }
        // one that is slow, but is held
        let slow = matrix![1.0, 1e-3; 0.0, 1.0];
        let push = vector![0.0, 1e-3];
        let lazy = Matrix2::from_diagonal(&vector![1e-12, 0.0]);
        Regulator::stationary(&slow, &push, &lazy, &matrix![1.0]).unwrap();
    }

    #[test]
    fn decaying_modes_need_no_input() {
        let a = matrix![0.5_f64, 0.0; 0.0, 0.9];
        let regulator =
            Regulator::stationary(&a, &vector![0.0, 0.0], &Matrix2::identity(), &matrix![1.0]).unwrap();
        assert!((regulator.cost[(0, 0)] - 1.0 / 0.75).abs() < 1e-14);
        assert!((regulator.cost[(1, 1)] - 1.0 / 0.19).abs() < 1e-13);
        assert!(regulator.gain.norm() < 1e-300);
    }
}
