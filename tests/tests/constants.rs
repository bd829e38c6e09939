//! Constants are parameters that are known when the code is compiled.
#![allow(non_snake_case, reason = "parameters are written as in mechanics: J")]

use nh_runtime::prelude::*;
use nh_tests::random::Random;

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
    // a factor that is a number costs as much as one that is a parameter
    assert!(counts[1] <= counts[0] + 1 && counts[2] < counts[0], "{counts:?}");
}
