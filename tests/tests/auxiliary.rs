//! Auxiliary states: to geometry and mechanics they are given functions of the time, mathematics (40).
#![allow(non_snake_case, reason = "parameters are written as in mechanics: J, I")]

use nh_tests::random::Random;
use nonholonomic::prelude::*;

/// A sleigh whose blade is turned by an angle, on a floor that moves: with forces, outputs and a claim.
macro_rules! sleigh {
    ($name:ident, $s:tt, $($more:tt)*) => {
        #[nonholonomic(
            base   { theta, x, y }
            basis  { omega, v1, v2 }
            anchor {
                der(theta) = omega;
                der(x) = v1 * cos(theta) - v2 * sin(theta);
                der(y) = v1 * sin(theta) + v2 * cos(theta);
            }
            lagrangian  { (J + m * a^2) / 2 * omega^2 + m / 2 * (v1^2 + v2^2) + m * a * omega * v2 - m * x * sin(theta) }
            constraints { blade: v2 = tan($s / 3) * v1 - U * sin(theta) * $s^2; }
            forces      { omega: -c * omega * (1 + $s^2); x: sin($s) }
            outputs     { slip = v1 * $s; turn = omega + x; }
            emit        { multipliers, reactions, gibbs_appell, bracket, momenta }
            symmetries  { up: sin(theta) * v1 + cos(theta) * v2; }
            $($more)*
        )]
        #[derive(Clone, Copy, Debug)]
        struct $name { m: f64, J: f64, a: f64, U: f64, c: f64 }
    };
}

sleigh!(TimedSleigh, (c * t),);
sleigh!(ClockedSleigh, s, auxiliary { der(s) = c; });
sleigh!(ProjectedTimedSleigh, (c * t), formulation { projected });
sleigh!(ProjectedClockedSleigh, s, auxiliary { der(s) = rate; } inputs { rate } formulation { projected });

/// A law of two declarations: what they have in common is equal.
fn close(what: &str, one: &[f64], other: &[f64]) {
    assert_eq!(one.len(), other.len(), "{what}");
    let scale = one.iter().chain(other).fold(1.0, |most: f64, x| most.max(x.abs()));
    for (a, b) in one.iter().zip(other) {
        assert!((a - b).abs() <= 1e-12 * scale, "{what}: {a} and {b} of {one:?} and {other:?}");
    }
}

/// With the time in their places, and with a clock that runs at the rate c, coefficients, drift, forces and
/// outputs mean the same; so does all that is derived of them.
#[test]
fn a_clock_is_as_good_as_the_time() {
    macro_rules! compare {
        ($random:ident, $n:literal, $timed:ident, $timed_state:ident, $clocked:ident, $clocked_state:ident, $input:expr) => {
            for _ in 0..20 {
                let [m, J, a, U, c] = std::array::from_fn(|_| $random.between(0.3, 2.0));
                let (timed, clocked) = ($timed { m, J, a, U, c }, $clocked { m, J, a, U, c });
                let t = $random.between(-1.0, 1.0);
                let numbers: [f64; $n] = std::array::from_fn(|_| $random.between(-1.0, 1.0));
                let mut with_clock = [c * t; $n + 1];
                with_clock[..$n].copy_from_slice(&numbers);
                let (x, z) = ($timed_state::from(numbers), $clocked_state::from(with_clock));
                let input = &$input(c);
                let rate: [f64; $n + 1] = clocked.derivative(t, &z, input).into();
                close("derivative", &<[f64; $n]>::from(timed.derivative(t, &x, &())), &rate[..$n]);
                close("rate of the clock", &rate[$n..], &[c]);
                let appell: [f64; $n + 1] = clocked.gibbs_appell(t, &z, input).into();
                close("gibbs_appell", &appell, &rate);
                close("energy", &[timed.energy(t, &x)], &[clocked.energy(t, &z)]);
                close(
                    "velocity",
                    &<[f64; 3]>::from(timed.velocity(t, &x)),
                    &<[f64; 3]>::from(clocked.velocity(t, &z)),
                );
                close(
                    "multipliers",
                    &[timed.multipliers(t, &x, &()).blade],
                    &[clocked.multipliers(t, &z, input).blade],
                );
                close(
                    "reactions",
                    &<[f64; 3]>::from(timed.reactions(t, &x, &())),
                    &<[f64; 3]>::from(clocked.reactions(t, &z, input)),
                );
                close(
                    "outputs",
                    &<[f64; 2]>::from(timed.outputs(t, &x, &())),
                    &<[f64; 2]>::from(clocked.outputs(t, &z, input)),
                );
                let drift = timed.drift_of_outputs(t, &x, &());
                close(
                    "drift",
                    &<[f64; 2]>::from(drift),
                    &<[f64; 2]>::from(clocked.drift_of_outputs(t, &z, input)),
                );
                let bracket = timed.bracket_with_energy(t, &x, &());
                close(
                    "bracket",
                    &<[f64; 2]>::from(bracket),
                    &<[f64; 2]>::from(clocked.bracket_with_energy(t, &z, input)),
                );
                let (one, other) = (timed.momentum_rates(t, &x, &()), clocked.momentum_rates(t, &z, input));
                close("momentum rate", &[one.up], &[other.up]);
            }
        };
    }
    let mut random = Random::new(31);
    compare!(random, 5, TimedSleigh, TimedSleighState, ClockedSleigh, ClockedSleighState, |_| ());
    let rate = |rate| ProjectedClockedSleighInput { rate };
    compare!(
        random,
        6,
        ProjectedTimedSleigh,
        ProjectedTimedSleighState,
        ProjectedClockedSleigh,
        ProjectedClockedSleighState,
        rate
    );
}

/// A skate that a servo turns: an auxiliary state is the drift of a constraint that the state keeps.
#[nonholonomic(
    base        { x, y, heading }
    lagrangian  { m / 2 * (der(x)^2 + der(y)^2) + J / 2 * der(heading)^2 }
    constraints { blade: der(x) * sin(heading) = der(y) * cos(heading); servo: der(heading) = turn; }
    inputs      { wanted }
    auxiliary   { der(turn) = (wanted - turn) / lag; }
    formulation { projected }
    emit        { symmetric_projection }
)]
#[derive(Clone, Copy, Debug)]
struct Servo {
    m: f64,
    J: f64,
    lag: f64,
}

#[test]
fn a_symmetric_projection_follows_a_drift_that_is_an_auxiliary_state() {
    let servo = Servo { m: 2.0, J: 0.3, lag: 0.5 };
    let start =
        ServoState { x: 0.0, y: 0.0, heading: 0.0, x_dot: 1.0, y_dot: 0.0, heading_dot: 0.0, turn: 0.0 };
    let method = ImplicitMidpoint::new(0.01).symmetrically_projected();
    let mut sim = Integrator::new(servo, method, 0.0, start);
    sim.set_input(ServoInput { wanted: 1.5 });
    sim.advance_to(2.0).expect("a step");
    let state = sim.state();
    let residual = servo.constraint_residual(2.0, state);
    assert!(residual.blade.abs() < 1e-12 && residual.servo.abs() < 1e-12, "{residual:?}");
    // the heading is the integral of the turn, and the speed along it stays
    let heading = 1.5 * (2.0 - 0.5 * (1.0 - (-4.0_f64).exp()));
    assert!((state.heading - heading).abs() < 1e-4, "{} for {heading}", state.heading);
    assert!((state.x_dot.hypot(state.y_dot) - 1.0).abs() < 1e-4, "{state:?}");
}

/// A mass on a circle, pushed by a force that lags behind what is asked for.
#[nonholonomic(
    base       { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) - m * g * y }
    holonomic  { circle: x^2 + y^2 = l^2; }
    inputs     { wanted }
    auxiliary  { der(push) = (wanted - push) / lag; }
    forces     { x: push; }
    emit       { symmetric_projection }
)]
#[derive(Clone, Copy, Debug)]
struct Pushed {
    m: f64,
    g: f64,
    l: f64,
    lag: f64,
}

#[test]
fn a_symmetric_projection_leaves_auxiliary_states_to_their_equations() {
    let pushed = Pushed { m: 1.0, g: 9.81, l: 1.0, lag: 0.3 };
    let start = PushedState { x: 0.0, y: -1.0, x_dot: 1.5, y_dot: 0.0, push: 0.0 };
    let method = ImplicitMidpoint::new(0.01).symmetrically_projected();
    let mut sim = Integrator::new(pushed, method, 0.0, start);
    sim.set_input(PushedInput { wanted: 2.0 });
    sim.advance_to(3.0).expect("a step");
    let state = sim.state();
    // the midpoint rule multiplies what is left by (1 − z/2) / (1 + z/2) with z = h / lag
    let half: f64 = 0.01 / 0.3 / 2.0;
    let left = ((1.0 - half) / (1.0 + half)).powi(300);
    assert!((state.push - 2.0 * (1.0 - left)).abs() < 1e-11, "{}", state.push);
    let residual = pushed.constraint_residual(3.0, state);
    assert!(residual.circle.abs() < 1e-12, "{residual:?}");
    assert!(state.x.abs() > 0.05, "it is pushed aside: {}", state.x);
}

/// A mass behind two lags: the rate of the first is made of that of the second, which is declared behind it and calls a method.
#[nonholonomic(
    base        { x }
    lagrangian  { m / 2 * der(x)^2 }
    inputs      { wanted }
    auxiliary   { der(first) = der(second) + x; der(second) = self.limited(wanted) - second; der(third) = 3 * second; }
    forces      { x: first; }
    emit        { gibbs_appell }
)]
#[derive(Clone, Copy, Debug)]
struct Lagging {
    m: f64,
}

impl Lagging {
    fn limited(self, wanted: f64) -> f64 {
        wanted.clamp(-self.m / 2.0, self.m / 2.0)
    }
}

#[test]
fn rates_are_declared_in_any_order() {
    let lagging = Lagging { m: 2.0 };
    let state = LaggingState { x: 0.5, x_dot: 0.25, first: 4.0, second: -0.75, third: 0.0 };
    let rates = LaggingState { x: 0.25, x_dot: 2.0, first: 2.25, second: 1.75, third: -2.25 };
    let input = LaggingInput { wanted: 3.0 };
    assert_eq!(lagging.derivative(0.0, &state, &input), rates);
    assert_eq!(lagging.gibbs_appell(0.0, &state, &input), rates);
}
