//! Stiff problems of the literature with their Jacobians (Hairer, Wanner, Solving Ordinary Differential
//! Equations II, section IV.10; Mazzia, Magherini, Test Set for Initial Value Problem Solvers, 2008).

use nonholonomic::prelude::*;
use nonholonomic::{D, Jacobian};

/// A state of N numbers.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Numbers<const N: usize>(pub(crate) [f64; N]);

macro_rules! state {
    ($($n:literal)*) => {$(
        impl State for Numbers<$n> {
            type Scalar = f64;
            type Dim = D<$n>;
            fn to_array(&self) -> [f64; $n] {
                self.0
            }
            fn from_array(x: [f64; $n]) -> Self {
                Self(x)
            }
            fn names() -> [&'static str; $n] {
                ["x"; $n]
            }
        }
    )*};
}
state!(2 3 4 8 20 40);

/// A problem: its equations, and what it is measured by.
pub(crate) trait Problem<const N: usize>: Jacobian<State = Numbers<N>, Input = ()> + Copy {
    const NAME: &'static str;
    const START: [f64; N];
    const END: f64;
    /// The solution at the end.
    const SOLUTION: [f64; N];
    /// Components below it do not count.
    const NEGLIGIBLE: f64 = 0.0;
    /// The absolute tolerance that is usual with a relative one.
    fn atol(rtol: f64) -> f64;
}

macro_rules! system {
    ($name:ident, $n:literal, $f:expr, $jacobian:expr) => {
        #[derive(Clone, Copy, Debug)]
        pub(crate) struct $name;
        impl nonholonomic::Dynamics for $name {
            type State = Numbers<$n>;
            type Input = ();
            fn derivative(&self, _t: f64, state: &Numbers<$n>, (): &()) -> Numbers<$n> {
                let f: fn(&[f64; $n]) -> [f64; $n] = $f;
                Numbers(f(&state.0))
            }
        }
        impl nonholonomic::Jacobian for $name {
            type InputDim = nonholonomic::D<0>;
            fn state_jacobian(&self, _t: f64, state: &Numbers<$n>, (): &()) -> [[f64; $n]; $n] {
                let jacobian: fn(&[f64; $n]) -> [[f64; $n]; $n] = $jacobian;
                jacobian(&state.0)
            }
            fn input_jacobian(&self, _t: f64, _state: &Numbers<$n>, (): &()) -> [[f64; 0]; $n] {
                [[]; $n]
            }
        }
    };
}
pub(crate) use system;

system!(VanDerPol, 2, |[a, b]| [*b, ((1.0 - a * a) * b - a) / 1e-6], |[a, b]| [
    [0.0, 1.0],
    [(-2.0 * a * b - 1.0) / 1e-6, (1.0 - a * a) / 1e-6]
]);

impl Problem<2> for VanDerPol {
    const NAME: &'static str = "VDPOL";
    const START: [f64; 2] = [2.0, 0.0];
    const END: f64 = 2.0;
    const SOLUTION: [f64; 2] = [1.706_167_732_170_465, -0.892_809_701_024_816_5];
    fn atol(rtol: f64) -> f64 {
        rtol
    }
}

system!(
    Robertson,
    3,
    |[a, b, c]| {
        let (first, last) = (-0.04 * a + 1e4 * b * c, 3e7 * b * b);
        [first, -first - last, last]
    },
    |[_, b, c]| [[-0.04, 1e4 * c, 1e4 * b], [0.04, -1e4 * c - 6e7 * b, -1e4 * b], [0.0, 6e7 * b, 0.0],]
);

impl Problem<3> for Robertson {
    const NAME: &'static str = "ROBER";
    const START: [f64; 3] = [1.0, 0.0, 0.0];
    const END: f64 = 1e11;
    const SOLUTION: [f64; 3] = [2.083_340_149_701_282e-8, 8.333_360_770_334_733e-14, 0.999_999_979_166_516_5];
    fn atol(rtol: f64) -> f64 {
        1e-6 * rtol
    }
}

system!(
    Oregonator,
    3,
    |[a, b, c]| [77.27 * (b + a * (1.0 - 8.375e-6 * a - b)), (c - (1.0 + a) * b) / 77.27, 0.161 * (a - c),],
    |[a, b, _]| [
        [77.27 * (1.0 - 2.0 * 8.375e-6 * a - b), 77.27 * (1.0 - a), 0.0],
        [-b / 77.27, -(1.0 + a) / 77.27, 1.0 / 77.27],
        [0.161, 0.0, -0.161],
    ]
);

impl Problem<3> for Oregonator {
    const NAME: &'static str = "OREGO";
    const START: [f64; 3] = [1.0, 2.0, 3.0];
    const END: f64 = 360.0;
    const SOLUTION: [f64; 3] = [1.000_814_870_318_522_7, 1_228.178_521_549_888, 132.055_494_284_650_93];
    fn atol(rtol: f64) -> f64 {
        1e-6 * rtol
    }
}

system!(
    Hires,
    8,
    |y| {
        let [y1, y2, y3, y4, y5, y6, y7, y8] = *y;
        let seventh = 280.0 * y6 * y8 - 1.81 * y7;
        [
            -1.71 * y1 + 0.43 * y2 + 8.32 * y3 + 0.0007,
            1.71 * y1 - 8.75 * y2,
            -10.03 * y3 + 0.43 * y4 + 0.035 * y5,
            8.32 * y2 + 1.71 * y3 - 1.12 * y4,
            -1.745 * y5 + 0.43 * y6 + 0.43 * y7,
            -280.0 * y6 * y8 + 0.69 * y4 + 1.71 * y5 - 0.43 * y6 + 0.69 * y7,
            seventh,
            -seventh,
        ]
    },
    |y| {
        let [.., y6, _, y8] = *y;
        let (by_6, by_8) = (280.0 * y8, 280.0 * y6);
        [
            [-1.71, 0.43, 8.32, 0.0, 0.0, 0.0, 0.0, 0.0],
            [1.71, -8.75, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
            [0.0, 0.0, -10.03, 0.43, 0.035, 0.0, 0.0, 0.0],
            [0.0, 8.32, 1.71, -1.12, 0.0, 0.0, 0.0, 0.0],
            [0.0, 0.0, 0.0, 0.0, -1.745, 0.43, 0.43, 0.0],
            [0.0, 0.0, 0.0, 0.69, 1.71, -0.43 - by_6, 0.69, -by_8],
            [0.0, 0.0, 0.0, 0.0, 0.0, by_6, -1.81, by_8],
            [0.0, 0.0, 0.0, 0.0, 0.0, -by_6, 1.81, -by_8],
        ]
    }
);

impl Problem<8> for Hires {
    const NAME: &'static str = "HIRES";
    const START: [f64; 8] = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0057];
    const END: f64 = 321.8122;
    const SOLUTION: [f64; 8] = [
        7.371_312_573_325_668e-4,
        1.442_485_726_316_185e-4,
        5.888_729_740_967_576e-5,
        1.175_651_343_283_149_2e-3,
        2.386_356_198_831_332e-3,
        6.238_968_252_742_796e-3,
        2.849_998_395_185_774e-3,
        2.850_001_604_814_226e-3,
    ];
    fn atol(rtol: f64) -> f64 {
        1e-4 * rtol
    }
}

system!(
    E5,
    4,
    |[y1, y2, y3, y4]| {
        let (first, second) = (7.89e-10 * y1, 1.1e7 * y1 * y3);
        let (third, fourth) = (1.13e9 * y2 * y3, 1.13e3 * y4);
        let (f2, f4) = (first - third, second - fourth);
        [-first - second, f2, f2 - f4, f4]
    },
    |[y1, y2, y3, _]| {
        let (a, b, cm, c) = (7.89e-10, 1.1e7, 1.13e9, 1.13e3);
        [
            [-a - b * y3, 0.0, -b * y1, 0.0],
            [a, -cm * y3, -cm * y2, 0.0],
            [a - b * y3, -cm * y3, -b * y1 - cm * y2, c],
            [b * y3, 0.0, b * y1, -c],
        ]
    }
);

impl Problem<4> for E5 {
    const NAME: &'static str = "E5";
    const START: [f64; 4] = [1.76e-3, 0.0, 0.0, 0.0];
    const END: f64 = 1e9;
    const SOLUTION: [f64; 4] = [
        3.131_714_832_935_699_6e-14,
        1.484_095_795_287_006_4e-16,
        1.484_095_794_834_569_1e-16,
        4.524_372_827_978_262e-26,
    ];
    // the last component is below the absolute tolerance
    const NEGLIGIBLE: f64 = 1e-20;
    fn atol(_rtol: f64) -> f64 {
        1.7e-24
    }
}

/// The cells of the Brusselator.
const CELLS: usize = 20;
/// 0.02 over the square of their distance.
const DIFFUSION: f64 = 0.02 * 21.0 * 21.0;

system!(
    Brusselator,
    40,
    |y| {
        let mut f = [0.0; 40];
        let at = |i: usize| if (1..=CELLS).contains(&i) { (y[2 * i - 2], y[2 * i - 1]) } else { (1.0, 3.0) };
        for i in 1..=CELLS {
            let ((u0, v0), (u, v), (u2, v2)) = (at(i - 1), at(i), at(i + 1));
            f[2 * i - 2] = 1.0 + u * u * v - 4.0 * u + DIFFUSION * (u0 - 2.0 * u + u2);
            f[2 * i - 1] = 3.0 * u - u * u * v + DIFFUSION * (v0 - 2.0 * v + v2);
        }
        f
    },
    |y| {
        let mut jacobian = [[0.0; 40]; 40];
        for (i, pair) in y.as_chunks::<2>().0.iter().enumerate() {
            let ([u, v], k) = (*pair, 2 * i);
            jacobian[k][k] = 2.0 * u * v - 4.0 - 2.0 * DIFFUSION;
            jacobian[k][k + 1] = u * u;
            jacobian[k + 1][k] = 3.0 - 2.0 * u * v;
            jacobian[k + 1][k + 1] = -u * u - 2.0 * DIFFUSION;
            for row in [k, k + 1] {
                if i > 0 {
                    jacobian[row][row - 2] = DIFFUSION;
                }
                if i + 1 < CELLS {
                    jacobian[row][row + 2] = DIFFUSION;
                }
            }
        }
        jacobian
    }
);

impl Problem<40> for Brusselator {
    const NAME: &'static str = "BRUSS";
    const START: [f64; 40] = BRUSSELATOR_START;
    const END: f64 = 10.0;
    const SOLUTION: [f64; 40] = BRUSSELATOR_END;
    fn atol(rtol: f64) -> f64 {
        rtol
    }
}

/// u = 1 + sin(2πx)/2, v = 3 at x = i/21.
const BRUSSELATOR_START: [f64; 40] = [
    1.147_377_587_205_452_1,
    3.0,
    1.281_660_029_031_811,
    3.0,
    1.390_915_741_234_015,
    3.0,
    1.465_436_874_322_102_2,
    3.0,
    1.498_601_898_590_59,
    3.0,
    1.487_463_956_090_911_8,
    3.0,
    1.433_012_701_892_219_4,
    3.0,
    1.340_086_368_885_459_6,
    3.0,
    1.216_941_869_558_779,
    3.0,
    1.074_521_133_088_087_3,
    3.0,
    0.925_478_866_911_913,
    3.0,
    0.783_058_130_441_221,
    3.0,
    0.659_913_631_114_540_3,
    3.0,
    0.566_987_298_107_780_8,
    3.0,
    0.512_536_043_909_088_2,
    3.0,
    0.501_398_101_409_41,
    3.0,
    0.534_563_125_677_898,
    3.0,
    0.609_084_258_765_985,
    3.0,
    0.718_339_970_968_188_6,
    3.0,
    0.852_622_412_794_547_6,
    3.0,
];

/// The solution at 10, by the method Radau IIA of order 5 in numbers of 33 digits with the tolerance 10⁻¹⁷.
const BRUSSELATOR_END: [f64; 40] = [
    0.879_975_745_768_899_1,
    3.126_929_998_390_441,
    0.770_864_209_702_487_4,
    3.240_692_656_764_195,
    0.678_844_495_149_063_1,
    3.333_678_508_462_712,
    0.605_630_199_242_518_9,
    3.403_878_245_705_626,
    0.549_943_622_892_769_2,
    3.453_283_593_676_075_7,
    0.509_117_193_422_713_1,
    3.485_928_530_145_413,
    0.480_243_219_950_997_5,
    3.506_338_849_365_164_4,
    0.460_793_950_013_589_6,
    3.518_580_578_238_063_7,
    0.448_864_154_755_857_9,
    3.525_792_659_474_769,
    0.443_214_619_531_55,
    3.530_016_448_015_490_3,
    0.443_243_923_864_134_2,
    3.532_167_043_758_295,
    0.448_959_482_757_831_2,
    3.532_048_663_897_025,
    0.460_977_298_644_521_3,
    3.528_369_045_789_21,
    0.480_549_448_653_469_8,
    3.518_753_751_912_418,
    0.509_587_940_825_060_2,
    3.499_806_719_579_819_7,
    0.550_612_481_687_274_3,
    3.467_314_691_654_263_6,
    0.606_495_218_637_364_7,
    3.416_746_894_555_47,
    0.679_829_795_454_383_3,
    3.344_227_087_334_942_4,
    0.771_787_711_196_218_3,
    3.248_072_364_643_563_4,
    0.880_563_488_685_161,
    3.130_682_054_767_363,
];
