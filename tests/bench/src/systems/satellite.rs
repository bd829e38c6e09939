//! A satellite with three reaction wheels, its attitude by a quaternion.

use nonholonomic::prelude::*;

use crate::contest::contest;

/// A satellite with a wheel on each principal axis, which spins at s relative to it.
#[nonholonomic(
    base  { q[4] }
    basis { w[3], s[3] }
    anchor {
        der(q[0]) = -(q[1] * w[0] + q[2] * w[1] + q[3] * w[2]) / 2;
        der(q[1]) = (q[0] * w[0] + q[2] * w[2] - q[3] * w[1]) / 2;
        der(q[2]) = (q[0] * w[1] + q[3] * w[0] - q[1] * w[2]) / 2;
        der(q[3]) = (q[0] * w[2] + q[1] * w[1] - q[2] * w[0]) / 2;
    }
    brackets so(3) { w[0], w[1], w[2] }
    lagrangian { sum(i in 0..3: I[i] * w[i]^2 + J[i] * (w[i] + s[i])^2) / 2 }
    inputs { torque[3] }
    forces { for i in 0..3 { s[i]: torque[i]; } }
    emit { jacobian, sparse_jacobian }
)]
#[derive(Clone, Copy, Debug)]
pub struct Satellite {
    I: [f64; 3],
    J: [f64; 3],
}

contest! {
    Satellite as "satellite", 10 states, 3 inputs of SatelliteInput,
    parameters [p.I[0], p.I[1], p.I[2], p.J[0], p.J[1], p.J[2]] of p,
    Satellite { I: [1.1, 1.7, 2.3], J: [0.1, 0.2, 0.15] },
    hand |p, _t, x, u| {
        let ([q0, q1, q2, q3], [w1, w2, w3], [s1, s2, s3]) = (x.q, x.w, x.s);
        let ([i1, i2, i3], [j1, j2, j3], [u1, u2, u3]) = (p.I, p.J, u.torque);
        // the angular momentum of all, and its rate M × ω less what goes into the wheels
        let m1 = i1.mul_add(w1, j1 * (w1 + s1));
        let m2 = i2.mul_add(w2, j2 * (w2 + s2));
        let m3 = i3.mul_add(w3, j3 * (w3 + s3));
        let a1 = m2.mul_add(w3, (-m3).mul_add(w2, -u1)) / i1;
        let a2 = m3.mul_add(w1, (-m1).mul_add(w3, -u2)) / i2;
        let a3 = m1.mul_add(w2, (-m2).mul_add(w1, -u3)) / i3;
        let (h1, h2, h3) = (0.5 * w1, 0.5 * w2, 0.5 * w3);
        SatelliteState {
            q: [
                (-q1).mul_add(h1, (-q2).mul_add(h2, -(q3 * h3))),
                q0.mul_add(h1, q2.mul_add(h3, -(q3 * h2))),
                q0.mul_add(h2, q3.mul_add(h1, -(q1 * h3))),
                q0.mul_add(h3, q1.mul_add(h2, -(q2 * h1))),
            ],
            w: [a1, a2, a3],
            s: [u1 / j1 - a1, u2 / j2 - a2, u3 / j3 - a3],
        }
    }
}
