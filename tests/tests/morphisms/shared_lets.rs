//! `let …;` between the sections of maps and quotients: each belongs to what uses it.

use nonholonomic::prelude::*;

use super::support::reconstructs;

/// A sleigh on a plane.
#[nonholonomic(
    base { theta, p[2] }
    let along = [cos(theta), sin(theta)];
    let across = [-sin(theta), cos(theta)];
    lagrangian { kinetic(m, J, p + a * along, theta) }
    constraints { blade: dot(across, der(p)) = 0; }
    assume { m > 0; J > 0; }
)]
#[derive(Clone, Copy, Debug)]
struct Sleigh {
    m: f64,
    J: f64,
    a: f64,
}

quotient! {
    Sleigh ->
    /// On se(2).
    #[derive(Clone, Copy, Debug)]
    struct Algebra by { theta, p } {
        let turn = [[cos(theta), sin(theta)], [-sin(theta), cos(theta)]];
        let body = turn * der(p);
        let energy_of_turning = J / 2 * omega^2;
        velocities { omega = der(theta); v[0..2] = body; }
        outputs { turning = energy_of_turning; }
    }
}

/// A sleigh in its own frame.
#[nonholonomic(
    basis { omega, v[2] }
    brackets se(2) { omega, v }
    lagrangian { (J + m * a^2) / 2 * omega^2 + m / 2 * dot(v, v) + m * a * omega * v[1] }
    constraints { v[1] = 0; }
)]
#[derive(Clone, Copy, Debug)]
struct Declared {
    m: f64,
    J: f64,
    a: f64,
}

morphism! {
    Sleigh -> Declared {
        let turn = transpose([along, across]);
        velocities { omega = der(theta); v = transpose(turn) * der(p); }
    }
}

/// A body about its centre of mass, by angles.
#[nonholonomic(
    base { yaw, pitch, roll }
    let attitude = rot_z(yaw) * rot_y(pitch) * rot_x(roll);
    lagrangian { dot(body_rate(attitude), diag(A, B, C) * body_rate(attitude)) / 2 }
    assume { A > 0; B > 0; C > 0; }
)]
#[derive(Clone, Copy, Debug)]
struct Turning {
    A: f64,
    B: f64,
    C: f64,
}

quotient! {
    Turning ->
    /// By its rate in its own axes.
    #[derive(Clone, Copy, Debug)]
    struct InItsAxes by { yaw, pitch, roll } {
        velocities { w = body_rate(attitude); }
    }
}

/// Euler's equations.
#[nonholonomic(
    basis { w[3] }
    brackets so(3) { w }
    lagrangian { (A * w[0]^2 + B * w[1]^2 + C * w[2]^2) / 2 }
)]
#[derive(Clone, Copy, Debug)]
struct Euler {
    A: f64,
    B: f64,
    C: f64,
}

morphism! {
    Turning -> Euler {
        let turned = der(attitude);
        velocities { w = vee(transpose(attitude) * turned); }
    }
}

#[test]
fn rates_of_expressions_are_velocities_of_maps_and_quotients() {
    let body = Turning { A: 1.0, B: 2.0, C: 4.0 };
    let state = TurningState { yaw_dot: 0.3, pitch_dot: -0.7, roll_dot: 0.9, ..TurningState::default() };
    let in_its_axes: InItsAxesState = Reduction::<InItsAxes>::reduce(&body, 0.0, &state);
    let mapped: EulerState = Reduction::<Euler>::reduce(&body, 0.0, &state);
    assert_eq!((in_its_axes.w, mapped.w), ([0.9, -0.7, 0.3], [0.9, -0.7, 0.3]));
    let rate = Euler { A: 1.0, B: 2.0, C: 4.0 }.derivative(0.0, &mapped, &());
    assert!((rate.w[0] - 2.0 * 0.7 * 0.3).abs() < 1e-15);
}

#[test]
fn lets_of_the_full_system_and_of_the_new_one() {
    let sleigh = Sleigh { m: 1.3, J: 0.7, a: 0.4 };
    let (sin, cos) = 0.6_f64.sin_cos();
    let start = SleighState { theta: 0.6, p: [0.3, -0.2], theta_dot: 1.2, p_dot: [0.9 * cos, 0.9 * sin] };
    reconstructs::<_, Algebra>(&sleigh, start, ());
    reconstructs::<_, Declared>(&sleigh, start, ());
    let reduced: Algebra = sleigh.reduced();
    let state = Reduction::<Algebra>::reduce(&sleigh, 0.0, &start);
    assert!((reduced.outputs(0.0, &state, &()).turning - 0.7 / 2.0 * 1.44).abs() < 1e-14);
}
