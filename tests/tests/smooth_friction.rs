//! Functions of velocities that constraints or a rate determine: what is emitted is what is written, by hand.

#![allow(non_snake_case, missing_docs)]

use nonholonomic::prelude::*;

/// A wheel that rolls along a belt, which a slide pulls: friction of the belt's speed over the ground.
#[nonholonomic(
    base        { x, phi, y }
    lagrangian  { m / 2 * (der(x)^2 + der(y)^2) + J / 2 * der(phi)^2 }
    constraints { der(x) = r * der(phi) + q * der(y); }
    forces      { x: -c * tanh(k * der(x)); }
    outputs     { wave = sin(2 * der(x)); growth = exp(der(x) / 2); }
)]
#[derive(Clone, Copy, Debug)]
struct Belt {
    m: f64,
    J: f64,
    r: f64,
    q: f64,
    c: f64,
    k: f64,
}

#[test]
fn friction_of_a_determined_velocity() {
    let belt = Belt { m: 1.3, J: 0.4, r: 0.7, q: -0.6, c: 0.9, k: 1.7 };
    let Belt { m, J, r, q, c, k } = belt;
    for (phi_dot, y_dot) in [(0.3, 0.8), (-1.4, 0.2), (2.0, 1.9)] {
        let state = BeltState { phi_dot, y_dot, ..BeltState::default() };
        let x_dot = r * phi_dot + q * y_dot;
        let force = -c * (k * x_dot).tanh();
        // the masses along both velocities that are kept
        let (a, b, d) = (m * r * r + J, m * r * q, m * q * q + m);
        let determinant = a * d - b * b;
        let expected = [(r * d - b * q) * force / determinant, (a * q - b * r) * force / determinant];
        let rate = belt.derivative(0.0, &state, &());
        for (found, expected) in [rate.phi_dot, rate.y_dot].iter().zip(expected) {
            assert!((found - expected).abs() < 1e-14, "{found} {expected}");
        }
        let outputs = belt.outputs(0.0, &state, &());
        assert!((outputs.wave - (2.0 * x_dot).sin()).abs() < 1e-15);
        assert!((outputs.growth - (x_dot / 2.0).exp()).abs() < 4e-15);
    }
}

/// A mass that is pulled by a filter's rate.
#[nonholonomic(
    base       { x, y }
    auxiliary  { der(s) = a * x + b * y; der(w) = sin(k * der(s)) - w; }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) }
    forces     { x: -c * exp(der(s)) - w; }
)]
#[derive(Clone, Copy, Debug)]
struct Filtered {
    m: f64,
    a: f64,
    b: f64,
    c: f64,
    k: f64,
}

#[test]
fn functions_of_the_rate_of_an_auxiliary_state() {
    let system = Filtered { m: 1.3, a: 0.7, b: -0.4, c: 0.9, k: 1.7 };
    let state = FilteredState { x: 0.6, y: -1.1, x_dot: 0.2, y_dot: 0.1, s: 3.0, w: 0.5 };
    let rate = system.derivative(0.0, &state, &());
    let s_dot = 0.7 * 0.6 + 0.4 * 1.1;
    assert!((rate.s - s_dot).abs() < 1e-15 && (rate.w - ((1.7 * s_dot).sin() - 0.5)).abs() < 1e-15);
    assert!((rate.x_dot - (-0.9 * s_dot.exp() - 0.5) / 1.3).abs() < 4e-15 && rate.y_dot == 0.0);
}
