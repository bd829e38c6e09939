//! A heavy top about a fixed point.

use nonholonomic::prelude::*;

use crate::contest::contest;

/// A top whose centre of mass is anywhere; `g` is the vertical seen from it.
#[nonholonomic(
    base  { g[3] }
    basis { w[3] }
    anchor { der(g) = cross(g, w); }
    brackets so(3) { w }
    lagrangian { sum(i in 0..3: I[i] * w[i]^2) / 2 - m * gravity * dot(c, g) }
    emit { jacobian, sparse_jacobian }
)]
#[derive(Clone, Copy, Debug)]
pub struct HeavyTop {
    I: [f64; 3],
    c: [f64; 3],
    m: f64,
    gravity: f64,
}

contest! {
    HeavyTop as "heavy top", 6 states, 0 inputs,
    parameters [p.I[0], p.I[1], p.I[2], p.c[0], p.c[1], p.c[2], p.m, p.gravity] of p,
    HeavyTop { I: [1.1, 1.7, 2.3], c: [0.1, 0.2, 0.4], m: 0.8, gravity: 9.81 },
    hand |s, _t, x, _u| {
        let ([g1, g2, g3], [w1, w2, w3], [i1, i2, i3]) = (x.g, x.w, s.I);
        let weight = s.m * s.gravity;
        let (c1, c2, c3) = (weight * s.c[0], weight * s.c[1], weight * s.c[2]);
        HeavyTopState {
            g: [g2.mul_add(w3, -(g3 * w2)), g3.mul_add(w1, -(g1 * w3)), g1.mul_add(w2, -(g2 * w1))],
            w: [
                ((i2 - i3) * w2).mul_add(w3, g2.mul_add(c3, -(g3 * c2))) / i1,
                ((i3 - i1) * w3).mul_add(w1, g3.mul_add(c1, -(g1 * c3))) / i2,
                ((i1 - i2) * w1).mul_add(w2, g1.mul_add(c2, -(g2 * c1))) / i3,
            ],
        }
    }
}
