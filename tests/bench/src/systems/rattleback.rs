//! Stones that roll on a table without slipping.

use nonholonomic::prelude::*;

use crate::contest::contest;

/// A rattleback, half an ellipsoid with half axes `a`: `g` is the vertical seen from the stone, and its centre of mass lies
/// `h` below the ellipsoid's centre, with a deviation moment `D`.
#[nonholonomic(
    base  { g[3] }
    basis { w[3], v[3] }
    anchor { der(g) = cross(g, w); }
    brackets se(3) { w, v }
    lagrangian {
        let s = sqrt(sum(i in 0..3: a[i]^2 * g[i]^2));
        m / 2 * dot(v, v) + sum(i in 0..3: I[i] * w[i]^2) / 2 + D * w[0] * w[1] - m * gravity * (s - h * g[2])
    }
    constraints {
        let s = sqrt(sum(i in 0..3: a[i]^2 * g[i]^2));
        let r = [-a[0]^2 * g[0] / s, -a[1]^2 * g[1] / s, h - a[2]^2 * g[2] / s];
        v = cross(r, w);
    }
    emit { jacobian, sparse_jacobian }
)]
#[derive(Clone, Copy, Debug)]
pub struct Rattleback {
    m: f64,
    I: [f64; 3],
    D: f64,
    a: [f64; 3],
    h: f64,
    gravity: f64,
}

contest! {
    Rattleback as "rattleback", 6 states, 0 inputs,
    parameters [p.m, p.I[0], p.I[1], p.I[2], p.D, p.a[0], p.a[1], p.a[2], p.h, p.gravity] of p,
    Rattleback { m: 1.3, I: [0.4, 1.6, 1.7], D: -0.1, a: [1.2, 0.7, 0.5], h: 0.1, gravity: 9.81 },
    hand |s, _t, x, _u| {
        let ([g1, g2, g3], w) = (x.g, x.w);
        // the contact from the centre of mass, and how it moves in the stone
        let (a1, a2, a3) = (s.a[0] * s.a[0], s.a[1] * s.a[1], s.a[2] * s.a[2]);
        let (q1, q2, q3) = (a1 * g1, a2 * g2, a3 * g3);
        let over = 1.0 / q1.mul_add(g1, q2.mul_add(g2, q3 * g3)).sqrt();
        let (p1, p2, p3) = (q1 * over, q2 * over, q3 * over);
        let d = cross(x.g, w);
        let slide = p1.mul_add(d[0], p2.mul_add(d[1], p3 * d[2]));
        let moved = [
            over * p1.mul_add(slide, -(a1 * d[0])),
            over * p2.mul_add(slide, -(a2 * d[1])),
            over * p3.mul_add(slide, -(a3 * d[2])),
        ];
        let w_dot = rolled(s.m, s.I, s.D, s.gravity, ([-p1, -p2, s.h - p3], moved), (x.g, w));
        RattlebackState { g: d, w: w_dot }
    }
}

/// A stone whose bottom is a paraboloid of curvature radii `R`, its apex `h` below the centre of mass: the vertical seen
/// from it is along `(u, 1)`.
#[nonholonomic(
    base  { u[2] }
    basis { w[3], v[3] }
    anchor {
        der(u[0]) = cross([u[0], u[1], 1], w)[0] - u[0] * cross([u[0], u[1], 1], w)[2];
        der(u[1]) = cross([u[0], u[1], 1], w)[1] - u[1] * cross([u[0], u[1], 1], w)[2];
    }
    brackets se(3) { w, v }
    lagrangian {
        let r = [-R[0] * u[0], -R[1] * u[1], (R[0] * u[0]^2 + R[1] * u[1]^2) / 2 - h];
        m / 2 * dot(v, v) + sum(i in 0..3: I[i] * w[i]^2) / 2 + D * w[0] * w[1]
            + m * gravity * dot(r, [u[0], u[1], 1]) / sqrt(1 + dot(u, u))
    }
    constraints { v = cross([-R[0] * u[0], -R[1] * u[1], (R[0] * u[0]^2 + R[1] * u[1]^2) / 2 - h], w); }
    emit { jacobian, sparse_jacobian }
)]
#[derive(Clone, Copy, Debug)]
pub struct Stone {
    m: f64,
    I: [f64; 3],
    D: f64,
    R: [f64; 2],
    h: f64,
    gravity: f64,
}

contest! {
    Stone as "stone on a paraboloid", 5 states, 0 inputs,
    parameters [p.m, p.I[0], p.I[1], p.I[2], p.D, p.R[0], p.R[1], p.h, p.gravity] of p,
    Stone { m: 1.3, I: [0.4, 1.6, 1.7], D: -0.1, R: [1.2, 0.7], h: 0.4, gravity: 9.81 },
    hand |s, _t, x, _u| {
        let ([u1, u2], [w1, w2, w3]) = (x.u, x.w);
        let down = u1.mul_add(w2, -(u2 * w1));
        let d1 = u1.mul_add(-down, u2.mul_add(w3, -w2));
        let d2 = u2.mul_add(-down, u1.mul_add(-w3, w1));
        let (r1, r2) = (s.R[0] * u1, s.R[1] * u2);
        let contact = [-r1, -r2, 0.5_f64.mul_add(r1.mul_add(u1, r2 * u2), -s.h)];
        let moved = [-s.R[0] * d1, -s.R[1] * d2, r1.mul_add(d1, r2 * d2)];
        let over = 1.0 / u1.mul_add(u1, u2.mul_add(u2, 1.0)).sqrt();
        let g = [u1 * over, u2 * over, over];
        StoneState { u: [d1, d2], w: rolled(s.m, s.I, s.D, s.gravity, (contact, moved), (g, x.w)) }
    }
}

#[inline(always)]
fn cross([a1, a2, a3]: [f64; 3], [b1, b2, b3]: [f64; 3]) -> [f64; 3] {
    [a2.mul_add(b3, -(a3 * b2)), a3.mul_add(b1, -(a1 * b3)), a1.mul_add(b2, -(a2 * b1))]
}

/// The angular acceleration of a stone that rolls on a point `r` which moves in it: the balance of moments about it,
/// `(I + m (r·r − r rᵀ)) ω̇ = Iω × ω + m r × (gravity g + ω × (r × ω − ṙ))`.
#[inline(always)]
fn rolled(
    m: f64,
    [i1, i2, i3]: [f64; 3],
    d: f64,
    gravity: f64,
    (r, moved): ([f64; 3], [f64; 3]),
    (g, w): ([f64; 3], [f64; 3]),
) -> [f64; 3] {
    let [w1, w2, w3] = w;
    let v = cross(r, w);
    let f = cross(w, [v[0] - moved[0], v[1] - moved[1], v[2] - moved[2]]);
    let f = [gravity.mul_add(g[0], f[0]), gravity.mul_add(g[1], f[1]), gravity.mul_add(g[2], f[2])];
    let k = cross([i1.mul_add(w1, d * w2), i2.mul_add(w2, d * w1), i3 * w3], w);
    let (n1, n2, n3) = (m * r[0], m * r[1], m * r[2]);
    let t = cross([n1, n2, n3], f);
    let (f1, f2, f3) = (k[0] + t[0], k[1] + t[1], k[2] + t[2]);
    // the matrix and its cofactors
    let (x, y, z) = (n1 * r[0], n2 * r[1], n3 * r[2]);
    let (m11, m22, m33) = (i1 + y + z, i2 + z + x, i3 + x + y);
    let (m12, m13, m23) = (n1.mul_add(-r[1], d), -n1 * r[2], -n2 * r[2]);
    let c11 = m22.mul_add(m33, -(m23 * m23));
    let c12 = m13.mul_add(m23, -(m12 * m33));
    let c13 = m12.mul_add(m23, -(m13 * m22));
    let c22 = m11.mul_add(m33, -(m13 * m13));
    let c23 = m12.mul_add(m13, -(m11 * m23));
    let c33 = m11.mul_add(m22, -(m12 * m12));
    let over = 1.0 / m11.mul_add(c11, m12.mul_add(c12, m13 * c13));
    [
        over * c11.mul_add(f1, c12.mul_add(f2, c13 * f3)),
        over * c12.mul_add(f1, c22.mul_add(f2, c23 * f3)),
        over * c13.mul_add(f1, c23.mul_add(f2, c33 * f3)),
    ]
}
