//! Multipliers and reaction forces: their names, that they close the equations of motion, and that
//! they do no work where the constraints are homogeneous.

use nh_tests::random::Random;
use nh_tests::systems::sleigh::{Sleigh, SleighInput, SleighReactions, SleighState};
use nh_tests::systems::snakeboard::{
    SnakeboardOnThePlane, SnakeboardOnThePlaneInput, SnakeboardOnThePlaneState,
};
use nonholonomic::prelude::*;

/// A particle on rails, with labels that generated names have to live with.
#[nonholonomic(
    base { q[3], z }
    basis { w[3], v }
    anchor { der(q[0]) = w[0]; der(q[1]) = w[1]; der(q[2]) = w[2]; der(z) = v; }
    lagrangian { m / 2 * (dot(w, w) + v^2) - m * g * z }
    constraints { constraint_2: w[1] = 2 * w[0]; v = q[0] * w[0]; r#type: w[2] = c; }
    forces { w[0]: u; }
    inputs { u }
    emit { multipliers, reactions }
)]
#[derive(Clone, Copy, Debug)]
struct Rails {
    m: f64,
    g: f64,
    c: f64,
}

#[test]
fn labels_name_the_multipliers() {
    let rails = Rails { m: 2.0, g: 9.8, c: 0.5 };
    let state = RailsState { q: [0.7, 0.1, 0.2], w_0: 0.3, ..RailsState::default() };
    let input = RailsInput { u: 1.1 };
    let rate = rails.derivative(0.0, &state, &input).w_0;
    let lambda: RailsMultipliers = rails.multipliers(0.0, &state, &input);
    // m (2 w0)˙, m (q0 w0)˙ + m g, and nothing along a rail of constant speed
    assert!((lambda.constraint_2 - 4.0 * rate).abs() < 1e-14, "{lambda:?}");
    let expected = 2.0 * (0.09 + 0.7 * rate + 9.8);
    assert!((lambda.constraint_2_ - expected).abs() < 1e-13, "{lambda:?}");
    assert!(lambda.r#type.abs() < 1e-14, "{lambda:?}");
    let reactions = rails.reactions(0.0, &state, &input);
    let along_w0 = -2.0 * lambda.constraint_2 - 0.7 * lambda.constraint_2_;
    assert!((reactions.w[0] - along_w0).abs() < 1e-13, "{reactions:?}");
    assert!((reactions.w[1] - lambda.constraint_2).abs() < 1e-14, "{reactions:?}");
    assert!((reactions.v - lambda.constraint_2_).abs() < 1e-14, "{reactions:?}");
    let [.., last]: [f64; 4] = reactions.into();
    assert!((last - reactions.v).abs() == 0.0);
}

#[test]
fn the_blade_pushes_sideways_alone() {
    let sleigh = Sleigh { m: 1.2, J: 0.4, a: 0.3, b: 0.1, c: 0.2 };
    let state = SleighState { omega: 0.8, v1: 0.5, ..SleighState::default() };
    let input = SleighInput { torque: 0.6 };
    let rate = sleigh.derivative(0.0, &state, &input);
    let blade = sleigh.multipliers(0.0, &state, &input).blade;
    // Newton's law for the centre of mass, sideways: m (a ω˙ − b ω² + ω v1)
    let expected = 1.2 * (0.3 * rate.omega - 0.1 * 0.64 + 0.8 * 0.5);
    assert!((blade - expected).abs() < 1e-14, "{blade} {expected}");
    let SleighReactions { omega, v1, v2 } = sleigh.reactions(0.0, &state, &input);
    assert!(omega.abs() < 1e-14 && v1.abs() < 1e-14 && (v2 - blade).abs() < 1e-14, "{omega} {v1} {v2}");
}

#[test]
fn reactions_close_the_equations_and_do_no_work() {
    let board = SnakeboardOnThePlane { m: 6.0, l: 0.3, J0: 0.16, J1: 0.04 };
    let SnakeboardOnThePlane { m, l, J0, J1 } = board;
    let mut random = Random::new(5);
    for _ in 0..100 {
        let t = random.between(0.0, 5.0);
        let mut numbers = [0.0; 10];
        for number in &mut numbers {
            *number = random.between(-1.2, 1.2);
        }
        let mut state = SnakeboardOnThePlaneState::from(numbers);
        board.project(t, &mut state).unwrap();
        let input = SnakeboardOnThePlaneInput { rotor: random.between(-1.0, 1.0), steering: 0.3 };
        let rate = board.derivative(t, &state, &input);
        let force = board.reactions(t, &state, &input);
        let largest = <[f64; 5]>::from(force).iter().fold(1.0, |m: f64, f| m.max(f.abs()));
        let closes = |inertial: f64, force: f64, what: &str| {
            assert!((inertial - force).abs() < 1e-11 * largest, "{what}: {inertial} {force}");
        };
        closes(m * rate.x_dot, force.x_dot, "x");
        closes(m * rate.y_dot, force.y_dot, "y");
        closes(m * l * l * rate.theta_dot + J0 * rate.psi_dot, force.theta_dot, "theta");
        closes(J0 * (rate.psi_dot + rate.theta_dot), force.psi_dot + input.rotor, "psi");
        closes(2.0 * J1 * rate.phi_dot, force.phi_dot + input.steering, "phi");
        // Jᵀ λ
        let lambda = board.multipliers(t, &state, &input);
        let (behind, ahead) = (state.theta + state.phi, state.theta - state.phi);
        let sideways = -lambda.wheel_back * behind.sin() - lambda.wheel_front * ahead.sin();
        closes(sideways, force.x_dot, "J^T lambda");
        let velocity: [f64; 5] = board.velocity(t, &state).into();
        let power: f64 = velocity.iter().zip(<[f64; 5]>::from(force)).map(|(y, f)| y * f).sum();
        assert!(power.abs() < 1e-12 * largest, "{power}");
    }
}
