//! Symmetric methods that stay on the constraints.

use super::Symmetric;
use super::blur::{blur, is_within};
use crate::arrays::displaced;
use crate::held::{Held, Holding};
use crate::methods::implicit::newton::{self, falls, refusal, sizes};
use crate::methods::plateau::{Plateau, largest_of};
use crate::methods::{Arrival, Fixed, OneStep, Start};
use crate::{Dim, DimOf, IntegrationError, Real, Scalar, ScalarOf, State, Statistics, VecOf};

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

/// A step with both moves by some μ.
struct Way<S: Holding> {
    change: VecOf<S>,
    end: VecOf<S>,
    /// What is left of the equations at the end, and what they ask of μ there.
    left: VecOf<S>,
    correction: VecOf<S>,
}

impl<P> SymmetricProjection<P> {
    /// R(x₀) μ, the step, R(x₁) μ.
    fn way<S: Holding>(
        &self,
        (start, x, h): (&Start<'_, S>, &VecOf<S>, ScalarOf<S>),
        (first, last): (&Held<S::State>, &mut Held<S::State>),
        amounts: &VecOf<S>,
        (work, statistics): (&mut P::Work, &mut Statistics),
    ) -> Result<Way<S>, IntegrationError>
    where
        P: OneStep<S>,
        ScalarOf<S>: Real,
    {
        let Start { system, input, time, .. } = *start;
        let one = ScalarOf::<S>::ONE;
        let mut change = first.along(amounts);
        let here = displaced(x, one, &change);
        let state = S::State::from_array(here);
        let within =
            self.base.increment(&Start { system, input, time, state: &state }, &here, h, work, statistics)?;
        change = displaced(&change, one, &within);
        let reached = displaced(x, one, &displaced(&change, one, &last.along(amounts)));
        *last = system.held(time + h, &S::State::from_array(reached));
        change = displaced(&change, one, &last.along(amounts));
        let end = displaced(x, one, &change);
        let left = system.equations(time + h, &S::State::from_array(end));
        Ok(Way { change, end, left, correction: last.projector().amounts(&left) })
    }
}

/// What rounding of the step and of their terms makes of the equations.
fn of_rounding<S: Holding>((start, x, h): (&Start<'_, S>, &VecOf<S>, ScalarOf<S>), way: &Way<S>) -> VecOf<S>
where
    ScalarOf<S>: Real,
{
    let open = |x: &VecOf<S>| start.system.equations(start.time + h, &S::State::from_array(*x));
    let moved = displaced(&sizes(x), ScalarOf::<S>::ONE, &sizes(&way.change));
    blur(&way.end, &moved, open)
}

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
        let first = start.system.held(start.time, start.state);
        let mut last = first;
        let mut amounts = work.amounts;
        let mut least: Option<VecOf<S>> = None;
        let mut plateau = Plateau::new();
        let half = T::from_f64(0.5);
        let mut iterations = 0;
        loop {
            let way = self.way((start, x, h), (&first, &mut last), &amounts, (&mut work.base, statistics))?;
            iterations += 1;
            let now = sizes(&way.correction);
            let size = now.as_ref().iter().fold(T::ZERO, |most, size| most.max(*size));
            // what is no longer less than before is not yet rounding: the one before was less by accident, or all lead away
            let is_less = falls(least.get_or_insert(now).as_mut(), now.as_ref()) || iterations == 1;
            let is_level = plateau.is_level(&way.correction, size);
            let blur = if is_less { DimOf::<S>::vec(T::ZERO) } else { of_rounding((start, x, h), &way) };
            let is_open = |row| !is_within(row, &way.left, &blur);
            let mut is_there = !is_less && (0..DimOf::<S>::N).all(|row| !is_open(row));
            let moved = largest_of([&last.along(&way.correction); 2]);
            let is_small = moved <= T::EPSILON.sqrt().sqrt() * largest_of([x, &way.change]);
            if !is_there && is_level && is_small {
                let mut base = self.base.work();
                is_there = plateau.is_rounding(&way.correction, size, is_open, |part| {
                    let further = displaced(&amounts, -half * part, &way.correction);
                    let work = (&mut base, &mut *statistics);
                    let way = self.way((start, x, h), (&first, &mut { last }), &further, work);
                    way.map_or(DimOf::<S>::vec(T::from_f64(f64::NAN)), |way| way.correction)
                });
            }
            // both moves change g by μ, to first order
            amounts = displaced(&amounts, -half, &way.correction);
            if is_there {
                work.amounts = amounts;
                return Ok(way.change);
            }
            if iterations == MOST_ITERATIONS || !size.is_finite() {
                let (none, moved) = (DimOf::<S>::vec(T::ZERO), last.along(&way.correction));
                work.amounts = none;
                // in units of the tolerance that the iterations of other methods have
                let residual = newton::size(&moved, x, &way.change, &none) / (T::from_f64(1e3) * T::EPSILON);
                return Err(refusal(start, h, (iterations, residual), way.end.as_ref(), None));
            }
        }
    }

    fn blame(&self, start: &Start<'_, S>, h: ScalarOf<S>) -> Option<IntegrationError> {
        self.base.blame(start, h)
    }
}
