//! Emitted Jacobians against the emitted derivative of dual numbers: equal to round-off.

use nh_tests::dual::Dual;
use nh_tests::random::Random;
use nonholonomic::Dim;
use nonholonomic::prelude::*;

/// Adapted: a sleigh with friction, driven.
#[nonholonomic(
    base   { theta, x, y }
    basis  { omega, v1, v2 }
    anchor {
        der(theta) = omega;
        der(x) = v1 * cos(theta) - v2 * sin(theta);
        der(y) = v1 * sin(theta) + v2 * cos(theta);
    }
    lagrangian  { (J + m * a^2) / 2 * omega^2 + m / 2 * (v1^2 + v2^2) + m * a * omega * v2 }
    constraints { v2 = 0; }
    forces      { omega: torque - c * omega; v1: push * cos(theta) - c * v1 * abs(v1); }
    inputs      { torque, push }
    emit        { jacobian }
)]
#[derive(Clone, Copy, Debug)]
struct Sleigh<T> {
    m: T,
    J: T,
    a: T,
    c: T,
}

/// Projected, without inputs.
#[nonholonomic(
    base { theta, x, y }
    lagrangian {
        let xc = der(x) - a * sin(theta) * der(theta);
        let yc = der(y) + a * cos(theta) * der(theta);
        J / 2 * der(theta)^2 + m / 2 * (xc^2 + yc^2)
    }
    constraints { cos(theta) * der(y) - sin(theta) * der(x) = 0; }
    emit { jacobian }
)]
#[derive(Clone, Copy, Debug)]
struct SleighOnThePlane<T> {
    m: T,
    J: T,
    a: T,
}

/// Projected, on an embedded base, with an inertia matrix.
#[nonholonomic(
    base { g[3] }
    basis { w[3] }
    anchor {
        der(g[0]) = g[1] * w[2] - g[2] * w[1];
        der(g[1]) = g[2] * w[0] - g[0] * w[2];
        der(g[2]) = g[0] * w[1] - g[1] * w[0];
    }
    brackets so(3) { w[0], w[1], w[2] }
    lagrangian  { dot(w, I * w) / 2 - dot(c, g) }
    constraints { dot(g, w) = 0; }
    emit { jacobian }
)]
#[derive(Clone, Copy, Debug)]
struct Veselova<T> {
    I: [[T; 3]; 3],
    c: [T; 3],
}

/// A kinetic energy without sign in more velocities than have a closed form: solved with pivoting.
#[nonholonomic(
    base { q[5] }
    lagrangian {
        a / 2 * (der(q[0])^2 - der(q[1])^2 + der(q[2])^2 - der(q[3])^2 + der(q[4])^2)
            + cos(q[0]) * der(q[0]) * der(q[1]) + sin(q[1]) * der(q[2]) * der(q[3])
            + b * q[0] * der(q[1]) * der(q[4]) + der(q[3]) * der(q[0]) * q[2] / 3
            - dot(q, q) / 2
    }
    forces { q[4]: u; }
    inputs { u }
    emit { jacobian }
)]
#[derive(Clone, Copy, Debug)]
struct Indefinite<T> {
    a: T,
    b: T,
}

/// Forces by methods, whose derivatives are declared.
#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + x^2 * der(y)^2) }
    forces { x: self.motor(der(x), u * y) - self.drag(der(x)); y: self.motor(x * y, 0); }
    inputs { u }
    derivative { motor: [self.motor_speed, self.motor_input]; drag: [self.drag_speed]; }
    emit { jacobian }
)]
#[derive(Clone, Copy, Debug)]
struct Driven<T> {
    m: T,
}

impl<T: Scalar> Driven<T> {
    fn motor(&self, speed: T, input: T) -> T {
        input * (-speed * speed).exp() - speed * self.m
    }
    fn motor_speed(&self, speed: T, input: T) -> T {
        T::from_f64(-2.0) * speed * input * (-speed * speed).exp() - self.m
    }
    fn motor_input(&self, speed: T, _: T) -> T {
        _ = self;
        (-speed * speed).exp()
    }
    fn drag(&self, speed: T) -> T {
        self.m * speed.tanh()
    }
    fn drag_speed(&self, speed: T) -> T {
        let tanh = speed.tanh();
        self.m * (T::ONE - tanh * tanh)
    }
}

/// The derivative of dual numbers, its arguments in one list: state, then inputs.
trait Slopes<S: Jacobian> {
    fn derivative(&self, arguments: &[Dual]) -> Vec<Dual>;
    fn input(&self, numbers: &[f64]) -> S::Input;
    /// The inherent method: both matrices, row by row.
    fn jacobian(&self, system: &S, state: &S::State, input: &S::Input) -> (Vec<f64>, Vec<f64>);
}

const T: f64 = 0.3;

/// Implements [`Slopes`] for a declaration.
macro_rules! slopes {
    ($system:ident, state: $n:literal, inputs: $m:literal $(, $input:ident)?) => {
        impl Slopes<$system<f64>> for $system<Dual> {
            fn derivative(&self, arguments: &[Dual]) -> Vec<Dual> {
                let state: [Dual; $n] = arguments[..$n].try_into().unwrap();
                let _inputs: [Dual; $m] = arguments[$n..].try_into().unwrap();
                let rate = self.derivative(
                    Dual::from_f64(T), &State::from_array(state), &slopes!(@input _inputs $(, $input)?),
                );
                rate.to_array().to_vec()
            }
            fn input(&self, numbers: &[f64]) -> <$system<f64> as Dynamics>::Input {
                let _inputs: [f64; $m] = numbers.try_into().unwrap();
                slopes!(@input _inputs $(, $input)?)
            }
            fn jacobian(
                &self,
                system: &$system<f64>,
                state: &<$system<f64> as Dynamics>::State,
                input: &<$system<f64> as Dynamics>::Input,
            ) -> (Vec<f64>, Vec<f64>) {
                let (a, b) = system.jacobian(T, state, input);
                // matrices are stored by columns
                (a.transpose().as_slice().to_vec(), b.transpose().as_slice().to_vec())
            }
        }
    };
    (@input $numbers:ident) => { () };
    (@input $numbers:ident, $input:ident) => { $input::from($numbers) };
}

slopes!(Sleigh, state: 5, inputs: 2, SleighInput);
slopes!(SleighOnThePlane, state: 6, inputs: 0);
slopes!(Veselova, state: 6, inputs: 0);
slopes!(Indefinite, state: 10, inputs: 1, IndefiniteInput);
slopes!(Driven, state: 4, inputs: 1, DrivenInput);

/// Compares at random points.
fn check<S>(system: &S, dual: &impl Slopes<S>)
where
    S: Jacobian<State: State<Scalar = f64>>,
{
    let (n, m) = (<S::State as State>::Dim::N, S::InputDim::N);
    let mut random = Random::new(7);
    let mut zeros = 0;
    for _ in 0..50 {
        let point = random.list(n + m, -1.0, 1.0);
        let mut array = <S::State as State>::Dim::vec(0.0);
        array.as_mut().copy_from_slice(&point[..n]);
        let (state, input) = (S::State::from_array(array), dual.input(&point[n..]));
        let (a, b) = dual.jacobian(system, &state, &input);
        let by_state = system.state_jacobian(T, &state, &input);
        let by_input = system.input_jacobian(T, &state, &input);
        // all in one program, whose bits are its own
        let (rates, of_state, of_input) = system.linearized(T, &state, &input);
        for (found, expected) in
            rates.to_array().as_ref().iter().zip(system.derivative(T, &state, &input).to_array().as_ref())
        {
            assert!((found - expected).abs() <= 1e-12 * expected.abs().max(1.0), "{found} is not {expected}");
        }
        for column in 0..n + m {
            let seeded = |(index, value): (usize, &f64)| {
                let slope = if index == column { 1.0 } else { 0.0 };
                Dual { value: *value, slope }
            };
            let arguments: Vec<Dual> = point.iter().enumerate().map(seeded).collect();
            let slopes = dual.derivative(&arguments);
            let scale = slopes.iter().fold(1.0_f64, |scale, s| scale.max(s.slope.abs()));
            for (row, expected) in slopes.iter().enumerate() {
                let found = if column < n {
                    [
                        a[row * n + column],
                        by_state.as_ref()[row].as_ref()[column],
                        of_state.as_ref()[row].as_ref()[column],
                    ]
                } else {
                    let column = column - n;
                    [
                        b[row * m + column],
                        by_input.as_ref()[row].as_ref()[column],
                        of_input.as_ref()[row].as_ref()[column],
                    ]
                };
                // what is said to be zero everywhere is
                if column < n && !S::state_depends(row, column) {
                    zeros += 1;
                    assert!(found.iter().all(|entry| *entry == 0.0), "({row}, {column})");
                }
                for found in found {
                    let error = (found - expected.slope).abs();
                    assert!(error <= 1e-11 * scale, "({row}, {column}): {found} is not {}", expected.slope);
                }
            }
        }
    }
    assert!(zeros > 0, "a rate of a coordinate does not depend on that coordinate in any of these");
}

/// A parameter of either kind.
fn n<S: Scalar>(value: f64) -> S {
    S::from_f64(value)
}

#[test]
fn adapted_equations_with_inputs() {
    fn sleigh<S: Scalar>() -> Sleigh<S> {
        Sleigh { m: n(1.3), J: n(0.7), a: n(0.4), c: n(0.2) }
    }
    check(&sleigh(), &sleigh());
    let report = Sleigh::<f64>::REPORT;
    for counted in ["  jacobian: ", "  state_jacobian: ", "  input_jacobian: "] {
        assert!(report.contains(counted), "{report}");
    }
}

#[test]
fn projected_equations_without_inputs() {
    fn sleigh<S: Scalar>() -> SleighOnThePlane<S> {
        SleighOnThePlane { m: n(1.3), J: n(0.7), a: n(0.4) }
    }
    check(&sleigh(), &sleigh());
}

#[test]
fn projected_equations_on_an_embedded_base() {
    fn veselova<S: Scalar>() -> Veselova<S> {
        let inertia = [[1.2, 0.1, -0.2], [0.1, 0.9, 0.3], [-0.2, 0.3, 1.6]];
        Veselova { I: inertia.map(|row| row.map(n)), c: [0.3, -0.8, 0.5].map(n) }
    }
    check(&veselova(), &veselova());
}

#[test]
fn linear_systems_solved_with_pivoting() {
    fn indefinite<S: Scalar>() -> Indefinite<S> {
        Indefinite { a: n(3.0), b: n(0.6) }
    }
    check(&indefinite(), &indefinite());
}

#[test]
fn methods_with_declared_derivatives() {
    fn driven<S: Scalar>() -> Driven<S> {
        Driven { m: n(1.3) }
    }
    check(&driven(), &driven());
}

#[test]
fn the_implicit_midpoint_rule_saves_evaluations() {
    // strong friction: an explicit method would need steps of 10⁻⁵
    let stiff = Sleigh { m: 1.3, J: 0.7, a: 0.4, c: 1e5 };
    let start = SleighState { theta: 0.2, x: 0.0, y: 0.0, omega: 0.2, v1: 1.0 };
    let input = SleighInput { torque: 2e4, push: 1e5 };
    let by_differences = ImplicitMidpoint::new(0.01);
    let mut plain = Integrator::new(stiff, by_differences, 0.0, start);
    let mut analytic = Integrator::new(stiff, by_differences.with_jacobian(), 0.0, start);
    plain.set_input(input);
    analytic.set_input(input);
    plain.advance_to(5.0).unwrap();
    analytic.advance_to(5.0).unwrap();
    let ends: [[f64; 5]; 2] = [(*plain.state()).into(), (*analytic.state()).into()];
    for (a, b) in ends[0].iter().zip(ends[1]) {
        assert!((a - b).abs() < 1e-9 * (1.0 + b.abs()), "{ends:?}");
    }
    // driven against friction, the body turns at the speed at which the torques balance
    assert!((ends[1][3] - 0.2).abs() < 1e-2, "{ends:?}");
    let (plain, analytic) = (plain.statistics(), analytic.statistics());
    assert_eq!(analytic.evaluations, analytic.iterations);
    assert!(plain.evaluations >= plain.iterations + 5 * plain.jacobians, "{plain:?}");
    assert!(analytic.evaluations < plain.evaluations, "{analytic:?} {plain:?}");
    let once = ImplicitMidpoint::step(&stiff, 0.0, 0.01, &start, &input).unwrap();
    let again = ImplicitMidpoint::step_with_jacobian(&stiff, 0.0, 0.01, &start, &input).unwrap();
    assert!((once.omega - again.omega).abs() < 1e-11 && (once.v1 - again.v1).abs() < 1e-11);
}
