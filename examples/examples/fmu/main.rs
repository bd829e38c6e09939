//! A declared machine as a functional mock-up unit: FMI 2.0, model exchange.
//!
//! `cargo run --release --example fmu`
//!
//! leaves the folder `target/fmu/robot`: the model description, and C without dependencies – the functions of
//! `emit { c }`, and `fmi2.c`, which calls them by the interface's names. `.ci/fmu` compiles it, zips it, and compares its
//! motion with the one that is printed here. See README.md beside this file.

use std::error::Error;
use std::fs;
use std::path::Path;

use nonholonomic::prelude::*;

mod unit;
use unit::Unit;

/// A robot on two driven wheels, with its centre of mass ahead of the axle.
#[nonholonomic(
    base  { x, y, theta }
    basis { v, side, omega }
    anchor {
        der(x) = v * cos(theta) - side * sin(theta);
        der(y) = v * sin(theta) + side * cos(theta);
        der(theta) = omega;
    }
    lagrangian  { m / 2 * (v^2 + (side + a * omega)^2) + J / 2 * omega^2 }
    constraints { blade: side = 0; }
    inputs { torque_right, torque_left }
    forces { v: (torque_right + torque_left) / r - c * v; omega: b * (torque_right - torque_left) / r; }
    assume { m > 0; J > 0; r > 0; }
    units  { x, y, a, b, r = m; theta = rad; m = kg; J = kg m^2; torque_right, torque_left = N m; blade = N; }
    emit   { c }
)]
#[derive(Clone, Copy, Debug)]
struct Robot {
    m: f64,
    J: f64,
    /// The centre of mass is so far ahead of the axle.
    a: f64,
    /// Half the axle.
    b: f64,
    /// The radius of the wheels.
    r: f64,
    /// Drag.
    c: f64,
}

/// How long the robot drives (s).
const END: f64 = 5.0;

fn main() -> Result<(), Box<dyn Error>> {
    let robot = Robot { m: 5.0, J: 0.1, a: 0.08, b: 0.15, r: 0.05, c: 0.4 };
    let start = RobotState { v: 0.3, ..RobotState::default() };
    let input = RobotInput { torque_right: 0.06, torque_left: 0.05 };

    let unit = Unit {
        name: "Robot",
        functions: Robot::C99,
        parameters: &[robot.m, robot.J, robot.a, robot.b, robot.r, robot.c],
        start: &start.to_array(),
        inputs: &[input.torque_right, input.torque_left],
    };
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../target/fmu/robot");
    fs::create_dir_all(folder.join("sources"))?;
    fs::write(folder.join("modelDescription.xml"), unit.description())?;
    fs::write(folder.join("sources/model.h"), unit.header())?;
    fs::write(folder.join("sources/model.c"), unit.functions)?;
    fs::write(folder.join("sources/fmi2.c"), include_str!("fmi2.c"))?;

    let mut sim = Integrator::new(robot, Dop853::new().rtol(1e-12).atol(1e-12), 0.0, start);
    sim.set_input(input);
    sim.advance_to(END)?;
    for (name, value) in RobotState::names().iter().zip(sim.state().to_array()) {
        println!("{name} {value:.15e}");
    }
    println!("energy {:.15e}", robot.energy(END, sim.state()));
    Ok(())
}
