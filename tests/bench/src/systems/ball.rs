//! A homogeneous ball that rolls on a rotating table, CLMM section 7.4.

use crate::contest::contest;

nh_models::ball! {
    /// The ball on the rotating table.
    #[derive(Clone, Copy, Debug)]
    pub struct Ball { m: f64, r: f64, k2: f64, Omega: f64 }
    emit { jacobian, sparse_jacobian }
}

contest! {
    Ball as "ball on table", 5 states, 0 inputs,
    parameters [p.m, p.r, p.k2, p.Omega] of p,
    Ball { m: 1.0, r: 0.3, k2: 0.04, Omega: 0.7 },
    hand |s, _t, x, _u| {
        let dx = s.r.mul_add(x.wy, -(s.Omega * x.y));
        let dy = s.Omega.mul_add(x.x, -(s.r * x.wx));
        let gain = s.r * s.Omega / s.r.mul_add(s.r, s.k2);
        BallState { x: dx, y: dy, wx: gain * dx, wy: gain * dy, wz: 0.0 }
    }
}
