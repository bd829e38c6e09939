//! Windows of rods side by side, in coordinates of their joints: each time all rods are in one line, more can move than
//! at other times, and no step may notice. The example "N-four-bar" of the IFToMM library of multibody benchmarks.

use core::f64::consts::{FRAC_PI_2, PI};

use nonholonomic::prelude::*;

/// Three windows: four upright rods of length l, and three on top of them.
#[nonholonomic(
    base { x[4], y[4] }
    let joint[k in 0..4] = [x[k], y[k]];
    let foot[k in 0..4] = [k * l, 0];
    let rod(u, v) = m / 6 * (dot(der(u), der(u)) + dot(der(u), der(v)) + dot(der(v), der(v))) - m * g * (u + v)[1] / 2;
    holonomic {
        for k in 0..4 { upright: dot(joint[k] - foot[k], joint[k] - foot[k]) = l^2; }
        for k in 0..3 { top: dot(joint[k + 1] - joint[k], joint[k + 1] - joint[k]) = l^2; }
    }
    lagrangian { sum(k in 0..4: rod(foot[k], joint[k])) + sum(k in 0..3: rod(joint[k], joint[k + 1])) }
)]
#[derive(Clone, Copy, Debug)]
struct Windows {
    l: f64,
    m: f64,
    g: f64,
}

const WINDOWS: Windows = Windows { l: 1.0, m: 1.0, g: 9.81 };

/// The same motion by the angle of the upright rods, as long as the windows stay parallelograms.
#[nonholonomic(
    base { angle }
    lagrangian { 4 * m * l^2 / 6 * der(angle)^2 + 3 * m * l^2 / 2 * der(angle)^2 - 5 * m * g * l * sin(angle) }
)]
#[derive(Clone, Copy, Debug)]
struct Turning {
    l: f64,
    m: f64,
    g: f64,
}

const TURNING: Turning = Turning { l: WINDOWS.l, m: WINDOWS.m, g: WINDOWS.g };

/// All rods upright, the joints at 1 m/s to the right.
fn start() -> WindowsState {
    WindowsState { x: [0.0, 1.0, 2.0, 3.0], y: [1.0; 4], x_dot: [1.0; 4], y_dot: [0.0; 4] }
}

/// Ten seconds, in which all rods are in one line again and again: at most four times the errors that the same method at
/// the same tolerance makes with the angle alone. The library asks for 0.1 J.
#[test]
fn runs_pass_where_all_rods_are_in_line() {
    let method = |tolerance: f64| Dopri5::new().rtol(tolerance).atol(tolerance);
    let begin = TurningState { angle: FRAC_PI_2, angle_dot: -1.0 };
    let turned = |tolerance: f64| {
        let mut run = Integrator::new(TURNING, method(tolerance), 0.0, begin);
        run.advance_to(10.0).unwrap();
        *run.state()
    };
    let angle = turned(1e-12).angle;
    // ten times in line
    assert!(angle < -9.0 * PI, "{angle}");
    for tolerance in [1e-5, 1e-6, 1e-7, 1e-8, 1e-9] {
        let alone = turned(tolerance);
        let lost_alone = (TURNING.energy(10.0, &alone) - TURNING.energy(0.0, &begin)).abs();
        let mut run = Integrator::new(WINDOWS, method(tolerance), 0.0, start());
        run.advance_to(10.0).unwrap();
        let state = run.state();
        for (place, (x, y)) in (0_u8..).zip(state.x.iter().zip(&state.y)) {
            let off = (x - f64::from(place) - angle.cos()).hypot(y - angle.sin());
            assert!(off < 4.0 * (alone.angle - angle).abs(), "{tolerance} {off} {state:?}");
        }
        let left = WINDOWS.constraint_residual(10.0, state);
        assert!(left.upright.iter().chain(&left.top).all(|left| left.abs() < 1e-14), "{tolerance} {left:?}");
        let lost = (WINDOWS.energy(10.0, state) - WINDOWS.energy(0.0, &start())).abs();
        assert!(lost < 4.0 * lost_alone && lost < 0.1, "{tolerance} {lost}");
    }
}
