//! Machines with several items, run from event to event: whatever comes to rest does not fall through.

use core::ops::ControlFlow;

use nonholonomic::impacts::ImpactError;
use nonholonomic::prelude::*;
use nonholonomic::{Direction, Events};

/// A rod over a table, each end by itself.
#[nonholonomic(
    base { x, y, th }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) + J / 2 * der(th)^2 - m * g * y }
    impacts {
        left: y - l * sin(th) >= 0 with restitution e;
        right: y + l * sin(th) >= 0 with restitution e;
    }
)]
#[derive(Clone, Copy, Debug)]
struct Rod {
    m: f64,
    J: f64,
    g: f64,
    l: f64,
    e: f64,
}

/// A ball in a corner.
#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) - m * (g * y + push * x) }
    impacts { floor: y >= 0 with restitution e; wall: x >= 0 with restitution e; }
)]
#[derive(Clone, Copy, Debug)]
struct Ball {
    m: f64,
    g: f64,
    push: f64,
    e: f64,
}

/// Runs to the end in pieces, with the jumps of both items wherever one of their gaps closes.
fn run<S: Dynamics<State: State<Scalar = f64>, Input = ()> + Copy>(
    system: S,
    start: S::State,
    pieces: u32,
    gaps: impl Fn(f64, &S::State) -> [f64; 2],
    jump: impl Fn(f64, &S::State) -> Result<S::State, ImpactError>,
) -> (Option<IntegrationError>, S::State) {
    let events = Events::new(|t, x: &S::State, (): &()| gaps(t, x)).directions([Direction::Closing; 2]);
    let mut sim = Integrator::new(system, Dopri5::new().rtol(1e-9).atol(1e-12), 0.0, start);
    let mut ended = None;
    for piece in 1..=pieces {
        let target = 3.0 * f64::from(piece) / f64::from(pieces);
        let run = sim.advance_acting(target, &events, |sim, _| {
            let after = jump(sim.time(), sim.state()).expect("the rows are independent");
            sim.set_state(after);
            ControlFlow::Continue(())
        });
        if let Err(error) = run {
            ended = Some(error);
            break;
        }
    }
    (ended, *sim.state())
}

#[test]
fn a_ball_in_a_corner_stays_in_it() {
    for e in [0.0, 0.5, 0.8] {
        for (x, y) in [(0.5, 1.0), (0.0, 1.0), (0.5, 0.0), (0.0, 0.0), (-1e-9, 1.0)] {
            for pieces in [1, 7, 300] {
                let ball = Ball { m: 0.3, g: 9.81, push: 4.0, e };
                let start = BallState { x, y, ..BallState::default() };
                let (ended, last) = run(
                    ball,
                    start,
                    pieces,
                    |t, s| [ball.event_floor(t, s), ball.event_wall(t, s)],
                    |t, s| ball.impact_floor(t, s).and_then(|(s, _)| Ok(ball.impact_wall(t, &s)?.0)),
                );
                let case = format!("e = {e} from {x}, {y} in {pieces}: {last:?}");
                assert!(last.y > -1e-9 && last.x > -2e-9, "{case}");
                let accumulates = matches!(ended, Some(IntegrationError::EventsAccumulate { .. }));
                assert!(accumulates || e == 0.8, "{case}, {ended:?}");
            }
        }
    }
}

#[test]
fn a_rod_on_its_ends_stays_above_the_table() {
    for e in [0.0, 0.5] {
        for th in [0.0, 0.3, -0.7] {
            for pieces in [1, 2, 300] {
                let rod = Rod { m: 1.0, J: 0.2, g: 9.81, l: 1.0, e };
                let start = RodState { y: 1.5, th, ..RodState::default() };
                let gaps = |t: f64, s: &RodState| [rod.event_left(t, s), rod.event_right(t, s)];
                let (ended, last) = run(rod, start, pieces, gaps, |t, s| {
                    rod.impact_left(t, s).and_then(|(s, _)| Ok(rod.impact_right(t, &s)?.0))
                });
                let case = format!("e = {e}, {th} in {pieces}: {last:?}");
                assert!(gaps(0.0, &last).iter().all(|gap| *gap > -1e-9), "{case}");
                assert!(
                    matches!(ended, Some(IntegrationError::EventsAccumulate { .. })),
                    "{case}, {ended:?}"
                );
            }
        }
    }
}

/// A ball on a table that shakes, under a lid that shakes with it.
#[nonholonomic(
    base { y }
    lagrangian { m / 2 * der(y)^2 - m * g * y }
    impacts {
        table: y >= A * sin(w * t) with restitution e;
        lid: y <= A * sin(w * t) + high with restitution e;
    }
)]
#[derive(Clone, Copy, Debug)]
struct Shaken {
    m: f64,
    g: f64,
    A: f64,
    w: f64,
    high: f64,
    e: f64,
}

/// Random tables: between its events a ball is never found outside, whichever way its steps are cut.
#[test]
fn a_ball_in_a_box_that_shakes_stays_in_it() {
    let mut seed = 7_u64;
    let mut random = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        f64::from(u32::try_from(seed >> 32).unwrap()) / f64::from(u32::MAX)
    };
    let mut ends = [0; 2];
    for case in 0..200 {
        let e = [0.0, 0.3, 0.9, random()][case % 4];
        let shaken =
            Shaken { m: 0.3, g: 9.81, A: 0.2 * random(), w: 20.0 * random(), high: 0.05 + random(), e };
        let inside = |t: f64, s: &ShakenState| [shaken.event_table(t, s), shaken.event_lid(t, s)];
        let events =
            Events::new(|t, x: &ShakenState, (): &()| inside(t, x)).directions([Direction::Closing; 2]);
        let start = ShakenState { y: shaken.high * random(), y_dot: 4.0 * random() - 2.0 };
        let mut sim = Integrator::new(shaken, Dopri5::new().rtol(1e-9).atol(1e-12), 0.0, start);
        let mut ended = None;
        for piece in 1..=500 {
            let target = 0.01 * f64::from(piece);
            let run = sim.advance_acting(target, &events, |sim, _| {
                let (t, before) = (sim.time(), *sim.state());
                let after =
                    shaken.impact_table(t, &before).and_then(|(s, _)| Ok(shaken.impact_lid(t, &s)?.0));
                sim.set_state(after.expect("rows of one coordinate"));
                ControlFlow::Continue(())
            });
            let gaps = inside(sim.time(), sim.state());
            assert!(
                gaps.iter().all(|gap| *gap > -1e-9),
                "case {case}, {shaken:?} at {}: {gaps:?}, {run:?}",
                sim.time()
            );
            if let Err(error) = run {
                ended = Some(error);
                break;
            }
        }
        match ended {
            None => ends[0] += 1,
            Some(IntegrationError::EventsAccumulate { .. }) => ends[1] += 1,
            other => panic!("case {case}, {shaken:?}: {other:?}"),
        }
    }
    // many come to rest, and many do not
    assert!(ends.iter().all(|count| *count > 20), "{ends:?}");
}
