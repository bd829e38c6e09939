//! A prepared system is the same system, and does less at every evaluation.
#![allow(non_snake_case, reason = "parameters are written as in mechanics: J")]

use nh_tests::random::Random;
use nonholonomic::prelude::*;

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
    forces      { omega: torque - self.friction(omega); }
    derivative  { friction: [self.slope]; }
    inputs      { torque }
    emit        { prepared, jacobian }
)]
#[derive(Clone, Copy, Debug)]
struct Sleigh<T> {
    m: T,
    J: T,
    a: T,
    c: T,
}

impl<T: Scalar> Sleigh<T> {
    fn friction(&self, omega: T) -> T {
        self.c * omega
    }
    fn slope(&self, _: T) -> T {
        self.c
    }
}

/// The operations that the report counts for a function.
fn operations(function: &str) -> usize {
    let line = Sleigh::<f64>::REPORT.lines().find_map(|line| line.trim().strip_prefix(function));
    let numbers = line.expect("the function is in the report").split([' ', ',']);
    numbers.filter_map(|word| word.parse::<usize>().ok()).sum()
}

#[test]
fn a_prepared_system_is_the_same_system() -> Result<(), Box<dyn std::error::Error>> {
    let mut random = Random::new(11);
    for _ in 0..50 {
        let [m, J, a, c] = std::array::from_fn(|_| random.between(0.2, 3.0));
        let sleigh = Sleigh { m, J, a, c };
        let prepared: PreparedSleigh<f64> = sleigh.prepare();
        let state = SleighState::from(std::array::from_fn::<f64, 5, _>(|_| random.between(-2.0, 2.0)));
        let input = SleighInput { torque: random.between(-1.0, 1.0) };
        let expected: [f64; 5] = sleigh.derivative(0.0, &state, &input).into();
        let found: [f64; 5] = prepared.derivative(0.0, &state, &input).into();
        // the same arithmetic on the same values
        assert_eq!(found.map(f64::to_bits), expected.map(f64::to_bits), "{found:?} {expected:?}");
        let energies = [Energy::energy(&prepared, 0.0, &state), sleigh.energy(0.0, &state)];
        assert_eq!(energies[0].to_bits(), energies[1].to_bits());
        let matrices =
            [prepared.state_jacobian(0.0, &state, &input), sleigh.state_jacobian(0.0, &state, &input)];
        assert_eq!(matrices[0], matrices[1]);
        let mut simulation = Integrator::new(prepared, Dopri5::new(), 0.0, state);
        simulation.set_input(input);
        simulation.advance_to(0.1)?;
    }
    assert!(Sleigh { m: 1.0, J: f64::NAN, a: 0.1, c: 0.0 }.prepare().validate().is_err());
    Ok(())
}

#[test]
fn what_is_computed_ahead_is_not_computed_again() {
    let (whole, ahead, rest) =
        (operations("derivative:"), operations("prepare:"), operations("derivative, prepared:"));
    assert!(ahead >= 2, "{ahead}");
    assert_eq!(whole, ahead + rest);
}
