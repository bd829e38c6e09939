//! A body in space, carried by a thrust along an axis of its own.

use nonholonomic::prelude::*;

use crate::contest::contest;

/// A quadrotor: the place, the attitude by a quaternion, velocities of the centre of mass in space and angular velocities
/// in the body.
#[nonholonomic(
    base  { p[3], q[4] }
    basis { v[3], w[3] }
    anchor {
        der(p) = v;
        der(q[0]) = -(q[1] * w[0] + q[2] * w[1] + q[3] * w[2]) / 2;
        der(q[1]) = (q[0] * w[0] + q[2] * w[2] - q[3] * w[1]) / 2;
        der(q[2]) = (q[0] * w[1] + q[3] * w[0] - q[1] * w[2]) / 2;
        der(q[3]) = (q[0] * w[2] + q[1] * w[1] - q[2] * w[0]) / 2;
    }
    brackets so(3) { w }
    lagrangian { m / 2 * dot(v, v) + sum(i in 0..3: I[i] * w[i]^2) / 2 - m * g * p[2] }
    inputs { thrust, torque[3] }
    forces {
        v[0]: 2 * (q[1] * q[3] + q[0] * q[2]) * thrust;
        v[1]: 2 * (q[2] * q[3] - q[0] * q[1]) * thrust;
        v[2]: (q[0]^2 - q[1]^2 - q[2]^2 + q[3]^2) * thrust;
        for i in 0..3 { w[i]: torque[i]; }
    }
    emit { jacobian, sparse_jacobian }
)]
#[derive(Clone, Copy, Debug)]
pub struct Quadrotor {
    m: f64,
    I: [f64; 3],
    g: f64,
}

contest! {
    Quadrotor as "quadrotor", 13 states, 4 inputs of QuadrotorInput,
    parameters [p.m, p.I[0], p.I[1], p.I[2], p.g] of p,
    Quadrotor { m: 0.8, I: [0.011, 0.013, 0.021], g: 9.81 },
    hand |s, _t, x, u| {
        let ([q0, q1, q2, q3], [w1, w2, w3]) = (x.q, x.w);
        let ([i1, i2, i3], [t1, t2, t3]) = (s.I, u.torque);
        let (h1, h2, h3) = (0.5 * w1, 0.5 * w2, 0.5 * w3);
        let pull = u.thrust / s.m;
        let twice = 2.0 * pull;
        QuadrotorState {
            p: x.v,
            q: [
                (-q1).mul_add(h1, (-q2).mul_add(h2, -(q3 * h3))),
                q0.mul_add(h1, q2.mul_add(h3, -(q3 * h2))),
                q0.mul_add(h2, q3.mul_add(h1, -(q1 * h3))),
                q0.mul_add(h3, q1.mul_add(h2, -(q2 * h1))),
            ],
            v: [
                q1.mul_add(q3, q0 * q2) * twice,
                q2.mul_add(q3, -(q0 * q1)) * twice,
                q0.mul_add(q0, q3.mul_add(q3, (-q1).mul_add(q1, -(q2 * q2)))).mul_add(pull, -s.g),
            ],
            w: [
                (w2 * w3).mul_add(i2 - i3, t1) / i1,
                (w3 * w1).mul_add(i3 - i1, t2) / i2,
                (w1 * w2).mul_add(i1 - i2, t3) / i3,
            ],
        }
    }
}
