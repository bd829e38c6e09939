//! Momenta on levels where position constraints hold, mathematics (22): against the systems without `routh`, and in
//! coordinates that need no position constraint.
#![allow(non_snake_case, reason = "parameters are written as in mechanics")]

use nonholonomic::prelude::*;

/// A spherical pendulum, on a level of its momentum about the vertical.
#[nonholonomic(
    base { x, y, z }
    holonomic { rod: x^2 + y^2 + z^2 = l^2; }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) - m * g * z }
    symmetries { turn: x * der(y) - y * der(x); }
    routh { turn = mu; }
)]
#[derive(Clone, Copy, Debug)]
struct Turning {
    m: f64,
    l: f64,
    g: f64,
    mu: f64,
}

/// By its angle from the vertical.
#[nonholonomic(
    base { theta, phi }
    lagrangian { m * l^2 / 2 * (der(theta)^2 + sin(theta)^2 * der(phi)^2) - m * g * l * cos(theta) }
    routh { phi = mu; }
    independent { der(theta) }
)]
#[derive(Clone, Copy, Debug)]
struct ByAngle {
    m: f64,
    l: f64,
    g: f64,
    mu: f64,
}

#[test]
fn a_level_is_kept_with_the_positions() {
    let (m, l, g, mu) = (0.7, 0.9, 9.81, 0.5);
    let (full, angle) = (Turning { m, l, g, mu }, ByAngle { m, l, g, mu });
    let (theta, theta_dot) = (1.8_f64, 0.6);
    let (sin, cos) = theta.sin_cos();
    let phi_dot = mu / (m * l * l * sin * sin);
    let start = TurningState {
        x: l * sin,
        y: 0.0,
        z: l * cos,
        x_dot: l * cos * theta_dot,
        y_dot: l * sin * phi_dot,
        z_dot: -l * sin * theta_dot,
    };
    let left = full.constraint_residual(0.0, &start);
    let all: Vec<f64> = <[f64; 3]>::from(left).to_vec();
    assert!(all.iter().all(|left| left.abs() < 1e-15), "{left:?}");
    let mut on_rod = Integrator::new(full, Dop853::new().rtol(1e-12).atol(1e-12), 0.0, start);
    let reduced = ByAngleState { theta, theta_dot };
    let mut in_angle = Integrator::new(angle, Dop853::new().rtol(1e-12).atol(1e-12), 0.0, reduced);
    on_rod.advance_to(3.0).unwrap();
    in_angle.advance_to(3.0).unwrap();
    assert!((on_rod.state().z - l * in_angle.state().theta.cos()).abs() < 1e-9);
    let TurningState { x, y, x_dot, y_dot, .. } = *on_rod.state();
    assert!((m * (x * y_dot - y * x_dot) - mu).abs() < 1e-14);
    // off the level is off the constraints
    let mut off = TurningState { y_dot: 1.2 * start.y_dot, ..start };
    full.project(0.0, &mut off).unwrap();
    assert!((off.y_dot - start.y_dot).abs() < 1e-14);
}

/// An arm that is turned about an upright axis and carries a mass on a rod, on a level of its momentum.
#[nonholonomic(
    base { x, z, psi }
    holonomic { rod: x^2 + z^2 = l^2; }
    lagrangian { m / 2 * (der(x)^2 + der(z)^2 + x^2 * der(psi)^2) + J / 2 * der(psi)^2 - m * g * z }
    routh { psi = mu; }
    assume { m > 0; J > 0; }
    independent { der(x) }
)]
#[derive(Clone, Copy, Debug)]
struct Arm {
    m: f64,
    l: f64,
    g: f64,
    J: f64,
    mu: f64,
}

/// The same by the rod's angle from the axis.
#[nonholonomic(
    base { theta, psi }
    lagrangian { m * l^2 / 2 * (der(theta)^2 + sin(theta)^2 * der(psi)^2) + J / 2 * der(psi)^2 - m * g * l * cos(theta) }
    routh { psi = mu; }
    assume { m > 0; J > 0; }
)]
#[derive(Clone, Copy, Debug)]
struct ArmByAngle {
    m: f64,
    l: f64,
    g: f64,
    J: f64,
    mu: f64,
}

#[test]
fn a_level_is_solved_for_beside_a_position_constraint() {
    let (m, l, g, J, mu) = (0.7, 0.9, 9.81, 0.2, 0.5);
    let (arm, angle) = (Arm { m, l, g, J, mu }, ArmByAngle { m, l, g, J, mu });
    for (theta, theta_dot) in [(0.4_f64, 0.6), (1.1, -2.0), (2.5, 0.3)] {
        let (sin, cos) = theta.sin_cos();
        let state = ArmState { x: l * sin, z: l * cos, x_dot: l * cos * theta_dot };
        let there = ArmByAngleState { theta, theta_dot };
        let (found, wanted) = (arm.derivative(0.0, &state, &()), angle.derivative(0.0, &there, &()));
        let expected = l * (cos * wanted.theta_dot - sin * theta_dot * theta_dot);
        assert!((found.x_dot - expected).abs() < 1e-13 && (found.z + l * sin * theta_dot).abs() < 1e-14);
        let (rate, other) = (arm.velocity(0.0, &state).psi_dot, angle.velocity(0.0, &there).psi_dot);
        assert!((rate - other).abs() < 1e-14);
        assert!((arm.quadratures(0.0, &state).psi - rate).abs() < 1e-15);
        assert!((arm.energy(0.0, &state) - angle.energy(0.0, &there)).abs() < 1e-13);
    }
}
