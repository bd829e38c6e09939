//! Derivatives of the motions of declared systems, mathematics (51)–(53): generated Jacobians against whole integrations in
//! numbers that carry derivatives, and what becomes of returns to position constraints.
#![allow(non_snake_case, reason = "parameters are written as in mechanics")]

use nonholonomic::Jet;
use nonholonomic::nalgebra::SMatrix;
use nonholonomic::prelude::*;
use nonholonomic::sensitivity::{
    Adjoint, By, Checkpoint, ColumnTolerance, Objective, SensitivityError, Slope, Variational,
};

/// A sleigh with a motor whose current has a state of its own.
#[nonholonomic(
    base   { theta, x, y }
    basis  { omega, v1, v2 }
    anchor {
        der(theta) = omega;
        der(x) = v1 * cos(theta) - v2 * sin(theta);
        der(y) = v1 * sin(theta) + v2 * cos(theta);
    }
    lagrangian  { J / 2 * omega^2 + m / 2 * (v1^2 + (v2 + a * omega)^2) }
    constraints { v2 = 0; }
    inputs      { volts }
    auxiliary   { der(current) = (volts - k * omega - R * current) / L; }
    forces      { omega: k * current - c * omega; }
    emit        { jacobian, parameter_jacobian }
)]
#[derive(Clone, Copy, Debug)]
struct Driven<T> {
    m: T,
    J: T,
    a: T,
    c: T,
    k: T,
    R: T,
    L: T,
}

fn driven<T>([m, J, a, c, k, R, L]: [T; 7]) -> Driven<T> {
    Driven { m, J, a, c, k, R, L }
}

const NUMBERS: [f64; 7] = [2.0, 0.4, 0.15, 0.2, 0.6, 1.5, 0.1];
const START: [f64; 6] = [0.1, 0.0, 0.3, 0.7, 0.9, -0.2];
const VOLTS: f64 = 1.2;

/// Every start, the input, every parameter: fourteen columns of generated code.
#[test]
fn generated_columns_are_the_derivatives_of_the_steps() {
    type J = Jet<f64, 14>;
    let columns: [By; 14] = std::array::from_fn(|k| match k {
        0..6 => By::Start(k),
        6 => By::Input(0),
        _ => By::Parameter(k - 7),
    });
    let motion = Variational::new(driven(NUMBERS), columns)
        .by_parameters(|s: &Driven<f64>, t, x, u| s.parameter_jacobian(t, x, u));
    let start = motion.start(&DrivenState::from(START)).unwrap();
    let mut sim = Integrator::new(motion, Dop853::fixed(0.1), 0.0, start);
    sim.set_input(DrivenInput { volts: VOLTS });
    let all: [J; 14] = J::variables(std::array::from_fn(|k| match k {
        0..6 => START[k],
        6 => VOLTS,
        _ => NUMBERS[k - 7],
    }));
    let system = driven(std::array::from_fn(|k| all[k + 7]));
    let mut state = DrivenState::from(std::array::from_fn::<J, 6, _>(|k| all[k]));
    let input = DrivenInput { volts: all[6] };
    for step in 0..40 {
        let t = J::constant(0.1 * f64::from(step));
        state = Dop853::step(&system, t, J::constant(0.1), &state, &input);
        sim.step().unwrap();
    }
    for (k, column) in sim.state().columns.iter().enumerate() {
        for (found, expected) in column.to_array().iter().zip(state.to_array()) {
            let expected = expected.by[k];
            assert!((found - expected).abs() < 1e-12 * expected.abs().max(1.0), "{k}: {found} {expected}");
        }
    }
}

/// A pendulum on a rope, by its place, with all velocities in the state.
#[nonholonomic(
    base { x, y }
    holonomic { rope: x^2 + y^2 = l^2; }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) - m * g * y }
    emit { jacobian, return_jacobian, parameter_jacobian }
)]
#[derive(Clone, Copy, Debug)]
struct Rope<T> {
    m: T,
    l: T,
    g: T,
}

/// The same by its angle.
#[nonholonomic(
    base { angle }
    lagrangian { m / 2 * l^2 * der(angle)^2 + m * g * l * cos(angle) }
    emit { jacobian, parameter_jacobian }
)]
#[derive(Clone, Copy, Debug)]
struct Angle {
    m: f64,
    l: f64,
    g: f64,
}

const ROPE: Rope<f64> = Rope { m: 2.0, l: 0.7, g: 9.81 };
const BEGUN: [f64; 2] = [0.8, 1.1];

/// Place and velocity for an angle and its rate, in any numbers.
fn placed<T: Scalar>(l: T, angle: T, rate: T) -> RopeState<T> {
    let (sin, cos) = angle.sin_cos();
    RopeState { x: l * sin, y: -l * cos, x_dot: l * rate * cos, y_dot: l * rate * sin }
}

/// The derivatives of place and velocity at t = 1.5 by angle, rate and length at the start, from the other declaration.
fn by_the_angle() -> [[f64; 4]; 3] {
    let angle = Angle { m: ROPE.m, l: ROPE.l, g: ROPE.g };
    let motion = Variational::new(angle, [By::Start(0), By::Start(1), By::Parameter(1)])
        .by_parameters(|s: &Angle, t, x, u| s.parameter_jacobian(t, x, u));
    let start = motion.start(&AngleState::from(BEGUN)).unwrap();
    let method = Dop853::new().tolerance(ColumnTolerance::new(1e-13, 1e-13));
    let mut sim = Integrator::new(motion, method, 0.0, start);
    sim.advance_to(1.5).unwrap();
    let end = sim.state();
    std::array::from_fn(|k| {
        let jet = |value: f64, slope: f64| Jet::<f64, 1> { by: [slope], ..Jet::constant(value) };
        let l = jet(ROPE.l, if k == 2 { 1.0 } else { 0.0 });
        let column = end.columns[k];
        let placed =
            placed(l, jet(end.state.angle, column.angle), jet(end.state.angle_dot, column.angle_dot));
        placed.to_array().map(|component| component.by[0])
    })
}

/// Returned states with columns beside them: the exact motion, to the tolerance. The columns start along the rope's
/// circles, and stay along them.
#[test]
fn columns_of_a_closed_loop() {
    let motion = Variational::new(ROPE, [By::Start(0), By::Start(0), By::Parameter(1)])
        .by_parameters(|s: &Rope<f64>, t, x, u| s.parameter_jacobian(t, x, u));
    let [l, angle, rate] = Jet::<f64, 3>::variables([ROPE.l, BEGUN[0], BEGUN[1]]);
    let begun = placed(l, angle, rate).to_array();
    let mut start = motion.start(&RopeState::from(begun.map(|jet| jet.value))).unwrap();
    for (column, k) in start.columns.iter_mut().zip([1, 2, 0]) {
        *column = RopeState::from(begun.map(|jet| jet.by[k]));
    }
    let method = Dop853::new().tolerance(ColumnTolerance::new(1e-11, 1e-11));
    let mut sim = Integrator::new(motion, method, 0.0, start);
    sim.advance_to(1.5).unwrap();
    assert!(sim.statistics().projections > 0);
    let end = sim.state().state;
    assert!((end.x * end.x + end.y * end.y - 0.49).abs() < 1e-14);
    for (k, (column, expected)) in sim.state().columns.iter().zip(by_the_angle()).enumerate() {
        for (found, expected) in column.to_array().iter().zip(expected) {
            assert!((found - expected).abs() < 1e-7, "column {k}: {found} {expected}");
        }
        let radial = 2.0 * (end.x * column.x + end.y * column.y) - if k == 2 { 1.4 } else { 0.0 };
        assert!(radial.abs() < 1e-8, "column {k}: {radial:e}");
    }
}

/// Steps in jets contain the return: their columns are tangent to the loop to round-off of the return, and converge.
#[test]
fn steps_in_jets_contain_the_return() {
    type J = Jet<f64, 3>;
    let [l, angle, rate] = J::variables([ROPE.l, BEGUN[0], BEGUN[1]]);
    let system = Rope { m: J::constant(ROPE.m), l, g: J::constant(ROPE.g) };
    let mut state = placed(l, angle, rate);
    for k in 0..300 {
        state = Dop853::step(&system, J::constant(0.005 * f64::from(k)), J::constant(0.005), &state, &());
    }
    let off = state.x * state.x + state.y * state.y - l * l;
    let along = state.x * state.x_dot + state.y * state.y_dot;
    for residual in off.by.iter().chain(&along.by).chain([&off.value, &along.value]) {
        assert!(residual.abs() < 1e-13, "{residual:e}");
    }
    for (k, expected) in [(1, 0), (2, 1), (0, 2)] {
        for (found, expected) in state.to_array().iter().zip(by_the_angle()[expected]) {
            assert!((found.by[k] - expected).abs() < 1e-10, "{} {expected}", found.by[k]);
        }
    }
}

/// Second derivatives of a return, from on the constraint and from beside it: it leads along the rope, to x l/r.
#[test]
fn returns_in_jets_of_jets_have_second_derivatives() {
    type Twice = Jet<Jet<f64, 5>, 5>;
    let variable = |index: usize, value: f64| {
        let mut inner = Jet::<f64, 5>::constant(value);
        inner.by[index] = 1.0;
        let mut outer = Twice::constant(inner);
        outer.by[index] = Jet::constant(1.0);
        outer
    };
    let number = |value: f64| Twice::constant(Jet::constant(value));
    for off in [0.0, 1e-15, 1e-9, 1e-4, 0.1] {
        let [l, x, y] = [variable(0, 1.0), variable(1, 0.6 * (1.0 + off)), variable(2, -0.8 * (1.0 + off))];
        let [u, v] = [variable(3, 0.8), variable(4, 0.6 + off)];
        let system = Rope { m: number(1.0), l, g: number(9.81) };
        let mut state = RopeState { x, y, x_dot: u, y_dot: v };
        system.return_to_positions(number(0.0), &mut state).unwrap();
        let r = (x * x + y * y).sqrt();
        let along = (u * y - v * x) / (r * r);
        let expected = [x * l / r, y * l / r, along * y, -along * x];
        for (found, expected) in state.to_array().iter().zip(expected) {
            let all = found.by.iter().zip(&expected.by).flat_map(|(a, b)| a.by.iter().zip(&b.by));
            for (found, expected) in all.chain(found.value.by.iter().zip(&expected.value.by)) {
                assert!((found - expected).abs() < 1e-13, "{off}: {found} {expected}");
            }
        }
    }
}

/// The same without the derivative of its return.
#[nonholonomic(
    base { x, y }
    holonomic { rope: x^2 + y^2 = l^2; }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) - m * g * y }
    emit { jacobian }
)]
#[derive(Clone, Copy, Debug)]
struct Plain {
    m: f64,
    l: f64,
    g: f64,
}

/// Nobody is given the derivative of another step.
#[test]
fn steps_with_a_return_that_is_not_differentiated_have_no_derivative() {
    let plain = Plain { m: 1.0, l: 1.0, g: 9.81 };
    let start = PlainState { x: 0.6, y: -0.8, x_dot: 0.8, y_dot: 0.6 };
    let step = Rk4::linearized_step(&plain, 0.0, 0.1, &start, &());
    let alone = Rk4::step(&plain, 0.0, 0.1, &start, &());
    for (found, alone) in step.state.to_array().iter().zip(alone.to_array()) {
        assert!((found - alone).abs() < 1e-15, "{found} {alone}");
    }
    assert!(step.by_state.iter().all(|entry| entry.is_nan()));
    let step = ImplicitMidpoint::linearized_step(&plain, 0.0, 0.1, &start, &()).unwrap();
    assert!(step.by_state.iter().all(|entry| entry.is_nan()));
    let motion = Variational::new(plain, [By::Start(0)]);
    let mut columns = motion.start(&start).unwrap().columns;
    let mut sim = Integrator::new(plain, Radau5::new(), 0.0, start);
    assert_eq!(motion.advance(&mut sim, 1.0, &mut columns), Err(SensitivityError::Returned));
}

/// The constraints depend on parameters: derivatives by these that would leave the return out are refused, and those by the
/// start contain it.
#[test]
fn steps_with_returns_are_differentiated_by_states() {
    struct Last;
    impl Objective<Rope<f64>, 4, 0> for Last {
        fn end(&self, _t: f64, x: &RopeState<f64>) -> Slope<f64, 4, 0> {
            Slope { value: x.x, by_state: [1.0, 0.0, 0.0, 0.0], by_input: [] }
        }
    }
    let start = placed(ROPE.l, BEGUN[0], BEGUN[1]);
    let mut places = [Checkpoint::room(start); 2];
    let adjoint = Adjoint::new(&ROPE, Rk4::new(0.01));
    let gradient = adjoint.gradient(0.0, &start, &[(); 4], &Last, &mut places, &mut [[]; 4]).unwrap();
    let by_parameters = adjoint.by_parameters(|s: &Rope<f64>, t, x, u| s.parameter_jacobian(t, x, u));
    let refused = by_parameters.gradient(0.0, &start, &[(); 4], &Last, &mut places, &mut [[]; 4]);
    assert_eq!(refused.unwrap_err(), SensitivityError::Returned);
    let (mut state, mut row) = (start, SMatrix::<f64, 4, 4>::identity());
    for tick in 0..4 {
        let step = Rk4::linearized_step(&ROPE, 0.01 * f64::from(tick), 0.01, &state, &());
        (state, row) = (step.state, step.by_state * row);
    }
    for (forward, back) in row.row(0).iter().zip(gradient.by_start) {
        assert!((forward - back).abs() < 1e-14, "{forward} {back}");
    }
    let motion = Variational::new(ROPE, [By::Parameter(1)])
        .by_parameters(|s: &Rope<f64>, t, x, u| s.parameter_jacobian(t, x, u));
    let mut column = motion.start(&start).unwrap().columns;
    let mut sim = Integrator::new(ROPE, Radau5::new(), 0.0, start);
    assert_eq!(motion.advance(&mut sim, 1.0, &mut column), Err(SensitivityError::Returned));
    let mut free = Integrator::new(ROPE, Radau5::new(), 0.0, start).without_return();
    assert_eq!(motion.advance(&mut free, 0.1, &mut column), Ok(()));
}

/// A gradient of a declared system by its parameters, against forward columns.
#[test]
fn generated_adjoints() {
    struct Last;
    impl Objective<Driven<f64>, 6, 1> for Last {
        fn end(&self, _t: f64, x: &DrivenState<f64>) -> Slope<f64, 6, 1> {
            Slope { value: x.x * x.y, by_state: [0.0, x.y, x.x, 0.0, 0.0, 0.0], by_input: [0.0] }
        }
    }
    let system = driven(NUMBERS);
    let start = DrivenState::from(START);
    let mut places = [Checkpoint::room(start); 6];
    let mut by_inputs = [[0.0]; 80];
    let gradient = Adjoint::new(&system, Rk4::new(0.05))
        .by_parameters(|s: &Driven<f64>, t, x, u| s.parameter_jacobian(t, x, u))
        .gradient(0.0, &start, &[DrivenInput { volts: VOLTS }; 80], &Last, &mut places, &mut by_inputs)
        .unwrap();
    let motion = Variational::new(system, std::array::from_fn::<_, 7, _>(By::Parameter))
        .by_parameters(|s: &Driven<f64>, t, x, u| -> SMatrix<f64, 6, 7> { s.parameter_jacobian(t, x, u) });
    let mut sim = Integrator::new(motion, Rk4::new(0.05), 0.0, motion.start(&start).unwrap());
    sim.set_input(DrivenInput { volts: VOLTS });
    sim.advance_to(4.0).unwrap();
    let end = sim.state();
    for (found, column) in gradient.by_parameters.iter().zip(&end.columns) {
        let expected = end.state.x * column.y + end.state.y * column.x;
        assert!((found - expected).abs() < 1e-12 * expected.abs().max(1.0), "{found} {expected}");
    }
}
