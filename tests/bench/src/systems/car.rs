//! A car that is driven and steered at its front wheels.

use crate::contest::contest;

nh_models::car! {
    /// A car; its front wheels turn about the vertical axis together.
    #[derive(Clone, Copy, Debug)]
    pub struct Car { m: f64, J: f64, Js: f64, a: f64, L: f64 }
    emit { jacobian, sparse_jacobian }
}

contest! {
    Car as "car", 6 states, 2 inputs of CarInput,
    parameters [p.m, p.J, p.Js, p.a, p.L] of p,
    Car { m: 1.3, J: 0.4, Js: 0.07, a: 0.5, L: 0.9 },
    hand |s, _t, x, u| {
        let (sin_th, cos_th) = x.th.sin_cos();
        let (sin, cos) = x.delta.sin_cos();
        // θ̇ = κ v with κ = tan δ / L; bend = κ̇ v
        let over = 1.0 / (s.L * cos);
        let kappa = sin * over;
        let bend = x.turn * over * x.v / cos;
        // Js (θ̈ + δ̈) = steer, so that m v̇ + κ ((J + m a²) θ̈ + steer) = drive
        let inertia = (s.m * s.a).mul_add(s.a, s.J);
        let force = kappa.mul_add(-inertia.mul_add(bend, u.steer), u.drive);
        let v = force / (inertia * kappa).mul_add(kappa, s.m);
        CarState {
            x: x.v * cos_th,
            y: x.v * sin_th,
            th: kappa * x.v,
            delta: x.turn,
            v,
            turn: u.steer / s.Js - kappa.mul_add(v, bend),
        }
    }
}
