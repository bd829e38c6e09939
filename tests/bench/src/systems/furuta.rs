//! A pendulum on an arm that turns: Furuta's.

use nonholonomic::prelude::*;

use crate::contest::contest;

/// An arm of length `L` that a torque turns about the vertical, and a pendulum across its end, whose centre of mass is `l`
/// away from it.
#[nonholonomic(
    base { a, b }
    lagrangian {
        J / 2 * der(a)^2
            + m / 2 * ((L * der(a) + l * cos(b) * der(b))^2 + l^2 * sin(b)^2 * (der(a)^2 + der(b)^2))
            + I / 2 * (der(b)^2 + sin(b)^2 * der(a)^2) - m * g * l * cos(b)
    }
    inputs { torque }
    forces { a: torque; }
    emit { jacobian, sparse_jacobian }
)]
#[derive(Clone, Copy, Debug)]
pub struct Furuta {
    J: f64,
    L: f64,
    m: f64,
    l: f64,
    I: f64,
    g: f64,
}

contest! {
    Furuta as "Furuta's pendulum", 4 states, 1 inputs of FurutaInput,
    parameters [p.J, p.L, p.m, p.l, p.I, p.g] of p,
    Furuta { J: 0.2, L: 0.4, m: 0.3, l: 0.35, I: 0.02, g: 9.81 },
    hand |s, _t, x, u| {
        let (sin, cos) = x.b.sin_cos();
        let ml = s.m * s.l;
        let m22 = ml.mul_add(s.l, s.I);
        let reach = ml * s.L;
        let m12 = reach * cos;
        let m11 = (m22 * sin).mul_add(sin, (s.m * s.L).mul_add(s.L, s.J));
        let turn = m22 * sin * cos * x.a_dot;
        let f1 = (reach * sin * x.b_dot).mul_add(x.b_dot, (2.0 * turn).mul_add(-x.b_dot, u.torque));
        let f2 = turn.mul_add(x.a_dot, ml * s.g * sin);
        let scale = 1.0 / m11.mul_add(m22, -(m12 * m12));
        FurutaState {
            a: x.a_dot,
            b: x.b_dot,
            a_dot: m22.mul_add(f1, -(m12 * f2)) * scale,
            b_dot: m11.mul_add(f2, -(m12 * f1)) * scale,
        }
    }
}
