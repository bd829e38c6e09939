//! Implicit methods: orders, stiffness, and what they cost.

use nonholonomic::Method;
use nonholonomic::prelude::*;

use crate::systems::{
    Driven, FreeBody, Line, Pendulum, Plane, Scalar1, Spin, Stiff, Torque, VanDerPol, distance,
};

const START: Plane<f64> = Plane { q: 1.0, p: 0.0 };

fn end_error<M: Method<Driven>>(method: M) -> f64 {
    let mut sim = Integrator::new(Driven, method, 0.0, START);
    sim.advance_to(3.0).unwrap();
    distance(sim.state(), &Driven::solution(3.0))
}

fn dense_error<M: Method<Driven>>(method: M) -> f64 {
    let mut sim = Integrator::new(Driven, method, 0.7, Driven::solution(0.7));
    sim.step().unwrap();
    let h = sim.time() - 0.7;
    (1..20)
        .map(|i| 0.7 + h * f64::from(i) / 20.0)
        .map(|t| distance(&sim.at(t).unwrap(), &Driven::solution(t)))
        .fold(0.0, f64::max)
}

fn slope(error: impl Fn(f64) -> f64, h: f64) -> f64 {
    (error(h) / error(h / 2.0)).log2()
}

/// With a tolerance so loose that every step has the longest length.
macro_rules! loose {
    ($method:ident, $h:expr) => {
        $method::new().rtol(1.0).atol(1e-3).first_step($h).max_step($h)
    };
}

#[test]
fn orders_are_those_of_the_literature() {
    let order = slope(|h| end_error(GaussLegendre4::new(h)), 0.2);
    assert!((order - 4.0).abs() < 0.1, "{order}");
    let order = slope(|h| end_error(GaussLegendre6::new(h)), 0.3);
    assert!((order - 6.0).abs() < 0.2, "{order}");
    let order = slope(|h| end_error(loose!(Radau5, h)), 0.1);
    assert!((order - 5.0).abs() < 0.3, "{order}");
    let order = slope(|h| end_error(loose!(Rodas5P, h)), 0.1);
    assert!((order - 5.0).abs() < 0.3, "{order}");
}

#[test]
fn dense_output_has_its_order() {
    for (order, expected) in [
        (slope(|h| dense_error(GaussLegendre4::new(h)), 0.1), 4.0),
        (slope(|h| dense_error(GaussLegendre6::new(h)), 0.1), 4.0),
        (slope(|h| dense_error(loose!(Radau5, h)), 0.05), 4.0),
        (slope(|h| dense_error(loose!(Rodas5P, h)), 0.05), 5.0),
    ] {
        assert!((order - expected).abs() < 0.4, "{order} {expected}");
    }
}

#[test]
fn gauss_methods_keep_quadratic_invariants_and_are_reversible() {
    let body = FreeBody { i: [1.0, 2.0, 3.0] };
    let start = Spin { w1: 0.4, w2: 1.1, w3: -0.3 };
    let mut fourth = Integrator::new(body, GaussLegendre4::new(0.3), 0.0, start);
    let mut sixth = Integrator::new(body, GaussLegendre6::new(0.3).compensated(), 0.0, start);
    for _ in 0..10_000 {
        fourth.step().unwrap();
        sixth.step().unwrap();
    }
    let before = body.invariants(&start);
    for (i, before) in before.iter().enumerate() {
        assert!((body.invariants(fourth.state())[i] - before).abs() < 1e-12);
        assert!((body.invariants(sixth.state())[i] - before).abs() < 1e-12);
    }
    let statistics = sixth.statistics();
    assert!(statistics.iterations < 14 * statistics.steps, "{statistics:?}");

    let start = Plane { q: 1.0, p: 0.5 };
    let mut sim = Integrator::new(Pendulum { g: 2.0 }, GaussLegendre6::new(0.1), 0.0, start);
    sim.advance_to(20.0).unwrap();
    sim.advance_to(0.0).unwrap();
    assert!(distance(sim.state(), &start) < 1e-12);
    let pure = GaussLegendre6::step(&Pendulum { g: 2.0 }, 0.0, 0.1, &start, &Torque::default()).unwrap();
    sim.reset(0.0, start);
    sim.step().unwrap();
    assert!(distance(sim.state(), &pure) < 1e-15);
}

#[test]
fn smooth_steps_take_two_iterations() {
    fn iterations<M: Method<Pendulum<f64>>>(method: M) -> u64 {
        let mut sim = Integrator::new(Pendulum { g: 2.0 }, method, 0.0, Plane { q: 1.0, p: 0.5 });
        for _ in 0..500 {
            sim.step().unwrap();
        }
        sim.statistics().iterations
    }
    let counts = [
        iterations(GaussLegendre6::new(0.01)),
        iterations(GaussLegendre4::new(0.01)),
        iterations(ImplicitMidpoint::new(0.01)),
    ];
    assert!(counts.iter().all(|count| *count < 5 * 500 / 2), "{counts:?}");
}

#[test]
fn stiffness_does_not_shorten_the_steps() {
    for rate in [1e3, 1e6, 1e9, 1e12] {
        fn run<M: Method<Stiff>>(rate: f64, method: M) -> (f64, Statistics) {
            let mut sim = Integrator::new(Stiff { rate }, method, 0.0, Line { x: 2.0 });
            sim.advance_to(10.0).unwrap();
            ((sim.state().x - 10.0_f64.cos()).abs(), sim.statistics())
        }
        for (error, statistics) in [run(rate, Radau5::new().rtol(1e-8)), run(rate, Rodas5P::new().rtol(1e-8))]
        {
            assert!(error < 1e-7, "{rate}: {error}");
            assert!(statistics.steps < 600, "{rate}: {statistics:?}");
        }
        for (error, statistics) in
            [run(rate, GaussLegendre4::new(0.05)), run(rate, GaussLegendre6::new(0.05))]
        {
            // not damped at infinity, but bounded
            assert!(error < 1.1, "{rate}: {error}");
            assert_eq!(statistics.steps, 200);
        }
    }
}

#[test]
fn van_der_pol_is_solved_with_either_jacobian() {
    // q(2μ) at μ = 1000 from (2, 0): the reference of Radau5 and Rodas5P at tolerances from 1e-10 on
    let start = Plane { q: 2.0, p: 0.0 };
    let run = |state: &Plane<f64>| state.q;
    let vdp = VanDerPol { mu: 1000.0 };
    let mut reference = Integrator::new(vdp, Radau5::new().rtol(1e-12).with_jacobian(), 0.0, start);
    reference.advance_to(2000.0).unwrap();
    let mut other = Integrator::new(vdp, Rodas5P::new().rtol(1e-12).with_jacobian(), 0.0, start);
    other.advance_to(2000.0).unwrap();
    assert!(
        (run(reference.state()) - run(other.state())).abs() < 1e-9,
        "{:?} {:?}",
        reference.state(),
        other.state()
    );
    // q = 1.706167732170469 there (Hairer, Wanner II, problem VDPOL in this scaling)
    assert!((run(reference.state()) - 1.706_167_732_170_469).abs() < 1e-8, "{:?}", reference.state());
    let mut numerical = Integrator::new(vdp, Radau5::new().rtol(1e-7), 0.0, start);
    numerical.advance_to(2000.0).unwrap();
    assert!((run(numerical.state()) - run(reference.state())).abs() < 1e-5);
    let statistics = numerical.statistics();
    assert!(statistics.steps < 1500 && statistics.jacobians < statistics.steps, "{statistics:?}");
}

#[test]
fn tolerances_are_followed() {
    for exponent in 3..=11 {
        let tolerance = 10.0_f64.powi(-exponent);
        for error in [end_error(Radau5::new().rtol(tolerance)), end_error(Rodas5P::new().rtol(tolerance))] {
            assert!(error < 30.0 * tolerance, "{tolerance}: {error}");
        }
    }
}

/// A weight that swings about the lowest point, which is a length away from where angles are counted, and counts calls.
struct Swinging<'a> {
    calls: &'a core::cell::Cell<u64>,
}

impl Dynamics for Swinging<'_> {
    type State = Plane<f64>;
    type Input = ();
    fn derivative(&self, _t: f64, x: &Plane<f64>, (): &()) -> Plane<f64> {
        self.calls.set(self.calls.get() + 1);
        Plane { q: x.p, p: -((x.q + 1.0) - 1.0) }
    }
}

/// Where corrections no longer fall an iteration looks around whether they are rounding, which is part of what it costs.
#[test]
fn what_the_end_of_an_iteration_looks_at_is_counted() {
    fn counts(method: impl for<'a> Method<Swinging<'a>>, start: Plane<f64>) {
        let calls = core::cell::Cell::new(0);
        let mut sim = Integrator::new(Swinging { calls: &calls }, method, 0.0, start);
        for _ in 0..50 {
            if sim.step().is_err() {
                break;
            }
            assert_eq!(sim.statistics().evaluations, calls.get(), "{start:?} {:?}", sim.statistics());
        }
    }
    for q in [1e-9, 1e-14, 1e-15, 1e-16] {
        for p in [0.0, 1e-16, 1e-12] {
            for h in [0.3, 0.1, 0.01] {
                counts(ImplicitMidpoint::new(h), Plane { q, p });
                counts(GaussLegendre4::new(h), Plane { q, p });
                counts(GaussLegendre6::new(h), Plane { q, p });
            }
        }
    }
}

/// A force that jumps where a run begins: what it is behind that place is nothing to the run, in either direction of time.
#[test]
fn an_equation_ends_where_a_run_begins() {
    fn check<M: Method<Scalar1> + Copy>(name: &str, method: M) {
        let forwards = Scalar1(|t, x, _| if t < 1.0 { 100.0 } else { -x });
        let backwards = Scalar1(|t, x, _| if t > 1.0 { 100.0 } else { x });
        for (system, target) in [(forwards, 2.0), (backwards, 0.0)] {
            let mut sim = Integrator::new(system, method, 1.0, Line { x: 1.0 });
            sim.advance_to(target).unwrap_or_else(|error| panic!("{name} to {target}: {error}"));
            assert!((sim.state().x - (-1.0_f64).exp()).abs() < 1e-5, "{name} to {target}: {:?}", sim.state());
            assert!(sim.statistics().rejected < 3, "{name} to {target}: {:?}", sim.statistics());
        }
    }
    check("Rodas5P", Rodas5P::new());
    check("Radau5", Radau5::new());
    check("Auto", Auto::new());
    check("Dopri5", Dopri5::new());
}
