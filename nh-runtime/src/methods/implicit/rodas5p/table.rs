//! The table of Rodas5P (Steinebach, BIT 63 (2023) 27), for stages uᵢ = Σ γᵢⱼ kⱼ, which save the products
//! with the Jacobian (Hairer, Wanner, Solving Ordinary Differential Equations II, (IV.7.24)–(IV.7.25)).

/// γ.
pub(super) const GAMMA: f64 = 0.211_937_563_194_290_14;
/// The nodes α.
pub(super) const NODES: [f64; 8] = [
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
pub(super) const TIME: [f64; 8] = [
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
pub(super) const A: [[f64; 7]; 8] = [
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
pub(super) const C: [[f64; 7]; 8] = [
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
pub(super) const DENSE: [[f64; 8]; 3] = [
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

#[cfg(test)]
mod tests {
    use std::vec::Vec;

    use super::{A, C, DENSE, GAMMA, NODES, TIME};
    use crate::methods::trees::{Tree, elementary_weights, holds_to, residual, trees};

    const S: usize = 8;
    type Matrix = [[f64; S]; S];

    /// Σ wᵢ rowᵢ.
    fn times(w: &[f64; S], rows: &Matrix) -> [f64; S] {
        std::array::from_fn(|j| (0..S).map(|i| w[i] * rows[i][j]).sum())
    }

    fn padded(rows: &[[f64; S - 1]; S]) -> Matrix {
        rows.map(|row| std::array::from_fn(|j| row.get(j).copied().unwrap_or(0.0)))
    }

    /// Γ = (1/γ − C)⁻¹, by forward substitution, and α = A Γ.
    #[allow(clippy::needless_range_loop)] // the indices of the formula
    fn standard() -> (Matrix, Matrix) {
        let c = padded(&C);
        let mut gamma = [[0.0; S]; S];
        for i in 0..S {
            for j in 0..=i {
                let unit = if i == j { 1.0 } else { 0.0 };
                let known: f64 = (j..i).map(|k| c[i][k] * gamma[k][j]).sum();
                gamma[i][j] = GAMMA * (unit + known);
            }
        }
        (padded(&A).map(|row| times(&row, &gamma)), gamma)
    }

    /// m: the last row of A, with a further 1.
    fn ends() -> [f64; S] {
        let mut m = padded(&A)[S - 1];
        m[S - 1] = 1.0;
        m
    }

    /// Branches that are alone at their root come through β = α + Γ, others through α: theorem IV.7.4 there.
    fn weights(trees: &[Tree]) -> Vec<Vec<f64>> {
        let (alpha, gamma) = standard();
        elementary_weights(trees, S, |phi, alone| {
            let through = |i: usize, j: usize| alpha[i][j] + if alone { gamma[i][j] } else { 0.0 };
            (0..S).map(|i| (0..S).map(|j| through(i, j) * phi[j]).sum()).collect()
        })
    }

    /// The coefficients are given to 16 digits, and those of u are some 10² times those of k.
    const ROUND_OFF: f64 = 1e-12;

    #[test]
    fn the_order_is_5_and_that_of_the_estimate_4() {
        let (_, gamma) = standard();
        let trees = trees(6);
        let phi = weights(&trees);
        let b = times(&ends(), &gamma);
        holds_to(5, ROUND_OFF, |n| residual(&trees, &phi, n, &b, |tree| 1.0 / tree.density));
        // the estimate is the last stage
        let mut last = [0.0; S];
        last[S - 1] = 1.0;
        let e = times(&last, &gamma);
        holds_to(4, ROUND_OFF, |n| residual(&trees, &phi, n, &e, |_| 0.0));
    }

    #[test]
    fn the_order_of_the_dense_output_is_4() {
        let (_, gamma) = standard();
        let trees = trees(5);
        let phi = weights(&trees);
        for s in [0.2, 0.5, 0.9_f64] {
            let m = ends();
            let u: [f64; S] = std::array::from_fn(|i| {
                s * m[i] + s * (1.0 - s) * (DENSE[0][i] + s * (DENSE[1][i] + s * DENSE[2][i]))
            });
            let b = times(&u, &gamma);
            let powers = |tree: &Tree| s.powi(i32::try_from(tree.order).unwrap()) / tree.density;
            holds_to(4, 10.0 * ROUND_OFF, |n| residual(&trees, &phi, n, &b, powers));
        }
    }

    /// With αᵢ = Σ αᵢⱼ and γᵢ = Σ γᵢⱼ a system that depends on time is integrated as the autonomous one in
    /// which the time is a component: (IV.7.4a) there.
    #[test]
    fn time_is_a_component_like_others() {
        let (alpha, gamma) = standard();
        for i in 0..S {
            assert!((alpha[i].iter().sum::<f64>() - NODES[i]).abs() < ROUND_OFF, "{i}");
            assert!((gamma[i].iter().sum::<f64>() - TIME[i]).abs() < ROUND_OFF, "{i}");
        }
    }

    /// L-stability at infinity: R(∞) = 1 − b B⁻¹ 1 = 0, and the stages at the end of the step are stiffly
    /// accurate: b is the last row of β.
    #[test]
    fn it_is_stiffly_accurate() {
        let (alpha, gamma) = standard();
        let b = times(&ends(), &gamma);
        for j in 0..S {
            assert!((alpha[S - 1][j] + gamma[S - 1][j] - b[j]).abs() < ROUND_OFF, "{j}");
        }
    }
}
