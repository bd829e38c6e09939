//! A long pendulum in x and y for a day and more, beside the elliptic functions of its swing.

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    holonomic { rope: x^2 + y^2 = l^2; }
    lagrangian { (der(x)^2 + der(y)^2) / 2 - g * y }
)]
#[derive(Clone, Copy, Debug)]
struct Swing {
    l: f64,
    g: f64,
}

#[test]
fn a_hundred_thousand_seconds() {
    let swing = Swing { l: 250.0, g: 9.81 };
    let (sin, cos) = 1.0_f64.sin_cos();
    let start = SwingState { x: 250.0 * sin, y: -250.0 * cos, ..SwingState::default() };
    let mut sim = Integrator::new(swing, Dop853::new().rtol(1e-11).atol(1e-11), 0.0, start);
    sim.advance_to(1e5).unwrap();
    let state = sim.state();
    let left: [f64; 2] = swing.constraint_residual(1e5, state).into();
    assert!(left.iter().all(|left| left.abs() < 1e-9), "{left:?}");
    let drift = swing.energy(1e5, state) / swing.energy(0.0, &start) - 1.0;
    assert!(drift.abs() < 1e-7, "{drift:e}");
    // sin θ/2 = k cd(ω t), reference/loops.py
    let (angle, rate) = (state.x.atan2(-state.y), state.x_dot.hypot(state.y_dot) / 250.0);
    assert!((angle + 0.845_790_430_120_868_9).abs() < 1e-4, "{angle}");
    assert!((rate - 0.098_184_983_366_055_5).abs() < 1e-4, "{rate}");
}
