//! The benchmark bicycle declared by where its bodies are. Accelerations, energies and multipliers agree with numbers of
//! `reference/machines.py`, which come of the equations of Newton and Euler with differences at 200 digits.
#![allow(non_snake_case, reason = "parameters are written as in mechanics: I")]

#[path = "more_systems/reference.rs"]
mod reference;

use nonholonomic::prelude::*;
use reference::check_with_multipliers;

/// The bicycle of Meijaard, Papadopoulos, Ruina and Schwab (2007): x forwards, z down, wheels that stand on the ground.
#[nonholonomic(
    base { x, y, z, yaw, lean, pitch, steer, turn[2] }
    let chassis = rot_z(yaw) * rot_x(lean) * rot_y(pitch);
    let fork = chassis * rot([sin(tilt), 0, cos(tilt)], steer);
    let rear_wheel = chassis * rot_y(turn[0]);
    let front_wheel = fork * rot_y(turn[1]);
    let rear = [x, y, z];
    let head = rear + chassis * [w + c, 0, rR];
    let front = head + fork * [-c, 0, -rF];
    let frame = rear + chassis * [xB, 0, zB + rR];
    let handlebar = head + fork * [xH - w - c, 0, zH];
    let down(R) = [0, 0, 1] - R[2][1] * R * [0, 1, 0];
    let contact = [rear + rR * down(chassis) / norm(down(chassis)), front + rF * down(fork) / norm(down(fork))];
    lagrangian {
        kinetic(mR, IR, rear, rear_wheel) + kinetic(mF, IF, front, front_wheel)
        + kinetic(mB, IB, frame, chassis) + kinetic(mH, IH, handlebar, fork)
        + g * (mR * rear + mF * front + mB * frame + mH * handlebar)[2]
    }
    holonomic { ground: [contact[0][2], contact[1][2]] = 0; }
    constraints {
        rear_rolls: velocity_at(rear, rear_wheel, contact[0])[0..2] = 0;
        front_rolls: velocity_at(front, front_wheel, contact[1])[0..2] = 0;
    }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct Bicycle {
    w: f64,
    c: f64,
    tilt: f64,
    g: f64,
    rR: f64,
    rF: f64,
    mR: f64,
    IR: [f64; 3],
    mF: f64,
    IF: [f64; 3],
    mB: f64,
    xB: f64,
    zB: f64,
    #[nh(symmetric)]
    IB: [[f64; 3]; 3],
    mH: f64,
    xH: f64,
    zH: f64,
    #[nh(symmetric)]
    IH: [[f64; 3]; 3],
}

const BICYCLE: Bicycle = Bicycle {
    w: 1.02,
    c: 0.08,
    tilt: 0.314_159_265_358_979_3,
    g: 9.81,
    rR: 0.3,
    rF: 0.35,
    mR: 2.0,
    IR: [0.0603, 0.12, 0.0603],
    mF: 3.0,
    IF: [0.1405, 0.28, 0.1405],
    mB: 85.0,
    xB: 0.3,
    zB: -0.9,
    IB: [[9.2, 0.0, 2.4], [0.0, 11.0, 0.0], [2.4, 0.0, 2.8]],
    mH: 4.0,
    xH: 0.9,
    zH: -0.7,
    IH: [[0.058_92, 0.0, -0.007_56], [0.0, 0.06, 0.0], [-0.007_56, 0.0, 0.007_08]],
};

#[test]
fn bicycle() {
    let multipliers = |t, state: &BicycleState| BICYCLE.multipliers(t, state, &());
    check_with_multipliers("bicycle_by_geometry", &BICYCLE, (), multipliers);
}

#[test]
fn symmetric_matrices_are_symmetric() {
    let mut bicycle = BICYCLE;
    bicycle.IB[2][0] += 1e-12;
    let error = bicycle.validate().expect_err("2.4 and another number");
    assert_eq!(
        error.to_string(),
        "the parameter `IB[2][0]` is 2.400000000001, but the matrix is declared symmetric, and `IB[0][2]` is another \
         number: give both the same"
    );
    // four roundings are none
    bicycle.IB[2][0] = 2.4 * (1.0 + 2.0 * f64::EPSILON);
    assert!(bicycle.validate().is_ok());
}

#[test]
fn the_multipliers_have_the_shapes_of_the_equations() {
    let BicycleMultipliers { ground, rear_rolls, front_rolls } =
        BICYCLE.multipliers(0.0, &BicycleState::default(), &());
    let all: [[f64; 2]; 3] = [ground, rear_rolls, front_rolls];
    // the wheels carry the weight, and nothing pushes
    assert!((all[0][0] + all[0][1] + 94.0 * 9.81).abs() < 1e-9, "{all:?}");
    assert!(all[1].iter().chain(&all[2]).all(|force| force.abs() < 1e-9), "{all:?}");
}
