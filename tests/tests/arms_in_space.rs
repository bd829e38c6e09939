//! Arms in space, mathematics (42) and (43), against their bodies with the forces and moments of their joints.
#![allow(non_snake_case, reason = "parameters are written as in mechanics: J")]

use nh_tests::linear::solved;
use nh_tests::random::Random;
use nh_tests::vectors::{Square, Vector, cross, image, plus, product, transposed};
use nonholonomic::prelude::*;

const BODIES: usize = 6;

/// Two arms on one column: axes that are orthogonal, parallel and neither, and centres of mass beside them.
#[nonholonomic(
    base { q[6] }
    let R0 = rot_z(q[0]);
    let R1 = R0 * rot_y(q[1]);
    let R2 = R1 * rot_y(q[2]);
    let R3 = R2 * rot([3/5, 0, 4/5], q[3]);
    let R4 = R1 * rot_x(q[4]);
    let R5 = R4 * rot_z(q[5]);
    let o1 = R0 * l[1];
    let o2 = o1 + R1 * l[2];
    let o3 = o2 + R2 * l[3];
    let o4 = o1 + R1 * l[4];
    let o5 = o4 + R4 * l[5];
    let p = [R0 * c[0], o1 + R1 * c[1], o2 + R2 * c[2], o3 + R3 * c[3], o4 + R4 * c[4], o5 + R5 * c[5]];
    lagrangian {
        kinetic(m[0], J[0], p[0], R0) + kinetic(m[1], J[1], p[1], R1) + kinetic(m[2], K, p[2], R2)
        + kinetic(m[3], J[3], p[3], R3) + kinetic(m[4], J[4], p[4], R4) + kinetic(m[5], J[5], p[5], R5)
        - g * sum(k in 0..6: m[k] * p[k][2])
    }
    inputs { torque[6] }
    forces { q: torque; }
    emit { explain, prepared }
)]
#[derive(Clone, Copy, Debug)]
struct Arms<T> {
    m: [T; 6],
    J: [[T; 3]; 6],
    #[nh(symmetric)]
    K: [[T; 3]; 3],
    l: [[T; 3]; 6],
    c: [[T; 3]; 6],
    g: T,
}

const PARENTS: [Option<usize>; BODIES] = [None, Some(0), Some(1), Some(2), Some(1), Some(4)];
const AXES: [[f64; 3]; BODIES] =
    [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [0.0, 1.0, 0.0], [0.6, 0.0, 0.8], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];

/// û, with û w = u × w.
fn hat(u: Vector) -> Square {
    [[0.0, -u[2], u[1]], [u[2], 0.0, -u[0]], [-u[1], u[0], 0.0]]
}

fn rotation(n: Vector, angle: f64) -> Square {
    let (sin, cos) = angle.sin_cos();
    let hat = hat(n);
    let identity = |i, j| if i == j { cos } else { 0.0 };
    std::array::from_fn(|i| {
        std::array::from_fn(|j| identity(i, j) + (1.0 - cos) * n[i] * n[j] + sin * hat[i][j])
    })
}

/// Where a body is and how it turns, in the axes of space.
#[derive(Clone, Copy, Default)]
struct Pose {
    attitude: Square,
    joint: Vector,
    centre: Vector,
    rate: Vector,
    axis: Vector,
    inertia: Square,
}

fn poses(arms: &Arms<f64>, state: &ArmsState<f64>) -> [Pose; BODIES] {
    let mut found = [Pose::default(); BODIES];
    for k in 0..BODIES {
        let turn = rotation(AXES[k], state.q[k]);
        let (attitude, joint, carried) = match PARENTS[k] {
            None => (turn, [0.0; 3], [0.0; 3]),
            Some(h) => {
                let Pose { attitude, joint, rate, .. } = found[h];
                (product(&attitude, &turn), plus(joint, image(&attitude, arms.l[k])), rate)
            }
        };
        let axis = image(&attitude, AXES[k]);
        let diagonal = |i, j| if i == j { arms.J[k][i] } else { 0.0 };
        let own: Square = match k {
            2 => arms.K,
            _ => std::array::from_fn(|i| std::array::from_fn(|j| diagonal(i, j))),
        };
        found[k] = Pose {
            attitude,
            joint,
            centre: plus(joint, image(&attitude, arms.c[k])),
            rate: plus(carried, axis.map(|entry| entry * state.q_dot[k])),
            axis,
            inertia: product(&product(&attitude, &own), &transposed(&attitude)),
        };
    }
    found
}

/// p̈, ω̇, the force and the moment in the joint, and q̈ of each body.
const PER_BODY: usize = 13;

/// Writes `sign · â` for the block of three rows and columns.
fn block(matrix: &mut [Vec<f64>], (row, column): (usize, usize), a: &Square, sign: f64) {
    for i in 0..3 {
        for j in 0..3 {
            matrix[row + i][column + j] += sign * a[i][j];
        }
    }
}

/// q̈ by Newton's and Euler's equations of every body, with the forces and moments in the joints as unknowns.
fn by_bodies(arms: &Arms<f64>, state: &ArmsState<f64>, torque: &[f64; BODIES]) -> Vec<f64> {
    let poses = poses(arms, state);
    let size = PER_BODY * BODIES;
    let (mut matrix, mut right) = (vec![vec![0.0; size]; size], vec![0.0; size]);
    let one: Square = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    for k in 0..BODIES {
        let Pose { joint, centre, rate, axis, inertia, .. } = poses[k];
        let at = PER_BODY * k;
        let [move_, turn, force, moment] = [0, 3, 6, 9].map(|offset| at + offset);
        let back = plus(joint, centre.map(|entry| -entry));
        // 1. m p̈ = F − m g, I ω̇ + ω × Iω = M + (o − p) × F
        block(&mut matrix, (at, move_), &one, arms.m[k]);
        block(&mut matrix, (at, force), &one, -1.0);
        right[at + 2] -= arms.m[k] * arms.g;
        block(&mut matrix, (at + 3, turn), &inertia, 1.0);
        block(&mut matrix, (at + 3, moment), &one, -1.0);
        block(&mut matrix, (at + 3, force), &hat(back), -1.0);
        let gyroscopic = cross(rate, image(&inertia, rate));
        for i in 0..3 {
            right[at + 3 + i] -= gyroscopic[i];
        }
        // 2. p̈ = ö + ω̇ × (p − o) + ω × (ω × (p − o)), and ö by the body before
        let arm = back.map(|entry| -entry);
        let mut swung = cross(rate, cross(rate, arm));
        block(&mut matrix, (at + 6, move_), &one, 1.0);
        block(&mut matrix, (at + 6, turn), &hat(arm), 1.0);
        // 3. ω̇ = ω̇' + n q̈ + ω' × n q̇
        block(&mut matrix, (at + 9, turn), &one, 1.0);
        for i in 0..3 {
            matrix[at + 9 + i][at + 12] = -axis[i];
        }
        // 4. n · M is what the motor gives
        matrix[at + 12][moment..moment + 3].copy_from_slice(&axis);
        right[at + 12] = torque[k];
        if let Some(h) = PARENTS[k] {
            let before = PER_BODY * h;
            let lever = plus(joint, poses[h].centre.map(|entry| -entry));
            let carried = poses[h].rate;
            block(&mut matrix, (before, force), &one, 1.0);
            block(&mut matrix, (before + 3, moment), &one, 1.0);
            block(&mut matrix, (before + 3, force), &hat(lever), 1.0);
            block(&mut matrix, (at + 6, before), &one, -1.0);
            block(&mut matrix, (at + 6, before + 3), &hat(lever), 1.0);
            swung = plus(swung, cross(carried, cross(carried, lever)));
            block(&mut matrix, (at + 9, before + 3), &one, -1.0);
            let turned = cross(carried, axis.map(|entry| entry * state.q_dot[k]));
            for i in 0..3 {
                right[at + 9 + i] += turned[i];
            }
        }
        for i in 0..3 {
            right[at + 6 + i] += swung[i];
        }
    }
    let found = solved(matrix, right);
    (0..BODIES).map(|k| found[PER_BODY * k + 12]).collect()
}

fn arms(random: &mut Random) -> Arms<f64> {
    let mut list = |low: f64, high: f64| -> [f64; 6] { std::array::from_fn(|_| random.between(low, high)) };
    let m = list(0.3, 2.0);
    let mut triples = |low: f64, high: f64| -> [[f64; 3]; 6] {
        std::array::from_fn(|_| std::array::from_fn(|_| random.between(low, high)))
    };
    let (l, c) = (triples(-0.6, 0.6), triples(-0.4, 0.4));
    // moments that a body can have: each is less than the sum of the others
    let J = triples(0.2, 0.35);
    let mut K = [[0.3, 0.04, -0.03], [0.04, 0.25, 0.02], [-0.03, 0.02, 0.28]];
    K[0][0] += random.between(0.0, 0.1);
    Arms { m, J, K, l, c, g: 9.81 }
}

#[test]
fn accelerations_are_those_of_bodies_with_the_forces_of_their_joints() {
    let in_body_axes = |line: &str| {
        ["joint by joint", "by composite bodies"].iter().any(|name| line.trim().starts_with(name))
            && line.contains(": chosen")
    };
    assert!(Arms::<f64>::DERIVATION.lines().any(in_body_axes), "{}", Arms::<f64>::DERIVATION);
    let mut random = Random::new(42);
    for _ in 0..200 {
        let arms = arms(&mut random);
        let mut list = |bound: f64| -> [f64; 6] { std::array::from_fn(|_| random.between(-bound, bound)) };
        let (state, torque) = (ArmsState { q: list(3.0), q_dot: list(2.0) }, list(3.0));
        let found = arms.derivative(0.0, &state, &ArmsInput { torque }).q_dot;
        let expected = by_bodies(&arms, &state, &torque);
        let size = expected.iter().fold(1.0_f64, |size, value| size.max(value.abs()));
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() <= 1e-11 * size, "{found}, {expected} of {size} for {arms:?}");
        }
        let prepared = arms.prepare().derivative(0.0, &state, &ArmsInput { torque }).q_dot;
        assert_eq!(prepared.map(f64::to_bits), found.map(f64::to_bits));
    }
}
