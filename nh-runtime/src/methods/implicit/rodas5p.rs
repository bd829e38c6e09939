//! The Rosenbrock method Rodas5P.

use super::collocation::{shifted, weighted};
use super::linearization::{Analytic, FiniteDifferences, Linearization};
use crate::arrays::{all_finite, displaced, first_non_finite, nought};
use crate::linear::Factors;
use crate::methods::adaptive::{Adaptive, Scheme, Trial};
use crate::methods::{Arrival, Start};
use crate::tolerance::{Tolerance, Uniform};
use crate::{Dim, DimOf, Dynamics, MatOf, Real, Scalar, ScalarOf, State, Statistics, VecOf};

/// The adaptive Rosenbrock method Rodas5P with eight stages, of order 5 with an error estimate of order
/// 4 and a continuous extension of order 4: L-stable, for stiff systems (Steinebach, Construction of
/// Rosenbrock–Wanner method Rodas5P and numerical benchmarks within the Julia Differential Equations
/// package, BIT 63 (2023) 27; Hairer, Wanner, Solving Ordinary Differential Equations II, section IV.7).
///
/// There is nothing to iterate: a step forms the Jacobian and factorizes one real matrix. The order
/// rests on the Jacobian: take [that of the system](Self::with_jacobian) where there is one rather
/// than difference quotients. ∂f/∂t is a difference quotient.
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

/// γ.
const GAMMA: f64 = 0.211_937_563_194_290_14;
/// The nodes α.
const NODES: [f64; 8] = [
    0.0,
    0.635_812_689_582_870_4,
    0.409_579_839_339_753_5,
    0.976_930_672_506_071_6,
    0.428_840_360_955_866_4,
    1.0,
    1.0,
    1.0,
];
/// The weights γᵢ of ∂f/∂t.
const TIME: [f64; 8] = [
    0.211_937_563_194_290_14,
    -0.423_875_126_388_580_27,
    -0.338_462_712_623_592_4,
    1.804_645_287_288_273_4,
    2.325_825_639_765_069,
    0.0,
    0.0,
    0.0,
];
/// aᵢⱼ; the last row with a further 1 is m.
const A: [[f64; 7]; 8] = [
    [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [3.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [2.849_394_379_747_939, 0.458_422_422_044_639_23, 0.0, 0.0, 0.0, 0.0, 0.0],
    [-6.954_028_509_809_101, 2.489_845_061_869_568, -10.358_996_098_473_584, 0.0, 0.0, 0.0, 0.0],
    [
        2.802_998_627_562_896_4,
        0.507_246_473_622_820_6,
        -0.398_831_254_177_052_4,
        -0.047_211_872_304_046_41,
        0.0,
        0.0,
        0.0,
    ],
    [
        -7.502_846_399_306_121,
        2.561_846_144_803_919,
        -11.627_539_656_261_098,
        -0.182_687_676_599_422_56,
        0.030_198_172_008_377_946,
        0.0,
        0.0,
    ],
    [
        -7.502_846_399_306_121,
        2.561_846_144_803_919,
        -11.627_539_656_261_098,
        -0.182_687_676_599_422_56,
        0.030_198_172_008_377_946,
        1.0,
        0.0,
    ],
    [
        -7.502_846_399_306_121,
        2.561_846_144_803_919,
        -11.627_539_656_261_098,
        -0.182_687_676_599_422_56,
        0.030_198_172_008_377_946,
        1.0,
        1.0,
    ],
];
/// cᵢⱼ.
const C: [[f64; 7]; 8] = [
    [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [-14.155_112_264_123_755, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [-17.972_960_358_859_52, -2.859_693_295_451_294, 0.0, 0.0, 0.0, 0.0, 0.0],
    [147.121_502_757_117_16, -1.412_214_027_182_13, 71.689_402_513_023_58, 0.0, 0.0, 0.0, 0.0],
    [
        165.435_170_248_716_76,
        -0.459_282_345_649_112_6,
        42.909_383_369_586_03,
        -5.961_986_721_573_306,
        0.0,
        0.0,
        0.0,
    ],
    [
        24.854_864_614_690_072,
        -3.000_922_700_283_218_6,
        47.493_111_002_076_8,
        5.581_419_782_155_812_5,
        -0.661_069_182_524_947_1,
        0.0,
        0.0,
    ],
    [
        30.912_732_140_285_99,
        -3.120_824_334_993_797_4,
        77.799_546_460_708_92,
        34.286_460_282_947_83,
        -19.097_331_116_725_623,
        -28.087_943_162_872_662,
        0.0,
    ],
    [
        37.802_771_233_905_63,
        -3.257_196_902_907_227_6,
        112.269_188_494_963_27,
        66.934_723_124_404_7,
        -40.066_189_370_910_02,
        -54.667_802_628_779_68,
        -9.488_616_523_096_27,
    ],
];
/// The coefficients of the dense output.
const DENSE: [[f64; 8]; 3] = [
    [
        25.948_786_856_663_858,
        -2.557_972_484_584_623_5,
        10.433_815_404_888_879,
        -2.367_925_102_268_520_4,
        0.524_948_541_321_073,
        1.124_108_831_045_040_4,
        0.427_287_619_443_187_4,
        -0.172_022_210_701_554_93,
    ],
    [
        -9.915_688_506_951_71,
        -0.968_994_459_411_515_4,
        3.043_803_724_297_845_3,
        -24.495_224_566_215_796,
        20.176_138_334_709_044,
        15.980_663_614_246_51,
        -6.789_040_303_419_874,
        -6.710_236_069_923_372,
    ],
    [
        11.419_903_575_922_262,
        2.887_964_514_613_699_4,
        72.921_379_959_960_29,
        80.125_118_346_226_43,
        -52.072_871_366_152_654,
        -59.789_936_252_667_29,
        -0.155_826_842_827_519_13,
        4.883_087_185_713_722,
    ],
];

/// What is kept of a step.
pub struct Work<S: Dynamics> {
    /// f, ∂f/∂x and ∂f/∂t at the start.
    first: VecOf<S>,
    jacobian: MatOf<S>,
    by_time: VecOf<S>,
    /// Whether the latter two belong to the present start.
    linearized: bool,
    /// The stages u.
    stages: [VecOf<S>; 8],
    /// The start and the length of the step that the stages belong to.
    step: Option<(ScalarOf<S>, ScalarOf<S>)>,
}

impl<S: Dynamics> Clone for Work<S> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<S: Dynamics> Copy for Work<S> {}

/// ∂f/∂t by a difference quotient, forwards or else backwards.
fn by_time<S: Dynamics>(start: &Start<'_, S>, first: &VecOf<S>, statistics: &mut Statistics) -> VecOf<S>
where
    ScalarOf<S>: Real,
{
    let x = start.state.to_array();
    let least = ScalarOf::<S>::from_f64(1e-5);
    // the increment of the code RODAS (Hairer, Wanner II, section IV.7)
    let delta = (ScalarOf::<S>::EPSILON * start.time.abs().max(least)).sqrt();
    for delta in [delta, -delta] {
        let there = start.time + delta;
        let mut slope = start.derivative_at(there, x);
        statistics.evaluations += 1;
        if all_finite::<ScalarOf<S>, _>(&slope) {
            for (s, f) in slope.as_mut().iter_mut().zip(first.as_ref()) {
                *s = (*s - *f) / (there - start.time);
            }
            return slope;
        }
    }
    DimOf::<S>::vec(ScalarOf::<S>::ZERO)
}

impl<J> Rodas<J> {
    /// Computes the stages of a step and gives its end.
    fn stages<S: Dynamics>(start: &Start<'_, S>, h: ScalarOf<S>, work: &mut Work<S>) -> VecOf<S>
    where
        ScalarOf<S>: Real,
    {
        let w = ScalarOf::<S>::from_f64;
        let one = ScalarOf::<S>::ONE;
        let zero = DimOf::<S>::vec(ScalarOf::<S>::ZERO);
        let x = start.state.to_array();
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
            let right = displaced(&coupled, w(*time) * h, &work.by_time);
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
            by_time: zero,
            linearized: false,
            stages: [zero; 8],
            step: None,
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
        work.linearized = false;
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
        if !work.linearized {
            let jacobian = self.linearization.state_jacobian(start, start.time, &x, &work.first, statistics);
            work.jacobian = jacobian;
            work.by_time = by_time(start, &work.first, statistics);
            statistics.jacobians += 1;
            work.linearized = work.jacobian.as_ref().iter().all(all_finite::<ScalarOf<S>, _>);
            if !work.linearized {
                // an infinite entry would take its stages for zero
                return Trial { state: x, error: ScalarOf::<S>::ZERO.recip() };
            }
        }
        statistics.factorizations += 1;
        statistics.evaluations += 7;
        let state = Self::stages(start, h, work);
        let [.., defect] = &work.stages;
        let error = tolerance.mean_square(defect, &x, &state).sqrt();
        Trial { state, error: error + nought(&state) }
    }

    fn accept<const KEEP: bool>(&self, start: &Start<'_, S>, h: ScalarOf<S>, work: &mut Work<S>) {
        work.step = Some((start.time, h));
    }

    #[cold]
    fn blame(&self, start: &Start<'_, S>, h: ScalarOf<S>, work: &Work<S>) -> Option<((usize, f64), f64)> {
        let x = start.state.to_array();
        let zero = DimOf::<S>::vec(ScalarOf::<S>::ZERO);
        let [known @ .., _] = &work.stages;
        A.iter().zip(NODES).find_map(|(a, node)| {
            let state = displaced(&x, ScalarOf::<S>::ONE, &weighted(zero, a, known));
            let slope = start.derivative_at(start.time + ScalarOf::<S>::from_f64(node) * h, state);
            first_non_finite::<ScalarOf<S>>(slope.as_ref()).map(|found| (found, node))
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
        let x = start.state.to_array();
        again.jacobian = self.linearization.state_jacobian(start, start.time, &x, &again.first, statistics);
        again.by_time = by_time(start, &again.first, statistics);
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
