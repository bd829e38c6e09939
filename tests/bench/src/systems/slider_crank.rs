//! A slider crank in the angles of crank and rod and the place of the piston.

use nonholonomic::prelude::*;

use crate::contest::{ClosedByHand, contest};

/// Crank, rod and piston; the rod's mass is in its middle.
#[nonholonomic(
    base { a, b, s }
    holonomic { closure: [l1 * cos(a) + l2 * cos(b) - s, l1 * sin(a) + l2 * sin(b)] = 0; }
    lagrangian {
        J1 / 2 * der(a)^2 + J2 / 2 * der(b)^2 + M / 2 * der(s)^2
        + m / 2 * (l1^2 * der(a)^2 + l2^2 / 4 * der(b)^2 + l1 * l2 * cos(a - b) * der(a) * der(b))
    }
    inputs { torque, push }
    forces { a: torque; s: push; }
    emit { jacobian, sparse_jacobian }
)]
#[derive(Clone, Copy, Debug)]
pub struct SliderCrank {
    l1: f64,
    l2: f64,
    J1: f64,
    J2: f64,
    m: f64,
    M: f64,
}

contest! {
    SliderCrank as "slider crank", 6 states, 2 inputs of SliderCrankInput,
    parameters [p.l1, p.l2, p.J1, p.J2, p.m, p.M] of p,
    SliderCrank { l1: 0.3, l2: 0.9, J1: 0.3, J2: 0.8, m: 0.7, M: 1.4 },
    hand |s, _t, x, u| {
        let (sa, ca) = x.a.sin_cos();
        let (sb, cb) = x.b.sin_cos();
        let (aa, bb) = (x.a_dot * x.a_dot, x.b_dot * x.b_dot);
        // b̈ = k ä + g and s̈ = e ä + h from the loop
        let over = 1.0 / (s.l2 * cb);
        let (up, ahead) = (s.l1 * sa, s.l1 * ca);
        let (rod_up, rod_ahead) = (s.l2 * sb, s.l2 * cb);
        let k = -(ahead * over);
        let g = over * up.mul_add(aa, rod_up * bb);
        let e = -rod_up.mul_add(k, up);
        let h = -rod_up.mul_add(g, ahead.mul_add(aa, rod_ahead * bb));
        let half = 0.5 * s.m;
        let w12 = half * ahead.mul_add(rod_ahead, up * rod_up);
        let turn = half * up.mul_add(rod_ahead, -(ahead * rod_up));
        let w22 = (0.5 * half * s.l2).mul_add(s.l2, s.J2);
        let w11 = (s.m * s.l1).mul_add(s.l1, s.J1);
        let row = w22.mul_add(k, w12);
        let me = s.M * e;
        let mass = k.mul_add(row + w12, me.mul_add(e, w11));
        let force = k.mul_add(turn * aa, turn.mul_add(-bb, u.torque))
            + e.mul_add(u.push, -row.mul_add(g, me * h));
        let a = force / mass;
        SliderCrankState {
            a: x.a_dot,
            b: x.b_dot,
            s: x.s_dot,
            a_dot: a,
            b_dot: k.mul_add(a, g),
            s_dot: e.mul_add(a, h),
        }
    }
    closed
}

/// The crank keeps its angle and its velocity, rod and piston follow.
impl ClosedByHand for SliderCrank {
    #[inline]
    fn open(&self, x: &SliderCrankState) -> [f64; 2] {
        let ((sa, ca), (sb, cb)) = (x.a.sin_cos(), x.b.sin_cos());
        [self.l1.mul_add(ca, self.l2.mul_add(cb, -x.s)), self.l1.mul_add(sa, self.l2 * sb)]
    }

    #[inline]
    fn close(&self, x: &mut SliderCrankState) {
        let ((sa, ca), (sb, cb)) = (x.a.sin_cos(), x.b.sin_cos());
        let (rod_up, rod_ahead) = (self.l2 * sb, self.l2 * cb);
        let turn = -self.l1.mul_add(sa, rod_up) / rod_ahead;
        x.b += turn;
        x.s = rod_up.mul_add(-turn, self.l1.mul_add(ca, rod_ahead));
    }

    #[inline]
    fn follow(&self, x: &mut SliderCrankState) {
        let ((sa, ca), (sb, cb)) = (x.a.sin_cos(), x.b.sin_cos());
        let drive = self.l1 * x.a_dot;
        x.b_dot = -(drive * ca) / (self.l2 * cb);
        x.s_dot = -drive.mul_add(sa, self.l2 * sb * x.b_dot);
    }
}
