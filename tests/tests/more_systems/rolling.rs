//! Rolling: the tilting disk, the rattleback, balls on turning surfaces, balls with any inertia.
#![allow(non_snake_case, reason = "parameters are written as in mechanics: J, I, R, Omega")]

use nonholonomic::prelude::*;

use super::{check, check_with_multipliers};

/// A disk that rolls and tilts, in Euler angles and the contact point.
#[nonholonomic(
    base { x, y, phi, theta, psi }
    lagrangian {
        let h = r * sin(theta);
        let hd = r * cos(theta) * der(theta);
        let cx = der(x) - r * (-sin(theta) * der(theta) * sin(phi) + cos(theta) * cos(phi) * der(phi));
        let cy = der(y) + r * (-sin(theta) * der(theta) * cos(phi) - cos(theta) * sin(phi) * der(phi));
        let w1 = der(theta);
        let w2 = der(phi) * sin(theta);
        let w3 = der(psi) + der(phi) * cos(theta);
        m / 2 * (cx^2 + cy^2 + hd^2) + A / 2 * (w1^2 + w2^2) + C / 2 * w3^2 - m * g * h
    }
    constraints { der(x) = -r * cos(phi) * der(psi); der(y) = -r * sin(phi) * der(psi); }
)]
#[derive(Clone, Copy, Debug)]
struct Disk {
    m: f64,
    A: f64,
    C: f64,
    r: f64,
    g: f64,
}

/// The same by angular velocities along the line of nodes, a coframe.
#[nonholonomic(
    base { x, y, phi, theta, psi }
    velocities {
        w1 = der(theta);
        w2 = sin(theta) * der(phi);
        w3 = der(psi) + cos(theta) * der(phi);
        vx = der(x);
        vy = der(y)
    }
    lagrangian {
        let cx = vx - r * (-sin(theta) * w1 * sin(phi) + cos(theta) * cos(phi) * der(phi));
        let cy = vy + r * (-sin(theta) * w1 * cos(phi) - cos(theta) * sin(phi) * der(phi));
        m / 2 * (cx^2 + cy^2 + (r * cos(theta) * w1)^2) + A / 2 * (w1^2 + w2^2) + C / 2 * w3^2
            - m * g * r * sin(theta)
    }
    constraints { vx = -r * cos(phi) * der(psi); vy = -r * sin(phi) * der(psi); }
)]
#[derive(Clone, Copy, Debug)]
struct DiskCoframe {
    m: f64,
    A: f64,
    C: f64,
    r: f64,
    g: f64,
}

/// The same by the sections that span the constraint distribution.
#[nonholonomic(
    base { x, y, phi, theta, psi }
    basis { dx, dy, dphi, dtheta, dpsi }
    anchor { der(x) = dx; der(y) = dy; der(phi) = dphi; der(theta) = dtheta; der(psi) = dpsi }
    frame { roll = dpsi - r*cos(phi)*dx - r*sin(phi)*dy; turn = dphi; tilt = dtheta; ex = dx; ey = dy; }
    lagrangian {
        let cx = der(x) - r * (-sin(theta) * der(theta) * sin(phi) + cos(theta) * cos(phi) * der(phi));
        let cy = der(y) + r * (-sin(theta) * der(theta) * cos(phi) - cos(theta) * sin(phi) * der(phi));
        let w3 = der(psi) + der(phi) * cos(theta);
        m / 2 * (cx^2 + cy^2 + (r * cos(theta) * der(theta))^2)
            + A / 2 * (der(theta)^2 + (der(phi)*sin(theta))^2) + C / 2 * w3^2 - m * g * r * sin(theta)
    }
    distribution { roll, turn, tilt }
)]
#[derive(Clone, Copy, Debug)]
struct DiskFrame {
    m: f64,
    A: f64,
    C: f64,
    r: f64,
    g: f64,
}

/// An ellipsoid on a plane, its axes of inertia turned: reduced to the vertical seen from the body.
#[nonholonomic(
    base { g[3] }
    on { dot(g, g) = 1; }
    basis { w[3], v[3] }
    anchor { for i in 0..3 { der(g[i]) = cross(g, w)[i]; } }
    brackets se(3) { w[0], w[1], w[2], v[0], v[1], v[2] }
    lagrangian { m/2*dot(v,v) + dot(w, I*w)/2 - m*gr*sqrt(a^2*g[0]^2+b^2*g[1]^2+c^2*g[2]^2) }
    constraints {
        let s = sqrt(a^2*g[0]^2+b^2*g[1]^2+c^2*g[2]^2);
        let rho = [-a^2*g[0]/s, -b^2*g[1]/s, -c^2*g[2]/s];
        for i in 0..3 { v[i] = -cross(w, rho)[i]; }
    }
)]
#[derive(Clone, Copy, Debug)]
struct Rattleback {
    m: f64,
    I: [[f64; 3]; 3],
    a: f64,
    b: f64,
    c: f64,
    gr: f64,
}

/// The same with attitude and position.
#[nonholonomic(
    base { R[3][3], X, Y, Z }
    on {
        sum(k in 0..3: R[k][0]^2) = 1;
        sum(k in 0..3: R[k][1]^2) = 1;
        sum(k in 0..3: R[k][2]^2) = 1;
        sum(k in 0..3: R[k][0]*R[k][1]) = 0;
        sum(k in 0..3: R[k][1]*R[k][2]) = 0;
        sum(k in 0..3: R[k][0]*R[k][2]) = 0;
    }
    basis { w[3], v[3] }
    anchor {
        for i in 0..3 { for j in 0..3 { der(R[i][j]) = cross(R[i], w)[j]; } }
        der(X) = sum(k in 0..3: R[0][k]*v[k]);
        der(Y) = sum(k in 0..3: R[1][k]*v[k]);
        der(Z) = sum(k in 0..3: R[2][k]*v[k]);
    }
    brackets se(3) { w[0], w[1], w[2], v[0], v[1], v[2] }
    lagrangian { dot(w, I*w)/2 + m/2*dot(v,v) - m*gr*Z }
    constraints {
        let s = sqrt(a^2*R[2][0]^2+b^2*R[2][1]^2+c^2*R[2][2]^2);
        let rho = [-a^2*R[2][0]/s, -b^2*R[2][1]/s, -c^2*R[2][2]/s];
        for i in 0..3 { v[i] = -cross(w, rho)[i]; }
    }
)]
#[derive(Clone, Copy, Debug)]
struct RattlebackAttitude {
    m: f64,
    I: [[f64; 3]; 3],
    a: f64,
    b: f64,
    c: f64,
    gr: f64,
}

/// A ball on a turning table, with space components of the angular velocity.
#[nonholonomic(
    base { x, y }
    basis { vx, vy, wx, wy, wz }
    anchor { der(x) = vx; der(y) = vy; }
    brackets { [wx, wy] = -wz; [wy, wz] = -wx; [wz, wx] = -wy; }
    lagrangian { m/2*(vx^2+vy^2) + m*k2/2*(wx^2+wy^2+wz^2) }
    constraints { r1: vx - a*wy = -Omega*y; r2: vy + a*wx = Omega*x; }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct Table {
    m: f64,
    k2: f64,
    a: f64,
    Omega: f64,
}

/// The same, its vector of angular velocity eliminated first.
#[nonholonomic(
    base { x, y }
    basis { wx, wy, wz, vx, vy }
    anchor { der(x) = vx; der(y) = vy; }
    brackets so(3) { wz, wy, wx }
    lagrangian { m/2*(vx^2+vy^2) + m*k2/2*(wx^2+wy^2+wz^2) }
    constraints { wx = (Omega*x - vy)/a; wy = (vx + Omega*y)/a; }
)]
#[derive(Clone, Copy, Debug)]
struct Table2 {
    m: f64,
    k2: f64,
    a: f64,
    Omega: f64,
}

/// A ball in a turning cylinder, in a frame that moves around with it.
#[nonholonomic(
    base { phi, z }
    basis { vphi, vz, wr, wt, wz }
    anchor { der(phi) = vphi; der(z) = vz; }
    brackets { [wr, wt] = -wz; [wt, wz] = -wr; [wz, wr] = -wt; [vphi, wr] = wt; [vphi, wt] = -wr; }
    lagrangian { m/2*(rho^2*vphi^2+vz^2) + m*k2/2*(wr^2+wt^2+wz^2) - m*g*z }
    constraints { rho*vphi + a*wz = Omega*(rho+a); vz - a*wt = 0; }
)]
#[derive(Clone, Copy, Debug)]
struct Cylinder {
    m: f64,
    k2: f64,
    a: f64,
    Omega: f64,
    g: f64,
    rho: f64,
}

/// The same with space components.
#[nonholonomic(
    base { phi, z }
    basis { vphi, vz, wx, wy, wz }
    anchor { der(phi) = vphi; der(z) = vz; }
    brackets { [wx, wy] = -wz; [wy, wz] = -wx; [wz, wx] = -wy; }
    lagrangian { m/2*(rho^2*vphi^2+vz^2) + m*k2/2*(wx^2+wy^2+wz^2) - m*g*z }
    constraints { rho*vphi + a*wz = Omega*(rho+a); vz + a*(wx*sin(phi) - wy*cos(phi)) = 0; }
)]
#[derive(Clone, Copy, Debug)]
struct CylinderSpace {
    m: f64,
    k2: f64,
    a: f64,
    Omega: f64,
    g: f64,
    rho: f64,
}

/// A ball in a turning cone.
#[nonholonomic(
    base { x, y }
    basis { vx, vy, wx, wy, wz }
    anchor { der(x) = vx; der(y) = vy; }
    brackets { [wx, wy] = -wz; [wy, wz] = -wx; [wz, wx] = -wy; }
    lagrangian {
        let r = sqrt(x^2+y^2);
        let vz = kappa*(x*vx+y*vy)/r;
        m/2*(vx^2+vy^2+vz^2) + m*k2/2*(wx^2+wy^2+wz^2) - m*g*kappa*r
    }
    constraints {
        let r = sqrt(x^2+y^2);
        let q = a/sqrt(1+kappa^2);
        let n = [q*kappa*x/r, q*kappa*y/r, -q];
        let w = [wx, wy, wz];
        let c = [x + n[0], y + n[1]];
        vx + cross(w, n)[0] = -Omega*c[1];
        vy + cross(w, n)[1] = Omega*c[0];
    }
)]
#[derive(Clone, Copy, Debug)]
struct Cone {
    m: f64,
    k2: f64,
    a: f64,
    Omega: f64,
    g: f64,
    kappa: f64,
}

/// A ball on a surface without symmetry.
#[nonholonomic(
    base { x, y }
    basis { vx, vy, wx, wy, wz }
    anchor { der(x) = vx; der(y) = vy; }
    brackets { [wx, wy] = -wz; [wy, wz] = -wx; [wz, wx] = -wy; }
    lagrangian {
        let fx = x + y^2/5;
        let fy = y + 2*x*y/5;
        m/2*(vx^2+vy^2+(fx*vx+fy*vy)^2) + J/2*(wx^2+wy^2+wz^2) - m*g*((x^2+y^2)/2+x*y^2/5)
    }
    constraints {
        let fx = x + y^2/5;
        let fy = y + 2*x*y/5;
        let s = a/sqrt(1+fx^2+fy^2);
        let n = [s*fx, s*fy, -s];
        let w = [wx, wy, wz];
        let c = cross(w, n);
        vx + c[0] = 0;
        vy + c[1] = 0;
    }
)]
#[derive(Clone, Copy, Debug)]
struct BallSurface {
    m: f64,
    J: f64,
    g: f64,
    a: f64,
}

/// A ball with any inertia in a field.
#[nonholonomic(
    base { R[3][3], X, Y }
    on {
        for i in 0..3 { sum(k in 0..3: R[k][i]^2) = 1 }
        for i in 0..3 { for j in i+1..3 { sum(k in 0..3: R[k][i]*R[k][j]) = 0 } }
    }
    basis { w[3], vX, vY }
    anchor {
        for i in 0..3 { for j in 0..3 { der(R[i][j]) = cross(R[i], w)[j]; } }
        der(X) = vX;
        der(Y) = vY
    }
    brackets so(3) { w[0], w[1], w[2] }
    lagrangian { dot(w, I*w)/2 + m/2*(vX^2+vY^2) - (3*R[2][0]-R[2][1]/2+2*R[2][2]+R[2][0]*R[2][1]^2) }
    constraints { a: vX = r*dot(R[1], w); b: vY = -r*dot(R[0], w) }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct ChaplyginBall {
    I: [[f64; 3]; 3],
    m: f64,
    r: f64,
}

/// The same without spin about the vertical.
#[nonholonomic(
    base { R[3][3], X, Y }
    on {
        for i in 0..3 { sum(k in 0..3: R[k][i]^2) = 1 }
        for i in 0..3 { for j in i+1..3 { sum(k in 0..3: R[k][i]*R[k][j]) = 0 } }
    }
    basis { w[3], vX, vY }
    anchor {
        for i in 0..3 { for j in 0..3 { der(R[i][j]) = cross(R[i], w)[j] } }
        der(X) = vX;
        der(Y) = vY
    }
    brackets so(3) { w[0], w[1], w[2] }
    lagrangian { dot(w, I*w)/2 + m/2*(vX^2+vY^2) - (3*R[2][0]-R[2][1]/2+2*R[2][2]+R[2][0]*R[2][1]^2) }
    constraints { a: vX = r*dot(R[1], w); b: vY = -r*dot(R[0], w); c: dot(R[2], w) = 0 }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct RubberBall {
    I: [[f64; 3]; 3],
    m: f64,
    r: f64,
}

const INERTIA: [[f64; 3]; 3] = [[1.8, 0.1, -0.2], [0.1, 2.0, 0.3], [-0.2, 0.3, 2.5]];
const ELLIPSOID: [[f64; 3]; 3] = [[0.15, 0.1, 0.0], [0.1, 1.1, 0.0], [0.0, 0.0, 1.2]];

#[test]
fn disks_rattlebacks_and_balls() {
    check("disk", &Disk { m: 1.2, A: 0.15, C: 0.29, r: 0.7, g: 9.81 }, ());
    check("disk", &DiskCoframe { m: 1.2, A: 0.15, C: 0.29, r: 0.7, g: 9.81 }, ());
    check("disk", &DiskFrame { m: 1.2, A: 0.15, C: 0.29, r: 0.7, g: 9.81 }, ());
    check("rattleback", &Rattleback { m: 1.1, I: ELLIPSOID, a: 2.0, b: 0.6, c: 0.5, gr: 9.81 }, ());
    check("rattleback", &RattlebackAttitude { m: 1.1, I: ELLIPSOID, a: 2.0, b: 0.6, c: 0.5, gr: 9.81 }, ());
    let system = Table { m: 1.4, k2: 0.05, a: 0.3, Omega: 0.9 };
    check_with_multipliers("ball_table", &system, (), |t, x| system.multipliers(t, x, &()));
    check("ball_table", &Table2 { m: 1.4, k2: 0.05, a: 0.3, Omega: 0.9 }, ());
}

#[test]
fn balls_of_any_inertia() {
    check("ball_cylinder", &Cylinder { m: 1.4, k2: 0.05, a: 0.3, Omega: 0.9, g: 9.81, rho: 1.3 }, ());
    check("ball_cylinder", &CylinderSpace { m: 1.4, k2: 0.05, a: 0.3, Omega: 0.9, g: 9.81, rho: 1.3 }, ());
    check("ball_cone", &Cone { m: 1.4, k2: 0.05, a: 0.3, Omega: 0.9, g: 9.81, kappa: 0.8 }, ());
    check("ball_surface", &BallSurface { m: 1.4, J: 0.05, g: 9.81, a: 0.3 }, ());
    let system = ChaplyginBall { I: INERTIA, m: 1.4, r: 0.6 };
    check_with_multipliers("chaplygin_ball_pot", &system, (), |t, x| system.multipliers(t, x, &()));
    let system = RubberBall { I: INERTIA, m: 1.4, r: 0.6 };
    check_with_multipliers("rubber_ball", &system, (), |t, x| system.multipliers(t, x, &()));
}
