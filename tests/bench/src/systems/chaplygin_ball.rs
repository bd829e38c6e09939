//! Chaplygin's ball: three moments of inertia, rolling without slipping.

use nonholonomic::prelude::*;

use crate::contest::contest;

/// A ball whose centre of mass is its centre, by the vertical g and its velocities in its own axes.
#[nonholonomic(
    base  { g[3] }
    basis { w[3], v[3] }
    anchor { der(g) = cross(g, w); }
    brackets se(3) { w[0], w[1], w[2], v[0], v[1], v[2] }
    lagrangian { sum(i in 0..3: I[i] * w[i]^2) / 2 + m / 2 * dot(v, v) }
    constraints { v = r * cross(w, g); }
    emit { jacobian, sparse_jacobian }
)]
#[derive(Clone, Copy, Debug)]
pub struct ChaplyginBall {
    I: [f64; 3],
    m: f64,
    r: f64,
}

contest! {
    ChaplyginBall as "Chaplygin ball", 6 states, 0 inputs,
    parameters [p.I[0], p.I[1], p.I[2], p.m, p.r] of p,
    ChaplyginBall { I: [1.1, 1.7, 2.3], m: 1.3, r: 0.7 },
    hand |p, _t, x, _u| {
        // the inertia about the contact is diagonal less m r² g gᵀ, which Sherman and Morrison invert; g has any length
        let ([g1, g2, g3], [w1, w2, w3]) = (x.g, x.w);
        let [i1, i2, i3] = p.I;
        let mrr = p.m * p.r * p.r;
        let d = mrr * g1.mul_add(g1, g2.mul_add(g2, g3 * g3));
        let (a1, a2, a3) = (i1 + d, i2 + d, i3 + d);
        let (b1, b2, b3) = (g1 / a1, g2 / a2, g3 / a3);
        let (k1, k2, k3) = ((i2 - i3) * w2 * w3, (i3 - i1) * w3 * w1, (i1 - i2) * w1 * w2);
        let sum = b1.mul_add(k1, b2.mul_add(k2, b3 * k3));
        let l = sum / (1.0 / mrr - b1.mul_add(g1, b2.mul_add(g2, b3 * g3)));
        ChaplyginBallState {
            g: [g2.mul_add(w3, -(g3 * w2)), g3.mul_add(w1, -(g1 * w3)), g1.mul_add(w2, -(g2 * w1))],
            w: [g1.mul_add(l, k1) / a1, g2.mul_add(l, k2) / a2, g3.mul_add(l, k3) / a3],
        }
    }
}
