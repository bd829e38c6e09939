//! Bodies that turn: attitude as angles or as a rotation matrix, reduced by rotations.

use nonholonomic::prelude::*;

use super::support::{reconstructs, reduces};

/// A free rigid body in Euler angles.
#[nonholonomic(
    base { phi, theta, psi }
    lagrangian {
        let w1 = der(phi) * sin(theta) * sin(psi) + der(theta) * cos(psi);
        let w2 = der(phi) * sin(theta) * cos(psi) - der(theta) * sin(psi);
        let w3 = der(phi) * cos(theta) + der(psi);
        (A * w1^2 + B * w2^2 + C * w3^2) / 2
    }
)]
#[derive(Clone, Copy, Debug)]
struct EulerAngles {
    A: f64,
    B: f64,
    C: f64,
}

/// With a rotation matrix.
#[nonholonomic(
    base { R[3][3] }
    on { for i in 0..3 { for j in 0..i { sum(k in 0..3: R[k][i] * R[k][j]) = 0; } sum(k in 0..3: R[k][i]^2) = 1; } }
    basis { w[3] }
    anchor { for i in 0..3 { der(R[i]) = cross(R[i], w); } }
    lagrangian { (A * w[0]^2 + B * w[1]^2 + C * w[2]^2) / 2 }
    brackets so(3) { w[0], w[1], w[2] }
)]
#[derive(Clone, Copy, Debug)]
struct RotationMatrix {
    A: f64,
    B: f64,
    C: f64,
}

/// Euler's equations on so(3).
#[nonholonomic(
    basis { w[3] }
    brackets so(3) { w }
    lagrangian { sum(i in 0..3: I[i] * w[i]^2) / 2 }
)]
#[derive(Clone, Copy, Debug)]
struct Euler {
    I: [f64; 3],
}

morphism! { EulerAngles -> Euler {
    parameters { I = [A, B, C]; }
    velocities {
        w[0] = der(phi) * sin(theta) * sin(psi) + der(theta) * cos(psi);
        w[1] = der(phi) * sin(theta) * cos(psi) - der(theta) * sin(psi);
        w[2] = der(phi) * cos(theta) + der(psi);
    }
} }

morphism! { RotationMatrix -> Euler { parameters { I = [A, B, C]; } } }

// from Euler angles to the rotation matrix of the same attitude.
morphism! { EulerAngles -> RotationMatrix {
    base {
        R[0] = [
            cos(phi) * cos(psi) - sin(phi) * cos(theta) * sin(psi),
            -cos(phi) * sin(psi) - sin(phi) * cos(theta) * cos(psi),
            sin(phi) * sin(theta),
        ];
        R[1] = [
            sin(phi) * cos(psi) + cos(phi) * cos(theta) * sin(psi),
            -sin(phi) * sin(psi) + cos(phi) * cos(theta) * cos(psi),
            -cos(phi) * sin(theta),
        ];
        R[2] = [sin(theta) * sin(psi), sin(theta) * cos(psi), cos(theta)];
    }
    velocities {
        w = [
            der(phi) * sin(theta) * sin(psi) + der(theta) * cos(psi),
            der(phi) * sin(theta) * cos(psi) - der(theta) * sin(psi),
            der(phi) * cos(theta) + der(psi),
        ];
    }
} }

/// Checks mathematics (13) and (14).
#[test]
fn rigid_body() {
    let body = EulerAngles { A: 1.0, B: 1.7, C: 2.3 };
    let start =
        EulerAnglesState { phi: 0.2, theta: 1.1, psi: -0.4, phi_dot: 0.5, theta_dot: 0.8, psi_dot: -0.9 };
    reconstructs::<_, Euler>(&body, start, ());
    reconstructs::<_, RotationMatrix>(&body, start, ());
    let matrix: RotationMatrix = body.reduced();
    let start = Reduction::<RotationMatrix>::reduce(&body, 0.0, &start);
    reconstructs::<_, Euler>(&matrix, start, ());
}

/// Veselova's system with its attitude: TSO(3).
#[nonholonomic(
    base { R[3][3] }
    on { for i in 0..3 { for j in 0..i { sum(k in 0..3: R[k][i] * R[k][j]) = 0; } sum(k in 0..3: R[k][i]^2) = 1; } }
    basis { w[3] }
    anchor { for i in 0..3 { der(R[i]) = cross(R[i], w); } }
    brackets so(3) { w[0], w[1], w[2] }
    lagrangian  { dot(w, I * w) / 2 - dot(c, R[2]) }
    constraints { veselova: dot(R[2], w) = 0; }
)]
#[derive(Clone, Copy, Debug)]
struct VeselovaOnRotations {
    I: [[f64; 3]; 3],
    c: [f64; 3],
}

/// In Euler angles.
#[nonholonomic(
    base { phi, theta, psi }
    lagrangian {
        let w1 = der(phi) * sin(theta) * sin(psi) + der(theta) * cos(psi);
        let w2 = der(phi) * sin(theta) * cos(psi) - der(theta) * sin(psi);
        let w3 = der(phi) * cos(theta) + der(psi);
        dot([w1, w2, w3], I * [w1, w2, w3]) / 2
            - dot(c, [sin(theta) * sin(psi), sin(theta) * cos(psi), cos(theta)])
    }
    constraints { veselova: der(phi) = -cos(theta) * der(psi); }
)]
#[derive(Clone, Copy, Debug)]
struct VeselovaInAngles {
    I: [[f64; 3]; 3],
    c: [f64; 3],
}

/// On the action algebroid S² × so(3).
#[nonholonomic(
    base { g[3] }
    on { dot(g, g) = 1; }
    basis { w[3] }
    anchor { der(g) = cross(g, w); }
    brackets so(3) { w[0], w[1], w[2] }
    lagrangian  { dot(w, I * w) / 2 - dot(c, g) }
    constraints { veselova: dot(g, w) = 0; }
)]
#[derive(Clone, Copy, Debug)]
struct Veselova {
    I: [[f64; 3]; 3],
    c: [f64; 3],
}

morphism! { VeselovaOnRotations -> Veselova { base { g = R[2]; } } }

morphism! { VeselovaInAngles -> Veselova {
    base { g = [sin(theta) * sin(psi), sin(theta) * cos(psi), cos(theta)]; }
    velocities {
        w[0] = der(phi) * sin(theta) * sin(psi) + der(theta) * cos(psi);
        w[1] = der(phi) * sin(theta) * cos(psi) - der(theta) * sin(psi);
        w[2] = der(phi) * cos(theta) + der(psi);
    }
} }

const INERTIA: [[f64; 3]; 3] = [[1.0, 0.1, -0.2], [0.1, 1.6, 0.3], [-0.2, 0.3, 2.1]];

#[test]
fn veselova() {
    let c = [0.4, -0.3, 0.8];
    let (sin, cos) = 0.5_f64.sin_cos();
    let turned = VeselovaOnRotationsState {
        R: [[cos, 0.0, sin], [0.0, 1.0, 0.0], [-sin, 0.0, cos]],
        w: [cos, 0.7, sin],
    };
    reconstructs::<_, Veselova>(&VeselovaOnRotations { I: INERTIA, c }, turned, ());
    let angles = VeselovaInAngles { I: INERTIA, c };
    let start = VeselovaInAnglesState { phi: 0.1, theta: 0.9, psi: 0.3, theta_dot: 0.6, psi_dot: -0.8 };
    reconstructs::<_, Veselova>(&angles, start, ());
}

/// The Chaplygin sphere with its attitude and place: no slipping, at a height that stays.
#[nonholonomic(
    base { R[3][3], p[3] }
    on { for i in 0..3 { for j in 0..i { sum(k in 0..3: R[k][i] * R[k][j]) = 0; } sum(k in 0..3: R[k][i]^2) = 1; } }
    basis { w[3], dp[3] }
    anchor { for i in 0..3 { der(R[i]) = cross(R[i], w); der(p[i]) = dp[i]; } }
    lagrangian { m / 2 * dot(dp, dp) + dot(w, I * w) / 2 }
    brackets so(3) { w[0], w[1], w[2] }
    constraints {
        dp[0] = r * dot(R[1], w);
        dp[1] = -r * dot(R[0], w);
        dp[2] = 0;
    }
)]
#[derive(Clone, Copy, Debug)]
struct RollingAttitude {
    I: [[f64; 3]; 3],
    m: f64,
    r: f64,
}

/// Reduced by the motions of the plane, on S² × se(3).
#[nonholonomic(
    base { g[3] }
    on { dot(g, g) = 1; }
    basis { w[3], v[3] }
    anchor { der(g) = cross(g, w); }
    brackets se(3) { w[0], w[1], w[2], v[0], v[1], v[2] }
    lagrangian { m / 2 * dot(v, v) + dot(w, I * w) / 2 }
    constraints { for i in 0..3 { v[i] = r * cross(w, g)[i]; } }
)]
#[derive(Clone, Copy, Debug)]
struct ChaplyginSphere {
    I: [[f64; 3]; 3],
    m: f64,
    r: f64,
}

morphism! { RollingAttitude -> ChaplyginSphere {
    base { g = R[2]; }
    velocities { v[i in 0..3] = sum(j in 0..3: R[j][i] * dp[j]); }
} }

#[test]
fn chaplygin_sphere() {
    let (sin, cos) = 0.5_f64.sin_cos();
    let start = RollingAttitudeState {
        R: [[cos, 0.0, sin], [0.0, 1.0, 0.0], [-sin, 0.0, cos]],
        p: [0.5, 0.6, 0.2],
        w: [1.0, 0.7, -0.4],
    };
    reconstructs::<_, ChaplyginSphere>(&RollingAttitude { I: INERTIA, m: 1.2, r: 0.3 }, start, ());
}

/// A ball on a turning table: an affine constraint, with the attitude in Cardan angles.
#[nonholonomic(
    base { x, y, a, b, c }
    velocities {
        wx = der(a) + sin(b) * der(c);
        wy = cos(a) * der(b) - sin(a) * cos(b) * der(c);
        wz = sin(a) * der(b) + cos(a) * cos(b) * der(c);
        sx = der(x) - r * (cos(a) * der(b) - sin(a) * cos(b) * der(c));
        sy = der(y) + r * (der(a) + sin(b) * der(c));
    }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + k2 * (wx^2 + wy^2 + wz^2)) }
    constraints { roll_x: sx = -Omega * y; roll_y: sy = Omega * x; }
)]
#[derive(Clone, Copy, Debug)]
struct BallOnTable {
    m: f32,
    r: f32,
    k2: f32,
    Omega: f32,
}

/// On the Atiyah algebroid; the angular velocity is that seen in space.
#[nonholonomic(
    base  { x, y }
    basis { dx, dy, wx, wy, wz }
    anchor { der(x) = dx; der(y) = dy; }
    brackets { [wx, wy] = -wz; [wy, wz] = -wx; [wz, wx] = -wy; }
    lagrangian { m / 2 * (dx^2 + dy^2 + k2 * (wx^2 + wy^2 + wz^2)) }
    constraints { roll_x: dx = r * wy - Omega * y; roll_y: dy = -r * wx + Omega * x; }
)]
#[derive(Clone, Copy, Debug)]
struct AtiyahBall<T> {
    m: T,
    r: T,
    k2: T,
    Omega: T,
}

morphism! { BallOnTable -> AtiyahBall { velocities { dx = der(x); dy = der(y); } } }

#[test]
fn ball_on_a_turning_table() {
    let ball = BallOnTable { m: 1.0, r: 0.3, k2: 0.036, Omega: 0.8 };
    let start = BallOnTableState { x: 0.4, y: 0.1, a: 0.2, b: -0.3, c: 0.5, wx: 1.0, wy: -0.5, wz: 0.3 };
    let reduced: AtiyahBall<f32> = ball.reduced();
    let image = ball.reduce(0.0, &start);
    // in single precision: the rates are related
    let full = ball.derivative(0.0, &start, &());
    let rates = reduced.derivative(0.0, &image, &());
    for (a, b) in
        [(full.x, rates.x), (full.y, rates.y), (full.wx, rates.wx), (full.wy, rates.wy), (full.wz, rates.wz)]
    {
        assert!((a - b).abs() < 1e-6, "{a} is not {b}");
    }
    let joint = Reconstructed::<_, AtiyahBall<f32>>::new(ball);
    let joined = joint.start(0.0, &start);
    assert_eq!(joint.full_state(0.0, &joined), start);
    let rate = joint.derivative(0.0, &joined, &()).group;
    assert!(
        (rate.a - full.a).abs() < 1e-6 && (rate.b - full.b).abs() < 1e-6 && (rate.c - full.c).abs() < 1e-6
    );
}

/// A nonlinear constraint: the speed is given.
#[nonholonomic(
    base { x, y, z }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) - m * g * z }
    constraints { der(x)^2 + der(y)^2 + der(z)^2 = speed^2; }
)]
#[derive(Clone, Copy, Debug)]
struct ConstantSpeed {
    m: f64,
    g: f64,
    speed: f64,
}

/// By the translations of the plane; the height is that in other units, its velocity follows.
#[nonholonomic(
    base { h }
    basis { u, v, w }
    anchor { der(h) = w; }
    brackets {}
    lagrangian { m / 2 * (u^2 + v^2 + (w / scale)^2) - m * g * h / scale }
    constraints { u^2 + v^2 + (w / scale)^2 = speed^2; }
)]
#[derive(Clone, Copy, Debug)]
struct SpeedByHeight {
    m: f64,
    g: f64,
    speed: f64,
    scale: f64,
}

morphism! { ConstantSpeed -> SpeedByHeight {
    parameters { scale = 1 / 2; }
    base { h = z / 2; }
    velocities { u = der(x); v = der(y); w = der(z) / 2; }
} }

#[test]
fn constant_speed() {
    let start = ConstantSpeedState { x: 0.0, y: 0.0, z: 1.0, x_dot: 0.6, y_dot: 0.0, z_dot: 0.8 };
    reduces::<_, SpeedByHeight>(&ConstantSpeed { m: 1.0, g: 2.0, speed: 1.0 }, start, ());
    reconstructs::<_, SpeedByHeight>(&ConstantSpeed { m: 1.0, g: 2.0, speed: 1.0 }, start, ());
}
