//! The snakeboard with torques on its rotor and on its wheels.

use crate::contest::contest;

nh_models::snakeboard! {
    /// The snakeboard.
    #[derive(Clone, Copy, Debug)]
    pub struct Snakeboard { m: f64, l: f64, J0: f64, J1: f64 }
    independent { u1, dpsi, dphi }
    emit { jacobian, sparse_jacobian }
}

contest! {
    Snakeboard as "snakeboard", 8 states, 2 inputs of SnakeboardInput,
    parameters [p.m, p.l, p.J0, p.J1] of p,
    Snakeboard { m: 1.4, l: 0.5, J0: 0.09, J1: 0.03 },
    hand |s, _t, x, u| {
        let (sin_theta, cos_theta) = x.theta.sin_cos();
        let (sin_phi, cos_phi) = x.phi.sin_cos();
        // θ̇ = −κ u₁ with κ = tan φ / l, and turn = κ̇ u₁
        let lc = s.l * cos_phi;
        let kappa = sin_phi / lc;
        let turn = x.dphi * x.u1 / (lc * cos_phi);
        let excess = (s.m * s.l).mul_add(s.l, -s.J0);
        let mass = (excess * kappa).mul_add(kappa, s.m);
        let u1_dot = excess.mul_add(-turn, u.rotor) * kappa / mass;
        let minus_theta_ddot = kappa.mul_add(u1_dot, turn);
        SnakeboardState {
            x: x.u1 * cos_theta,
            y: x.u1 * sin_theta,
            theta: -kappa * x.u1,
            psi: x.dpsi,
            phi: x.dphi,
            u1: u1_dot,
            dpsi: u.rotor / s.J0 + minus_theta_ddot,
            dphi: u.steering / (2.0 * s.J1),
        }
    }
}
