//! Several families of embedded coordinates in one machine: attitudes as matrices, and a direction.

use nh_tests::random::Random;
use nonholonomic::prelude::*;

/// Two bodies that turn about fixed points, with a potential between an axis of one and an axis of the other, under a
/// direction that the first carries along.
#[nonholonomic(
    base { P[3][3], g[3], Q[3][3] }
    on { transpose(P) * P = identity(3); dot(g, g) = 1; transpose(Q) * Q = identity(3); }
    basis { w[3], o[3] }
    anchor { der(P) = P * hat(w); der(g) = cross(g, w); der(Q) = Q * hat(o); }
    lagrangian { sum(i in 0..3: I[i] * w[i]^2 + K[i] * o[i]^2) / 2 - k * dot(P * [1, 0, 0], Q * [0, 1, 0]) - h * g[2] }
    assume { I > 0; K > 0; }
)]
#[derive(Clone, Copy, Debug)]
#[allow(non_snake_case, reason = "as in mechanics")]
struct TwoBodies {
    I: [f64; 3],
    K: [f64; 3],
    k: f64,
    h: f64,
}

/// Two bodies by places and matrices, with a ball joint between them, and a rope from the first to the ceiling.
#[nonholonomic(
    base { P[3][3], Q[3][3], c[3], d[3] }
    on { transpose(P) * P = identity(3); transpose(Q) * Q = identity(3); }
    basis { w[3], o[3], v[3], s[3] }
    anchor { der(P) = P * hat(w); der(Q) = Q * hat(o); der(c) = v; der(d) = s; }
    let end = c - P * [l, 0, 0];
    holonomic { joint: c + P * [l, 0, 0] - d - Q * [0, l, 0] = 0; ceiling: dot(end, end) = rope^2; }
    lagrangian { kinetic(m, I, c, P) + kinetic(m, I, d, Q) - m * g * (c[2] + d[2]) }
    assume { m > 0; I > 0; }
)]
#[derive(Clone, Copy, Debug)]
#[allow(non_snake_case, reason = "as in mechanics")]
struct Hanging {
    m: f64,
    I: [f64; 3],
    l: f64,
    rope: f64,
    g: f64,
}

type Vector = [f64; 3];

fn cross(a: Vector, b: Vector) -> Vector {
    std::array::from_fn(|i| a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3])
}

fn rows(e: [f64; 9]) -> [Vector; 3] {
    std::array::from_fn(|i| std::array::from_fn(|j| e[3 * i + j]))
}

fn column(matrix: &[Vector; 3], j: usize) -> Vector {
    matrix.map(|row| row[j])
}

/// Rᵀ v.
fn seen_from(matrix: &[Vector; 3], v: Vector) -> Vector {
    std::array::from_fn(|j| (0..3).map(|i| matrix[i][j] * v[i]).sum())
}

/// Euler's equations, with the torque ∓k a × b of the potential k a·b, and h g × e₃ of the weight.
#[test]
fn two_bodies_turn_by_eulers_equations() {
    let bodies = TwoBodies { I: [1.0, 1.7, 2.2], K: [0.6, 0.9, 1.3], k: 0.8, h: 0.5 };
    let mut random = Random::new(5);
    for _ in 0..20 {
        let mut vector = || -> Vector { std::array::from_fn(|_| random.between(-1.0, 1.0)) };
        let (w, o, g) = (vector(), vector(), vector());
        let (p, q) = (rows(random.rotation()), rows(random.rotation()));
        let mut state = TwoBodiesState { P: p, g, Q: q, w, o };
        bodies.normalize(&mut state).unwrap();
        assert_eq!((state.w, state.o), (w, o));
        let rate = bodies.derivative(0.0, &state, &());
        let between = cross(column(&state.P, 0), column(&state.Q, 1));
        let (on_first, on_second) = (seen_from(&state.P, between), seen_from(&state.Q, between));
        let weight = cross(state.g, [0.0, 0.0, 1.0]);
        let momenta =
            |inertia: Vector, rate: Vector| -> Vector { std::array::from_fn(|i| inertia[i] * rate[i]) };
        let (turned, other) = (cross(momenta(bodies.I, w), w), cross(momenta(bodies.K, o), o));
        for i in 0..3 {
            let first = (turned[i] - bodies.k * on_first[i] + bodies.h * weight[i]) / bodies.I[i];
            let second = (other[i] + bodies.k * on_second[i]) / bodies.K[i];
            assert!((rate.w[i] - first).abs() < 1e-14, "{} {first}", rate.w[i]);
            assert!((rate.o[i] - second).abs() < 1e-14, "{} {second}", rate.o[i]);
        }
    }
}

#[test]
fn joined_bodies_keep_their_joint_and_their_attitudes() {
    let hanging = Hanging { m: 1.2, I: [0.02, 0.03, 0.04], l: 0.3, rope: 0.5, g: 9.81 };
    let upright = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let guess = HangingState {
        P: upright,
        Q: upright,
        c: [0.6, 0.1, -0.4],
        d: [0.9, -0.2, -0.4],
        w: [0.5, 1.0, -2.0],
        ..HangingState::default()
    };
    let start = hanging.assemble(0.0, &guess).unwrap();
    let mut sim = Integrator::new(hanging, Dop853::new().rtol(1e-10), 0.0, start);
    sim.advance_to(5.0).unwrap();
    let state = sim.state();
    assert!((hanging.energy(5.0, state) - hanging.energy(0.0, &start)).abs() < 1e-7);
    for matrix in [&state.P, &state.Q] {
        for (i, j) in [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)] {
            let product: f64 = (0..3).map(|k| matrix[k][i] * matrix[k][j]).sum();
            assert!((product - if i == j { 1.0 } else { 0.0 }).abs() < 1e-8, "{product}");
        }
    }
    let residual = hanging.constraint_residual(5.0, state);
    assert!(residual.joint.iter().all(|gap| gap.abs() < 1e-14) && residual.ceiling.abs() < 1e-14);
}
