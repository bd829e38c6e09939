//! What reduction theory calls a system, and the gyroscopic force of Chaplygin systems: against the
//! formula for the two-wheeled robot, and as the force that makes the reduced Lagrangian right.

use nh_tests::random::Random;
use nh_tests::systems::particles::ParticleY;
use nh_tests::systems::rotating_table::BallOnRotatingTable;
use nh_tests::systems::suslov::Suslov;
use nonholonomic::prelude::*;

/// A two-wheeled robot on the algebroid of its symmetry group, CLMM section 6.4.
#[nonholonomic(
    base  { psi1, psi2 }
    basis { dpsi1, dpsi2, w1, w2, w3 }
    anchor { der(psi1) = dpsi1; der(psi2) = dpsi2; }
    brackets se(2) { w3, w1, w2 }
    lagrangian {
        (m0 + 2 * m1) / 2 * (w1^2 + w2^2) + m0 * l * w2 * w3 + J / 2 * w3^2 + J2 / 2 * (dpsi1^2 + dpsi2^2)
    }
    constraints {
        lateral: -w2 = 0;
        wheel1: w1 + c * w3 + R * dpsi1 = 0;
        wheel2: w1 - c * w3 + R * dpsi2 = 0;
    }
    emit { gyroscopic }
)]
#[derive(Clone, Copy, Debug)]
struct Robot {
    m0: f64,
    m1: f64,
    l: f64,
    J: f64,
    J2: f64,
    c: f64,
    R: f64,
}

#[test]
fn the_force_of_the_robots_constraints() {
    let robot = Robot { m0: 3.0, m1: 0.4, l: 0.2, J: 0.5, J2: 0.02, c: 0.3, R: 0.1 };
    let u = robot.m0 * robot.l * robot.R.powi(3) / (4.0 * robot.c * robot.c);
    let mut random = Random::new(9);
    for _ in 0..50 {
        let state = RobotState::from(std::array::from_fn(|_| random.between(-5.0, 5.0)));
        let RobotState { dpsi1, dpsi2, .. } = state;
        let force = robot.gyroscopic(0.0, &state);
        // ⟨J, K⟩ = U (ψ̇₂ − ψ̇₁) (ψ̇₁ dψ₂ − ψ̇₂ dψ₁)
        let expected = [-u * (dpsi2 - dpsi1) * dpsi2, u * (dpsi2 - dpsi1) * dpsi1];
        for (found, expected) in <[f64; 2]>::from(force).iter().zip(expected) {
            assert!((found - expected).abs() < 1e-15 * (1.0 + expected.abs()), "{found} {expected}");
        }
    }
    let plane = RobotOnThePlane { m0: 3.0, m1: 0.4, l: 0.2, J: 0.5, J2: 0.02, c: 0.3, R: 0.1 };
    for _ in 0..50 {
        let state = RobotOnThePlaneState::from(std::array::from_fn(|_| random.between(-5.0, 5.0)));
        let RobotOnThePlaneState { psi1, psi2, psi1_dot, psi2_dot, .. } = state;
        let reduced = RobotState { psi1, psi2, dpsi1: psi1_dot, dpsi2: psi2_dot };
        let (found, expected) = (plane.gyroscopic(0.0, &state), robot.gyroscopic(0.0, &reduced));
        for (found, expected) in <[f64; 2]>::from(found).iter().zip(<[f64; 2]>::from(expected)) {
            assert!((found - expected).abs() < 1e-15 * (1.0 + expected.abs()), "{found} {expected}");
        }
    }
    let report = RobotOnThePlane::REPORT;
    for line in [
        "rates of psi1, psi2; the group: the declared symmetries of L and D, with the cyclic coordinates \
         that they move\n",
        "velocity in the invariant frame: body_x = (cos(theta))*x_dot + (sin(theta))*y_dot\n",
    ] {
        assert!(report.contains(line), "{line}\n{report}");
    }
    let report = Robot::REPORT;
    assert!(
        report.contains("Chaplygin system: the anchor maps D one to one onto the rates of psi1, psi2\n"),
        "{report}"
    );
    assert!(report.contains("curvature K(d/dpsi1, d/dpsi2) = (R^2/2/c)*w2\n"), "{report}");
}

/// The same on the plane, where the symmetries of the group are declared.
#[nonholonomic(
    base { x, y, theta, psi1, psi2 }
    lagrangian {
        let w2 = cos(theta) * der(y) - sin(theta) * der(x);
        (m0 + 2 * m1) / 2 * (der(x)^2 + der(y)^2) + m0 * l * w2 * der(theta) + J / 2 * der(theta)^2
            + J2 / 2 * (der(psi1)^2 + der(psi2)^2)
    }
    constraints {
        cos(theta) * der(y) = sin(theta) * der(x);
        cos(theta) * der(x) + sin(theta) * der(y) + c * der(theta) + R * der(psi1) = 0;
        cos(theta) * der(x) + sin(theta) * der(y) - c * der(theta) + R * der(psi2) = 0;
    }
    assume { R > 0; c > 0; }
    symmetries { turn: der(theta) + x * der(y) - y * der(x); }
    independent { der(psi1), der(psi2) }
    emit { gyroscopic }
)]
#[derive(Clone, Copy, Debug)]
struct RobotOnThePlane {
    m0: f64,
    m1: f64,
    l: f64,
    J: f64,
    J2: f64,
    c: f64,
    R: f64,
}

/// A particle on a rough plane, with a potential: only z is cyclic.
#[nonholonomic(
    base { x, y, z }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) - k * x * y^2 }
    constraints { der(z) = sin(y) * der(x) + x^2 * der(y); }
    emit { gyroscopic }
)]
#[derive(Clone, Copy, Debug)]
struct Particle {
    m: f64,
    k: f64,
}

/// Its reduced Lagrangian, with a force from outside.
#[nonholonomic(
    base { x, y }
    lagrangian {
        let up = sin(y) * der(x) + x^2 * der(y);
        m / 2 * (der(x)^2 + der(y)^2 + up^2) - k * x * y^2
    }
    forces { x: fx; y: fy; }
    inputs { fx, fy }
)]
#[derive(Clone, Copy, Debug)]
struct ReducedParticle {
    m: f64,
    k: f64,
}

/// Checks mathematics (23).
#[test]
fn the_reduced_lagrangian_with_the_gyroscopic_force_moves_alike() {
    let (particle, reduced) = (Particle { m: 1.3, k: 0.7 }, ReducedParticle { m: 1.3, k: 0.7 });
    let mut random = Random::new(4);
    for _ in 0..50 {
        let [x, y, x_dot, y_dot] = std::array::from_fn(|_| random.between(-1.5, 1.5));
        let state = ParticleState { x, y, z: 0.0, x_dot, y_dot };
        let force = particle.gyroscopic(0.0, &state);
        let input = ReducedParticleInput { fx: force.x, fy: force.y };
        let found = reduced.derivative(0.0, &ReducedParticleState { x, y, x_dot, y_dot }, &input);
        let expected = particle.derivative(0.0, &state, &());
        assert!((found.x_dot - expected.x_dot).abs() < 1e-12, "{found:?} {expected:?}");
        assert!((found.y_dot - expected.y_dot).abs() < 1e-12, "{found:?} {expected:?}");
        // without power
        assert!((force.x * x_dot + force.y * y_dot).abs() < 1e-13, "{force:?}");
    }
}

/// A ball in a bowl of its own: a momentum equation is left.
#[nonholonomic(
    base { r }
    basis { v, w1, w2, w3 }
    anchor { der(r) = v; }
    brackets so(3) { w1, w2, w3 }
    lagrangian { m / 2 * v^2 + I / 2 * (w1^2 + w2^2) + K / 2 * w3^2 - k * r^2 }
    constraints { w1 = r * v; }
)]
#[derive(Clone, Copy, Debug)]
struct Spinning {
    m: f64,
    I: f64,
    K: f64,
    k: f64,
}

/// The same without constraints.
#[nonholonomic(
    base { r }
    basis { v, w1, w2, w3 }
    anchor { der(r) = v; }
    brackets so(3) { w1, w2, w3 }
    lagrangian { m / 2 * v^2 + I / 2 * (w1^2 + w2^2) + r^2 / 2 * w3^2 }
)]
#[derive(Clone, Copy, Debug)]
struct Free {
    m: f64,
    I: f64,
}

/// Purely kinematic: both constraints are on the one direction of the fibre and on the base.
#[nonholonomic(
    base { x, y, z }
    basis { u, v, w, xi }
    anchor { der(x) = u; der(y) = v; der(z) = w; }
    brackets { }
    lagrangian { m / 2 * (u^2 + v^2 + w^2) + xi^2 / 2 - x * y * z }
    constraints { xi = x * v; w = y * u; }
)]
#[derive(Clone, Copy, Debug)]
struct Kinematic {
    m: f64,
}

#[test]
fn systems_are_called_by_their_names() {
    for (report, name) in [
        (Suslov::REPORT, "equations: Euler–Poincaré–Suslov\n"),
        (Free::REPORT, "equations: Lagrange–Poincaré, with momentum equations of rank 3\n"),
        (
            Spinning::REPORT,
            "equations: Lagrange–d'Alembert–Poincaré: S = D ∩ V, V = ker ρ, has rank 2; D + V = E (the dimension \
             assumption)\n",
        ),
        (
            Kinematic::REPORT,
            "equations: purely kinematic: D meets V = ker ρ in 0 only; ρ(D) has rank 2 of 3\n",
        ),
        (ParticleY::REPORT, "; the group: translations along the cyclic coordinates\n"),
    ] {
        assert!(report.contains(name), "{name}\n{report}");
    }
    // [X_v, e2] and [X_v, e3] with X_v = v + r w1: the connection; [e2, e3] = e1 in S
    for line in [
        "momentum section S_w2 = w2\n",
        "connection [h_r, S_w2] = (r)*w3\n",
        "bracket in S [S_w2, S_w3] = w1\n",
    ] {
        assert!(Spinning::REPORT.contains(line), "{line}\n{}", Spinning::REPORT);
    }
    assert!(!BallOnRotatingTable::REPORT.contains("Chaplygin"), "its constraints are affine");
}
