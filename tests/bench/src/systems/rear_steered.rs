//! A car that steers with all wheels, and its trailer.

use nonholonomic::prelude::*;

use crate::contest::contest;

/// A car with front wheels at `f` and rear wheels at `b`, both steered, and a trailer hitched `h` behind the rear axle.
#[nonholonomic(
    base  { x, y, th, f, b, rel }
    basis { v, side, omega, fd, bd, rd }
    anchor {
        der(x) = v * cos(th) - side * sin(th);
        der(y) = v * sin(th) + side * cos(th);
        der(th) = omega;
        der(f) = fd;
        der(b) = bd;
        der(rel) = rd;
    }
    lagrangian {
        let w = omega + rd;
        let px = v + d * sin(rel) * w;
        let py = side - h * omega - d * cos(rel) * w;
        m / 2 * (v^2 + (side + a * omega)^2) + J / 2 * omega^2 + Jf / 2 * (omega + fd)^2 + Jb / 2 * (omega + bd)^2
            + mt / 2 * (px^2 + py^2) + Jt / 2 * w^2
    }
    constraints {
        side * cos(b) = v * sin(b);
        (side + L * omega) * cos(f) = v * sin(f);
        (side - h * omega) * cos(rel) - v * sin(rel) = d * (omega + rd);
    }
    independent { v, fd, bd }
    inputs { drive, front, rear }
    forces { v: drive; fd: front; bd: rear; }
    emit { jacobian, sparse_jacobian }
)]
#[derive(Clone, Copy, Debug)]
pub struct RearSteered {
    m: f64,
    J: f64,
    Jf: f64,
    Jb: f64,
    a: f64,
    L: f64,
    mt: f64,
    Jt: f64,
    h: f64,
    d: f64,
}

contest! {
    RearSteered as "car, rear steering and trailer", 9 states, 3 inputs of RearSteeredInput,
    parameters [p.m, p.J, p.Jf, p.Jb, p.a, p.L, p.mt, p.Jt, p.h, p.d] of p,
    RearSteered { m: 1.3, J: 0.4, Jf: 0.05, Jb: 0.04, a: 0.5, L: 0.9, mt: 0.7, Jt: 0.1, h: 0.2, d: 0.8 },
    hand |s, _t, x, u| {
        let (sin_th, cos_th) = x.th.sin_cos();
        let (sin_f, cos_f) = x.f.sin_cos();
        let (sin_b, cos_b) = x.b.sin_cos();
        let (sin, cos) = x.rel.sin_cos();
        // every velocity is a multiple of v: of the rear axle across σ, of yaw κ, of the trailer η and its yaw κₜ
        let (over_f, over_b) = (1.0 / cos_f, 1.0 / cos_b);
        let (over, over_d) = (1.0 / s.L, 1.0 / s.d);
        let sigma = sin_b * over_b;
        let sigma_dot = over_b * over_b * x.bd;
        let kappa = over * sin_f.mul_add(over_f, -sigma);
        let kappa_dot = over * (over_f * over_f).mul_add(x.fd, -sigma_dot);
        let rho = s.a.mul_add(kappa, sigma);
        let rho_dot = s.a.mul_add(kappa_dot, sigma_dot);
        let mu = s.h.mul_add(-kappa, sigma);
        let mu_dot = s.h.mul_add(-kappa_dot, sigma_dot);
        let eta = mu.mul_add(sin, cos);
        let across = mu.mul_add(cos, -sin);
        let spin = across * over_d;
        let omega = kappa * x.v;
        let rate = spin.mul_add(x.v, -omega);
        let eta_dot = rate.mul_add(across, mu_dot * sin);
        let spin_dot = over_d * mu_dot.mul_add(cos, -(rate * eta));
        let (m1, m2, m3, m4) = (s.m * rho, s.J * kappa, s.mt * eta, s.Jt * spin);
        let mass = m1.mul_add(rho, m2.mul_add(kappa, m3.mul_add(eta, m4.mul_add(spin, s.m))));
        let change = m1.mul_add(rho_dot, m2.mul_add(kappa_dot, m3.mul_add(eta_dot, m4 * spin_dot)));
        let force = kappa.mul_add(-(u.front + u.rear), x.v.mul_add(-change, u.drive));
        let v = force / mass;
        let turned = kappa.mul_add(v, kappa_dot * x.v);
        let side = sigma * x.v;
        RearSteeredState {
            x: x.v.mul_add(cos_th, -(side * sin_th)),
            y: x.v.mul_add(sin_th, side * cos_th),
            th: omega,
            f: x.fd,
            b: x.bd,
            rel: rate,
            v,
            fd: u.front / s.Jf - turned,
            bd: u.rear / s.Jb - turned,
        }
    }
}
