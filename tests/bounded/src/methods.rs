//! A run by every method that takes any system, and a tick of every building block of a controller: the bits of what comes out.

use nalgebra::{Matrix1, Matrix4, RowVector4, SMatrix, Vector1, Vector4, Vector5};
use nonholonomic::control::{
    ControlError, Entry, Estimate, Ilqr, Quadratic, Regulator, Sampled, Unscented, held_noise,
    zero_order_hold,
};
use nonholonomic::methods::Method;
use nonholonomic::prelude::*;

use crate::bits::{Bits, line};
use crate::systems::{Sleigh, SleighInput, SleighState};

type System = Sleigh<f64>;

const SLEIGH: System = Sleigh { m: 1.0, J: 0.5, a: 0.3, b: 0.1, c: 0.02, J_w: 0.1 };

/// The same over any number.
#[allow(non_snake_case)] // the names of the parameters
fn sleigh<T: Scalar>() -> Sleigh<T> {
    let Sleigh { m, J, a, b, c, J_w } = SLEIGH;
    let [m, J, a, b, c, J_w] = [m, J, a, b, c, J_w].map(T::from_f64);
    Sleigh { m, J, J_w, a, b, c }
}

const START: [f64; 5] = [-0.4, 0.0, 0.0, 0.15, -1.0];

/// The bits of the state after five seconds.
fn run<M: Method<System>>(lines: &mut Vec<String>, name: &str, method: M) {
    let mut sim = Integrator::new(SLEIGH, method, 0.0, SleighState::from(START));
    sim.set_input(SleighInput { torque: 0.02 });
    match sim.advance_to(5.0) {
        Ok(()) => lines.push(line(name, &sim.state().to_array())),
        Err(error) => panic!("{name}: {error}"),
    }
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
    run(lines, "Auto", Auto::new());
    let done = (controls::<f64>(lines), controls::<f32>(lines));
    assert_eq!(done, (Ok(()), Ok(())));
    core::mem::take(lines)
}

/// A tick of every building block of a controller.
fn controls<T: Entry + Bits>(lines: &mut Vec<String>) -> Result<(), ControlError> {
    let mut print = |name: &str, numbers: &[T]| lines.push(line(name, numbers));
    let number = |x: f64| <T as Scalar>::from_f64(x);
    let a = Matrix4::identity() * number(0.9) + Matrix4::repeat(number(0.02));
    let b = Vector4::new(0.1, 0.2, 0.3, 0.4).map(number);
    let (one, r) = (Matrix4::identity(), Matrix1::new(number(2.0)));
    let row = RowVector4::new(1.0, 0.0, 0.5, 0.0).map(number);
    let belief = Estimate { mean: Vector4::new(0.1, 0.0, 0.2, 0.0).map(number), covariance: one };
    let seen = Vector1::new(number(0.3));
    let dt = number(0.1);
    let (step, held) = zero_order_hold(&a, &b, dt)?;
    print("hold", step.as_slice());
    print("held input", held.as_slice());
    print("noise", held_noise(&a, &one, dt)?.as_slice());
    print("regulator", Regulator::stationary(&a, &b, &one, &r)?.gain.as_slice());
    print("with cross", Regulator::stationary_with_cross(&a, &b, &one, &r, &b)?.gain.as_slice());
    print("before", Regulator::before(&one, &a, &b, &one, &r)?.gain.as_slice());
    print("predicted", belief.predicted(a * belief.mean, &a, &one)?.covariance.as_slice());
    print("corrected", belief.corrected(&seen, &row, &r)?.estimate.covariance.as_slice());
    let filter = Unscented::default();
    let bent = |x: Vector4<T>| (a * x).map(|x| x + dt * x * x);
    print("points, predicted", filter.predicted(&belief, bent, &one)?.covariance.as_slice());
    let points = filter.corrected(&belief, &seen, |x| row * bent(x), |a, b| a - b, &r)?;
    print("points, corrected", points.estimate.covariance.as_slice());
    let model = Sampled { system: sleigh::<T>(), start: number(0.0), dt: number(0.05) };
    let start = Vector5::from(START.map(number));
    let weight = start.map(Scalar::abs);
    let cost = Quadratic { goal: Vector5::zeros(), state: weight, input: seen, end: weight };
    let mut plan = Ilqr::<T, 5, 1, 20>::new(SMatrix::zeros());
    plan.solve(&model, &cost, &start, number(1e-4), 10)?;
    print("plan", &plan.inputs().map(|u| u[0]));
    Ok(())
}
