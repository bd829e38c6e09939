//! A control loop as on a microcontroller: single precision, no standard library, no heap.
#![no_std]
#![deny(missing_docs, warnings)]

pub mod words;

use nonholonomic::prelude::*;

/// A rigid body on a plane, carried by a knife edge.
#[nonholonomic(
    base   { theta, x, y }
    basis  { omega, v1, v2 }
    anchor {
        der(theta) = omega;
        der(x) = v1 * cos(theta) - v2 * sin(theta);
        der(y) = v1 * sin(theta) + v2 * cos(theta);
    }
    lagrangian  { J / 2 * omega^2 + m / 2 * (v1^2 + (v2 + a * omega)^2) }
    constraints { edge: v2 = 0; }
    forces      { omega: torque; }
    inputs      { torque }
    emit        { jacobian, prepared, multipliers }
)]
#[derive(Clone, Copy, Debug)]
pub struct Sleigh {
    /// Mass.
    pub m: f32,
    /// Moment of inertia about the centre of mass.
    pub J: f32,
    /// Centre of mass ahead of the contact point.
    pub a: f32,
}

/// One tick of the loop: steers towards heading 0 and returns the state at its end.
#[must_use]
pub fn tick(sleigh: &Sleigh, t: f32, state: &SleighState) -> SleighState {
    let input = SleighInput { torque: -2.0 * state.theta - state.omega };
    Rk4::step(sleigh, t, 0.01, state, &input)
}

/// The same system in coordinates of the plane, where the state keeps all velocities.
#[nonholonomic(
    base { theta, x, y }
    lagrangian  { J / 2 * der(theta)^2 + m / 2 * (der(x)^2 + der(y)^2) }
    constraints { cos(theta) * der(y) - sin(theta) * der(x) = 0; }
)]
#[derive(Clone, Copy, Debug)]
pub struct SleighOnThePlane {
    /// Mass.
    pub m: f64,
    /// Moment of inertia about the centre of mass.
    pub J: f64,
}

/// Integrates for a while, back on the constraint after every step.
///
/// # Errors
/// As the integrator's.
pub fn run(sleigh: SleighOnThePlane, start: SleighOnThePlaneState) -> Result<f64, IntegrationError> {
    let mut sim = Integrator::new(sleigh, Projected::new(Dopri5::new(), 1), 0.0, start);
    sim.advance_to(1.0)?;
    Ok(sleigh.energy(sim.time(), sim.state()))
}
