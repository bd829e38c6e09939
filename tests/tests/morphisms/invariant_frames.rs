//! Quotients by declared symmetries: the invariant frame is derived.

use nonholonomic::prelude::*;

use super::support::reconstructs;

/// Rolling disk, upright.
#[nonholonomic(
    base { x, y, phi, psi }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) + I / 2 * der(psi)^2 + J / 2 * der(phi)^2 - k * cos(psi) }
    constraints { der(x) = r * cos(phi) * der(psi); der(y) = r * sin(phi) * der(psi); }
    forces { psi: push - c * der(psi); phi: steer; }
    inputs { push, steer }
    symmetries { turn: der(phi) + x * der(y) - y * der(x); }
)]
#[derive(Clone, Copy, Debug)]
struct Disk {
    m: f64,
    I: f64,
    J: f64,
    r: f64,
    k: f64,
    c: f64,
}

quotient! { Disk -> #[derive(Clone, Copy, Debug)] struct DiskShape by { x, y, phi } }

#[test]
fn disk() {
    let disk = Disk { m: 1.1, I: 0.4, J: 0.3, r: 0.5, k: 0.6, c: 0.05 };
    let start = DiskState { x: 0.2, y: -0.3, phi: 0.7, psi: 0.4, psi_dot: 1.2, phi_dot: -0.8 };
    reconstructs::<_, DiskShape>(&disk, start, DiskInput { push: 0.2, steer: 0.1 });
}

/// Two-wheeled robot that pulls a trailer.
#[nonholonomic(
    base { x, y, theta, b, psi[2] }
    lagrangian {
        m / 2 * (der(x)^2 + der(y)^2) + J / 2 * der(theta)^2 + J2 / 2 * (der(psi[0])^2 + der(psi[1])^2)
        + mt / 2 * ((der(x) - d * sin(theta + b) * (-der(theta) - der(b)))^2 + (der(y) - d * cos(theta + b) * (der(theta) + der(b)))^2)
        + Jt / 2 * (der(theta) + der(b))^2
    }
    constraints {
        -sin(theta) * der(x) + cos(theta) * der(y) = 0;
        cos(theta) * der(x) + sin(theta) * der(y) + c * der(theta) = R * der(psi[0]);
        cos(theta) * der(x) + sin(theta) * der(y) - c * der(theta) = R * der(psi[1]);
        -sin(theta + b) * der(x) + cos(theta + b) * der(y) = d * (der(theta) + der(b));
    }
    assume { d > 0; c > 0; R > 0; }
    forces { psi[0]: u[0]; psi[1]: u[1]; }
    inputs { u[2] }
    symmetries { turn: der(theta) + x * der(y) - y * der(x); }
    independent { der(psi[0]), der(psi[1]) }
)]
#[derive(Clone, Copy, Debug)]
struct Pulling {
    m: f64,
    J: f64,
    J2: f64,
    mt: f64,
    Jt: f64,
    d: f64,
    c: f64,
    R: f64,
}

quotient! { Pulling -> #[derive(Clone, Copy, Debug)] struct PullingShape by { x, y, theta } }

#[test]
fn trailer() {
    let robot = Pulling { m: 3.0, J: 0.9, J2: 0.05, mt: 1.2, Jt: 0.3, d: 0.6, c: 0.3, R: 0.15 };
    let start = PullingState { x: 0.2, y: -0.3, theta: 0.7, b: 0.4, psi: [0.1, 0.2], psi_dot: [2.0, 3.0] };
    reconstructs::<_, PullingShape>(&robot, start, PullingInput { u: [0.2, 0.1] });
}

/// Contact particle on the Heisenberg group.
#[nonholonomic(
    base { x, y, z }
    lagrangian { (der(x)^2 + A * der(y)^2) / 2 + B / 2 * (der(z) - y * der(x))^2 + C * der(x) * der(y) }
    constraints { der(z) = y * der(x) + e * der(y); }
    symmetries { push: der(y) + x * der(z); }
)]
#[derive(Clone, Copy, Debug)]
struct Contact {
    A: f64,
    B: f64,
    C: f64,
    e: f64,
}

quotient! { Contact -> #[derive(Clone, Copy, Debug)] struct ContactAlgebra by { x, y, z } }

#[test]
fn contact() {
    let p = Contact { A: 1.5, B: 0.8, C: 0.2, e: 0.7 };
    let start = ContactState { x: 0.2, y: -0.3, z: 0.1, x_dot: 0.6, y_dot: -0.5 };
    reconstructs::<_, ContactAlgebra>(&p, start, ());
}

/// A homogeneous ball with its attitude as a matrix, inside a cylinder; the symmetry: how it is painted.
#[nonholonomic(
    base { al, z, R[3][3] }
    on { for i in 0..3 { for j in 0..i { sum(k in 0..3: R[i][k] * R[j][k]) = 0; } sum(k in 0..3: R[i][k]^2) = 1; } }
    basis { da, dz, w[3] }
    anchor { der(al) = da; der(z) = dz; for i in 0..3 { der(R[i]) = cross(R[i], w); } }
    brackets so(3) { w }
    lagrangian { m / 2 * ((Q - a)^2 * da^2 + dz^2) + J / 2 * dot(w, w) - m * g * z }
    constraints {
        (Q - a) * da + a * dot(R[2], w) = 0;
        dz = a * (-sin(al) * dot(R[0], w) + cos(al) * dot(R[1], w));
    }
    symmetries { p0: w[0]; p1: w[1]; p2: w[2]; }
)]
#[derive(Clone, Copy, Debug)]
struct Painted {
    m: f64,
    J: f64,
    Q: f64,
    a: f64,
    g: f64,
}

quotient! { Painted -> #[derive(Clone, Copy, Debug)] struct Ball by { R[0], R[1], R[2] } }

// the same in the moving frame of the point of contact
quotient! { Painted -> #[derive(Clone, Copy, Debug)] struct BallMoving by { al, R[0], R[1], R[2] } {
    velocities {
        da = da; dz = dz;
        wr = cos(al) * dot(R[0], w) + sin(al) * dot(R[1], w);
        wa = -sin(al) * dot(R[0], w) + cos(al) * dot(R[1], w);
        wz = dot(R[2], w);
    }
} }

#[test]
fn ball() {
    let p = Painted { m: 1.0, J: 0.04, Q: 1.0, a: 0.3, g: 9.8 };
    let (sin, cos) = 0.9_f64.sin_cos();
    let start = PaintedState {
        al: 0.4,
        z: 0.2,
        R: [[cos, 0.0, sin], [0.0, 1.0, 0.0], [-sin, 0.0, cos]],
        w: [0.7, -0.4, 1.1],
    };
    reconstructs::<_, Ball>(&p, start, ());
    reconstructs::<_, BallMoving>(&p, start, ());
    for line in [
        "[body_w_0, body_w_1] = -body_w_2\n",
        "curvature [h_al, h_z] = (-Q*cos(al)/a^2)*body_w_0 + (-Q*sin(al)/a^2)*body_w_1\n",
    ] {
        assert!(Ball::REPORT.contains(line), "{line}\n{}", Ball::REPORT);
    }
}

/// Knife edge on an incline: y only.
#[nonholonomic(
    base { x, y, phi }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) + J / 2 * der(phi)^2 + m * g * sin(s) * x }
    constraints { sin(phi) * der(x) = cos(phi) * der(y); }
)]
#[derive(Clone, Copy, Debug)]
struct Incline {
    m: f64,
    J: f64,
    g: f64,
    s: f64,
}

quotient! { Incline -> #[derive(Clone, Copy, Debug)] struct InclineShape by { y } }

#[test]
fn incline() {
    let p = Incline { m: 1.0, J: 0.4, g: 9.8, s: 0.3 };
    let start =
        InclineState { x: 0.1, y: 0.3, phi: 0.4, x_dot: 0.4_f64.cos(), y_dot: 0.4_f64.sin(), phi_dot: 0.9 };
    reconstructs::<_, InclineShape>(&p, start, ());
}

/// A sled in space: a body that slides along its first axis only, in space-fixed velocities.
#[nonholonomic(
    base { R[3][3], x[3] }
    on { for i in 0..3 { for j in 0..i { sum(k in 0..3: R[i][k] * R[j][k]) = 0; } sum(k in 0..3: R[i][k]^2) = 1; } }
    basis { w[3], u[3] }
    anchor { for i in 0..3 { der(R[i]) = cross(R[i], w); } for i in 0..3 { der(x[i]) = u[i]; } }
    brackets so(3) { w }
    lagrangian { m / 2 * dot(u, u) + (A * w[0]^2 + B * w[1]^2 + C * w[2]^2) / 2 + s * sum(k in 0..3: R[k][0] * u[k]) * w[1] }
    constraints { sum(k in 0..3: R[k][1] * u[k]) = 0; sum(k in 0..3: R[k][2] * u[k]) = 0; }
    symmetries {
        rx: dot(R[0], w) + x[1] * u[2] - x[2] * u[1];
        ry: dot(R[1], w) + x[2] * u[0] - x[0] * u[2];
        rz: dot(R[2], w) + x[0] * u[1] - x[1] * u[0];
    }
)]
#[derive(Clone, Copy, Debug)]
struct Sled {
    m: f64,
    A: f64,
    B: f64,
    C: f64,
    s: f64,
}

quotient! { Sled -> #[derive(Clone, Copy, Debug)] struct SledAlgebra by { R[0], R[1], R[2], x } }

#[test]
fn sled() {
    let sled = Sled { m: 1.3, A: 1.0, B: 1.4, C: 2.0, s: 0.3 };
    let (sin, cos) = 0.9_f64.sin_cos();
    let start = SledState {
        R: [[cos, 0.0, sin], [0.0, 1.0, 0.0], [-sin, 0.0, cos]],
        x: [0.1, 0.2, -0.3],
        w: [0.3, -0.5, 0.8],
        u: [0.7 * cos, 0.0, -0.7 * sin],
    };
    reconstructs::<_, SledAlgebra>(&sled, start, ());
    for line in ["[w[0], body_u_1] = body_u_2\n", "equations: Euler–Poincaré–Suslov\n"] {
        assert!(SledAlgebra::REPORT.contains(line), "{line}\n{}", SledAlgebra::REPORT);
    }
}

/// A rigid body in Euler angles: of its rotations in space only one is along a coordinate.
#[nonholonomic(
    base { phi, theta, psi }
    lagrangian {
        let w1 = sin(theta) * sin(psi) * der(phi) + cos(psi) * der(theta);
        let w2 = sin(theta) * cos(psi) * der(phi) - sin(psi) * der(theta);
        let w3 = cos(theta) * der(phi) + der(psi);
        (A * w1^2 + B * w2^2 + C * w3^2) / 2
    }
    symmetries {
        sx: cos(phi) * der(theta) - sin(phi) * cos(theta) / sin(theta) * der(phi) + sin(phi) / sin(theta) * der(psi);
        sy: sin(phi) * der(theta) + cos(phi) * cos(theta) / sin(theta) * der(phi) - cos(phi) / sin(theta) * der(psi);
    }
)]
#[derive(Clone, Copy, Debug)]
struct Euler {
    A: f64,
    B: f64,
    C: f64,
}

quotient! { Euler -> #[derive(Clone, Copy, Debug)] struct Body by { phi, theta, psi } }

#[test]
fn euler() {
    let body = Euler { A: 1.0, B: 1.4, C: 2.0 };
    let start = EulerState { phi: 0.3, theta: 1.1, psi: 0.4, phi_dot: 0.5, theta_dot: -0.3, psi_dot: 0.7 };
    reconstructs::<_, Body>(&body, start, ());
}

/// A knife edge geared to twice the angle, beside a coordinate with the name that a velocity would get.
#[nonholonomic(
    base { x, y, phi, body_x }
    lagrangian { (der(x)^2 + der(y)^2) / 2 + J / 2 * der(phi)^2 + der(body_x)^2 / 2 - der(phi) * body_x }
    constraints { sin(2 * phi) * der(x) = cos(2 * phi) * der(y); }
    symmetries { turn: der(phi) / 2 + x * der(y) - y * der(x); }
)]
#[derive(Clone, Copy, Debug)]
struct Geared {
    J: f64,
}

quotient! { Geared -> #[derive(Clone, Copy, Debug)] struct GearedShape by { x, y, phi } }

#[test]
fn geared() {
    let (sin, cos) = 0.8_f64.sin_cos();
    let place = GearedState { x: 0.1, y: 0.3, phi: 0.4, body_x: 0.2, ..GearedState::default() };
    let start = GearedState { x_dot: cos, y_dot: sin, phi_dot: 0.9, body_x_dot: -0.3, ..place };
    reconstructs::<_, GearedShape>(&Geared { J: 0.7 }, start, ());
    let line = "[body_x_, phi_dot] = -2*body_y\n";
    assert!(GearedShape::REPORT.contains(line), "{}", GearedShape::REPORT);
}
