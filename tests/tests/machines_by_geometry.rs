//! Machines declared by where their bodies are: positions, attitudes and contacts, each once, and nothing
//! differentiated by hand. Accelerations, energies and multipliers agree with numbers of `reference/machines.py`,
//! which come of the equations of Newton and Euler with differences at 200 digits.
#![allow(non_snake_case, reason = "parameters are written as in mechanics: A, C, I")]

#[path = "more_systems/reference.rs"]
mod reference;

use nonholonomic::prelude::*;
use reference::{check, check_with_multipliers};

/// A disk that rolls on an uneven surface z = h(x, y): the point of contact is below (x, y).
#[nonholonomic(
    let h(u, v) = k[0] * u^2 + k[1] * v^2 + k[2] * u * v;
    let slope = diff(h(x, y), [x, y]);
    let contact = [x, y, h(x, y)];
    let tangent = [1, 0, slope[0]] / norm([1, slope[0]]);
    let normal = [-slope[0], -slope[1], 1] / norm([slope[0], slope[1], 1]);
    let surface = transpose([tangent, cross(normal, tangent), normal]);
    let upright = surface * rot_z(yaw) * rot_x(lean);
    let R = upright * rot_y(spin);
    let centre = contact + upright * [0, 0, r];
    base { x, y, yaw, lean, spin }
    lagrangian { kinetic(m, [A, C, A], centre, R) - m * g * centre[2] }
    constraints { rolling: (transpose(surface) * velocity_at(centre, R, contact))[0..2] = 0; }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct DiskOnASurface {
    m: f64,
    r: f64,
    A: f64,
    C: f64,
    k: [f64; 3],
    g: f64,
}

#[test]
fn disk_on_a_surface() {
    let disk = DiskOnASurface { m: 2.0, r: 0.4, A: 0.09, C: 0.17, k: [0.3, -0.2, 0.15], g: 9.81 };
    check_with_multipliers("disk_on_a_surface", &disk, (), |t, state| disk.multipliers(t, state, &()));
}

/// A body that balances on a ball.
#[nonholonomic(
    let ball = [x, y, r];
    let spin = rot_z(a) * rot_x(b) * rot_z(c);
    let R = rot_z(yaw) * rot_y(pitch) * rot_x(roll);
    let body = ball + R * [0, 0, l];
    base { x, y, a, b, c, yaw, pitch, roll }
    lagrangian { kinetic(M, Jb, ball, spin) + kinetic(m, I, body, R) - m * g * body[2] }
    constraints { slip: velocity_at(ball, spin, [x, y, 0])[0..2] = 0; }
    formulation { projected }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct BallBot {
    M: f64,
    r: f64,
    Jb: f64,
    m: f64,
    l: f64,
    I: [f64; 3],
    g: f64,
}

#[test]
fn ball_bot() {
    let bot = BallBot { M: 3.0, r: 0.12, Jb: 0.02, m: 9.0, l: 0.35, I: [0.6, 0.5, 0.2], g: 9.81 };
    check_with_multipliers("ball_bot", &bot, (), |t, state| bot.multipliers(t, state, &()));
}

/// A unicycle that balances by pitching its frame and turning a flywheel about the axis of travel.
#[nonholonomic(
    let contact = [x, y, 0];
    let upright = rot_z(yaw) * rot_x(lean);
    let hub = contact + upright * [0, 0, r];
    let R = upright * rot_y(pitch);
    let frame = hub + R * [0, 0, h];
    let flywheel = hub + R * [0, 0, hd];
    base { x, y, yaw, lean, spin, pitch, wheel }
    lagrangian {
        kinetic(mw, [Aw, Cw, Aw], hub, upright * rot_y(spin)) + kinetic(mf, I, frame, R)
        + kinetic(md, [Cd, Ad, Ad], flywheel, R * rot_x(wheel))
        - g * (mw * hub + mf * frame + md * flywheel)[2]
    }
    constraints { rolling: velocity_at(hub, upright * rot_y(spin), contact)[0..2] = 0; }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct Unicycle {
    mw: f64,
    r: f64,
    Aw: f64,
    Cw: f64,
    mf: f64,
    h: f64,
    I: [f64; 3],
    md: f64,
    hd: f64,
    Ad: f64,
    Cd: f64,
    g: f64,
}

#[test]
fn unicycle() {
    let unicycle = Unicycle {
        mw: 1.5,
        r: 0.3,
        Aw: 0.04,
        Cw: 0.08,
        mf: 8.0,
        h: 0.7,
        I: [0.9, 0.8, 0.3],
        md: 2.0,
        hd: 1.1,
        Ad: 0.05,
        Cd: 0.1,
        g: 9.81,
    };
    check_with_multipliers("unicycle", &unicycle, (), |t, state| unicycle.multipliers(t, state, &()));
}

/// A quadrotor with a load on a cable that stays tight.
#[nonholonomic(
    let R = rot_z(yaw) * rot_y(pitch) * rot_x(roll);
    let load = p - R * [0, 0, d] + rot_x(swing) * rot_y(turn) * [0, 0, -l];
    let w = body_rate(R);
    base { p[3], yaw, pitch, roll, swing, turn }
    inputs { thrust, torque[3] }
    lagrangian { kinetic(m, I, p, R) + kinetic(ml, load) - g * (m * p + ml * load)[2] }
    forces {
        p: R * [0, 0, thrust];
        yaw: dot(torque, diff(w, der(yaw)));
        pitch: dot(torque, diff(w, der(pitch)));
        roll: dot(torque, diff(w, der(roll)));
    }
)]
#[derive(Clone, Copy, Debug)]
struct Quadrotor {
    m: f64,
    I: [f64; 3],
    ml: f64,
    l: f64,
    d: f64,
    g: f64,
}

#[test]
fn quadrotor_with_load() {
    let quadrotor = Quadrotor { m: 1.2, I: [0.02, 0.025, 0.04], ml: 0.4, l: 0.9, d: 0.05, g: 9.81 };
    check("quadrotor_with_load", &quadrotor, QuadrotorInput { thrust: 14.0, torque: [0.1, -0.05, 0.02] });
}
