//! The roller racer, which is driven by turning its handlebar.

use nonholonomic::prelude::*;

use crate::contest::contest;

/// The roller racer; its mass is at the axle of the seat.
#[nonholonomic(
    base  { x, y, th, phi }
    basis { v, side, omega, swing }
    anchor {
        der(x) = v * cos(th) - side * sin(th);
        der(y) = v * sin(th) + side * cos(th);
        der(th) = omega;
        der(phi) = swing;
    }
    lagrangian { m / 2 * (v^2 + side^2) + I1 / 2 * omega^2 + I2 / 2 * (omega + swing)^2 }
    constraints { side = 0; v * sin(phi) = (d1 * cos(phi) + d2) * omega + d2 * swing; }
    independent { v, omega }
    inputs { torque }
    forces { swing: torque; }
    emit { jacobian, sparse_jacobian }
)]
#[derive(Clone, Copy, Debug)]
pub struct RollerRacer {
    m: f64,
    I1: f64,
    I2: f64,
    d1: f64,
    d2: f64,
}

contest! {
    RollerRacer as "roller racer", 6 states, 1 inputs of RollerRacerInput,
    parameters [p.m, p.I1, p.I2, p.d1, p.d2] of p,
    RollerRacer { m: 1.3, I1: 0.4, I2: 0.07, d1: 0.5, d2: 0.2 },
    hand |s, _t, x, u| {
        let (sin_th, cos_th) = x.th.sin_cos();
        let (sin, cos) = x.phi.sin_cos();
        // the handlebar turns at θ̇ + φ̇ = a v − b ω
        let over = 1.0 / s.d2;
        let (a, b) = (sin * over, s.d1 * cos * over);
        let swing = a.mul_add(x.v, -((b + 1.0) * x.omega));
        let bend = swing * over * cos.mul_add(x.v, s.d1 * sin * x.omega);
        // the force across its wheels, in units of d2: m v̇ = a f, I₁ ω̇ = −torque − b f
        let (a_per_mass, b_per_inertia) = (a / s.m, b / s.I1);
        let free = b_per_inertia.mul_add(u.torque, bend);
        let lag = a.mul_add(a_per_mass, b * b_per_inertia);
        let force = s.I2.mul_add(-free, u.torque) / s.I2.mul_add(lag, 1.0);
        RollerRacerState {
            x: x.v * cos_th,
            y: x.v * sin_th,
            th: x.omega,
            phi: swing,
            v: a_per_mass * force,
            omega: -b_per_inertia.mul_add(force, u.torque / s.I1),
        }
    }
}
