//! The power of forces and constraints is the rate of the energy, mathematics (41); output Jacobians.
#![allow(non_snake_case, reason = "parameters are written as in mechanics: J, I")]

use nonholonomic::prelude::*;

/// A driven sleigh on a belt, with a blade that an auxiliary state turns, a frame, and forces of each kind.
macro_rules! sleigh {
    ($name:ident, $($more:tt)*) => {
        #[nonholonomic(
            base   { theta, x, y }
            basis  { omega, v1, v2 }
            anchor {
                der(theta) = omega;
                der(x) = v1 * cos(theta) - v2 * sin(theta);
                der(y) = v1 * sin(theta) + v2 * cos(theta);
            }
            lagrangian  {
                (J + m * a^2) / 2 * omega^2 + m / 2 * (v1^2 + v2^2) + m * a * omega * v2 - m * x * sin(theta + t)
            }
            auxiliary   { der(angle) = command - angle; }
            inputs      { command, torque }
            constraints { blade: v2 = tan(angle) * v1 - U * cos(t) * sin(theta); }
            forces      { omega: torque - c * omega; v1: -self.drag(v1); x: sin(t) * y + angle; }
            derivative  { drag: [self.drag_slope]; }
            outputs     { heading = theta + angle; speed = v1 * (1 + torque) - self.drag(v1); }
            emit        { power, output_jacobian }
            $($more)*
        )]
        #[derive(Clone, Copy, Debug)]
        struct $name { m: f64, J: f64, a: f64, U: f64, c: f64 }

        impl $name {
            fn drag(&self, speed: f64) -> f64 {
                self.c * speed * speed * speed
            }
            fn drag_slope(&self, speed: f64) -> f64 {
                3.0 * self.c * speed * speed
            }
        }
    };
}

sleigh!(Sleigh, names { power = Powers; });
sleigh!(Projected, formulation { projected });

/// Nonlinear: the speed grows by itself, which takes power.
#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) - m * g * y }
    constraints { pace: der(x)^2 + der(y)^2 = (u + w * t)^2; }
    emit { power }
)]
#[derive(Clone, Copy, Debug)]
struct Pace<T> {
    m: T,
    g: T,
    u: T,
    w: T,
}

/// The slope of a function at 0, by central differences of two lengths.
fn slope(function: impl Fn(f64) -> f64) -> f64 {
    let difference = |h: f64| (function(h) - function(-h)) / (2.0 * h);
    let h = 1e-3;
    (4.0 * difference(h / 2.0) - difference(h)) / 3.0
}

fn close(what: &str, found: f64, expected: f64) {
    assert!((found - expected).abs() < 1e-9 * (1.0 + expected.abs()), "{what}: {found} for {expected}");
}

/// The rate of the energy along the motion is the total, less that of the Lagrangian at a fixed state.
macro_rules! obeys_the_law {
    ($n:literal, $system:expr, $t:expr, $numbers:expr, $state:ident, $input:expr, $lagrangian_rate:expr) => {{
        let (system, t, numbers): (_, f64, [f64; $n]) = ($system, $t, $numbers);
        let rates: [f64; $n] = system.derivative(t, &$state::from(numbers), $input).into();
        let ahead = |h: f64| $state::from(std::array::from_fn::<f64, $n, _>(|i| numbers[i] + h * rates[i]));
        let rate = slope(|h| system.energy(t + h, &ahead(h)));
        let power = system.power(t, &$state::from(numbers), $input);
        close("power", power.total() - $lagrangian_rate, rate);
        power
    }};
}

#[test]
fn the_energy_changes_by_the_power() {
    let [m, J, a, U, c] = [1.3, 0.7, 0.4, 0.6, 0.2];
    let (t, theta, x, v1, torque): (f64, f64, f64, f64, f64) = (0.7, 0.3, -1.1, 0.9, 0.5);
    let lagrangian_rate = -m * x * (theta + t).cos();
    let sleigh = Sleigh { m, J, a, U, c };
    let input = &SleighInput { command: 0.3, torque };
    let numbers = [theta, x, 0.4, 1.2, v1, 0.25];
    let power = obeys_the_law!(6, sleigh, t, numbers, SleighState, input, lagrangian_rate);
    let Powers { forces, constraints } = power;
    // by hand: along a section, by a method, and along a coordinate
    close("omega", forces.omega, (torque - c * 1.2) * 1.2);
    close("v1", forces.v1, -c * v1.powi(4));
    let v2 = 0.25_f64.tan() * v1 - U * t.cos() * theta.sin();
    close("x", forces.x, (t.sin() * 0.4 + 0.25) * (v1 * theta.cos() - v2 * theta.sin()));
    assert!(constraints.blade.abs() > 1e-3, "{constraints:?}");
    // the other formulation, on the constraint manifold
    let projected = Projected { m, J, a, U, c };
    let numbers = [theta, x, 0.4, 1.2, v1, v2, 0.25];
    let input = &ProjectedInput { command: 0.3, torque };
    let other = obeys_the_law!(7, projected, t, numbers, ProjectedState, input, lagrangian_rate);
    close("blade", other.constraints.blade, constraints.blade);
    // C and D of both agree where the outputs depend on what they share
    let (_, by_input) = projected.output_jacobian(t, &numbers.into(), input);
    close("D", by_input[(1, 1)], v1);
}

#[test]
fn a_nonlinear_constraint_has_a_power_where_it_is_not_homogeneous() {
    let pace = Pace { m: 1.3, g: 9.8, u: 1.1, w: 0.4 };
    let (t, angle): (f64, f64) = (0.7, 0.6);
    let speed = pace.u + pace.w * t;
    let numbers = [0.2, -0.3, speed * angle.cos(), speed * angle.sin()];
    let power = obeys_the_law!(4, pace, t, numbers, PaceState, &(), 0.0);
    close("pace", power.constraints.pace, pace.m * speed * pace.w + pace.m * pace.g * speed * angle.sin());
    // in single precision too
    let single = Pace { m: 1.3_f32, g: 9.8, u: 1.1, w: 0.4 };
    #[allow(clippy::cast_possible_truncation)]
    let state = PaceState::from(numbers.map(|x| x as f32));
    assert!((f64::from(single.power(0.7, &state, &()).total()) - power.total()).abs() < 1e-4);
}

#[test]
fn output_jacobians_are_slopes_of_the_outputs() {
    let sleigh = Sleigh { m: 1.3, J: 0.7, a: 0.4, U: 0.6, c: 0.2 };
    let (t, numbers, inputs) = (0.7, [0.3, -1.1, 0.4, 1.2, 0.9, 0.25], [0.3, 0.5]);
    let (by_state, by_input) = sleigh.output_jacobian(t, &numbers.into(), &inputs.into());
    let outputs = |numbers: [f64; 6], inputs: [f64; 2]| -> [f64; 2] {
        sleigh.outputs(t, &numbers.into(), &inputs.into()).into()
    };
    for i in 0..2 {
        for j in 0..6 {
            let along = |h: f64| std::array::from_fn(|k| numbers[k] + if j == k { h } else { 0.0 });
            close("C", by_state[(i, j)], slope(|h| outputs(along(h), inputs)[i]));
        }
        for j in 0..2 {
            let along = |h: f64| std::array::from_fn(|k| inputs[k] + if j == k { h } else { 0.0 });
            close("D", by_input[(i, j)], slope(|h| outputs(numbers, along(h))[i]));
        }
    }
}

/// Nothing does work on it, whatever its numbers are.
#[nonholonomic(
    base       { x }
    lagrangian { m / 2 * der(x)^2 }
    emit       { power }
)]
#[derive(Clone, Copy, Debug)]
struct Free<T> {
    m: T,
}

#[test]
fn what_nothing_acts_on_has_no_power() {
    let state = FreeState { x: 0.5_f32, x_dot: 2.0 };
    let total: f32 = Free { m: 3.0 }.power(0.0, &state, &()).total();
    assert_eq!(total.to_bits(), 0.0_f32.to_bits());
}
