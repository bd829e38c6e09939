//! The method Radau IIA of order 5.

mod coefficients;

pub(super) use coefficients::RADAU;

use super::collocation::{Matrices, weighted};
use super::linearization::{Analytic, FiniteDifferences, Linearization};
use super::newton::{blamed, is_first_term};
use crate::arrays::{Array, displaced, nought};
use crate::dense::hermite;
use crate::methods::adaptive::Adaptive;
use crate::methods::trial::{Scheme, Trial};
use crate::methods::{Arrival, Start};
use crate::step_control::Controller;
use crate::tolerance::{Tolerance, Uniform, norm};
use crate::{Dim, DimOf, Dynamics, MatOf, Real, Scalar, ScalarOf, State, Statistics, VecOf};

/// The adaptive method Radau IIA with three stages, of order 5 with an error estimate of order 3 and
/// the collocation polynomial of order 3 as continuous extension: L-stable, for stiff systems
/// (Hairer, Wanner, Solving Ordinary Differential Equations II, section IV.8, the code RADAU5).
///
/// The equations are solved by simplified Newton iterations, one real and one complex factorization
/// per step. The Jacobian comes from difference quotients, or [from the system](Self::with_jacobian),
/// and is kept as long as the iteration converges fast.
pub type Radau5<T, W = Uniform<T>, J = FiniteDifferences> = Adaptive<Radau<J>, T, W>;

/// The computation of a step of [`Radau5`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Radau<J> {
    linearization: J,
}

impl Default for Radau<FiniteDifferences> {
    fn default() -> Self {
        Self { linearization: FiniteDifferences }
    }
}

impl<T: Real, W> Radau5<T, W> {
    /// The same method with the system's own Jacobian, for systems that have one: declared with
    /// `emit { jacobian }`.
    #[must_use]
    pub fn with_jacobian(self) -> Radau5<T, W, Analytic> {
        let Self { tolerance, control, .. } = self;
        Adaptive { scheme: Radau { linearization: Analytic }, tolerance, control }
    }
}

/// (−13 − 7√6, −13 + 7√6, −1)/3: the weights of the error estimate, eq. (IV.8.19) there.
const ERROR: [f64; 3] = [-10.048_809_399_827_416, 1.382_142_733_160_749, -0.333_333_333_333_333_3];
/// The corrections at which an iteration ends, in units of the tolerance, are at most this.
const ENOUGH: f64 = 0.03;
/// And at least so many rounding units of the state.
const RESOLVED: f64 = 10.0;
/// The iterations after which it is given up.
const MOST_ITERATIONS: i32 = 7;
/// The rate of convergence up to which the Jacobian serves the next step, too, if it takes no more evaluations than an
/// iteration; and in any case.
const FAST: [f64; 2] = [2e-3, 0.1];
/// The evaluations of an iteration.
const STAGES: f64 = 3.0;
/// The rate of convergence that is as good as none.
const HOPELESS: f64 = 0.99;
/// The length of a step is kept where it could grow up to this factor.
const KEPT: f64 = 1.3;
/// The matrices of one length serve another one that differs by up to this share of it.
const SAME: f64 = 1e-6;

/// Start, length and stages of a step.
type Accepted<S> = (ScalarOf<S>, ScalarOf<S>, [VecOf<S>; 3]);

/// What is kept of a step.
pub struct Work<S: Dynamics> {
    /// The derivative at the start.
    first: VecOf<S>,
    jacobian: Option<MatOf<S>>,
    /// For a step of which length.
    formed: ScalarOf<S>,
    /// Whether that was at the present start.
    current: bool,
    /// For steps of which length.
    matrices: Option<(ScalarOf<S>, Matrices<S>)>,
    /// The stages being computed.
    trial: [VecOf<S>; 3],
    /// The last accepted step.
    accepted: Option<Accepted<S>>,
    /// Whether the accepted stages may be continued into the next step.
    smooth: bool,
    /// Whether a step from the present start has been computed before.
    again: bool,
    /// The rate at which the last iteration converged.
    rate: ScalarOf<S>,
    /// How far the last correction of an iteration is from its end, as a multiple of it, going by the rate of
    /// the last one.
    ahead: ScalarOf<S>,
    /// The iterations of the last step.
    iterations: i32,
    /// The share of its length to try after a step whose equations were not solved.
    shorter: Option<ScalarOf<S>>,
}

impl<S: Dynamics> Clone for Work<S> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<S: Dynamics> Copy for Work<S> {}

/// The end of a step from x, which is its last stage.
fn end_of<T: Scalar, V: Array<T>>(x: &V, [.., last]: &[V; 3]) -> V {
    displaced(x, T::ONE, last)
}

impl<S: Dynamics> Work<S> {
    /// Drops a Jacobian of another place after a step that failed.
    fn reconsider(&mut self) {
        if !self.current {
            self.jacobian = None;
            self.matrices = None;
        }
    }
}

impl<J> Radau<J> {
    /// Solves the equations, or says which share of the length to try next.
    fn solve<S: Dynamics, W: Tolerance<S::State>>(
        start: &Start<'_, S>,
        h: ScalarOf<S>,
        matrices: &Matrices<S>,
        tolerance: &W,
        work: &mut Work<S>,
        statistics: &mut Statistics,
    ) -> Option<ScalarOf<S>>
    where
        ScalarOf<S>: Real,
    {
        let w = ScalarOf::<S>::from_f64;
        let one = ScalarOf::<S>::ONE;
        let x = start.state.to_array();
        let zero = DimOf::<S>::vec(ScalarOf::<S>::ZERO);
        work.trial = match &work.accepted {
            Some((_, length, z)) if work.smooth => RADAU.extrapolated(zero, z, h / *length),
            _ => [zero; 3],
        };
        // how many tolerances the state has: the estimate is of lower order than the step, so that
        // the equations have to be solved the better the smaller the tolerance is
        let resolution = norm(tolerance, &x, &x, &x);
        let enough = w(ENOUGH).min(resolution.sqrt().recip());
        let enough = enough.max(w(RESOLVED) * ScalarOf::<S>::EPSILON * resolution);
        let failed = Some(w(0.5));
        work.ahead = work.ahead.max(ScalarOf::<S>::EPSILON).powf(w(0.8));
        work.rate = w(FAST[0]);
        let (mut last, mut last_ratio) = (one, one);
        for iteration in 1..=MOST_ITERATIONS {
            let change = RADAU.iterate(start, &x, h, matrices, &mut work.trial);
            work.iterations = iteration;
            statistics.iterations += 1;
            statistics.evaluations += 3;
            let end = end_of(&x, &work.trial);
            let squares = change.iter().map(|c| tolerance.mean_square(c, &x, &end));
            let squares = squares.fold(ScalarOf::<S>::ZERO, |sum, square| sum + square);
            let size = (squares * w(1.0 / 3.0)).sqrt();
            if !size.is_finite() {
                return failed;
            }
            if iteration > 1 {
                let ratio = size / last;
                work.rate = if iteration == 2 { ratio } else { (ratio * last_ratio).sqrt() };
                last_ratio = ratio;
                if work.rate >= w(HOPELESS) {
                    return failed;
                }
                work.ahead = work.rate / (one - work.rate);
                let left = MOST_ITERATIONS - iteration;
                // how much too large the last correction would be
                let excess = work.ahead * size * work.rate.powi(left) / enough;
                if excess >= one {
                    let exponent = (w(4.0) + w(f64::from(left))).recip();
                    return Some(w(0.8) * excess.max(w(1e-4)).min(w(20.0)).powf(-exponent));
                }
            }
            if work.ahead * size <= enough {
                return None;
            }
            last = size.max(ScalarOf::<S>::EPSILON);
        }
        failed
    }

    /// The rate of convergence up to which the Jacobian serves the next step, too: one that takes many evaluations is worth
    /// more iterations.
    fn fast<S: Dynamics>(&self) -> f64
    where
        J: Linearization<S>,
    {
        let [least, most] = FAST;
        let iterations =
            f64::from(u32::try_from(self.linearization.evaluations()).unwrap_or(u32::MAX)) / STAGES;
        (least * iterations * iterations).clamp(least, most)
    }

    /// The matrices for a step of length h.
    fn matrices<S: Dynamics>(
        &self,
        start: &Start<'_, S>,
        h: ScalarOf<S>,
        work: &mut Work<S>,
        statistics: &mut Statistics,
    ) -> Matrices<S>
    where
        ScalarOf<S>: Real,
        J: Linearization<S>,
    {
        if let Some((length, matrices)) = &work.matrices
            && (*length - h).abs() <= ScalarOf::<S>::from_f64(SAME) * h.abs()
        {
            return *matrices;
        }
        let kept = work.jacobian.filter(|_| work.current || self.linearization.serves(work.formed, h));
        let jacobian = if let Some(jacobian) = kept {
            jacobian
        } else {
            statistics.jacobians += 1;
            let x = start.state.to_array();
            let jacobian =
                self.linearization.state_jacobian(start, start.time, &x, &work.first, h, statistics);
            work.current = true;
            work.formed = h;
            *work.jacobian.insert(jacobian)
        };
        statistics.factorizations += 2;
        let matrices = RADAU.matrices::<S>(&jacobian, h);
        work.matrices = Some((h, matrices));
        matrices
    }
}

impl<S: Dynamics, J: Linearization<S>> Scheme<S> for Radau<J>
where
    ScalarOf<S>: Real,
{
    const ERROR_ORDER: u32 = 4;
    type Work = Work<S>;
    type Dense = [VecOf<S>; 3];

    fn work(&self) -> Work<S> {
        let zero = DimOf::<S>::vec(ScalarOf::<S>::ZERO);
        Work {
            first: zero,
            jacobian: None,
            formed: ScalarOf::<S>::ZERO,
            current: false,
            matrices: None,
            trial: [zero; 3],
            accepted: None,
            smooth: false,
            again: false,
            rate: ScalarOf::<S>::ZERO,
            ahead: ScalarOf::<S>::ZERO.recip(),
            iterations: 0,
            shorter: None,
        }
    }

    fn usual_controller() -> Controller<ScalarOf<S>> {
        Controller::predictive()
    }

    fn forget(&self, work: &mut Work<S>) {
        work.jacobian = None;
        work.matrices = None;
        work.smooth = false;
        work.ahead = ScalarOf::<S>::ZERO.recip();
    }

    /// The derivative is evaluated at every start, and the Jacobian serves many of them.
    fn moved(&self, _work: &mut Work<S>) {}

    fn begin<'w>(
        &self,
        start: &Start<'_, S>,
        work: &'w mut Work<S>,
        statistics: &mut Statistics,
    ) -> &'w VecOf<S> {
        statistics.evaluations += 1;
        work.first = start.derivative();
        work.again = false;
        work.current = false;
        &work.first
    }

    fn attempt<const KEEP: bool, W: Tolerance<S::State>>(
        &self,
        start: &Start<'_, S>,
        h: ScalarOf<S>,
        tolerance: &W,
        work: &mut Work<S>,
        statistics: &mut Statistics,
    ) -> Trial<S> {
        let one = ScalarOf::<S>::ONE;
        let x = start.state.to_array();
        let zero = DimOf::<S>::vec(ScalarOf::<S>::ZERO);
        let infinite = one / ScalarOf::<S>::ZERO;
        if is_first_term(h) {
            let slope = work.first;
            work.trial = RADAU.nodes.map(|node| displaced(&zero, ScalarOf::<S>::from_f64(node) * h, &slope));
            work.again = true;
            let state = displaced(&x, h, &slope);
            return Trial { state, error: nought(&state) };
        }
        let matrices = self.matrices(start, h, work, statistics);
        work.shorter = Self::solve(start, h, &matrices, tolerance, work, statistics);
        if work.shorter.is_some() && !work.current {
            // the Jacobian may be that of another place
            work.reconsider();
            let matrices = self.matrices(start, h, work, statistics);
            work.shorter = Self::solve(start, h, &matrices, tolerance, work, statistics);
        }
        let first_time = !work.again && work.accepted.is_some();
        work.again = true;
        if work.shorter.is_some() {
            work.reconsider();
            return Trial { state: x, error: infinite };
        }
        let state = end_of(&x, &work.trial);
        let by_stages = weighted(zero, &ERROR, &work.trial);
        let slope = displaced(&work.first, one / h, &by_stages);
        let Some(factors) = &matrices.real else { return Trial { state, error: infinite } };
        let mut defect = factors.solve(&slope);
        let mut error = norm(tolerance, &defect, &x, &state);
        if error >= one && !first_time {
            // a second filtering keeps the estimate from overrating fast components, eq. (IV.8.20)
            statistics.evaluations += 1;
            let moved = start.derivative_at(start.time, displaced(&x, one, &defect));
            defect = factors.solve(&displaced(&moved, one / h, &by_stages));
            error = norm(tolerance, &defect, &x, &state);
        }
        Trial { state, error: error + nought(&state) }
    }

    fn accept<const KEEP: bool>(&self, start: &Start<'_, S>, h: ScalarOf<S>, work: &mut Work<S>) {
        work.accepted = Some((start.time, h, work.trial));
        work.smooth = true;
        if work.rate > ScalarOf::<S>::from_f64(self.fast::<S>()) {
            work.jacobian = None;
            work.matrices = None;
        }
    }

    fn retry(&self, work: &Work<S>) -> Option<ScalarOf<S>> {
        work.shorter
    }

    /// Shorter after many iterations, and of the same length if that lets the matrices serve again.
    fn continued(&self, h: ScalarOf<S>, next: ScalarOf<S>, work: &Work<S>) -> ScalarOf<S> {
        let w = |x: i32| ScalarOf::<S>::from_f64(f64::from(x));
        let next = next * w(1 + 2 * MOST_ITERATIONS) / w(work.iterations + 2 * MOST_ITERATIONS);
        let is_kept = work.matrices.is_some() && next >= h && next <= h * ScalarOf::<S>::from_f64(KEPT);
        if is_kept { h } else { next }
    }

    #[cold]
    fn blame(&self, start: &Start<'_, S>, h: ScalarOf<S>, work: &Work<S>) -> Option<((usize, f64), f64)> {
        let x = start.state.to_array();
        blamed(start, h, &RADAU.nodes, |stage| {
            work.trial.get(stage).map_or(x, |z| displaced(&x, ScalarOf::<S>::ONE, z))
        })
    }

    fn dense(&self, work: &Work<S>, start: &Start<'_, S>, arrival: &Arrival<S>) -> [VecOf<S>; 3] {
        let h = arrival.time - start.time;
        if let Some((time, length, z)) = work.accepted
            && (time, length) == (start.time, h)
        {
            return z;
        }
        // another step has been computed since: what is left is the cubic through both ends
        let (x0, x1) = (start.state.to_array(), arrival.state.to_array());
        let (f0, f1) = (start.derivative(), start.derivative_at(arrival.time, x1));
        RADAU.nodes.map(|node| {
            let there = hermite((&x0, &f0), (&x1, &f1), h, ScalarOf::<S>::from_f64(node));
            displaced(&there, -ScalarOf::<S>::ONE, &x0)
        })
    }

    fn interpolate(
        &self,
        dense: &[VecOf<S>; 3],
        start: &Start<'_, S>,
        arrival: &Arrival<S>,
        time: ScalarOf<S>,
    ) -> S::State {
        let s = (time - start.time) / (arrival.time - start.time);
        let x = start.state.to_array();
        let zero = DimOf::<S>::vec(ScalarOf::<S>::ZERO);
        let there = displaced(&x, ScalarOf::<S>::ONE, &RADAU.polynomial(zero, dense, s));
        // a projection may have moved the end
        let [.., last] = dense;
        let end = displaced(&x, ScalarOf::<S>::ONE, last);
        let moved = displaced(&arrival.state.to_array(), -ScalarOf::<S>::ONE, &end);
        S::State::from_array(displaced(&there, s, &moved))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::methods::implicit::collocation::tests::check;

    #[test]
    fn the_table_is_that_of_collocation() {
        check(&RADAU);
        let root = 6.0_f64.sqrt();
        let exact = [(-13.0 - 7.0 * root) / 3.0, (-13.0 + 7.0 * root) / 3.0, -1.0 / 3.0];
        for (e, exact) in ERROR.iter().zip(exact) {
            assert!((e - exact).abs() < 1e-15 * exact.abs().max(1.0) * 10.0, "{e} {exact}");
        }
    }
}
