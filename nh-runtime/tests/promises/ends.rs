//! Events at the very start and the very end of a run, and of the parts of one: each is told once, and none that lies outside.

use nonholonomic::Method;
use nonholonomic::prelude::*;

use crate::events::{Balls, Flight};
use crate::systems::every_kind;

/// The times of all events on a way through several targets.
fn told<T: Real>(
    method: impl Method<Balls<T>>,
    (begin, targets): (T, &[T]),
    function: impl Fn(T, &Flight<T>) -> T,
) -> Vec<T> {
    let start = Flight { height: [begin, T::ZERO], speed: [T::ONE, T::ZERO] };
    let mut sim = Integrator::new(Balls { g: T::ZERO }, method, begin, start);
    let events = Events::new(|t, x: &Flight<T>, (): &()| [function(t, x)]);
    let mut times = Vec::new();
    for target in targets {
        while let Some(event) = sim.advance_until(*target, &events).unwrap() {
            times.push(event.time);
            assert!(times.len() < 9);
        }
        assert!(sim.time() == *target);
    }
    times
}

fn at_the_ends<T: Real>(name: &str, method: impl Method<Balls<T>> + Clone) {
    let w = T::from_f64;
    let next = |t: T, by: f64| t + w(by) * T::EPSILON * t.abs().max(T::ONE);
    for (begin, middle, end) in
        [(0.0, 0.25, 0.5), (1.0, 1.3, 1.7), (-1.0, 0.0, 1.0), (1000.0, 1000.5, 1001.0)]
    {
        for back in [false, true] {
            let (begin, end) = if back { (end, begin) } else { (begin, end) };
            let (begin, middle, end) = (w(begin), w(middle), w(end));
            let ways: [&[T]; 3] = [&[end], &[middle, end], &[middle, end, end]];
            for way in ways {
                for (place, is_within) in [
                    (begin, false),
                    // what is nearer is at the start, as far as time and function are resolved
                    (next(begin, if back { -1024.0 } else { 1024.0 }), true),
                    (next(begin, if back { 1024.0 } else { -1024.0 }), false),
                    (next(middle, -2.0), true),
                    (middle, true),
                    (next(middle, 2.0), true),
                    (next(end, if back { 2.0 } else { -2.0 }), true),
                    (end, true),
                    (next(end, if back { -2.0 } else { 2.0 }), false),
                ] {
                    let times = told(method.clone(), (begin, way), |t, _| t - place);
                    let is_near =
                        |time: &T| (*time - place).abs() <= w(64.0) * T::EPSILON * place.abs().max(T::ONE);
                    assert!(
                        times.len() == usize::from(is_within) && times.iter().all(is_near),
                        "{name} from {begin:?} through {way:?}, at {place:?}: {times:?}"
                    );
                }
            }
        }
    }
}

#[test]
fn events_at_the_ends_are_told_once() {
    every_kind!(at_the_ends::<f64>, 0.1);
    every_kind!(at_the_ends::<f32>, 0.1_f32);
}
