//! A leg that stands on its foot: shank, thigh and trunk in a vertical plane.

use nonholonomic::prelude::*;

use crate::contest::contest;

/// Three links on the ground by their angles to the vertical, with torques in ankle, knee and hip; `c` is where a link's
/// centre of mass is along it.
#[nonholonomic(
    base { q[3] }
    lagrangian {
        let vx[i in 0..3] = sum(j in 0..i: l[j] * cos(q[j]) * der(q[j])) + c[i] * cos(q[i]) * der(q[i]);
        let vy[i in 0..3] = -sum(j in 0..i: l[j] * sin(q[j]) * der(q[j])) - c[i] * sin(q[i]) * der(q[i]);
        let h[i in 0..3] = sum(j in 0..i: l[j] * cos(q[j])) + c[i] * cos(q[i]);
        sum(i in 0..3: m[i] / 2 * (vx[i]^2 + vy[i]^2) + J[i] / 2 * der(q[i])^2 - m[i] * g * h[i])
    }
    inputs { torque[3] }
    forces { q[0]: torque[0] - torque[1]; q[1]: torque[1] - torque[2]; q[2]: torque[2]; }
    emit { jacobian, sparse_jacobian }
)]
#[derive(Clone, Copy, Debug)]
pub struct Leg {
    m: [f64; 3],
    J: [f64; 3],
    l: [f64; 3],
    c: [f64; 3],
    g: f64,
}

contest! {
    Leg as "leg on a foot", 6 states, 3 inputs of LegInput,
    parameters [
        p.m[0], p.m[1], p.m[2], p.J[0], p.J[1], p.J[2], p.l[0], p.l[1], p.l[2], p.c[0], p.c[1], p.c[2], p.g
    ] of p,
    Leg {
        m: [0.6, 1.1, 2.3], J: [0.02, 0.05, 0.2], l: [0.45, 0.5, 0.7], c: [0.2, 0.22, 0.35], g: 9.81,
    },
    hand |s, _t, x, u| {
        let (s1, c1) = x.q[0].sin_cos();
        let (s2, c2) = x.q[1].sin_cos();
        let (s3, c3) = x.q[2].sin_cos();
        let sq = [x.q_dot[0] * x.q_dot[0], x.q_dot[1] * x.q_dot[1], x.q_dot[2] * x.q_dot[2]];
        // what hangs beyond each link, and first moments
        let beyond2 = s.m[2] * s.l[1];
        let k2 = s.m[1].mul_add(s.c[1], beyond2);
        let k3 = s.m[2] * s.c[2];
        let heavy = s.m[1] + s.m[2];
        let k1 = s.m[0].mul_add(s.c[0], heavy * s.l[0]);
        let m11 = (heavy * s.l[0]).mul_add(s.l[0], (s.m[0] * s.c[0]).mul_add(s.c[0], s.J[0]));
        let m22 = beyond2.mul_add(s.l[1], (s.m[1] * s.c[1]).mul_add(s.c[1], s.J[1]));
        let m33 = k3.mul_add(s.c[2], s.J[2]);
        let (l12, l13, l23) = (s.l[0] * k2, s.l[0] * k3, s.l[1] * k3);
        let m12 = l12 * c1.mul_add(c2, s1 * s2);
        let m13 = l13 * c1.mul_add(c3, s1 * s3);
        let m23 = l23 * c2.mul_add(c3, s2 * s3);
        let n12 = l12 * s1.mul_add(c2, -(c1 * s2));
        let n13 = l13 * s1.mul_add(c3, -(c1 * s3));
        let n23 = l23 * s2.mul_add(c3, -(c2 * s3));
        let f1 = (s.g * k1).mul_add(s1, (-n12).mul_add(sq[1], (-n13).mul_add(sq[2], u.torque[0] - u.torque[1])));
        let f2 = (s.g * k2).mul_add(s2, n12.mul_add(sq[0], (-n23).mul_add(sq[2], u.torque[1] - u.torque[2])));
        let f3 = (s.g * k3).mul_add(s3, n13.mul_add(sq[0], n23.mul_add(sq[1], u.torque[2])));
        // from the last, whose inertia is a parameter
        let over3 = 1.0 / m33;
        let (e1, e2) = (m13 * over3, m23 * over3);
        let (a11, a12, a22) = (e1.mul_add(-m13, m11), e1.mul_add(-m23, m12), e2.mul_add(-m23, m22));
        let (b1, b2) = (e1.mul_add(-f3, f1), e2.mul_add(-f3, f2));
        let scale = 1.0 / a11.mul_add(a22, -(a12 * a12));
        let p = a22.mul_add(b1, -(a12 * b2)) * scale;
        let q = a11.mul_add(b2, -(a12 * b1)) * scale;
        LegState { q: x.q_dot, q_dot: [p, q, f3.mul_add(over3, -e1.mul_add(p, e2 * q))] }
    }
}
