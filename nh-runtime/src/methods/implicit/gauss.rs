//! The methods of Gauss and Legendre.

use super::collocation::{Collocation, Matrices, continued};
use super::linearization::{Analytic, FiniteDifferences, Linearization};
use super::newton::{
    MOST_ITERATIONS, SLOW, Settling, check_tolerance, exceeds, is_first_term, once, reach, refusal, size,
};
use super::starting_values::Misses;
use crate::arrays::{displaced, first_non_finite};
use crate::methods::fixed::{Fixed, OneStep};
use crate::methods::plateau::{Plateau, largest_of};
use crate::methods::{Arrival, Start};
use crate::{Dim, DimOf, Dynamics, IntegrationError, Real, Scalar, ScalarOf, State, Statistics, VecOf};

/// The method of Gauss and Legendre with two stages and fixed steps, of order 4
/// (Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I, table II.7.3).
///
/// Symmetric, A-stable, and it keeps quadratic invariants (Hairer, Lubich, Wanner, Geometric Numerical
/// Integration, theorem IV.2.1) to the accuracy to which its equations are solved: simplified Newton
/// iterations start from the stages of the last steps, continued, and go on until a hundredth of a rounding unit
/// is missing, or the corrections stagnate in round-off. The Jacobian comes from difference quotients, or
/// [from the system](Self::with_jacobian); it is kept as long as the iteration converges well.
///
/// Where the derivative has an infinite slope, as that of a tank out of which water flows, x' = 1 − √x, has while it is empty,
/// the iteration may not solve them, and [`IntegrationError::NoConvergence`] says so. [`Radau5`](crate::Radau5),
/// [`Rodas5P`](crate::Rodas5P) and [`ImplicitMidpoint`](crate::ImplicitMidpoint) get over that one, and explicit methods do.
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
        ahead: continued([0.211_324_865_405_187_1, 0.788_675_134_594_812_9]),
        matrix: [
            [(0.25, 0.0), (-0.038_675_134_594_812_88, -2.847_352_561_863_714_5e-18)],
            [(0.538_675_134_594_812_9, 1.672_514_036_967_817_2e-17), (0.25, 0.0)],
        ],
        end: [
            (-1.732_050_807_568_877_2, -1.003_508_422_180_690_3e-16),
            (1.732_050_807_568_877_2, 1.003_508_422_180_690_3e-16),
        ],
        real: 0.0,
        pair: (3.0, 1.732_050_807_568_877_2),
        from_blocks: [[0.0, -0.267_949_192_431_122_7], [1.0, 0.0]],
        to_blocks: [[0.0, 1.0], [-3.732_050_807_568_877, 0.0]],
    };
}

impl<T, J> Table<3> for Gauss<T, J, 3> {
    const TABLE: Collocation<3> = Collocation {
        nodes: [0.112_701_665_379_258_31, 0.5, 0.887_298_334_620_741_7],
        ahead: continued([0.112_701_665_379_258_31, 0.5, 0.887_298_334_620_741_7]),
        matrix: [
            [
                (0.138_888_888_888_888_9, -6.167_905_692_361_980_4e-18),
                (-0.035_976_667_524_938_9, -1.713_147_716_657_678_7e-18),
                (0.009_789_444_015_308_325, 6.854_025_647_616_559e-19),
            ],
            [
                (0.300_263_194_980_864_57, 2.516_409_893_370_003_6e-17),
                (0.222_222_222_222_222_2, 1.233_581_138_472_396_1e-17),
                (-0.022_485_417_203_086_815, 6.640_061_530_657_58e-19),
            ],
            [
                (0.267_988_333_762_469_44, 7.795_467_762_236_068e-18),
                (0.480_421_111_969_383_36, -1.524_859_293_733_776_7e-17),
                (0.138_888_888_888_888_9, -6.167_905_692_361_980_4e-18),
            ],
        ],
        end: [
            (1.666_666_666_666_666_7, -7.401_486_830_834_377e-17),
            (-1.333_333_333_333_333_3, -7.401_486_830_834_377e-17),
            (1.666_666_666_666_666_7, -7.401_486_830_834_377e-17),
        ],
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
            /// The largest correction of a component, relative to it or to the terms of its rate, at which the iteration
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
    last: Option<(ScalarOf<S>, [VecOf<S>; N])>,
    /// By how much the steps of this length missed the continued polynomial of the step before.
    misses: [Misses<VecOf<S>>; N],
    matrices: Option<(ScalarOf<S>, Matrices<S>, VecOf<S>)>,
}

impl<S: Dynamics, const N: usize> Clone for Work<S, N> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<S: Dynamics, const N: usize> Copy for Work<S, N> {}

impl<S: Dynamics, const N: usize> Work<S, N> {
    /// Before any step.
    pub(super) fn none() -> Self {
        let zero = DimOf::<S>::vec(ScalarOf::<S>::ZERO);
        Self { last: None, misses: [Misses::none(zero); N], matrices: None }
    }
}

impl<T: Real, S: Dynamics, J: Linearization<S>, const N: usize> OneStep<S> for Gauss<T, J, N>
where
    S::State: State<Scalar = T>,
    Self: Table<N>,
{
    type Work = Work<S, N>;
    dense_by_cubic!();

    fn work(&self) -> Work<S, N> {
        Work::none()
    }

    #[inline]
    fn forget(&self, work: &mut Work<S, N>) {
        *work = Work::none();
    }

    /// Stages that the next ones start from, and matrices of an iteration, serve states beside theirs.
    fn moved(&self, _work: &mut Work<S, N>) {}

    fn check(&self) -> Result<(), IntegrationError> {
        check_tolerance(self.tolerance)
    }

    fn increment(
        &self,
        start: &Start<'_, S>,
        x: &VecOf<S>,
        h: T,
        work: &mut Work<S, N>,
        statistics: &mut Statistics,
    ) -> Result<VecOf<S>, IntegrationError> {
        self.increment_beyond(start, (x, &DimOf::<S>::vec(T::ZERO)), h, work, statistics)
    }

    fn increment_beyond(
        &self,
        start: &Start<'_, S>,
        (_, rest): (&VecOf<S>, &VecOf<S>),
        h: T,
        work: &mut Work<S, N>,
        statistics: &mut Statistics,
    ) -> Result<VecOf<S>, IntegrationError> {
        let table = &Self::TABLE;
        let (z, rests) =
            settled(table, &self.linearization, self.tolerance, (start, rest), h, work, statistics)?;
        let zero = DimOf::<S>::vec(T::ZERO);
        Ok(table.increment(zero, &z, &rests))
    }
}

/// The stages z of a step, and what rounding has taken from them.
type Stages<S, const N: usize> = ([VecOf<S>; N], [VecOf<S>; N]);

/// The stages of a step, by simplified Newton iterations until their corrections stagnate in round-off.
pub(super) fn settled<T: Real, S: Dynamics, J: Linearization<S>, const N: usize>(
    table: &Collocation<N>,
    linearization: &J,
    tolerance: T,
    (start, rest): (&Start<'_, S>, &VecOf<S>),
    h: T,
    work: &mut Work<S, N>,
    statistics: &mut Statistics,
) -> Result<Stages<S, N>, IntegrationError>
where
    S::State: State<Scalar = T>,
{
    let zero = DimOf::<S>::vec(T::ZERO);
    if is_first_term(h) {
        *work = Work::none();
        statistics.evaluations += 1;
        let slope = start.derivative();
        if first_non_finite::<T>(slope.as_ref()).is_some() {
            return Err(refusal(start, h, (0, T::ZERO), slope.as_ref(), None));
        }
        return Ok((table.nodes.map(|node| displaced(&zero, T::from_f64(node) * h, &slope)), [zero; N]));
    }
    if work.matrices.as_ref().is_some_and(|(length, ..)| *length != h) {
        work.matrices = None;
    }
    let guess = work.last.as_ref().map(|(length, z)| table.extrapolated(zero, z, h / *length));
    if work.last.as_ref().is_some_and(|(length, _)| *length != h) {
        work.misses = [Misses::none(zero); N];
    }
    let mut z = guess.unwrap_or([zero; N]);
    for (z, misses) in z.iter_mut().zip(&work.misses) {
        misses.mend(z);
    }
    let solved = solve(table, linearization, tolerance, (start, rest), h, (z, work), statistics);
    let Ok((z, _)) = &solved else {
        *work = Work::none();
        return solved;
    };
    if let Some(guess) = guess {
        for (misses, (z, guess)) in work.misses.iter_mut().zip(z.iter().zip(&guess)) {
            misses.note(z, guess);
        }
    }
    work.last = Some((h, *z));
    solved
}

/// The same from given starting values.
fn solve<T: Real, S: Dynamics, J: Linearization<S>, const N: usize>(
    table: &Collocation<N>,
    linearization: &J,
    tolerance: T,
    (start, rest): (&Start<'_, S>, &VecOf<S>),
    h: T,
    (mut z, work): ([VecOf<S>; N], &mut Work<S, N>),
    statistics: &mut Statistics,
) -> Result<Stages<S, N>, IntegrationError>
where
    S::State: State<Scalar = T>,
{
    let x = &start.state.to_array();
    let zero = DimOf::<S>::vec(T::ZERO);
    // stored matrices and starting values that fail get one chance more with new ones
    let mut retry = work.last.is_some() || work.matrices.is_some();
    let mut preceding: Option<T> = None;
    let mut rests = [zero; N];
    let mut settling = [Settling::<DimOf<S>, T>::new(); N];
    let mut plateaus = [Plateau::<VecOf<S>, T>::new(); N];
    let mut iterations = 0;
    loop {
        if work.matrices.is_none() {
            let slope = start.derivative();
            let jacobian = linearization.state_jacobian(start, start.time, x, &slope, h, statistics);
            statistics.evaluations += 1;
            statistics.jacobians += 1;
            statistics.factorizations += 2;
            work.matrices = Some((h, table.matrices::<S>(&jacobian, h), reach::<S>(&jacobian, x, h)));
        }
        let Some((_, matrices, reach)) = &work.matrices else { continue };
        let before = (z, rests);
        let change = table.iterate_exactly(start, (x, rest), h, matrices, (&mut z, &mut rests));
        iterations += 1;
        statistics.iterations += 1;
        statistics.evaluations += N as u64;
        let sizes = change.iter().zip(&z).map(|(c, z)| size(c, x, z, reach));
        let residual = sizes.fold(T::ZERO, T::max) / tolerance;
        let ratio = preceding.map(|preceding| residual / preceding);
        let is_small = residual <= T::ONE;
        let stages = settling.iter_mut().zip(change.iter().zip(&z));
        let all = stages.fold(true, |all, (stage, (c, z))| stage.after(c, z, is_small, ratio) & all);
        if all || (is_small && iterations >= MOST_ITERATIONS) {
            return Ok((z, rests));
        }
        let levels = plateaus.iter_mut().zip(&change).map(|(plateau, c)| plateau.is_level(c, residual));
        if levels.fold(true, |all, level| all & level) && residual > T::ONE {
            let mut ahead = |part: T| {
                statistics.evaluations += N as u64;
                let (mut z, mut rests) = before;
                z.iter_mut().zip(&change).for_each(|(z, c)| *z = displaced(z, part, c));
                table.iterate_exactly(start, (x, rest), h, matrices, (&mut z, &mut rests))
            };
            let mut stages = plateaus.iter().zip(change.iter().zip(&z)).enumerate();
            if stages.all(|(stage, (plateau, (c, z)))| {
                let of_stage = |part| ahead(part).get(stage).copied().unwrap_or(zero);
                let permitted = T::EPSILON.sqrt() * largest_of([x, z]);
                plateau.is_rounding(c, permitted, |row| exceeds(row, (c, x, z, reach), tolerance), of_stage)
            }) {
                return Ok((z, rests));
            }
        }
        if !residual.is_finite() || iterations >= MOST_ITERATIONS {
            if !retry {
                let reached = displaced(x, T::ONE, &table.increment(zero, &z, &rests));
                let stages = table.nodes.iter().zip(&before.0);
                let at = |node: f64| start.time + T::from_f64(node) * h;
                let from = stages.map(|(node, z)| (at(*node), displaced(x, T::ONE, z)));
                return Err(refusal(start, h, (iterations, residual), reached.as_ref(), from));
            }
            retry = false;
            (z, rests) = ([zero; N], [zero; N]);
            (work.matrices, preceding, iterations) = (None, None, 0);
            settling = [Settling::new(); N];
            plateaus = [Plateau::new(); N];
            continue;
        }
        if ratio.is_some_and(|ratio| ratio >= T::from_f64(SLOW)) && residual > T::ONE && retry {
            retry = false;
            work.matrices = None;
        }
        preceding = Some(residual);
    }
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
