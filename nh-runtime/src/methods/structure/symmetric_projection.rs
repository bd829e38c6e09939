//! Symmetric methods that stay on the constraints.

use super::Symmetric;
use crate::arrays::displaced;
use crate::held::Holding;
use crate::methods::implicit::newton::{falls, refusal, sizes};
use crate::methods::{Arrival, Fixed, OneStep, Start};
use crate::{Dim, DimOf, IntegrationError, Real, ScalarOf, State, Statistics, VecOf};

/// A step with symmetric projection, mathematics (38): the start is moved off the constraints by R(x₀) μ, the method
/// takes its step, and R(x₁) μ with the same μ leads back to where g(x₁) = 0.
///
/// The step is its own inverse with the time reversed, as the method is; a return after the step is not. So the energy of
/// a motion that is its own reverse, as a swing is, stays within a band where a return makes it drift. That of one that is
/// not, as of a crank that goes round, drifts here too, but less; [`DiscreteGradient`](crate::DiscreteGradient) keeps it,
/// [`Rattle`](crate::Rattle) keeps it in a band.
///
/// Hairer, Symmetric projection methods for differential equations on manifolds, BIT 40 (2000); Hairer, Lubich, Wanner,
/// Geometric Numerical Integration, V.4.1. For systems declared with `emit { symmetric_projection }`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SymmetricProjection<P> {
    base: P,
}

impl<P: Symmetric, T> Fixed<P, T> {
    /// The method with its constraints kept by symmetric projection: see [`SymmetricProjection`]. It is symmetric and of
    /// order 2 as well, so that compositions of it have order 4 and 6.
    #[must_use]
    pub fn symmetrically_projected(self) -> Fixed<SymmetricProjection<P>, T> {
        Fixed { step: self.step, scheme: SymmetricProjection { base: self.scheme } }
    }
}

impl<P: Symmetric> Symmetric for SymmetricProjection<P> {}

/// What is kept from step to step: μ, from which the next search starts.
pub struct Work<S: Holding, K> {
    base: K,
    amounts: VecOf<S>,
}

impl<S: Holding, K: Clone> Clone for Work<S, K> {
    fn clone(&self) -> Self {
        Self { base: self.base.clone(), amounts: self.amounts }
    }
}
impl<S: Holding, K: Copy> Copy for Work<S, K> {}

/// The iterations after which a solution is given up.
const MOST_ITERATIONS: u32 = 50;

impl<T: Real, S: Holding, P: OneStep<S>> OneStep<S> for SymmetricProjection<P>
where
    S::State: State<Scalar = T>,
{
    type Work = Work<S, P::Work>;
    dense_by_cubic!();

    fn work(&self) -> Self::Work {
        Work { base: self.base.work(), amounts: DimOf::<S>::vec(T::ZERO) }
    }

    fn forget(&self, work: &mut Self::Work) {
        self.base.forget(&mut work.base);
        work.amounts = DimOf::<S>::vec(T::ZERO);
    }

    fn moved(&self, work: &mut Self::Work) {
        self.base.moved(&mut work.base);
    }

    fn stand(&self, work: &mut Self::Work) {
        self.base.stand(&mut work.base);
        work.amounts = DimOf::<S>::vec(T::ZERO);
    }

    fn check(&self) -> Result<(), IntegrationError> {
        self.base.check()
    }

    fn keeps_positions(&self) -> bool {
        true
    }

    fn increment(
        &self,
        start: &Start<'_, S>,
        x: &VecOf<S>,
        h: T,
        work: &mut Self::Work,
        statistics: &mut Statistics,
    ) -> Result<VecOf<S>, IntegrationError> {
        let Start { system, input, time, state } = *start;
        let first = system.held(time, state);
        let mut last = first;
        let mut amounts = work.amounts;
        let mut least: Option<VecOf<S>> = None;
        let half = T::from_f64(0.5);
        let mut iterations = 0;
        loop {
            // R(x₀) μ, the step, R(x₁) μ
            let mut change = first.along(&amounts);
            let here = displaced(x, T::ONE, &change);
            let state = S::State::from_array(here);
            let moved = Start { system, input, time, state: &state };
            let within = self.base.increment(&moved, &here, h, &mut work.base, statistics)?;
            change = displaced(&change, T::ONE, &within);
            let reached = displaced(x, T::ONE, &displaced(&change, T::ONE, &last.along(&amounts)));
            last = system.held(time + h, &S::State::from_array(reached));
            change = displaced(&change, T::ONE, &last.along(&amounts));
            let end = displaced(x, T::ONE, &change);
            let left = system.equations(time + h, &S::State::from_array(end));
            // both moves change g by μ, to first order
            let correction = last.projector().amounts(&left);
            amounts = displaced(&amounts, -half, &correction);
            iterations += 1;
            let now = sizes(&correction);
            if !falls(least.get_or_insert(now).as_mut(), now.as_ref()) && iterations > 1 {
                work.amounts = amounts;
                return Ok(change);
            }
            let size = now.as_ref().iter().fold(T::ZERO, |most, size| most.max(*size));
            if iterations == MOST_ITERATIONS || !size.is_finite() {
                work.amounts = DimOf::<S>::vec(T::ZERO);
                return Err(refusal(start, h, (iterations, size), end.as_ref(), None));
            }
        }
    }

    fn blame(&self, start: &Start<'_, S>, h: ScalarOf<S>) -> Option<IntegrationError> {
        self.base.blame(start, h)
    }
}
