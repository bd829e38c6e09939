//! Events: found, located, in order, in both directions of time.

use core::ops::ControlFlow;

use nonholonomic::Method;
use nonholonomic::prelude::*;

use crate::systems::{Driven, Line, Pendulum, Plane, Scalar1, Torque, distance};

const START: Plane<f64> = Plane { q: 1.0, p: 0.0 };
const PI: f64 = core::f64::consts::PI;

/// q'' = −q.
fn circle() -> Scalar1 {
    Scalar1(|t, _, _| t.cos())
}

/// The zeros of sin within 20, by any method.
fn finds_all_zeros<M: Method<Scalar1>>(method: M, tolerance: f64) {
    let events = Events::new(|_, x: &Line<f64>, _: &Torque<f64>| [x.x]);
    let mut sim = Integrator::new(circle(), method, 0.0, Line { x: 0.0 });
    let mut found = Vec::new();
    let stop = sim.advance_watching(20.0, &events, |event| {
        found.push((event.time, event.direction));
        ControlFlow::Continue(())
    });
    assert_eq!((stop, sim.time()), (Ok(None), 20.0));
    assert_eq!(found.len(), 6, "{found:?}");
    for (i, (time, direction)) in (1_u8..).zip(&found) {
        let expected = if i % 2 == 1 { Direction::Falling } else { Direction::Rising };
        assert!((time - PI * f64::from(i)).abs() < tolerance && *direction == expected, "{found:?}");
    }
}

#[test]
fn every_method_finds_all_zeros() {
    finds_all_zeros(Euler::new(1e-3), 1e-2);
    finds_all_zeros(Rk4::new(0.3), 1e-3);
    finds_all_zeros(Bs23::new().rtol(1e-8), 1e-6);
    finds_all_zeros(Dopri5::new().rtol(1e-9), 1e-7);
    finds_all_zeros(Dop853::new().rtol(1e-11), 1e-9);
    finds_all_zeros(Vern9::new().rtol(1e-12), 1e-9);
    finds_all_zeros(ImplicitMidpoint::new(0.01), 1e-3);
    finds_all_zeros(GaussLegendre6::new(0.1), 1e-6);
    finds_all_zeros(Radau5::new().rtol(1e-9), 1e-6);
    finds_all_zeros(Rodas5P::new().rtol(1e-9), 1e-6);
    finds_all_zeros(Auto::new().rtol(1e-9), 1e-7);
    finds_all_zeros(Dop853::fixed(0.5), 1e-7);
}

#[test]
fn several_events_of_one_step_come_in_order() {
    // one long step of a straight line crosses them all
    let system = Scalar1(|_, _, _| 1.0);
    let levels = |_: f64, x: &Line<f64>, _: &Torque<f64>| [x.x - 0.7, 0.2 - x.x, x.x - 0.45, x.x - 0.2];
    for samples in [0, 3] {
        let events = Events::new(levels).samples(samples);
        let mut sim = Integrator::new(system, Dopri5::new().first_step(1.0), 0.0, Line { x: 0.0 });
        let mut found = Vec::new();
        let seen = |event: &Event<f64, Line<f64>>| {
            found.push((event.index, event.time));
            ControlFlow::Continue(())
        };
        sim.advance_watching(1.0, &events, seen).unwrap();
        assert_eq!(sim.statistics().steps, 1);
        let order: Vec<usize> = found.iter().map(|(index, _)| *index).collect();
        assert_eq!(order, [1, 3, 2, 0]);
        for ((_, time), level) in found.iter().zip([0.2, 0.2, 0.45, 0.7]) {
            assert!((time - level).abs() < 1e-15, "{found:?}");
        }
        // backwards they come in the opposite order, with the opposite directions
        found.clear();
        let events =
            events.directions([Direction::Falling, Direction::Rising, Direction::Rising, Direction::Falling]);
        sim.advance_watching(0.0, &events, |event| {
            found.push((event.index, event.time));
            ControlFlow::Continue(())
        })
        .unwrap();
        let order: Vec<usize> = found.iter().map(|(index, _)| *index).collect();
        assert_eq!(order, [0, 1, 3]);
    }
}

#[test]
fn a_stop_stands_at_the_event_and_goes_on_from_there() {
    fn check<M: Method<Driven> + Clone>(method: M, tolerance: f64) {
        let mut sim = Integrator::new(Driven, method.clone(), 0.0, START);
        let events = Events::new(|_, x: &Plane<f64>, (): &()| [x.q, x.p]);
        let mut count = 0;
        while let Some(event) = sim.advance_until(12.0, &events).unwrap() {
            count += 1;
            assert_eq!((sim.time(), *sim.state()), (event.time, event.state));
            assert!(distance(&event.state, &Driven::solution(event.time)) < tolerance);
            let value = if event.index == 0 { event.state.q } else { event.state.p };
            assert!(value.abs() < 1e-12, "{event:?}");
            // the part of the step before the event is still there
            assert!(sim.at(event.time).is_ok());
        }
        assert_eq!(sim.time(), 12.0);
        assert!(distance(sim.state(), &Driven::solution(12.0)) < tolerance);
        // as many as are passed without stopping
        let mut passed = 0;
        let mut sim = Integrator::new(Driven, method, 0.0, START);
        sim.advance_watching(12.0, &events, |_| {
            passed += 1;
            ControlFlow::Continue(())
        })
        .unwrap();
        assert_eq!(count, passed);
    }
    check(Rk4::new(0.05), 1e-4);
    check(Dopri5::new().rtol(1e-9), 1e-6);
    check(Dop853::new().rtol(1e-11), 1e-8);
    check(Vern9::new().rtol(1e-12), 1e-9);
    check(Radau5::new().rtol(1e-9), 1e-5);
    check(Rodas5P::new().rtol(1e-9), 1e-5);
    check(GaussLegendre4::new(0.02), 1e-5);
}

#[test]
fn a_start_on_zero_is_no_event_but_the_return_is() {
    // thrown up from the ground: the whole flight fits into one step
    let system = Scalar1(|t, _, _| 5.0 - 10.0 * t);
    let ground = Events::new(|_, x: &Line<f64>, _: &Torque<f64>| [x.x]);
    for samples in [0, 3] {
        let method = Dopri5::new().first_step(1.5);
        let mut sim = Integrator::new(system, method, 0.0, Line { x: 0.0 });
        let impact = sim.advance_until(1.5, &ground.samples(samples)).unwrap().expect("an impact");
        assert!((impact.time - 1.0).abs() < 1e-14 && impact.direction == Direction::Falling);
        // at rest on the ground, or sinking from it, there is none
        for slope in [|_: f64, _: f64, _: f64| 0.0, |_: f64, _: f64, _: f64| -1.0] {
            let mut sim = Integrator::new(Scalar1(slope), method, 0.0, Line { x: 0.0 });
            assert_eq!(sim.advance_until(1.5, &ground.samples(samples)), Ok(None));
        }
    }
}

#[test]
fn touching_zero_at_the_end_of_a_step_is_an_event_once() {
    let system = Scalar1(|_, _, _| 1.0);
    let events = Events::new(|_, x: &Line<f64>, _: &Torque<f64>| [x.x - 0.5]);
    let mut sim = Integrator::new(system, Euler::new(0.25), 0.0, Line { x: 0.0 });
    let event = sim.advance_until(1.0, &events).unwrap().expect("an event");
    assert_eq!((event.time, sim.time()), (0.5, 0.5));
    assert_eq!(sim.advance_until(1.0, &events), Ok(None));
    assert_eq!((sim.time(), sim.statistics().steps), (1.0, 4));
}

#[test]
fn jumps_are_located_too() {
    let system = Scalar1(|_, _, _| 1.0);
    let events = Events::new(|t: f64, _: &Line<f64>, _: &Torque<f64>| [if t < 0.3 { -1.0 } else { 5.0 }]);
    let mut sim = Integrator::new(system, Dop853::new(), 0.0, Line { x: 0.0 });
    let event = sim.advance_until(1.0, &events).unwrap().expect("an event");
    assert!((event.time - 0.3).abs() < 1e-15 && event.time >= 0.3);
}

#[test]
fn as_many_samples_as_can_be_asked_for() {
    let soon = Events::new(|t, _: &Line<f64>, _: &Torque<f64>| [t - 1e-12]).samples(u32::MAX);
    let mut sim = Integrator::new(circle(), Rk4::new(1.0), 0.0, Line { x: 1.0 });
    let event = sim.advance_until(1.0, &soon).unwrap().expect("an event");
    assert!((event.time - 1e-12).abs() < 1e-15, "{event:?}");
}

#[test]
fn what_cannot_be_looked_at_is_an_error_and_leaves_the_state() {
    let events = Events::new(|t: f64, x: &Plane<f64>, _: &Torque<f64>| [x.p - 10.0, (1.0 - t).sqrt()]);
    let mut sim = Integrator::new(Pendulum { g: 1.0 }, Dopri5::new(), 0.0, START);
    let error = sim.advance_until(3.0, &events).unwrap_err();
    assert!(matches!(error, IntegrationError::NonFiniteEvent { event: 1, time, .. } if time > 1.0));
    assert!(sim.time() < 1.0 && sim.state().q.is_finite());
    let error = IntegrationError::NonFiniteEvent { event: 1, time: 1.5, value: f64::NAN };
    assert_eq!(
        error.to_string(),
        "the event function 1 is NaN at t = 1.5, so that its zeros cannot be found: it has to be finite \
         wherever the solution leads"
    );
    let time = sim.time();
    sim.advance_to(3.0).unwrap();
    assert!(time < 3.0);
}

#[test]
fn stops_and_samples_come_in_turn() {
    let mut sim = Integrator::new(Driven, Dop853::new().rtol(1e-10), 0.0, START);
    let mut seen = Vec::new();
    sim.advance_through([0.5, 2.0, 1.0], |sim| seen.push((sim.time(), *sim.state()))).unwrap();
    assert_eq!(seen.iter().map(|(t, _)| *t).collect::<Vec<_>>(), [0.5, 2.0, 1.0]);
    assert!(seen.iter().all(|(t, x)| distance(x, &Driven::solution(*t)) < 1e-7));

    sim.reset(0.0, START);
    let mut times = Vec::new();
    sim.sample((0..=400).map(|i| f64::from(i) * 0.05), |t, x| {
        assert!(distance(x, &Driven::solution(t)) < 1e-7);
        times.push(t);
    })
    .unwrap();
    assert_eq!((times.len(), sim.time()), (401, 20.0));
    assert!(sim.statistics().steps < 120, "{:?}", sim.statistics());
    // within a step, too, times follow one another; what repeats is given again
    sim.reset(0.0, START);
    let mut seen = Vec::new();
    let unordered = sim.sample([1e-3, 3e-3, 3e-3, 2e-3, 4e-3], |t, _| seen.push(t));
    let expected = IntegrationError::UnorderedTimes { time: 2e-3, before: 3e-3, last: 4e-3 };
    assert_eq!((unordered, seen.len(), sim.time()), (Err(expected), 0, 0.0));
    sim.sample([1e-3, 3e-3, 3e-3, 4e-3], |t, _| seen.push(t)).unwrap();
    assert_eq!(seen, [1e-3, 3e-3, 3e-3, 4e-3]);
    assert_eq!(
        expected.to_string(),
        "states were asked for at t = 0.003 and then at 0.002, on the way to 0.004: sort the times, or go through them \
         with `advance_through`, which may turn back"
    );
    sim.reset(0.0, START);
    let backwards = sim.sample([-1e-3, -3e-3, -2e-3, -4e-3], |_, _| {});
    assert!(matches!(backwards, Err(IntegrationError::UnorderedTimes { time: -2e-3, .. })), "{backwards:?}");
    sim.reset(20.0, START);
    let late = sim.sample([20.0, 3.0, 21.0], |_, _| {});
    assert!(matches!(late, Err(IntegrationError::UnorderedTimes { time: 3.0, .. })));
    // back to where the run stands, from where it has not been; nothing moves for it
    for times in [[21.0, 21.0, 20.0], [22.0, 21.5, 21.0], [19.0, 19.0, 19.5]] {
        let refused = sim.sample(times, |_, _| {});
        assert!(matches!(refused, Err(IntegrationError::OutsideLastStep { .. })), "{times:?}: {refused:?}");
        assert_eq!(sim.time(), 20.0);
    }
    assert_eq!(
        sim.sample([20.0, f64::NAN], |_, _| {}).map_err(|error| error.to_string()),
        Err("the time NaN cannot be reached: times have to be finite".into())
    );
}
