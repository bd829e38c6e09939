//! A basis of D that is orthonormal in the kinetic metric: C is the identity, the motion the same.

use nonholonomic::prelude::*;

macro_rules! twice {
    ($plain:ident, $unit:ident { $($names:tt)* } ($($sections:tt)*) { $($fields:tt)* }) => {
        #[nonholonomic($($sections)*)]
        #[derive(Clone, Copy, Debug)]
        struct $plain { $($fields)* }

        #[nonholonomic($($sections)* orthonormal { $($names)* })]
        #[derive(Clone, Copy, Debug)]
        struct $unit { $($fields)* }
    };
}

twice! {
    Sleigh, UnitSleigh { turn, slide }
    (
        base   { theta, x, y }
        basis  { omega, v1, v2 }
        anchor {
            der(theta) = omega;
            der(x) = v1 * cos(theta) - v2 * sin(theta);
            der(y) = v1 * sin(theta) + v2 * cos(theta);
        }
        lagrangian  { (J + m * (a^2 + b^2)) / 2 * omega^2 + m / 2 * (v1^2 + v2^2) - m * b * omega * v1 + m * a * omega * v2 }
        constraints { blade: v2 = 0; }
        forces      { omega: torque - c * omega; }
        inputs      { torque }
        outputs     { speed = v1; }
        assume      { m > 0; J > 0; }
        emit        { multipliers, jacobian }
    )
    { m: f64, J: f64, a: f64, b: f64, c: f64 }
}

// a metric that depends on the place and the time, with a drift
twice! {
    Wheel, UnitWheel { u[2] }
    (
        base { x, phi, psi }
        lagrangian {
            m / 2 * (1 + x^2) * der(x)^2 + I / 2 * der(phi)^2 + (2 + sin(t)) / 2 * der(psi)^2
                + k * cos(x) * der(phi) * der(psi) - g * sin(x)
        }
        constraints { der(x) = r * der(phi) + s * t; }
    )
    { m: f64, I: f64, k: f64, g: f64, r: f64, s: f64 }
}

fn assert_close(found: &[f64], expected: &[f64]) {
    for (a, b) in found.iter().zip(expected) {
        assert!((a - b).abs() <= 1e-9 * (1.0 + b.abs()), "{found:?} is not {expected:?}");
    }
}

/// The end of a motion.
fn end<S: Dynamics<State: State<Scalar = f64>>>(system: S, start: S::State, input: S::Input) -> S::State {
    let mut sim = Integrator::new(system, Dopri5::new().rtol(1e-12).atol(1e-12), 0.0, start);
    sim.set_input(input);
    sim.advance_to(2.0).unwrap();
    *sim.state()
}

#[test]
fn sleigh() {
    let report = UnitSleigh::REPORT;
    assert!(report.contains("its basis is orthonormal in the kinetic metric"), "{report}");
    let mass =
        report.split("Mass matrix").nth(1).unwrap().lines().skip(1).take(2).collect::<Vec<_>>().join("\n");
    assert!(!mass.contains('m') && !mass.contains('J'), "the mass matrix is no identity:\n{mass}");
    let (m, inertia, a, b, c) = (1.3, 0.7, 0.4, -0.2, 0.1);
    let (plain, unit) = (Sleigh { m, J: inertia, a, b, c }, UnitSleigh { m, J: inertia, a, b, c });
    let start = UnitSleighState { theta: 0.3, x: 1.0, y: 2.0, turn: 0.9, slide: -0.6 };
    // twice the kinetic energy is u²
    assert!((unit.energy(0.0, &start) - 0.585).abs() < 1e-14);
    let velocity = unit.velocity(0.0, &start);
    assert!(velocity.v2.abs() <= 0.0);
    let same = SleighState { theta: 0.3, x: 1.0, y: 2.0, omega: velocity.omega, v1: velocity.v1 };
    let multiplier = unit.multipliers(0.0, &start, &UnitSleighInput { torque: 0.25 }).blade;
    assert_close(&[multiplier], &[plain.multipliers(0.0, &same, &SleighInput { torque: 0.25 }).blade]);
    let found = end(unit, start, UnitSleighInput { torque: 0.25 });
    let expected = end(plain, same, SleighInput { torque: 0.25 });
    let velocity = unit.velocity(2.0, &found);
    assert_close(
        &[found.theta, found.x, found.y, velocity.omega, velocity.v1],
        &[expected.theta, expected.x, expected.y, expected.omega, expected.v1],
    );
    let (by_state, _) = unit.jacobian(0.0, &start, &UnitSleighInput { torque: 0.0 });
    assert!(by_state.iter().all(|entry| entry.is_finite()));
}

#[test]
fn a_metric_that_moves() {
    let (m, inertia, k, g, r, s) = (1.2, 0.8, 0.3, 0.5, 0.6, 0.2);
    let (plain, unit) = (Wheel { m, I: inertia, k, g, r, s }, UnitWheel { m, I: inertia, k, g, r, s });
    let start = UnitWheelState { x: 0.4, phi: 0.1, psi: -0.3, u: [0.7, -0.5] };
    let velocity = unit.velocity(0.0, &start);
    let same =
        WheelState { x: 0.4, phi: 0.1, psi: -0.3, phi_dot: velocity.phi_dot, psi_dot: velocity.psi_dot };
    let (found, expected) = (end(unit, start, ()), end(plain, same, ()));
    let velocity = unit.velocity(2.0, &found);
    assert_close(
        &[found.x, found.phi, found.psi, velocity.phi_dot, velocity.psi_dot],
        &[expected.x, expected.phi, expected.psi, expected.phi_dot, expected.psi_dot],
    );
}
