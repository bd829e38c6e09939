//! A prepared system, or one with its angles at hand, is the same system, and does less at every evaluation.
#![allow(non_snake_case, reason = "parameters are written as in mechanics: J")]

use nh_tests::random::Random;
use nonholonomic::prelude::*;
use nonholonomic::{ByStages, Fast, IntegrationError};

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
    emit        { prepared, angle_cache, jacobian }
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

/// A pendulum in the plane, whose rod is a position constraint.
#[nonholonomic(
    base { x, y }
    holonomic { rod: x^2 + y^2 = l^2; }
    lagrangian { m/2 * (der(x)^2 + der(y)^2) - m * g * y }
    emit { prepared, angle_cache }
)]
#[derive(Clone, Copy, Debug)]
struct Pendulum {
    m: f64,
    g: f64,
    l: f64,
}

/// Whether a motion does not start.
fn refused<S: Dynamics<State = PendulumState>>(system: S, start: PendulumState) -> bool {
    let mut motion = Integrator::new(system, Rk4::new(0.02), 0.0, start);
    matches!(motion.advance_to(1.0), Err(IntegrationError::OffConstraints { .. }))
}

/// What holds a system hands on all of it: the way back to position constraints, too.
#[test]
fn holders_stay_where_position_constraints_hold() {
    fn off<S: Dynamics<State = PendulumState>>(system: S, start: PendulumState) -> f64 {
        assert!(system.has_positions());
        let mut motion = Integrator::new(system, Rk4::new(0.02), 0.0, start);
        motion.advance_to(20.0).expect("a regular motion");
        let PendulumState { x, y, .. } = *motion.state();
        (x.hypot(y) - 1.3).abs()
    }
    let pendulum = Pendulum { m: 0.7, g: 9.81, l: 1.3 };
    let start = PendulumState { x: 1.3, y: 0.0, ..PendulumState::default() };
    let borrowed: &Pendulum = &pendulum;
    let found = [
        off(pendulum, start),
        off(borrowed, start),
        off(pendulum.prepare(), start),
        off(pendulum.with_angle_cache(), start),
        off(ByStages::<_, Pendulum>::new(pendulum), start),
    ];
    assert!(found.iter().all(|off| *off < 1e-13), "{found:?}");
    // one that is off them is refused, whoever holds it
    let bad = PendulumState { x: 1.4, ..start };
    assert!(refused(pendulum, bad) && refused(pendulum.prepare(), bad));
    assert!(refused(pendulum.with_angle_cache(), bad));
}

/// In double and single precision and with the kernel for sines: the derivative differs by rounding errors alone, near the
/// last angle and far from it.
#[test]
fn angles_at_hand_cost_no_more_than_rounding() {
    fn worst<T: Real>(of: impl Fn(f64) -> T) -> f64 {
        let mut random = Random::new(5);
        let sleigh = Sleigh { m: of(1.3), J: of(0.4), a: of(0.2), c: of(0.1) };
        let near = sleigh.with_angle_cache();
        let input = SleighInput { torque: of(0.3) };
        let (mut theta, mut worst) = (0.0, 0.0_f64);
        for _ in 0..2000 {
            theta += random.between(-0.2, 0.25);
            let [omega, v1] = [random.between(-2.0, 2.0), random.between(-2.0, 2.0)];
            let state = SleighState::from([theta, 0.1, 0.2, omega, v1].map(&of));
            let expected: [T; 5] = sleigh.derivative(T::ZERO, &state, &input).into();
            let found: [T; 5] = near.derivative(T::ZERO, &state, &input).into();
            for (found, expected) in found.into_iter().zip(expected) {
                worst = worst.max((found - expected).abs().to_f64() / T::EPSILON.to_f64());
            }
        }
        worst
    }
    let found = [worst(|x| x), worst(f32::from_f64), worst(Fast)];
    // velocities are at most 2, and the error of a sine at most two units
    assert!(found.iter().all(|worst| *worst < 6.0), "{found:?}");
}

/// The state after 200 s.
fn end<S: Dynamics<State = SleighState<f64>, Input = SleighInput<f64>>>(
    system: S,
    start: SleighState<f64>,
) -> [f64; 5] {
    let mut motion = Integrator::new(system, Rk4::new(0.01), 0.0, start);
    motion.advance_to(200.0).expect("a regular motion");
    (*motion.state()).into()
}

/// A motion is the same up to rounding, without drift.
#[test]
fn a_motion_with_angles_at_hand_is_the_same() {
    let sleigh = Sleigh { m: 1.3, J: 0.4, a: 0.2, c: 0.0 };
    let start = SleighState { omega: 2.0, v1: 0.5, ..SleighState::default() };
    let [run, near]: [[f64; 5]; 2] = [end(sleigh, start), end(sleigh.with_angle_cache(), start)];
    for (run, near) in run.into_iter().zip(near) {
        assert!((run - near).abs() < 1e-11, "{run} {near}");
    }
}

/// A mass that is pushed by the sine of an angle which is made of other sines.
#[nonholonomic(
    base       { x }
    lagrangian { m / 2 * der(x)^2 }
    forces     { x: -sin(k + sin(cos(x))); }
    emit       { angle_cache }
)]
#[derive(Clone, Copy, Debug)]
struct Nested {
    m: f64,
    k: f64,
}

#[test]
fn angles_at_hand_are_made_of_others() {
    let nested = Nested { m: 1.0, k: 0.2 };
    let near = nested.with_angle_cache();
    for place in 0..20 {
        let state = NestedState { x: 0.3 + 0.01 * f64::from(place), x_dot: 0.5 };
        let change = near.derivative(0.0, &state, &()).x_dot - nested.derivative(0.0, &state, &()).x_dot;
        assert!(change.abs() < 1e-14, "{place}: {change:e}");
    }
}
