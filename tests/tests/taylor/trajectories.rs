//! Near round-off at the end of long runs.
//!
//! The ends were computed with Taylor series of order 40 in 45-digit arithmetic from the equations of
//! Newton and Euler (`tests/peers/python/reference.py`); at T = 20 they agree with the reference data.
#![allow(non_snake_case, reason = "parameters are written as in mechanics: J, I")]

use nonholonomic::prelude::*;

use super::systems::{Sleigh, SleighState, Veselova, VeselovaState};

/// In the frame of the tractor: the adapted formulation.
#[nonholonomic(
    base { x, y, theta[4] }
    basis { v1, v2, om[4] }
    anchor {
        der(x) = v1 * cos(theta[0]) - v2 * sin(theta[0]);
        der(y) = v1 * sin(theta[0]) + v2 * cos(theta[0]);
        for i in 0..4 { der(theta[i]) = om[i]; }
    }
    lagrangian {
        let vx[i in 0..4] = der(x) + sum(j in 1..i+1: d[j] * sin(theta[j]) * om[j]);
        let vy[i in 0..4] = der(y) - sum(j in 1..i+1: d[j] * cos(theta[j]) * om[j]);
        m[0]/2 * (v1^2 + (v2 + a * om[0])^2) + sum(i in 0..4: J[i]/2 * om[i]^2)
            + sum(i in 1..4: m[i]/2 * (vx[i]^2 + vy[i]^2))
    }
    constraints {
        v2 = 0;
        for i in 1..4 { d[i] * om[i] = v1 * sin(theta[0] - theta[i])
            - sum(j in 1..i: d[j] * cos(theta[i] - theta[j]) * om[j]); }
    }
    inputs { F, tau }
    forces { v1: F; om[0]: tau }
    independent { v1, om[0] }
    emit { taylor }
)]
#[derive(Clone, Copy, Debug)]
struct Tractor {
    m: [f64; 4],
    J: [f64; 4],
    d: [f64; 4],
    a: f64,
}

/// In coordinates of the plane: all velocities and four multipliers.
#[nonholonomic(
    base { x, y, theta[4] }
    lagrangian {
        let vx[i in 0..4] = der(x) + sum(j in 1..i+1: d[j] * sin(theta[j]) * der(theta[j]));
        let vy[i in 0..4] = der(y) - sum(j in 1..i+1: d[j] * cos(theta[j]) * der(theta[j]));
        m[0]/2 * ((der(x) - a*sin(theta[0])*der(theta[0]))^2 + (der(y) + a*cos(theta[0])*der(theta[0]))^2)
            + sum(i in 0..4: J[i]/2 * der(theta[i])^2) + sum(i in 1..4: m[i]/2 * (vx[i]^2 + vy[i]^2))
    }
    constraints {
        for i in 0..4 { cos(theta[i])*(der(y) - sum(j in 1..i+1: d[j] * cos(theta[j]) * der(theta[j])))
            = sin(theta[i])*(der(x) + sum(j in 1..i+1: d[j] * sin(theta[j]) * der(theta[j]))); }
    }
    inputs { F, tau }
    forces { x: F * cos(theta[0]); y: F * sin(theta[0]); theta[0]: tau }
    formulation { projected }
    emit { taylor }
)]
#[derive(Clone, Copy, Debug)]
struct ProjectedTractor {
    m: [f64; 4],
    J: [f64; 4],
    d: [f64; 4],
    a: f64,
}

fn compare(found: &[f64], expected: &[f64], tolerance: f64) {
    for (x, expected) in found.iter().zip(expected) {
        assert!((x - expected).abs() <= tolerance, "{x:?} for {expected:?}");
    }
}

#[test]
fn a_sleigh_for_twenty_seconds() {
    // with b = −0.2 the centre of mass is beside the edge: shift the contact point along it instead,
    // v₁ − b ω is the velocity of the point of the body that is not
    let (a, b) = (0.35, -0.2);
    let system = Sleigh { m: 1.5, J: 0.8, a, c: 0.0 };
    let (sin, cos) = 0.3_f64.sin_cos();
    // the contact point of the shifted edge is at b along the second axis
    let start = SleighState { theta: 0.3, x: -b * sin, y: b * cos, omega: 1.1, v1: -0.6 - b * 1.1 };
    let mut sim = Integrator::new(system, Taylor::new().rtol(1e-15), 0.0, start);
    sim.advance_to(20.0).unwrap();
    let end = sim.state();
    let (sin, cos) = end.theta.sin_cos();
    let found = [end.theta, end.x + b * sin, end.y - b * cos, end.omega, end.v1 + b * end.omega];
    let expected = [
        4.867_242_701_758_369,
        -0.591_984_051_315_226_1,
        -15.542_084_728_666_937,
        0.000_117_343_795_806_487_74,
        0.968_459_016_525_313_4,
    ];
    compare(&found, &expected, 4e-14);
}

#[test]
fn the_veselova_system_for_a_hundred_seconds() {
    let inertia = [[2.1, 0.0, 0.0], [0.0, 2.8, 0.0], [0.0, 0.0, 3.3]];
    let system = Veselova { I: inertia, c: [0.9, -0.4, 1.7] };
    let start = VeselovaState { g: [14.0 / 15.0, 2.0 / 15.0, 1.0 / 3.0], w: [0.6, -1.1, -1.24] };
    let mut sim = Integrator::new(system, Taylor::new().rtol(1e-15), 0.0, start);
    sim.advance_to(100.0).unwrap();
    let expected = [
        -0.896_835_541_531_127_4,
        -0.051_296_845_938_864_89,
        0.439_379_841_416_619_7,
        -0.674_143_014_110_514,
        1.498_745_361_899_331_5,
        -1.201_043_961_181_442_7,
    ];
    let found: [f64; 6] = (*sim.state()).into();
    // some 800 steps, and errors grow by a factor of a few
    compare(&found, &expected, 5e-13);
}

#[test]
fn a_tractor_with_three_trailers_in_two_formulations() {
    let (a, m, J, d) = (0.25, [1.5, 0.8, 0.6, 0.5], [0.4, 0.2, 1.0 / 7.0, 1.0 / 9.0], [0.0, 0.9, 0.8, 0.7]);
    let system = Tractor { m, J, d, a };
    let start = TractorState { x: 0.3, y: -0.2, theta: [0.1, 0.4, 0.2, -0.3], v1: 0.6, om_0: 0.2 };
    let velocity = system.velocity(0.0, &start);
    let (sin, cos) = start.theta[0].sin_cos();
    let other_start = ProjectedTractorState {
        x: start.x,
        y: start.y,
        theta: start.theta,
        x_dot: velocity.v1 * cos,
        y_dot: velocity.v1 * sin,
        theta_dot: velocity.om,
    };
    let mut sim = Integrator::new(system, Taylor::new().rtol(1e-15), 0.0, start);
    sim.set_input(TractorInput { F: 0.3, tau: 0.1 });
    let projected = ProjectedTractor { m, J, d, a };
    let mut other = Integrator::new(projected, Taylor::new().rtol(1e-15), 0.0, other_start);
    other.set_input(ProjectedTractorInput { F: 0.3, tau: 0.1 });
    sim.advance_to(10.0).unwrap();
    other.advance_to(10.0).unwrap();
    let (x, y) = (sim.state(), other.state());
    let found = [x.x, x.y, x.theta[0], x.theta[1], x.theta[2], x.theta[3], x.om_0];
    let expected = [y.x, y.y, y.theta[0], y.theta[1], y.theta[2], y.theta[3], y.theta_dot[0]];
    compare(&found, &expected, 1e-11);
}
