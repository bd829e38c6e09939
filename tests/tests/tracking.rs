//! Tracked systems are smaller, and agree with the whole ones on what they keep.

// what is kept has the same bits
#![allow(clippy::float_cmp)]

use nh_tests::random::Random;
use nonholonomic::prelude::*;

/// One sleigh, tracked in several ways.
macro_rules! sleigh {
    ($name:ident, $($section:ident { $($content:tt)* })*) => {
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
            forces      { omega: torque - c * omega; }
            inputs      { torque }
            $($section { $($content)* })*
        )]
        #[derive(Clone, Copy, Debug)]
        struct $name { m: f64, J: f64, a: f64, c: f64 }

        impl Default for $name {
            fn default() -> Self {
                Self { m: 1.3, J: 0.7, a: 0.4, c: 0.2 }
            }
        }
    };
}

sleigh!(Whole, outputs { speed = abs(v1); } emit { jacobian, multipliers });
sleigh!(Velocities, outputs { speed = abs(v1); } track { omega, v1 } emit { jacobian, multipliers });
sleigh!(Heading, track { theta });
sleigh!(Northing, outputs { north = 2 * y; } track { north });

/// On an embedded base, with a potential: nothing but the position may be left out.
#[nonholonomic(
    base { s, g[3] }
    basis { w[3], v }
    anchor {
        der(s) = v;
        der(g[0]) = g[1] * w[2] - g[2] * w[1];
        der(g[1]) = g[2] * w[0] - g[0] * w[2];
        der(g[2]) = g[0] * w[1] - g[1] * w[0];
    }
    on { dot(g, g) = 1; }
    lagrangian { dot(w, w) / 2 + m / 2 * v^2 - g[2] }
    brackets so(3) { w[0], w[1], w[2] }
    constraints { dot(g, w) = 0; }
    track { w }
)]
#[derive(Clone, Copy, Debug)]
struct Embedded {
    m: f64,
}

/// Energy depends on the height, which nothing else does.
#[nonholonomic(base { x, h } lagrangian { m / 2 * (der(x)^2 + der(h)^2) - m * g * h } track { der(h), x })]
#[derive(Clone, Copy, Debug)]
struct Falling {
    m: f64,
    g: f64,
}

#[test]
fn velocities_alone() {
    let (whole, tracked) = (Whole::default(), Velocities::default());
    let mut random = Random::new(3);
    for _ in 0..100 {
        let [theta, x, y, omega, v1, torque]: [f64; 6] = std::array::from_fn(|_| random.between(-2.0, 2.0));
        let large = WholeState { theta, x, y, omega, v1 };
        let small = VelocitiesState { omega, v1 };
        let (large_input, small_input) = (WholeInput { torque }, VelocitiesInput { torque });
        let (of_whole, of_tracked) =
            (whole.derivative(0.0, &large, &large_input), tracked.derivative(0.0, &small, &small_input));
        same(of_whole.omega, of_tracked.omega);
        same(of_whole.v1, of_tracked.v1);
        same(whole.energy(0.0, &large), tracked.energy(0.0, &small));
        same(whole.velocity(0.0, &large).omega, tracked.velocity(0.0, &small).omega);
        let speeds = (whole.outputs(0.0, &large, &large_input), tracked.outputs(0.0, &small, &small_input));
        same(speeds.0.speed, speeds.1.speed);
        let (a, b) = whole.jacobian(0.0, &large, &large_input);
        let (a_small, b_small) = tracked.jacobian(0.0, &small, &small_input);
        assert!((a.fixed_view::<2, 2>(3, 3) - a_small).iter().all(|gap| gap.abs() < 1e-14));
        assert!((b.fixed_view::<2, 1>(3, 0) - b_small).iter().all(|gap| gap.abs() < 1e-14));
    }
    assert!(!counts(Velocities::REPORT).contains("sin_cos"));
    assert!(counts(Whole::REPORT).contains("sin_cos"));
    assert!(Velocities::REPORT.contains("left out: theta, x, y"), "{}", Velocities::REPORT);
}

/// A body that slides in space, with a spring in height.
macro_rules! slider {
    ($name:ident, $($section:ident { $($content:tt)* })*) => {
        #[nonholonomic(
            base { x, y, z }
            lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) - k / 2 * y^2 }
            inputs { lift }
            forces { y: lift - c * der(y); }
            outputs { place = [x, y, z]; sideways = x; pace = der(x) * lift; height = y * der(y); grid = [[x, z], [z, x]]; }
            units { x, y, z = m; t = s; m = kg; lift = N; }
            emit { output_jacobian, bracket, c, latex }
            linearization { keep: y, der(y); }
            $($section { $($content)* })*
        )]
        #[derive(Clone, Copy, Debug)]
        struct $name { m: f64, k: f64, c: f64 }
    };
}

slider!(Everywhere,);
slider!(Upwards, track { der(x), y });

#[test]
fn outputs_that_need_what_is_left_out_go() {
    let (whole, part) = (Everywhere { m: 1.3, k: 0.7, c: 0.2 }, Upwards { m: 1.3, k: 0.7, c: 0.2 });
    let (y, x_dot, y_dot) = (0.4, -0.3, 0.9);
    let large = EverywhereState { x: 1.1, y, z: -2.0, x_dot, y_dot, z_dot: 0.2 };
    let small = UpwardsState { y, x_dot, y_dot };
    let (large_input, small_input) = (EverywhereInput { lift: 0.5 }, UpwardsInput { lift: 0.5 });
    let all = whole.outputs(0.0, &large, &large_input);
    // nothing else is a field
    let UpwardsOutputs { place_1, pace, height } = part.outputs(0.0, &small, &small_input);
    assert_eq!([place_1, pace, height], [all.place[1], all.pace, all.height]);
    assert_eq!(
        <[f64; 3]>::from(Observed::outputs(&part, 0.0, &small, &small_input)),
        [place_1, pace, height]
    );
    let (outputs, variables) = ([1, 4, 5], [1, 3, 4]);
    let (c_whole, d_whole) = whole.output_jacobian(0.0, &large, &large_input);
    let (c, d) = part.output_jacobian(0.0, &small, &small_input);
    let of_all = whole.bracket(0.0, &large, &large_input);
    let brackets = part.bracket(0.0, &small, &small_input);
    for (row, output) in outputs.into_iter().enumerate() {
        assert_eq!(d[row], d_whole[output]);
        for (column, variable) in variables.into_iter().enumerate() {
            assert_eq!(c[(row, column)], c_whole[(output, variable)]);
        }
        for (column, other) in outputs.into_iter().enumerate() {
            assert_eq!(brackets[(row, column)], of_all[(output, other)]);
        }
    }
    let rates = part.bracket_with_energy(0.0, &small, &small_input);
    let drifts = part.drift_of_outputs(0.0, &small, &small_input);
    assert_eq!(rates.height, whole.bracket_with_energy(0.0, &large, &large_input).height);
    assert_eq!(drifts.height, whole.drift_of_outputs(0.0, &large, &large_input).height);
    let model = part.linearize(0.0, &small, &small_input).unwrap();
    let of_whole = whole.linearize(0.0, &large, &large_input).unwrap();
    assert_eq!(model.c.row(2), of_whole.c.row(5));
    for declared in [
        "upwards_outputs(const Upwards *p, double t, const UpwardsState *x, const UpwardsInput *u, double result[3])",
        "u, double result[12])",
    ] {
        assert!(Upwards::C99.contains(declared), "{}", Upwards::C99);
    }
    for told in ["the output `place[0]`, which depends on x", "the output `grid`, which depends on x, z"] {
        assert!(Upwards::REPORT.contains(told), "{}", Upwards::REPORT);
        assert!(Upwards::LATEX.contains("left out"), "{}", Upwards::LATEX);
    }
}

/// Equal up to the order of operations.
fn same(a: f64, b: f64) {
    assert!((a - b).abs() <= 1e-14 * (1.0 + b.abs()), "{a} is not {b}");
}

/// The operations of the derivative.
fn counts(report: &str) -> &str {
    report.lines().find(|line| line.trim_start().starts_with("derivative: ")).unwrap_or_default()
}

#[test]
fn what_flows_into_a_coordinate_or_an_output() {
    let heading = HeadingState { theta: 0.1, omega: 0.2, v1: 0.3 };
    let rate = Heading::default().derivative(0.0, &heading, &HeadingInput { torque: 0.0 });
    same(rate.theta, 0.2);
    let start = NorthingState { theta: 0.1, y: 0.0, omega: 0.2, v1: 0.3 };
    let mut small = Integrator::new(Northing::default(), Dopri5::new(), 0.0, start);
    let start = WholeState { theta: 0.1, x: 0.0, y: 0.0, omega: 0.2, v1: 0.3 };
    let mut large = Integrator::new(Whole::default(), Dopri5::new().rtol(1e-9), 0.0, start);
    small.advance_to(3.0).unwrap();
    large.advance_to(3.0).unwrap();
    assert!((small.state().y - large.state().y).abs() < 1e-5);
    let north = Northing::default().outputs(3.0, small.state(), &NorthingInput { torque: 0.0 }).north;
    same(north, 2.0 * small.state().y);
}

#[test]
fn constraints_and_identities_keep_what_they_need() {
    let embedded = Embedded { m: 1.0 };
    let mut state = EmbeddedState { g: [0.6, 0.0, 0.8], w: [0.4, 0.3, 0.1], v: 1.0 };
    embedded.project(0.0, &mut state).unwrap();
    assert!(Constrained::constraint_residual(&embedded, 0.0, &state).iter().all(|r| r.abs() < 1e-15));
    let mut sim = Integrator::new(embedded, Dopri5::new(), 0.0, state);
    sim.advance_to(1.0).unwrap();
}

#[test]
fn the_energy_goes_with_what_it_depends_on() {
    let start = FallingState { x: 1.0, x_dot: 2.0, h_dot: 3.0 };
    let rate = Falling { m: 1.0, g: 9.81 }.derivative(0.0, &start, &());
    assert_eq!(rate, FallingState { x: 2.0, x_dot: 0.0, h_dot: -9.81 });
    assert!(Falling::REPORT.contains("left out: h, the energy"), "{}", Falling::REPORT);
    assert!(!Falling::REPORT.contains("energy: "));
}
