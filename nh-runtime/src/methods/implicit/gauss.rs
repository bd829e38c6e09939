//! The methods of Gauss and Legendre.

use super::collocation::{Collocation, Matrices, weighted};
use super::linearization::{Analytic, FiniteDifferences, Linearization};
use super::newton::{MOST_ITERATIONS, SLOW, check_tolerance, is_first_term, once, refusal, size};
use crate::arrays::{displaced, first_non_finite};
use crate::methods::fixed::{self, Fixed, OneStep, Slopes};
use crate::methods::{Arrival, Start};
use crate::{Dim, DimOf, Dynamics, IntegrationError, Real, ScalarOf, State, Statistics, VecOf};

/// The method of Gauss and Legendre with two stages and fixed steps, of order 4
/// (Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I, table II.7.3).
///
/// Symmetric, A-stable, and it keeps quadratic invariants (Hairer, Lubich, Wanner, Geometric Numerical
/// Integration, theorem IV.2.1) to the accuracy to which its equations are solved: simplified Newton
/// iterations go on until the corrections stagnate in round-off. The Jacobian comes from difference
/// quotients, or [from the system](Self::with_jacobian); it is kept as long as the iteration converges
/// well.
pub type GaussLegendre4<T, J = FiniteDifferences> = Fixed<Gauss<T, J, 2>, T>;

/// The method of Gauss and Legendre with three stages and fixed steps, of order 6
/// (Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I, table II.7.4); otherwise as
/// [`GaussLegendre4`].
pub type GaussLegendre6<T, J = FiniteDifferences> = Fixed<Gauss<T, J, 3>, T>;

/// The computation of a step of [`GaussLegendre4`] and [`GaussLegendre6`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gauss<T, J, const N: usize> {
    tolerance: T,
    linearization: J,
}

/// The tables by their number of stages.
pub(super) trait Table<const N: usize> {
    const TABLE: Collocation<N>;
}

impl<T, J> Table<2> for Gauss<T, J, 2> {
    const TABLE: Collocation<2> = Collocation {
        nodes: [0.211_324_865_405_187_1, 0.788_675_134_594_812_9],
        end: [-1.732_050_807_568_877_2, 1.732_050_807_568_877_2],
        real: 0.0,
        pair: (3.0, 1.732_050_807_568_877_2),
        from_blocks: [[0.0, -0.267_949_192_431_122_7], [1.0, 0.0]],
        to_blocks: [[0.0, 1.0], [-3.732_050_807_568_877, 0.0]],
    };
}

impl<T, J> Table<3> for Gauss<T, J, 3> {
    const TABLE: Collocation<3> = Collocation {
        nodes: [0.112_701_665_379_258_31, 0.5, 0.887_298_334_620_741_7],
        end: [1.666_666_666_666_666_7, -1.333_333_333_333_333_3, 1.666_666_666_666_666_7],
        real: 4.644_370_709_252_171,
        pair: (3.677_814_645_373_914_4, 3.508_761_919_567_443_3),
        from_blocks: [
            [0.072_151_852_055_200_17, -0.082_241_230_573_630_67, 0.060_120_738_619_308_5],
            [0.118_832_578_741_277_81, 0.053_065_090_742_061_394, -0.316_205_051_132_291_6],
            [1.0, 1.0, 0.0],
        ],
        to_blocks: [
            [5.991_698_084_937_801, 1.139_214_295_155_735_4, 0.432_312_113_783_858_36],
            [-5.991_698_084_937_801, -1.139_214_295_155_735_4, 0.567_687_886_216_141_6],
            [1.246_213_273_586_231_5, -2.925_559_646_192_313_7, 0.257_735_201_273_432_47],
        ],
    };
}

macro_rules! constructors {
    ($name:ident, $stages:literal) => {
        impl<T: Real> $name<T> {
            /// The method with steps of length `step`, which has to be positive and finite.
            #[must_use]
            pub fn new(step: T) -> Self {
                let tolerance = T::from_f64(1e3) * T::EPSILON;
                Fixed { step, scheme: Gauss { tolerance, linearization: FiniteDifferences } }
            }

            /// The same method with the system's own Jacobian, for systems that have one: declared
            /// with `emit { jacobian }`.
            #[must_use]
            pub fn with_jacobian(self) -> $name<T, Analytic> {
                let Fixed { step, scheme: Gauss { tolerance, .. } } = self;
                Fixed { step, scheme: Gauss { tolerance, linearization: Analytic } }
            }

            /// One step of length `dt` as a pure function: the state at `t + dt`.
            ///
            /// # Errors
            /// [`IntegrationError::NoConvergence`] if the equations are not solved,
            /// [`IntegrationError::NonFiniteDerivative`] if the derivative at `state` is not finite,
            /// [`IntegrationError::Setting`] if `dt` is not.
            pub fn step<S>(
                system: &S,
                t: T,
                dt: T,
                state: &S::State,
                input: &S::Input,
            ) -> Result<S::State, IntegrationError>
            where
                S: Dynamics,
                S::State: State<Scalar = T>,
            {
                once(&Self::new(dt.abs()).scheme, &Start { system, input, time: t, state }, dt)
            }
        }

        impl<T: Real, J> $name<T, J> {
            /// The largest correction, relative to the largest component of the state, at which the iteration
            /// may stagnate; 1000 rounding units if not given. A larger one does not make it stop
            /// earlier.
            #[must_use]
            pub fn tolerance(mut self, tolerance: T) -> Self {
                self.scheme.tolerance = tolerance;
                self
            }
        }
    };
}
constructors!(GaussLegendre4, 2);
constructors!(GaussLegendre6, 3);

/// What a Gauss method keeps: the stages of the last step, and the matrices while they serve.
pub struct Work<S: Dynamics, const N: usize> {
    /// The length of the last step, and its stages.
    pub(super) last: Option<(ScalarOf<S>, [VecOf<S>; N])>,
    pub(super) matrices: Option<(ScalarOf<S>, Matrices<S>)>,
}

impl<S: Dynamics, const N: usize> Clone for Work<S, N> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<S: Dynamics, const N: usize> Copy for Work<S, N> {}

impl<T: Real, S: Dynamics, J: Linearization<S>, const N: usize> OneStep<S> for Gauss<T, J, N>
where
    S::State: State<Scalar = T>,
    Self: Table<N>,
{
    type Work = Work<S, N>;
    type Dense = Slopes<VecOf<S>>;

    fn work(&self) -> Work<S, N> {
        Work { last: None, matrices: None }
    }

    #[inline]
    fn forget(&self, work: &mut Work<S, N>) {
        *work = Work { last: None, matrices: None };
    }

    fn check(&self) -> Result<(), IntegrationError> {
        check_tolerance(self.tolerance)
    }

    fn increment(
        &self,
        start: &Start<'_, S>,
        _x: &VecOf<S>,
        h: T,
        work: &mut Work<S, N>,
        statistics: &mut Statistics,
    ) -> Result<VecOf<S>, IntegrationError> {
        let table = &Self::TABLE;
        let z = settled(table, &self.linearization, self.tolerance, start, h, work, statistics)?;
        Ok(weighted(DimOf::<S>::vec(T::ZERO), &table.end, &z))
    }

    fn dense(&self, _work: &Work<S, N>, start: &Start<'_, S>, arrival: &Arrival<S>) -> Slopes<VecOf<S>> {
        fixed::slopes(start, arrival)
    }

    fn interpolate(
        &self,
        dense: &Slopes<VecOf<S>>,
        start: &Start<'_, S>,
        arrival: &Arrival<S>,
        time: T,
    ) -> S::State {
        fixed::interpolate(dense, start, arrival, time)
    }
}

/// The stages of a step, by simplified Newton iterations until their corrections stagnate in round-off.
pub(super) fn settled<T: Real, S: Dynamics, J: Linearization<S>, const N: usize>(
    table: &Collocation<N>,
    linearization: &J,
    tolerance: T,
    start: &Start<'_, S>,
    h: T,
    work: &mut Work<S, N>,
    statistics: &mut Statistics,
) -> Result<[VecOf<S>; N], IntegrationError>
where
    S::State: State<Scalar = T>,
{
    let x = &start.state.to_array();
    let zero = DimOf::<S>::vec(T::ZERO);
    if is_first_term(h) {
        statistics.evaluations += 1;
        let slope = start.derivative();
        if first_non_finite::<T>(slope.as_ref()).is_some() {
            return Err(refusal(start, h, 0, T::ZERO, slope.as_ref()));
        }
        *work = Work { last: None, matrices: None };
        return Ok(table.nodes.map(|node| displaced(&zero, T::from_f64(node) * h, &slope)));
    }
    let mut z = match &work.last {
        Some((length, z)) => table.extrapolated(zero, z, h / *length),
        None => [zero; N],
    };
    let mut matrices = work.matrices.filter(|(length, _)| *length == h).map(|(_, matrices)| matrices);
    // stored matrices and starting values that fail get one chance more with new ones
    let mut retry = work.last.is_some() || matrices.is_some();
    *work = Work { last: None, matrices: None };
    let mut preceding: Option<T> = None;
    let mut iterations = 0;
    let mut residual;
    loop {
        let current = if let Some(matrices) = matrices {
            matrices
        } else {
            let slope = start.derivative();
            let jacobian = linearization.state_jacobian(start, start.time, x, &slope, h, statistics);
            statistics.evaluations += 1;
            statistics.jacobians += 1;
            statistics.factorizations += 2;
            *matrices.insert(table.matrices::<S>(&jacobian, h))
        };
        let change = table.iterate(start, x, h, &current, &mut z);
        iterations += 1;
        statistics.iterations += 1;
        statistics.evaluations += N as u64;
        let sizes = change.iter().zip(&z).map(|(c, z)| size(c, x, z));
        let largest = sizes.fold(T::ZERO, T::max);
        residual = largest / tolerance;
        let ratio = preceding.map(|preceding| residual / preceding);
        let stagnates = ratio.is_some_and(|ratio| ratio >= T::from_f64(0.5));
        if largest <= T::EPSILON * T::from_f64(0.5) || (stagnates && residual <= T::ONE) {
            break;
        }
        if !residual.is_finite() || iterations >= MOST_ITERATIONS {
            if !retry {
                let reached = displaced(x, T::ONE, &weighted(zero, &table.end, &z));
                return Err(refusal(start, h, iterations, residual, reached.as_ref()));
            }
            retry = false;
            (z, matrices, preceding, iterations) = ([zero; N], None, None, 0);
            continue;
        }
        if ratio.is_some_and(|ratio| ratio >= T::from_f64(SLOW)) && residual > T::ONE && retry {
            retry = false;
            matrices = None;
        }
        preceding = Some(residual);
    }
    *work = Work { last: Some((h, z)), matrices: matrices.map(|matrices| (h, matrices)) };
    Ok(z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::methods::implicit::collocation::tests::check;

    #[test]
    fn the_tables_are_those_of_collocation() {
        check(&<Gauss<f64, Analytic, 2> as Table<2>>::TABLE);
        check(&<Gauss<f64, Analytic, 3> as Table<3>>::TABLE);
    }
}
