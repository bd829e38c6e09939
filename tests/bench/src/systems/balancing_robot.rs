//! A robot that balances on two wheels.

use nonholonomic::prelude::*;

use crate::contest::contest;

/// A body on two wheels, between which it may topple.
#[nonholonomic(
    base  { x, y, th, phi, psi[2] }
    basis { v, side, omega, pitch, w[2] }
    anchor {
        der(x) = v * cos(th) - side * sin(th);
        der(y) = v * sin(th) + side * cos(th);
        der(th) = omega;
        der(phi) = pitch;
        for i in 0..2 { der(psi[i]) = w[i]; }
    }
    lagrangian {
        mb / 2 * ((v + l * pitch * cos(phi))^2 + (side + l * omega * sin(phi))^2 + (l * pitch * sin(phi))^2)
            + I2 / 2 * pitch^2 + (I1 * sin(phi)^2 + I3 * cos(phi)^2) / 2 * omega^2
            + mw * (v^2 + side^2) + (mw * b^2 + Iz) * omega^2 + Jw / 2 * (w[0]^2 + w[1]^2)
            - mb * g * l * cos(phi)
    }
    constraints { side = 0; r * w[0] = v + b * omega; r * w[1] = v - b * omega; }
    independent { v, omega, pitch }
    track { x, y, th, phi, v, omega, pitch }
    inputs { right, left }
    forces { w[0]: right; w[1]: left; pitch: -right - left; }
    emit { jacobian, sparse_jacobian }
)]
#[derive(Clone, Copy, Debug)]
pub struct BalancingRobot {
    mb: f64,
    mw: f64,
    l: f64,
    I1: f64,
    I2: f64,
    I3: f64,
    Iz: f64,
    Jw: f64,
    b: f64,
    r: f64,
    g: f64,
}

contest! {
    BalancingRobot as "balancing robot", 7 states, 2 inputs of BalancingRobotInput,
    parameters [p.mb, p.mw, p.l, p.I1, p.I2, p.I3, p.Iz, p.Jw, p.b, p.r, p.g] of p,
    BalancingRobot {
        mb: 2.0, mw: 0.2, l: 0.4, I1: 0.1, I2: 0.12, I3: 0.05, Iz: 0.001, Jw: 0.002, b: 0.3, r: 0.1, g: 9.81,
    },
    hand |s, _t, x, u| {
        let (sin_th, cos_th) = x.th.sin_cos();
        let (sin, cos) = x.phi.sin_cos();
        let over = 1.0 / s.r;
        let ml = s.mb * s.l;
        let mll = ml * s.l;
        let wheel = (s.Jw * over).mul_add(over, s.mw);
        let total = 2.0_f64.mul_add(wheel, s.mb);
        let topple = mll + s.I2;
        let (coupling, overhang) = (ml * cos, ml * sin);
        let (sum, difference) = (u.right + u.left, u.right - u.left);
        let square = x.omega * x.omega;
        let slim = (mll + s.I1 - s.I3) * sin;
        // total v̇ + ml cos φ̈ = f, ml cos v̇ + topple φ̈ = h
        let f = overhang.mul_add(x.pitch.mul_add(x.pitch, square), sum * over);
        let h = (slim * cos).mul_add(square, overhang.mul_add(s.g, -sum));
        let scale = 1.0 / total.mul_add(topple, -(coupling * coupling));
        let yaw = slim.mul_add(sin, 2.0_f64.mul_add((wheel * s.b).mul_add(s.b, s.Iz), s.I3));
        let drag = (2.0 * slim * cos).mul_add(x.pitch, overhang * x.v);
        BalancingRobotState {
            x: x.v * cos_th,
            y: x.v * sin_th,
            th: x.omega,
            phi: x.pitch,
            v: topple.mul_add(f, -(coupling * h)) * scale,
            omega: x.omega.mul_add(-drag, difference * s.b * over) / yaw,
            pitch: total.mul_add(h, -(coupling * f)) * scale,
        }
    }
}
