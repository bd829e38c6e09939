//! Compositions of a symmetric method with itself.

use core::marker::PhantomData;

use crate::arrays::displaced;
use crate::methods::{Arrival, Fixed, Midpoint, OneStep, Start};
use crate::{Dim, DimOf, Dynamics, IntegrationError, Real, ScalarOf, State, Statistics, VecOf};

/// A one-step method that is its own inverse with the step reversed. Its error has even powers of the
/// step alone, so that symmetric compositions gain two orders at a time. For methods of order 2.
pub trait Symmetric {}

/// A symmetric composition: the lengths of its substeps, relative to the step.
pub trait Substeps: Copy + Default {
    /// The first half of the lengths, the one in the middle included: the others mirror them.
    const HALF: &'static [f64];
}

/// Suzuki's composition of order 4, five substeps with γ = 1/(4 − ∛4), γ, 1 − 4γ, γ, γ: the negative
/// one is short, unlike in the triple jump (Suzuki, Phys. Lett. A 146 (1990); Hairer, Lubich, Wanner,
/// Geometric Numerical Integration, II (4.5)).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Suzuki4;

impl Substeps for Suzuki4 {
    const HALF: &'static [f64] =
        &[0.414_490_771_794_375_74, 0.414_490_771_794_375_74, -0.657_963_087_177_502_9];
}

/// Nine substeps of order 6 (Kahan, Li, Composition constants for raising the orders of
/// unconventional schemes, Math. Comp. 66 (1997); Hairer, Lubich, Wanner, Geometric Numerical
/// Integration, V (3.12)).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct KahanLi6;

impl Substeps for KahanLi6 {
    const HALF: &'static [f64] = &[
        0.392_161_444_007_314_1,
        0.332_599_136_789_359_44,
        -0.706_246_172_557_639_4,
        0.082_213_596_293_550_8,
        0.798_543_990_934_83,
    ];
}

/// The most different lengths in a composition.
const LENGTHS: usize = 5;

/// A step of a composition.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Composed<P, C> {
    base: P,
    substeps: PhantomData<C>,
}

impl<P: Symmetric, T> Fixed<P, T> {
    /// The composition of order 4 of a symmetric method of order 2 with itself, in five substeps: see
    /// [`Suzuki4`]. A substep goes back in time, which systems with strong friction do not bear.
    #[must_use]
    pub fn fourth_order(self) -> Fixed<Composed<P, Suzuki4>, T> {
        Fixed { step: self.step, scheme: Composed { base: self.scheme, substeps: PhantomData } }
    }

    /// The composition of order 6, in nine substeps: see [`KahanLi6`].
    #[must_use]
    pub fn sixth_order(self) -> Fixed<Composed<P, KahanLi6>, T> {
        Fixed { step: self.step, scheme: Composed { base: self.scheme, substeps: PhantomData } }
    }
}

impl<T, J> Symmetric for Midpoint<T, J> {}

impl<T: Real, S: Dynamics, P: OneStep<S>, C: Substeps> OneStep<S> for Composed<P, C>
where
    S::State: State<Scalar = T>,
{
    /// What the method keeps for each length.
    type Work = [P::Work; LENGTHS];
    dense_by_cubic!();

    fn work(&self) -> Self::Work {
        [self.base.work(); LENGTHS]
    }

    fn forget(&self, work: &mut Self::Work) {
        for work in work {
            self.base.forget(work);
        }
    }

    fn moved(&self, work: &mut Self::Work) {
        for work in work {
            self.base.moved(work);
        }
    }

    fn stand(&self, work: &mut Self::Work) {
        for work in work {
            self.base.stand(work);
        }
    }

    fn check(&self) -> Result<(), IntegrationError> {
        self.base.check()
    }

    fn keeps_positions(&self) -> bool {
        self.base.keeps_positions()
    }

    fn increment(
        &self,
        start: &Start<'_, S>,
        x: &VecOf<S>,
        h: T,
        work: &mut Self::Work,
        statistics: &mut Statistics,
    ) -> Result<VecOf<S>, IntegrationError> {
        let half = C::HALF.len();
        let mut change = DimOf::<S>::vec(T::ZERO);
        let mut passed = 0.0;
        for index in 0..(2 * half).saturating_sub(1) {
            // mirrored behind the middle
            let position = if index < half { index } else { 2 * half - 2 - index };
            let (Some(&length), Some(work)) = (C::HALF.get(position), work.get_mut(position)) else { break };
            let here = displaced(x, T::ONE, &change);
            let state = S::State::from_array(here);
            let time = start.time + h * T::from_f64(passed);
            let substep = Start { system: start.system, input: start.input, time, state: &state };
            let increment =
                self.base.increment(&substep, &here, h * T::from_f64(length), work, statistics)?;
            change = displaced(&change, T::ONE, &increment);
            passed += length;
        }
        Ok(change)
    }

    fn blame(&self, start: &Start<'_, S>, h: ScalarOf<S>) -> Option<IntegrationError> {
        self.base.blame(start, h)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lengths<C: Substeps>() -> std::vec::Vec<f64> {
        let mirrored = C::HALF.iter().rev().skip(1);
        C::HALF.iter().chain(mirrored).copied().collect()
    }

    fn power_sum<C: Substeps>(power: i32) -> f64 {
        lengths::<C>().iter().map(|length| length.powi(power)).sum()
    }

    /// Hairer, Lubich, Wanner, Geometric Numerical Integration, V.3: example 3.5.
    #[test]
    fn order_conditions() {
        assert!((power_sum::<Suzuki4>(1) - 1.0).abs() < 1e-15 && power_sum::<Suzuki4>(3).abs() < 1e-15);
        for power in [1, 3, 5] {
            let expected = if power == 1 { 1.0 } else { 0.0 };
            assert!((power_sum::<KahanLi6>(power) - expected).abs() < 1e-15, "{power}");
        }
        // Σ' γ_k³ Σ'_{l ≤ k} γ_l …: the remaining condition of order 5, with half weight on the diagonal
        let gamma = lengths::<KahanLi6>();
        let mut sum = 0.0;
        for (k, g) in gamma.iter().enumerate() {
            let before: f64 = gamma[..k].iter().sum::<f64>() + g / 2.0;
            sum += g.powi(3) * before * before;
        }
        let diagonal: f64 = gamma.iter().map(|g| g.powi(5)).sum::<f64>() / 12.0;
        assert!((sum + diagonal).abs() < 1e-14, "{sum} {diagonal}");
    }
}
