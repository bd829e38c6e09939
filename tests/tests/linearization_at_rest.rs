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

/// A sphere in air with a propeller, which has a drag of its own at its tips: emitted Jacobians divide by lengths that
/// vanish at rest.
macro_rules! sphere {
    ($Sphere:ident, { $($accuracy:tt)* }, $T:ident) => {
        #[nonholonomic(
            base { x, y, z, turn }
            let v = [der(x), der(y), der(z)];
            let tip = sqrt((der(z) + k * der(x))^2 + (l * der(turn))^2);
            lagrangian {
                m / 2 * dot(v, v) + J / 2 * der(turn)^2 + e * cos(turn) * der(turn) * der(z) - m * g * z
            }
            forces {
                x: -c * norm(v) * der(x) - b * der(x) - k * d * tip * (der(z) + k * der(x));
                y: -c * norm(v) * der(y);
                z: lift - c * norm(v) * der(z) - d * tip * (der(z) + k * der(x));
                turn: torque - d * l^2 * tip * der(turn);
            }
            inputs { lift, torque }
            assume { m > 0; J > 0; l > 0; e^2 < m * J; }
            emit { jacobian, sparse_jacobian, jacobian_product, adjoint_product, parameter_jacobian }
            $($accuracy)*
        )]
        #[derive(Clone, Copy, Debug)]
        #[allow(non_snake_case, reason = "parameters are written as in mechanics: J")]
        struct $Sphere<$T> {
            m: $T,
            J: $T,
            e: $T,
            g: $T,
            k: $T,
            l: $T,
            b: $T,
            c: $T,
            d: $T,
        }
    };
}

sphere!(Fast, { accuracy { fast } }, T);
sphere!(Balanced, {}, T);
sphere!(Careful, { accuracy { careful } }, T);

/// The Jacobian at rest is that without drag, near it is near that, and all products agree with it.
macro_rules! goes_on {
    ($Sphere:ident, $State:ident, $Input:ident, $number:ty, $tolerance:expr) => {{
        let of = <$number as Scalar>::from_f64;
        let [m, J, e, g, k, l, b, c, d] = [1.2, 0.3, 0.2, 9.81, 0.4, 0.7, 0.1, 0.8, 0.6].map(of);
        let sphere = $Sphere { m, J, e, g, k, l, b, c, d };
        let smooth = $Sphere { c: of(0.0), d: of(0.0), ..sphere };
        let input = $Input { lift: of(3.0), torque: of(-0.4) };
        for turn in [0.0, 0.8, -2.0].map(of) {
            let rest = $State { turn, ..$State::default() };
            let (a, b) = sphere.jacobian(of(0.0), &rest, &input);
            assert_eq!((a, b), smooth.jacobian(of(0.0), &rest, &input), "at rest");
            for (x_dot, turn_dot) in [(1.0, 0.0), (0.0, -1.0), (0.3, 0.9)] {
                let [x_dot, turn_dot] = [x_dot, turn_dot].map(|speed| of($tolerance * speed));
                let slow = $State { x_dot, z_dot: -x_dot, turn_dot, ..rest };
                let (near, _) = sphere.jacobian(of(0.0), &slow, &input);
                assert!((near - a).abs().max() < of(30.0 * $tolerance), "{near} {a}");
            }
            let values = sphere.sparse_jacobian(of(0.0), &rest, &input);
            let places =
                $Sphere::<$number>::JACOBIAN_ROWS.into_iter().zip($Sphere::<$number>::JACOBIAN_COLUMNS);
            for (value, (row, column)) in values.iter().zip(places) {
                let entry = if column < 8 { a[(row, column)] } else { b[(row, column - 8)] };
                assert!((value - entry).abs() <= of(0.1 * $tolerance), "{value} {entry}");
            }
            let along = $State::from([of(1.0); 8]);
            let product = sphere.jacobian_product(of(0.0), &rest, &input, &along, &$Input::default());
            let (transposed, _) = sphere.adjoint_product(of(0.0), &rest, &input, &along);
            for (row, (of_row, of_column)) in
                product.to_array().into_iter().zip(transposed.to_array()).enumerate()
            {
                assert!((of_row - a.row(row).sum()).abs() < of(10.0 * $tolerance), "{of_row}");
                assert!((of_column - a.column(row).sum()).abs() < of(10.0 * $tolerance), "{of_column}");
            }
            let by_parameters = sphere.parameter_jacobian(of(0.0), &rest, &input);
            assert!(by_parameters.iter().all(|entry| entry.is_finite()), "{by_parameters}");
        }
    }};
}

#[test]
#[allow(non_snake_case, reason = "parameters are written as in mechanics: J")]
fn jacobians_go_on_to_rest() {
    goes_on!(Fast, FastState, FastInput, f64, 1e-9);
    goes_on!(Balanced, BalancedState, BalancedInput, f64, 1e-9);
    goes_on!(Balanced, BalancedState, BalancedInput, f32, 1e-4);
    goes_on!(Careful, CarefulState, CarefulInput, f64, 1e-9);
    for report in [Fast::<f64>::REPORT, Balanced::<f64>::REPORT, Careful::<f64>::REPORT] {
        assert!(!report.contains("may have no value"), "{report}");
    }
}

/// A sleigh with drag of its turning, by the velocities of its blade: where it goes straight ahead, the square of what it
/// turns by is 0, and multiplied out it would be a rounding error of either sign.
macro_rules! sleigh {
    ($Sleigh:ident, { $($accuracy:tt)* }) => {
        #[nonholonomic(
            base { x, y, theta }
            lagrangian { m / 2 * (der(x)^2 + der(y)^2) + J / 2 * der(theta)^2 }
            constraints { blade: der(y) * cos(theta) = der(x) * sin(theta) + l * der(theta); }
            forces {
                x: -c * norm([der(x), der(y)]) * der(x);
                y: -c * norm([der(x), der(y)]) * der(y);
                theta: -d * sqrt(der(theta)^2) * der(theta);
            }
            assume { m > 0; J > 0; l > 0; }
            emit { jacobian, jacobian_product, adjoint_product }
            $($accuracy)*
        )]
        #[derive(Clone, Copy, Debug)]
        #[allow(non_snake_case, reason = "parameters are written as in mechanics: J")]
        struct $Sleigh {
            m: f64,
            J: f64,
            l: f64,
            c: f64,
            d: f64,
        }
    };
}

sleigh!(FastSleigh, { accuracy { fast } });
sleigh!(BalancedSleigh, {});
sleigh!(CarefulSleigh, { accuracy { careful } });

macro_rules! goes_straight {
    ($Sleigh:ident, $State:ident) => {{
        let sleigh = $Sleigh { m: 1.3, J: 0.2, l: 0.3, c: 0.1, d: 0.4 };
        let smooth = $Sleigh { d: 0.0, ..sleigh };
        for (step, speed) in (0..2000).zip([0.0, 1.0, 0.37, 1e-3].into_iter().cycle()) {
            let theta = 0.01 * f64::from(step);
            let state =
                $State { theta, x_dot: speed * theta.cos(), y_dot: speed * theta.sin(), ..$State::default() };
            let [found, wanted] =
                [sleigh, smooth].map(|sleigh| sleigh.derivative(0.0, &state, &()).to_array());
            for (found, wanted) in found.into_iter().zip(wanted) {
                assert!((found - wanted).abs() < 1e-14, "{found} for {wanted} at {state:?}");
            }
            let [found, wanted] = [sleigh, smooth].map(|sleigh| sleigh.jacobian(0.0, &state, &()).0);
            assert!((found - wanted).abs().max() < 1e-14, "{found} {wanted}");
            let along = $State::from([1.0; 5]);
            let product = sleigh.jacobian_product(0.0, &state, &(), &along, &()).to_array();
            let (transposed, ()) = sleigh.adjoint_product(0.0, &state, &(), &along);
            for (place, (of_row, of_column)) in product.into_iter().zip(transposed.to_array()).enumerate() {
                assert!((of_row - wanted.row(place).sum()).abs() < 1e-13, "{of_row} {wanted}");
                assert!((of_column - wanted.column(place).sum()).abs() < 1e-13, "{of_column} {wanted}");
            }
        }
    }};
}

#[test]
fn what_goes_straight_has_values() {
    goes_straight!(FastSleigh, FastSleighState);
    goes_straight!(BalancedSleigh, BalancedSleighState);
    goes_straight!(CarefulSleigh, CarefulSleighState);
}
