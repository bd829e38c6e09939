//! Machines assembled from rough starts.

use nonholonomic::prelude::*;
use nonholonomic::{AssemblyError, IntegrationError};

use super::four_bar::{
    FourBar, FourBarCoordinate, FourBarState, OnTheCrank, OnTheCrankCoordinate, OnTheCrankState,
};

/// A guess that leaves the loop open by about a metre.
const ROUGH: FourBarState = FourBarState { a: 0.7, b: 0.1, c: 1.9, a_dot: 3.0, b_dot: 0.0, c_dot: 0.0 };

fn is_closed(state: &FourBarState) {
    let left: [f64; 4] = FourBar::MODEL.constraint_residual(0.0, state).into();
    assert!(left.iter().all(|left| left.abs() < 1e-14), "{left:?}");
}

/// Whether the coupler is turned to the left of the rocker: cos b sin c − sin b cos c.
fn branch(state: &FourBarState) -> f64 {
    (state.c - state.b).sin()
}

#[test]
fn a_rough_guess_is_moved_to_a_closed_loop() {
    let left: [f64; 4] = FourBar::MODEL.constraint_residual(0.0, &ROUGH).into();
    assert!(left[0].abs() > 0.5);
    let found = FourBar::MODEL.assemble(0.0, &ROUGH).unwrap();
    is_closed(&found);
    assert!(branch(&found) * branch(&ROUGH) > 0.0);
    Integrator::new(FourBar::MODEL, Dopri5::new(), 0.0, found).advance_to(1.0).unwrap();
    // what is assembled stays where it is
    let again = FourBar::MODEL.assemble(0.0, &found).unwrap();
    let moved = again.to_array().iter().zip(found.to_array()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(moved < 1e-14, "{moved:e}");
}

#[test]
fn the_crank_is_held_with_its_rate() {
    let held = [FourBarCoordinate::a];
    for turn in 0..24 {
        let a = 0.1 + f64::from(turn) * core::f64::consts::TAU / 24.0;
        let found = FourBar::MODEL.assemble_holding(0.0, &FourBarState { a, ..ROUGH }, &held).unwrap();
        is_closed(&found);
        assert_eq!((found.a, found.a_dot), (a, 3.0));
        assert!(branch(&found) > 0.0, "{found:?}");
        // the other branch by its guess: the mirror image about the line between the joints
        let mirrored = FourBarState { a, b: 1.3, c: -0.6, ..ROUGH };
        let other = FourBar::MODEL.assemble_holding(0.0, &mirrored, &held).unwrap();
        is_closed(&other);
        assert!(branch(&other) < 0.0);
        assert_eq!((other.a, other.a_dot), (a, 3.0));
    }
}

#[test]
fn the_adapted_form_is_assembled_alike() {
    let guess = OnTheCrankState { a: 0.7, b: 0.1, c: 1.9, a_dot: 3.0 };
    let found = OnTheCrank::MODEL.assemble_holding(0.0, &guess, &[OnTheCrankCoordinate::a]).unwrap();
    let all = FourBar::MODEL.assemble_holding(0.0, &ROUGH, &[FourBarCoordinate::a]).unwrap();
    assert_eq!((found.a, found.a_dot), (0.7, 3.0));
    assert!((found.b - all.b).abs() < 1e-15 && (found.c - all.c).abs() < 1e-15);
    let branch_of = |state: &OnTheCrankState| (state.c - state.b).sin();
    // the rocker's rate is none of the state, and asked for all the same
    let c_dot = |state: &OnTheCrankState| OnTheCrank::MODEL.derivative(0.0, state, &()).c;
    let wanted = c_dot(&guess);
    let by_rocker = OnTheCrank::MODEL.assemble_holding(0.0, &guess, &[OnTheCrankCoordinate::c]);
    let by_rocker = by_rocker.unwrap();
    assert!((c_dot(&by_rocker) - wanted).abs() < 1e-14 * wanted.abs(), "{} {wanted}", c_dot(&by_rocker));
    assert_eq!((by_rocker.c, branch_of(&by_rocker) > 0.0), (1.9, true));
    let free = OnTheCrank::MODEL.assemble(0.0, &guess).unwrap();
    assert_eq!((free.a_dot, branch_of(&free) > 0.0), (3.0, true));
}

#[test]
fn what_cannot_be_assembled_is_said() {
    use FourBarCoordinate::{a, b, c};
    let assemble = |guess: &FourBarState, held: &[FourBarCoordinate]| {
        FourBar::MODEL.assemble_holding(0.0, guess, held).unwrap_err()
    };
    assert_eq!(assemble(&ROUGH, &[]), AssemblyError::TooFewHeld { held: 0, needed: 1 });
    assert_eq!(assemble(&ROUGH, &[a, b]), AssemblyError::TooManyHeld { held: 2, permitted: 1 });
    // twice the same is once
    assert!(FourBar::MODEL.assemble_holding(0.0, &ROUGH, &[a, a]).is_ok());
    // the rocker does not get there
    let error = assemble(&FourBarState { c: 0.2, ..ROUGH }, &[c]);
    let AssemblyError::NoSolution { constraint, residual } = error else { panic!("{error:?}") };
    assert!(constraint.starts_with("closure") && residual.abs() > 0.1, "{error}");
    // coupler and rocker in line: which way do they fold?
    let error = assemble(&FourBarState { b: 1.9, ..ROUGH }, &[a]);
    let AssemblyError::Singular { constraint: "closure[0]" | "closure[1]", .. } = error else {
        panic!("{error:?}")
    };
    let error = FourBar::MODEL.assemble(0.0, &FourBarState::default()).unwrap_err();
    assert!(matches!(error, AssemblyError::Singular { constraint: "closure[0]", .. }), "{error:?}");
    let error = assemble(&FourBarState { b_dot: f64::NAN, ..ROUGH }, &[a]);
    assert!(matches!(error, AssemblyError::NonFiniteGuess { component: "b_dot", .. }), "{error:?}");
}

/// A rope that is let out.
#[nonholonomic(
    base { x, y }
    holonomic { rope: x^2 + y^2 = (l + t)^2; }
    lagrangian { (der(x)^2 + der(y)^2) / 2 }
)]
#[derive(Clone, Copy, Debug)]
struct Rope {
    l: f64,
}

#[test]
fn a_time_or_a_parameter_that_is_no_number_is_told() {
    let guess = RopeState { x: 0.6, y: -1.0, ..Default::default() };
    for number in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let (broken, rope) = (Rope { l: number }, Rope { l: 1.0 });
        let errors = [
            broken.assemble(0.0, &guess),
            broken.assemble_holding(0.0, &guess, &[RopeCoordinate::x]),
            rope.assemble(number, &guess),
            rope.assemble_holding(number, &guess, &[RopeCoordinate::x]),
        ];
        for error in errors.map(Result::unwrap_err) {
            assert!(matches!(error, AssemblyError::NoValue { constraint: "rope", .. }), "{error:?}");
        }
    }
}

#[test]
fn errors_say_what_to_do() {
    let texts = [
        (
            AssemblyError::NonFiniteGuess { component: "a", value: f64::INFINITY },
            "`a` of the guess is inf: give finite",
        ),
        (
            AssemblyError::NoValue { constraint: "closure[0]", value: f64::INFINITY },
            "`closure[0]` is inf there: the time or a parameter may be no number",
        ),
        (
            AssemblyError::TooFewHeld { held: 0, needed: 1 },
            "0 are held, which leaves others free to move: hold 1, or",
        ),
        (
            AssemblyError::TooManyHeld { held: 2, permitted: 1 },
            "2 are held, and the others cannot satisfy these: hold 1",
        ),
        (
            AssemblyError::NoSolution { constraint: "closure", residual: 0.3 },
            "`closure` is left with 0.3; the parts may",
        ),
        (
            AssemblyError::Singular { constraint: "closure", residual: 0.3 },
            "0.3 left in `closure`: guess positions to one",
        ),
        (
            AssemblyError::OtherBranch { coordinate: "b", value: 2.0 },
            "another branch than the guess, with `b` at 2.0: guess",
        ),
        (
            AssemblyError::Velocities { constraint: "rolling", residual: 0.3 },
            "no velocities: `rolling` is left with 0.3; the",
        ),
    ];
    for (error, part) in texts {
        let text = error.to_string();
        assert!(text.contains(part), "{text}");
    }
}

/// A disk that rolls upright along a wire that is a parabola: a contact and a rolling constraint.
#[nonholonomic(
    base { x, y, lift, turn }
    holonomic { wire: y = k * x^2; height: lift = y / 2; }
    constraints { rolling: der(x) = r * der(turn); }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(lift)^2) + J / 2 * der(turn)^2 - m * g * y }
)]
#[derive(Clone, Copy, Debug)]
struct OnAWire<T> {
    m: T,
    J: T,
    r: T,
    k: T,
    g: T,
}

#[test]
fn rates_are_kept_where_they_determine_the_motion() {
    use OnAWireCoordinate::{turn, x, y};
    let wire = OnAWire { m: 1.0, J: 0.2, r: 0.5, k: 0.7, g: 9.81 };
    let guess = OnAWireState { x: 0.8, turn: 3.0, x_dot: 2.0, turn_dot: 7.0, ..OnAWireState::default() };
    // turn is in no position constraint, and may be held or not; with it, two rates for one velocity
    let found = wire.assemble_holding(0.0, &guess, &[x]).unwrap();
    assert!((found.y - 0.7 * 0.64).abs() < 1e-16 && (found.lift - 0.35 * 0.64).abs() < 1e-16, "{found:?}");
    assert_eq!((found.x_dot, found.turn), (2.0, 3.0));
    assert!((found.turn_dot - 4.0).abs() < 1e-15 && (found.y_dot - 2.0 * 0.7 * 0.8 * 2.0).abs() < 1e-15);
    let nearest = wire.assemble_holding(0.0, &guess, &[x, turn]).unwrap();
    assert!(
        (nearest.x_dot - 2.0).abs() > 0.1 && (nearest.x_dot - 0.5 * nearest.turn_dot).abs() < 1e-15,
        "{nearest:?}"
    );
    // at the bottom the height says nothing of x
    let flat = OnAWireState { y: 0.0, ..OnAWireState::default() };
    let error = wire.assemble_holding(0.0, &flat, &[y]).unwrap_err();
    assert!(matches!(error, AssemblyError::Singular { .. }), "{error:?}");
    // the same in single precision
    let single = OnAWire { m: 1.0_f32, J: 0.2, r: 0.5, k: 0.7, g: 9.81 };
    let guess = OnAWireState { x: 0.8, x_dot: 2.0, ..OnAWireState::default() };
    let found = single.assemble_holding(0.0, &guess, &[x]).unwrap();
    assert!((found.y - 0.448).abs() < 1e-7);
    assert_eq!((found.x, found.x_dot), (0.8, 2.0));
    let found = single.assemble(0.0, &guess).unwrap();
    assert!((found.y - 0.7 * found.x * found.x).abs() < 1e-7);
}

/// A pendulum on the sphere of a unit vector, whose tip stays on an inclined plane through time.
#[nonholonomic(
    base { g[3] }
    on { unit: dot(g, g) = 1; }
    basis { w[3] }
    anchor { der(g) = cross(g, w); }
    brackets so(3) { w[0], w[1], w[2] }
    holonomic { tilt: g[2] = g[0] / 2 + t / 10; }
    lagrangian { J / 2 * dot(w, w) - m * g[2] }
)]
#[derive(Clone, Copy, Debug)]
struct Tilted {
    J: f64,
    m: f64,
}

#[test]
fn embedded_coordinates_are_found_with_their_identities() {
    use TiltedCoordinate::{g_0, g_1};
    let system = Tilted { J: 1.0, m: 2.0 };
    let guess = TiltedState { g: [0.4, 0.9, 0.8], w: [0.1, 0.2, 0.3] };
    for found in [system.assemble(2.0, &guess), system.assemble_holding(2.0, &guess, &[g_0])] {
        let found = found.unwrap();
        let [x, y, z] = found.g;
        assert!(
            (x * x + y * y + z * z - 1.0).abs() < 4e-16 && (z - x / 2.0 - 0.2).abs() < 4e-16,
            "{found:?}"
        );
        let left: [f64; 2] = system.constraint_residual(2.0, &found).into();
        assert!(left.iter().all(|left| left.abs() < 1e-15), "{left:?}");
    }
    let held = system.assemble_holding(2.0, &guess, &[g_0]).unwrap();
    assert_eq!((held.g[0], held.g[1] > 0.0), (0.4, true));
    let below = TiltedState { g: [0.4, -0.9, 0.8], ..guess };
    assert!(system.assemble_holding(2.0, &below, &[g_0]).unwrap().g[1] < 0.0);
    let error = system.assemble_holding(2.0, &guess, &[g_0, g_1]).unwrap_err();
    assert_eq!(error, AssemblyError::TooManyHeld { held: 2, permitted: 1 });
}

#[test]
fn a_start_that_is_not_assembled_is_refused_with_the_way_out() {
    let mut sim = Integrator::new(FourBar::MODEL, Dopri5::new(), 0.0, ROUGH);
    let error = sim.advance_to(1.0).unwrap_err();
    assert!(matches!(error, IntegrationError::OffConstraints { .. }));
    assert!(error.to_string().contains("or `project` or `assemble` it first"), "{error}");
}

/// A body that turns with its axis on a tilted cone: an identity of the base and a position constraint, each of which the
/// way back to the other one leaves.
#[nonholonomic(
    base { g[3] }
    on { unit: dot(g, g) = 1; }
    basis { w[3] }
    anchor { der(g) = cross(g, w); }
    brackets so(3) { w[0], w[1], w[2] }
    holonomic { cone: g[2] = h * (1 + g[0] / 3); }
    lagrangian { 1 / 2 * (w[0]^2 + 2 * w[1]^2 + 3 * w[2]^2) - k * g[0] }
)]
#[derive(Clone, Copy, Debug)]
struct Coned {
    h: f64,
    k: f64,
}

/// What was projected is where it belongs, and stays there.
#[test]
fn projections_end_on_identities_and_positions() {
    let coned = Coned { h: 0.4, k: 1.0 };
    for k in 0..200 {
        let part = |of: i32| f64::from((k * of) % 101) / 101.0 - 0.5;
        let g = [0.6 + 0.3 * part(7), 0.7 + 0.3 * part(13), 0.45 + 0.3 * part(29)];
        let mut state = ConedState { g, w: [part(3), part(5), part(11)] };
        coned.project(0.0, &mut state).unwrap();
        let [x, y, z] = state.g;
        let (unit, cone) = (x * x + y * y + z * z - 1.0, z - 0.4 * (1.0 + x / 3.0));
        assert!(unit.abs() < 1e-15 && cone.abs() < 1e-15, "{k}: {unit:e} {cone:e}");
        let mut again = state;
        coned.project(0.0, &mut again).unwrap();
        for (a, b) in again.to_array().iter().zip(state.to_array()) {
            assert!((a - b).abs() < 1e-15, "{k}: {a} {b}");
        }
        let mut sim = Integrator::new(coned, Dopri5::new().rtol(1e-12).atol(1e-12), 0.0, state);
        sim.advance_to(0.1).unwrap();
    }
}
