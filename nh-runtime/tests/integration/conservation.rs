//! What the implicit midpoint rule is there for.

use nonholonomic::prelude::*;

use crate::systems::{FreeBody, Line, Pendulum, Plane, Spin, Stiff};

#[test]
fn implicit_midpoint_keeps_quadratic_invariants() {
    let body = FreeBody { i: [1.0, 2.0, 3.0] };
    let start = Spin { w1: 0.4, w2: 1.1, w3: -0.3 };
    for h in [0.01, 0.1, 0.7] {
        let mut sim = Integrator::new(body, ImplicitMidpoint::new(h), 0.0, start);
        for _ in 0..10_000 {
            sim.step().unwrap();
        }
        let before = body.invariants(&start);
        let after = body.invariants(sim.state());
        for (a, b) in before.iter().zip(after) {
            assert!((a - b).abs() < 2e-13, "{h}: {}", a - b);
        }
        let statistics = sim.statistics();
        assert!(statistics.iterations < 12 * statistics.steps, "{statistics:?}");
    }
}

#[test]
fn implicit_midpoint_is_reversible() {
    let start = Plane { q: 1.0, p: 0.5 };
    let mut sim = Integrator::new(Pendulum { g: 2.0 }, ImplicitMidpoint::new(0.1), 0.0, start);
    sim.advance_to(20.0).unwrap();
    sim.advance_to(0.0).unwrap();
    assert!((sim.state().q - 1.0).abs() < 1e-12 && (sim.state().p - 0.5).abs() < 1e-12);
}

#[test]
fn implicit_midpoint_takes_long_steps_on_stiff_systems() {
    let mut sim = Integrator::new(Stiff { rate: 1e6 }, ImplicitMidpoint::new(0.01), 0.0, Line { x: 1.0 });
    sim.advance_to(10.0).unwrap();
    assert!((sim.state().x - 10.0_f64.cos()).abs() < 1e-4, "{:?}", sim.state());
    let statistics = sim.statistics();
    assert_eq!(statistics.steps, 1000);
    assert!(statistics.iterations < 4 * 1000, "{statistics:?}");
    assert!(statistics.jacobians < 10, "{statistics:?}");
}
