//! What is no state on the constraints is not linearised, and what has no derivative is named; constraints on velocities are
//! equations of a trim.

use nonholonomic::LinearizationError;
use nonholonomic::prelude::*;

/// A skate whose velocities are all in the state.
#[nonholonomic(
    base { x, y, theta }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) + J / 2 * der(theta)^2 }
    constraints { skate: sin(theta) * der(x) = cos(theta) * der(y); }
    forces { x: push; }
    inputs { push }
    formulation { projected }
    linearization { keep: theta, der(theta); }
)]
#[derive(Clone, Copy, Debug)]
struct Skate {
    m: f64,
    J: f64,
}

#[test]
fn a_state_off_the_constraints_on_velocities_is_refused() {
    let skate = Skate { m: 1.0, J: 0.2 };
    for unit in [1e-200, 1e-9, 1.0, 1e9, 1e200] {
        let at = |x_dot: f64, y_dot: f64| {
            let state =
                SkateState { theta: 0.3, x_dot: x_dot * unit, y_dot: y_dot * unit, ..SkateState::default() };
            skate.linearize(0.0, &state, &SkateInput { push: 0.0 })
        };
        assert!(at(1.0, 0.3_f64.tan()).is_ok() && at(1.0, 0.3_f64.tan() + 1e-8).is_ok());
        let error = at(1.0, 0.5).unwrap_err();
        let LinearizationError::OffConstraints { constraint: "skate", residual } = error else {
            panic!("{error}")
        };
        assert!((residual / unit - (0.3_f64.sin() - 0.5 * 0.3_f64.cos())).abs() < 1e-15, "{residual}");
        assert!(error.to_string().contains("`project` it to the constraints first"), "{error}");
    }
}

/// Going straight, wherever it is pushed: the constraint is one of the equations.
#[test]
fn a_trim_satisfies_constraints_on_velocities() {
    let skate = Skate { m: 1.0, J: 0.2 };
    let guess = SkateState { x_dot: 1.0, y_dot: 0.2, theta: 0.3, theta_dot: 0.1, ..SkateState::default() };
    let held = [SkateVariable::theta, SkateVariable::x_dot];
    let (state, input) = skate.trim(0.0, &guess, &SkateInput { push: 0.2 }, &held).unwrap();
    assert!((state.y_dot - 0.3_f64.tan()).abs() < 1e-15 && (state.x_dot - 1.0).abs() < 1e-15, "{state:?}");
    assert!(state.theta_dot.abs() < 1e-16 && input.push.abs() < 1e-16, "{state:?} {input:?}");
    assert!(skate.linearize(0.0, &state, &input).is_ok());
}

/// A point on a circle, in x and y from its lowest point, and a spring that gets stiffer by a root.
#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) - m * g * y - k / 2 * sqrt(c) * x^2 }
    holonomic { circle: x^2 + (y - l)^2 = l^2; }
    assume { m > 0; l > 0; c >= 0; }
    linearization { keep: x, der(x); }
)]
#[derive(Clone, Copy, Debug)]
struct Pendulum {
    m: f64,
    l: f64,
    g: f64,
    k: f64,
    c: f64,
}

#[test]
fn near_to_the_origin_rounding_of_lengths_is_no_distance() {
    for unit in [1e-12, 1e-3, 1.0, 1e9] {
        let pendulum = Pendulum { m: 1.0, l: 0.3 * unit, g: 9.81 * unit, k: 1.0, c: 1.0 };
        for off in [0.0, 1e-17, -4e-17] {
            let state = PendulumState { y: off * unit, ..PendulumState::default() };
            let found =
                pendulum.linearize(0.0, &state, &()).unwrap_or_else(|error| panic!("{unit} {off}: {error}"));
            assert!((found.a[(1, 0)] + 9.81 / 0.3 + 1.0).abs() < 1e-12, "{unit} {off}: {found:?}");
        }
        let state = PendulumState { y: 1e-3 * unit, ..PendulumState::default() };
        let error = pendulum.linearize(0.0, &state, &()).unwrap_err();
        assert!(matches!(error, LinearizationError::OffConstraints { constraint: "circle", .. }), "{error}");
    }
}

#[test]
fn what_has_no_derivative_is_named() {
    let pendulum = Pendulum { m: 1.0, l: 0.3, g: 9.81, k: 1.0, c: 0.0 };
    // beside the lowest point, where what has none is multiplied by nothing
    let aside = PendulumState { x: 0.18, y: 0.06, ..PendulumState::default() };
    let error = pendulum.linearize(0.0, &aside, &()).unwrap_err();
    assert_eq!(error, LinearizationError::NotDifferentiable { of: "x_dot" });
    assert_eq!(
        error.to_string(),
        "`x_dot` has no finite derivatives at this state, though it has a value: it may take the root, or a power, of a \
         variable or a parameter that is 0; linearise at another state, or with another parameter"
    );
}
