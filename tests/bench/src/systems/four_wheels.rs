//! A satellite with four reaction wheels on a pyramid.

use nonholonomic::prelude::*;

use crate::contest::contest;

/// A satellite with wheels about the axes `(±e₁, ±e₁, e₃)`-like rows of `e`, which spin at `s` relative to it.
#[nonholonomic(
    base  { q[4] }
    basis { w[3], s[4] }
    anchor {
        der(q[0]) = -(q[1] * w[0] + q[2] * w[1] + q[3] * w[2]) / 2;
        der(q[1]) = (q[0] * w[0] + q[2] * w[2] - q[3] * w[1]) / 2;
        der(q[2]) = (q[0] * w[1] + q[3] * w[0] - q[1] * w[2]) / 2;
        der(q[3]) = (q[0] * w[2] + q[1] * w[1] - q[2] * w[0]) / 2;
    }
    brackets so(3) { w }
    lagrangian {
        sum(i in 0..3: I[i] * w[i]^2) / 2
            + sum(k in 0..4: J[k] / 2 * (s[k] + sum(i in 0..3: e[k][i] * w[i]))^2)
    }
    inputs { torque[4] }
    forces { for k in 0..4 { s[k]: torque[k]; } }
    emit { jacobian, sparse_jacobian }
)]
#[derive(Clone, Copy, Debug)]
pub struct FourWheels {
    I: [f64; 3],
    J: [f64; 4],
    e: [[f64; 3]; 4],
}

contest! {
    FourWheels as "satellite, 4 wheels", 11 states, 4 inputs of FourWheelsInput,
    parameters [
        p.I[0], p.I[1], p.I[2], p.J[0], p.J[1], p.J[2], p.J[3],
        p.e[0][0], p.e[0][1], p.e[0][2], p.e[1][0], p.e[1][1], p.e[1][2],
        p.e[2][0], p.e[2][1], p.e[2][2], p.e[3][0], p.e[3][1], p.e[3][2]
    ] of p,
    FourWheels {
        I: [1.1, 1.7, 2.3],
        J: [0.1, 0.2, 0.15, 0.12],
        e: [[0.8, 0.0, 0.6], [0.0, 0.8, 0.6], [-0.8, 0.0, 0.6], [0.0, -0.8, 0.6]],
    },
    hand |p, _t, x, u| {
        let ([q0, q1, q2, q3], [w1, w2, w3]) = (x.q, x.w);
        let along = |e: [f64; 3], [a, b, c]: [f64; 3]| e[0].mul_add(a, e[1].mul_add(b, e[2] * c));
        // the wheels' momenta
        let h1 = p.J[0] * (x.s[0] + along(p.e[0], x.w));
        let h2 = p.J[1] * (x.s[1] + along(p.e[1], x.w));
        let h3 = p.J[2] * (x.s[2] + along(p.e[2], x.w));
        let h4 = p.J[3] * (x.s[3] + along(p.e[3], x.w));
        let sum = |i: usize, [a, b, c, d]: [f64; 4], start: f64| {
            p.e[0][i].mul_add(a, p.e[1][i].mul_add(b, p.e[2][i].mul_add(c, p.e[3][i].mul_add(d, start))))
        };
        let h = [h1, h2, h3, h4];
        let m1 = sum(0, h, p.I[0] * w1);
        let m2 = sum(1, h, p.I[1] * w2);
        let m3 = sum(2, h, p.I[2] * w3);
        let back = [-u.torque[0], -u.torque[1], -u.torque[2], -u.torque[3]];
        let a = [
            sum(0, back, m2.mul_add(w3, -(m3 * w2))) / p.I[0],
            sum(1, back, m3.mul_add(w1, -(m1 * w3))) / p.I[1],
            sum(2, back, m1.mul_add(w2, -(m2 * w1))) / p.I[2],
        ];
        let (f1, f2, f3) = (0.5 * w1, 0.5 * w2, 0.5 * w3);
        FourWheelsState {
            q: [
                (-q1).mul_add(f1, (-q2).mul_add(f2, -(q3 * f3))),
                q0.mul_add(f1, q2.mul_add(f3, -(q3 * f2))),
                q0.mul_add(f2, q3.mul_add(f1, -(q1 * f3))),
                q0.mul_add(f3, q1.mul_add(f2, -(q2 * f1))),
            ],
            w: a,
            s: core::array::from_fn(|k| u.torque[k] / p.J[k] - along(p.e[k], a)),
        }
    }
}
