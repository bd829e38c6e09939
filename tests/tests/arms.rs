//! An arm whose accelerations are found from its tip, mathematics (39), against its bodies with the forces of its joints.
#![allow(non_snake_case, reason = "parameters are written as in mechanics: J")]

use nh_tests::linear::solved;
use nh_tests::random::Random;
use nonholonomic::prelude::*;

const LINKS: usize = 5;
const SIZE: usize = 5 * LINKS;

/// Hinged to the ground in a vertical plane, with a motor in every joint.
#[nonholonomic(
    base { q[5] }
    lagrangian {
        let th[i in 0..5] = sum(j in 0..i + 1: q[j]);
        let px[i in 0..5] = sum(j in 0..i: l[j] * cos(th[j])) + c[i] * cos(th[i]);
        let py[i in 0..5] = sum(j in 0..i: l[j] * sin(th[j])) + c[i] * sin(th[i]);
        sum(i in 0..5: kinetic(m[i], J[i], [px[i], py[i]], th[i]) - m[i] * g * py[i])
    }
    inputs { torque[5] }
    forces { q: torque; }
    emit { jacobian, taylor, prepared, explain }
)]
#[derive(Clone, Copy, Debug)]
struct Arm<T> {
    m: [T; 5],
    J: [T; 5],
    l: [T; 5],
    c: [T; 5],
    g: T,
}

/// Bodies of ordinary sizes; one is a material point, and one turns about its joint.
fn arm(random: &mut Random) -> Arm<f64> {
    let mut list = |low, high| std::array::from_fn(|_| random.between(low, high));
    let mut arm =
        Arm { m: list(0.3, 2.0), J: list(0.02, 0.5), l: list(0.3, 1.2), c: list(0.1, 0.8), g: 9.81 };
    (arm.J[2], arm.c[3]) = (0.0, 0.0);
    arm
}

fn state(random: &mut Random) -> ArmState<f64> {
    let mut list = || std::array::from_fn(|_| random.between(-2.0, 2.0));
    ArmState { q: list(), q_dot: list() }
}

/// q̈ by Newton's and Euler's equations of every body, with the forces in the joints as unknowns.
fn by_bodies(arm: &Arm<f64>, state: &ArmState<f64>, torque: &[f64; LINKS]) -> [f64; LINKS] {
    let (mut angle, mut rate) = ([0.0; LINKS], [0.0; LINKS]);
    for i in 0..LINKS {
        angle[i] = state.q[..=i].iter().sum();
        rate[i] = state.q_dot[..=i].iter().sum();
    }
    // ẍ, ÿ, φ̈ of each body, then the two components of the force in each joint on the body behind it
    let (mut matrix, mut right) = (vec![vec![0.0; SIZE]; SIZE], vec![0.0; SIZE]);
    for i in 0..LINKS {
        let (body, joint) = (3 * i, 3 * LINKS + 2 * i);
        let (sin, cos) = angle[i].sin_cos();
        let (near, far) = (arm.c[i], arm.l[i] - arm.c[i]);
        // 1. the balance of forces and of moments about the centre of mass
        for k in 0..2 {
            matrix[body + k][body + k] = arm.m[i];
            matrix[body + k][joint + k] = -1.0;
        }
        matrix[body + 2][body + 2] = arm.J[i];
        matrix[body + 2][joint] = -near * sin;
        matrix[body + 2][joint + 1] = near * cos;
        right[body + 1] = -arm.m[i] * arm.g;
        right[body + 2] = torque[i];
        if i + 1 < LINKS {
            for k in 0..2 {
                matrix[body + k][joint + 2 + k] = 1.0;
            }
            matrix[body + 2][joint + 2] = -far * sin;
            matrix[body + 2][joint + 3] = far * cos;
            right[body + 2] -= torque[i + 1];
        }
        // 2. the near end of the body accelerates like the far end of the one before
        let turning = rate[i] * rate[i];
        matrix[joint][body] = 1.0;
        matrix[joint][body + 2] = near * sin;
        right[joint] = -near * cos * turning;
        matrix[joint + 1][body + 1] = 1.0;
        matrix[joint + 1][body + 2] = -near * cos;
        right[joint + 1] = -near * sin * turning;
        if i > 0 {
            let (before, lever) = (body - 3, arm.l[i - 1] - arm.c[i - 1]);
            let (sin, cos) = angle[i - 1].sin_cos();
            let turning = rate[i - 1] * rate[i - 1];
            matrix[joint][before] = -1.0;
            matrix[joint][before + 2] = lever * sin;
            right[joint] -= lever * cos * turning;
            matrix[joint + 1][before + 1] = -1.0;
            matrix[joint + 1][before + 2] = -lever * cos;
            right[joint + 1] -= lever * sin * turning;
        }
    }
    let found = solved(matrix, right);
    std::array::from_fn(|i| found[3 * i + 2] - if i > 0 { found[3 * i - 1] } else { 0.0 })
}

#[test]
fn accelerations_are_those_of_bodies_with_the_forces_of_their_joints() {
    let chosen = |line: &str| line.trim().starts_with("from the tips") && line.contains(": chosen");
    assert!(Arm::<f64>::DERIVATION.lines().any(chosen), "{}", Arm::<f64>::DERIVATION);
    let mut random = Random::new(39);
    for _ in 0..200 {
        let (arm, state) = (arm(&mut random), state(&mut random));
        let torque = std::array::from_fn(|_| random.between(-3.0, 3.0));
        let found = arm.derivative(0.0, &state, &ArmInput { torque }).q_dot;
        let expected = by_bodies(&arm, &state, &torque);
        let size = expected.iter().fold(1.0_f64, |size, value| size.max(value.abs()));
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() <= 1e-11 * size, "{found}, {expected} of {size} for {arm:?}");
        }
        let prepared = arm.prepare().derivative(0.0, &state, &ArmInput { torque }).q_dot;
        assert_eq!(prepared.map(f64::to_bits), found.map(f64::to_bits));
    }
}

#[test]
fn runs_keep_the_energy_and_agree_with_their_series() {
    let mut random = Random::new(40);
    let (arm, start) = (arm(&mut random), state(&mut random));
    let mut by_series = Integrator::new(arm, Taylor::new().rtol(1e-14), 0.0, start);
    let mut by_stages = Integrator::new(arm, Dop853::new().rtol(1e-13).atol(1e-13), 0.0, start);
    by_series.advance_to(0.5).expect("regular");
    by_stages.advance_to(0.5).expect("regular");
    let energy = arm.energy(0.0, &start);
    let change = arm.energy(0.0, by_series.state()) - energy;
    assert!(change.abs() <= 1e-11 * energy.abs().max(1.0), "{change:e} of {energy}");
    for (one, other) in by_series.state().q.iter().zip(by_stages.state().q) {
        assert!((one - other).abs() <= 1e-9, "{one}, {other}");
    }
}
