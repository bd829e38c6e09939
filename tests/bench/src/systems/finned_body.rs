//! A body in a fluid, with fins.

use nonholonomic::prelude::*;

use crate::contest::contest;

/// A body by its attitude, with the inertias `I` and masses `M` that it has in the fluid, a thrust along its first axis and
/// torques; fins `d` behind its centre do not move across this axis.
#[nonholonomic(
    base  { q[4] }
    basis { w[3], v[3] }
    anchor {
        der(q[0]) = -(q[1] * w[0] + q[2] * w[1] + q[3] * w[2]) / 2;
        der(q[1]) = (q[0] * w[0] + q[2] * w[2] - q[3] * w[1]) / 2;
        der(q[2]) = (q[0] * w[1] + q[3] * w[0] - q[1] * w[2]) / 2;
        der(q[3]) = (q[0] * w[2] + q[1] * w[1] - q[2] * w[0]) / 2;
    }
    brackets se(3) { w, v }
    lagrangian { sum(i in 0..3: I[i] * w[i]^2 + M[i] * v[i]^2) / 2 }
    constraints { v[1] = d * w[2]; v[2] = -d * w[1]; }
    independent { w[0], w[1], w[2], v[0] }
    inputs { thrust, torque[3] }
    forces { v[0]: thrust; for i in 0..3 { w[i]: torque[i]; } }
    emit { jacobian, sparse_jacobian }
)]
#[derive(Clone, Copy, Debug)]
pub struct FinnedBody {
    I: [f64; 3],
    M: [f64; 3],
    d: f64,
}

contest! {
    FinnedBody as "body with fins", 8 states, 4 inputs of FinnedBodyInput,
    parameters [p.I[0], p.I[1], p.I[2], p.M[0], p.M[1], p.M[2], p.d] of p,
    FinnedBody { I: [0.4, 1.7, 2.3], M: [1.3, 2.1, 1.9], d: 0.6 },
    hand |s, _t, x, u| {
        let ([q0, q1, q2, q3], [w1, w2, w3]) = (x.q, x.w);
        let ([i1, i2, i3], [m1, m2, m3]) = (s.I, s.M);
        // fins add their masses to the inertias about them: v₂ = d ω₃ and v₃ = −d ω₂ never show up
        let (p2, p3) = (m2 * s.d, m3 * s.d);
        let (k2, k3) = (p3.mul_add(s.d, i2), p2.mul_add(s.d, i3));
        let f1 = (p2 * w3).mul_add(w3, (p3 * w2).mul_add(w2, u.thrust));
        let t1 = ((k2 - k3) * w2).mul_add(w3, u.torque[0]);
        let t2 = ((k3 - i1) * w3).mul_add(w1, (p3 * x.v_0).mul_add(-w2, u.torque[1]));
        let t3 = ((i1 - k2) * w1).mul_add(w2, (p2 * x.v_0).mul_add(-w3, u.torque[2]));
        let (h1, h2, h3) = (0.5 * w1, 0.5 * w2, 0.5 * w3);
        FinnedBodyState {
            q: [
                (-q1).mul_add(h1, (-q2).mul_add(h2, -(q3 * h3))),
                q0.mul_add(h1, q2.mul_add(h3, -(q3 * h2))),
                q0.mul_add(h2, q3.mul_add(h1, -(q1 * h3))),
                q0.mul_add(h3, q1.mul_add(h2, -(q2 * h1))),
            ],
            w: [t1 / i1, t2 / k2, t3 / k3],
            v_0: f1 / m1,
        }
    }
}
