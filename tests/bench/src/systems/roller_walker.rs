//! A walker on two legs that end in passive rollers.

use nonholonomic::prelude::*;

use crate::contest::contest;

/// A body and two legs of angles `a`, hinged `h` ahead of the centre of mass; a leg's roller does not move along it. The
/// legs have inertia and no mass.
#[nonholonomic(
    base { x, y, th, a[2] }
    lagrangian {
        m / 2 * (der(x)^2 + der(y)^2) + J / 2 * der(th)^2 + sum(i in 0..2: Jl[i] / 2 * der(a[i])^2)
    }
    constraints {
        for i in 0..2 {
            cos(a[i]) * (der(x) - h[i] * sin(th) * der(th)) + sin(a[i]) * (der(y) + h[i] * cos(th) * der(th)) = 0;
        }
    }
    inputs { torque[2] }
    forces { th: -torque[0] - torque[1]; for i in 0..2 { a[i]: torque[i]; } }
    emit { jacobian, sparse_jacobian }
)]
#[derive(Clone, Copy, Debug)]
pub struct RollerWalker {
    m: f64,
    J: f64,
    Jl: [f64; 2],
    h: [f64; 2],
}

contest! {
    RollerWalker as "roller walker", 10 states, 2 inputs of RollerWalkerInput,
    parameters [p.m, p.J, p.Jl[0], p.Jl[1], p.h[0], p.h[1]] of p,
    RollerWalker { m: 1.3, J: 0.4, Jl: [0.05, 0.07], h: [0.3, -0.35] },
    hand |s, _t, x, u| {
        let (sin, cos) = x.th.sin_cos();
        let (s1, c1) = x.a[0].sin_cos();
        let (s2, c2) = x.a[1].sin_cos();
        let w = x.th_dot;
        // rows (cᵢ, sᵢ, kᵢ) with kᵢ = hᵢ sin(aᵢ − θ), and what their change leaves
        let k1 = s.h[0] * s1.mul_add(cos, -(c1 * sin));
        let k2 = s.h[1] * s2.mul_add(cos, -(c2 * sin));
        let l1 = s.h[0] * c1.mul_add(cos, s1 * sin);
        let l2 = s.h[1] * c2.mul_add(cos, s2 * sin);
        let across1 = s1.mul_add(x.x_dot, -(c1 * x.y_dot));
        let across2 = s2.mul_add(x.x_dot, -(c2 * x.y_dot));
        let b1 = x.a_dot[0].mul_add(across1, l1 * w * (w - x.a_dot[0]));
        let b2 = x.a_dot[1].mul_add(across2, l2 * w * (w - x.a_dot[1]));
        // multipliers by mass: (1 + ε k₁², cos(a₁ − a₂) + ε k₁ k₂; …) with ε = m / J
        let over = 1.0 / s.J;
        let ratio = s.m * over;
        let free = -(u.torque[0] + u.torque[1]) * over;
        let (e1, e2) = (ratio * k1, ratio * k2);
        let m11 = e1.mul_add(k1, 1.0);
        let m12 = e1.mul_add(k2, c1.mul_add(c2, s1 * s2));
        let m22 = e2.mul_add(k2, 1.0);
        let (f1, f2) = (k1.mul_add(-free, b1), k2.mul_add(-free, b2));
        let scale = 1.0 / m11.mul_add(m22, -(m12 * m12));
        let p1 = m22.mul_add(f1, -(m12 * f2)) * scale;
        let p2 = m11.mul_add(f2, -(m12 * f1)) * scale;
        RollerWalkerState {
            x: x.x_dot,
            y: x.y_dot,
            th: w,
            a: x.a_dot,
            x_dot: c1.mul_add(p1, c2 * p2),
            y_dot: s1.mul_add(p1, s2 * p2),
            th_dot: e1.mul_add(p1, e2.mul_add(p2, free)),
            a_dot: [u.torque[0] / s.Jl[0], u.torque[1] / s.Jl[1]],
        }
    }
}
