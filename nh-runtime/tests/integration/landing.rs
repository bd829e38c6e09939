//! Times: landing, direction, dense output at the ends, and what is counted.

use nonholonomic::Method;
use nonholonomic::prelude::*;

use crate::systems::{Driven, Line, Pendulum, Plane, Scalar1, Torque, distance};

const START: Plane<f64> = Plane { q: 1.0, p: 0.0 };

fn lands_exactly<M: Method<Driven>>(method: M, tolerance: f64) {
    let mut sim = Integrator::new(Driven, method, 0.0, START);
    for target in [0.1, 0.3, 0.300_000_001, 1.0, std::f64::consts::PI, 2.0, 0.0, -0.7, -0.7, 0.0] {
        sim.advance_to(target).unwrap();
        assert_eq!(sim.time(), target);
        let error = distance(sim.state(), &Driven::solution(target));
        assert!(error < tolerance, "{error} at {target}");
    }
}

#[test]
fn every_method_lands_exactly_forwards_and_backwards() {
    lands_exactly(Euler::new(1e-4), 1e-2);
    lands_exactly(Rk4::new(0.007), 1e-8);
    lands_exactly(ImplicitMidpoint::new(0.001), 1e-5);
    lands_exactly(Dopri5::new().rtol(1e-10), 1e-8);
}

#[test]
fn a_zero_length_does_nothing() {
    let mut sim = Integrator::new(Driven, Dopri5::new(), 0.25, START);
    sim.advance_to(0.25).unwrap();
    sim.step_towards(0.25).unwrap();
    assert_eq!((*sim.state(), sim.time(), sim.statistics()), (START, 0.25, Statistics::default()));
}

#[test]
fn fixed_steps_are_counted_exactly() {
    let mut sim = Integrator::new(Driven, Rk4::new(0.1), 0.0, START);
    for i in 1..=100 {
        sim.advance_to(f64::from(i) * 0.7).unwrap();
    }
    let statistics = sim.statistics();
    assert_eq!((statistics.steps, statistics.evaluations, statistics.rejected), (700, 2800, 0));
}

#[test]
fn dopri5_reuses_its_last_evaluation() {
    let mut sim = Integrator::new(Driven, Dopri5::new().first_step(0.01), 0.0, START);
    sim.advance_to(5.0).unwrap();
    let statistics = sim.statistics();
    assert_eq!(statistics.evaluations, 1 + 6 * (statistics.steps + statistics.rejected));
}

#[test]
fn frequent_targets_do_not_shorten_the_steps() {
    let mut sim = Integrator::new(Driven, Dopri5::new().rtol(1e-6), 0.0, START);
    for i in 1..=1000 {
        sim.advance_to(f64::from(i) * 0.01).unwrap();
    }
    assert_eq!(sim.statistics().steps, 1000);
    sim.reset(0.0, START);
    sim.advance_to(10.0).unwrap();
    assert!(sim.statistics().steps < 60, "{:?}", sim.statistics());
}

#[test]
fn a_new_input_acts_at_once() {
    let system = Scalar1(|_, _, u| u);
    let mut sim = Integrator::new(system, Dopri5::new(), 0.0, Line { x: 0.0 });
    for (i, torque) in [1.0, -2.0, 3.0, 0.5].into_iter().enumerate() {
        let before = sim.state().x;
        sim.set_input(Torque { torque });
        assert_eq!(sim.input().torque, torque);
        sim.advance_to(f64::from(u8::try_from(i).unwrap()) + 1.0).unwrap();
        assert!((sim.state().x - before - torque).abs() < 1e-14);
    }
}

#[test]
fn dense_output_meets_the_ends_and_keeps_the_old_input() {
    fn check<M: Method<Pendulum<f64>>>(method: M) {
        let mut sim = Integrator::new(Pendulum { g: 1.0 }, method, 0.0, START);
        assert_eq!(sim.at(0.0), Ok(START));
        assert!(matches!(sim.at(0.1), Err(IntegrationError::OutsideLastStep { .. })));
        sim.set_input(Torque { torque: 5.0 });
        sim.advance_to(1.0).unwrap();
        sim.step_towards(1.2).unwrap();
        let end = sim.time();
        let middle = sim.at(1.0 + (end - 1.0) / 2.0).unwrap();
        let before = sim.at(1.0).unwrap();
        assert!(middle.p > before.p && sim.state().p > middle.p);
        sim.set_input(Torque { torque: -50.0 });
        assert_eq!(sim.at(1.0 + (end - 1.0) / 2.0), Ok(middle));
        assert_eq!(sim.at(1.0), Ok(before));
        assert_eq!(sim.at(end), Ok(*sim.state()));
        for outside in [0.999, end + 1e-9, f64::NAN] {
            assert!(matches!(sim.at(outside), Err(IntegrationError::OutsideLastStep { .. })));
        }
        // a step backwards has an inside too
        sim.step_towards(1.1).unwrap();
        assert!(sim.at(f64::midpoint(sim.time(), end)).is_ok());
    }
    check(Euler::new(0.05));
    check(Rk4::new(0.05));
    check(ImplicitMidpoint::new(0.05));
    check(Dopri5::new());
}

#[test]
fn reset_repeats_the_integration() {
    let mut sim = Integrator::new(Driven, Dopri5::new(), 0.0, START);
    sim.advance_to(3.0).unwrap();
    let (state, statistics) = (*sim.state(), sim.statistics());
    sim.reset(0.0, START);
    assert_eq!((sim.time(), *sim.state()), (0.0, START));
    sim.clone().advance_to(1.0).unwrap();
    sim.advance_to(3.0).unwrap();
    assert_eq!((*sim.state(), sim.statistics()), (state, statistics));
}

#[test]
fn large_times_are_resolved() {
    let mut sim = Integrator::new(Scalar1(|t, _, _| (t - 1e9).cos()), Dopri5::new(), 1e9, Line { x: 0.0 });
    sim.advance_to(1e9 + 1.0).unwrap();
    assert!((sim.state().x - 1.0_f64.sin()).abs() < 1e-6);
}

#[test]
fn an_equilibrium_does_not_stop_the_time() {
    let mut sim = Integrator::new(Scalar1(|_, _, _| 0.0), Dopri5::new(), 0.0, Line { x: 1.0 });
    sim.advance_to(1e12).unwrap();
    assert!(sim.statistics().steps < 30);
    while let Ok(()) = sim.step() {}
    let error = sim.step().unwrap_err();
    assert_eq!(error, IntegrationError::NonFiniteTime { time: f64::INFINITY });
}
