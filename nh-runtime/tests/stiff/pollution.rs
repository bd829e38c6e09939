//! The problem POLLU of the test sets, 25 reactions of 20 pollutants of the air (Verwer, Gauss–Seidel iteration for
//! stiff ODEs from chemical kinetics, SIAM J. Sci. Comput. 15 (1994); Mazzia, Magherini, Test Set for Initial Value
//! Problem Solvers, 2008).

use crate::problems::{Numbers, Problem, system};

/// A rate, the pollutants that react, counted from 1, and those that they become.
type Reaction = (f64, &'static [usize], &'static [usize]);

const REACTIONS: [Reaction; 25] = [
    (0.35, &[1], &[2, 3]),
    (26.6, &[2, 4], &[1]),
    (1.23e4, &[5, 2], &[1, 6]),
    (8.6e-4, &[7], &[8, 5, 5]),
    (8.2e-4, &[7], &[8]),
    (1.5e4, &[7, 6], &[8, 5]),
    (1.3e-4, &[9], &[10, 5, 8]),
    (2.4e4, &[9, 6], &[11]),
    (1.65e4, &[11, 2], &[1, 10, 12]),
    (9e3, &[11, 1], &[13]),
    (0.022, &[13], &[11, 1]),
    (1.2e4, &[10, 2], &[1, 14]),
    (1.88, &[14], &[7, 5]),
    (1.63e4, &[1, 6], &[15]),
    (4.8e6, &[3], &[4]),
    (3.5e-4, &[4], &[16]),
    (0.0175, &[4], &[3]),
    (1e8, &[16], &[6, 6]),
    (4.44e11, &[16], &[3]),
    (1240.0, &[17, 6], &[18, 5]),
    (2.1, &[19], &[2]),
    (5.78, &[19], &[1, 3]),
    (0.0474, &[1, 4], &[19]),
    (1780.0, &[19, 1], &[20]),
    (3.12, &[20], &[1, 19]),
];

system!(
    Pollution,
    20,
    |y| {
        let mut f = [0.0; 20];
        for (rate, from, to) in REACTIONS {
            let speed: f64 = rate * from.iter().map(|i| y[i - 1]).product::<f64>();
            for i in from {
                f[i - 1] -= speed;
            }
            for i in to {
                f[i - 1] += speed;
            }
        }
        f
    },
    |y| {
        let mut jacobian = [[0.0; 20]; 20];
        for (rate, from, to) in REACTIONS {
            for j in from {
                let slope: f64 = rate * from.iter().filter(|i| *i != j).map(|i| y[i - 1]).product::<f64>();
                for i in from {
                    jacobian[i - 1][j - 1] -= slope;
                }
                for i in to {
                    jacobian[i - 1][j - 1] += slope;
                }
            }
        }
        jacobian
    }
);

impl Problem<20> for Pollution {
    const NAME: &'static str = "POLLU";
    const START: [f64; 20] = [
        0.0, 0.2, 0.0, 0.04, 0.0, 0.0, 0.1, 0.3, 0.01, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.007, 0.0, 0.0,
        0.0,
    ];
    const END: f64 = 60.0;
    // by the code RADAU5 with the tolerance 1e-12, to twelve digits
    const SOLUTION: [f64; 20] = [
        5.646_255_479_97e-2,
        1.342_484_130_43e-1,
        4.139_734_331_06e-9,
        5.523_140_207_64e-3,
        2.018_977_262_44e-7,
        1.464_541_863_6e-7,
        7.784_249_119_02e-2,
        3.245_075_353_39e-1,
        7.494_013_383_92e-3,
        1.622_293_157_41e-8,
        1.135_863_833_33e-8,
        2.230_505_975_68e-3,
        2.087_162_882_8e-4,
        1.396_921_017_38e-5,
        8.964_884_856_92e-3,
        4.352_846_369_45e-18,
        6.899_219_696_26e-3,
        1.007_803_037_35e-4,
        1.772_146_514_09e-6,
        5.682_943_292_71e-5,
    ];
    const NEGLIGIBLE: f64 = 0.01;
    fn atol(rtol: f64) -> f64 {
        0.01 * rtol
    }
}
