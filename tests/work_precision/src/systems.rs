//! Two motions in several forms.
#![allow(non_snake_case, reason = "parameters are written as in mechanics: J, I")]

use nh_work_precision::Study;
use nonholonomic::prelude::*;

/// A rigid body on a plane, carried by a knife edge.
#[nonholonomic(
    base   { theta, x, y }
    basis  { omega, v1, v2 }
    anchor {
        der(theta) = omega;
        der(x) = v1 * cos(theta) - v2 * sin(theta);
        der(y) = v1 * sin(theta) + v2 * cos(theta);
    }
    lagrangian  { J / 2 * omega^2 + m / 2 * ((v1 - b * omega)^2 + (v2 + a * omega)^2) }
    constraints { v2 = 0; }
    assume      { m > 0; J > 0; }
    emit        { taylor }
)]
#[derive(Clone, Copy, Debug)]
struct Sleigh<T> {
    m: T,
    J: T,
    a: T,
    b: T,
}

/// The same with all velocities in the state.
#[nonholonomic(
    base   { theta, x, y }
    basis  { omega, v1, v2 }
    anchor {
        der(theta) = omega;
        der(x) = v1 * cos(theta) - v2 * sin(theta);
        der(y) = v1 * sin(theta) + v2 * cos(theta);
    }
    lagrangian  { J / 2 * omega^2 + m / 2 * ((v1 - b * omega)^2 + (v2 + a * omega)^2) }
    constraints { v2 = 0; }
    assume      { m > 0; J > 0; }
    formulation { projected }
    emit        { taylor }
)]
#[derive(Clone, Copy, Debug)]
struct ProjectedSleigh<T> {
    m: T,
    J: T,
    a: T,
    b: T,
}

/// A rigid body about a fixed point whose angular velocity stays orthogonal to a vector fixed in space.
#[nonholonomic(
    base  { g[3] }
    basis { w[3] }
    anchor { der(g) = cross(g, w); }
    brackets so(3) { w }
    lagrangian  { sum(i in 0..3: I[i] * w[i]^2) / 2 - dot(c, g) }
    constraints { dot(g, w) = 0; }
    emit        { taylor }
)]
#[derive(Clone, Copy, Debug)]
struct Veselova<T> {
    I: [T; 3],
    c: [T; 3],
}

/// The sleigh for twenty seconds.
fn sleigh() -> Study {
    let mut study = Study::new("sleigh", 0.0, 20.0);
    let start = SleighState { theta: 0.3, x: 0.0, y: 0.0, omega: 1.1, v1: -0.6 };
    let system = Sleigh { m: 1.5, J: 0.8, a: 0.35, b: -0.2 };
    study.variant("adapted", system, start).explicit().implicit().taylor();
    let start = ProjectedSleighState { theta: 0.3, x: 0.0, y: 0.0, omega: 1.1, v1: -0.6, v2: 0.0 };
    let system = ProjectedSleigh { m: 1.5, J: 0.8, a: 0.35, b: -0.2 };
    study.variant("projected", system, start).explicit().taylor();
    let start = SleighState { theta: 0.3_f32, x: 0.0, y: 0.0, omega: 1.1, v1: -0.6 };
    let system = Sleigh { m: 1.5_f32, J: 0.8, a: 0.35, b: -0.2 };
    study.variant("adapted, f32", system, start).explicit().taylor();
    study
}

/// The Veselova system for twenty seconds.
fn veselova() -> Study {
    let mut study = Study::new("veselova", 0.0, 20.0);
    let start = VeselovaState { g: [14.0 / 15.0, 2.0 / 15.0, 1.0 / 3.0], w: [0.6, -1.1, -1.24] };
    let system = Veselova { I: [2.1, 2.8, 3.3], c: [0.9, -0.4, 1.7] };
    study.variant("f64", system, start).explicit().implicit().taylor();
    let start = VeselovaState { g: [14.0 / 15.0, 2.0 / 15.0, 1.0_f32 / 3.0], w: [0.6, -1.1, -1.24] };
    let system = Veselova { I: [2.1_f32, 2.8, 3.3], c: [0.9, -0.4, 1.7] };
    study.variant("f32", system, start).explicit().taylor();
    study
}

/// All of them.
pub(crate) fn all() -> Vec<Study> {
    vec![sleigh(), veselova()]
}
