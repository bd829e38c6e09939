//! Machines on wheels, as `reference/more_wheels.py` sets them up from positions in space.
#![allow(non_snake_case, reason = "parameters are written as in mechanics: J, I, R, Omega")]

use nonholonomic::prelude::*;

use super::check_with_multipliers;

/// A platform on four wheels with rollers: the wheels alone obey a combination of the constraints.
#[nonholonomic(
    base { x, y, th, a[4] }
    basis { vx, vy, om, w[4] }
    anchor {
        der(x) = vx * cos(th) - vy * sin(th);
        der(y) = vx * sin(th) + vy * cos(th);
        der(th) = om;
        der(a) = w;
    }
    lagrangian {
        m / 2 * ((vx - cy * om)^2 + (vy + cx * om)^2) + J / 2 * om^2 + sum(i in 0..4: Jw * w[i]^2) / 2
    }
    constraints {
        front_left: r * w[0] = vx - vy - k * om;
        front_right: r * w[1] = vx + vy + k * om;
        rear_left: r * w[2] = vx + vy - k * om;
        rear_right: r * w[3] = vx - vy + k * om;
    }
    inputs { torque[4] }
    forces { for i in 0..4 { w[i]: torque[i] - f * w[i]; } }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct Mecanum {
    m: f64,
    J: f64,
    Jw: f64,
    r: f64,
    k: f64,
    cx: f64,
    cy: f64,
    f: f64,
}

/// A pendulum on two wheels, all of it in rates of coordinates.
#[nonholonomic(
    base { x, y, yaw, tilt, right, left }
    lagrangian {
        let px = der(x) + d * (cos(yaw) * cos(tilt) * der(tilt) - sin(yaw) * sin(tilt) * der(yaw));
        let py = der(y) + d * (sin(yaw) * cos(tilt) * der(tilt) + cos(yaw) * sin(tilt) * der(yaw));
        let pz = -d * sin(tilt) * der(tilt);
        mw * (der(x)^2 + der(y)^2 + c^2 * der(yaw)^2) + Jd * der(yaw)^2 + Jw / 2 * (der(right)^2 + der(left)^2)
            + mb / 2 * (px^2 + py^2 + pz^2) - mb * g * d * cos(tilt)
            + I[0] / 2 * (sin(tilt) * der(yaw))^2 + I[1] / 2 * der(tilt)^2 + I[2] / 2 * (cos(tilt) * der(yaw))^2
    }
    constraints {
        skid: -sin(yaw) * der(x) + cos(yaw) * der(y) = 0;
        roll_right: cos(yaw) * der(x) + sin(yaw) * der(y) + c * der(yaw) = r * der(right);
        roll_left: cos(yaw) * der(x) + sin(yaw) * der(y) - c * der(yaw) = r * der(left);
    }
    inputs { u_right, u_left }
    forces { right: u_right; left: u_left; tilt: -(u_right + u_left); }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct Segway {
    mw: f64,
    mb: f64,
    Jd: f64,
    Jw: f64,
    I: [f64; 3],
    c: f64,
    r: f64,
    d: f64,
    g: f64,
}

/// A rolling disk with a rider who swings in its plane.
#[nonholonomic(
    base { x, y, yaw, lean, spin, beta }
    lagrangian {
        // the hub above the contact, and the rider from there
        let up = [sin(yaw) * sin(lean), -cos(yaw) * sin(lean), cos(lean)];
        let ahead = [cos(yaw), sin(yaw), 0];
        let up_turns = [
            cos(yaw) * sin(lean) * der(yaw) + sin(yaw) * cos(lean) * der(lean),
            sin(yaw) * sin(lean) * der(yaw) - cos(yaw) * cos(lean) * der(lean),
            -sin(lean) * der(lean)
        ];
        let ahead_turns = [-sin(yaw) * der(yaw), cos(yaw) * der(yaw), 0];
        let hub = [der(x), der(y), 0] + r * up_turns;
        let top = hub + d * (cos(beta) * up_turns + sin(beta) * ahead_turns
            + der(beta) * (cos(beta) * ahead - sin(beta) * up));
        m / 2 * dot(hub, hub) + M / 2 * dot(top, top) + A / 2 * (der(lean)^2 + (der(yaw) * cos(lean))^2)
            + C / 2 * (der(spin) + sin(lean) * der(yaw))^2
            - m * g * r * cos(lean) - M * g * (r + d * cos(beta)) * cos(lean)
    }
    constraints { der(x) = r * cos(yaw) * der(spin); der(y) = r * sin(yaw) * der(spin); }
    inputs { pedal }
    forces { spin: pedal; beta: -pedal; }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct Rider {
    m: f64,
    M: f64,
    A: f64,
    C: f64,
    r: f64,
    d: f64,
    g: f64,
}

/// A car whose trailer is hitched behind the rear axle: D has no basis that is valid everywhere.
#[nonholonomic(
    base { x, y, th, delta, psi }
    basis { v, w, om, dd, dpsi }
    anchor {
        der(x) = v * cos(th) - w * sin(th);
        der(y) = v * sin(th) + w * cos(th);
        der(th) = om;
        der(delta) = dd;
        der(psi) = dpsi;
    }
    lagrangian {
        let tx = der(x) + h * sin(th) * om + (l - e) * sin(psi) * dpsi;
        let ty = der(y) - h * cos(th) * om - (l - e) * cos(psi) * dpsi;
        m / 2 * (v^2 + (w + c * om)^2) + J / 2 * om^2 + Jf / 2 * (om + dd)^2
            + mt / 2 * (tx^2 + ty^2) + Jt / 2 * dpsi^2
    }
    constraints {
        rear: w = 0;
        front: cos(delta) * (w + b * om) = sin(delta) * v;
        trailer: cos(psi) * (der(y) - h * cos(th) * om - l * cos(psi) * dpsi)
            = sin(psi) * (der(x) + h * sin(th) * om + l * sin(psi) * dpsi);
    }
    inputs { drive, steer }
    forces { v: drive; delta: steer; }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct Hitch {
    m: f64,
    J: f64,
    Jf: f64,
    mt: f64,
    Jt: f64,
    b: f64,
    c: f64,
    h: f64,
    l: f64,
    e: f64,
}

#[test]
fn machines_on_wheels() {
    let system = Mecanum { m: 5.0, J: 0.6, Jw: 0.03, r: 0.1, k: 0.5, cx: 0.07, cy: -0.03, f: 0.01 };
    let input = MecanumInput { torque: [0.3, -0.2, 0.5, 0.1] };
    check_with_multipliers("mecanum", &system, input, |t, x| system.multipliers(t, x, &input));
    let (I, c, r, d) = ([0.2, 0.25, 0.11], 0.2, 0.1, 0.6);
    let system = Segway { mw: 0.5, mb: 4.0, Jd: 0.002, Jw: 0.004, I, c, r, d, g: 9.81 };
    let input = SegwayInput { u_right: 0.4, u_left: -0.1 };
    check_with_multipliers("segway", &system, input, |t, x| system.multipliers(t, x, &input));
    let system = Rider { m: 1.2, M: 0.8, A: 0.06, C: 0.11, r: 0.4, d: 0.7, g: 9.81 };
    let input = RiderInput { pedal: 0.33 };
    check_with_multipliers("rider", &system, input, |t, x| system.multipliers(t, x, &input));
    let (b, c, h, l, e) = (1.1, 0.45, 0.3, 0.8, 0.12);
    let system = Hitch { m: 2.1, J: 0.7, Jf: 0.05, mt: 0.9, Jt: 0.21, b, c, h, l, e };
    let input = HitchInput { drive: 0.8, steer: -0.2 };
    check_with_multipliers("hitch", &system, input, |t, x| system.multipliers(t, x, &input));
}
