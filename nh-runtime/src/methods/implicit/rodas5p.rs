//! The Rosenbrock method Rodas5P.

mod table;

use table::{A, C, DENSE, GAMMA, NODES, TIME};

use super::collocation::{shifted, weighted};
use super::linearization::{Analytic, FiniteDifferences, Linearization};
use super::newton::{blamed, is_first_term};
use crate::arrays::{all_finite, displaced, nought};
use crate::linear::Factors;
use crate::methods::adaptive::Adaptive;
use crate::methods::trial::{Scheme, Trial};
use crate::methods::{Arrival, Start};
use crate::tolerance::{Tolerance, Uniform, norm};
use crate::{Dim, DimOf, Dynamics, MatOf, Real, Scalar, ScalarOf, State, Statistics, VecOf};

/// The adaptive Rosenbrock method Rodas5P with eight stages, of order 5 with an error estimate of order
/// 4 and a continuous extension of order 4: L-stable, for stiff systems (Steinebach, Construction of
/// Rosenbrock–Wanner method Rodas5P and numerical benchmarks within the Julia Differential Equations
/// package, BIT 63 (2023) 27; Hairer, Wanner, Solving Ordinary Differential Equations II, section IV.7).
///
/// There is nothing to iterate: a step forms the Jacobian and factorizes one real matrix. The order
/// rests on the Jacobian: take [that of the system](Self::with_jacobian) where there is one rather
/// than difference quotients, which cost two or three times as many evaluations where the error needs more digits
/// than one for each component gives. ∂f/∂t is a difference quotient.
pub type Rodas5P<T, W = Uniform<T>, J = FiniteDifferences> = Adaptive<Rodas<J>, T, W>;

/// The computation of a step of [`Rodas5P`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rodas<J> {
    linearization: J,
}

impl Default for Rodas<FiniteDifferences> {
    fn default() -> Self {
        Self { linearization: FiniteDifferences }
    }
}

impl<T: Real, W> Rodas5P<T, W> {
    /// The same method with the system's own Jacobian, for systems that have one: declared with
    /// `emit { jacobian }`.
    #[must_use]
    pub fn with_jacobian(self) -> Rodas5P<T, W, Analytic> {
        let Self { tolerance, control, .. } = self;
        Adaptive { scheme: Rodas { linearization: Analytic }, tolerance, control }
    }
}

/// What is kept of a step.
pub struct Work<S: Dynamics> {
    /// f, ∂f/∂x and a difference of f by time at the start.
    first: VecOf<S>,
    jacobian: MatOf<S>,
    by_time: (VecOf<S>, ScalarOf<S>),
    /// The length of the step that the latter two were formed for, if they belong to the present start.
    linearized: Option<ScalarOf<S>>,
    /// The error of each component that they were formed for.
    permitted: VecOf<S>,
    /// The stages u.
    stages: [VecOf<S>; 8],
    /// The start and the length of the step that the stages belong to.
    step: Option<(ScalarOf<S>, ScalarOf<S>)>,
    /// The length that the derivatives of the last accepted step were formed for.
    accepted: ScalarOf<S>,
}

impl<S: Dynamics> Clone for Work<S> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<S: Dynamics> Copy for Work<S> {}

/// The change of f by time alone, in the direction of the step or else against it, and over which time. This is a share of
/// the step that the quotient is meant for: √ε of it, and more where time is too coarse. The quotient itself, with the
/// square of the unit of time, may be out of range where its contribution to the step is not.
fn by_time<S: Dynamics>(
    start: &Start<'_, S>,
    first: &VecOf<S>,
    h: ScalarOf<S>,
    statistics: &mut Statistics,
) -> (VecOf<S>, ScalarOf<S>)
where
    ScalarOf<S>: Real,
{
    let x = start.state.to_array();
    let coarseness = (start.time / h).abs().max(ScalarOf::<S>::ONE);
    // behind the start the equation may be another one
    let delta = h * (ScalarOf::<S>::EPSILON * coarseness).sqrt();
    for delta in [delta, -delta] {
        let there = start.time + delta;
        let mut slope = start.derivative_at(there, x);
        statistics.evaluations += 1;
        if all_finite::<ScalarOf<S>, _>(&slope) {
            slope.as_mut().iter_mut().zip(first.as_ref()).for_each(|(s, f)| *s -= *f);
            return (slope, there - start.time);
        }
    }
    (DimOf::<S>::vec(ScalarOf::<S>::ZERO), delta)
}

impl<J> Rodas<J> {
    /// Forms the derivatives of f at the start, for a step of length h.
    fn linearize<S: Dynamics>(
        &self,
        start: &Start<'_, S>,
        h: ScalarOf<S>,
        permitted: &VecOf<S>,
        work: &mut Work<S>,
        statistics: &mut Statistics,
    ) where
        ScalarOf<S>: Real,
        J: Linearization<S>,
    {
        work.jacobian =
            self.linearization.accurate_state_jacobian(start, &work.first, h, permitted, statistics);
        work.permitted = *permitted;
        work.by_time = by_time(start, &work.first, h, statistics);
    }

    /// Computes the stages of a step and gives its end.
    fn stages<S: Dynamics>(start: &Start<'_, S>, h: ScalarOf<S>, work: &mut Work<S>) -> VecOf<S>
    where
        ScalarOf<S>: Real,
    {
        let w = ScalarOf::<S>::from_f64;
        let one = ScalarOf::<S>::ONE;
        let zero = DimOf::<S>::vec(ScalarOf::<S>::ZERO);
        let x = start.state.to_array();
        if is_first_term(h) {
            work.stages = [zero; 8];
            return displaced(&x, h, &work.first);
        }
        let matrix = shifted::<S>(&work.jacobian, (h * w(GAMMA)).recip());
        let factors = Factors::<DimOf<S>, ScalarOf<S>>::new(&matrix);
        work.stages = [zero; 8];
        let mut state = x;
        for i in 0..8 {
            let (Some(a), Some(c), Some(node), Some(time)) = (A.get(i), C.get(i), NODES.get(i), TIME.get(i))
            else {
                break;
            };
            let [known @ .., _] = &work.stages;
            // later stages are zero
            state = displaced(&x, one, &weighted(zero, a, known));
            let slope =
                if i == 0 { work.first } else { start.derivative_at(start.time + w(*node) * h, state) };
            let coupled = displaced(&slope, one / h, &weighted(zero, c, known));
            let right = displaced(&coupled, w(*time) * (h / work.by_time.1), &work.by_time.0);
            if let Some(stage) = work.stages.get_mut(i) {
                *stage = factors.solve(&right);
            }
        }
        let [.., last] = &work.stages;
        displaced(&state, one, last)
    }
}

impl<S: Dynamics, J: Linearization<S>> Scheme<S> for Rodas<J>
where
    ScalarOf<S>: Real,
{
    const ERROR_ORDER: u32 = 5;
    type Work = Work<S>;
    /// The stages, combined.
    type Dense = [VecOf<S>; 3];

    fn work(&self) -> Work<S> {
        let zero = DimOf::<S>::vec(ScalarOf::<S>::ZERO);
        Work {
            first: zero,
            jacobian: DimOf::<S>::mat(ScalarOf::<S>::ZERO),
            by_time: (zero, ScalarOf::<S>::ONE),
            linearized: None,
            permitted: zero,
            stages: [zero; 8],
            step: None,
            accepted: ScalarOf::<S>::ZERO,
        }
    }

    fn forget(&self, _work: &mut Work<S>) {}

    fn begin<'w>(
        &self,
        start: &Start<'_, S>,
        work: &'w mut Work<S>,
        statistics: &mut Statistics,
    ) -> &'w VecOf<S> {
        statistics.evaluations += 1;
        work.first = start.derivative();
        work.linearized = None;
        work.step = None;
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
        let x = start.state.to_array();
        if work.linearized.is_none() {
            self.linearize(start, h, &tolerance.permitted(&x), work, statistics);
            statistics.jacobians += 1;
            if !work.jacobian.as_ref().iter().all(all_finite::<ScalarOf<S>, _>) {
                // an infinite entry would take its stages for zero
                return Trial { state: x, error: ScalarOf::<S>::ZERO.recip() };
            }
            work.linearized = Some(h);
        }
        statistics.factorizations += 1;
        statistics.evaluations += 7;
        let state = Self::stages(start, h, work);
        let [.., defect] = &work.stages;
        let error = norm(tolerance, defect, &x, &state);
        Trial { state, error: error + nought(&state) }
    }

    fn accept<const KEEP: bool>(&self, start: &Start<'_, S>, h: ScalarOf<S>, work: &mut Work<S>) {
        work.step = Some((start.time, h));
        work.accepted = work.linearized.unwrap_or(h);
    }

    #[cold]
    fn blame(&self, start: &Start<'_, S>, h: ScalarOf<S>, work: &Work<S>) -> Option<((usize, f64), f64)> {
        let x = start.state.to_array();
        let zero = DimOf::<S>::vec(ScalarOf::<S>::ZERO);
        let [known @ .., _] = &work.stages;
        blamed(start, h, &NODES, |stage| {
            A.get(stage).map_or(x, |a| displaced(&x, ScalarOf::<S>::ONE, &weighted(zero, a, known)))
        })
    }

    fn dense(&self, work: &Work<S>, start: &Start<'_, S>, arrival: &Arrival<S>) -> [VecOf<S>; 3] {
        let h = arrival.time - start.time;
        let zero = DimOf::<S>::vec(ScalarOf::<S>::ZERO);
        if work.step == Some((start.time, h)) {
            return DENSE.map(|row| weighted(zero, &row, &work.stages));
        }
        // another step has been tried since
        let mut again = *work;
        let statistics = &mut Statistics::default();
        again.first = start.derivative();
        self.linearize(start, work.accepted, &work.permitted, &mut again, statistics);
        Self::stages(start, h, &mut again);
        DENSE.map(|row| weighted(zero, &row, &again.stages))
    }

    /// x₀(1−s) + s (x₁ + (1−s)(k₁ + s(k₂ + s k₃))).
    fn interpolate(
        &self,
        dense: &[VecOf<S>; 3],
        start: &Start<'_, S>,
        arrival: &Arrival<S>,
        time: ScalarOf<S>,
    ) -> S::State {
        let one = ScalarOf::<S>::ONE;
        let s = (time - start.time) / (arrival.time - start.time);
        let [k1, k2, k3] = dense;
        let inner = displaced(k1, s, &displaced(k2, s, k3));
        let x0 = start.state.to_array();
        let change = displaced(&arrival.state.to_array(), -one, &x0);
        S::State::from_array(displaced(&displaced(&x0, s, &change), s * (one - s), &inner))
    }
}
