//! The Chaplygin sleigh with a torque and rotary friction.

use crate::contest::contest;

nh_models::sleigh! {
    /// The Chaplygin sleigh.
    #[derive(Clone, Copy, Debug)]
    pub struct Sleigh { m: f64, J: f64, a: f64, b: f64, c: f64 }
    emit { jacobian, sparse_jacobian }
}

contest! {
    Sleigh as "sleigh", 5 states, 1 inputs of SleighInput,
    parameters [p.m, p.J, p.a, p.b, p.c] of p,
    Sleigh { m: 1.3, J: 0.7, a: 0.4, b: 0.15, c: 0.2 },
    hand |s, _t, x, u| {
        let (sin, cos) = x.theta.sin_cos();
        let ma = s.m * s.a;
        let couple = ma.mul_add(s.b.mul_add(-x.omega, x.v1), s.c);
        let omega_dot = x.omega.mul_add(-couple, u.torque) / ma.mul_add(s.a, s.J);
        SleighState {
            theta: x.omega,
            x: x.v1 * cos,
            y: x.v1 * sin,
            omega: omega_dot,
            v1: s.b.mul_add(omega_dot, s.a * x.omega * x.omega),
        }
    }
}
