//! Parts that are alike: where positions hold has several branches, and equal lengths are in several equations.

use nonholonomic::prelude::*;

/// Five posts at equal distances, joined by bars of that length; all are uniform rods. (N four-bars are a problem of the
/// IFToMM library of multibody problems: all links come in line together, where each of them could fold.)
#[nonholonomic(
    base { x[5], y[5] }
    holonomic {
        for i in 0..5 { post: (x[i] - i * l)^2 + y[i]^2 = l^2; }
        for i in 0..4 { bar: (x[i+1] - x[i])^2 + (y[i+1] - y[i])^2 = l^2; }
    }
    lagrangian {
        sum(i in 0..5: m / 6 * (der(x[i])^2 + der(y[i])^2) - m * g * y[i] / 2)
        + sum(i in 0..4: m / 6 * (der(x[i])^2 + der(y[i])^2 + der(x[i+1])^2 + der(y[i+1])^2
            + der(x[i]) * der(x[i+1]) + der(y[i]) * der(y[i+1])) - m * g * (y[i] + y[i+1]) / 2)
    }
)]
#[derive(Clone, Copy, Debug)]
struct FourBars {
    m: f64,
    l: f64,
    g: f64,
}

/// The same while all posts are parallel: 5 m l²/3 of the posts, 4 m l² of the bars.
#[nonholonomic(
    base { angle }
    lagrangian { 17 / 6 * m * l^2 * der(angle)^2 - 13 / 2 * m * g * l * sin(angle) }
)]
#[derive(Clone, Copy, Debug)]
struct Parallel {
    m: f64,
    l: f64,
    g: f64,
}

#[test]
fn posts_swing_in_parallel_until_they_lie() {
    let bars = FourBars { m: 1.5, l: 0.8, g: 9.81 };
    let post = Parallel { m: 1.5, l: 0.8, g: 9.81 };
    // upright, pushed with 1 m/s
    let x = core::array::from_fn(|i| 0.8 * [0.0, 1.0, 2.0, 3.0, 4.0][i]);
    let start = FourBarsState { x, y: [0.8; 5], x_dot: [1.0; 5], y_dot: [0.0; 5] };
    let method = Dop853::new().rtol(1e-11).atol(1e-11);
    let mut all = Integrator::new(bars, method, 0.0, start);
    let angle = ParallelState { angle: core::f64::consts::FRAC_PI_2, angle_dot: -1.0 / 0.8 };
    let mut one = Integrator::new(post, method, 0.0, angle);
    for tenth in 1..=5 {
        let time = f64::from(tenth) / 10.0;
        all.advance_to(time).unwrap();
        one.advance_to(time).unwrap();
        let (sin, cos) = one.state().angle.sin_cos();
        for (i, (x, y)) in all.state().x.iter().zip(all.state().y).enumerate() {
            assert!((x - start.x[i] - 0.8 * cos).abs() < 1e-9 && (y - 0.8 * sin).abs() < 1e-9, "{time} {i}");
        }
    }
}

/// Two arms of one length r, that slides and grows, with their ends at one height z over the ground: r (sin a − sin b) = 0,
/// where r is not 0.
#[nonholonomic(
    base { z, r, a, b }
    holonomic { one: r * sin(a) = z; other: r * sin(b) = z; length: r^2 = L^2 + z^2; }
    lagrangian { m / 2 * (der(z)^2 + der(r)^2) + J / 2 * (der(a)^2 + der(b)^2) - m * g * z }
)]
#[derive(Clone, Copy, Debug)]
struct Arms {
    m: f64,
    J: f64,
    g: f64,
    L: f64,
}

/// By the angle of one of them: r = L / cos a, z = L tan a.
#[nonholonomic(
    base { a }
    lagrangian {
        m / 2 * (der(L * tan(a))^2 + der(L / cos(a))^2) + J * der(a)^2 - m * g * L * tan(a)
    }
)]
#[derive(Clone, Copy, Debug)]
struct ByAngle {
    m: f64,
    J: f64,
    g: f64,
    L: f64,
}

#[test]
fn arms_of_one_length_mirror_each_other() {
    let arms = Arms { m: 0.4, J: 0.03, g: 9.81, L: 0.5 };
    let angle = ByAngle { m: 0.4, J: 0.03, g: 9.81, L: 0.5 };
    let state = ByAngleState { a: 0.6, a_dot: -0.7 };
    let (sin, cos) = state.a.sin_cos();
    let start = ArmsState {
        z: 0.5 * sin / cos,
        r: 0.5 / cos,
        a: 0.6,
        b: core::f64::consts::PI - 0.6,
        z_dot: 0.5 / (cos * cos) * -0.7,
        r_dot: 0.5 * sin / (cos * cos) * -0.7,
        a_dot: -0.7,
        b_dot: 0.7,
    };
    let (all, one) = (arms.derivative(0.0, &start, &()), angle.derivative(0.0, &state, &()));
    assert!((all.a_dot - one.a_dot).abs() < 1e-12 * one.a_dot.abs(), "{} {}", all.a_dot, one.a_dot);
    assert!((all.a_dot + all.b_dot).abs() < 1e-12 * one.a_dot.abs());
}
