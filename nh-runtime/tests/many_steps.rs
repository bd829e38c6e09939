//! Many steps: what they leave of the energy and of the way. Ten to the eight of each system in release, which is
//! a test of the project's own check: `cargo test --release -p nonholonomic --test many_steps`.

#![allow(non_snake_case, reason = "parameters are written as in mechanics")]

use nonholonomic::prelude::*;

/// A Chaplygin sleigh whose centre of mass lies on the line of the blade.
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
    assume      { m > 0; J > 0; }
)]
#[derive(Clone, Copy, Debug)]
struct Sleigh {
    m: f64,
    J: f64,
    a: f64,
}

/// Suslov's problem.
#[nonholonomic(
    basis { w1, w2, w3 }
    brackets so(3) { w1, w2, w3 }
    lagrangian { dot([w1, w2, w3], I * [w1, w2, w3]) / 2 }
    constraints { w3 = 0; }
)]
#[derive(Clone, Copy, Debug)]
struct Suslov {
    I: [[f64; 3]; 3],
}

/// Sleigh and Suslov over many steps: what the energy and the position have lost.
fn long_run(steps: u32) {
    let h = 0.01;
    let end = f64::from(steps) * h;
    let sleigh = Sleigh { m: 1.0, J: 1.0, a: 0.5 };
    let start = SleighState { omega: 0.1, v1: -1.0, ..SleighState::default() };
    let before = sleigh.energy(0.0, &start);
    let mut sim = Integrator::new(sleigh, Rk4::new(h).compensated(), 0.0, start).max_steps(u64::MAX);
    // until it slides straight on, and then for the rest
    sim.advance_to(end / 10.0).unwrap();
    let (t, half) = (sim.time(), *sim.state());
    sim.advance_to(end).unwrap();
    let state = sim.state();
    assert!(
        (sleigh.energy(0.0, state) / before - 1.0).abs() < 1e-9,
        "{}",
        sleigh.energy(0.0, state) / before
    );
    assert!((state.v1 - half.v1).abs() < 1e-14);
    let gone = (state.x - half.x).hypot(state.y - half.y) / (half.v1 * (end - t));
    assert!((gone - 1.0).abs() < 4e-15, "{:e}", gone - 1.0);

    let suslov = Suslov { I: [[2.0, 0.0, 0.3], [0.0, 3.0, 0.4], [0.3, 0.4, 2.5]] };
    let start = SuslovState { w1: 0.6, w2: -0.3 };
    let before = suslov.energy(0.0, &start);
    let mut sim = Integrator::new(suslov, Rk4::new(h).compensated(), 0.0, start).max_steps(u64::MAX);
    sim.advance_to(end).unwrap();
    assert!((suslov.energy(0.0, sim.state()) / before - 1.0).abs() < 1e-10);
}

#[test]
fn many_steps() {
    long_run(if cfg!(debug_assertions) { 50_000 } else { 100_000_000 });
}
