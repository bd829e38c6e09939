//! Solutions of the Hamilton–Jacobi equation on D* for systems that are in no list: motions that start on
//! the section stay on it. Claims that are almost true are in `ui/phase_space`.
#![allow(non_snake_case, reason = "parameters are written as in mechanics")]

use nonholonomic::prelude::*;

/// A knife edge on an incline. A friction that acts only off the section does not matter.
#[nonholonomic(
    base { th, x, y }
    basis { w, v, u }
    anchor { der(th) = w; der(x) = v * cos(th) - u * sin(th); der(y) = v * sin(th) + u * cos(th); }
    lagrangian { J / 2 * w^2 + m / 2 * (u^2 + v^2) - m * g * x }
    constraints { u = 0; }
    forces { w: -c * (w - W); }
    hamilton_jacobi { w: J * W; v: sqrt(2 * m * (E - m * g * x)); }
    emit { hamiltonian }
)]
#[derive(Clone, Copy, Debug)]
struct Edge {
    m: f64,
    J: f64,
    g: f64,
    E: f64,
    W: f64,
    c: f64,
}

/// Suslov's body, where the axis that may not turn is no principal axis: only turning about one axis is steady.
#[nonholonomic(
    basis { w[3] }
    brackets so(3) { w }
    lagrangian { (A * w[0]^2 + B * w[1]^2 + C * w[2]^2) / 2 + D * w[0] * w[2] }
    constraints { w[2] = 0; }
    hamilton_jacobi { w[1]: p; }
    emit { hamiltonian }
)]
#[derive(Clone, Copy, Debug)]
struct Suslov {
    A: f64,
    B: f64,
    C: f64,
    D: f64,
    p: f64,
}

/// A charge in the plane and a magnetic field that a potential balances; momenta are not velocities.
#[nonholonomic(
    base { x, y }
    lagrangian { (der(x)^2 + der(y)^2) / 2 + b * x * der(y) - b^2 * x^2 / 2 }
    hamilton_jacobi { y_dot: b * sqrt(2) * k; x_dot: sqrt(2 * e - (b * sqrt(2) * k - b * x)^2 - b^2 * x^2); }
    emit { hamiltonian }
)]
#[derive(Clone, Copy, Debug)]
struct Charge {
    b: f64,
    k: f64,
    e: f64,
}

/// A constraint that moves: R_L acts along the section only.
#[nonholonomic(
    base { x, y }
    lagrangian { (der(x)^2 + der(y)^2) / 2 }
    constraints { der(y) = W; }
    hamilton_jacobi { x_dot: p; }
    emit { hamiltonian }
)]
#[derive(Clone, Copy, Debug)]
struct Belt {
    W: f64,
    p: f64,
}

/// Checks mathematics (20).
#[test]
fn motions_stay_on_their_sections() -> Result<(), IntegrationError> {
    let edge = Edge { m: 0.8, J: 0.3, g: 2.0, E: 5.0, W: 1.1, c: 0.4 };
    let start = edge.hamilton_jacobi(0.0, &EdgeState { th: 0.3, x: 0.2, y: -0.1, ..EdgeState::default() });
    let mut sim = Integrator::new(edge, Dopri5::new().rtol(1e-12).atol(1e-12), 0.0, start);
    for second in 1..=4 {
        sim.advance_to(f64::from(second))?;
        let section = edge.hamilton_jacobi(0.0, sim.state());
        assert!((section.w - sim.state().w).abs() < 1e-10, "{:?}", sim.state());
        assert!((section.v - sim.state().v).abs() < 1e-10, "{:?}", sim.state());
    }
    let suslov = Suslov { A: 1.0, B: 2.0, C: 3.0, D: 0.4, p: 0.7 };
    let turning = suslov.hamilton_jacobi(0.0, &SuslovState::default());
    assert_eq!(turning, SuslovState { w_0: 0.0, w_1: 0.35 });
    assert_eq!(suslov.derivative(0.0, &turning, &()), SuslovState::default());
    let charge = Charge { b: 0.6, k: 0.5, e: 2.0 };
    let start = charge.hamilton_jacobi(0.0, &ChargeState { x: 0.1, y: 0.4, ..ChargeState::default() });
    let mut sim = Integrator::new(charge, Dopri5::new().rtol(1e-12).atol(1e-12), 0.0, start);
    sim.advance_to(1.0)?;
    let section = charge.hamilton_jacobi(0.0, sim.state());
    assert!((section.x_dot - sim.state().x_dot).abs() < 1e-10, "{section:?} {:?}", sim.state());
    assert!((section.y_dot - sim.state().y_dot).abs() < 1e-10, "{section:?} {:?}", sim.state());
    let belt = Belt { W: 0.3, p: 0.9 };
    let rate = belt.derivative(0.0, &belt.hamilton_jacobi(0.0, &BeltState::default()), &());
    assert!(rate.x_dot.abs() <= 0.0, "{rate:?}");
    Ok(())
}

#[test]
fn the_jacobi_identity_is_decided() {
    for (report, line) in [
        // D is not involutive
        (Edge::REPORT, "the bracket violates the Jacobi identity: {"),
        // two momenta over a point, and a whole tangent bundle
        (Suslov::REPORT, "the bracket satisfies the Jacobi identity"),
        (Charge::REPORT, "the bracket satisfies the Jacobi identity"),
        (Belt::REPORT, "the bracket satisfies the Jacobi identity"),
    ] {
        assert!(report.contains(line), "{report}");
    }
}
