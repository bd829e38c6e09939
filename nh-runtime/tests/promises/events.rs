//! Events: none is invented where a function starts from zero, none is lost, and where they accumulate a run ends.

use core::ops::ControlFlow;

use nonholonomic::prelude::*;
use nonholonomic::{D, Method};

use crate::systems::every_kind;

/// Two balls above a floor.
#[derive(Clone, Copy)]
pub(crate) struct Balls<T> {
    pub(crate) g: T,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Flight<T> {
    pub(crate) height: [T; 2],
    pub(crate) speed: [T; 2],
}

impl<T: Real> State for Flight<T> {
    type Scalar = T;
    type Dim = D<4>;
    fn to_array(&self) -> [T; 4] {
        [self.height[0], self.height[1], self.speed[0], self.speed[1]]
    }
    fn from_array([a, b, c, d]: [T; 4]) -> Self {
        Self { height: [a, b], speed: [c, d] }
    }
    fn names() -> [&'static str; 4] {
        ["height[0]", "height[1]", "speed[0]", "speed[1]"]
    }
}

impl<T: Real> Dynamics for Balls<T> {
    type State = Flight<T>;
    type Input = ();
    fn derivative(&self, _t: T, x: &Flight<T>, (): &()) -> Flight<T> {
        Flight { height: x.speed, speed: [-self.g; 2] }
    }
}

/// Calls a law with methods of every kind.
macro_rules! methods {
    ($law:expr, $number:ty) => {
        every_kind!($law, <$number as Scalar>::from_f64(0.1))
    };
}

/// A ball that loses speed at every impact, until the impacts accumulate; the other one stays far above.
fn bounces<T: Real>(name: &str, method: impl Method<Balls<T>> + Clone) {
    for restitution in [0.8, 0.5, 0.1] {
        for direction in [Direction::Falling, Direction::Either] {
            for exact in [true, false] {
                comes_to_rest(name, method.clone(), restitution, direction, exact);
            }
        }
    }
}

/// After an impact it is put onto the floor if that is to be `exact`, and left where it was found if not.
fn comes_to_rest<T: Real>(
    name: &str,
    method: impl Method<Balls<T>>,
    restitution: f64,
    direction: Direction,
    exact: bool,
) {
    let c = T::from_f64;
    let case = format!("{name}, e = {restitution}, {direction:?}, {exact}");
    let start = Flight { height: [T::ONE, c(1e6)], speed: [T::ZERO; 2] };
    let mut sim = Integrator::new(Balls { g: c(9.81) }, method, T::ZERO, start);
    let floor = Events::new(|_, x: &Flight<T>, (): &()| [x.height[0]]).directions([direction]);
    let mut impacts = 0;
    let end = loop {
        match sim.advance_until(c(100.0), &floor) {
            Ok(None) => panic!("{case}: fell through to {:?}", sim.state()),
            Ok(Some(impact)) => {
                assert_eq!(impact.direction, Direction::Falling, "{case} after {impacts}: {impact:?}");
                assert!(impact.state.height[0].abs() <= c(1e-5), "{case}: {impact:?}");
                let mut next = impact.state;
                next.speed[0] = -c(restitution) * next.speed[0];
                if exact {
                    next.height[0] = T::ZERO;
                }
                sim.reset(impact.time, next);
                impacts += 1;
                assert!(impacts < 5000, "{case} at {:?}", sim.time());
            }
            Err(end) => break end,
        }
    };
    assert!(matches!(end, IntegrationError::EventsAccumulate { event: 0, .. }), "{case}: {end}");
    // all flights together: a geometric series
    let first = (2.0_f64 / 9.81).sqrt();
    let expected = first * (1.0 + 2.0 * restitution / (1.0 - restitution));
    let off = sim.time().to_f64() - expected;
    assert!(off.abs() < 50.0 * T::DEFAULT_TOLERANCE.to_f64(), "{case}: {off:e} after {impacts}");
    assert!(sim.state().height[0].abs() < c(1e-5), "{case}: {:?}", sim.state());
}

#[test]
fn a_bouncing_ball_comes_to_rest_on_the_floor() {
    methods!(bounces::<f64>, f64);
    methods!(bounces::<f32>, f32);
    comes_to_rest("Dopri5", Dopri5::<f64>::new(), 0.98, Direction::Falling, true);
    comes_to_rest("Rk4", Rk4::<f64>::new(0.5), 0.99, Direction::Either, false);
    assert_eq!(
        IntegrationError::EventsAccumulate { event: 2, time: 1.5, flight: 2e-15, resolution: 3.5e-16 }
            .to_string(),
        "the event function 2 leaves zero at t = 1.5 and is back after 2e-15, where rounding leaves 3.5e-16 of \
         its zeros' times open: that is too little, or has been so too often in a row, to go on; events accumulate there, as the \
         impacts of a ball that comes to rest: go on with what holds from then on, such as the contact as a \
         constraint; or time is counted from too far away"
    );
}

/// Where time is counted from far away, flights of many seconds are a few hundred of its rounding units: an end of the
/// run says so.
#[test]
fn flights_that_far_times_do_not_resolve_are_told_with_their_lengths() {
    let start = Flight { height: [0.0, 1e6], speed: [29.0, 0.0] };
    let mut sim = Integrator::new(Balls { g: 1.0 }, Dopri5::new(), 1e15, start);
    let floor = Events::new(|_, x: &Flight<f64>, (): &()| [x.height[0]]).directions([Direction::Falling]);
    let end = (0..200).find_map(|_| {
        let found = sim.advance_until(2e15, &floor);
        sim.set_state(start);
        found.err()
    });
    let Some(IntegrationError::EventsAccumulate { event: 0, flight, resolution, .. }) = end else {
        panic!("{end:?}")
    };
    assert!((flight - 58.0).abs() < 1.0 && (resolution - 0.22).abs() < 0.01, "{end:?}");
}

/// Two balls that hit the floor at the same time, each sent up again by its own event.
fn both<T: Real>(name: &str, method: impl Method<Balls<T>>) {
    let c = T::from_f64;
    let start = Flight { height: [T::ONE; 2], speed: [T::ZERO; 2] };
    let mut sim = Integrator::new(Balls { g: c(9.81) }, method, T::ZERO, start);
    let floor = Events::new(|_, x: &Flight<T>, (): &()| [x.height[0], c(3.0) * x.height[1]])
        .directions([Direction::Falling; 2]);
    let mut impacts = [0; 2];
    while let Some(impact) = sim.advance_until(c(4.0), &floor).unwrap() {
        assert_eq!((impact.time, impact.state), (sim.time(), *sim.state()), "{name}");
        impacts[impact.index] += 1;
        let mut next = impact.state;
        next.height[impact.index] = T::ZERO;
        next.speed[impact.index] = -c(0.9) * next.speed[impact.index];
        sim.reset(impact.time, next);
    }
    assert_eq!(impacts, [6, 6], "{name}: {:?}", sim.state());
    // a handler that sends up both at the first event is not told of the other
    let mut sim = {
        sim.reset(T::ZERO, start);
        sim
    };
    let mut impacts = 0;
    while let Some(impact) = sim.advance_until(c(4.0), &floor).unwrap() {
        impacts += 1;
        let up = impact.state.speed.map(|speed| -c(0.9) * speed);
        sim.reset(impact.time, Flight { height: [T::ZERO; 2], speed: up });
    }
    assert_eq!(impacts, 6, "{name}");
}

#[test]
fn of_two_impacts_at_the_same_time_none_is_lost() {
    methods!(both::<f64>, f64);
    methods!(both::<f32>, f32);
}

/// Functions of all sizes that vanish together.
fn together<T: Real>(name: &str, method: impl Method<Balls<T>> + Clone) {
    let c = T::from_f64;
    let start = Flight { height: [T::ONE, c(2.0)], speed: [T::ZERO; 2] };
    let factors = [1.0, -1e-30, 3.0, 1e30, -7.7, 0.1].map(c);
    let events = Events::new(|_, x: &Flight<T>, (): &()| factors.map(|f| f * x.height[0]));
    for restarted in [false, true] {
        let mut sim = Integrator::new(Balls { g: c(9.81) }, method.clone(), T::ZERO, start);
        let (mut found, mut times) = (Vec::new(), Vec::new());
        while let Some(event) = sim.advance_until(T::ONE, &events).unwrap() {
            let direction =
                if factors[event.index] > T::ZERO { Direction::Falling } else { Direction::Rising };
            assert_eq!(event.direction, direction, "{name}: {event:?}");
            found.push(event.index);
            times.push(event.time);
            if restarted {
                sim.reset(event.time, event.state);
            }
        }
        assert_eq!(found, [0, 1, 2, 3, 4, 5], "{name}");
        assert!(times.iter().all(|time| *time == times[0]), "{name}: {times:?}");
    }
    // all are visited before a run stops
    let mut sim = Integrator::new(Balls { g: c(9.81) }, method, T::ZERO, start);
    let mut visited = 0;
    let stopped = sim.advance_watching(T::ONE, &events, |_| {
        visited += 1;
        if visited == 2 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    assert_eq!((visited, stopped.unwrap().map(|event| event.index)), (6, Some(1)), "{name}");
    assert_eq!(sim.advance_until(T::ONE, &events), Ok(None), "{name}");
}

#[test]
fn events_at_the_same_time_are_all_reported_once() {
    methods!(together::<f64>, f64);
    methods!(together::<f32>, f32);
}

/// A clock whose powers are watched: t, t², t³, and their differences from where they start.
fn starts<T: Real>(name: &str, method: impl Method<Balls<T>> + Clone) {
    let c = T::from_f64;
    for offset in [0.0, 1.0, -3.0, 1e3] {
        let offset = c(offset);
        let start = Flight { height: [offset, T::ZERO], speed: [T::ONE, T::ZERO] };
        let events = Events::new(|_, x: &Flight<T>, (): &()| {
            let t = x.height[0] - offset;
            [t, t * t, t * t * t, -t, t.sin(), T::ONE - t.cos(), t * t - t * c(1e-3) * t, T::ZERO]
        });
        for target in [2.0, -2.0] {
            let mut sim = Integrator::new(Balls { g: T::ZERO }, method.clone(), T::ZERO, start);
            let found = sim.advance_until(c(target), &events);
            assert_eq!(found, Ok(None), "{name} from {offset:?} to {target}");
        }
    }
}

#[test]
fn a_start_from_zero_is_no_event() {
    methods!(starts::<f64>, f64);
    methods!(starts::<f32>, f32);
}

/// Two zeros between two points that a step is looked at.
fn dips<T: Real>(name: &str, method: impl Method<Balls<T>> + Clone) {
    let c = T::from_f64;
    // a parabola over time that dips by 2⁻¹⁰ at its turn
    let depth = c(1.0 / 1024.0);
    for turn in [0.03, 0.1, 0.3, 0.55, 0.97] {
        let turn = c(turn);
        let start = Flight { height: [turn * turn - depth, T::ONE], speed: [-(turn + turn), T::ZERO] };
        let mut sim = Integrator::new(Balls { g: -c(2.0) }, method.clone(), T::ZERO, start);
        let floor = Events::new(|_, x: &Flight<T>, (): &()| [x.height[0], -x.height[0]]);
        let mut found = Vec::new();
        while let Some(event) = sim.advance_until(T::from_f64(2.0), &floor).unwrap() {
            found.push((event.index, event.direction, event.time));
        }
        let half = depth.sqrt();
        let expected = [(turn - half, Direction::Falling), (turn + half, Direction::Rising)];
        let expected: Vec<_> = expected.into_iter().filter(|(time, _)| *time > T::ZERO).collect();
        assert_eq!(found.len(), 2 * expected.len(), "{name}, {turn:?}: {found:?}");
        for (pair, (time, direction)) in found.chunks(2).zip(expected) {
            assert_eq!((pair[0].0, pair[0].1), (0, direction), "{name}, {turn:?}: {found:?}");
            assert!((pair[0].2 - time).to_f64().abs() < 1e-4, "{name}, {turn:?}: {found:?} {time:?}");
            assert_eq!((pair[1].0, pair[1].2), (1, pair[0].2));
        }
    }
}

#[test]
fn two_zeros_between_two_samples_are_found() {
    methods!(dips::<f64>, f64);
    methods!(dips::<f32>, f32);
}

/// What is multiplied by a power of two vanishes at the same time, to the last bit.
fn scaled<T: Real>(name: &str, method: impl Method<Balls<T>> + Clone) {
    let c = T::from_f64;
    let start = Flight { height: [T::ONE, c(2.0)], speed: [c(2.0), T::ZERO] };
    let huge = T::MIN_POSITIVE.recip() * c(1.0 / 1024.0);
    let mut times = Vec::new();
    for factor in [T::ONE, huge, -huge, huge.recip(), -T::MIN_POSITIVE * c(1024.0)] {
        let mut sim = Integrator::new(Balls { g: c(9.81) }, method.clone(), T::ZERO, start);
        let floor = Events::new(|_, x: &Flight<T>, (): &()| [factor * x.height[0]]);
        times.push(sim.advance_until(T::ONE, &floor).unwrap().map(|event| event.time));
    }
    let first = times[0].unwrap();
    let off = |time: &Option<T>| (time.unwrap() - first).abs().to_f64();
    assert!(times.iter().all(|time| off(time) <= 2.0 * T::EPSILON.to_f64()), "{name}: {times:?}");
}

#[test]
fn the_scale_of_a_function_does_not_matter() {
    methods!(scaled::<f64>, f64);
    methods!(scaled::<f32>, f32);
}

/// A zero where a run ends belongs to that run alone.
fn at_the_end<T: Real>(name: &str, method: impl Method<Balls<T>> + Clone) {
    let c = T::from_f64;
    let start = Flight { height: [c(-0.5), T::ONE], speed: [T::ONE, T::ZERO] };
    let events = Events::new(|_, x: &Flight<T>, (): &()| [x.height[0], x.height[0]]);
    for target in [c(0.5), T::ONE] {
        let mut sim = Integrator::new(Balls { g: T::ZERO }, method.clone(), T::ZERO, start);
        let mut found = Vec::new();
        for stop in [c(0.25), target, c(2.0)] {
            while let Some(event) = sim.advance_until(stop, &events).unwrap() {
                assert!((event.time - c(0.5)).abs() < T::DEFAULT_TOLERANCE, "{name}: {event:?}");
                found.push(event.index);
            }
            assert_eq!(sim.time(), stop);
        }
        assert_eq!(found, [0, 1], "{name}");
    }
}

#[test]
fn an_event_at_the_end_of_a_run_is_reported_once() {
    methods!(at_the_end::<f64>, f64);
    methods!(at_the_end::<f32>, f32);
}
