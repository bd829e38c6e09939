//! A ball on the ground: its bounces, its rest, and a ground that moves.

use core::ops::ControlFlow;

use nonholonomic::impacts::{End, ImpactError, advance_with_impacts, strike};
use nonholonomic::prelude::*;
use nonholonomic::{Direction, Events};

/// A ball that is thrown.
#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) - m * g * y }
    impacts { floor: y >= 0 with restitution e; }
)]
#[derive(Clone, Copy, Debug)]
struct Ball<T> {
    m: T,
    g: T,
    e: T,
}

const BALL: Ball<f64> = Ball { m: 0.3, g: 9.81, e: 0.8 };

#[test]
fn bounces_are_those_of_the_exact_solution() {
    for e in [1.0, 0.8, 0.3] {
        let ball = Ball { e, ..BALL };
        let start = BallState { y: 1.0, x_dot: 0.7, ..BallState::default() };
        let mut sim = Integrator::new(ball, Dopri5::new().rtol(1e-11).atol(1e-12), 0.0, start);
        let floor = Events::new(|t, state: &BallState<f64>, (): &()| [ball.event_floor(t, state)])
            .directions([Direction::Falling]);
        let fall = (2.0 / ball.g).sqrt();
        // the instants and the speeds: t + 2 v / g, and e v
        let (mut time, mut speed) = (fall, ball.g * fall);
        for _ in 0..5 {
            let event = sim.advance_until(20.0, &floor).unwrap().unwrap();
            assert!((event.time - time).abs() < 1e-9, "{e}: {} {time}", event.time);
            assert!((event.state.y_dot + speed).abs() < 1e-9, "{e}");
            let (after, impulses) = ball.impact_floor(event.time, &event.state).unwrap();
            assert!((after.y_dot - e * speed).abs() < 1e-9 && after.x_dot == event.state.x_dot, "{e}");
            assert!((impulses.floor - ball.m * (1.0 + e) * speed).abs() < 1e-9, "{e}");
            sim.reset(event.time, after);
            speed *= e;
            time += 2.0 * speed / ball.g;
        }
    }
}

#[test]
fn a_ball_that_is_away_or_separates_stays_as_it_is() {
    let above = BallState { y: 0.5, y_dot: -3.0, ..BallState::default() };
    let rising = BallState { y: 0.0, y_dot: 2.0, x: 3.0, x_dot: 1.0 };
    for state in [above, rising] {
        let (after, impulses) = BALL.impact_floor(0.7, &state).unwrap();
        assert_eq!((after, impulses), (state, BallImpulses { floor: 0.0 }));
    }
}

/// Gaps are closed up to the rounding of what a row moves by in the time: where that is no number, nothing is known of them.
#[test]
fn at_no_time_no_jump_is_made() {
    let falling = BallState { y: 0.0, y_dot: -2.0, ..BallState::default() };
    let above = BallState { y: 0.5, ..falling };
    for t in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for state in [falling, above] {
            let error = BALL.impact_floor(t, &state).unwrap_err();
            assert!(matches!(error, ImpactError::NotFinite { row: "floor", .. }), "{t}: {error}");
        }
    }
    // so fast that it may have been anywhere
    let fast = BallState { y: 0.5, y_dot: -1e200, ..falling };
    assert!(matches!(BALL.impact_floor(1e200, &fast), Err(ImpactError::NotFinite { .. })));
}

#[test]
fn bounces_without_end_are_an_event_and_no_fall_through_the_ground() {
    let start = BallState { y: 1.0, x_dot: 0.5, ..BallState::default() };
    let mut sim = Integrator::new(BALL, Tsit5::new().rtol(1e-10).atol(1e-12), 0.0, start);
    let mut energy = BALL.energy(0.0, &start);
    let mut bounces = 0;
    let end = advance_with_impacts(&mut sim, 30.0, &BallFloorImpact, 0.0, |struck| {
        let after = BALL.energy(struck.time, &struck.after);
        assert!(after <= energy + 1e-12 && struck.after.y > -1e-11, "{after} {energy} {struck:?}");
        let lost = BALL.energy(struck.time, &struck.before) - after;
        assert!(struck.lost.is_some_and(|said| (lost - said).abs() < 1e-14), "{lost} {:?}", struck.lost);
        energy = after;
        bounces += 1;
        ControlFlow::Continue(())
    });
    // all bounces are over after (1 + e)/(1 − e) times the first fall
    let over = (2.0_f64 / 9.81).sqrt() * 1.8 / 0.2;
    let Ok(End::Accumulated { row: 0, time }) = end else { panic!("{end:?}") };
    assert!((time - over).abs() < 1e-4 && bounces > 40, "{time} {over} {bounces}");
    let rest = sim.state();
    assert!(rest.y.abs() < 1e-10 && rest.y_dot == 0.0 && (rest.x - 0.5 * time).abs() < 1e-9, "{rest:?}");
}

#[test]
fn in_f32_it_bounces_too() {
    let ball = Ball::<f32> { m: 0.3, g: 9.81, e: 0.5 };
    let start = BallState::<f32> { y: 1.0, ..BallState::default() };
    let mut sim = Integrator::new(ball, Dopri5::new().rtol(1e-5).atol(1e-6), 0.0, start);
    let end = advance_with_impacts(&mut sim, 30.0, &BallFloorImpact, 0.0, |struck| {
        assert!(struck.after.y > -1e-5 && struck.after.y_dot >= 0.0);
        ControlFlow::Continue(())
    });
    let Ok(End::Accumulated { row: 0, time }) = end else { panic!("{end:?}") };
    assert!((time - 3.0 * (2.0_f32 / 9.81).sqrt()).abs() < 1e-2, "{time}");
    assert!(sim.state().y.abs() < 1e-5 && sim.state().y_dot == 0.0);
}

#[test]
fn a_coefficient_that_is_none_is_told() {
    let ball = Ball { e: 1.5, ..BALL };
    let falling = BallState { y_dot: -1.0, ..BallState::default() };
    assert_eq!(ball.impact_floor(0.0, &falling), Err(ImpactError::Restitution { value: 1.5 }));
}

/// A ball on a table that shakes, and that keeps it from below on demand.
#[nonholonomic(
    base { y }
    lagrangian { m / 2 * der(y)^2 - m * g * y }
    impacts {
        table: y >= A * sin(w * t) with restitution 1/2;
        glue: y = A * sin(w * t);
    }
)]
#[derive(Clone, Copy, Debug)]
struct Shaken {
    m: f64,
    g: f64,
    A: f64,
    w: f64,
}

#[test]
fn a_table_that_moves_gives_its_speed() {
    let shaken = Shaken { m: 2.0, g: 9.81, A: 0.1, w: 7.0 };
    let t = 0.3;
    let table = shaken.A * shaken.w * (shaken.w * t).cos();
    let state = ShakenState { y: shaken.A * (shaken.w * t).sin(), y_dot: -1.0 };
    assert_eq!(shaken.event_table(t, &state), 0.0);
    let (after, impulses) = shaken.impact_table(t, &state).unwrap();
    assert!((after.y_dot - (table + 0.5 * (1.0 + table))).abs() < 1e-14);
    assert!((impulses.table - 2.0 * (after.y_dot + 1.0)).abs() < 1e-14 && impulses.glue == 0.0);
    // the table does work, of which the rows say nothing
    let struck = strike(&shaken, &ShakenTableImpact, t, &state, 0.0).unwrap();
    assert_eq!((struck.after, struck.lost), (after, None));
    // what is bilateral pulls as well
    let (held, impulses) = shaken.impact_glue(t, &ShakenState { y_dot: 4.0, ..state }).unwrap();
    assert!((held.y_dot - table).abs() < 1e-14 && impulses.glue < 0.0);
}

/// A ball that rolls on a turning table, up to a wall: its constraints are affine.
#[nonholonomic(
    base { x, y, f, h }
    basis { u, v, wx, wy }
    anchor { der(x) = u; der(y) = v; der(f) = wx; der(h) = wy; }
    lagrangian { m / 2 * (u^2 + v^2) + J / 2 * (wx^2 + wy^2) }
    constraints { u - r * wy = -W * y; v + r * wx = W * x; }
    independent { u, v }
    impacts { wall: x <= far with restitution e; }
)]
#[derive(Clone, Copy, Debug)]
struct OnTable {
    m: f64,
    J: f64,
    r: f64,
    W: f64,
    far: f64,
    e: f64,
}

/// What a jump loses is said where nothing moves by itself.
#[test]
fn what_a_jump_loses_is_said_where_it_is_known() {
    let table = OnTable { m: 0.3, J: 0.01, r: 0.1, W: 0.7, far: 1.0, e: 0.7 };
    let state = OnTableState { x: 1.0, y: 0.2, u: 0.8, ..OnTableState::default() };
    let struck = strike(&table, &OnTableWallImpact, 0.0, &state, 0.0).unwrap();
    assert!(struck.impulses[0] > 0.0 && struck.lost.is_none(), "{struck:?}");
    let turned = table.energy(0.0, &struck.before) - table.energy(0.0, &struck.after);
    assert!((struck.after.u + 0.7 * 0.8).abs() < 1e-14 && turned.abs() > 1e-6, "{struck:?}");
}
