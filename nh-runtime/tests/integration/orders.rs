//! The order of every method and of its dense output, measured.

use nonholonomic::prelude::*;
use nonholonomic::{Method, ScalarOf};

use crate::systems::{Driven, Pendulum, Plane, Torque, distance};

const START: Plane<f64> = Plane { q: 1.0, p: 0.0 };

/// The slope of error against step between h and h/2.
fn slope(error: impl Fn(f64) -> f64, h: f64) -> f64 {
    (error(h) / error(h / 2.0)).log2()
}

/// The error at t = 3 with steps of length h.
fn end_error<M: Method<Driven>>(method: M) -> f64 {
    let mut sim = Integrator::new(Driven, method, 0.0, START);
    sim.advance_to(3.0).unwrap();
    distance(sim.state(), &Driven::solution(3.0))
}

#[test]
fn euler_has_order_1() {
    let order = slope(|h| end_error(Euler::new(h)), 1e-3);
    assert!((order - 1.0).abs() < 0.05, "{order}");
}

#[test]
fn rk4_has_order_4() {
    let order = slope(|h| end_error(Rk4::new(h)), 0.02);
    assert!((order - 4.0).abs() < 0.1, "{order}");
}

#[test]
fn heun_and_ralston_have_orders_2_and_3() {
    let order = slope(|h| end_error(Heun::new(h)), 0.01);
    assert!((order - 2.0).abs() < 0.05, "{order}");
    let order = slope(|h| end_error(Ralston::new(h)), 0.02);
    assert!((order - 3.0).abs() < 0.1, "{order}");
}

#[test]
fn implicit_midpoint_has_order_2() {
    let order = slope(|h| end_error(ImplicitMidpoint::new(h)), 0.01);
    assert!((order - 2.0).abs() < 0.05, "{order}");
}

/// With a tolerance so loose that every step has the longest length.
macro_rules! loose {
    ($method:ident, $h:expr) => {
        $method::new().rtol(1.0).atol(1.0).first_step($h).max_step($h)
    };
}

#[test]
fn adaptive_methods_have_their_orders() {
    let order = slope(|h| end_error(loose!(Bs23, h)), 0.02);
    assert!((order - 3.0).abs() < 0.1, "{order}");
    let order = slope(|h| end_error(loose!(Dopri5, h)), 0.1);
    assert!((order - 5.0).abs() < 0.25, "{order}");
    let order = slope(|h| end_error(loose!(Tsit5, h)), 0.1);
    assert!((order - 5.0).abs() < 0.25, "{order}");
    let order = slope(|h| end_error(loose!(Dop853, h)), 0.3);
    assert!((order - 8.0).abs() < 0.5, "{order}");
    let order = slope(|h| end_error(loose!(Vern9, h)), 0.6);
    assert!((order - 9.0).abs() < 0.6, "{order}");
}

#[test]
fn adaptive_methods_are_methods_of_fixed_step_too() {
    let order = slope(|h| end_error(Dop853::fixed(h)), 0.3);
    assert!((order - 8.0).abs() < 0.5, "{order}");
    let mut fixed = Integrator::new(Driven, Tsit5::fixed(0.1), 0.0, START);
    fixed.step().unwrap();
    assert_eq!(*fixed.state(), Tsit5::step(&Driven, 0.0, 0.1, &START, &()));
    assert_eq!(fixed.statistics().evaluations, 6);
}

/// The largest error of the dense output in one step of length h from t = 0.7.
fn dense_error<M: Method<Driven>>(method: M) -> f64 {
    let mut sim = Integrator::new(Driven, method, 0.7, Driven::solution(0.7));
    sim.step().unwrap();
    let h = sim.time() - 0.7;
    (1..20)
        .map(|i| 0.7 + h * f64::from(i) / 20.0)
        .map(|t| distance(&sim.at(t).unwrap(), &Driven::solution(t)))
        .fold(0.0, f64::max)
}

#[test]
fn dense_output_has_its_order() {
    // local errors: one order more
    let order = slope(|h| dense_error(Rk4::new(h)), 0.1);
    assert!((order - 4.0).abs() < 0.3, "{order}");
    let order = slope(|h| dense_error(loose!(Bs23, h)), 0.1);
    assert!((order - 4.0).abs() < 0.3, "{order}");
    let order = slope(|h| dense_error(loose!(Dopri5, h)), 0.1);
    assert!((order - 5.0).abs() < 0.3, "{order}");
    let order = slope(|h| dense_error(loose!(Tsit5, h)), 0.1);
    assert!((order - 5.0).abs() < 0.3, "{order}");
    let order = slope(|h| dense_error(loose!(Dop853, h)), 0.4);
    assert!((order - 8.0).abs() < 0.4, "{order}");
    let order = slope(|h| dense_error(Dop853::fixed(h)), 0.4);
    assert!((order - 8.0).abs() < 0.4, "{order}");
    let order = slope(|h| dense_error(loose!(Vern9, h)), 0.8);
    assert!((order - 10.0).abs() < 0.5, "{order}");
}

#[test]
fn the_error_follows_the_tolerance() {
    for exponent in 3..=12 {
        let tolerance = 10.0_f64.powi(-exponent);
        for error in [
            end_error(Bs23::new().rtol(tolerance.max(1e-9))) * tolerance / tolerance.max(1e-9),
            end_error(Dopri5::new().rtol(tolerance)),
            end_error(Tsit5::new().rtol(tolerance)),
            end_error(Dop853::new().rtol(tolerance)),
            end_error(Vern9::new().rtol(tolerance)),
        ] {
            assert!(error < 20.0 * tolerance + 1e-14, "{tolerance}: {error}");
        }
    }
}

#[test]
fn the_pure_functions_agree_with_the_integrator() {
    let pendulum = Pendulum { g: 9.81 };
    let input = Torque { torque: 0.3 };
    let mut state = START;
    let mut sim = Integrator::new(&pendulum, Rk4::new(0.01), 0.0, START);
    let mut mid = Integrator::new(&pendulum, ImplicitMidpoint::new(0.01), 0.0, START);
    sim.set_input(input);
    mid.set_input(input);
    let mut mid_state = START;
    for i in 0..100 {
        let t = f64::from(i) * 0.01;
        state = Rk4::step(&pendulum, t, 0.01, &state, &input);
        mid_state = ImplicitMidpoint::step(&pendulum, t, 0.01, &mid_state, &input).unwrap();
        sim.step().unwrap();
        mid.step().unwrap();
    }
    assert_eq!(*sim.state(), state);
    assert!(distance(mid.state(), &mid_state) < 1e-13);
    let euler = Euler::step(&pendulum, 0.0, 0.5, &START, &input);
    assert!((euler.p - 0.5 * (0.3 - 9.81 * 1.0_f64.sin())).abs() < 1e-15);
}

#[test]
fn types_are_inferred() {
    fn energy<S: Dynamics<State = Plane<f32>>>(sim: &Integrator<S, impl Method<S>>) -> f32 {
        let x = sim.state();
        x.p * x.p / 2.0 - 9.81 * x.q.cos()
    }
    fn run<T: Real>(g: T) -> ScalarOf<Pendulum<T>> {
        let start = Plane { q: T::ONE, p: T::ZERO };
        let mut sim = Integrator::new(Pendulum { g }, Dopri5::new(), T::ZERO, start);
        sim.advance_to(T::ONE).unwrap();
        sim.state().q
    }
    let start = Plane { q: 1.0, p: 0.0 };
    let pendulum = Pendulum { g: 9.81_f32 };
    let mut adaptive = Integrator::new(pendulum, Dopri5::new().rtol(1e-6), 0.0, start);
    let mut fixed = Integrator::new(&pendulum, Rk4::new(1e-2), 0.0, start);
    let mut implicit = Integrator::new(&pendulum, ImplicitMidpoint::new(1e-3), 0.0, start);
    let before = energy(&adaptive);
    adaptive.advance_to(10.0).unwrap();
    fixed.advance_to(10.0).unwrap();
    implicit.advance_to(10.0).unwrap();
    for error in [energy(&adaptive) - before, energy(&fixed) - before, energy(&implicit) - before] {
        assert!(error.abs() < 3e-4, "{error}");
    }
    assert!((f64::from(run(9.81_f32)) - run(9.81_f64)).abs() < 1e-3);
}
