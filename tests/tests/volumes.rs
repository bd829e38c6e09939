//! Volumes of systems that are in no list: the verdicts are known from elsewhere.
#![allow(non_snake_case, reason = "parameters are written as in mechanics")]

use nonholonomic::prelude::*;

/// Polar coordinates: the density of the plane, r, in unit velocities.
#[nonholonomic(
    base { r, phi }
    basis { u, w }
    anchor { der(r) = u; der(phi) = w / r; }
    lagrangian { (u^2 + w^2) / 2 - V * r^4 }
    volume;
    emit { volume, divergence }
)]
#[derive(Clone, Copy, Debug)]
struct Polar {
    V: f64,
}

/// The nonholonomic particle ż = y ẋ: density 1/√(1 + y²) on the reduced space, times the mass.
#[nonholonomic(
    base { x, y, z }
    lagrangian { (der(x)^2 + der(y)^2 + der(z)^2) / 2 }
    constraints { der(z) = y * der(x); }
    volume { sqrt(1 + y^2); }
    emit { volume, divergence }
)]
#[derive(Clone, Copy, Debug)]
struct Particle;

/// The same found.
#[nonholonomic(
    base { x, y, z }
    lagrangian { (der(x)^2 + der(y)^2 + der(z)^2) / 2 - sin(x) }
    constraints { der(z) = y * der(x); }
    volume;
    emit { volume, divergence }
)]
#[derive(Clone, Copy, Debug)]
struct ParticleFound;

/// The vertical rolling disk, on the plane.
#[nonholonomic(
    base { x, y, theta, phi }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) + K / 2 * der(phi)^2 + J / 2 * der(theta)^2 }
    constraints { der(x) = R * cos(theta) * der(phi); der(y) = R * sin(theta) * der(phi); }
    volume;
    emit { volume }
)]
#[derive(Clone, Copy, Debug)]
struct Disk {
    m: f64,
    J: f64,
    K: f64,
    R: f64,
}

/// A skate in coordinates of the plane: the projected formulation.
#[nonholonomic(
    base { theta, x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) + J / 2 * der(theta)^2 - m * g * x }
    constraints { sin(theta) * der(x) = cos(theta) * der(y); }
    volume;
    emit { volume }
)]
#[derive(Clone, Copy, Debug)]
struct Skate {
    m: f64,
    J: f64,
    g: f64,
}

/// Euler angles of a free body: the density sin(theta).
#[nonholonomic(
    base { phi, theta, psi }
    velocities {
        w1 = der(phi) * sin(theta) * sin(psi) + der(theta) * cos(psi);
        w2 = der(phi) * sin(theta) * cos(psi) - der(theta) * sin(psi);
        w3 = der(phi) * cos(theta) + der(psi);
    }
    lagrangian { (A * w1^2 + B * w2^2 + C * w3^2) / 2 - cos(theta) }
    volume { sin(theta); }
    emit { volume }
)]
#[derive(Clone, Copy, Debug)]
struct Euler {
    A: f64,
    B: f64,
    C: f64,
}

/// The same, found.
#[nonholonomic(
    base { phi, theta, psi }
    velocities {
        w1 = der(phi) * sin(theta) * sin(psi) + der(theta) * cos(psi);
        w2 = der(phi) * sin(theta) * cos(psi) - der(theta) * sin(psi);
        w3 = der(phi) * cos(theta) + der(psi);
    }
    lagrangian { (A * w1^2 + B * w2^2 + C * w3^2) / 2 - cos(theta) }
    emit { volume }
)]
#[derive(Clone, Copy, Debug)]
struct EulerFound {
    A: f64,
    B: f64,
    C: f64,
}

/// Rotation matrices: the anchor keeps RᵀR = 1, and the divergence on them is 0.
#[nonholonomic(
    base { R[3][3] }
    on {
        for i in 0..3 { sum(k in 0..3: R[k][i]^2) = 1; }
        for i in 0..2 { for j in i + 1..3 { sum(k in 0..3: R[k][i] * R[k][j]) = 0; } }
    }
    basis { w[3] }
    anchor {
        for i in 0..3 {
            der(R[i][0]) = R[i][1] * w[2] - R[i][2] * w[1];
            der(R[i][1]) = R[i][2] * w[0] - R[i][0] * w[2];
            der(R[i][2]) = R[i][0] * w[1] - R[i][1] * w[0];
        }
    }
    brackets so(3) { w }
    lagrangian { (A * w[0]^2 + B * w[1]^2 + C * w[2]^2) / 2 - R[2][0] }
    volume;
    emit { volume, divergence }
)]
#[derive(Clone, Copy, Debug)]
struct Top {
    A: f64,
    B: f64,
    C: f64,
}

/// A damped particle on a blade by the Lagrangian of Caldirola and Kanai: its divergence is a number, and its density, the mass,
/// depends on the time.
#[nonholonomic(
    base { x, y, z }
    lagrangian { exp(2 * c * t) * ((der(x)^2 + der(y)^2 + der(z)^2) / 2 - sin(x)) }
    constraints { der(z) = y * der(x); }
    volume;
    emit { volume, divergence }
)]
#[derive(Clone, Copy, Debug)]
struct Damped {
    c: f64,
}

/// Checks mathematics (19).
#[test]
fn verdicts() {
    for (report, density) in [
        (Polar::REPORT, "invariant: (abs(r)) "),
        (Particle::REPORT, "the density sqrt(y^2 + 1) is kept"),
        (ParticleFound::REPORT, "invariant: (sqrt(y^2 + 1)) "),
        (Disk::REPORT, "invariant: (1) "),
        (Skate::REPORT, "invariant: (1) "),
        (Euler::REPORT, "the density sin(theta) is kept"),
        (EulerFound::REPORT, "invariant: (abs(sin(theta))) "),
        (Top::REPORT, "invariant: (1) "),
    ] {
        assert!(report.contains(density), "{report}");
    }
}

#[test]
fn densities_and_divergences() {
    let euler = EulerFound { A: 1.0, B: 2.0, C: 3.0 };
    let state = EulerFoundState { phi: 0.1, theta: 0.7, psi: 0.4, w1: 0.2, w2: -0.3, w3: 0.5 };
    assert!((euler.volume_density(0.0, &state) - 0.7_f64.sin()).abs() < 1e-15);
    let state = ParticleState { y: 0.5, x_dot: 0.3, y_dot: 0.7, ..Default::default() };
    // −d/dt log √(1 + y²)
    assert!((Particle.divergence(0.0, &state, &()) + 0.5 * 0.7 / 1.25).abs() < 1e-15);
    let (damped, state) =
        (Damped { c: 0.3 }, DampedState { y: 0.5, x_dot: 0.3, y_dot: 0.7, ..Default::default() });
    let density = (4.0_f64 * 0.3 * 2.0).exp() * 1.25_f64.sqrt();
    assert!((damped.volume_density(2.0, &state) / density - 1.0).abs() < 1e-15);
    assert!((damped.divergence(2.0, &state, &()) + 4.0 * 0.3 + 0.5 * 0.7 / 1.25).abs() < 1e-15);
    let top = Top { A: 1.0, B: 2.0, C: 3.0 };
    let state = TopState { R: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], w: [0.3, 0.4, -0.5] };
    assert!(top.divergence(0.0, &state, &()).abs() < 1e-15);
}
