//! What the structure-preserving methods keep: the measurements of the example `structure`, asserted.
#![allow(non_snake_case, reason = "parameters are written as in mechanics")]
#![allow(dead_code, reason = "the example uses the rest")]

#[path = "../../examples/examples/structure/keeps.rs"]
mod keeps;
#[path = "../../examples/examples/structure/systems.rs"]
mod systems;

use keeps::{CONTACT, Kept, Row, Special, on_tq, row, run};
use nh_tests::comparison::largest;
use nonholonomic::prelude::*;
use systems::{ChaoticQuartic, ChaoticQuarticState, Suslov, SuslovState};

/// Steps for the measurements: few, since tests are not optimised.
const STEPS: u32 = 1000;

fn is_exact(kept: Kept) -> bool {
    matches!(kept, Kept::Exactly(_))
}

#[test]
fn discrete_gradients() {
    let Row { order, energy, identity, constraint, momentum, reversal, volume, .. } =
        row("DiscreteGradient", STEPS, DiscreteGradient::new);
    assert!((order - 2.0).abs() < 0.1, "{order}");
    assert!(is_exact(energy) && is_exact(identity) && is_exact(constraint));
    assert!(matches!(momentum, Kept::Nearly(_)), "{momentum}");
    assert!(reversal < 1e-11, "{reversal}");
    assert!(volume > 1e-4, "{volume}");
}

#[test]
fn compositions_of_discrete_gradients() {
    let fourth = row("", STEPS / 4, |h| DiscreteGradient::new(h).fourth_order());
    let sixth = row("", STEPS / 4, |h| DiscreteGradient::new(h).sixth_order());
    for (row, order) in [(fourth, 4.0), (sixth, 6.0)] {
        assert!((row.order - order).abs() < 0.1, "{}", row.order);
        assert!(is_exact(row.energy) && is_exact(row.identity) && is_exact(row.constraint));
        assert!(row.reversal < 1e-11, "{}", row.reversal);
    }
}

#[test]
fn implicit_midpoint_and_its_composition() {
    let plain = row("", STEPS, ImplicitMidpoint::new);
    let fourth = row("", STEPS / 4, |h| ImplicitMidpoint::new(h).fourth_order());
    for (row, order) in [(plain, 2.0), (fourth, 4.0)] {
        assert!((row.order - order).abs() < 0.1, "{}", row.order);
        assert!(matches!(row.energy, Kept::Nearly(_)), "{}", row.energy);
        assert!(is_exact(row.identity) && is_exact(row.constraint) && is_exact(row.momentum));
        assert!(row.reversal < 1e-11, "{}", row.reversal);
    }
}

#[test]
fn explicit_methods_keep_nothing() {
    let Row { energy, identity, reversal, .. } = row("Rk4", STEPS, Rk4::new);
    assert!(matches!((energy, identity), (Kept::Not(_), Kept::Not(_))), "{energy} {identity}");
    assert!(reversal > 1e-6, "{reversal}");
}

/// Checks mathematics (26).
#[test]
fn the_leapfrog_method() {
    let Special { order, energy, constraint, reversal, .. } = on_tq("", STEPS, ReflectedLeapfrog::new);
    assert!((order - 2.0).abs() < 0.05, "{order}");
    assert!(matches!((energy, constraint), (Kept::Nearly(_), Some(Kept::Nearly(_)))), "{energy}");
    assert!(reversal < 1e-12, "{reversal}");
}

#[test]
fn returns_to_constraints_and_integrals() {
    let projected = on_tq("", STEPS, |h| Projected::new(Rk4::new(h), 1));
    assert!(projected.constraint.is_some_and(is_exact) && !is_exact(projected.energy));
    let conserving = on_tq("", STEPS, |h| Conserving::new(Rk4::new(h)));
    assert!(is_exact(conserving.energy) && !conserving.constraint.is_some_and(is_exact));
    for Special { order, reversal, .. } in [projected, conserving] {
        assert!((order - 4.0).abs() < 0.2 && reversal > 1e-6, "{order} {reversal}");
    }
}

/// Checks mathematics (27).
#[test]
fn discrete_euler_poincare_suslov_equations() {
    let system = Suslov { I: [1.0, 2.0, 3.0], k: 0.7 };
    let start = SuslovState { w_0: 0.6, w_1: 0.8 };
    let end = |h: f64| {
        let mut sim = Integrator::new(system, DiscreteSuslov::new(h), 0.0, start);
        sim.advance_to(2.0).expect("a smooth motion");
        *sim.state()
    };
    let mut exact = Integrator::new(system, Vern9::new().rtol(1e-13).atol(1e-14), 0.0, start);
    exact.advance_to(2.0).expect("a smooth motion");
    let error = |h: f64| (end(h).w_0 - exact.state().w_0).hypot(end(h).w_1 - exact.state().w_1);
    let order = (error(0.1) / error(0.05)).log2();
    assert!((order - 2.0).abs() < 0.1, "{order}");
    // it is its own inverse with the step reversed
    let mut sim = Integrator::new(system, DiscreteSuslov::new(0.1), 0.0, start);
    sim.advance_to(3.0).and_then(|()| sim.advance_to(0.0)).expect("a smooth motion");
    assert!((sim.state().w_0 - start.w_0).abs() < 1e-12);
}

/// Energies of long motions: much longer ones are the business of the example.
#[test]
fn the_energy_does_not_drift() {
    let errors = run(CONTACT, keeps::contact(), DiscreteGradient::new(0.1), 5000, |s| CONTACT.energy(0.0, s));
    assert!(errors.iter().all(|error| error.abs() < 4e-15));
    let start =
        ChaoticQuarticState { x: 0.1, y: [0.4, -0.3, 0.5], z: [0.2, 0.6, -0.1], ..Default::default() };
    let energy = |s: &ChaoticQuarticState| ChaoticQuartic.energy(0.0, s);
    let errors = run(ChaoticQuartic, start, DiscreteGradient::new(0.05), 500, energy);
    assert!(errors.iter().all(|error| error.abs() < 4e-15));
}

/// One step as a pure function, and steps that cannot be solved.
#[test]
fn steps() {
    let start = keeps::contact();
    let mut sim = Integrator::new(CONTACT, DiscreteGradient::new(0.1), 0.0, start);
    sim.step().expect("a step");
    let next = DiscreteGradient::step(&CONTACT, 0.0, 0.1, &start, &()).expect("a step");
    assert_eq!(next, *sim.state());
    // the equation of a step that is much too long has a solution as well: it is found or refused, and keeps
    // the energy if it is found
    let energy = CONTACT.energy(0.0, &start);
    let mut refused = 0;
    for length in [1e6, 1e9, 1e12, 1e18, 1e100] {
        match DiscreteGradient::step(&CONTACT, 0.0, length, &start, &()) {
            Ok(state) => {
                assert!((CONTACT.energy(length, &state) - energy).abs() < 1e-12 * energy, "{length}");
            }
            Err(IntegrationError::NoConvergence { .. } | IntegrationError::NonFiniteStep { .. }) => {
                refused += 1;
            }
            Err(error) => panic!("{length}: {error:?}"),
        }
    }
    assert!(refused > 0, "no step was too long");
    let none = Integrator::new(CONTACT, DiscreteGradient::new(0.0), 0.0, start).step();
    assert!(matches!(none, Err(IntegrationError::Setting { setting: "step", .. })), "{none:?}");
}

/// A ball on a turning table: its energy changes, the stated integrals do not.
#[nonholonomic(
    base  { x, y }
    basis { dx, dy, wx, wy, wz }
    anchor { der(x) = dx; der(y) = dy; }
    brackets { [wx, wy] = -wz; [wy, wz] = -wx; [wz, wx] = -wy; }
    lagrangian { (dx^2 + dy^2 + k2 * (wx^2 + wy^2 + wz^2)) / 2 }
    constraints { dx = r * wy - Omega * y; dy = -r * wx + Omega * x; }
    conserved {
        contact_x = r * dx + k2 * wy;
        contact_y = r * dy - k2 * wx;
        moving = (dx^2 + dy^2 + k2 * (wx^2 + wy^2 + wz^2)) / 2 - Omega * (x * dy - y * dx + k2 * wz);
    }
    emit { invariants }
)]
#[derive(Clone, Copy, Debug)]
struct Table {
    r: f64,
    k2: f64,
    Omega: f64,
}

#[test]
fn stated_invariants() {
    use nonholonomic::Invariants;
    let table = Table { r: 0.5, k2: 0.1, Omega: 1.3 };
    let start = TableState { x: 0.4, y: -0.2, wx: 0.3, wy: 0.7, wz: -0.4 };
    let before = table.invariants(0.0, &start);
    let drift = |state: &TableState| {
        let after = table.invariants(0.0, state);
        largest(before.iter().zip(after).map(|(a, b)| a - b))
    };
    let mut plain = Integrator::new(table, Rk4::new(0.1), 0.0, start);
    let mut kept = Integrator::new(table, Conserving::new(Rk4::new(0.1)), 0.0, start);
    for _ in 0..500 {
        plain.step().and_then(|()| kept.step()).expect("a step");
        assert!(drift(kept.state()) < 1e-14, "{}", drift(kept.state()));
    }
    assert!(drift(plain.state()) > 1e-9, "{}", drift(plain.state()));
    // the order stays
    let mut exact = Integrator::new(table, Vern9::new().rtol(1e-13).atol(1e-14), 0.0, start);
    exact.advance_to(2.0).expect("a smooth motion");
    let error = |h: f64| {
        let mut sim = Integrator::new(table, Conserving::new(Rk4::new(h)), 0.0, start);
        sim.advance_to(2.0).expect("a smooth motion");
        (sim.state().x - exact.state().x).hypot(sim.state().wx - exact.state().wx)
    };
    let order = (error(0.1) / error(0.05)).log2();
    assert!(order > 3.8, "{order}");
}
