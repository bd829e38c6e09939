//! Products of Jacobians with vectors against the Jacobians: equal to round-off, in both precisions.
#![allow(non_snake_case, reason = "parameters are written as in mechanics: J, I")]

use nh_tests::random::Random;
use nonholonomic::prelude::*;

/// Adapted, with an input, the time, and a method of the struct in the forces.
#[nonholonomic(
    base   { theta, x, y }
    basis  { omega, v1, v2 }
    anchor {
        der(theta) = omega;
        der(x) = v1 * cos(theta) - v2 * sin(theta);
        der(y) = v1 * sin(theta) + v2 * cos(theta);
    }
    lagrangian { (J + m * a^2) / 2 * omega^2 + m / 2 * (v1^2 + v2^2) + m * a * omega * v2 }
    constraints { v2 = 0; }
    inputs      { torque, push }
    forces      { omega: torque * cos(t) - self.drag(omega, v1); v1: push - x; }
    derivative  { drag: [self.drag_by_first, self.drag_by_second]; }
    emit        { jacobian, jacobian_product, adjoint_product }
)]
#[derive(Clone, Copy, Debug)]
struct Sleigh<T> {
    m: T,
    J: T,
    a: T,
    c: T,
}

impl<T: Scalar> Sleigh<T> {
    fn drag(&self, omega: T, v: T) -> T {
        self.c * omega * v * v
    }
    fn drag_by_first(&self, _: T, v: T) -> T {
        self.c * v * v
    }
    fn drag_by_second(&self, omega: T, v: T) -> T {
        self.c * omega * (v + v)
    }
}

/// Projected, with numerical pivoting or without.
#[nonholonomic(
    base { theta, x, y }
    lagrangian { J / 2 * der(theta)^2 + m / 2 * (der(x)^2 + der(y)^2) + m * g * x * sin(t) }
    constraints { cos(theta) * der(y) - sin(theta) * der(x) = 0; }
    emit { jacobian, jacobian_product, adjoint_product }
)]
#[derive(Clone, Copy, Debug)]
struct Skate<T> {
    m: T,
    J: T,
    g: T,
}

/// Three angles that are coupled: C is factorised. One of them is tracked with its friction.
#[nonholonomic(
    base { a, b, c }
    let p = [sin(a), -cos(a)];
    let q = p + [sin(b), -cos(b)];
    let r = q + [sin(c), -cos(c)];
    lagrangian {
        m / 2 * (dot(der(p), der(p)) + dot(der(q), der(q)) + dot(der(r), der(r))) - m * g * (p[1] + q[1] + r[1])
    }
    inputs     { torque }
    auxiliary  { der(heat) = der(a)^2 - k * heat; }
    forces     { a: torque - k * heat; }
    emit       { jacobian, jacobian_product, adjoint_product }
)]
#[derive(Clone, Copy, Debug)]
struct Pendulum<T> {
    m: T,
    g: T,
    k: T,
}

const T: f64 = 0.7;

/// Both products of a system against its matrices, for numbers of a type made from those of `f64`.
macro_rules! agree {
    ($name:literal, $system:expr, $state:ident, $inputs:literal, $input:expr, $number:ty, $tolerance:expr) => {{
        let mut random = Random::new(7);
        let system = $system;
        for _ in 0..20 {
            let mut next = || <$number as Scalar>::from_f64(random.between(-1.0, 1.0));
            let state = $state::from(std::array::from_fn(|_| next()));
            let direction = $state::from(std::array::from_fn(|_| next()));
            let weights = $state::from(std::array::from_fn(|_| next()));
            let [at, along]: [[$number; $inputs]; 2] =
                std::array::from_fn(|_| std::array::from_fn(|_| next()));
            let (at, along) = (($input)(at), along);
            let t = <$number as Scalar>::from_f64(T);
            let (a, b) = system.jacobian(t, &state, &at);
            let found = system.jacobian_product(t, &state, &at, &direction, &($input)(along)).to_array();
            let (w, p) = (direction.to_array(), weights.to_array());
            for (row, found) in found.into_iter().enumerate() {
                let mut wanted = <$number as Scalar>::ZERO;
                (0..w.len()).for_each(|column| wanted += a[(row, column)] * w[column]);
                (0..$inputs).for_each(|column| wanted += b[(row, column)] * along[column]);
                near($name, f64::from(found), f64::from(wanted), $tolerance);
            }
            let (by_state, by_input) = system.adjoint_product(t, &state, &at, &weights);
            for (column, found) in by_state.to_array().into_iter().enumerate() {
                let mut wanted = <$number as Scalar>::ZERO;
                (0..p.len()).for_each(|row| wanted += a[(row, column)] * p[row]);
                near($name, f64::from(found), f64::from(wanted), $tolerance);
            }
            let by_input: [$number; $inputs] = by_input.into();
            for (column, found) in by_input.into_iter().enumerate() {
                let mut wanted = <$number as Scalar>::ZERO;
                (0..p.len()).for_each(|row| wanted += b[(row, column)] * p[row]);
                near($name, f64::from(found), f64::from(wanted), $tolerance);
            }
        }
    }};
}

fn near(name: &str, found: f64, wanted: f64, tolerance: f64) {
    assert!((found - wanted).abs() <= tolerance * (1.0 + wanted.abs()), "{name}: {found} for {wanted}");
}

macro_rules! in_numbers {
    ($number:ty, $tolerance:expr) => {{
        let of = <$number as Scalar>::from_f64;
        let sleigh = Sleigh { m: of(1.3), J: of(0.4), a: of(0.2), c: of(0.7) };
        let with = |[torque, push]: [$number; 2]| SleighInput { torque, push };
        agree!("sleigh", sleigh, SleighState, 2, with, $number, $tolerance);
        let pendulum = Pendulum { m: of(1.1), g: of(9.81), k: of(0.3) };
        let with = |[torque]: [$number; 1]| PendulumInput { torque };
        agree!("pendulum", pendulum, PendulumState, 1, with, $number, $tolerance);
    }};
}

#[test]
fn products_are_those_with_the_jacobian() {
    in_numbers!(f64, 1e-11);
    in_numbers!(f32, 3e-3);
}

#[test]
fn without_inputs_there_is_nothing_for_them() {
    let skate = Skate { m: 1.2, J: 0.5, g: 9.81 };
    let mut random = Random::new(3);
    let mut next = || SkateState::from(std::array::from_fn(|_| random.between(-1.0, 1.0)));
    let [state, direction, weights] = [next(), next(), next()];
    let (a, _) = skate.jacobian(T, &state, &());
    let found = skate.jacobian_product(T, &state, &(), &direction, &()).to_array();
    let (of_state, ()) = skate.adjoint_product(T, &state, &(), &weights);
    let (w, p) = (direction.to_array(), weights.to_array());
    for row in 0..6 {
        let wanted: f64 = (0..6).map(|column| a[(row, column)] * w[column]).sum();
        assert!((found[row] - wanted).abs() < 1e-12 * (1.0 + wanted.abs()), "{} for {wanted}", found[row]);
        let wanted: f64 = (0..6).map(|column| a[(column, row)] * p[column]).sum();
        let found = of_state.to_array()[row];
        assert!((found - wanted).abs() < 1e-12 * (1.0 + wanted.abs()), "{found} for {wanted}");
    }
}
