//! Machines at rest, and out of contact: forces whose parts have no derivatives there, while they have.

use nonholonomic::prelude::*;

/// A puck on a spring, with the drag of air: −c |v| v.
#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) - k / 2 * (x^2 + y^2) }
    forces {
        x: push - c * sqrt(der(x)^2 + der(y)^2) * der(x);
        y: -c * sqrt(der(x)^2 + der(y)^2) * der(y);
    }
    inputs { push }
    assume { m > 0; }
    linearization { keep: x, y, der(x), der(y); }
)]
#[derive(Clone, Copy, Debug)]
struct Puck {
    m: f64,
    k: f64,
    c: f64,
}

#[test]
fn drag_has_no_slope_at_rest() {
    let puck = Puck { m: 2.0, k: 6.0, c: 0.7 };
    let guess = PuckState { x: 0.1, y: -0.2, x_dot: 0.3, y_dot: 0.1 };
    let push = PuckInput { push: 1.5 };
    for guess in [guess, PuckState { x_dot: 0.0, y_dot: 0.0, ..guess }] {
        let (rest, input) = puck.trim(0.0, &guess, &push, &[PuckVariable::push]).expect("it rests");
        assert!((rest.x - 0.25).abs() < 1e-15 && rest.y.abs() < 1e-15, "{rest:?}");
        assert!(rest.x_dot.abs() < 1e-12 && rest.y_dot.abs() < 1e-12 && input == push, "{rest:?}");
    }
    let rest = PuckState { x: 0.25, ..PuckState::default() };
    let model = puck.linearize(0.0, &rest, &push).expect("it has derivatives");
    #[rustfmt::skip]
    let expected = nalgebra::Matrix4::new(
        0.0, 0.0, 1.0, 0.0,
        0.0, 0.0, 0.0, 1.0,
        -3.0, 0.0, 0.0, 0.0,
        0.0, -3.0, 0.0, 0.0,
    );
    assert!((model.a - expected).abs().max() < 1e-15, "{}", model.a);
}

/// A ball over elastic ground, after Hertz, with friction that is smoothed where it moves slowly.
#[nonholonomic(
    base { height }
    lagrangian { m / 2 * der(height)^2 - m * g * height }
    forces { height: lift + stiffness * max(0, -height)^(3/2) - f * der(height) / (slow + abs(der(height))); }
    inputs { lift }
    assume { m > 0; slow > 0; }
    linearization { keep: height, der(height); }
)]
#[derive(Clone, Copy, Debug)]
struct Ball {
    m: f64,
    g: f64,
    stiffness: f64,
    f: f64,
    slow: f64,
}

#[test]
fn ground_that_is_not_touched_has_no_slope() {
    let ball = Ball { m: 2.0, g: 9.81, stiffness: 1e4, f: 0.1, slow: 0.01 };
    let above = BallState { height: 1.0, height_dot: 0.0 };
    let (state, input) =
        ball.trim(0.0, &above, &BallInput::default(), &[BallVariable::height]).expect("it is carried");
    assert!(state == above && (input.lift - 19.62).abs() < 1e-14, "{state:?} {input:?}");
    // where it touches the ground both sides have the same slope
    for height in [1.0, 0.0] {
        let state = BallState { height, height_dot: 0.0 };
        let model = ball.linearize(0.0, &state, &input).expect("it has derivatives");
        assert!(model.a[(1, 0)] == 0.0 && (model.a[(1, 1)] + 5.0).abs() < 1e-14, "{}", model.a);
    }
    let pressed = BallState { height: -0.01, height_dot: 0.0 };
    let model = ball.linearize(0.0, &pressed, &input).expect("it has derivatives");
    assert!((model.a[(1, 0)] + 0.5 * 1.5 * 1e4 * 0.1).abs() < 1e-10, "{}", model.a);
}
