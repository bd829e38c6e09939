//! A ball that rolls, driven by rotors in it.

use nonholonomic::prelude::*;

use crate::contest::contest;

/// A ball as Chaplygin's, with a rotor on each principal axis, which spins at `s` relative to it.
#[nonholonomic(
    base  { g[3] }
    basis { w[3], v[3], s[3] }
    anchor { der(g) = cross(g, w); }
    brackets se(3) { w, v }
    lagrangian { sum(i in 0..3: I[i] * w[i]^2 + J[i] * (w[i] + s[i])^2) / 2 + m / 2 * dot(v, v) }
    constraints { v = r * cross(w, g); }
    inputs { torque[3] }
    forces { for i in 0..3 { s[i]: torque[i]; } }
    emit { jacobian, sparse_jacobian }
)]
#[derive(Clone, Copy, Debug)]
pub struct BallWithRotors {
    I: [f64; 3],
    J: [f64; 3],
    m: f64,
    r: f64,
}

contest! {
    BallWithRotors as "ball with rotors", 9 states, 3 inputs of BallWithRotorsInput,
    parameters [p.I[0], p.I[1], p.I[2], p.J[0], p.J[1], p.J[2], p.m, p.r] of p,
    BallWithRotors { I: [1.1, 1.7, 2.3], J: [0.1, 0.2, 0.15], m: 1.3, r: 0.7 },
    hand |p, _t, x, u| {
        let ([g1, g2, g3], [w1, w2, w3], [s1, s2, s3]) = (x.g, x.w, x.s);
        let ([i1, i2, i3], [j1, j2, j3], [u1, u2, u3]) = (p.I, p.J, u.torque);
        let m1 = i1.mul_add(w1, j1 * (w1 + s1));
        let m2 = i2.mul_add(w2, j2 * (w2 + s2));
        let m3 = i3.mul_add(w3, j3 * (w3 + s3));
        let k1 = m2.mul_add(w3, (-m3).mul_add(w2, -u1));
        let k2 = m3.mul_add(w1, (-m1).mul_add(w3, -u2));
        let k3 = m1.mul_add(w2, (-m2).mul_add(w1, -u3));
        // as Chaplygin's
        let mrr = p.m * p.r * p.r;
        let d = mrr * g1.mul_add(g1, g2.mul_add(g2, g3 * g3));
        let (a1, a2, a3) = (1.0 / (i1 + d), 1.0 / (i2 + d), 1.0 / (i3 + d));
        let (b1, b2, b3) = (g1 * a1, g2 * a2, g3 * a3);
        let sum = b1.mul_add(k1, b2.mul_add(k2, b3 * k3));
        let l = mrr * sum / (-mrr).mul_add(b1.mul_add(g1, b2.mul_add(g2, b3 * g3)), 1.0);
        let (a1, a2, a3) = (a1.mul_add(k1, b1 * l), a2.mul_add(k2, b2 * l), a3.mul_add(k3, b3 * l));
        BallWithRotorsState {
            g: [g2.mul_add(w3, -(g3 * w2)), g3.mul_add(w1, -(g1 * w3)), g1.mul_add(w2, -(g2 * w1))],
            w: [a1, a2, a3],
            s: [u1 / j1 - a1, u2 / j2 - a2, u3 / j3 - a3],
        }
    }
}
