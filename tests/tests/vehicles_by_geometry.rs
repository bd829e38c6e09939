//! Vehicles, robots and a satellite declared by where their bodies are, each position and each attitude once, and nothing
//! differentiated by hand. Accelerations, energies and multipliers agree with numbers of `reference/machines.py`,
//! which come of the equations of Newton and Euler with differences at 200 digits.
#![allow(non_snake_case, reason = "parameters are written as in mechanics: A, C, I")]

#[path = "more_systems/reference.rs"]
mod reference;

use nonholonomic::prelude::*;
use reference::{check, check_with_multipliers};

/// A snake of five links with wheels that do not slip sideways, and motors in its joints.
#[nonholonomic(
    base { x, y, q[5] }
    inputs { torque[4] }
    let along(a) = [cos(a), sin(a)];
    let across(a) = [-sin(a), cos(a)];
    let link[i in 0..5] = [x, y] + sum(j in 0..i: 2 * l * along(q[j])) + l * along(q[i]);
    lagrangian { sum(i in 0..5: kinetic(m, J, link[i], q[i])) }
    constraints { for i in 0..5 { wheels: dot(across(q[i]), der(link[i])) = 0; } }
    forces {
        q[0]: -torque[0];
        q[1..4]: torque[0..3] - torque[1..4];
        q[4]: torque[3];
    }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct Snake {
    m: f64,
    J: f64,
    l: f64,
}

#[test]
fn snake() {
    let snake = Snake { m: 0.7, J: 0.012, l: 0.15 };
    let input = SnakeInput { torque: [0.05, -0.12, 0.2, 0.08] };
    check_with_multipliers("snake", &snake, input, |t, state| snake.multipliers(t, state, &input));
    let at_rest = SnakeState { q: [0.1, 0.4, -0.2, 0.3, 0.5], ..SnakeState::default() };
    let wheels: [f64; 5] = snake.multipliers(0.0, &at_rest, &SnakeInput::default()).wheels;
    assert!(wheels.iter().all(|force| force.abs() < 1e-12));
}

/// A tractor with steered front wheels and two trailers, hitched behind the axles.
#[nonholonomic(
    base { rear[2], yaw, steer, hitch[2] }
    inputs { drive, steering }
    let along(a) = [cos(a), sin(a)];
    let across(a) = [-sin(a), cos(a)];
    let trailer = [yaw + hitch[0], yaw + hitch[0] + hitch[1]];
    let front = rear + wheelbase * along(yaw);
    let first = rear - behind[0] * along(yaw) - drawbar[0] * along(trailer[0]);
    let second = first - behind[1] * along(trailer[0]) - drawbar[1] * along(trailer[1]);
    lagrangian {
        kinetic(m[0], J[0], rear + b[0] * along(yaw), yaw) + kinetic(mf, Jf, front, yaw + steer)
        + kinetic(m[1], J[1], first + b[1] * along(trailer[0]), trailer[0])
        + kinetic(m[2], J[2], second + b[2] * along(trailer[1]), trailer[1])
    }
    constraints {
        axles: [
            dot(across(yaw), der(rear)), dot(across(yaw + steer), der(front)),
            dot(across(trailer[0]), der(first)), dot(across(trailer[1]), der(second))
        ] = 0;
    }
    forces { rear: drive * along(yaw); steer: steering; }
    formulation { projected }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct Tractor {
    wheelbase: f64,
    behind: [f64; 2],
    drawbar: [f64; 2],
    b: [f64; 3],
    m: [f64; 3],
    J: [f64; 3],
    mf: f64,
    Jf: f64,
}

#[test]
fn tractor() {
    let tractor = Tractor {
        wheelbase: 2.4,
        behind: [0.8, 0.5],
        drawbar: [3.0, 2.6],
        b: [0.9, 0.3, 0.2],
        m: [3200.0, 1800.0, 1500.0],
        J: [4100.0, 2600.0, 2100.0],
        mf: 220.0,
        Jf: 14.0,
    };
    let input = TractorInput { drive: 5000.0, steering: 30.0 };
    check_with_multipliers("tractor", &tractor, input, |t, state| tractor.multipliers(t, state, &input));
}

/// A satellite with three reaction wheels and a boom that bends in two modes, seen as eight pieces.
#[nonholonomic(
    base { p[3], yaw, pitch, roll, wheel[3], bend[2] }
    inputs { torque[3] }
    let R = rot_z(yaw) * rot_y(pitch) * rot_x(roll);
    let shape(s) = [1 - cos(pi / 2 * s), 1 - cos(3 * pi / 2 * s)];
    let boom(s) = p + R * [root + length * s, dot(shape(s), bend), 0];
    lagrangian {
        kinetic(m, I, p, R) + sum(i in 1..9: kinetic(mb / 8, boom(i / 8)))
        + kinetic(mw, [Cw, Aw, Aw], p + R * [d, 0, 0], R * rot_x(wheel[0]))
        + kinetic(mw, [Aw, Cw, Aw], p + R * [0, d, 0], R * rot_y(wheel[1]))
        + kinetic(mw, [Aw, Aw, Cw], p + R * [0, 0, d], R * rot_z(wheel[2]))
        - dot(k, [bend[0]^2, bend[1]^2]) / 2
    }
    forces { wheel: torque; bend: [-c[0] * der(bend[0]), -c[1] * der(bend[1])]; }
)]
#[derive(Clone, Copy, Debug)]
struct Satellite {
    m: f64,
    #[nh(symmetric)]
    I: [[f64; 3]; 3],
    mb: f64,
    root: f64,
    length: f64,
    mw: f64,
    Aw: f64,
    Cw: f64,
    d: f64,
    k: [f64; 2],
    c: [f64; 2],
}

#[test]
fn satellite_with_boom() {
    let satellite = Satellite {
        m: 120.0,
        I: [[25.0, 1.5, -0.8], [1.5, 32.0, 0.6], [-0.8, 0.6, 28.0]],
        mb: 6.0,
        root: 0.6,
        length: 4.0,
        mw: 3.0,
        Aw: 0.012,
        Cw: 0.02,
        d: 0.25,
        k: [5.0, 180.0],
        c: [0.05, 0.3],
    };
    check("satellite_with_boom", &satellite, SatelliteInput { torque: [0.02, -0.03, 0.01] });
}

/// A car on springs: wheels that turn about kingpins, and a rack that turns them by two tie rods.
#[nonholonomic(
    base { p[3], yaw, pitch, roll, travel[4], spin[4], steer[2], rack }
    inputs { push, drive }
    let R = rot_z(yaw) * rot_y(pitch) * rot_x(roll);
    let side = [1, -1, 1, -1];
    let mount[i in 0..2] = [a, side[i] * w, -h + travel[i]];
    let hub = [mount[0], mount[1], [-b, w, -h + travel[2]], [-b, -w, -h + travel[3]]];
    let turned(angle) = rot([-sin(caster), 0, cos(caster)], angle);
    let wheel(i, angle) = R * turned(angle) * rot_y(spin[i]);
    let rod[i in 0..2] = mount[i] + turned(steer[i]) * [-arm, -side[i] * inset, 0] - [a - arm, side[i] * reach + rack, -h];
    let centre[i in 0..4] = p + R * hub[i];
    let slip(i, angle) = velocity_at(centre[i], wheel(i, angle), centre[i] - [0, 0, r])[0..2];
    let slips = [slip(0, steer[0]), slip(1, steer[1]), slip(2, 0), slip(3, 0)];
    let loss = cs / 2 * dot(der(travel), der(travel)) + ct / 2 * sum(i in 0..4: dot(slips[i], slips[i]));
    lagrangian {
        kinetic(m, I, p, R) + sum(i in 0..2: kinetic(mw, [A, C, A], centre[i], wheel(i, steer[i]))
        + kinetic(mw, [A, C, A], centre[i + 2], wheel(i + 2, 0))) + mr / 2 * der(rack)^2
        - m * g * p[2] - sum(i in 0..4: mw * g * centre[i][2] + kt / 2 * (centre[i][2] - r)^2 + ks / 2 * travel[i]^2)
    }
    holonomic { for i in 0..2 { tie_rods: dot(rod[i], rod[i]) = rod_length^2; } }
    forces {
        p: -diff(loss, der(p));
        yaw: -diff(loss, der(yaw));
        pitch: -diff(loss, der(pitch));
        roll: -diff(loss, der(roll));
        travel: -diff(loss, der(travel));
        spin: [0, 0, drive, drive] - diff(loss, der(spin));
        steer: -diff(loss, der(steer));
        rack: push;
    }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct Car {
    m: f64,
    I: [f64; 3],
    a: f64,
    b: f64,
    w: f64,
    h: f64,
    g: f64,
    caster: f64,
    arm: f64,
    inset: f64,
    reach: f64,
    rod_length: f64,
    mw: f64,
    A: f64,
    C: f64,
    r: f64,
    mr: f64,
    ks: f64,
    cs: f64,
    kt: f64,
    ct: f64,
}

#[test]
fn car() {
    let car = Car {
        m: 1200.0,
        I: [400.0, 1500.0, 1700.0],
        a: 1.2,
        b: 1.4,
        w: 0.75,
        h: 0.25,
        g: 9.81,
        caster: 0.1,
        arm: 0.15,
        inset: 0.05,
        reach: 0.4,
        rod_length: 0.3,
        mw: 30.0,
        A: 0.7,
        C: 1.1,
        r: 0.31,
        mr: 4.0,
        ks: 25_000.0,
        cs: 1800.0,
        kt: 180_000.0,
        ct: 9000.0,
    };
    let input = CarInput { push: 150.0, drive: 220.0 };
    check_with_multipliers("car", &car, input, |t, state| car.multipliers(t, state, &input));
}

/// An arm with six joints on a platform with four wheels whose rollers stand at 45 degrees.
#[nonholonomic(
    base { x, y, yaw, wheel[4], q[6] }
    inputs { drive[4], torque[6] }
    let P = rot_z(yaw);
    let corner = [[a, b, r], [a, -b, r], [-a, b, r], [-a, -b, r]];
    let hub[k in 0..4] = [x, y, 0] + P * corner[k];
    let slant = [1, -1, -1, 1];
    let R1 = P * rot_z(q[0]);
    let R2 = R1 * rot_y(q[1]);
    let R3 = R2 * rot_y(q[2]);
    let R4 = R3 * rot_x(q[3]);
    let R5 = R4 * rot_y(q[4]);
    let R6 = R5 * rot_x(q[5]);
    let shoulder = [x, y, h];
    let elbow = shoulder + R2 * [0, 0, l[0]];
    let wrist = elbow + R3 * [l[1], 0, 0];
    let link = [
        shoulder, shoulder + R2 * [0, 0, l[0] / 2], elbow + R3 * [l[1] / 4, 0, 0],
        elbow + R4 * [3 * l[1] / 4, 0, 0], wrist, wrist + R6 * [l[2], 0, 0]
    ];
    lagrangian {
        kinetic(M, [0, 0, Jp], [x, y, r], P) + sum(k in 0..4: kinetic(mw, [Aw, Cw, Aw], hub[k], P * rot_y(wheel[k])))
        + kinetic(m[0], I[0], link[0], R1) + kinetic(m[1], I[1], link[1], R2) + kinetic(m[2], I[2], link[2], R3)
        + kinetic(m[3], I[3], link[3], R4) + kinetic(m[4], I[4], link[4], R5) + kinetic(m[5], I[5], link[5], R6)
        - g * sum(k in 0..6: m[k] * link[k][2])
    }
    constraints {
        for k in 0..4 {
            rollers: dot(P * [1, slant[k], 0], velocity_at(hub[k], P * rot_y(wheel[k]), hub[k] - [0, 0, r])) = 0;
        }
    }
    forces { wheel: drive; q: torque; }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct ArmOnPlatform {
    M: f64,
    Jp: f64,
    a: f64,
    b: f64,
    r: f64,
    mw: f64,
    Aw: f64,
    Cw: f64,
    h: f64,
    l: [f64; 3],
    m: [f64; 6],
    I: [[f64; 3]; 6],
    g: f64,
}

#[test]
fn arm_on_platform() {
    let arm = ArmOnPlatform {
        M: 60.0,
        Jp: 4.5,
        a: 0.35,
        b: 0.25,
        r: 0.1,
        mw: 2.5,
        Aw: 0.009,
        Cw: 0.014,
        h: 0.5,
        l: [0.5, 0.45, 0.12],
        m: [6.0, 8.0, 4.0, 2.5, 1.5, 0.8],
        I: [
            [0.091, 0.092, 0.093],
            [0.081, 0.082, 0.083],
            [0.071, 0.072, 0.073],
            [0.061, 0.062, 0.063],
            [0.051, 0.052, 0.053],
            [0.041, 0.042, 0.043],
        ],
        g: 9.81,
    };
    let input =
        ArmOnPlatformInput { drive: [1.5, -0.5, 0.8, 1.1], torque: [2.0, 30.0, 12.0, 0.7, -1.2, 0.3] };
    check_with_multipliers("arm_on_platform", &arm, input, |t, state| arm.multipliers(t, state, &input));
}
