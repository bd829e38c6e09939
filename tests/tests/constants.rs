//! Constants are parameters that are known when the code is compiled.
#![allow(non_snake_case, reason = "parameters are written as in mechanics: J")]

use nh_tests::random::Random;
use nonholonomic::prelude::*;

/// Declares a body with two inertias and a wheel, whose numbers come from fields or from constants.
macro_rules! cart {
    ($Cart:ident, { $($constants:tt)* }, { $($fields:tt)* }) => {
        #[nonholonomic(
            $($constants)*
            base   { theta, x, y }
            basis  { omega, v1, v2 }
            anchor {
                der(theta) = omega;
                der(x) = v1 * cos(theta) - v2 * sin(theta);
                der(y) = v1 * sin(theta) + v2 * cos(theta);
            }
            lagrangian  { (J[0] + J[1] + m * a^2) / 2 * omega^2 + m / 2 * (v1^2 + v2^2) + m * a * omega * v2 }
            constraints { v2 = 0; }
            forces      { omega: -c * omega; }
            assume      { m > 0; c > 0; }
        )]
        #[derive(Clone, Copy, Debug)]
        struct $Cart { $($fields)* }
    };
}

cart!(Varying, {}, { m: f64, J: [f64; 2], a: f64, c: f64 });
cart!(Half, { constants { a = 0.4; J = [a^2, 3 * a / 8]; } }, { m: f64, c: f64 });
cart!(Fixed, { constants { m = 1.3; a = 0.4; J = [0.16, 0.15]; c = 1/5; } }, {});

/// The operations of the derivative that the report counts.
fn operations(report: &str) -> usize {
    let line = report.lines().find_map(|line| line.trim().strip_prefix("derivative"));
    let numbers = line.expect("the function is in the report").split([' ', ',']);
    numbers.filter_map(|word| word.parse::<usize>().ok()).sum()
}

#[test]
fn constants_are_parameters_with_a_value() {
    let mut random = Random::new(5);
    let varying = Varying { m: 1.3, J: [0.16, 0.15], a: 0.4, c: 0.2 };
    assert_eq!((varying.validate(), Fixed {}.validate()), (Ok(()), Ok(())));
    for _ in 0..50 {
        let state: [f64; 5] = std::array::from_fn(|_| random.between(-2.0, 2.0));
        let expected: [f64; 5] = varying.derivative(0.0, &state.into(), &()).into();
        let half: [f64; 5] = Half { m: 1.3, c: 0.2 }.derivative(0.0, &state.into(), &()).into();
        let fixed: [f64; 5] = Fixed {}.derivative(0.0, &state.into(), &()).into();
        for (expected, found) in expected.iter().chain(&expected).zip(half.iter().chain(&fixed)) {
            assert!((found - expected).abs() <= 8.0 * f64::EPSILON * expected.abs(), "{found} {expected}");
        }
    }
}

#[test]
fn what_is_constant_is_not_computed() {
    let counts = [Varying::REPORT, Half::REPORT, Fixed::REPORT].map(operations);
    assert!(counts[1] <= counts[0] && counts[2] < counts[0], "{counts:?}");
    assert!(Fixed::REPORT.contains("Constants\n  m = 13/10\n  a = 2/5\n"), "{}", Fixed::REPORT);
}

/// A heavy top whose inertias about two axes are equal, by names of their own.
#[nonholonomic(
    constants { I = [0.5, 0.5, 0.2]; m = 1.5; l = 0.3; g = 9.81; }
    base  { G[3] }
    on    { dot(G, G) = 1; }
    basis { w[3] }
    anchor { der(G) = cross(G, w); }
    brackets so(3) { w[0], w[1], w[2] }
    lagrangian { sum(i in 0..3: I[i] / 2 * w[i]^2) - m * g * l * G[2] }
)]
#[derive(Clone, Copy, Debug)]
struct Top {}

#[test]
fn what_cancels_for_these_values_is_gone() {
    let state = TopState { G: [0.6, 0.0, 0.8], w: [0.7, -0.4, 3.1] };
    let rate = Top {}.derivative(0.0, &state, &());
    assert!(rate.w[2] == 0.0, "{rate:?}");
    let (torque, gyroscopic) = (1.5 * 9.81 * 0.3, (0.5 - 0.2) * 3.1);
    let expected = [(torque * 0.0 - gyroscopic * 0.4) / 0.5, (-torque * 0.6 - gyroscopic * 0.7) / 0.5];
    for (found, expected) in rate.w.iter().zip(expected) {
        assert!((found.abs() - expected.abs()).abs() < 1e-14, "{rate:?} is not {expected:?}");
    }
}

/// A sleigh in the plane, and what is left of it without its place: the constants are handed on.
#[nonholonomic(
    constants { m = 1.3; J = [0, 0.7]; a = 0.4; c = sqrt(2) / 10; }
    base { theta, x, y }
    velocities {
        omega = der(theta);
        v1 = cos(theta) * der(x) + sin(theta) * der(y);
        v2 = -sin(theta) * der(x) + cos(theta) * der(y);
    }
    lagrangian  { (J[0] + J[1] + m * a^2) / 2 * omega^2 + m / 2 * (v1^2 + v2^2) + m * a * omega * v2 }
    constraints { v2 = 0; }
    forces      { omega: -c * omega; }
    assume      { m > 1; }
)]
#[derive(Clone, Copy, Debug)]
struct Sleigh {}

quotient! { Sleigh -> #[derive(Clone, Copy, Debug)] struct Turning by { theta, x, y } { outputs { p = m * v1; } } }

#[test]
fn constants_are_handed_on_to_a_quotient() {
    let state = SleighState { theta: 0.3, x: 1.0, y: 2.0, omega: 0.9, v1: -0.6 };
    let reduced = Sleigh {}.reduce(0.0, &state);
    let (full, quotient) =
        (Sleigh {}.derivative(0.0, &state, &()), Turning {}.derivative(0.0, &reduced, &()));
    for (full, quotient) in [(full.omega, quotient.omega), (full.v1, quotient.v1)] {
        assert!((full - quotient).abs() < 1e-14, "{full} is not {quotient}");
    }
    assert!((Turning {}.outputs(0.0, &reduced, &()).p + 1.3 * 0.6).abs() < 1e-15);
    assert!(Turning::REPORT.contains("J[1] = 7/10"), "{}", Turning::REPORT);
}

/// Declares a motion whose mass, force and phase are numbers in which all digits of double precision cancel, or most.
macro_rules! near {
    ($Near:ident, { $($accuracy:tt)* }, $T:ident) => {
        #[nonholonomic(
            base { x }
            lagrangian {
                10^12 * (m - exp(pi * sqrt(163)) + 262537412640768744) * der(x)^2 / 2
                    + 10^9 * (sqrt(2) - 1.41421356) * sin(x) + 10^18 * (atan(1 / 10^6) - 1 / 10^6) * x
            }
            emit { jacobian, taylor }
            $($accuracy)*
        )]
        #[derive(Clone, Copy, Debug)]
        struct $Near<$T> { m: $T }
    };
}

near!(Fast, { accuracy { fast } }, T);
near!(Balanced, {}, T);
near!(Careful, { accuracy { careful } }, T);

#[test]
fn numbers_that_cancel_keep_their_digits() {
    // to sixty digits: 7.4993·10⁻¹³, 2.3731·10⁻⁹, −3.3333·10⁻¹⁹
    let (mass, force, push) = (0.749_927_402_801_814_3, 2.373_095_048_801_688_7, -0.333_333_333_333_133_3);
    for x in [0.2_f64, 0.7, 2.5] {
        for m in [0.0, 1e-12] {
            let expected = (force * x.cos() + push) / (1e12 * m + mass);
            let found = [
                Fast { m }.derivative(0.0, &FastState { x, x_dot: 0.0 }, &()).x_dot,
                Balanced { m }.derivative(0.0, &BalancedState { x, x_dot: 0.0 }, &()).x_dot,
                Careful { m }.derivative(0.0, &CarefulState { x, x_dot: 0.0 }, &()).x_dot,
                Balanced { m }.taylor::<3>(0.0, &BalancedState { x, x_dot: 0.0 }, &())[1].x_dot,
            ];
            for found in found {
                assert!((found - expected).abs() < 8.0 * f64::EPSILON * expected.abs(), "{found} {expected}");
            }
        }
        #[allow(clippy::cast_possible_truncation, reason = "the rounding is wanted")]
        let (x, expected) = (x as f32, ((force * x.cos() + push) / mass) as f32);
        let found = Balanced { m: 0.0_f32 }.derivative(0.0, &BalancedState { x, x_dot: 0.0 }, &()).x_dot;
        assert!((found - expected).abs() < 8.0 * f32::EPSILON * expected.abs(), "{found} {expected}");
    }
}
