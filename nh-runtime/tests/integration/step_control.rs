//! The laws by which steps follow errors.

use nonholonomic::Controller;
use nonholonomic::prelude::*;

use crate::systems::{Driven, Line, Plane, Stiff, VanDerPol, distance};

const START: Plane<f64> = Plane { q: 1.0, p: 0.0 };

fn laws() -> [(&'static str, Controller<f64>); 6] {
    [
        ("PI", Controller::default()),
        ("I", Controller::gustafsson(0.0)),
        ("PI.3.3", Controller::filter([2.0 / 3.0, -1.0 / 3.0, 0.0])),
        ("PI.4.2", Controller::filter([0.6, -0.2, 0.0])),
        ("H211PI", Controller::filter([1.0 / 6.0, 1.0 / 6.0, 0.0])),
        ("H312PID", Controller::filter([1.0 / 18.0, 1.0 / 9.0, 1.0 / 18.0])),
    ]
}

#[test]
fn every_law_keeps_the_tolerance() {
    for (name, law) in laws() {
        for law in [law, law.aim(0.25), law.safety(0.7).factors(0.5, 2.0)] {
            for tolerance in [1e-5, 1e-8, 1e-11] {
                let method = Tsit5::new().rtol(tolerance).controller(law);
                let mut sim = Integrator::new(Driven, method, 0.0, START);
                sim.advance_to(3.0).unwrap();
                let error = distance(sim.state(), &Driven::solution(3.0));
                assert!(error < 20.0 * tolerance, "{name} {law:?} {tolerance}: {error}");
            }
        }
    }
}

/// The logarithms of the ratios of successive steps.
fn ratios(law: Controller<f64>) -> Vec<f64> {
    let method = Dopri5::new().rtol(1e-6).controller(law);
    let mut sim = Integrator::new(VanDerPol { mu: 5.0 }, method, 0.0, Plane { q: 2.0, p: 0.0 });
    let mut lengths = Vec::new();
    while sim.time() < 20.0 {
        let before = sim.time();
        sim.step().unwrap();
        lengths.push(sim.time() - before);
    }
    lengths.windows(2).map(|pair| (pair[1] / pair[0]).ln()).collect()
}

#[test]
fn factors_bound_the_change_of_steps() {
    let within = ratios(Controller::default().factors(0.8, 1.25));
    // a step that is rejected may be shortened more than once
    assert!(within.iter().all(|ratio| *ratio < 1.25_f64.ln() + 1e-6), "{within:?}");
    let free = ratios(Controller::default());
    assert!(free.iter().any(|ratio| *ratio > 1.25_f64.ln()), "{free:?}");
}

#[test]
fn filters_smooth_the_steps() {
    let roughness = |law| {
        let ratios = ratios(law);
        ratios.windows(2).map(|pair| (pair[1] - pair[0]).abs()).sum::<f64>()
    };
    let [_, (_, integral), .., (_, smooth), (_, smoother)] = laws();
    let (integral, smooth, smoother) = (roughness(integral), roughness(smooth), roughness(smoother));
    assert!(smooth < 0.7 * integral && smoother < smooth, "{integral} {smooth} {smoother}");
}

#[test]
fn proportional_control_at_the_limit_of_stability() {
    let rejected = |law| {
        let method = Dopri5::new().rtol(1e-6).controller(law);
        let mut sim = Integrator::new(Stiff { rate: 1e3 }, method, 0.0, Line { x: 1.0 });
        sim.advance_to(5.0).unwrap();
        sim.statistics().rejected
    };
    let [_, (_, integral), (_, proportional), ..] = laws();
    let (integral, proportional) = (rejected(integral), rejected(proportional));
    assert!(2 * proportional < integral, "{integral} {proportional}");
}

#[test]
fn settings_out_of_range_are_named() {
    let method = Radau5::new().controller(Controller::default().safety(2.0));
    let mut sim = Integrator::new(Driven, method, 0.0, START);
    assert_eq!(
        sim.step().unwrap_err().to_string(),
        "the setting `safety` of the method is 2.0, but has to be above 0 and at most 1"
    );
    assert_eq!(*sim.state(), START);
}
