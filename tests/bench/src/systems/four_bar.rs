//! A four-bar linkage in the angles of its links, whose loop is closed by constraints on positions.

use nonholonomic::prelude::*;

use crate::contest::{ClosedByHand, contest};

/// Crank, coupler and rocker; the coupler's mass is in its middle, a torque acts on the crank.
#[nonholonomic(
    base { a, b, c }
    holonomic {
        closure: [
            l1 * cos(a) + l2 * cos(b) - l3 * cos(c) - d,
            l1 * sin(a) + l2 * sin(b) - l3 * sin(c)
        ] = 0;
    }
    lagrangian {
        J1 / 2 * der(a)^2 + J2 / 2 * der(b)^2 + J3 / 2 * der(c)^2
        + m / 2 * (l1^2 * der(a)^2 + l2^2 / 4 * der(b)^2 + l1 * l2 * cos(a - b) * der(a) * der(b))
    }
    inputs { torque }
    forces { a: torque; }
    emit { jacobian, sparse_jacobian }
)]
#[derive(Clone, Copy, Debug)]
pub struct FourBar {
    l1: f64,
    l2: f64,
    l3: f64,
    d: f64,
    J1: f64,
    J2: f64,
    J3: f64,
    m: f64,
}

contest! {
    FourBar as "four-bar linkage", 6 states, 1 inputs of FourBarInput,
    parameters [p.l1, p.l2, p.l3, p.d, p.J1, p.J2, p.J3, p.m] of p,
    FourBar { l1: 1.0, l2: 3.0, l3: 2.5, d: 3.0, J1: 0.3, J2: 0.8, J3: 0.5, m: 0.7 },
    hand |s, _t, x, u| {
        let (sin_ab, cos_ab) = (x.a - x.b).sin_cos();
        let (sin_ac, cos_ac) = (x.a - x.c).sin_cos();
        // c − b is the difference of these
        let sin_cb = sin_ab.mul_add(cos_ac, -(cos_ab * sin_ac));
        let cos_cb = cos_ab.mul_add(cos_ac, sin_ab * sin_ac);
        let (aa, bb, cc) = (x.a_dot * x.a_dot, x.b_dot * x.b_dot, x.c_dot * x.c_dot);
        // b̈ = k₂ ä + g₂, c̈ = k₃ ä + g₃ from the loop
        let over = 1.0 / (s.l2 * s.l3 * sin_cb);
        let (over2, over3) = (s.l3 * over, s.l2 * over);
        let k2 = s.l1 * sin_ac * over2;
        let k3 = s.l1 * sin_ab * over3;
        let (pull, rod) = (s.l1 * aa, s.l2 * bb);
        let arm = s.l3 * cc;
        let g2 = pull.mul_add(cos_ac, rod.mul_add(cos_cb, -arm)) * over2;
        let g3 = pull.mul_add(cos_ab, arm.mul_add(-cos_cb, rod)) * over3;
        let half = 0.5 * s.m * s.l2;
        let coupling = half * s.l1;
        let w12 = coupling * cos_ab;
        let w22 = half.mul_add(0.5 * s.l2, s.J2);
        let turn = coupling * sin_ab;
        let row = w22.mul_add(k2, w12);
        let j3k3 = s.J3 * k3;
        let w11 = (s.m * s.l1).mul_add(s.l1, s.J1);
        let mass = k2.mul_add(row + w12, j3k3.mul_add(k3, w11));
        let force = k2.mul_add(turn * aa, turn.mul_add(-bb, u.torque)) - row.mul_add(g2, j3k3 * g3);
        let a = force / mass;
        FourBarState {
            a: x.a_dot,
            b: x.b_dot,
            c: x.c_dot,
            a_dot: a,
            b_dot: k2.mul_add(a, g2),
            c_dot: k3.mul_add(a, g3),
        }
    }
    closed
}

/// The crank keeps its angle and its velocity, coupler and rocker follow.
impl ClosedByHand for FourBar {
    #[inline]
    fn open(&self, x: &FourBarState) -> [f64; 2] {
        let ((sa, ca), (sb, cb), (sc, cc)) = (x.a.sin_cos(), x.b.sin_cos(), x.c.sin_cos());
        [
            self.l1.mul_add(ca, self.l2.mul_add(cb, self.l3.mul_add(-cc, -self.d))),
            self.l1.mul_add(sa, self.l2.mul_add(sb, -(self.l3 * sc))),
        ]
    }

    #[inline]
    fn close(&self, x: &mut FourBarState) {
        let ((sa, ca), (sb, cb), (sc, cc)) = (x.a.sin_cos(), x.b.sin_cos(), x.c.sin_cos());
        let gx = self.l1.mul_add(ca, self.l2.mul_add(cb, self.l3.mul_add(-cc, -self.d)));
        let gy = self.l1.mul_add(sa, self.l2.mul_add(sb, -(self.l3 * sc)));
        // along the rocker the coupler moves alone, and along the coupler the rocker
        let over = 1.0 / sc.mul_add(cb, -(cc * sb));
        x.b -= gx.mul_add(cc, gy * sc) * over / self.l2;
        x.c -= gx.mul_add(cb, gy * sb) * over / self.l3;
    }

    #[inline]
    fn follow(&self, x: &mut FourBarState) {
        let (sin_ab, cos_ab) = (x.a - x.b).sin_cos();
        let (sin_ac, cos_ac) = (x.a - x.c).sin_cos();
        let sin_cb = sin_ab.mul_add(cos_ac, -(cos_ab * sin_ac));
        let drive = self.l1 * x.a_dot / sin_cb;
        x.b_dot = drive * sin_ac / self.l2;
        x.c_dot = drive * sin_ab / self.l3;
    }
}
