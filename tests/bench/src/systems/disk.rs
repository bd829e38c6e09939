//! A disk that rolls on a table and leans: Euler's disk.

use nonholonomic::prelude::*;

use crate::contest::contest;

/// A disk in the place of its centre, heading, inclination of its plane against the table, and spin.
#[nonholonomic(
    base { x, y, psi, al, phi }
    lagrangian {
        let w2 = sin(al) * der(psi);
        let w3 = cos(al) * der(psi) + der(phi);
        m / 2 * (der(x)^2 + der(y)^2 + r^2 * cos(al)^2 * der(al)^2)
            + I / 2 * (der(al)^2 + w2^2) + J / 2 * w3^2 - m * g * r * sin(al)
    }
    constraints {
        let w3 = cos(al) * der(psi) + der(phi);
        der(x) = r * (sin(al) * sin(psi) * der(al) - cos(psi) * w3);
        der(y) = -r * (sin(al) * cos(psi) * der(al) + sin(psi) * w3);
    }
    independent { der(psi), der(al), der(phi) }
    emit { jacobian, sparse_jacobian }
)]
#[derive(Clone, Copy, Debug)]
pub struct Disk {
    m: f64,
    r: f64,
    I: f64,
    J: f64,
    g: f64,
}

contest! {
    Disk as "leaning disk", 8 states, 0 inputs,
    parameters [p.m, p.r, p.I, p.J, p.g] of p,
    Disk { m: 1.3, r: 0.5, I: 0.09, J: 0.17, g: 9.81 },
    hand |s, _t, x, _u| {
        let (sin_psi, cos_psi) = x.psi.sin_cos();
        let (sin, cos) = x.al.sin_cos();
        // in axes that follow the disk but do not spin
        let w1 = x.al_dot;
        let w2 = sin * x.psi_dot;
        let turn = cos * x.psi_dot;
        let w3 = turn + x.phi_dot;
        let mr = s.m * s.r;
        let mrr = mr * s.r;
        let tip = s.I * turn - (s.J + mrr) * w3;
        let w1_dot = w2.mul_add(tip, -(mr * s.g * cos)) / (s.I + mrr);
        let w3_dot = mrr * w1 * w2 / (s.J + mrr);
        // I ω̇₂ = ω₁ (J ω₃ − I ψ̇ cos α), ω₂ = ψ̇ sin α
        let psi_dot = w1 * (s.J / s.I).mul_add(w3, -(2.0 * turn)) / sin;
        let (along, down) = (s.r * w3, s.r * sin * w1);
        DiskState {
            x: down.mul_add(sin_psi, -(along * cos_psi)),
            y: -down.mul_add(cos_psi, along * sin_psi),
            psi: x.psi_dot,
            al: w1,
            phi: x.phi_dot,
            psi_dot,
            al_dot: w1_dot,
            phi_dot: w1.mul_add(w2, cos.mul_add(-psi_dot, w3_dot)),
        }
    }
}
