//! Steady motions with a coordinate held that the linear model does not keep, but that goes with one it keeps.

use nonholonomic::TrimError;
use nonholonomic::prelude::*;

/// A weight on a rope that a motor pulls aside.
#[nonholonomic(
    base { x, y }
    holonomic { rope: x^2 + y^2 = l^2; }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) - m * g * y }
    inputs { volts }
    auxiliary { der(current) = (volts - R * current - k * der(x)) / L; }
    forces { x: k * current; }
    assume { L > 0; }
    linearization { keep: x, der(x), current; }
)]
#[derive(Clone, Copy, Debug)]
struct Aside {
    m: f64,
    l: f64,
    g: f64,
    R: f64,
    k: f64,
    L: f64,
}

const ASIDE: Aside = Aside { m: 0.9, l: 1.5, g: 9.81, R: 1.6, k: 1.5, L: 0.8 };

/// x is at rest where it is held by its height, from wherever it is looked for; the pull is m g tan of the angle.
#[test]
fn a_weight_is_held_at_a_height() {
    for (x, speed) in [(1.0, 0.0), (-0.3, 0.07), (1.2, -0.2), (0.4, -0.2)] {
        for y in [-1.2, -0.9, -0.4] {
            let guess = AsideState { x, y, x_dot: speed, y_dot: 0.5 * speed, current: 0.1 };
            let found = ASIDE.trim(0.0, &guess, &AsideInput { volts: -0.6 }, &[AsideVariable::y]);
            let (state, input) = found.unwrap_or_else(|error| panic!("{x} {y} {speed}: {error}"));
            let aside = f64::copysign((1.5_f64 * 1.5 - y * y).sqrt(), x);
            assert!((state.x - aside).abs() < 1e-12 && (state.y - y).abs() == 0.0, "{state:?}");
            assert!(state.x_dot.abs() < 1e-12 && state.y_dot.abs() < 1e-12, "{state:?}");
            let pull = -0.9 * 9.81 * aside / y;
            assert!((1.5 * state.current - pull).abs() < 1e-9, "{state:?}");
            assert!((input.volts - 1.6 * state.current).abs() < 1e-9, "{input:?}");
        }
    }
}

/// Where it is to rise at some rate it moves aside, too: that is no steady motion.
#[test]
fn a_weight_that_is_to_rise_is_not_at_rest() {
    for (x, rate) in [(1.0, 0.3), (0.8, -0.05), (-1.1, 1e-3)] {
        let guess = AsideState { x, y: -1.1, x_dot: 0.0, y_dot: rate, current: 1.0 };
        let held = [AsideVariable::y, AsideVariable::y_dot];
        let found = ASIDE.trim(0.0, &guess, &AsideInput { volts: 1.0 }, &held);
        assert!(matches!(found, Err(TrimError::NoSolution { .. })), "{x} {rate}: {found:?}");
    }
}

/// A top on a sphere of directions, driven.
#[nonholonomic(
    base { g[3] }
    basis { w[3] }
    anchor { der(g) = cross(g, w); }
    brackets so(3) { w[0], w[1], w[2] }
    on { dot(g, g) = 1; }
    lagrangian { (A * w[0]^2 + B * w[1]^2 + C * w[2]^2) / 2 - M * g[2] - N * g[0] }
    inputs { u[3] }
    forces { for i in 0..3 { w[i]: u[i] - d * w[i]; } }
    linearization { keep: g[0], g[1], w; }
)]
#[derive(Clone, Copy, Debug)]
struct Top {
    A: f64,
    B: f64,
    C: f64,
    M: f64,
    N: f64,
    d: f64,
}

/// Where more is held than leaves a solution, that is said: a state with rates that were left out at the start was given back.
#[test]
fn what_is_found_satisfies_all_equations() {
    use TopVariable::{g_1, u_0, u_1, w_1};
    let top = Top { A: 1.1, B: 0.7, C: 1.6, M: 0.8, N: -0.4, d: 0.2 };
    let guess = TopState { g: [1.0, 0.0, 0.0], w: [0.0, 1.0, 0.0] };
    let found = top.trim(0.0, &guess, &TopInput { u: [1.0, 0.0, 1.0] }, &[g_1, w_1, u_0, u_1]);
    assert!(matches!(found, Err(TrimError::NoSolution { .. })), "{found:?}");
}
