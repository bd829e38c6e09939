//! A platform on six legs (Gough, Stewart): six loops in space. Each leg is a tube on the ground and a rod at the platform,
//! with their masses, pushed apart along the leg. Everything is declared by where it is; what it is compared with comes
//! from `tests/reference/stewart.py`.

use nonholonomic::prelude::*;

macro_rules! stewart {
    ($(#[$doc:meta])* $name:ident: $($more:tt)*) => {
        $(#[$doc])*
        #[nonholonomic(
            base { p[3], yaw, pitch, roll, leg[6] }

            let attitude = rot_z(yaw) * rot_y(pitch) * rot_x(roll);
            let tip[k in 0..6] = p + attitude * joint[k];
            let strut[k in 0..6] = tip[k] - foot[k];
            let along[k in 0..6] = strut[k] / leg[k];
            let tube[k in 0..6] = foot[k] + low * along[k];
            let rod[k in 0..6] = tip[k] - high * along[k];

            holonomic { for k in 0..6 { length: dot(strut[k], strut[k]) = leg[k]^2; } }
            lagrangian {
                kinetic(M, I, p, attitude) - M * g * p[2]
                + sum(k in 0..6: kinetic(m[0], tube[k]) + kinetic(m[1], rod[k]) + kinetic(J, along[k])
                    - g * (m[0] * tube[k][2] + m[1] * rod[k][2]))
            }
            inputs { push[6] }
            forces { for k in 0..6 { leg[k]: push[k]; } }
            units {
                p, leg, foot, joint, low, high = m; yaw, pitch, roll = rad; M, m = kg; I, J = kg m^2; g = m/s^2;
                push = N;
            }
            $($more)*
        )]
        #[derive(Clone, Copy, Debug)]
        struct $name {
            /// Where the legs stand, and where they are joined to the platform, in its axes.
            foot: [[f64; 3]; 6],
            joint: [[f64; 3]; 6],
            /// The platform.
            M: f64,
            I: [f64; 3],
            /// Tubes and rods, and how far their centres of mass are from the joints of theirs.
            m: [f64; 2],
            low: f64,
            high: f64,
            /// The moment of inertia of tube and rod across the leg.
            J: f64,
            g: f64,
        }

        impl $name {
            const MODEL: Self = Self {
                foot: [
                    [0.98, -0.17, 0.0],
                    [0.97, 0.19, 0.02],
                    [-0.34, 0.94, 0.0],
                    [-0.65, 0.77, -0.01],
                    [-0.64, -0.78, 0.03],
                    [-0.33, -0.95, 0.0],
                ],
                joint: [
                    [0.32, -0.38, -0.05],
                    [0.33, 0.37, -0.04],
                    [0.16, 0.47, -0.05],
                    [-0.49, 0.08, -0.06],
                    [-0.48, -0.1, -0.05],
                    [0.17, -0.46, -0.03],
                ],
                M: 25.0,
                I: [1.1, 1.4, 2.1],
                m: [2.5, 1.5],
                low: 0.3,
                high: 0.35,
                J: 0.15,
                g: 9.81,
            };
        }
    };
}

stewart!(
    /// All velocities, with the multipliers of the legs.
    Stewart: emit { multipliers }
);
stewart!(
    /// The velocities of the platform, which determine those of the legs as long as these have a length.
    OnItsLegs: independent { der(p), der(yaw), der(pitch), der(roll) }
);

const MACHINE: Stewart = Stewart::MODEL;

const STATE: StewartState = StewartState {
    p: [0.05, -0.08, 0.9],
    yaw: 0.2,
    pitch: -0.15,
    roll: 0.1,
    leg: [
        1.034_276_882_155_997_6,
        1.156_616_868_674_434_5,
        1.152_502_511_230_948_6,
        1.185_247_121_223_655,
        0.935_520_610_688_161_8,
        1.162_953_945_856_191,
    ],
    p_dot: [0.3, -0.2, 0.4],
    yaw_dot: 0.5,
    pitch_dot: -0.7,
    roll_dot: 0.6,
    leg_dot: [
        0.070_968_715_943_401_5,
        0.656_485_686_745_361_9,
        0.712_622_642_755_597_6,
        0.433_786_024_417_284_25,
        -0.055_607_475_595_521_226,
        0.500_829_282_659_011_8,
    ],
};

/// What is pushed there.
const PUSH: StewartInput = StewartInput { push: [110.0, 45.0, 70.0, 95.0, 60.0, 88.0] };

fn are_equal(found: &[f64], expected: &[f64], within: f64) {
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() < within, "{found} {expected}");
    }
}

#[test]
fn accelerations_and_the_multipliers_of_the_legs() {
    let rates = MACHINE.derivative(0.0, &STATE, &PUSH).to_array();
    let expected = [
        0.815_038_315_415_313_7,
        -1.517_427_732_556_157,
        0.534_241_440_216_366_4,
        6.517_997_579_639_933,
        -5.675_202_921_815_708,
        -11.931_219_990_937_285,
        4.814_305_938_814_14,
        -0.230_351_996_698_828,
        -3.408_757_429_496_545_5,
        2.076_510_179_071_494,
        -2.091_103_819_285_623,
        6.919_971_106_819_827,
    ];
    are_equal(&rates[12..], &expected, 1e-13);
    let multipliers = MACHINE.multipliers(0.0, &STATE, &PUSH).length;
    let expected = [
        52.851_971_848_679_13,
        20.163_367_288_026_958,
        31.708_397_558_779_044,
        40.210_759_587_213_83,
        33.675_246_505_283_87,
        37.090_321_338_852_93,
    ];
    are_equal(&multipliers, &expected, 1e-12);
    assert!((MACHINE.energy(0.0, &STATE) - 313.591_103_016_837_54).abs() < 1e-12);
    let StewartState { p, yaw, pitch, roll, leg, p_dot, yaw_dot, pitch_dot, roll_dot, .. } = STATE;
    let state = OnItsLegsState { p, yaw, pitch, roll, leg, p_dot, yaw_dot, pitch_dot, roll_dot };
    let push = OnItsLegsInput { push: PUSH.push };
    let adapted = OnItsLegs::MODEL.derivative(0.0, &state, &push).to_array();
    are_equal(&adapted[..12], &rates[..12], 1e-15);
    are_equal(&adapted[12..], &rates[12..18], 1e-13);
}

/// The platform lies where it is, and the legs are all guessed to be one metre long.
#[test]
fn legs_are_assembled_to_a_platform() {
    use StewartCoordinate::{leg_0, leg_1, leg_2, leg_3, leg_4, leg_5, p_0, p_1, p_2, pitch, roll, yaw};
    let rough = StewartState { leg: [1.0; 6], leg_dot: [0.0; 6], ..STATE };
    let found = MACHINE.assemble_holding(0.0, &rough, &[p_0, p_1, p_2, yaw, pitch, roll]).unwrap();
    are_equal(&found.to_array(), &STATE.to_array(), 1e-15);
    // the other way round, from where the platform is level: the legs are given, as they are in a machine
    let level =
        StewartState { p: [0.0, 0.0, 0.8], yaw: 0.0, pitch: 0.0, roll: 0.0, p_dot: [0.0; 3], ..STATE };
    let legs = [leg_0, leg_1, leg_2, leg_3, leg_4, leg_5];
    let found = MACHINE.assemble_holding(0.0, &level, &legs).unwrap();
    are_equal(&found.to_array(), &STATE.to_array(), 2e-14);
    // and with nothing held
    let found = MACHINE.assemble(0.0, &rough).unwrap();
    let left: [f64; 12] = MACHINE.constraint_residual(0.0, &found).into();
    are_equal(&left, &[0.0; 12], 1e-15);
}

#[test]
fn a_run_keeps_the_loops_and_the_energy() {
    let mut sim = Integrator::new(MACHINE, Dop853::new().rtol(1e-13).atol(1e-13), 0.0, STATE);
    sim.set_input(PUSH);
    // what is pushed with these forces has a potential
    let energy = |state: &StewartState| {
        let work = PUSH.push.iter().zip(&state.leg).map(|(push, leg)| push * leg);
        MACHINE.energy(0.0, state) - work.sum::<f64>()
    };
    let start = energy(&STATE);
    for tenth in 1..=10 {
        sim.advance_to(f64::from(tenth) / 10.0).unwrap();
        let left: [f64; 12] = MACHINE.constraint_residual(0.0, sim.state()).into();
        are_equal(&left, &[0.0; 12], 3e-14);
        are_equal(&[energy(sim.state())], &[start], 1e-11);
    }
}

/// What holds it at rest: the forces of the reference, and where legs weigh nothing those whose sum and moment carry the
/// platform, Σ Fₖ nₖ = M g e₃ and Σ Fₖ (attitude jointₖ) × nₖ = 0.
#[test]
fn legs_that_hold_the_platform() {
    let rest = StewartState {
        p_dot: [0.0; 3],
        yaw_dot: 0.0,
        pitch_dot: 0.0,
        roll_dot: 0.0,
        leg_dot: [0.0; 6],
        ..STATE
    };
    let push = [
        87.436_953_220_689_89,
        72.634_632_899_487_78,
        58.532_873_625_192_57,
        61.291_495_252_735_76,
        115.521_851_415_331_41,
        39.264_250_908_986_95,
    ];
    let rates = MACHINE.derivative(0.0, &rest, &StewartInput { push }).to_array();
    are_equal(&rates[12..], &[0.0; 12], 1e-13);
    let weightless = Stewart { m: [0.0; 2], J: 0.0, ..MACHINE };
    let push = [
        63.155_385_541_928_04,
        52.534_269_010_380_01,
        42.251_929_135_941_324,
        44.856_711_689_558_44,
        83.917_428_704_149_87,
        28.409_856_493_961_67,
    ];
    let [force, moment] = wrench_of(&weightless, &rest, &push);
    are_equal(&force, &[0.0, 0.0, weightless.M * weightless.g], 1e-13);
    are_equal(&moment, &[0.0; 3], 1e-13);
    let rates = weightless.derivative(0.0, &rest, &StewartInput { push }).to_array();
    are_equal(&rates[12..], &[0.0; 12], 1e-13);
    // nothing but the force of the actuator goes through such a leg, moving or not: 2 λ leg = push
    for (state, push) in [(rest, push), (STATE, PUSH.push)] {
        let multipliers = weightless.multipliers(0.0, &state, &StewartInput { push }).length;
        for ((multiplier, leg), push) in multipliers.iter().zip(state.leg).zip(push) {
            assert!((2.0 * multiplier * leg - push).abs() < 1e-12, "{multiplier} {leg} {push}");
        }
    }
}

/// The force and the moment about the platform's centre that forces along the legs come to.
fn wrench_of(machine: &Stewart, state: &StewartState, forces: &[f64; 6]) -> [[f64; 3]; 2] {
    let [(sy, cy), (sp, cp), (sr, cr)] = [state.yaw, state.pitch, state.roll].map(f64::sin_cos);
    let attitude = [
        [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
        [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
        [-sp, cp * sr, cp * cr],
    ];
    let (mut force, mut moment) = ([0.0; 3], [0.0; 3]);
    for ((foot, joint), push) in machine.foot.iter().zip(&machine.joint).zip(forces) {
        let arm = attitude.map(|row| row.iter().zip(joint).map(|(a, b)| a * b).sum::<f64>());
        let strut: [f64; 3] = std::array::from_fn(|i| state.p[i] + arm[i] - foot[i]);
        let length = strut.iter().map(|x| x * x).sum::<f64>().sqrt();
        let along = strut.map(|x| push * x / length);
        for i in 0..3 {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            force[i] += along[i];
            moment[i] += arm[j] * along[k] - arm[k] * along[j];
        }
    }
    [force, moment]
}
