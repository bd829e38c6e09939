//! Events that act: what is changed at them acts from there on, all events of an instant are handed over at once, and the
//! limits hold for the whole run.

use core::ops::ControlFlow;

use nonholonomic::prelude::*;

use crate::systems::{Line, Pendulum, Plane, Scalar1, Torque};

const GO_ON: ControlFlow<()> = ControlFlow::Continue(());

#[test]
fn state_input_and_parameters_act_from_the_event_on() {
    // up at the speed of the torque, which turns at 1 and at 0
    let rises = Scalar1(|_, _, u| u);
    let mut sim = Integrator::new(rises, Rk4::new(0.125), 0.0, Line { x: 0.5 });
    sim.set_input(Torque { torque: 1.0 });
    let ends = Events::new(|_, x: &Line<f64>, _: &Torque<f64>| [x.x - 1.0, x.x])
        .directions([Direction::Rising, Direction::Falling]);
    let mut turns = Vec::new();
    let ended = sim.advance_acting(4.25, &ends, |sim, turn| {
        turns.push((turn.time, turn.of(0).is_some(), turn.of(1).is_some()));
        let torque = -sim.input().torque;
        sim.set_input(Torque { torque });
        GO_ON
    });
    assert_eq!((ended, sim.time()), (Ok(None), 4.25));
    let expected = [(0.5, true, false), (1.5, false, true), (2.5, true, false), (3.5, false, true)];
    for ((time, up, down), expected) in turns.iter().zip(expected) {
        assert!((time - expected.0).abs() < 1e-14 && (*up, *down) == (expected.1, expected.2), "{turns:?}");
    }
    assert_eq!(turns.len(), 4);
    assert!((sim.state().x - 0.75).abs() < 1e-14);

    // a pendulum that is taken to where nothing pulls when it is lowest moves on evenly
    let start = Plane { q: 0.1, p: 0.0 };
    let mut sim = Integrator::new(Pendulum { g: 1.0 }, Dop853::new().rtol(1e-12), 0.0, start);
    let lowest = Events::new(|_, x: &Plane<f64>, _: &Torque<f64>| [x.q]);
    let mut lowest_at = None;
    let ended = sim.advance_acting(5.0, &lowest, |sim, event| {
        lowest_at = Some((event.time, event.state));
        sim.system_mut().g = 1e-300;
        GO_ON
    });
    assert_eq!(ended, Ok(None));
    let (time, state) = lowest_at.unwrap();
    assert!((sim.state().q - state.p * (5.0 - time)).abs() < 1e-13);
    assert!((sim.state().p - state.p).abs() < 1e-14);
}

#[test]
fn parameters_are_checked_before_they_act() {
    let start = Plane { q: 0.1, p: 0.0 };
    let mut sim = Integrator::new(Pendulum { g: 1.0 }, Rk4::new(0.1), 0.0, start);
    sim.advance_to(1.0).unwrap();
    sim.system_mut().g = -1.0;
    let here = *sim.state();
    let error = sim.step().unwrap_err();
    assert!(error.to_string().contains("the parameter `g` is -1.0"), "{error}");
    assert_eq!((*sim.state(), sim.time()), (here, 1.0));
    // the step before belongs to the old parameters
    sim.system_mut().g = 2.0;
    assert!(sim.at(0.95).is_err());
    sim.step().unwrap();
}

#[test]
fn all_events_of_an_instant_come_together() {
    let rises = Scalar1(|_, _, _| 1.0);
    let mut sim = Integrator::new(rises, Rk4::new(0.5), 0.0, Line { x: 0.0 });
    let levels =
        Events::new(|_, x: &Line<f64>, _: &Torque<f64>| [x.x - 0.7, x.x - 2.0, 0.7 - x.x, 3.0 * x.x - 2.1]);
    let mut seen = Vec::new();
    let ended = sim.advance_acting(1.0, &levels, |_, now| {
        seen.push(now.iter().map(|event| event.index).collect::<Vec<_>>());
        ControlFlow::Break(())
    });
    let ended = ended.unwrap().unwrap();
    assert_eq!(sim.time(), ended.time);
    assert_eq!(seen.len(), 1);
    // as far as time resolves them: 3 · 0.7 is not 2.1
    assert!(seen[0].starts_with(&[0, 2]), "{seen:?}");
    assert!(ended.of(1).is_none() && ended.of(7).is_none());
}

#[test]
fn what_was_learnt_about_the_steps_goes_on_after_a_jump() {
    let run = |anew: bool| {
        let start = Plane { q: 1.0, p: 0.0 };
        let mut sim = Integrator::new(Pendulum { g: 1e4 }, Dopri5::new().rtol(1e-8), 0.0, start);
        let lowest = Events::new(|_, x: &Plane<f64>, _: &Torque<f64>| [x.q]);
        let mut tries = 0;
        sim.advance_acting(1.0, &lowest, |sim, event| {
            let state = Plane { q: 0.0, p: 0.999 * event.state.p };
            if anew {
                let statistics = sim.statistics();
                tries += statistics.evaluations;
                sim.reset(event.time, state);
            } else {
                sim.set_state(state);
            }
            GO_ON
        })
        .unwrap();
        tries + sim.statistics().evaluations
    };
    let (goes_on, begins_anew) = (run(false), run(true));
    assert!(goes_on < begins_anew, "{goes_on} {begins_anew}");
}

#[test]
fn limits_hold_for_the_whole_run() {
    let rises = Scalar1(|_, _, _| 1.0);
    let mut sim = Integrator::new(rises, Rk4::new(0.01), 0.0, Line { x: 0.0 }).max_steps(50);
    let level = Events::new(|_, x: &Line<f64>, _: &Torque<f64>| [x.x - 0.095]);
    let mut falls = 0;
    let error = sim.advance_acting(10.0, &level, |sim, _| {
        falls += 1;
        sim.set_state(Line { x: 0.0 });
        GO_ON
    });
    assert_eq!(error, Err(IntegrationError::TooManySteps { time: sim.time(), target: 10.0, limit: 50 }));
    assert_eq!((falls, sim.statistics().steps), (5, 50));
}

#[test]
fn impacts_that_do_not_end_are_an_error() {
    #[derive(Clone, Copy)]
    struct Ball;
    impl Dynamics for Ball {
        type State = Plane<f64>;
        type Input = ();
        fn derivative(&self, _t: f64, x: &Plane<f64>, (): &()) -> Plane<f64> {
            Plane { q: x.p, p: -9.81 }
        }
    }
    let start = Plane { q: 1.0, p: 0.0 };
    let mut sim = Integrator::new(Ball, Dopri5::new(), 0.0, start);
    let ground = Events::new(|_, x: &Plane<f64>, (): &()| [x.q]).directions([Direction::Falling]);
    let ended = sim.advance_acting(10.0, &ground, |sim, impact| {
        sim.set_state(Plane { q: 0.0, p: -0.5 * impact.state.p });
        GO_ON
    });
    assert!(matches!(ended, Err(IntegrationError::EventsAccumulate { .. })), "{ended:?}");
    assert!(sim.state().q >= -1e-12);
}
