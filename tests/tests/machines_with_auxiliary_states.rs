//! Auxiliary states in machines: currents of motors, relaxation lengths of tyres, a servo. Rates agree with numbers of
//! `reference/machines.py`, and with themselves in everything that is derived of them: Jacobians, Taylor series, slices,
//! single precision.
#![allow(non_snake_case, reason = "parameters are written as in mechanics: J, K")]

#[path = "more_systems/reference.rs"]
mod reference;

use nonholonomic::prelude::*;
use reference::{check, check_with_multipliers};

macro_rules! robot {
    ($name:ident, $($more:tt)*) => {
        /// A robot with two driven wheels, each by a motor with inductance.
        #[nonholonomic(
            base { p[2], yaw, wheel[2] }
            inputs { volts[2] }
            let ahead = [cos(yaw), sin(yaw)];
            let across = [-sin(yaw), cos(yaw)];
            let hub = [p - b * across, p + b * across];
            lagrangian { kinetic(m, J, p + a * ahead, yaw) + Jw / 2 * dot(der(wheel), der(wheel)) }
            constraints {
                blade: dot(across, der(p)) = 0;
                for i in 0..2 { roll: dot(ahead, der(hub[i])) = r * der(wheel[i]); }
            }
            auxiliary {
                der(current[i in 0..2]) = (volts[i] - K * der(wheel[i]) - Rm * current[i]) / Lm;
                der(heat) = Rm * dot(current, current);
            }
            forces { wheel: K * current - c * der(wheel); }
            outputs { speed = r * (der(wheel[0]) + der(wheel[1])) / 2; load = dot(volts, current); }
            independent { der(wheel) }
            assume { m > 0; J > 0; Jw > 0; Lm > 0; r > 0; b > 0; }
            $($more)*
        )]
        #[derive(Clone, Copy, Debug)]
        struct $name<T> { m: T, J: T, a: T, b: T, r: T, Jw: T, K: T, Rm: T, Lm: T, c: T }

        impl<T: Scalar> $name<T> {
            fn example() -> Self {
                let [m, J, a, b] = [6.0, 0.25, 0.05, 0.2].map(T::from_f64);
                let [r, Jw, K, Rm, Lm, c] = [0.07, 0.004, 0.3, 0.9, 0.02, 0.01].map(T::from_f64);
                Self { m, J, a, b, r, Jw, K, Rm, Lm, c }
            }
        }
    };
}

robot!(Robot, emit { jacobian, output_jacobian, taylor, multipliers, divergence });
robot!(Tracked, track { speed });

const VOLTS: [f64; 2] = [4.0, 6.5];

#[test]
fn robot_with_motors() {
    let robot = Robot::<f64>::example();
    let input = RobotInput { volts: VOLTS };
    check_with_multipliers("robot_with_motors", &robot, input, |t, state| {
        robot.multipliers(t, state, &input)
    });
}

macro_rules! single_track {
    ($name:ident, $($more:tt)*) => {
        /// A car on one track whose tyres build up their side forces along a relaxation length, steered by a servo.
        #[nonholonomic(
            base { p[2], yaw }
            inputs { push, command }
            let along(u) = [cos(u), sin(u)];
            let across(u) = [-sin(u), cos(u)];
            let angle = [yaw + delta, yaw];
            let axle = [p + a * along(yaw), p - b * along(yaw)];
            let rolling[i in 0..2] = dot(along(angle[i]), der(axle[i]));
            let slipping[i in 0..2] = dot(across(angle[i]), der(axle[i]));
            let force = side[0] * across(angle[0]) + side[1] * across(angle[1]);
            lagrangian { kinetic(m, J, p, yaw) }
            auxiliary {
                der(side[i in 0..2]) = -(stiffness[i] * slipping[i] + rolling[i] * side[i]) / relaxation;
                der(delta) = (command - delta) / lag;
            }
            forces {
                p: push * along(yaw) + force;
                yaw: sum(i in 0..2: side[i] * dot(across(angle[i]), diff(der(axle[i]), der(yaw))));
            }
            assume { m > 0; J > 0; relaxation > 0; lag > 0; }
            $($more)*
        )]
        #[derive(Clone, Copy, Debug)]
        struct $name<T> { m: T, J: T, a: T, b: T, stiffness: [T; 2], relaxation: T, lag: T }

        impl<T: Scalar> $name<T> {
            fn example() -> Self {
                let [m, J, a, b, relaxation, lag] = [1300.0, 2000.0, 1.1, 1.4, 0.4, 0.15].map(T::from_f64);
                Self { m, J, a, b, stiffness: [52_000.0, 61_000.0].map(T::from_f64), relaxation, lag }
            }
        }
    };
}

single_track!(SingleTrack, emit { jacobian, taylor, divergence });

const DRIVING: SingleTrackInput<f64> = SingleTrackInput { push: 900.0, command: 0.12 };

#[test]
fn single_track_with_relaxation() {
    check("single_track_with_relaxation", &SingleTrack::<f64>::example(), DRIVING);
}

/// A and B are differences of the derivative, divergence is the trace of A.
fn differs<S, const N: usize>(system: &S, state: [f64; N], input: &S::Input, a: &[[f64; N]; N])
where
    S: Dynamics<State: From<[f64; N]> + Into<[f64; N]> + State<Scalar = f64>>,
{
    let h = 1e-5;
    for j in 0..N {
        let at = |sign: f64| -> [f64; N] {
            let mut moved = state;
            moved[j] += sign * h;
            system.derivative(0.0, &moved.into(), input).into()
        };
        let (after, before) = (at(1.0), at(-1.0));
        for (i, ((after, before), row)) in after.iter().zip(&before).zip(a).enumerate() {
            let difference = (after - before) / (2.0 * h);
            let scale = 1.0 + difference.abs().max(after.abs());
            assert!((difference - row[j]).abs() < 1e-7 * scale, "({i}, {j}): {difference}, {}", row[j]);
        }
    }
}

const MOVING: [f64; 10] = [0.3, -0.2, 0.7, 0.1, 0.4, 3.0, 4.0, 1.5, -0.8, 2.0];
const TURNING: [f64; 9] = [0.0, 0.0, 0.4, 15.0, 5.5, 0.2, 300.0, -200.0, 0.05];

#[test]
fn jacobians_hold_auxiliary_states() {
    let robot = Robot::<f64>::example();
    let input = RobotInput { volts: VOLTS };
    let state = RobotState::from(MOVING);
    differs(&robot, MOVING, &input, &robot.state_jacobian(0.0, &state, &input));
    let (a, b) = robot.jacobian(0.0, &state, &input);
    // the currents are rows and columns 7 and 8, the heat is 9
    assert!((b[(7, 0)] - 1.0 / 0.02).abs() < 1e-12 && b[(8, 0)] == 0.0);
    assert!((a[(9, 8)] - 2.0 * 0.9 * -0.8).abs() < 1e-12 && (0..10).all(|i| a[(i, 9)] == 0.0));
    assert!((robot.divergence(0.0, &state, &input) - a.trace()).abs() < 1e-10 * a.trace().abs());
    let (c, d) = robot.output_jacobian(0.0, &state, &input);
    let found = [c[(1, 7)], c[(1, 8)], d[(1, 0)], d[(1, 1)]];
    assert!(found.iter().zip([4.0, 6.5, 1.5, -0.8]).all(|(x, y)| (x - y).abs() < 1e-15), "{found:?}");
    let car = SingleTrack::<f64>::example();
    let state = SingleTrackState::from(TURNING);
    differs(&car, TURNING, &DRIVING, &car.state_jacobian(0.0, &state, &DRIVING));
    let (a, _) = car.jacobian(0.0, &state, &DRIVING);
    assert!((car.divergence(0.0, &state, &DRIVING) - a.trace()).abs() < 1e-10 * a.trace().abs());
}

#[test]
fn taylor_series_hold_auxiliary_states() {
    fn ends<S>(system: &S, start: S::State, input: S::Input)
    where
        S: TaylorSeries<State: State<Scalar = f64>, Input: Copy>,
    {
        let mut series = Integrator::new(system, Taylor::new().rtol(1e-14).atol(1e-14), 0.0, start);
        let mut steps = Integrator::new(system, Dop853::new().rtol(1e-13).atol(1e-13), 0.0, start);
        series.set_input(input);
        steps.set_input(input);
        series.advance_to(0.4).unwrap();
        steps.advance_to(0.4).unwrap();
        let (one, other) = (series.state().to_array(), steps.state().to_array());
        for (x, y) in one.as_ref().iter().zip(other.as_ref()) {
            assert!((x - y).abs() < 1e-10 * (1.0 + y.abs()), "{x} {y}");
        }
    }
    ends(&Robot::<f64>::example(), RobotState::from(MOVING), RobotInput { volts: VOLTS });
    ends(&SingleTrack::<f64>::example(), SingleTrackState::from(TURNING), DRIVING);
}

/// The speed needs the currents, but neither place nor heading nor heat.
#[test]
fn slices_keep_the_auxiliary_states_that_matter() {
    let (whole, tracked) = (Robot::<f64>::example(), Tracked::<f64>::example());
    let state = RobotState::from(MOVING);
    let slice = TrackedState { wheel_dot: state.wheel_dot, current: state.current };
    let input = RobotInput { volts: VOLTS };
    let all = whole.derivative(0.0, &state, &input);
    let some = tracked.derivative(0.0, &slice, &TrackedInput { volts: VOLTS });
    for i in 0..2 {
        assert!((all.wheel_dot[i] - some.wheel_dot[i]).abs() < 1e-12 * (1.0 + all.wheel_dot[i].abs()));
        assert!((all.current[i] - some.current[i]).abs() < 1e-12 * (1.0 + all.current[i].abs()));
    }
}

#[test]
fn single_precision_holds_auxiliary_states() {
    let input = RobotInput { volts: VOLTS };
    let state = RobotState::from(MOVING);
    let exact: [f64; 10] = Robot::<f64>::example().derivative(0.0, &state, &input).into();
    #[allow(clippy::cast_possible_truncation, reason = "rounding is meant")]
    let rounded = RobotState::from(MOVING.map(|x| x as f32));
    let input = RobotInput { volts: [4.0_f32, 6.5] };
    let found: [f32; 10] = Robot::<f32>::example().derivative(0.0, &rounded, &input).into();
    for (x, y) in found.iter().zip(&exact) {
        assert!((f64::from(*x) - y).abs() < 2e-5 * (1.0 + y.abs()), "{x} {y}");
    }
}
