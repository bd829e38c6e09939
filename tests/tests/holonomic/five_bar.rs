//! A parallel robot of five bars, and the same with a wheel on one of its rods: a loop, and a loop with a nonholonomic
//! constraint. Accelerations are those of `reference/loops.py`, which takes redundant coordinates, multipliers and
//! differences of 60 digits.

use nonholonomic::prelude::*;

macro_rules! five_bar {
    ($name:ident { $($sections:tt)* }) => {
        /// Two cranks on the ground with a rod on each, whose ends meet.
        #[nonholonomic(
            base { left, right, left_rod, right_rod }
            let along(angle) = [cos(angle), sin(angle)];
            let elbow = [l[0] * along(left), [d, 0] + l[1] * along(right)];
            let tip = elbow[0] + l[2] * along(left_rod);
            holonomic { meet: tip - (elbow[1] + l[3] * along(right_rod)) = 0; }
            let bodies = [
                l[0] / 2 * along(left), [d, 0] + l[1] / 2 * along(right),
                elbow[0] + l[2] / 2 * along(left_rod), elbow[1] + l[3] / 2 * along(right_rod)
            ];
            lagrangian {
                kinetic(m[0], I[0], bodies[0], left) + kinetic(m[1], I[1], bodies[1], right)
                + kinetic(m[2], I[2], bodies[2], left_rod) + kinetic(m[3], I[3], bodies[3], right_rod)
                - g * sum(i in 0..4: m[i] * bodies[i][1])
            }
            inputs { torque[2] }
            forces { left: torque[0]; right: torque[1]; }
            $($sections)*
        )]
        #[derive(Clone, Copy, Debug)]
        struct $name {
            l: [f64; 4],
            d: f64,
            m: [f64; 4],
            I: [f64; 4],
            g: f64,
        }

        impl $name {
            const MODEL: Self = Self {
                l: [0.3, 0.35, 0.5, 0.45],
                d: 0.4,
                m: [1.1, 1.3, 0.8, 0.7],
                I: [0.02, 0.03, 0.015, 0.012],
                g: 9.81,
            };
        }
    };
}

five_bar! { FiveBar { linearization { keep: left, right, der(left), der(right); } } }
five_bar! { WithAWheel {
    constraints { wheel: dot([-sin(left_rod), cos(left_rod)], der(tip)) = 0; }
} }

const PLACE: [f64; 4] = [2.1, 0.9, 0.609_797_442_441_575_1, 2.494_895_757_104_266];
const TORQUE: [f64; 2] = [2.5, -1.5];

/// The found accelerations are those of the reference, in units of the largest.
fn agree(found: &[f64], expected: [f64; 4]) {
    let largest = expected.iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() < 1e-13 * largest, "{found} {expected}");
    }
}

#[test]
fn accelerations_of_the_loop() {
    let rates = [0.7, -0.4, -0.464_239_710_008_919_2, 0.582_721_320_278_701_9];
    let mut state = [0.0; 8];
    state[..4].copy_from_slice(&PLACE);
    state[4..].copy_from_slice(&rates);
    let state = FiveBarState::from(state);
    let found = FiveBar::MODEL.derivative(0.0, &state, &FiveBarInput { torque: TORQUE }).to_array();
    let expected =
        [37.305_676_428_072_28, -26.695_532_247_518_702, -28.801_700_830_253_996, 32.578_475_652_556_09];
    agree(&found[4..], expected);
    // from the angles of the cranks and a glance at the rods
    let hold = [FiveBarCoordinate::left, FiveBarCoordinate::right];
    let guess =
        FiveBarState { left_rod: 0.4, right_rod: 2.7, left_rod_dot: 0.0, right_rod_dot: 0.0, ..state };
    let assembled = FiveBar::MODEL.assemble_holding(0.0, &guess, &hold).unwrap();
    assert!(assembled.to_array().iter().zip(state.to_array()).all(|(a, b)| (a - b).abs() < 1e-14));
}

#[test]
fn torques_that_hold_the_robot() {
    let mut state = [0.0; 8];
    state[..4].copy_from_slice(&PLACE);
    let guess = FiveBarState::from(state);
    let robot = FiveBar::MODEL;
    // one list for both methods
    let hold = [FiveBarCoordinate::left, FiveBarCoordinate::right];
    let (held, input) = robot.trim(0.0, &guess, &FiveBarInput::default(), &hold).unwrap();
    // virtual work: the torque of a crank is the slope of the weight's height over its angle
    let height = |left: f64, right: f64| {
        let moved = FiveBarState { left, right, ..guess };
        robot.energy(0.0, &robot.assemble_holding(0.0, &moved, &hold).unwrap())
    };
    let h = 1e-4;
    let slopes = [
        (height(2.1 + h, 0.9) - height(2.1 - h, 0.9)) / (2.0 * h),
        (height(2.1, 0.9 + h) - height(2.1, 0.9 - h)) / (2.0 * h),
    ];
    for (torque, slope) in input.torque.iter().zip(slopes) {
        assert!((torque - slope).abs() < 1e-6, "{torque} {slope}");
    }
    // and its linear model says whether it would fall
    let model = robot.linearize(0.0, &held, &input).unwrap();
    assert_eq!(model.states, ["left", "right", "left_dot", "right_dot"]);
    let upper = model.a.fixed_view::<2, 4>(0, 0).into_owned();
    assert!((upper[(0, 2)], upper[(1, 3)], upper[(0, 0)]) == (1.0, 1.0, 0.0), "{upper}");
}

#[test]
fn accelerations_with_a_wheel_on_the_coupler() {
    let rates = [0.7, 0.184_943_249_275_565_56, -0.033_812_751_014_708_88, 0.445_831_470_786_814_3];
    let mut state = [0.0; 8];
    state[..4].copy_from_slice(&PLACE);
    state[4..].copy_from_slice(&rates);
    let state = WithAWheelState::from(state);
    let input = WithAWheelInput { torque: TORQUE };
    let found = WithAWheel::MODEL.derivative(0.0, &state, &input).to_array();
    let expected =
        [28.745_934_038_234_56, 7.879_813_069_330_774, -1.081_340_627_780_973_5, 18.308_448_214_675_676];
    agree(&found[4..], expected);
    // the wheel rolls on, and the loop stays closed
    let mut sim = Integrator::new(WithAWheel::MODEL, Dop853::new().rtol(1e-10).atol(1e-10), 0.0, state);
    sim.advance_to(0.3).unwrap();
    let energies = [state, *sim.state()].map(|state| WithAWheel::MODEL.energy(0.0, &state));
    assert!((energies[0] - energies[1]).abs() < 1e-8 * energies[0].abs(), "{energies:?}");
    let left: [f64; 5] = WithAWheel::MODEL.constraint_residual(0.3, sim.state()).into();
    assert!(left.iter().all(|left| left.abs() < 1e-13), "{left:?}");
}
