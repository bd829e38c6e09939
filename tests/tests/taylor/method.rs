//! The method: landing, dense output, scales, and what it refuses.

use nh_tests::comparison::largest;
use nonholonomic::prelude::*;

use super::systems::{Everything, EverythingState, Sleigh, SleighInput, SleighState};

/// An oscillator with a frequency, a constant pull, and a falling ball, whose series ends.
#[nonholonomic(
    base { x, fall }
    lagrangian { (der(x)^2 - (w * x)^2) / 2 + der(fall)^2 / 2 - g * fall }
    emit { taylor }
)]
#[derive(Clone, Copy, Debug)]
struct Scales<T> {
    w: T,
    g: T,
}

fn sleigh() -> (Sleigh<f64>, SleighState<f64>) {
    let start = SleighState { theta: 0.4, x: 1.0, y: -2.0, omega: 0.9, v1: -0.5 };
    (Sleigh { m: 1.3, J: 0.4, a: 0.7, c: 0.2 }, start)
}

fn distance(a: &SleighState<f64>, b: &SleighState<f64>) -> f64 {
    let (a, b): ([f64; 5], [f64; 5]) = ((*a).into(), (*b).into());
    largest(a.iter().zip(b).map(|(a, b)| a - b))
}

#[test]
fn forth_and_back() {
    let (system, start) = sleigh();
    let mut sim = Integrator::new(system, Taylor::new().rtol(1e-15), 0.0, start);
    sim.set_input(SleighInput { torque: 0.3 });
    sim.advance_to(7.3).unwrap();
    assert!((sim.time() - 7.3).abs() <= 0.0);
    sim.advance_to(0.0).unwrap();
    assert!(distance(sim.state(), &start) < 1e-11, "{:?}", sim.state());
}

#[test]
fn between_the_ends_of_a_step() {
    let (system, start) = sleigh();
    let mut sim = Integrator::new(&system, Taylor::new().rtol(1e-15), 0.0, start);
    let push = SleighInput { torque: 0.3 };
    sim.set_input(push);
    for _ in 0..5 {
        let before = sim.time();
        sim.step().unwrap();
        for s in [0.0, 0.1, 0.5, 0.9, 1.0] {
            let t = before + s * (sim.time() - before);
            let mut other = Integrator::new(&system, Taylor::new().rtol(1e-15), 0.0, start);
            other.set_input(push);
            other.advance_to(t).unwrap();
            let error = distance(&sim.at(t).unwrap(), other.state());
            assert!(error < 1e-13, "{error:e} at {t}");
        }
    }
    // another input acts from now on, but not on the step that has been made
    let (t, inside) = (sim.time() - 0.01, sim.at(sim.time() - 0.01).unwrap());
    sim.set_input(SleighInput { torque: -5.0 });
    assert_eq!(sim.at(t).unwrap(), inside);
}

#[test]
fn the_order_follows_the_tolerance() {
    for (rtol, order) in [(1e-3, 5), (1e-6, 8), (1e-9, 12), (1e-12, 15), (1e-15, 19), (0.0, 20)] {
        assert_eq!(Taylor::<f64>::new().rtol(rtol).order(), order, "{rtol:e}");
    }
    assert_eq!(Taylor::<f32>::new().rtol(1e-6).order(), 8);
    assert_eq!(Taylor::<f64, 9>::of_order(5).rtol(1e-15).order(), 5);
}

#[test]
fn errors_fall_with_the_tolerance() {
    let (system, start) = sleigh();
    let end = |method: Taylor<f64>| {
        let mut sim = Integrator::new(system, method, 0.0, start);
        sim.advance_to(10.0).unwrap();
        *sim.state()
    };
    let exact = end(Taylor::new().rtol(1e-15));
    for exponent in 3..=13 {
        let rtol = 10.0_f64.powi(-exponent);
        let error = distance(&end(Taylor::new().rtol(rtol)), &exact);
        // some twenty steps, each off by the tolerance at most
        assert!(error < 30.0 * rtol, "{error:e} with {rtol:e}");
    }
}

#[test]
fn time_scales_from_tiny_to_huge() {
    for exponent in [-150, -30, -10, 0, 6, 30, 150] {
        let w = 10.0_f64.powi(exponent);
        let system = Scales { w, g: 0.0 };
        let start = ScalesState { x: 1.0, x_dot: 0.0, ..ScalesState::default() };
        // a component as large as the frequency has to be measured relative to itself
        let method = Taylor::new().rtol(1e-14).atol(1e-14 * w.min(1.0));
        let mut sim = Integrator::new(system, method, 0.0, start);
        let end = 3.0 / w;
        sim.advance_to(end).unwrap();
        let error = (sim.state().x - 3.0_f64.cos()).abs();
        assert!(error < 1e-12, "{error:e} at {w:e}");
        assert!(sim.statistics().evaluations < 60, "{:?} at {w:e}", sim.statistics());
    }
}

#[test]
fn a_series_that_ends_does_not_limit_the_step() {
    let system = Scales { w: 0.0, g: 9.81 };
    let start = ScalesState { x_dot: 1.0, fall_dot: 3.0, ..ScalesState::default() };
    let mut sim = Integrator::new(system, Taylor::new().rtol(1e-12), 0.0, start);
    sim.advance_to(1e6).unwrap();
    assert!((sim.state().x / 1e6 - 1.0).abs() < 1e-12);
    let fallen = 3.0 * 1e6 - 9.81 / 2.0 * 1e12;
    assert!((sim.state().fall / fallen - 1.0).abs() < 1e-12);
    assert!(sim.statistics().steps < 12, "{:?}", sim.statistics());
    // and nothing at all happens at rest
    let mut rest = Integrator::new(Scales { w: 1.0, g: 0.0 }, Taylor::new(), 0.0, ScalesState::default());
    rest.advance_to(50.0).unwrap();
    assert_eq!(*rest.state(), ScalesState::default());
}

#[test]
fn single_precision() {
    let system = Scales { w: 1e6_f32, g: 0.0 };
    let start = ScalesState { x: 1.0, ..ScalesState::default() };
    let mut sim = Integrator::new(system, Taylor::new().rtol(1e-6).atol(1e-6), 0.0, start);
    sim.advance_to(1e-5).unwrap();
    assert!((sim.state().x - 10.0_f32.cos()).abs() < 1e-4, "{:?}", sim.state());
}

#[test]
fn every_function_and_the_time() {
    let start = EverythingState { x: 0.5, y: -0.4, z: 0.7, x_dot: 0.2, y_dot: -0.3, z_dot: 0.6 };
    let system = Everything { c: 0.8 };
    let mut series = Integrator::new(system, Taylor::new().rtol(1e-14), -1.0, start);
    let mut stages = Integrator::new(system, Dopri5::new().rtol(1e-12), -1.0, start);
    series.advance_to(0.2).unwrap();
    stages.advance_to(0.2).unwrap();
    let (a, b): ([f64; 6], [f64; 6]) = ((*series.state()).into(), (*stages.state()).into());
    for (a, b) in a.iter().zip(b) {
        assert!((a - b).abs() < 1e-9, "{a} {b}");
    }
}

#[test]
fn settings_and_states_are_refused_in_words() {
    let (system, start) = sleigh();
    let refusal = |method: Taylor<f64, 9>| {
        let mut sim = Integrator::new(system, method, 0.0, start);
        sim.step().unwrap_err().to_string()
    };
    assert!(refusal(Taylor::of_order(1)).contains("`order`"));
    assert!(refusal(Taylor::of_order(9)).contains("less than the number of coefficients"));
    assert!(refusal(Taylor::of_order(4).rtol(-1.0)).contains("`rtol`"));
    assert!(refusal(Taylor::of_order(4).max_step(0.0)).contains("`max_step`"));
    // y < −3 has no logarithm
    let start = EverythingState { y: -3.5, ..EverythingState::default() };
    let mut sim = Integrator::new(Everything { c: 0.8 }, Taylor::new(), 0.0, start);
    assert!(matches!(sim.step(), Err(IntegrationError::NonFiniteDerivative { component: "y_dot", .. })));
    assert_eq!((*sim.state(), sim.time()), (start, 0.0));
}

#[test]
fn a_longest_step_is_kept() {
    let (system, start) = sleigh();
    let mut sim = Integrator::new(system, Taylor::new().max_step(0.01), 0.0, start);
    sim.advance_to(1.0).unwrap();
    assert!((99..=101).contains(&sim.statistics().steps));
}

#[test]
fn nothing_is_allocated() {
    let (system, start) = sleigh();
    let counted = allocation_counter::measure(|| {
        let mut sim = Integrator::new(system, Taylor::new().rtol(1e-13), 0.0, start);
        sim.advance_to(5.0).unwrap();
        std::hint::black_box((
            sim.at(4.99).unwrap(),
            system.taylor::<30>(0.0, &start, &SleighInput::default()),
        ));
    });
    assert_eq!(counted.count_total, 0);
}
