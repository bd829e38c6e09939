//! A robot with a trailer that is hitched behind its axle.

use nonholonomic::prelude::*;

use crate::contest::contest;

/// A robot and its trailer.
#[nonholonomic(
    base  { x, y, th, rel }
    basis { v, side, omega, rd }
    anchor {
        der(x) = v * cos(th) - side * sin(th);
        der(y) = v * sin(th) + side * cos(th);
        der(th) = omega;
        der(rel) = rd;
    }
    lagrangian {
        let w = omega + rd;
        let px = v + d * sin(rel) * w;
        let py = side - h * omega - d * cos(rel) * w;
        m / 2 * (v^2 + side^2) + J / 2 * omega^2 + mt / 2 * (px^2 + py^2) + Jt / 2 * w^2
    }
    constraints { side = 0; (side - h * omega) * cos(rel) - v * sin(rel) = d * (omega + rd); }
    independent { v, omega }
    inputs { push, steer }
    forces { v: push; omega: steer; }
    emit { jacobian, sparse_jacobian }
)]
#[derive(Clone, Copy, Debug)]
pub struct HitchedTrailer {
    m: f64,
    J: f64,
    mt: f64,
    Jt: f64,
    h: f64,
    d: f64,
}

contest! {
    HitchedTrailer as "hitched trailer", 6 states, 2 inputs of HitchedTrailerInput,
    parameters [p.m, p.J, p.mt, p.Jt, p.h, p.d] of p,
    HitchedTrailer { m: 1.3, J: 0.4, mt: 0.7, Jt: 0.1, h: 0.2, d: 0.8 },
    hand |s, _t, x, u| {
        let (sin_th, cos_th) = x.th.sin_cos();
        let (sin, cos) = x.rel.sin_cos();
        // the trailer runs at v cos − ω h sin along its axis, and turns at −(v sin + ω h cos) / d
        let over = 1.0 / s.d;
        let (across, ahead) = (s.h * sin, s.h * cos);
        let along = cos.mul_add(x.v, -(across * x.omega));
        let spin = -over * sin.mul_add(x.v, ahead * x.omega);
        let rate = spin - x.omega;
        // what its inertia asks for at v̇ = ω̇ = 0
        let pull = s.mt * rate * s.d * spin;
        let twist = -s.Jt * over * rate * along;
        let (spin_v, spin_omega) = (sin * over, ahead * over);
        let moment = s.Jt * spin_v;
        let momentum = s.mt * cos;
        let m11 = momentum.mul_add(cos, moment.mul_add(spin_v, s.m));
        let m12 = moment.mul_add(spin_omega, -(momentum * across));
        let m22 = (s.mt * across).mul_add(across, (s.Jt * spin_omega).mul_add(spin_omega, s.J));
        let f1 = spin_v.mul_add(twist, cos.mul_add(-pull, u.push));
        let f2 = spin_omega.mul_add(twist, across.mul_add(pull, u.steer));
        let scale = 1.0 / m11.mul_add(m22, -(m12 * m12));
        HitchedTrailerState {
            x: x.v * cos_th,
            y: x.v * sin_th,
            th: x.omega,
            rel: rate,
            v: m22.mul_add(f1, -(m12 * f2)) * scale,
            omega: m11.mul_add(f2, -(m12 * f1)) * scale,
        }
    }
}
