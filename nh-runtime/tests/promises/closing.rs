//! Gaps: what rests on a contact, or is put below it, does not fall through.

use core::ops::ControlFlow;

use nonholonomic::Method;
use nonholonomic::prelude::*;

use crate::events::{Balls, Flight};
use crate::systems::every_kind;

/// Where a ball begins: its height and its speed.
const STARTS: [(f64, f64); 6] = [(1.0, 0.0), (0.2, 3.0), (0.0, 0.0), (0.0, -2.0), (0.0, 2.0), (-0.1, 0.0)];

/// How the one who acts goes on after an impact.
const RESTITUTIONS: [f64; 3] = [0.0, 0.1, 0.5];

fn stays_above<T: Real>(name: &str, method: impl Method<Balls<T>> + Clone) {
    let c = T::from_f64;
    for (height, speed) in STARTS {
        for restitution in RESTITUTIONS {
            for chunks in [1, 7] {
                let case = format!("{name} from {height}, {speed}, e = {restitution}, {chunks}");
                let start = Flight { height: [c(height), c(1e6)], speed: [c(speed), T::ZERO] };
                let mut sim = Integrator::new(Balls { g: c(9.81) }, method.clone(), T::ZERO, start);
                let gap =
                    Events::new(|_, x: &Flight<T>, (): &()| [x.height[0]]).directions([Direction::Closing]);
                let end = (1..=chunks).map(|chunk| c(9.0 * f64::from(chunk) / f64::from(chunks))).find_map(
                    |target| {
                        let ended = sim.advance_acting(target, &gap, |sim, impact| {
                            let mut next = impact.state;
                            next.speed[0] = -c(restitution) * next.speed[0];
                            sim.set_state(next);
                            ControlFlow::Continue(())
                        });
                        ended.err()
                    },
                );
                let found = end.unwrap_or_else(|| panic!("{case}: fell to {:?}", sim.state()));
                assert!(
                    matches!(found, IntegrationError::EventsAccumulate { event: 0, .. }),
                    "{case}: {found}"
                );
                let low = sim.state().height[0];
                assert!(low.abs() < c(1e-5) - c(height).min(T::ZERO), "{case}: ended at {low:?}");
            }
        }
    }
}

#[test]
fn what_rests_on_a_gap_meets_it() {
    every_kind!(stays_above::<f64>, 0.1);
    every_kind!(stays_above::<f32>, 0.1);
}

/// From below it rises without an event; nothing is reported until it falls.
fn rises<T: Real>(name: &str, method: impl Method<Balls<T>> + Clone) {
    let c = T::from_f64;
    for depth in [0.0, 1e-3, 0.1] {
        let start = Flight { height: [-c(depth), c(1e6)], speed: [c(3.0), T::ZERO] };
        let mut sim = Integrator::new(Balls { g: c(9.81) }, method.clone(), T::ZERO, start);
        let gap = Events::new(|_, x: &Flight<T>, (): &()| [x.height[0]]).directions([Direction::Closing]);
        let landed = sim.advance_until(c(2.0), &gap).unwrap().unwrap();
        let expected = (3.0 + (9.0 - 2.0 * 9.81 * depth).sqrt()) / 9.81;
        let off = landed.time.to_f64() - expected;
        assert!(off.abs() < 1e-4 && landed.direction == Direction::Falling, "{name}, {depth}: {landed:?}");
        // nobody has acted: it is still closed
        let again = sim.advance_until(c(2.0), &gap);
        assert!(
            matches!(again, Err(IntegrationError::EventsAccumulate { .. })),
            "{name}, {depth}: {again:?}"
        );
    }
}

#[test]
fn what_rises_out_of_a_contact_has_no_event_there() {
    every_kind!(rises::<f64>, 0.1);
    every_kind!(rises::<f32>, 0.1);
}

/// How far a step leads after flights of 0.9.
const SIGHT: f64 = 4.0;

/// A ball that loses nothing closes its gap at zero a thousand times, although a step takes whole flights, and what a step
/// rounds leaves the ball a little lower each time: on the way to a target that is near, or far.
fn goes_on<T: Real>(name: &str, method: impl Method<Balls<T>> + Clone) {
    let c = T::from_f64;
    for legs in [225, 1] {
        let start = Flight { height: [T::ONE, c(1e6)], speed: [T::ZERO; 2] };
        let mut sim = Integrator::new(Balls { g: c(9.81) }, method.clone(), T::ZERO, start);
        let gap = Events::new(|_, x: &Flight<T>, (): &()| [x.height[0]]).directions([Direction::Closing]);
        // the height from which a step would fall
        let allowed = c(50.0) * T::EPSILON * c(9.81 / 2.0 * SIGHT * SIGHT);
        let mut impacts = 0_u32;
        for leg in 1..=legs {
            let target = 900.0 * f64::from(leg) / f64::from(legs);
            let end = sim.advance_acting(c(target), &gap, |sim, impact| {
                impacts += 1;
                let mut next = impact.state;
                assert!(next.height[0].abs() < allowed, "{name}, {impacts}: {next:?}, allowed {allowed:?}");
                next.speed[0] = -next.speed[0];
                sim.set_state(next);
                ControlFlow::Continue(())
            });
            assert!(matches!(end, Ok(None)), "{name}, {impacts}: {end:?}");
        }
        let expected = 0.5 + 900.0 / (8.0_f64 / 9.81).sqrt();
        assert!((f64::from(impacts) / expected - 1.0).abs() < 0.01, "{name}: {impacts}, {expected}");
    }
}

#[test]
fn a_ball_that_loses_nothing_bounces_on() {
    every_kind!(goes_on::<f64>, 0.1);
    every_kind!(goes_on::<f32>, 0.1);
}
