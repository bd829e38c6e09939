//! Other derivations of the same equations, as generated code: `emit { gibbs_appell }`.

use nonholonomic::prelude::*;

/// In a basis of D, with a drift, a force by a method, and an input.
#[nonholonomic(
    base   { theta, x, y }
    basis  { omega, v1, v2 }
    anchor {
        der(theta) = omega;
        der(x) = v1 * cos(theta) - v2 * sin(theta);
        der(y) = v1 * sin(theta) + v2 * cos(theta);
    }
    lagrangian  { J / 2 * omega^2 + m / 2 * (v1^2 + (v2 + a * omega)^2) }
    constraints { v2 = slip * cos(t) * sin(theta); }
    forces      { omega: torque - c * omega; v1: self.brake(v1); }
    inputs      { torque }
    emit        { gibbs_appell }
)]
#[derive(Clone, Copy, Debug)]
struct Sleigh {
    m: f64,
    J: f64,
    a: f64,
    c: f64,
    slip: f64,
}

impl Sleigh {
    fn brake(&self, v: f64) -> f64 {
        -self.c * v * v.abs()
    }
}

/// On all of E, with multipliers.
#[nonholonomic(
    base { g[3] }
    on { dot(g, g) = 1; }
    basis { w[3] }
    anchor { der(g) = cross(g, w); }
    brackets so(3) { w }
    lagrangian  { (A * w[0]^2 + B * w[1]^2 + C * w[2]^2) / 2 - dot(c, g) }
    constraints { dot(g, w) = 0; }
    emit        { gibbs_appell }
)]
#[derive(Clone, Copy, Debug)]
struct Veselova<T> {
    A: T,
    B: T,
    C: T,
    c: [T; 3],
}

/// With what is tracked alone, and forces along sections that span D.
#[nonholonomic(
    base { x, phi, psi }
    lagrangian { m / 2 * der(x)^2 + (I * der(phi)^2 + J * der(psi)^2) / 2 }
    distribution { roll, spin }
    frame { roll = phi_dot + r * x_dot; spin = psi_dot; }
    forces { roll: push - sin(phi); }
    inputs { push }
    track { roll, phi }
    emit { gibbs_appell }
)]
#[derive(Clone, Copy, Debug)]
struct Wheel {
    m: f64,
    I: f64,
    J: f64,
    r: f64,
}

fn assert_same<S: State<Scalar = f64>>(found: &S, expected: &S) {
    for (a, b) in found.to_array().as_ref().iter().zip(expected.to_array().as_ref()) {
        assert!((a - b).abs() <= 1e-14 * (1.0 + b.abs()), "{a} is not {b}");
    }
}

#[test]
fn gibbs_and_appell_agree() {
    let sleigh = Sleigh { m: 1.2, J: 0.4, a: 0.3, c: 0.2, slip: 0.7 };
    let state = SleighState { theta: 0.4, x: 1.0, y: 2.0, omega: 1.1, v1: -0.8 };
    let input = SleighInput { torque: 0.3 };
    assert_same(&sleigh.gibbs_appell(0.7, &state, &input), &sleigh.derivative(0.7, &state, &input));

    let body = Veselova { A: 1.0, B: 1.7, C: 2.2, c: [0.3, -0.2, 0.5] };
    let state = VeselovaState { g: [0.6, 0.0, 0.8], w: [0.8, 0.5, -0.6] };
    assert_same(&body.gibbs_appell(0.0, &state, &()), &body.derivative(0.0, &state, &()));

    let wheel = Wheel { m: 1.0, I: 0.2, J: 0.1, r: 0.5 };
    let (state, input) = (WheelState { phi: 0.4, roll: 1.0 }, WheelInput { push: 2.0 });
    let rates = wheel.gibbs_appell(0.0, &state, &input);
    assert_same(&rates, &wheel.derivative(0.0, &state, &input));
    assert!((rates.roll - (2.0 - 0.4_f64.sin()) / (0.2 + 0.25)).abs() < 1e-14);
}
