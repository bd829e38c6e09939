//! The energy-preserving method of discrete gradients.

mod step;

use step::{Along, Parts, Step, dot};

use super::Symmetric;
use crate::arrays::displaced;
use crate::linear::Factors;
use crate::methods::implicit::newton::{SLOW, check_tolerance, exceeds, once, one_less, refusal};
use crate::methods::plateau::{Plateau, largest_of};
use crate::methods::{Analytic, Arrival, FiniteDifferences, Fixed, Linearization, OneStep, Start};
use crate::{AlmostPoisson, DimOf, Dynamics, IntegrationError, Real, ScalarOf, State, Statistics, VecOf};

/// The method x₁ = x₀ + h Π(x̄) ∂̄E(x₀, x₁) with fixed steps, of order 2, x̄ being the mean of both ends
/// and ∂̄E a midpoint discrete gradient of the energy,
///
/// ∂̄E = ∂E(x̄) + (E(x₁) − E(x₀) − ∂E(x̄)·Δ) d / (d·Δ), Δ = x₁ − x₀,
///
/// so that ∂̄E·Δ = E(x₁) − E(x₀), and that is h ∂̄E·Π ∂̄E = 0: the energy stays, whatever the step
/// (Gonzalez, Time integration and discrete Hamiltonian systems, J. Nonlinear Sci. 6 (1996); for
/// nonholonomic systems Celledoni, Farré Puiggalí, Høiseth, Martín de Diego, arXiv 1605.02845). It
/// is symmetric. Quadratic constraints and identities of coordinates (|γ| = 1, RᵀR = 1, γ·ω = 0) stay
/// too, since they are Casimir functions of Π. Position constraints, and all others beside them, are kept by every
/// step: Π(x̄) is projected so that their discrete gradients are Casimir functions, too, mathematics (37).
/// For systems declared with `emit { discrete_gradient }`.
///
/// Gonzalez takes d = Δ, which adds lengths to velocities: where these differ by orders of magnitude, as on
/// a stiff spring, the correction goes astray. Here dᵢ is the change of ∂E/∂xᵢ with the sign of Δᵢ, rounded
/// off between the signs, dᵢ = δᵢ sᵢ / √(sᵢ² + η² Σ s²), δ = ∂E(x₁) − ∂E(x₀), sᵢ = δᵢ Δᵢ: it does not
/// depend on the units of the components.
///
/// The equations are solved by Newton's iteration with the matrix of the implicit midpoint rule, until
/// the corrections stagnate in round-off. In place of E(x₀) stands the energy of the first state, which
/// is the same but for round-off: so that this does not add up, in any number of steps.
///
/// ```
/// # use nonholonomic::prelude::*;
/// # use nonholonomic::{AlmostPoisson, D};
/// # #[derive(Clone, Copy)] struct Pendulum;
/// # #[derive(Clone, Copy)] struct Swing { q: f64, v: f64 }
/// # impl State for Swing {
/// #     type Scalar = f64;
/// #     type Dim = D<2>;
/// #     fn to_array(&self) -> [f64; 2] { [self.q, self.v] }
/// #     fn from_array([q, v]: [f64; 2]) -> Self { Self { q, v } }
/// #     fn names() -> [&'static str; 2] { ["q", "v"] }
/// # }
/// # impl Dynamics for Pendulum {
/// #     type State = Swing;
/// #     type Input = ();
/// #     fn derivative(&self, _t: f64, s: &Swing, (): &()) -> Swing { Swing { q: s.v, v: -s.q.sin() } }
/// # }
/// # impl Energy for Pendulum {
/// #     fn energy(&self, _t: f64, s: &Swing) -> f64 { s.v * s.v / 2.0 - s.q.cos() }
/// # }
/// # impl AlmostPoisson for Pendulum {
/// #     fn energy_gradient(&self, _t: f64, s: &Swing) -> [f64; 2] { [s.q.sin(), s.v] }
/// #     fn almost_poisson(&self, _t: f64, _s: &Swing, c: &[f64; 2]) -> [f64; 2] { [c[1], -c[0]] }
/// # }
/// # fn main() -> Result<(), IntegrationError> {
/// let start = Swing { q: 2.5, v: 0.0 };
/// let mut sim = Integrator::new(Pendulum, DiscreteGradient::new(0.5), 0.0, start);
/// sim.advance_to(1000.0)?;
/// let drift = Pendulum.energy(0.0, sim.state()) - Pendulum.energy(0.0, &start);
/// assert!(drift.abs() < 1e-13);
/// # Ok(())
/// # }
/// ```
pub type DiscreteGradient<T, J = FiniteDifferences> = Fixed<Gonzalez<T, J>, T>;

/// A step of the method of discrete gradients: see [`DiscreteGradient`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gonzalez<T, J> {
    tolerance: T,
    linearization: J,
}

impl<T, J> Symmetric for Gonzalez<T, J> {}

impl<T: Real> DiscreteGradient<T> {
    /// The method with steps of length `step`, which has to be positive and finite.
    #[must_use]
    pub fn new(step: T) -> Self {
        let tolerance = T::from_f64(1e5) * T::EPSILON;
        Self { step, scheme: Gonzalez { tolerance, linearization: FiniteDifferences } }
    }

    /// The same method with the system's own Jacobian in Newton's iteration, for systems declared with
    /// `emit { jacobian }` too.
    #[must_use]
    pub fn with_jacobian(self) -> DiscreteGradient<T, Analytic> {
        let Self { step, scheme: Gonzalez { tolerance, .. } } = self;
        Fixed { step, scheme: Gonzalez { tolerance, linearization: Analytic } }
    }
}

impl<T: Real, J> DiscreteGradient<T, J> {
    /// The largest correction, relative to the largest component of the state, at which the iteration may
    /// stagnate; 100 000 rounding units if not given, since round-off in the energy counts for the more, the
    /// shorter the step. A larger one does not make it stop earlier.
    #[must_use]
    pub fn tolerance(mut self, tolerance: T) -> Self {
        self.scheme.tolerance = tolerance;
        self
    }
}

impl<T: Real> DiscreteGradient<T> {
    /// One step of length `dt` as a pure function: the state at `t + dt`.
    ///
    /// # Errors
    /// [`IntegrationError::NoConvergence`] if the equations are not solved,
    /// [`IntegrationError::NonFiniteDerivative`] if the derivative at `state` is not finite,
    /// [`IntegrationError::NonFiniteEnergy`] if the energy there is not,
    /// [`IntegrationError::Setting`] if `dt` is not.
    pub fn step<S>(
        system: &S,
        t: T,
        dt: T,
        state: &S::State,
        input: &S::Input,
    ) -> Result<S::State, IntegrationError>
    where
        S: AlmostPoisson,
        S::State: State<Scalar = T>,
    {
        once(&Self::new(dt).scheme, &Start { system, input, time: t, state }, dt)
    }
}

/// The iterations after which a solution is given up.
const MOST_ITERATIONS: u32 = 60;
/// The rounding errors of the energy that a solution has to bear.
const ROUND_OFF: f64 = 16.0;
/// The corrections in a row that do not halve the smallest one, after which round-off is all that is left.
const STALLED: u32 = 3;

/// A step h and the factorized matrix 1 − h/2 ∂f/∂x.
type Matrix<S> = (ScalarOf<S>, Factors<DimOf<S>, ScalarOf<S>>);

/// What is kept from step to step: the factorized matrix 1 − h/2 ∂f/∂x with its h, and the energy that
/// is held.
pub struct Work<S: Dynamics> {
    matrix: Option<Matrix<S>>,
    energy: Option<ScalarOf<S>>,
}

impl<S: Dynamics> Clone for Work<S> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<S: Dynamics> Copy for Work<S> {}

impl<T: Real, J> Gonzalez<T, J> {
    /// Solves the equations of a step.
    fn solve<S>(
        &self,
        step: &Step<'_, '_, S>,
        work: &mut Work<S>,
        statistics: &mut Statistics,
    ) -> Result<VecOf<S>, IntegrationError>
    where
        S: AlmostPoisson,
        S::State: State<Scalar = T>,
        J: Linearization<S>,
    {
        use crate::Dim;
        let mut matrix = work.matrix.filter(|(h, _)| *h == step.h);
        let mut retry = matrix.is_some();
        let mut change = DimOf::<S>::vec(T::ZERO);
        let most = (T::EPSILON * T::EPSILON).recip();
        let (mut best, mut stalled, mut iterations) = (most, 0, 0);
        let (mut settled, mut noise) = (None, None);
        let mut plateau = Plateau::new();
        loop {
            let (_, factors) = match matrix {
                Some(matrix) => matrix,
                None => *matrix.insert((step.h, self.matrix(step, &change, statistics))),
            };
            let (defect, factor) = step.defect(&change, settled);
            statistics.evaluations += 1;
            let correction = factors.solve(&defect);
            let before = change;
            change = displaced(&change, T::ONE, &correction);
            iterations += 1;
            statistics.iterations += 1;
            let size = step.relative(&correction, &change) / self.tolerance;
            // a single correction that is not smaller says nothing: what is left would be of one sign
            // and add up over the steps
            let ratio = size / best;
            stalled = if ratio < T::from_f64(0.5) { 0 } else { stalled + 1 };
            let mut bearable = T::ONE;
            if stalled > 0 {
                let [by_direction, by_change] = *noise.get_or_insert_with(|| {
                    statistics.evaluations += 1;
                    self.noise(step, &change, &factors)
                });
                // what round-off leaves of the energy goes the way on which it makes less of itself
                let is_quieter = by_change < by_direction || !by_direction.is_finite();
                if settled.is_none() && size <= T::ONE && is_quieter {
                    settled = Some(factor);
                }
                // more than half of the digits it does not excuse
                let noise = if settled.is_some() { by_change } else { by_direction };
                bearable = bearable.max(noise.min(T::EPSILON.sqrt() / self.tolerance));
            }
            best = best.min(size);
            if size == T::ZERO || (stalled >= STALLED && size <= bearable) {
                break;
            }
            let ahead = |part: T| {
                statistics.evaluations += 1;
                factors.solve(&step.defect(&displaced(&before, part, &correction), settled).0)
            };
            let permitted = T::EPSILON.sqrt() * largest_of([step.x, &change]);
            let is_open = |row| exceeds(row, (&correction, step.x, &change, &change), self.tolerance);
            if plateau.is_level(&correction, size)
                && size > bearable
                && plateau.is_rounding(&correction, permitted, is_open, ahead)
            {
                break;
            }
            if !size.is_finite() || iterations >= MOST_ITERATIONS {
                if !retry {
                    let reached = displaced(step.x, T::ONE, &change);
                    let half = T::from_f64(0.5);
                    let from = [(step.start.time + half * step.h, displaced(step.x, half, &before))];
                    return Err(refusal(step.start, step.h, (iterations, size), reached.as_ref(), from));
                }
                (retry, matrix, best, stalled, iterations) = (false, None, most, 0, 0);
                (settled, noise) = (None, None);
                plateau = Plateau::new();
                change = DimOf::<S>::vec(T::ZERO);
                continue;
            }
            if size > T::ONE && iterations > 1 && ratio >= T::from_f64(SLOW) {
                matrix = None;
            }
        }
        work.matrix = matrix;
        Ok(change)
    }

    /// The corrections that rounding errors of the energy make by themselves, in units of the tolerance: if
    /// they go along d, and if they go along Δ.
    #[cold]
    fn noise<S>(&self, step: &Step<'_, '_, S>, change: &VecOf<S>, factors: &Factors<DimOf<S>, T>) -> [T; 2]
    where
        S: AlmostPoisson,
        S::State: State<Scalar = T>,
    {
        let Parts { direction, along, size, .. } = step.parts(change);
        let round_off = T::from_f64(ROUND_OFF) * T::EPSILON * size / self.tolerance;
        // Δ as a covector: of the size of a gradient
        let Along { mut unit, length } = Along::new(change);
        let slope = size / length;
        unit.as_mut().iter_mut().for_each(|x| *x *= slope);
        let by_change = dot::<S>(&unit, change);
        [(&direction, along), (&unit, by_change)].map(|(direction, along)| {
            let correction = factors.solve(&step.turned(change, direction));
            let noise = round_off * (step.relative(&correction, change) / along);
            // where energies have no digits they make no noise either
            if noise >= T::ZERO { noise } else { T::ZERO }
        })
    }

    /// 1 − h/2 ∂f/∂x at the middle of a step, factorized.
    fn matrix<S>(
        &self,
        step: &Step<'_, '_, S>,
        change: &VecOf<S>,
        statistics: &mut Statistics,
    ) -> Factors<DimOf<S>, T>
    where
        S: AlmostPoisson,
        S::State: State<Scalar = T>,
        J: Linearization<S>,
    {
        let half = T::from_f64(0.5);
        let middle = displaced(step.x, half, change);
        let slope = step.start.derivative_at(step.start.time, middle);
        let jacobian = self.linearization.state_jacobian(
            step.start,
            step.start.time,
            &middle,
            &slope,
            step.h,
            statistics,
        );
        statistics.evaluations += 1;
        statistics.jacobians += 1;
        statistics.factorizations += 1;
        Factors::new(&one_less::<DimOf<S>, _>(half * step.h, jacobian))
    }
}

impl<T: Real, S: AlmostPoisson, J: Linearization<S>> OneStep<S> for Gonzalez<T, J>
where
    S::State: State<Scalar = T>,
{
    type Work = Work<S>;
    dense_by_cubic!();

    fn work(&self) -> Work<S> {
        Work { matrix: None, energy: None }
    }

    #[inline]
    fn forget(&self, work: &mut Work<S>) {
        *work = OneStep::<S>::work(self);
    }

    fn keeps_positions(&self) -> bool {
        S::HOLDS
    }

    /// The energy to keep stays that of the first state.
    fn moved(&self, _work: &mut Work<S>) {}

    /// As at the end of a step.
    fn stand(&self, _work: &mut Work<S>) {}

    fn check(&self) -> Result<(), IntegrationError> {
        check_tolerance(self.tolerance)
    }

    fn increment(
        &self,
        start: &Start<'_, S>,
        x: &VecOf<S>,
        h: T,
        work: &mut Work<S>,
        statistics: &mut Statistics,
    ) -> Result<VecOf<S>, IntegrationError> {
        let present = start.system.energy(start.time, start.state);
        if !present.is_finite() {
            let (time, value) = (start.time.to_f64(), present.to_f64());
            return Err(IntegrationError::NonFiniteEnergy { time, value });
        }
        let energy = *work.energy.get_or_insert(present);
        let gradient = start.system.energy_gradient(start.time, start.state);
        self.solve(&Step { start, x, h, energy, gradient }, work, statistics)
    }
}
