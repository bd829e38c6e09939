//! Levels of momenta whose pivots vanish at ordinary states: the state keeps what it needs, or what the
//! declaration names.
#![allow(dead_code, reason = "some systems only have to compile")]

use nh_tests::random::Random;
use nonholonomic::prelude::*;

/// A particle in a plane under a central force, by its angular momentum.
#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) - k / 2 * (x^2 + y^2) }
    symmetries { turn: x * der(y) - y * der(x); }
    conserved {
        amended = m / 2 * (x * der(x) + y * der(y))^2 / (x^2 + y^2) + mu^2 / (2 * m * (x^2 + y^2))
            + k / 2 * (x^2 + y^2);
    }
    routh { turn = mu; }
    emit { invariants, jacobian, momenta }
)]
#[derive(Clone, Copy, Debug)]
struct Turned {
    m: f64,
    k: f64,
    mu: f64,
}

#[test]
fn a_momentum_that_determines_no_velocity_everywhere() {
    let start = 0.5_f64;
    let state = TurnedState { x: start.cos(), y: start.sin(), x_dot: -start.sin(), y_dot: start.cos() };
    let turned = Turned { m: 1.0, k: 1.0, mu: 1.0 };
    assert!(turned.constraint_residual(0.0, &state).turn.abs() < 1e-15);
    let mut simulation = Integrator::new(turned, Rk4::new(0.1), start, state);
    simulation.advance_to(6.5).unwrap();
    let TurnedState { x, y, .. } = *simulation.state();
    assert!((x - 6.5_f64.cos()).abs() < 1e-5 && (y - 6.5_f64.sin()).abs() < 1e-5, "{x} {y}");
    assert!(Turned::REPORT.contains("formulation: projected"), "{}", Turned::REPORT);
    // a start off the level is moved to it
    let mut off = TurnedState { x_dot: 0.0, ..state };
    turned.project(0.0, &mut off).unwrap();
    assert!((turned.momenta(0.0, &off).turn - 1.0).abs() < 1e-15);
}

#[test]
fn through_the_point_where_a_level_says_nothing() {
    // at the origin every velocity has the angular momentum 0
    let turned = Turned { m: 1.3, k: 1.3, mu: 0.0 };
    let state = TurnedState { x: 0.6, y: -0.8, x_dot: 0.0, y_dot: 0.0 };
    let mut simulation = Integrator::new(turned, Rk4::new(0.01), 0.0, state);
    simulation.advance_to(10.0).unwrap();
    let TurnedState { x, y, .. } = *simulation.state();
    let c = 10.0_f64.cos();
    assert!((x - 0.6 * c).abs() < 1e-8 && (y + 0.8 * c).abs() < 1e-8, "{x} {y}");
    let origin = TurnedState { x: 0.0, y: 0.0, x_dot: 0.3, y_dot: 0.4 };
    let rate = turned.derivative(0.0, &origin, &());
    assert_eq!((rate.x, rate.y, rate.x_dot, rate.y_dot), (0.3, 0.4, 0.0, 0.0));
}

/// The whole system, and the same on levels, perhaps with velocities that are named.
macro_rules! both {
    ({ $($sections:tt)* } $({ $($named:tt)* })? routh { $($routh:tt)* }
     struct $whole:ident, $reduced:ident { $($field:ident),*; $($level:ident),* }) => {
        #[nonholonomic($($sections)*)]
        #[derive(Clone, Copy, Debug)]
        struct $whole { $($field: f64),* }

        #[nonholonomic($($sections)* routh { $($routh)* } $($($named)*)?)]
        #[derive(Clone, Copy, Debug)]
        struct $reduced { $($field: f64,)* $($level: f64),* }
    };
}

both! {
    {
        base { x, y }
        lagrangian { m / 2 * (der(x)^2 + der(y)^2) - k / 2 * (x^2 + y^2) }
        symmetries { turn: x * der(y) - y * der(x); }
    }
    { independent { der(y) } }
    routh { turn = mu; }
    struct Whole, Named { m, k; mu }
}

both! {
    // neither level determines a velocity alone, and both together determine two everywhere
    {
        base { x, y, s }
        basis { u, v, w }
        anchor {
            der(x) = u * cos(s) - v * sin(s);
            der(y) = u * sin(s) + v * cos(s);
            der(s) = w;
        }
        lagrangian { m / 2 * (u^2 + v^2) + (1 + k * sin(s)^2) / 2 * w^2 + k * w * u }
        symmetries { east: cos(s) * u - sin(s) * v; north: sin(s) * u + cos(s) * v; }
    }
    routh { east = mu; north = nu; }
    struct Drifting, OnBoth { m, k; mu, nu }
}

both! {
    // with a constraint and a drift, at levels that change the pivot with the time
    {
        base { x, y, z, s }
        lagrangian {
            m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) + (2 + cos(t)) / 2 * der(s)^2 + x * der(s) * der(y) / 5
        }
        constraints { der(z) = x * der(y) + k; }
    }
    routh { s = mu; }
    struct Moving, OnMoving { m, k; mu }
}

#[test]
fn named_velocities_and_levels_that_are_solved_together() {
    let mut random = Random::new(7);
    let close = |found: &[f64], expected: &[f64]| {
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-12 * (1.0 + expected.abs()), "{found} {expected}");
        }
    };
    for _ in 0..40 {
        let [x, y, s, v, t] = std::array::from_fn(|_| random.between(-2.0, 2.0));
        let named = Named { m: 1.3, k: 0.7, mu: 0.4 };
        let state = NamedState { x, y, y_dot: v };
        let x_dot = named.velocity(t, &state).x_dot;
        assert!((1.3 * (x * v - y * x_dot) - 0.4).abs() < 1e-12 * (1.0 + x_dot.abs()));
        let rate = named.derivative(t, &state, &());
        let whole = Whole { m: 1.3, k: 0.7 }.derivative(t, &WholeState { x, y, x_dot, y_dot: v }, &());
        close(&[rate.x, rate.y, rate.y_dot], &[whole.x, whole.y, whole.y_dot]);

        let both = OnBoth { m: 1.3, k: 0.7, mu: 0.4, nu: -0.9 };
        let state = OnBothState { s, u: v };
        let OnBothVelocity { u, v: across, w } = both.velocity(t, &state);
        let full = DriftingState { x, y, s, u, v: across, w };
        let momenta = Drifting { m: 1.3, k: 0.7 }.momenta(t, &full);
        close(&[momenta.east, momenta.north], &[0.4, -0.9]);
        let (rate, whole) =
            (both.derivative(t, &state, &()), Drifting { m: 1.3, k: 0.7 }.derivative(t, &full, &()));
        close(&[rate.s, rate.u], &[whole.s, whole.u]);

        let moving = OnMoving { m: 1.3, k: 0.7, mu: 0.4 };
        let state = OnMovingState { x, y, z: 0.1, x_dot: s, y_dot: v };
        let s_dot = moving.velocity(t, &state).s_dot;
        let full = MovingState { x, y, z: 0.1, s: 0.0, x_dot: s, y_dot: v, s_dot };
        let (rate, whole) =
            (moving.derivative(t, &state, &()), Moving { m: 1.3, k: 0.7 }.derivative(t, &full, &()));
        close(&[rate.x, rate.z, rate.x_dot, rate.y_dot], &[whole.x, whole.z, whole.x_dot, whole.y_dot]);
    }
    let told = "the levels are solved for `x_dot`, which breaks down where y = 0";
    assert!(Named::REPORT.contains(told), "{}", Named::REPORT);
    assert!(OnBoth::REPORT.contains("formulation: adapted"), "{}", OnBoth::REPORT);
}

/// A momentum whose pivot is a parameter.
#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * der(x)^2 + c / 2 * der(y)^2 - k / 2 * x^2 }
    routh { y = mu; }
)]
#[derive(Clone, Copy, Debug)]
struct ByParameter {
    m: f64,
    c: f64,
    k: f64,
    mu: f64,
}

#[test]
fn pivots_of_parameters_are_validated() {
    let system = ByParameter { m: 1.0, c: 0.5, k: 1.0, mu: 0.3 };
    assert!(system.validate().is_ok());
    let error = ByParameter { c: 0.0, ..system }.validate().unwrap_err();
    assert!(error.to_string().contains('c'), "{error}");
}

/// What is derived on a level, asked for word by word.
macro_rules! word_by_word {
    ($($word:ident $system:ident $kept:ident $constrained:ident),*) => { $(
        #[nonholonomic(
            base { x, y }
            lagrangian { m / 2 * (der(x)^2 + der(y)^2) - k / 2 * (x^2 + y^2) }
            symmetries { turn: x * der(y) - y * der(x); }
            conserved { spin = x * der(y) - y * der(x); }
            routh { turn = mu; }
            emit { $word }
        )]
        #[derive(Clone, Copy, Debug)]
        struct $kept { m: f64, k: f64, mu: f64 }

        #[nonholonomic(
            base { x, y, s }
            lagrangian { m / 2 * (der(x)^2 + der(y)^2) + (1 + y^2) / 2 * der(s)^2 + x * der(s) * der(y) - k * x }
            conserved { level = (1 + y^2) * der(s) + x * der(y); }
            routh { s = mu; }
            emit { $word }
        )]
        #[derive(Clone, Copy, Debug)]
        struct $system { m: f64, k: f64, mu: f64 }

        #[nonholonomic(
            base { x, y, z }
            lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) + k * der(x) * der(y) / 10 }
            constraints { slope: der(z) = x * der(x); }
            conserved { both = m * der(y) + k * der(x) / 10; }
            routh { y = mu; }
            emit { $word, multipliers }
        )]
        #[derive(Clone, Copy, Debug)]
        struct $constrained { m: f64, k: f64, mu: f64 }
    )* };
}

word_by_word! {
    jacobian A1 B1 C1, taylor A2 B2 C2, parameter_jacobian A3 B3 C3, prepared A4 B4 C4, momenta A5 B5 C5,
    gibbs_appell A6 B6 C6, invariants A7 B7 C7
}

#[test]
fn every_word_compiles_beside_a_level() {
    let (m, k, mu) = (1.3, 0.7, 0.4);
    let state = A1State { x: 0.3, y: -0.6, x_dot: 0.2, y_dot: 0.8 };
    let expected = <[f64; 4]>::from(A1 { m, k, mu }.derivative(0.0, &state, &()));
    let appell = A6 { m, k, mu }.gibbs_appell(0.0, &<[f64; 4]>::from(state).into(), &());
    for (found, expected) in <[f64; 4]>::from(appell).into_iter().zip(expected) {
        assert!((found - expected).abs() < 1e-13, "{found} {expected}");
    }
    // the gradients of the integrals have an entry for each variable of the state
    let state = A7State { x: 0.3, y: -0.6, x_dot: 0.2, y_dot: 0.8 };
    let mut run = Integrator::new(A7 { m, k, mu }, Conserving::new(Rk4::new(0.01)), 0.0, state);
    run.advance_to(1.0).unwrap();
    let state = C7State { x: 0.3, z: 0.1, x_dot: 0.2 };
    let mut run = Integrator::new(C7 { m, k, mu }, Conserving::new(Rk4::new(0.01)), 0.0, state);
    run.advance_to(1.0).unwrap();
    // ⟨∂f, ẋ⟩ = 0
    let (a, _) = B1 { m, k, mu }.jacobian(0.0, &B1State { x: 0.3, y: 0.4, x_dot: -0.2, y_dot: 0.9 }, &());
    assert!((a[(2, 0)] + k / m).abs() < 1e-14 && a[(2, 1)].abs() < 1e-14, "{a}");
}

/// A momentum along a section without kinetic energy of its own.
#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * der(x)^2 + c * der(x) * der(y) - k / 2 * x^2 }
    routh { y = mu; }
)]
#[derive(Clone, Copy, Debug)]
struct Null {
    m: f64,
    c: f64,
    k: f64,
    mu: f64,
}

#[test]
fn a_level_along_a_null_section_leaves_all_velocities() {
    let system = Null { m: 1.2, c: 0.5, k: 0.7, mu: 0.3 };
    let state = NullState { x: 0.4, x_dot: 0.6, y_dot: -1.0 };
    let rate = system.derivative(0.0, &state, &());
    // ẍ = 0, m ẍ + c ÿ = −k x
    assert!(rate.x_dot.abs() < 1e-15 && (rate.y_dot + 0.7 * 0.4 / 0.5).abs() < 1e-14, "{rate:?}");
}
