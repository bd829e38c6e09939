//! The derivative by the parameters against the derivative of dual numbers: equal to round-off.
#![allow(non_snake_case, reason = "parameters are written as in mechanics: J, I")]

use nh_tests::dual::Dual;
use nh_tests::random::Random;
use nonholonomic::prelude::*;

/// Adapted, with an array among the parameters.
#[nonholonomic(
    base   { theta, x, y }
    basis  { omega, v1, v2 }
    anchor {
        der(theta) = omega;
        der(x) = v1 * cos(theta) - v2 * sin(theta);
        der(y) = v1 * sin(theta) + v2 * cos(theta);
    }
    lagrangian {
        (J + m * dot(a, a)) / 2 * omega^2 + m / 2 * (v1^2 + v2^2)
            + m * a[0] * omega * v2 - m * a[1] * omega * v1
    }
    constraints { v2 = 0; }
    forces      { omega: torque - c * omega; }
    inputs      { torque }
    emit        { parameter_jacobian }
)]
#[derive(Clone, Copy, Debug)]
struct Sleigh<T> {
    m: T,
    J: T,
    a: [T; 2],
    c: T,
}

/// Projected.
#[nonholonomic(
    base { theta, x, y }
    lagrangian { J / 2 * der(theta)^2 + m / 2 * (der(x)^2 + der(y)^2) + m * g * x }
    constraints { cos(theta) * der(y) - sin(theta) * der(x) = 0; }
    emit { parameter_jacobian }
)]
#[derive(Clone, Copy, Debug)]
struct Skate<T> {
    m: T,
    J: T,
    g: T,
}

/// Every column is the slope along one parameter.
fn agree<const N: usize, const P: usize>(
    name: &str,
    matrix: [[f64; N]; P],
    slopes: impl Fn(usize) -> [Dual; N],
) {
    for (column, found) in matrix.iter().enumerate() {
        for (found, expected) in found.iter().zip(slopes(column)) {
            let scale = 1.0 + expected.slope.abs() + expected.value.abs();
            let difference = (found - expected.slope).abs();
            assert!(difference <= 1e-13 * scale, "{name}: {found} for {}", expected.slope);
        }
    }
}

fn seeded<const P: usize>(values: [f64; P], along: usize) -> [Dual; P] {
    std::array::from_fn(|k| Dual { value: values[k], slope: if k == along { 1.0 } else { 0.0 } })
}

#[test]
fn parameter_jacobians_are_those_of_dual_numbers() {
    let mut random = Random::new(7);
    for _ in 0..20 {
        let values: [f64; 5] = std::array::from_fn(|_| random.between(0.3, 2.0));
        let state: [f64; 5] = std::array::from_fn(|_| random.between(-2.0, 2.0));
        let sleigh = |[m, J, a0, a1, c]: [Dual; 5]| Sleigh { m, J, a: [a0, a1], c };
        let [m, J, a0, a1, c] = values;
        let found = Sleigh { m, J, a: [a0, a1], c }.parameter_jacobian(
            0.0,
            &SleighState::from(state),
            &SleighInput { torque: 0.3 },
        );
        let constant = |value| Dual { value, slope: 0.0 };
        agree("sleigh", found.into(), |along| {
            let input = SleighInput { torque: constant(0.3) };
            let state = SleighState::from(state.map(constant));
            sleigh(seeded(values, along)).derivative(constant(0.0), &state, &input).into()
        });
        let state: [f64; 6] = std::array::from_fn(|_| random.between(-2.0, 2.0));
        let skate = Skate { m, J, g: c };
        let found = skate.parameter_jacobian(0.0, &SkateState::from(state), &());
        agree("skate", found.into(), |along| {
            let [m, J, g] = seeded([m, J, c], along);
            let state = SkateState::from(state.map(constant));
            Skate { m, J, g }.derivative(constant(0.0), &state, &()).into()
        });
    }
}
