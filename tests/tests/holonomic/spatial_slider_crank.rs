//! A slider crank in space: a crank about an axis along the slide, beside it and above it, whose rod turns in two angles.

use nonholonomic::AssemblyError;
use nonholonomic::prelude::*;

#[nonholonomic(
    base { theta, s, a, b }
    let pin = [0, y0 + r * cos(theta), z0 + r * sin(theta)];
    let slide = [s, 0, 0];
    let attitude = rot_z(a) * rot_y(b);
    let axis = attitude * [-1, 0, 0];
    holonomic { closure: slide + rod * axis - pin = 0; }
    lagrangian {
        J / 2 * der(theta)^2 + kinetic(ms, slide) + kinetic(mr, [I1, I2, I2], slide + rod / 2 * axis, attitude)
        - mr * g * (slide + rod / 2 * axis)[2]
    }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct SliderCrank {
    y0: f64,
    z0: f64,
    r: f64,
    rod: f64,
    J: f64,
    ms: f64,
    mr: f64,
    I1: f64,
    I2: f64,
    g: f64,
}

const MODEL: SliderCrank = SliderCrank {
    y0: 0.1,
    z0: 0.12,
    r: 0.08,
    rod: 0.3,
    J: 0.0001,
    ms: 2.0,
    mr: 0.5,
    I1: 0.0001,
    I2: 0.004,
    g: 9.81,
};

/// The crank stands at 0.7 and turns with 6 rad/s; the rest is guessed.
const GUESS: SliderCrankState = SliderCrankState {
    theta: 0.7,
    s: 0.2,
    a: -0.6,
    b: 0.5,
    theta_dot: 6.0,
    s_dot: 0.0,
    a_dot: 0.0,
    b_dot: 0.0,
};

fn assembled(guess: SliderCrankState) -> Result<SliderCrankState, AssemblyError> {
    MODEL.assemble_holding(0.0, &guess, &[SliderCrankCoordinate::theta])
}

fn assert_near(found: &[f64], expected: &[f64]) {
    let largest = expected.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() < 1e-13 * largest, "{found} {expected}");
    }
}

/// By `tests/reference/spatial_slider_crank.py`.
#[test]
fn accelerations_and_multipliers() {
    let start = assembled(GUESS).unwrap();
    assert_near(
        &start.to_array()[..4],
        &[0.7, 0.185_993_401_518_668_18, -0.714_069_493_318_959_8, 0.608_687_749_030_299_6],
    );
    assert_near(
        &start.to_array()[4..],
        &[6.0, -0.070_607_133_871_140_35, 0.761_581_521_675_037_5, 1.491_649_079_838_018_3],
    );
    let rates = MODEL.derivative(0.0, &start, &()).to_array();
    let exact =
        [-60.602_120_386_204_18, 3.067_707_282_722_212, 6.920_108_582_248_614, -21.053_810_720_797_67];
    assert_near(&rates[4..], &exact);
    let exact = [6.902_341_386_124_977, -5.613_421_248_272_808, -4.629_075_987_741_7];
    assert_near(&MODEL.multipliers(0.0, &start, &()).closure, &exact);
    assert!((MODEL.energy(0.0, &start) - 0.447_432_730_511_361_7).abs() < 1e-15);
}

#[test]
fn bad_guesses_lead_to_the_loop_or_to_an_error() {
    let near = assembled(GUESS).unwrap();
    // turned many times, and with the slide far away
    let far = assembled(SliderCrankState { s: 2e3, a: 30.0, b: -70.5, ..GUESS }).unwrap();
    let mirrored = assembled(SliderCrankState { s: -0.2, a: 3.0, ..GUESS }).unwrap();
    for found in [far, mirrored] {
        let open = MODEL.constraint_residual(0.0, &found).closure;
        assert!(open.iter().all(|open| open.abs() < 1e-13), "{open:?}");
    }
    assert!((mirrored.s + near.s).abs() < 1e-15 && (mirrored.s_dot + near.s_dot).abs() < 1e-14);
    let short = SliderCrank { rod: 0.15, ..MODEL };
    let error = short.assemble_holding(0.0, &GUESS, &[SliderCrankCoordinate::theta]).unwrap_err();
    assert!(matches!(error, AssemblyError::NoSolution { .. } | AssemblyError::Singular { .. }), "{error}");
    let error = assembled(SliderCrankState { s: f64::NAN, ..GUESS }).unwrap_err();
    assert!(error.to_string().contains("`s` of the guess is NaN"), "{error}");
}

/// The slide comes to both ends of its stroke again and again.
#[test]
fn the_loop_stays_closed_through_dead_centres() {
    let start = assembled(SliderCrankState { theta_dot: 30.0, ..GUESS }).unwrap();
    let energy = MODEL.energy(0.0, &start);
    let mut sim = Integrator::new(MODEL, Dopri5::new().rtol(1e-9).atol(1e-9), 0.0, start);
    let (mut ends, mut before) = (0, start.s_dot);
    for tenth in 1..=500 {
        sim.advance_to(f64::from(tenth) / 100.0).unwrap();
        let state = sim.state();
        let open = MODEL.constraint_residual(0.0, state).closure;
        assert!(open.iter().all(|open| open.abs() < 1e-13), "{open:?}");
        ends += usize::from(state.s_dot * before < 0.0);
        before = state.s_dot;
    }
    assert!(ends > 20, "{ends}");
    assert!((MODEL.energy(0.0, sim.state()) / energy - 1.0).abs() < 1e-6);
}
