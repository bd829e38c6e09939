//! The derivative of a return by everything that the return depends on.

use nonholonomic::prelude::*;

/// A skate on a ring that grows, with a blade that a servo turns: a constraint contains an auxiliary state.
#[nonholonomic(
    base { x, y, heading }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) + J / 2 * der(heading)^2 - g * y }
    holonomic { ring: x^2 + y^2 = (l + v * t)^2; }
    constraints { blade: der(heading) * cos(turn) = (x * der(y) - y * der(x)) * sin(turn); }
    inputs { wanted }
    auxiliary { der(turn) = (wanted - turn) / lag; }
    emit { jacobian, return_jacobian }
)]
#[derive(Clone, Copy, Debug)]
struct Turned {
    m: f64,
    J: f64,
    g: f64,
    l: f64,
    v: f64,
    lag: f64,
}

/// A mass that grows with its speed along x: what a return moves depends on the velocities.
#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) + b / 4 * der(x)^4 - m * g * y }
    holonomic { rod: x^2 + y^2 = l^2; }
    emit { jacobian, return_jacobian }
)]
#[derive(Clone, Copy, Debug)]
struct Heavy {
    m: f64,
    b: f64,
    g: f64,
    l: f64,
}

/// Whether derivatives are those of a function, by differences of fifth order.
fn differentiates<const N: usize>(
    slopes: &[[f64; N]; N],
    from: [f64; N],
    function: impl Fn([f64; N]) -> [f64; N],
) {
    let step = 1e-3;
    for column in 0..N {
        let at = |by: f64| {
            let mut there = from;
            there[column] += by * step;
            function(there)
        };
        let ends = [-2.0, -1.0, 1.0, 2.0].map(at);
        for (row, slopes) in slopes.iter().enumerate() {
            let [a, b, c, d] = ends.map(|end| end[row]);
            let slope = (a - 8.0 * b + 8.0 * c - d) / (12.0 * step);
            let found = slopes[column];
            assert!((found - slope).abs() < 1e-9, "{row} by {column}: {found} and not {slope}");
        }
    }
}

#[test]
fn returns_are_differentiated_by_auxiliary_states() {
    let turned = Turned { m: 1.2, J: 0.3, g: 2.0, l: 0.9, v: 0.2, lag: 0.4 };
    let mut start =
        TurnedState { x: 0.5, y: 0.8, heading: 0.2, x_dot: -0.7, y_dot: 0.6, heading_dot: 0.5, turn: 0.6 };
    turned.project(0.3, &mut start).expect("it is near");
    for off in [0.0, 0.02] {
        let from = TurnedState { x: start.x + off, x_dot: start.x_dot - off, ..start };
        differentiates(&turned.return_jacobian(0.3, &from), from.to_array(), |state| {
            let mut state = TurnedState::from_array(state);
            turned.correct_positions(0.3, &mut state);
            state.to_array()
        });
    }
    // and with it the step that ends with the return
    let input = TurnedInput { wanted: 0.7 };
    let step = Rk4::linearized_step(&turned, 0.3, 0.1, &start, &input);
    let by_state = core::array::from_fn(|row| core::array::from_fn(|column| step.by_state[(row, column)]));
    differentiates(&by_state, start.to_array(), |state| {
        Rk4::step(&turned, 0.3, 0.1, &TurnedState::from_array(state), &input).to_array()
    });
}

#[test]
fn returns_are_differentiated_by_velocities_that_masses_depend_on() {
    let heavy = Heavy { m: 1.0, b: 2.0, g: 9.81, l: 1.0 };
    for off in [0.0, 0.02] {
        let from = HeavyState { x: 0.6 + off, y: -0.8, x_dot: 0.8, y_dot: 0.6 - off };
        differentiates(&heavy.return_jacobian(0.0, &from), from.to_array(), |state| {
            let mut state = HeavyState::from_array(state);
            heavy.correct_positions(0.0, &mut state);
            state.to_array()
        });
    }
}

/// A weight on a rope that also spins, of which the height alone is followed: the angle of the spin is left out.
#[nonholonomic(
    base { spin, x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) + J / 2 * der(spin)^2 - m * g * y }
    holonomic { rope: x^2 + y^2 = l^2; }
    constraints { slip: der(x) = r * tan(lean) * der(spin); }
    inputs { wanted }
    auxiliary { der(lean) = (wanted - lean) / lag; }
    outputs { height = y; }
    track { height }
    emit { jacobian, return_jacobian }
)]
#[derive(Clone, Copy, Debug)]
struct Followed {
    m: f64,
    J: f64,
    g: f64,
    l: f64,
    r: f64,
    lag: f64,
}

#[test]
fn returns_of_a_slice_are_differentiated_by_what_is_left() {
    let followed = Followed { m: 1.0, J: 0.3, g: 9.81, l: 1.0, r: 0.4, lag: 0.2 };
    let mut start = FollowedState { x: 0.6, y: -0.8, x_dot: 0.8, y_dot: 0.6, spin_dot: 2.0, lean: 0.7 };
    followed.project(0.0, &mut start).expect("it is near");
    for off in [0.0, 0.02] {
        let from = FollowedState { x: start.x + off, y_dot: start.y_dot - off, ..start };
        differentiates(&followed.return_jacobian(0.0, &from), from.to_array(), |state| {
            let mut state = FollowedState::from_array(state);
            followed.correct_positions(0.0, &mut state);
            state.to_array()
        });
    }
}
