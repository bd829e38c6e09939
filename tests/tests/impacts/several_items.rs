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
