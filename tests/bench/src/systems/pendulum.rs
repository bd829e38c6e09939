//! A spherical pendulum on a unicycle.

use nonholonomic::prelude::*;

use crate::contest::contest;

/// A bob on a rod, which a ball joint holds on a cart with one axle; `al` is its angle about the axle.
#[nonholonomic(
    base  { x, y, th, al, be }
    basis { v, side, omega, ad, bd }
    anchor {
        der(x) = v * cos(th) - side * sin(th);
        der(y) = v * sin(th) + side * cos(th);
        der(th) = omega;
        der(al) = ad;
        der(be) = bd;
    }
    lagrangian {
        let n = [sin(al) * cos(be), sin(be), -cos(al) * cos(be)];
        let bob = [v, side, 0] + l * (cross([0, 0, omega], n)
            + [cos(al) * cos(be) * ad - sin(al) * sin(be) * bd, cos(be) * bd, sin(al) * cos(be) * ad + cos(al) * sin(be) * bd]);
        mc / 2 * (v^2 + side^2) + J / 2 * omega^2 + mb / 2 * dot(bob, bob) - mb * g * l * n[2]
    }
    constraints { side = 0; }
    inputs { push, steer }
    forces { v: push; omega: steer; }
    emit { jacobian, sparse_jacobian }
)]
#[derive(Clone, Copy, Debug)]
pub struct Pendulum {
    mc: f64,
    mb: f64,
    J: f64,
    l: f64,
    g: f64,
}

contest! {
    Pendulum as "pendulum", 9 states, 2 inputs of PendulumInput,
    parameters [p.mc, p.mb, p.J, p.l, p.g] of p,
    Pendulum { mc: 2.0, mb: 0.5, J: 0.4, l: 0.6, g: 9.81 },
    hand |s, _t, x, i| {
        let (sin, cos) = x.th.sin_cos();
        let (sa, ca) = x.al.sin_cos();
        let (sb, cb) = x.be.sin_cos();
        let (v, w, ad, bd) = (x.v, x.omega, x.ad, x.bd);
        let wc = w * ca;
        let u1 = cb.mul_add(ad, -(wc * sb));
        let u2 = w.mul_add(sa, bd);
        let turn = sb.mul_add(ad, wc * cb);
        let n1 = sa * cb;
        let vw = v * w;
        // the rod's tension, per unit mass of the bob and its reaction on the cart
        let pull = s.l.mul_add(u1.mul_add(u1, u2 * u2), (s.g * ca).mul_add(cb, -(sb * vw)));
        let mn = s.mb * n1;
        let v_dot = mn.mul_add(pull, i.push) / mn.mul_add(n1, s.mc);
        let w_dot = i.steer / s.J;
        let over = 1.0 / s.l;
        let a = wc.mul_add(w * n1, (w_dot * sb).mul_add(ca, -(over * s.g.mul_add(sa, v_dot * ca))));
        let b = v_dot.mul_add(sa, -(s.g * ca)).mul_add(sb, -(cb * vw));
        PendulumState {
            x: v * cos, y: v * sin, th: w, al: ad, be: bd,
            v: v_dot,
            omega: w_dot,
            ad: (2.0 * turn).mul_add(bd, a) / cb,
            bd: over.mul_add(b, -turn.mul_add(u1, wc.mul_add(ad, w_dot * sa))),
        }
    }
}
