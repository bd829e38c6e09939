//! Brackets, R_L and connections of systems that are in no list, against `reference/brackets`: any regular
//! Lagrangian, affine, moving and nonlinear constraints, embedded bases, forces that call methods.
#![allow(non_snake_case, reason = "parameters are written as in mechanics: J, I")]

use std::collections::HashMap;
use std::sync::OnceLock;

use nonholonomic::prelude::*;

type Reference = HashMap<String, HashMap<String, Vec<String>>>;

/// Values are of order one, and few operations lead to them.
const ROUND_OFF: f64 = 4e-15;

fn reference(system: &str, what: &str) -> Vec<f64> {
    static DATA: OnceLock<Reference> = OnceLock::new();
    let data = DATA.get_or_init(|| {
        serde_json::from_str(include_str!("../reference/brackets/brackets.json")).expect("valid data")
    });
    data[system][what].iter().map(|text| text.parse().expect("a number")).collect()
}

fn compare(system: &str, what: &str, found: &[f64]) {
    let expected = reference(system, what);
    assert_eq!(found.len(), expected.len(), "{system}: {what}");
    for (index, (found, expected)) in found.iter().zip(&expected).enumerate() {
        let gap = (found - expected).abs();
        assert!(gap <= ROUND_OFF * (1.0 + expected.abs()), "{system}: {what} {index}: {found} {expected}");
    }
}

/// The brackets of the outputs with each other and with the energy, and the drift.
macro_rules! check {
    ($name:literal, $system:expr, $t:expr, $state:expr, $input:expr) => {{
        let (system, t, state, input) = ($system, $t, $state, $input);
        let matrix = system.bracket(t, &state, &input);
        // row by row
        compare($name, "bracket", matrix.transpose().as_slice());
        compare($name, "energy", &<[f64; _]>::from(system.bracket_with_energy(t, &state, &input)));
        compare($name, "drift", &<[f64; _]>::from(system.drift_of_outputs(t, &state, &input)));
    }};
}

/// A relativistic particle with an affine constraint.
#[nonholonomic(
    base { x, y, z }
    lagrangian { -m * c^2 * sqrt(1 - (der(x)^2 + der(y)^2 + der(z)^2) / c^2) - k * x^2 / 2 }
    constraints { der(z) = y * der(x) + w * x; }
    outputs { o1 = x; o2 = y; o3 = z; o4 = der(x) + y * der(z); o5 = der(y) * x; }
    emit { bracket }
)]
#[derive(Clone, Copy, Debug)]
struct Relativistic {
    m: f64,
    c: f64,
    k: f64,
    w: f64,
}

/// A skate with kinetic energy of fourth order, in the projected formulation.
#[nonholonomic(
    base { x, y, theta }
    lagrangian {
        let square = der(x)^2 + der(y)^2;
        m / 2 * square + q / 4 * square^2 + J / 2 * der(theta)^2 - g * sin(x)
    }
    constraints { sin(theta) * der(x) - cos(theta) * der(y) = 0; }
    outputs {
        o1 = x; o2 = y; o3 = theta;
        o4 = der(x) * cos(theta) + der(y) * sin(theta);
        o5 = der(theta) * x;
        o6 = sin(theta) * der(x) - cos(theta) * der(y);
    }
    emit { bracket }
)]
#[derive(Clone, Copy, Debug)]
struct QuarticSkate {
    m: f64,
    q: f64,
    J: f64,
    g: f64,
}

/// The constraint of Appell and Hamel.
#[nonholonomic(
    base { x, y, z }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) - m * g * z }
    constraints { der(x)^2 + der(y)^2 = k^2 * der(z)^2; }
    outputs { o1 = x; o2 = y; o3 = z; o4 = der(x); o5 = der(y); o6 = der(z); }
    emit { bracket }
)]
#[derive(Clone, Copy, Debug)]
struct AppellHamel {
    m: f64,
    g: f64,
    k: f64,
}

/// A constraint that moves, and an output that does.
#[nonholonomic(
    base { x, y, theta }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) + J / 2 * der(theta)^2 }
    constraints { der(theta) = sin(t) + x * der(y); }
    outputs { o1 = x; o2 = y * t; o3 = der(y) * der(x); }
    emit { bracket }
)]
#[derive(Clone, Copy, Debug)]
struct Steered {
    m: f64,
    J: f64,
}

/// A nonlinear constraint that is not homogeneous, in a magnetic field.
#[nonholonomic(
    base { x, y, z }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + (1 + x^2) * der(z)^2) - k * x * y + B * y * der(z) }
    constraints { der(x)^2 + der(y)^2 + y * der(z)^2 = c^2 + x * der(z); }
    outputs { o1 = x; o2 = y; o3 = z; o4 = der(x); o5 = der(y) * x; o6 = der(z); }
    emit { bracket }
)]
#[derive(Clone, Copy, Debug)]
struct Speed {
    m: f64,
    k: f64,
    c: f64,
    B: f64,
}

/// D by sections that span it, forces along one of them and along a coordinate; W is singular.
#[nonholonomic(
    base { x, y, z }
    basis { a, b, c }
    anchor { der(x) = a; der(y) = b * cos(x); der(z) = c + y * a; }
    lagrangian { (a^2 + m * b^2 * exp(x)) / 2 + k * a * b - x^2 * z }
    frame { s = a + y * c; d = b - x * c; n = c; }
    distribution { s, d }
    forces { s: -f * x; z: 0.3 * x; }
    outputs { o1 = x; o2 = y * z; o3 = a; o4 = b * b; o5 = c; }
    emit { bracket, hamiltonian }
)]
#[derive(Clone, Copy, Debug)]
struct Spanned<T> {
    m: T,
    k: T,
    f: T,
}

/// Veselova's constraint, affine and moving, with a term of fourth order and a motor.
#[nonholonomic(
    base { g[3] }
    on { dot(g, g) = 1; }
    basis { w[3] }
    anchor { der(g) = cross(g, w); }
    brackets so(3) { w }
    lagrangian  { sum(i in 0..3: I[i] * w[i]^2) / 2 + k * g[0] * w[1] - dot(c, g) + e * w[2]^4 }
    constraints { dot(g, w) = h * (1 + t) + g[2]; }
    forces      { w[0]: self.motor(w[1], g[0]); w[2]: u * g[0]; }
    inputs      { u }
    derivative  { motor: [self.motor_by_speed, self.motor_by_angle]; }
    outputs {
        direction[i in 0..3] = g[i];
        spin[i in 0..3] = I[i] * w[i] * t;
        power = self.motor(w[0], g[1]) * w[2];
    }
    emit { bracket }
)]
#[derive(Clone, Copy, Debug)]
struct MovingVeselova {
    I: [f64; 3],
    c: [f64; 3],
    h: f64,
    k: f64,
    e: f64,
}

#[allow(clippy::unused_self, reason = "forces call methods of the struct")]
impl MovingVeselova {
    fn motor(&self, speed: f64, angle: f64) -> f64 {
        (speed * angle).sin()
    }
    fn motor_by_speed(&self, speed: f64, angle: f64) -> f64 {
        (speed * angle).cos() * angle
    }
    fn motor_by_angle(&self, speed: f64, angle: f64) -> f64 {
        (speed * angle).cos() * speed
    }
}

/// A ball that is not homogeneous, on a rotating table, on springs.
#[nonholonomic(
    base { x, y, R[3][3] }
    on {
        for i in 0..3 { sum(k in 0..3: R[k][i]^2) = 1; }
        for i in 0..2 { for j in i + 1..3 { sum(k in 0..3: R[k][i] * R[k][j]) = 0; } }
    }
    basis { u, v, w[3] }
    anchor {
        der(x) = u;
        der(y) = v;
        for i in 0..3 {
            der(R[i][0]) = R[i][1] * w[2] - R[i][2] * w[1];
            der(R[i][1]) = R[i][2] * w[0] - R[i][0] * w[2];
            der(R[i][2]) = R[i][0] * w[1] - R[i][1] * w[0];
        }
    }
    brackets so(3) { w }
    lagrangian { m / 2 * (u^2 + v^2) + sum(i in 0..3: I[i] * w[i]^2) / 2 - stiff / 2 * (x^2 + y^2) }
    constraints {
        u = r * sum(j in 0..3: R[1][j] * w[j]) - Om * y;
        v = -r * sum(j in 0..3: R[0][j] * w[j]) + Om * x;
    }
    outputs { o1 = x; o2 = y; o3 = R[2][0]; o4 = w[0]; o5 = u; o6 = w[1] * R[0][1]; }
    emit { bracket, hamiltonian }
)]
#[derive(Clone, Copy, Debug)]
struct BallOnTable {
    m: f64,
    I: [f64; 3],
    r: f64,
    Om: f64,
    stiff: f64,
}

/// A frame with brackets, a mass matrix with an entry off the diagonal.
#[nonholonomic(
    base { x, y, z }
    basis { a, b, c }
    anchor { der(x) = a * (1 + y^2); der(y) = b * exp(x); der(z) = c + x * a; }
    lagrangian { m / 2 * (a^2 + b^2 * (2 + sin(y)) + c^2 + 2 / 3 * x * a * c) + k * x * b }
    constraints { c = y * a; }
    emit { connection }
)]
#[derive(Clone, Copy, Debug)]
struct Cone {
    m: f64,
    k: f64,
}

/// The connection on all of E.
#[nonholonomic(
    base { x, y, theta }
    lagrangian {
        m / 2 * (der(x)^2 + der(y)^2) + J / 2 * der(theta)^2 + l * cos(theta) * der(theta) * der(x)
    }
    constraints { sin(theta) * der(x) - cos(theta) * der(y) = 0; }
    emit { connection }
)]
#[derive(Clone, Copy, Debug)]
struct Skate {
    m: f64,
    J: f64,
    l: f64,
}

/// Checks mathematics (17).
#[test]
fn any_regular_lagrangian() {
    let system = Relativistic { m: 1.3, c: 2.0, k: 0.7, w: 0.4 };
    let state = RelativisticState { x: 0.3, y: -0.5, z: 0.2, x_dot: 0.6, y_dot: -0.4 };
    check!("relativistic", system, 0.0, state, ());
    let system = QuarticSkate { m: 1.3, q: 0.8, J: 0.7, g: 0.9 };
    let (theta, x_dot) = (0.6_f64, 0.6);
    let y_dot = x_dot * theta.tan();
    let state = QuarticSkateState { x: 0.3, y: -0.5, theta, x_dot, y_dot, theta_dot: -0.4 };
    check!("quartic_skate", system, 0.0, state, ());
    // no drift, and literally so
    let drift = <[f64; 6]>::from(system.drift_of_outputs(0.0, &state, &()));
    assert!(drift.iter().all(|rate| rate.abs() <= 0.0), "{drift:?}");
}

/// Checks mathematics (18).
#[test]
fn nonlinear_constraints() {
    let system = AppellHamel { m: 1.3, g: 0.9, k: 1.25 };
    let state = AppellHamelState { x: 0.3, y: -0.5, z: 0.6, x_dot: 0.6, y_dot: 0.8, z_dot: 0.8 };
    check!("appell_hamel", system, 0.0, state, ());
    let (x, y, y_dot, z_dot, c) = (0.3, 0.5, 0.8, -0.4, 1.25);
    let system = Speed { m: 1.3, k: 0.9, c, B: 0.4 };
    let square: f64 = c * c + x * z_dot - y_dot * y_dot - y * z_dot * z_dot;
    let state = SpeedState { x, y, z: 0.6, x_dot: square.sqrt(), y_dot, z_dot };
    check!("speed", system, 0.0, state, ());
}

/// Checks mathematics (28).
#[test]
fn constraints_that_move() {
    let system = Steered { m: 1.3, J: 0.7 };
    let state = SteeredState { x: 0.3, y: -0.5, theta: 0.6, x_dot: 0.6, y_dot: 0.8 };
    check!("steered", system, 0.35, state, ());
    let (t, h, g) = (0.3, 0.25, [1.0 / 3.0, 2.0 / 3.0, -2.0 / 3.0]);
    let system = MovingVeselova { I: [1.3, 2.0, 1.7], c: [0.2, -0.3, 0.5], h, k: 0.4, e: 0.15 };
    let w2 = (h * (1.0 + t) + g[2] - g[0] * 0.6 - g[1] * 0.8) / g[2];
    let state = MovingVeselovaState { g, w: [0.6, 0.8, w2] };
    check!("moving_veselova", system, t, state, MovingVeselovaInput { u: 0.7 });
}

#[test]
fn bases_of_the_distribution() {
    let system = Spanned { m: 1.3_f64, k: 0.3, f: 0.8 };
    let state = SpannedState { x: 0.3, y: -0.5, z: 0.6, s: 0.6, d: 0.8 };
    check!("spanned", system, 0.0, state, ());
    // on D* the drift is the force: Υ(s) = −f x + 0.3 x (y + y), Υ(d) = −0.3 x²
    let drift = system.drift(0.0, &system.legendre(0.0, &state), &());
    assert!((drift.p_s - (-0.8 * 0.3 - 0.3 * 0.3)).abs() < ROUND_OFF, "{drift:?}");
    assert!((drift.p_d + 0.3 * 0.3 * 0.3).abs() < ROUND_OFF, "{drift:?}");
    let turned = [[-20.0, 4.0, 22.0], [20.0, -10.0, 20.0], [10.0, 28.0, 4.0]];
    let R = turned.map(|row| row.map(|entry| entry / 30.0));
    let system = BallOnTable { m: 1.3, I: [1.3, 2.0, 1.7], r: 0.6, Om: 0.45, stiff: 0.7 };
    let state = BallOnTableState { x: 0.3, y: -0.5, R, w: [0.6, 0.8, -0.3] };
    check!("ball_on_table", system, 0.0, state, ());
    let phase = system.legendre(0.0, &state);
    let (all, bracket, drift) =
        (system.hamilton(0.0, &phase, &()), system.poisson(0.0, &phase), system.drift(0.0, &phase, &()));
    // ẋ = R_L(x) + {x, π_a} ∂h/∂π_a, where ∂h/∂π is the velocity without its part normal to D
    let expected = reference("ball_on_table", "drift");
    assert!((drift.x - expected[0]).abs() < ROUND_OFF && (drift.y - expected[1]).abs() < ROUND_OFF);
    let h = 1e-5;
    let slope = |a: usize| {
        let moved = |by: f64| {
            let mut values = <[f64; 14]>::from(phase);
            values[11 + a] += by;
            system.hamiltonian(0.0, &BallOnTablePhase::from(values))
        };
        (moved(h) - moved(-h)) / (2.0 * h)
    };
    let sum: f64 = (0..3).map(|a| bracket[(0, 11 + a)] * slope(a)).sum();
    // h is quadratic: the difference is exact but for its rounding, ε/h
    assert!((all.x - drift.x - sum).abs() < 1e-10);
}

/// Checks mathematics (21).
#[test]
fn connections() {
    let system = Cone { m: 1.3, k: 0.5 };
    let state = ConeState { x: 0.3, y: -0.5, z: 0.6, ..Default::default() };
    compare("cone", "christoffel", system.christoffel(0.0, &state).as_flattened().as_flattened());
    compare("cone", "connection", system.connection(0.0, &state).as_flattened().as_flattened());
    let system = Skate { m: 1.3, J: 0.7, l: 0.2 };
    let state = SkateState { x: 0.3, y: -0.5, theta: 0.6, ..Default::default() };
    compare("skate", "christoffel", system.christoffel(0.0, &state).as_flattened().as_flattened());
    compare("skate", "connection", system.connection(0.0, &state).as_flattened().as_flattened());
}
