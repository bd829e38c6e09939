//! The nonholonomic connection and the momentum equation, CM Propositions 8 and 9: against numbers from
//! vector fields on the configuration space, and as the force that makes the reduced Lagrangian right.

use std::path::Path;

use nonholonomic::prelude::*;
use serde_json::Value;

/// A roller racer: of its group SE(2) only the translations are cyclic, the turn is declared.
#[nonholonomic(
    base { theta, x, y, phi }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) + I1 / 2 * der(theta)^2 + I2 / 2 * (der(theta) + der(phi))^2 }
    constraints {
        cos(theta) * der(y) = sin(theta) * der(x);
        cos(theta + phi) * der(y) - sin(theta + phi) * der(x)
            = (d1 * cos(phi) + d2) * der(theta) + d2 * der(phi);
    }
    forces { phi: torque; }
    inputs { torque }
    assume { d2 > 0; }
    symmetries { turn: der(theta) + x * der(y) - y * der(x); }
    emit { splitting }
)]
#[derive(Clone, Copy, Debug)]
struct RollerRacer {
    m: f64,
    I1: f64,
    I2: f64,
    d1: f64,
    d2: f64,
}

/// A snakeboard on the plane, driven at its rotor and its wheels.
#[nonholonomic(
    base { x, y, theta, psi, phi }
    lagrangian {
        m / 2 * (der(x)^2 + der(y)^2) + m * l^2 / 2 * der(theta)^2 + J0 / 2 * der(psi)^2
            + J0 * der(psi) * der(theta) + J1 * der(phi)^2
    }
    constraints {
        -sin(theta + phi) * der(x) + cos(theta + phi) * der(y) - l * cos(phi) * der(theta) = 0;
        -sin(theta - phi) * der(x) + cos(theta - phi) * der(y) + l * cos(phi) * der(theta) = 0;
    }
    forces { psi: drive; phi: steer; }
    inputs { drive, steer }
    symmetries { turn: der(theta) + x * der(y) - y * der(x); spin: der(psi); }
    emit { splitting }
)]
#[derive(Clone, Copy, Debug)]
struct Snakeboard {
    m: f64,
    l: f64,
    J0: f64,
    J1: f64,
}

/// A momentum equation under a curvature over two coordinates; z and u are cyclic.
#[nonholonomic(
    base { x, y, z, u }
    lagrangian {
        (der(x)^2 + der(y)^2 + (1 + x^2) * der(z)^2 + 2 * der(u)^2) / 2 + der(x) * der(u) / 3 - k * x * y
    }
    constraints { der(z) = y * der(x) + sin(x) * der(u); }
    forces { y: f; z: g * der(x); }
    emit { splitting }
)]
#[derive(Clone, Copy, Debug)]
struct Curved {
    k: f64,
    f: f64,
    g: f64,
}

/// D + V is not everything; z is cyclic.
#[nonholonomic(
    base { x, y, z, w }
    lagrangian {
        (der(x)^2 + der(y)^2 + der(w)^2 + (der(z) + y * der(x))^2) / 2 + y * der(z) * der(w) / 4 - w^2 * x
    }
    constraints { der(y) = x * der(w); }
    emit { splitting }
)]
#[derive(Clone, Copy, Debug)]
struct NoDimension {}

/// Without constraints: the mechanical connection, with a force along the group.
#[nonholonomic(
    base { theta, a, b }
    lagrangian {
        (3 + cos(a)) / 2 * der(theta)^2 + (der(a)^2 + der(b)^2) / 2
            + der(theta) * (der(a) * sin(b) + der(b) * a / 2) - k * cos(b)
    }
    forces { theta: f; }
    emit { splitting }
)]
#[derive(Clone, Copy, Debug)]
struct Arm {
    k: f64,
    f: f64,
}

/// A charge in a magnetic field that a Heisenberg group keeps: momenta do not vanish at rest.
#[nonholonomic(
    base { a, x, y, z }
    lagrangian {
        (der(a)^2 + der(x)^2 + (2 + cos(a)) * der(y)^2 + (der(z) - x * der(y))^2) / 2 + sin(a) * der(a) * der(x) / 3
            + B * (cos(a) * der(x) + der(y) / 2 + a * (der(z) - x * der(y)))
    }
    constraints { der(z) - x * der(y) = sin(a) * der(x) + cos(a) * der(a); }
    symmetries { along: der(x) + y * der(z); across: der(y); up: der(z); }
    emit { splitting }
)]
#[derive(Clone, Copy, Debug)]
struct Charge {
    B: f64,
}

/// The numbers of a system.
fn read(name: &str) -> Value {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("reference/splitting.json");
    let text = std::fs::read_to_string(path).unwrap();
    let all: Value = serde_json::from_str(&text).unwrap();
    all[name].clone()
}

fn flat(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(list) => list.iter().flat_map(flat).collect(),
        other => vec![other.as_f64().unwrap()],
    }
}

/// Numbers in nested arrays, the last index fastest.
trait Flat {
    fn flat(&self) -> Vec<f64>;
}

impl Flat for f64 {
    fn flat(&self) -> Vec<f64> {
        vec![*self]
    }
}

impl<T: Flat, const N: usize> Flat for [T; N] {
    fn flat(&self) -> Vec<f64> {
        self.iter().flat_map(Flat::flat).collect()
    }
}

fn assert_close(what: &str, found: &[f64], expected: &Value) {
    let expected = flat(expected);
    assert_eq!(found.len(), expected.len(), "{what}");
    let scale = expected.iter().fold(1.0, |m: f64, x| m.max(x.abs()));
    for (a, b) in found.iter().zip(&expected) {
        assert!((a - b).abs() <= 1e-13 * scale, "{what}: {found:?} is not {expected:?}");
    }
}

/// All functions at the state of the reference.
macro_rules! check {
    ($name:literal, $system:expr, $state:expr, $input:expr) => {{
        let (system, reference) = ($system, read($name));
        let (state, input) = ($state(&flat(&reference["q"]), &flat(&reference["v"])), $input);
        check!(@each system, reference, state;
            vertical_sections, horizontal_lifts, locked_inertia, connection_coefficients, curvature,
            vertical_momenta, vertical_velocities, horizontal_force);
        let rates = system.vertical_momentum_rates(0.0, &state, &input).flat();
        assert_close("rates", &rates, &reference["vertical_momentum_rates"]);
    }};
    (@each $system:ident, $reference:ident, $state:ident; $($function:ident),*) => {
        $(
            let found = $system.$function(0.0, &$state).flat();
            assert_close(stringify!($function), &found, &$reference[stringify!($function)]);
        )*
    };
}

#[test]
fn roller_racer() {
    let racer = RollerRacer { m: 1.3, I1: 0.7, I2: 0.4, d1: 0.6, d2: 0.9 };
    let state = |q: &[f64], v: &[f64]| RollerRacerState {
        theta: q[0],
        x: q[1],
        y: q[2],
        phi: q[3],
        theta_dot: v[0],
        x_dot: v[1],
        y_dot: v[2],
        phi_dot: v[3],
    };
    check!("roller_racer", racer, state, RollerRacerInput { torque: 0.35 });
}

#[test]
fn snakeboard() {
    let board = Snakeboard { m: 1.2, l: 0.8, J0: 0.3, J1: 0.15 };
    let state = |q: &[f64], v: &[f64]| SnakeboardState {
        x: q[0],
        y: q[1],
        theta: q[2],
        psi: q[3],
        phi: q[4],
        x_dot: v[0],
        y_dot: v[1],
        theta_dot: v[2],
        psi_dot: v[3],
        phi_dot: v[4],
    };
    check!("snakeboard", board, state, SnakeboardInput { drive: 0.2, steer: -0.4 });
    for line in [
        "S = D ∩ V, V along the group, has rank 2 (more where cos(phi) = 0, or l = 0 and sin(phi) = 0); D + V = E (the dimension assumption)",
        "momentum section S_body_x = body_x + (-sin(phi)/l/cos(phi))*theta_dot\n",
        "locked inertia <S_body_x, S_body_x> = m/cos(phi)^2\n",
        "connection [h_phi, S_body_x] = (-1/l/cos(phi)^2)*theta_dot\n",
    ] {
        assert!(Snakeboard::REPORT.contains(line), "{line}\n{}", Snakeboard::REPORT);
    }
}

#[test]
fn curvature_over_two_coordinates() {
    let state = |q: &[f64], v: &[f64]| CurvedState {
        x: q[0],
        y: q[1],
        z: q[2],
        u: q[3],
        x_dot: v[0],
        y_dot: v[1],
        u_dot: v[3],
    };
    check!("curved", Curved { k: 0.7, f: 0.3, g: -0.6 }, state, ());
}

#[test]
fn without_the_dimension_assumption() {
    let state = |q: &[f64], v: &[f64]| NoDimensionState {
        x: q[0],
        y: q[1],
        z: q[2],
        w: q[3],
        x_dot: v[0],
        z_dot: v[2],
        w_dot: v[3],
    };
    check!("nodim", NoDimension {}, state, ());
}

#[test]
fn without_constraints() {
    let state = |q: &[f64], v: &[f64]| ArmState {
        theta: q[0],
        a: q[1],
        b: q[2],
        theta_dot: v[0],
        a_dot: v[1],
        b_dot: v[2],
    };
    check!("arm", Arm { k: 0.7, f: 0.3 }, state, ());
}

/// The derivative at 0 by differences of fourth order, and a bound of their error: what half the step
/// changes, and rounding.
fn slope(function: impl Fn(f64) -> f64) -> (f64, f64) {
    const STEP: f64 = 1e-3;
    let difference = |step: f64| {
        (8.0 * (function(step) - function(-step)) - (function(2.0 * step) - function(-2.0 * step)))
            / (12.0 * step)
    };
    let (fine, coarse) = (difference(STEP), difference(2.0 * STEP));
    (fine, (fine - coarse).abs() / 8.0 + function(0.0).abs() * 64.0 * f64::EPSILON / STEP)
}

#[test]
fn momenta_at_rest_are_no_velocities() {
    let charge = Charge { B: 0.7 };
    // L and p in the velocities a', x', y', z' - x y'
    let lagrangian = |a: f64, [u, v, w, s]: [f64; 4]| {
        (u * u + v * v + (2.0 + a.cos()) * w * w + s * s) / 2.0
            + a.sin() * u * v / 3.0
            + charge.B * (a.cos() * v + w / 2.0 + a * s)
    };
    let momenta = |a: f64, [u, v, w, s]: [f64; 4]| {
        let [px, py, pz] = [v + a.sin() * u / 3.0, (2.0 + a.cos()) * w, s];
        [u + a.sin() * v / 3.0, px + charge.B * a.cos(), py + charge.B / 2.0, pz + charge.B * a]
    };
    let reduced = |x: f64, [u, v, w, z]: [f64; 4]| [u, v, w, z - x * w];
    // h a' + S v
    let velocity = |state: &ChargeState, rate: f64, along: [f64; 2]| -> [f64; 4] {
        let [h] = charge.horizontal_lifts(0.0, state);
        let [first, second] = charge.vertical_sections(0.0, state);
        std::array::from_fn(|i| h[i] * rate + first[i] * along[0] + second[i] * along[1])
    };
    let start = [0.4, 0.3, -0.2, 0.1, 0.8, -0.5, 0.6];
    let state = ChargeState::from(start);
    let along = charge.vertical_velocities(0.0, &state);
    // 1. the splitting of the velocity
    let whole: [f64; 4] = charge.velocity(0.0, &state).into();
    for (found, expected) in velocity(&state, state.a_dot, along).iter().zip(whole) {
        assert!((found - expected).abs() < 1e-14, "{found} is not {expected}");
    }
    // 2. d/dt p(h) - h(l) is the horizontal force
    let rates: [f64; 7] = charge.derivative(0.0, &state, &()).into();
    let (change, error) = slope(|h| {
        let there = ChargeState::from(std::array::from_fn(|i| start[i] + h * rates[i]));
        let y = reduced(there.x, charge.velocity(0.0, &there).into());
        let [lift] = charge.horizontal_lifts(0.0, &there);
        let lift = reduced(there.x, lift);
        momenta(there.a, y).iter().zip(lift).map(|(p, h)| p * h).sum()
    });
    let (gradient, other) = slope(|h| {
        let there = ChargeState { a: state.a + h, ..state };
        lagrangian(there.a, reduced(there.x, velocity(&there, state.a_dot, along)))
    });
    let [force] = charge.horizontal_force(0.0, &state);
    assert!((change - gradient - force).abs() < error + other, "{change} - {gradient} is not {force}");
    assert!(error + other < 1e-8 && force.abs() > 0.1, "nothing is tested: {error}, {other}, {force}");
}
