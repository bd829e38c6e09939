//! A run by every method, and a tick of every building block of a controller: the bits of what comes out.

use nalgebra::{Matrix1, Matrix4, RowVector4, SMatrix, Vector1, Vector4, Vector5};
use nh_runtime::control::{
    Estimate, Ilqr, Quadratic, Regulator, Sampled, Unscented, held_noise, zero_order_hold,
};
use nh_runtime::methods::Method;
use nh_runtime::prelude::*;

use crate::systems::{
    Contact, ContactOnTq, ContactOnTqState, ContactState, Sleigh, SleighInput, SleighState, Suslov, SuslovState,
};

type System = Sleigh<f64>;

const SLEIGH: System = Sleigh { m: 1.0, J: 0.5, a: 0.3, b: 0.1, c: 0.02, J_w: 0.1 };
const START: [f64; 5] = [-0.4, 0.0, 0.0, 0.15, -1.0];

/// The bits of the state after five seconds.
fn run<M: Method<System>>(lines: &mut Vec<String>, name: &str, method: M) {
    let mut sim = Integrator::new(SLEIGH, method, 0.0, SleighState::from(START));
    sim.set_input(SleighInput { torque: 0.02 });
    match sim.advance_to(5.0) {
        Ok(()) => lines.push(line(name, &sim.state().to_array())),
        Err(error) => lines.push(format!("{name:18} {error}")),
    }
}

fn line(name: &str, numbers: &[f64]) -> String {
    let words: Vec<String> = numbers.iter().map(|x| format!("{:016x}", x.to_bits())).collect();
    format!("{name:18} {}", words.join(" "))
}

/// All of them, a line each.
pub(crate) fn all() -> Vec<String> {
    let lines = &mut Vec::new();
    run(lines, "Euler", Euler::new(0.02));
    run(lines, "Heun", Heun::new(0.02));
    run(lines, "Ralston", Ralston::new(0.02));
    run(lines, "Rk4", Rk4::new(0.02));
    run(lines, "Rk4, compensated", Rk4::new(0.02).compensated());
    run(lines, "Dopri5, fixed", Dopri5::fixed(0.02));
    run(lines, "Dop853, fixed", Dop853::fixed(0.02));
    run(lines, "Vern9, fixed", Vern9::fixed(0.02));
    run(lines, "ImplicitMidpoint", ImplicitMidpoint::new(0.02));
    run(lines, "GaussLegendre4", GaussLegendre4::new(0.02));
    run(lines, "GaussLegendre6", GaussLegendre6::new(0.02));
    run(lines, "Bs23", Bs23::new());
    run(lines, "Dopri5", Dopri5::new());
    run(lines, "Tsit5", Tsit5::new());
    run(lines, "Dop853", Dop853::new());
    run(lines, "Vern9", Vern9::new());
    run(lines, "Radau5", Radau5::new());
    run(lines, "Rodas5P", Rodas5P::new());
    if controls(lines).is_none() {
        lines.push("a building block has failed".into());
    }
    core::mem::take(lines)
}

fn controls(lines: &mut Vec<String>) -> Option<()> {
    let mut print = |name: &str, numbers: &[f64]| lines.push(line(name, numbers));
    let a = Matrix4::identity() * 0.9 + Matrix4::repeat(0.02);
    let b = Vector4::new(0.1, 0.2, 0.3, 0.4);
    let (one, r) = (Matrix4::identity(), Matrix1::new(2.0));
    let row = RowVector4::new(1.0, 0.0, 0.5, 0.0);
    let belief = Estimate { mean: Vector4::new(0.1, 0.0, 0.2, 0.0), covariance: one };
    let seen = Vector1::new(0.3);
    let (step, held) = zero_order_hold(&a, &b, 0.1).ok()?;
    print("hold", step.as_slice());
    print("held input", held.as_slice());
    print("noise", held_noise(&a, &one, 0.1).ok()?.as_slice());
    print("regulator", Regulator::stationary(&a, &b, &one, &r).ok()?.gain.as_slice());
    print("with cross", Regulator::stationary_with_cross(&a, &b, &one, &r, &b).ok()?.gain.as_slice());
    print("predicted", belief.predicted(a * belief.mean, &a, &one).ok()?.covariance.as_slice());
    print("corrected", belief.corrected(&seen, &row, &r).ok()?.estimate.covariance.as_slice());
    let filter = Unscented::default();
    let bent = |x: Vector4<f64>| (a * x).map(|x| x + 0.1 * x * x);
    print("points, predicted", filter.predicted(&belief, bent, &one).ok()?.covariance.as_slice());
    let points = filter.corrected(&belief, &seen, |x| row * bent(x), |a, b| a - b, &r).ok()?;
    print("points, corrected", points.estimate.covariance.as_slice());
    let model = Sampled { system: SLEIGH, start: 0.0, dt: 0.05 };
    let start = Vector5::from(START);
    let cost = Quadratic { goal: Vector5::zeros(), state: start.abs(), input: seen, end: start.abs() };
    let mut plan = Ilqr::<f64, 5, 1, 20>::new(SMatrix::zeros());
    plan.solve(&model, &cost, &start, 1e-9, 10).ok()?;
    print("plan", &plan.inputs().map(|u| u[0]));
    Some(())
}
