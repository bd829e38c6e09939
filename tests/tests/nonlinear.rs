//! Nonlinear constraints in long runs: kept to round-off, with the energy that theory gives them.

use nh_tests::comparison::larger;
use nh_tests::systems::nonlinear::{
    ConstantSpeed, ConstantSpeedState, GrowingSpeed, GrowingSpeedState, ParallelVelocities,
    ParallelVelocitiesState,
};
use nonholonomic::prelude::*;

const STEPS: usize = 100_000;

#[test]
fn parallel_velocities_keep_their_energy() {
    // no gravity: with it both points fall, and their velocities become parallel anyway
    let system = ParallelVelocities { m1: 1.1, m2: 2.3, k: 1.7, g: 0.0 };
    let start = ParallelVelocitiesState {
        x2: 1.0,
        y2: 0.6,
        x1_dot: 0.5,
        y1_dot: 0.4,
        x2_dot: 1.0,
        y2_dot: 0.8,
        ..ParallelVelocitiesState::default()
    };
    let mut sim = Integrator::new(system, Projected::new(Rk4::new(0.002), 10), 0.0, start);
    let energy = system.energy(0.0, &start);
    let mut residual = 0.0_f64;
    for step in 0..STEPS {
        sim.step().unwrap();
        if step % 10 == 9 {
            residual = larger(residual, system.constraint_residual(sim.time(), sim.state()).parallel);
        }
    }
    let drift = (system.energy(sim.time(), sim.state()) - energy).abs() / energy;
    println!("residual {residual:e}, energy {drift:e}, {:?}", sim.statistics());
    assert!(residual < 1e-14, "{residual:e}");
    assert!(drift < 1e-8, "{drift:e}");
}

#[test]
fn a_speed_is_held_and_does_work() {
    let system = ConstantSpeed { m: 1.4, c: 2.9, k: 0.8, g: 1.3 };
    let start =
        ConstantSpeedState { x: 0.4, y: -0.2, x_dot: 2.0, y_dot: 2.1, ..ConstantSpeedState::default() };
    let mut sim = Integrator::new(system, Projected::new(Rk4::new(0.002), 10), 0.0, start);
    let (mut residual, mut least, mut most) = (0.0_f64, f64::INFINITY, f64::NEG_INFINITY);
    for step in 0..STEPS {
        sim.step().unwrap();
        if step % 10 == 9 {
            let state = sim.state();
            residual = larger(residual, system.constraint_residual(sim.time(), state).speed);
            let energy = system.energy(sim.time(), state);
            (least, most) = (least.min(energy), most.max(energy));
        }
    }
    println!("residual {residual:e}, energy from {least} to {most}");
    assert!(residual < 1e-14, "{residual:e}");
    // kinetic energy is constant, potential energy is not: the constraint's force does work
    assert!(most - least > 1.0, "{least} {most}");
}

#[test]
fn a_speed_that_grows_is_kept_up_with() {
    let system = GrowingSpeed { m: 1.4, c: 1.8, g: 1.3 };
    let start = GrowingSpeedState { x_dot: 1.8, ..GrowingSpeedState::default() };
    let step = 2e-4;
    let mut sim = Integrator::new(system, Projected::new(Rk4::new(step), 10), 0.0, start);
    let mut residual = 0.0_f64;
    for count in 0..STEPS {
        sim.step().unwrap();
        if count % 10 == 9 {
            let speed = system.c * (1.0 + sim.time());
            let here = system.constraint_residual(sim.time(), sim.state()).speed / (speed * speed);
            residual = larger(residual, here);
        }
    }
    let (t, state) = (sim.time(), *sim.state());
    println!("relative residual {residual:e} at t = {t}: {state:?}");
    assert!(residual < 1e-15, "{residual:e}");
    // E = m c² (1 + t)² / 2 + m g y by the constraint
    let expected = system.m * (system.c * (1.0 + t)).powi(2) / 2.0 + system.m * system.g * state.y;
    assert!((system.energy(t, &state) - expected).abs() < 1e-13 * expected.abs());
    // the direction of motion follows m v φ˙ = −m g cos φ: the Gudermannian of −(g/c) ln(1 + t)
    let angle = -(system.g / system.c * (1.0 + t).ln()).sinh().atan();
    let direction = state.y_dot.atan2(state.x_dot);
    assert!((direction - angle).abs() < 1e-10, "{direction} {angle}");
}
