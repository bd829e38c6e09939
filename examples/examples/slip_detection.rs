//! When does a rolling or sliding contact give way?
//!
//! `cargo run --release --example slip_detection`
//!
//! A nonholonomic constraint is an idealisation: the force that keeps it up has to be there. Here a
//! skate is driven along its blade and steered ever harder, until the ice would have to push sideways
//! with more than it can bear. The force is the multiplier of the constraint, as the macro derives
//! it; the instant is found within a step, on the dense output of the integrator.

use nh_runtime::prelude::*;

/// A skate on ice with a motor and a steering torque.
#[nonholonomic(
    base { theta, x, y }
    basis { omega, v, side }
    anchor {
        der(theta) = omega;
        der(x) = v * cos(theta) - side * sin(theta);
        der(y) = v * sin(theta) + side * cos(theta);
    }
    lagrangian  { J / 2 * omega^2 + m / 2 * (v^2 + (side + a * omega)^2) }
    constraints { blade: side = 0; }
    forces      { v: thrust - drag * v; omega: torque - friction * omega; }
    inputs      { thrust, torque }
    assume      { m > 0; J > 0; }
    emit        { multipliers }
)]
#[derive(Clone, Copy, Debug)]
pub struct Skate {
    /// Mass (kg).
    pub m: f64,
    /// Moment of inertia about the centre of mass (kg m²).
    pub J: f64,
    /// Centre of mass ahead of the blade (m).
    pub a: f64,
    /// Resistance along the blade (kg/s).
    pub drag: f64,
    /// Resistance against turning (N m s).
    pub friction: f64,
}

/// The largest sideways force that the ice bears (N).
const LIMIT: f64 = 165.0;

fn main() -> Result<(), IntegrationError> {
    let skate = Skate { m: 70.0, J: 2.0, a: 0.05, drag: 12.0, friction: 6.0 };
    let side_force = |sim: &Integrator<Skate, Dopri5<f64>>, t: f64| {
        sim.at(t).map(|state| skate.multipliers(t, &state, sim.input()).blade)
    };
    let start = SkateState { v: 2.0, ..SkateState::default() };
    let mut sim = Integrator::new(skate, Dopri5::new().rtol(1e-10), 0.0, start);
    println!("     t    torque         v     omega   side force (N)");
    for second in 0..60 {
        // the torque grows from second to second
        let input = SkateInput { thrust: 30.0, torque: 2.5 * f64::from(second) };
        sim.set_input(input);
        let (t, state) = (sim.time(), sim.state());
        let force = skate.multipliers(t, state, &input).blade;
        println!("{t:6.1} {:9.2} {:9.4} {:9.4} {force:16.3}", input.torque, state.v, state.omega);
        while sim.time() < f64::from(second + 1) {
            let before = sim.time();
            sim.step_towards(f64::from(second + 1))?;
            if side_force(&sim, sim.time())?.abs() < LIMIT {
                continue;
            }
            // bisection between the ends of this step
            let (mut holds, mut slips) = (before, sim.time());
            while slips - holds > 1e-12 * slips {
                let middle = f64::midpoint(holds, slips);
                if side_force(&sim, middle)?.abs() < LIMIT { holds = middle } else { slips = middle }
            }
            let state = sim.at(slips)?;
            println!("\nthe blade slips at t = {slips:.9} s, at x = {:.4} m, y = {:.4} m,", state.x, state.y);
            println!("where v = {:.4} m/s and the ice would have to bear {LIMIT} N", state.v);
            return Ok(());
        }
    }
    println!("\nthe blade holds");
    Ok(())
}
