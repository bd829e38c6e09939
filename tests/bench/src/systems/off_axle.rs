//! A tractor with two trailers, each hitched behind the axle before it.

use nonholonomic::prelude::*;

use crate::contest::contest;

/// The velocities of each trailer's axle, `ahead` and `across`, are in the axes of the trailer.
#[nonholonomic(
    base  { x, y, th, rel[2] }
    basis { v, side, omega, rd[2] }
    anchor {
        der(x) = v * cos(th) - side * sin(th);
        der(y) = v * sin(th) + side * cos(th);
        der(th) = omega;
        der(rel) = rd;
    }
    let w1 = omega + rd[0];
    let w2 = w1 + rd[1];
    let ahead1 = v * cos(rel[0]) + (side - h * omega) * sin(rel[0]);
    let across1 = (side - h * omega) * cos(rel[0]) - v * sin(rel[0]) - d * w1;
    let ahead2 = ahead1 * cos(rel[1]) + (across1 - h * w1) * sin(rel[1]);
    let across2 = (across1 - h * w1) * cos(rel[1]) - ahead1 * sin(rel[1]) - d * w2;
    lagrangian {
        m / 2 * (v^2 + side^2) + J / 2 * omega^2 + mt / 2 * (ahead1^2 + across1^2 + ahead2^2 + across2^2) + Jt / 2 * (w1^2 + w2^2)
    }
    constraints { side = 0; across1 = 0; across2 = 0; }
    independent { v, omega }
    inputs { push, steer }
    forces { v: push; omega: steer; }
    emit { jacobian, sparse_jacobian }
)]
#[derive(Clone, Copy, Debug)]
pub struct OffAxle {
    m: f64,
    J: f64,
    mt: f64,
    Jt: f64,
    h: f64,
    d: f64,
}

contest! {
    OffAxle as "trailers off the axle", 7 states, 2 inputs of OffAxleInput,
    parameters [p.m, p.J, p.mt, p.Jt, p.h, p.d] of p,
    OffAxle { m: 1.3, J: 0.4, mt: 0.7, Jt: 0.1, h: 0.2, d: 0.8 },
    hand |s, _t, x, u| {
        let (sin_th, cos_th) = x.th.sin_cos();
        let (s1, c1) = x.rel[0].sin_cos();
        let (s2, c2) = x.rel[1].sin_cos();
        let over = 1.0 / s.d;
        // velocities of trailers by v and by omega
        let (av, ao) = (c1, -(s.h * s1));
        let (wv, wo) = (-(s1 * over), -(s.h * over * c1));
        let (hs, hc) = (s.h * s2, s.h * c2);
        let (bv, bo) = (c2.mul_add(av, -(hs * wv)), c2.mul_add(ao, -(hs * wo)));
        let (zv, zo) = (-over * s2.mul_add(av, hc * wv), -over * s2.mul_add(ao, hc * wo));
        let along1 = av.mul_add(x.v, ao * x.omega);
        let spin1 = wv.mul_add(x.v, wo * x.omega);
        let along2 = bv.mul_add(x.v, bo * x.omega);
        let spin2 = zv.mul_add(x.v, zo * x.omega);
        let (r1, r2) = (spin1 - x.omega, spin2 - spin1);
        // what changes with the angles
        let p1 = s.d * spin1 * r1;
        let t1 = -(over * along1 * r1);
        let p2 = (s.d * spin2).mul_add(r2, c2.mul_add(p1, -(hs * t1)));
        let t2 = -over * along2.mul_add(r2, s2.mul_add(p1, hc * t1));
        let (kav, kao, kbv, kbo) = (s.mt * av, s.mt * ao, s.mt * bv, s.mt * bo);
        let (jwv, jwo, jzv, jzo) = (s.Jt * wv, s.Jt * wo, s.Jt * zv, s.Jt * zo);
        let m11 = kav.mul_add(av, kbv.mul_add(bv, jwv.mul_add(wv, jzv.mul_add(zv, s.m))));
        let m12 = kav.mul_add(ao, kbv.mul_add(bo, jwv.mul_add(wo, jzv * zo)));
        let m22 = kao.mul_add(ao, kbo.mul_add(bo, jwo.mul_add(wo, jzo.mul_add(zo, s.J))));
        let f1 = (-kav).mul_add(p1, (-kbv).mul_add(p2, (-jwv).mul_add(t1, (-jzv).mul_add(t2, u.push))));
        let f2 = (-kao).mul_add(p1, (-kbo).mul_add(p2, (-jwo).mul_add(t1, (-jzo).mul_add(t2, u.steer))));
        let scale = 1.0 / m11.mul_add(m22, -(m12 * m12));
        OffAxleState {
            x: x.v * cos_th,
            y: x.v * sin_th,
            th: x.omega,
            rel: [r1, r2],
            v: m22.mul_add(f1, -(m12 * f2)) * scale,
            omega: m11.mul_add(f2, -(m12 * f1)) * scale,
        }
    }
}
