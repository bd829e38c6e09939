//! A five-bar linkage: two driven cranks, and a load where their couplers meet.

use nonholonomic::prelude::*;

use crate::contest::{ClosedByHand, contest};

/// Cranks `a`, `d` and couplers `b`, `c` by their angles, and a load at the joint of the couplers.
#[nonholonomic(
    base { a, b, c, d }
    holonomic {
        closure: [
            l1 * cos(a) + l2 * cos(b) - l3 * cos(c) - l4 * cos(d) - base,
            l1 * sin(a) + l2 * sin(b) - l3 * sin(c) - l4 * sin(d)
        ] = 0;
    }
    lagrangian {
        J1 / 2 * der(a)^2 + J2 / 2 * der(b)^2 + J3 / 2 * der(c)^2 + J4 / 2 * der(d)^2
        + m / 2 * (l1^2 * der(a)^2 + l2^2 * der(b)^2 + 2 * l1 * l2 * cos(a - b) * der(a) * der(b))
    }
    inputs { left, right }
    forces { a: left; d: right; }
    emit { jacobian, sparse_jacobian }
)]
#[derive(Clone, Copy, Debug)]
pub struct FiveBar {
    l1: f64,
    l2: f64,
    l3: f64,
    l4: f64,
    base: f64,
    J1: f64,
    J2: f64,
    J3: f64,
    J4: f64,
    m: f64,
}

contest! {
    FiveBar as "five-bar linkage", 8 states, 2 inputs of FiveBarInput,
    parameters [p.l1, p.l2, p.l3, p.l4, p.base, p.J1, p.J2, p.J3, p.J4, p.m] of p,
    FiveBar {
        l1: 1.0, l2: 2.0, l3: 2.2, l4: 1.1, base: 1.5, J1: 0.3, J2: 0.4, J3: 0.5, J4: 0.25, m: 0.7,
    },
    hand |s, _t, x, u| {
        let (sa, ca) = (x.a - x.b).sin_cos();
        let (sc, cc) = (x.c - x.b).sin_cos();
        let (sd, cd) = (x.d - x.b).sin_cos();
        // sines and cosines of a − c and d − c
        let (sac, cac) = (sa.mul_add(cc, -(ca * sc)), ca.mul_add(cc, sa * sc));
        let (sdc, cdc) = (sd.mul_add(cc, -(cd * sc)), cd.mul_add(cc, sd * sc));
        let (aa, bb) = (x.a_dot * x.a_dot, x.b_dot * x.b_dot);
        let (pull_a, pull_b) = (s.l1 * aa, s.l2 * bb);
        let (pull_c, pull_d) = (s.l3 * x.c_dot * x.c_dot, s.l4 * x.d_dot * x.d_dot);
        // b̈ = p ä + q d̈ + g and c̈ = r ä + t d̈ + h from the loop, along the couplers
        let over = 1.0 / sc;
        let (over2, over3) = (over / s.l2, over / s.l3);
        let p = s.l1 * sac * over2;
        let q = -(s.l4 * sdc * over2);
        let g = over2 * pull_a.mul_add(cac, pull_b.mul_add(cc, pull_d.mul_add(-cdc, -pull_c)));
        let r = s.l1 * sa * over3;
        let t = -(s.l4 * sd * over3);
        let h = over3 * pull_a.mul_add(ca, pull_c.mul_add(-cc, pull_d.mul_add(-cd, pull_b)));
        let load = s.m * s.l1;
        let coupling = load * s.l2;
        let w12 = coupling * ca;
        let turn = coupling * sa;
        let w22 = (s.m * s.l2).mul_add(s.l2, s.J2);
        let w11 = load.mul_add(s.l1, s.J1);
        let f1 = turn.mul_add(-bb, u.left);
        let f2 = w22.mul_add(-g, turn * aa);
        let (jr, jt) = (s.J3 * r, s.J3 * t);
        let row = w22.mul_add(p, w12);
        let m11 = p.mul_add(row + w12, jr.mul_add(r, w11));
        let m12 = row.mul_add(q, jr * t);
        let m22 = (w22 * q).mul_add(q, jt.mul_add(t, s.J4));
        let n1 = p.mul_add(f2, w12.mul_add(-g, jr.mul_add(-h, f1)));
        let n2 = q.mul_add(f2, jt.mul_add(-h, u.right));
        let scale = 1.0 / m11.mul_add(m22, -(m12 * m12));
        let a = m22.mul_add(n1, -(m12 * n2)) * scale;
        let d = m11.mul_add(n2, -(m12 * n1)) * scale;
        FiveBarState {
            a: x.a_dot,
            b: x.b_dot,
            c: x.c_dot,
            d: x.d_dot,
            a_dot: a,
            b_dot: p.mul_add(a, q.mul_add(d, g)),
            c_dot: r.mul_add(a, t.mul_add(d, h)),
            d_dot: d,
        }
    }
    closed
}

/// The cranks keep their angles and velocities, the couplers follow.
impl ClosedByHand for FiveBar {
    #[inline]
    fn open(&self, x: &FiveBarState) -> [f64; 2] {
        let ((sa, ca), (sb, cb)) = (x.a.sin_cos(), x.b.sin_cos());
        let ((sc, cc), (sd, cd)) = (x.c.sin_cos(), x.d.sin_cos());
        [
            self.l1.mul_add(ca, self.l2.mul_add(cb, self.l3.mul_add(-cc, self.l4.mul_add(-cd, -self.base)))),
            self.l1.mul_add(sa, self.l2.mul_add(sb, self.l3.mul_add(-sc, -(self.l4 * sd)))),
        ]
    }

    #[inline]
    fn close(&self, x: &mut FiveBarState) {
        let ((sa, ca), (sb, cb)) = (x.a.sin_cos(), x.b.sin_cos());
        let ((sc, cc), (sd, cd)) = (x.c.sin_cos(), x.d.sin_cos());
        let gx =
            self.l1.mul_add(ca, self.l2.mul_add(cb, self.l3.mul_add(-cc, self.l4.mul_add(-cd, -self.base))));
        let gy = self.l1.mul_add(sa, self.l2.mul_add(sb, self.l3.mul_add(-sc, -(self.l4 * sd))));
        let over = 1.0 / sc.mul_add(cb, -(cc * sb));
        x.b -= gx.mul_add(cc, gy * sc) * over / self.l2;
        x.c -= gx.mul_add(cb, gy * sb) * over / self.l3;
    }

    #[inline]
    fn follow(&self, x: &mut FiveBarState) {
        let (sa, ca) = (x.a - x.b).sin_cos();
        let (sc, cc) = (x.c - x.b).sin_cos();
        let (sd, cd) = (x.d - x.b).sin_cos();
        let (sac, sdc) = (sa.mul_add(cc, -(ca * sc)), sd.mul_add(cc, -(cd * sc)));
        let over = 1.0 / sc;
        let (left, right) = (self.l1 * x.a_dot * over, self.l4 * x.d_dot * over);
        x.b_dot = left.mul_add(sac, -(right * sdc)) / self.l2;
        x.c_dot = left.mul_add(sa, -(right * sd)) / self.l3;
    }
}
