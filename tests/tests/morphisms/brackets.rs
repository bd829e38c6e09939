//! Reductions relate the nonholonomic brackets, CLMM Theorems 4.7 and 7.9: {f∘Φ, g∘Φ} = {f, g}∘Φ.

use nonholonomic::prelude::*;

/// A sleigh in the frame of its body.
#[nonholonomic(
    base   { theta, x, y }
    basis  { omega, v1, v2 }
    anchor {
        der(theta) = omega;
        der(x) = v1 * cos(theta) - v2 * sin(theta);
        der(y) = v1 * sin(theta) + v2 * cos(theta);
    }
    lagrangian  { J / 2 * omega^2 + m / 2 * (v1^2 + (v2 + a * omega)^2) }
    constraints { v2 = 0; }
    outputs     { f = v1^2; g = omega * v1; h = omega; }
    emit        { bracket }
)]
#[derive(Clone, Copy, Debug)]
struct Sleigh {
    m: f64,
    J: f64,
    a: f64,
}

quotient! {
    Sleigh -> #[derive(Clone, Copy, Debug)] struct ReducedSleigh by { theta, x, y } {
        outputs { f = v1^2; g = omega * v1; h = omega; }
        emit    { bracket }
    }
}

/// A ball on a turning table, its attitude in Cardan angles: an affine constraint.
#[nonholonomic(
    base { x, y, a, b, c }
    velocities {
        wx = der(a) + sin(b) * der(c);
        wy = cos(a) * der(b) - sin(a) * cos(b) * der(c);
        wz = sin(a) * der(b) + cos(a) * cos(b) * der(c);
        dx = der(x);
        dy = der(y);
    }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + k2 * (wx^2 + wy^2 + wz^2)) }
    constraints { dx = r * wy - Omega * y; dy = -r * wx + Omega * x; }
    outputs { f = x * wy; g = wx * wz; h = y + wz^2; }
    emit { bracket }
)]
#[derive(Clone, Copy, Debug)]
struct Ball {
    m: f64,
    r: f64,
    k2: f64,
    Omega: f64,
}

quotient! {
    Ball -> #[derive(Clone, Copy, Debug)] struct ReducedBall by { a, b, c } {
        outputs { f = x * wy; g = wx * wz; h = y + wz^2; }
        emit    { bracket }
    }
}

#[test]
fn brackets_are_related() {
    let sleigh = Sleigh { m: 1.3, J: 0.7, a: 0.4 };
    let state = SleighState { theta: 0.3, x: 1.0, y: 2.0, omega: 0.9, v1: -0.6 };
    let full = sleigh.bracket(0.0, &state, &());
    let reduced = sleigh.reduced().bracket(0.0, &sleigh.reduce(0.0, &state), &());
    assert!((full[(0, 2)]).abs() > 1e-3, "nothing is compared");
    assert!((full - reduced).abs().max() < 1e-14, "{full} is not {reduced}");

    let ball = Ball { m: 1.0, r: 0.3, k2: 0.036, Omega: 0.8 };
    let state = BallState { x: 0.4, y: 0.1, a: 0.2, b: -0.3, c: 0.5, wx: 1.0, wy: -0.5, wz: 0.3 };
    let full = ball.bracket(0.0, &state, &());
    let reduced = ball.reduced().bracket(0.0, &ball.reduce(0.0, &state), &());
    assert!((full[(0, 2)]).abs() > 1e-3, "nothing is compared");
    assert!((full - reduced).abs().max() < 1e-13, "{full} is not {reduced}");
}
