//! Planar arms on a skate that is pushed and steered, with a torque in every joint.

use nonholonomic::prelude::*;

use crate::contest::contest;

/// An arm with a number of links, its hand-written equations, and its place in the contest: links and joints, outward
/// and inward.
///
/// By hand it is Featherstone's articulated-body algorithm (Rigid Body Dynamics Algorithms, 7.3) in the plane, in the axes
/// of each link: what hangs at a joint is an inertia of two directions, since the joint gives way to rotations.
macro_rules! arm {
    ($Arm:ident, $State:ident, $Input:ident, $name:literal, $links:literal, $inputs:literal, $states:literal, [$($out:literal)*], [$($in:literal)*]) => {
        /// A planar arm on a skate, hinged `a` ahead of its blade; `c` is where a link's centre of mass is along it.
        #[nonholonomic(
            base  { x, y, th, q[$links] }
            basis { v, side, omega, qd[$links] }
            anchor {
                der(x) = v * cos(th) - side * sin(th);
                der(y) = v * sin(th) + side * cos(th);
                der(th) = omega;
                der(q) = qd;
            }
            lagrangian {
                let ang[i in 0..$links] = sum(j in 0..i + 1: q[j]);
                let w[i in 0..$links] = omega + sum(j in 0..i + 1: qd[j]);
                let vx[i in 0..$links] = v - sum(j in 0..i: l[j] * sin(ang[j]) * w[j]) - c[i] * sin(ang[i]) * w[i];
                let vy[i in 0..$links] = side + a * omega + sum(j in 0..i: l[j] * cos(ang[j]) * w[j]) + c[i] * cos(ang[i]) * w[i];
                M / 2 * (v^2 + side^2) + I / 2 * omega^2
                    + sum(i in 0..$links: m[i] / 2 * (vx[i]^2 + vy[i]^2) + J[i] / 2 * w[i]^2)
            }
            constraints { side = 0; }
            inputs { push, steer, torque[$links] }
            forces { v: push; omega: steer; for i in 0..$links { qd[i]: torque[i]; } }
            emit { jacobian, sparse_jacobian }
        )]
        #[derive(Clone, Copy, Debug)]
        pub struct $Arm {
            M: f64,
            I: f64,
            a: f64,
            m: [f64; $links],
            J: [f64; $links],
            l: [f64; $links],
            c: [f64; $links],
        }

        contest! {
            $Arm as $name, $states states, $inputs inputs of $Input,
            parameters [p.M, p.I, p.a $(, p.m[$out], p.J[$out], p.l[$out], p.c[$out])*] of p,
            $Arm {
                M: 2.5,
                I: 0.3,
                a: 0.2,
                m: core::array::from_fn(|i| 0.9 - 0.08 * i as f64),
                J: core::array::from_fn(|i| 0.03 / (1.0 + 0.3 * i as f64)),
                l: core::array::from_fn(|i| 0.5 - 0.03 * i as f64),
                c: core::array::from_fn(|i| 0.22 - 0.01 * i as f64),
            },
            hand |s, _t, x, u| {
                let (sin_th, cos_th) = x.th.sin_cos();
                let turns = [$(x.q[$out].sin_cos()),*];
                // squares of the angular velocities
                let (base, mut run) = (x.omega * x.omega, x.omega);
                let mut squares = [0.0; $links];
                $( run += x.qd[$out]; squares[$out] = run * run; )*
                // inward: the force at a joint is (xx xy; xy yy) (its acceleration) + (fx, fy)
                let (mut xx, mut xy, mut yy, mut fx, mut fy, mut beyond) = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
                // a link's angular acceleration is e − kx aₓ − ky a_y
                let mut turned = [(0.0, 0.0, 0.0); $links];
                $(
                    let (m, c, l, ww) = (s.m[$in], s.c[$in], s.l[$in], squares[$in]);
                    let (mc, lw) = (m * c, l * ww);
                    let (xt, yt) = (l * xy, l.mul_add(yy, mc));
                    let tt = mc.mul_add(c, (l * l).mul_add(yy, s.J[$in]));
                    let px = xx.mul_add(-lw, mc.mul_add(-ww, fx));
                    let py = xy.mul_add(-lw, fy);
                    let over = 1.0 / tt;
                    let e = (u.torque[$in] - l.mul_add(py, beyond)) * over;
                    let (kx, ky) = (xt * over, yt * over);
                    turned[$in] = (e, kx, ky);
                    let (rx, ry) = (xt.mul_add(e, px), yt.mul_add(e, py));
                    let (rxx, rxy, ryy) = (m + xx - xt * kx, xt.mul_add(-ky, xy), m + yy - yt * ky);
                    let (sin, cos) = turns[$in];
                    let (t1, t2) = (cos.mul_add(rxx, -(sin * rxy)), cos.mul_add(rxy, -(sin * ryy)));
                    xx = cos.mul_add(t1, -(sin * t2));
                    xy = sin.mul_add(t1, cos * t2);
                    yy = rxx + ryy - xx;
                    fx = cos.mul_add(rx, -(sin * ry));
                    fy = sin.mul_add(rx, cos * ry);
                    beyond = u.torque[$in];
                )*
                // the skate, whose acceleration to the side is v ω
                let (lw, across) = (s.a * base, x.v * x.omega);
                let (xt, yt) = (s.a * xy, s.a * yy);
                let tt = s.a.mul_add(yt, s.I);
                let mass = s.M + xx;
                let py = xy.mul_add(-lw, fy);
                let f1 = u.push - xy.mul_add(across, xx.mul_add(-lw, fx));
                let f2 = u.steer - yt.mul_add(across, s.a.mul_add(py, beyond));
                let over = 1.0 / mass.mul_add(tt, -(xt * xt));
                let v_dot = tt.mul_add(f1, -(xt * f2)) * over;
                let w_dot = mass.mul_add(f2, -(xt * f1)) * over;
                // outward
                let mut qd_dot = [0.0; $links];
                let (mut ax, mut ay, mut alpha, mut ww, mut l) = (v_dot, across, w_dot, base, s.a);
                $(
                    let (jx, jy) = (l.mul_add(-ww, ax), l.mul_add(alpha, ay));
                    let (sin, cos) = turns[$out];
                    ax = cos.mul_add(jx, sin * jy);
                    ay = cos.mul_add(jy, -(sin * jx));
                    let (e, kx, ky) = turned[$out];
                    let next = kx.mul_add(-ax, ky.mul_add(-ay, e));
                    qd_dot[$out] = next - alpha;
                    alpha = next;
                    (ww, l) = (squares[$out], s.l[$out]);
                )*
                let _ = (ax, ay, alpha, ww, l);
                $State {
                    x: x.v * cos_th,
                    y: x.v * sin_th,
                    th: x.omega,
                    q: x.qd,
                    v: v_dot,
                    omega: w_dot,
                    qd: qd_dot,
                }
            }
        }
    };
}

arm!(Arm2, Arm2State, Arm2Input, "arm, 2 links", 2, 4, 9, [0 1], [1 0]);
arm!(Arm4, Arm4State, Arm4Input, "arm, 4 links", 4, 6, 13, [0 1 2 3], [3 2 1 0]);
arm!(Arm6, Arm6State, Arm6Input, "arm, 6 links", 6, 8, 17, [0 1 2 3 4 5], [5 4 3 2 1 0]);
