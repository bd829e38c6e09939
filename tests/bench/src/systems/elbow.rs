//! An arm in space: a turning base, a shoulder and an elbow.

use nonholonomic::prelude::*;

use crate::contest::contest;

/// An arm whose base turns about the vertical, with slender links by their angles to the horizontal at shoulder and, relative
/// to the upper arm, at the elbow; `c` is where a link's centre of mass is along it.
#[nonholonomic(
    base { q[3] }
    lagrangian {
        let low = q[1] + q[2];
        let w = der(q[1]) + der(q[2]);
        let out = l * cos(q[1]) + c[1] * cos(low);
        let vx = -l * sin(q[1]) * der(q[1]) - c[1] * sin(low) * w;
        let vy = l * cos(q[1]) * der(q[1]) + c[1] * cos(low) * w;
        J / 2 * der(q[0])^2
            + (m[0] * c[0]^2 + I[0]) / 2 * (der(q[1])^2 + cos(q[1])^2 * der(q[0])^2)
            + m[1] / 2 * (vx^2 + vy^2 + out^2 * der(q[0])^2) + I[1] / 2 * (w^2 + cos(low)^2 * der(q[0])^2)
            - m[0] * g * c[0] * sin(q[1]) - m[1] * g * (l * sin(q[1]) + c[1] * sin(low))
    }
    inputs { torque[3] }
    forces { for i in 0..3 { q[i]: torque[i]; } }
    emit { jacobian, sparse_jacobian }
)]
#[derive(Clone, Copy, Debug)]
pub struct Elbow {
    J: f64,
    m: [f64; 2],
    I: [f64; 2],
    c: [f64; 2],
    l: f64,
    g: f64,
}

contest! {
    Elbow as "arm in space, 3 joints", 6 states, 3 inputs of ElbowInput,
    parameters [p.J, p.m[0], p.m[1], p.I[0], p.I[1], p.c[0], p.c[1], p.l, p.g] of p,
    Elbow { J: 0.3, m: [1.2, 0.8], I: [0.03, 0.02], c: [0.2, 0.18], l: 0.43, g: 9.81 },
    hand |s, _t, x, u| {
        let (s1, c1) = x.q[1].sin_cos();
        let (se, ce) = x.q[2].sin_cos();
        let (s2, c2) = (s1.mul_add(ce, c1 * se), c1.mul_add(ce, -(s1 * se)));
        let [yaw, first, bend] = x.q_dot;
        let second = first + bend;
        // by angles to the horizontal: inertias k₁, k₂ of the links about their joints, coupling k
        let mc = s.m[1] * s.c[1];
        let ml = s.m[1] * s.l;
        let k1 = ml.mul_add(s.l, (s.m[0] * s.c[0]).mul_add(s.c[0], s.I[0]));
        let k2 = mc.mul_add(s.c[1], s.I[1]);
        let k = mc * s.l;
        // yaw: (J + k₁ c₁² + 2 k c₁ c₂ + k₂ c₂²) ω
        let (p1, p2) = (k1.mul_add(c1, k * c2), k2.mul_add(c2, k * c1));
        let inertia = c1.mul_add(p1, c2.mul_add(p2, s.J));
        let (t1, t2) = (s1 * p1, s2 * p2);
        let yaw_dot = (2.0 * yaw).mul_add(t1.mul_add(first, t2 * second), u.torque[0]) / inertia;
        // links in their plane
        let yaws = yaw * yaw;
        let (m12, turn) = (k * ce, k * se);
        let weight = s.m[0].mul_add(s.c[0], ml);
        let f1 = (turn * second).mul_add(second, (s.g * -weight).mul_add(c1, t1.mul_add(-yaws, u.torque[1] - u.torque[2])));
        let f2 = (turn * first).mul_add(-first, (s.g * -mc).mul_add(c2, t2.mul_add(-yaws, u.torque[2])));
        let scale = 1.0 / k1.mul_add(k2, -(m12 * m12));
        let a = k2.mul_add(f1, -(m12 * f2)) * scale;
        let b = k1.mul_add(f2, -(m12 * f1)) * scale;
        ElbowState { q: x.q_dot, q_dot: [yaw_dot, a, b - a] }
    }
}
