//! Functions that leave zero: wherever a run from there ends, however near, they have no event, and those that come back
//! have one.

use nonholonomic::prelude::*;
use nonholonomic::{D, Method};

use crate::systems::every_kind;

/// A particle on a line with a constant acceleration.
#[derive(Clone, Copy)]
struct Thrown<T> {
    acceleration: T,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Flight<T> {
    place: T,
    speed: T,
}

impl<T: Real> State for Flight<T> {
    type Scalar = T;
    type Dim = D<2>;
    fn to_array(&self) -> [T; 2] {
        [self.place, self.speed]
    }
    fn from_array([place, speed]: [T; 2]) -> Self {
        Self { place, speed }
    }
    fn names() -> [&'static str; 2] {
        ["place", "speed"]
    }
}

impl<T: Real> Dynamics for Thrown<T> {
    type State = Flight<T>;
    type Input = ();
    fn derivative(&self, _t: T, x: &Flight<T>, (): &()) -> Flight<T> {
        Flight { place: x.speed, speed: self.acceleration }
    }
}

/// Calls a law with methods of every kind.
macro_rules! methods {
    ($law:expr, $number:ty) => {
        every_kind!($law, <$number as Scalar>::from_f64(0.02))
    };
}

/// Runs that start where a function is zero, moving or at rest, and end within a few roundings of the start's time or of
/// its place, or far away.
fn leaves<T: Real>(name: &str, method: impl Method<Thrown<T>> + Clone) {
    let c = T::from_f64;
    let motions = [(1.0, 0.0), (-1.0, 0.0), (3.1, -9.8), (0.0, 1.0), (0.0, -0.3), (1e-9, 1.0)];
    for (clock, level) in [(0.0, 1.0), (0.0, -0.3), (1.0, 0.0), (1.0, 10.0), (-0.3, 1.0), (100.0, -0.3)] {
        for (speed, acceleration) in motions {
            let unit = T::EPSILON * if clock == 0.0 { c(1e-20) } else { c(clock).abs() };
            let lengths = [1.0, 2.0, 3.0, 5.0, 17.0, 1e3, 1e6].map(|units| c(units) * unit);
            for length in lengths.into_iter().chain([0.01, 0.1, 0.5].map(c)) {
                for length in [length, -length] {
                    let (clock, level) = (c(clock), c(level));
                    let thrown = Thrown { acceleration: c(acceleration) };
                    let start = Flight { place: level, speed: c(speed) };
                    // the slow one turns at once in one of the directions
                    if clock + length == clock || speed * acceleration * length.to_f64() < 0.0 {
                        continue;
                    }
                    let both = Events::new(|_, x: &Flight<T>, (): &()| [x.place - level, level - x.place]);
                    let mut sim = Integrator::new(thrown, method.clone(), clock, start);
                    let found = sim.advance_until(clock + length, &both);
                    let case =
                        format!("{name}, {speed} {acceleration} from {level:?} at {clock:?} by {length:?}");
                    if !matches!(found, Err(IntegrationError::UnresolvedStep { .. })) {
                        assert_eq!(found, Ok(None), "{case}");
                        assert_eq!(sim.time(), clock + length, "{case}");
                    }
                }
            }
        }
    }
}

#[test]
fn what_leaves_zero_has_no_event_however_near_the_run_ends() {
    methods!(leaves::<f64>, f64);
    methods!(leaves::<f32>, f32);
}

/// A throw from a level comes back to it once, on whatever leg of the run.
fn comes_back<T: Real>(name: &str, method: impl Method<Thrown<T>> + Clone) {
    let c = T::from_f64;
    for level in [0.0, 1.0, -7.3] {
        for first in [0.0, 1e-20, 1e-12, 1e-6, 1e-3, 0.3] {
            let level = c(level);
            let start = Flight { place: level, speed: c(2.0) };
            let mut sim = Integrator::new(Thrown { acceleration: c(-8.0) }, method.clone(), T::ZERO, start);
            let floor = Events::new(|_, x: &Flight<T>, (): &()| [x.place - level]);
            let mut times = Vec::new();
            for target in [c(first), c(0.4), T::ONE] {
                while let Some(event) = sim.advance_until(target, &floor).unwrap() {
                    assert_eq!(event.direction, Direction::Falling, "{name}, {level:?}, {first}: {event:?}");
                    times.push(event.time.to_f64());
                }
            }
            let is_back = times.len() == 1 && (times[0] - 0.5).abs() < 100.0 * T::DEFAULT_TOLERANCE.to_f64();
            assert!(is_back, "{name}, {level:?}, {first}: {times:?}");
        }
    }
}

#[test]
fn what_comes_back_to_zero_has_one_event_however_short_the_first_leg_was() {
    methods!(comes_back::<f64>, f64);
    methods!(comes_back::<f32>, f32);
}

/// Marks along a way that begins far away, or late: functions that bend between them have one event at each, in turn.
fn passes_marks<T: Real>(name: &str, method: impl Method<Thrown<T>> + Clone) {
    let c = T::from_f64;
    let between = |way: T| (way - T::ONE) * (way - c(1.5)) * (way - c(3.0));
    let resolved = [1.0, 1e3, 1e6, 1e9].into_iter().filter(|far| far * T::EPSILON.to_f64() < 1e-3);
    for (origin, late) in resolved.flat_map(|far| [(far, 0.0), (-far, 0.0), (0.0, far), (0.0, -far)]) {
        let (origin, late) = (c(origin), c(late));
        let start = Flight { place: origin, speed: T::ONE };
        let mut sim = Integrator::new(Thrown { acceleration: T::ZERO }, method.clone(), late, start);
        let marks = Events::new(|t, x: &Flight<T>, (): &()| [between(x.place - origin), between(t - late)])
            .samples(16);
        let mut times = [const { Vec::new() }; 2];
        while let Some(event) = sim.advance_until(late + c(4.0), &marks).unwrap() {
            let rises = times[event.index].len() % 2 == 0;
            let expected = if rises { Direction::Rising } else { Direction::Falling };
            assert_eq!(event.direction, expected, "{name}, {origin:?}, {late:?}: {event:?}");
            times[event.index].push((event.time - late).to_f64());
        }
        for times in times {
            let is_near = |(time, mark): (&f64, f64)| (time - mark).abs() < 0.05;
            let are_all = times.len() == 3 && times.iter().zip([1.0, 1.5, 3.0]).all(is_near);
            assert!(are_all, "{name}, {origin:?}, {late:?}: {times:?}");
        }
    }
}

#[test]
fn marks_near_one_another_are_passed_once_however_far_away_or_late() {
    methods!(passes_marks::<f64>, f64);
    methods!(passes_marks::<f32>, f32);
}
