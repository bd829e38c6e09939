//! Impacts where constraints hold: with multipliers and without, on positions and on velocities.

use nonholonomic::prelude::*;

/// A sleigh that meets a wall with its knife edge on the ground.
#[nonholonomic(
    base { theta, x, y }
    basis { omega, v1, v2 }
    anchor {
        der(theta) = omega;
        der(x) = v1 * cos(theta) - v2 * sin(theta);
        der(y) = v1 * sin(theta) + v2 * cos(theta);
    }
    lagrangian { (J + m * a^2) / 2 * omega^2 + m / 2 * (v1^2 + v2^2) + m * a * omega * v2 }
    constraints { v2 = s; }
    impacts { wall: x + b * cos(theta) <= 0 with restitution e; }
    names { state = SleighState; }
)]
#[derive(Clone, Copy, Debug)]
struct Sleigh {
    m: f64,
    J: f64,
    a: f64,
    b: f64,
    s: f64,
    e: f64,
}

/// The same, with multipliers.
#[nonholonomic(
    base { theta, x, y }
    basis { omega, v1, v2 }
    anchor {
        der(theta) = omega;
        der(x) = v1 * cos(theta) - v2 * sin(theta);
        der(y) = v1 * sin(theta) + v2 * cos(theta);
    }
    lagrangian { (J + m * a^2) / 2 * omega^2 + m / 2 * (v1^2 + v2^2) + m * a * omega * v2 }
    constraints { v2 = s; }
    impacts { wall: x + b * cos(theta) <= 0 with restitution e; }
    formulation { projected }
)]
#[derive(Clone, Copy, Debug)]
struct Multiplied {
    m: f64,
    J: f64,
    a: f64,
    b: f64,
    s: f64,
    e: f64,
}

#[test]
fn both_formulations_jump_alike() {
    for (s, e) in [(0.0, 0.0), (0.0, 0.7), (0.2, 0.4)] {
        let sleigh = Sleigh { m: 2.0, J: 0.4, a: 0.3, b: 0.5, s, e };
        let multiplied = Multiplied { m: 2.0, J: 0.4, a: 0.3, b: 0.5, s, e };
        let theta = 0.6_f64;
        let state = SleighState { theta, x: -0.5 * theta.cos(), y: 1.0, omega: -0.3, v1: 1.4 };
        let SleighState { x, y, omega, v1, .. } = state;
        let full = MultipliedState { theta, x, y, omega, v1, v2: s };
        let (after, impulses) = sleigh.impact_wall(0.0, &state).unwrap();
        let (after_full, impulses_full) = multiplied.impact_wall(0.0, &full).unwrap();
        assert!((after.omega - after_full.omega).abs() < 1e-14 && (after.v1 - after_full.v1).abs() < 1e-14);
        assert!((impulses.wall - impulses_full.wall).abs() < 1e-14 && impulses.wall > 0.0);
        assert!((after_full.v2 - s).abs() < 1e-15);
        // the gap, and its rate
        let rate = |theta: f64, omega: f64, v1: f64| {
            -(v1 * theta.cos() - s * theta.sin() - 0.5 * omega * theta.sin())
        };
        let (before, later) = (rate(theta, omega, v1), rate(theta, after.omega, after.v1));
        assert!(before < 0.0 && (later + e * before).abs() < 1e-14, "{before} {later}");
        if s == 0.0 {
            assert!(sleigh.energy(0.0, &after) <= sleigh.energy(0.0, &state) + 1e-14);
        }
    }
}

/// A pendulum in coordinates of the plane, and a wall through its lowest point.
#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) - m * g * y }
    holonomic { rod: x^2 + y^2 = l^2; }
    impacts { wall: x >= 0 with restitution e; }
)]
#[derive(Clone, Copy, Debug)]
struct Pendulum {
    m: f64,
    g: f64,
    l: f64,
    e: f64,
}

#[test]
fn a_pendulum_bounces_from_a_wall_on_its_circle() {
    use core::ops::ControlFlow;
    use nonholonomic::impacts::advance_with_impacts;
    let pendulum = Pendulum { m: 0.7, g: 9.81, l: 1.2, e: 1.0 };
    let start = PendulumState { x: 1.2 * 0.5_f64.sin(), y: -1.2 * 0.5_f64.cos(), ..PendulumState::default() };
    let mut sim = Integrator::new(pendulum, Dopri5::new().rtol(1e-10).atol(1e-12), 0.0, start);
    let energy = pendulum.energy(0.0, &start);
    let mut bounces = 0;
    let end = advance_with_impacts(&mut sim, 10.0, &PendulumWallImpact, 0.0, |struck| {
        let (before, after) = (&struck.before, &struck.after);
        assert!((after.x_dot + before.x_dot).abs() < 1e-12 && before.x_dot < -1.0);
        assert!((after.x * after.x_dot + after.y * after.y_dot).abs() < 1e-12);
        bounces += 1;
        ControlFlow::Continue(())
    });
    end.unwrap();
    let state = sim.state();
    // half a swing of 2.2 s each, and N is not left
    assert!(bounces == 9 || bounces == 8, "{bounces}");
    assert!((pendulum.energy(10.0, state) - energy).abs() < 1e-8);
    assert!((state.x.hypot(state.y) - 1.2).abs() < 1e-14 && state.x > -1e-9);
}
