//! The law over event finders.

use core::ops::ControlFlow;

use nonholonomic::prelude::*;
use nonholonomic::{Method, State};

use crate::problems::{Four, Kind, Problem};
use crate::record::told;
use crate::scaled::{Scaled, multiplied, two};
use crate::{Change, Part, Verdict, changes};

/// The events of a run with their times and states, in the units of the motion.
fn events<T: Real, M: Method<Scaled<Problem<T>>>>(
    kind: Kind,
    change: &Change,
    samples: u32,
    method: impl Fn(T, T) -> M,
) -> (Vec<u64>, String) {
    let problem = Problem::<T>::new(kind);
    let scaled = Scaled::new(problem, change);
    let (course, _) = problem.course();
    let (tau, units, other) = (scaled.time, scaled.units, scaled.other);
    let inner = move |x: &Four<T>| {
        let mut numbers = x.0;
        numbers.iter_mut().zip(units.0).for_each(|(x, unit)| *x = *x / unit);
        numbers
    };
    // a place, a product that touches zero, a time, and what is zero at the start
    let [a, b, ..] = course.start.0;
    let functions = move |t: T, x: &Four<T>, (): &()| {
        let [p, q, r, s] = inner(x);
        let time = t / tau;
        [q, p * s - q * r, time - T::from_f64(2.345), (p - a) + (q - b)].map(|value| value * other)
    };
    let watch = Events::new(functions).samples(samples);
    let start = multiplied(&course.start, &units);
    let mut sim = Integrator::new(scaled, method(tau, units.0[0]), course.from * tau, start).max_steps(4000);
    let mut numbers = Vec::new();
    let end = course.from + T::from_f64(5.0);
    let result = sim.advance_watching(end * tau, &watch, |event| {
        numbers.push(event.index as u64);
        numbers.push((event.time / tau).to_f64().to_bits());
        numbers.extend(inner(&event.state).map(|x| x.to_f64().to_bits()));
        // some are passed, others stop the run
        if numbers.len() > 60 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    let ending = match result {
        Ok(stop) => format!("{} events, stopped: {}", numbers.len() / 6, stop.is_some()),
        Err(error) => told(&error, tau.to_f64()),
    };
    if let Ok(Some(event)) = sim.advance_until(sim.time() + T::from_f64(3.0) * tau, &watch) {
        numbers.push(event.index as u64);
        numbers.push((event.time / tau).to_f64().to_bits());
    }
    numbers
        .extend(sim.state().to_array().iter().zip(units.0).map(|(x, unit)| (*x / unit).to_f64().to_bits()));
    numbers.push(sim.statistics().evaluations);
    (numbers, ending)
}

struct Trial {
    verdict: Verdict,
    changes: Vec<Change>,
    numbers: &'static str,
}

impl Trial {
    fn of<T: Real, M: Method<Scaled<Problem<T>>>>(
        &mut self,
        name: &str,
        apart: bool,
        method: impl Fn(T, T) -> M,
    ) {
        for kind in [Kind::Pendulum, Kind::Kepler, Kind::Rest] {
            for samples in [0, 3] {
                let plain = Change { part: Part::Time, time: 0, state: [0; 4], other: 0 };
                let expected = events(kind, &plain, samples, &method);
                for change in &self.changes {
                    if apart || change.part != Part::EachComponent {
                        let found = events(kind, change, samples, &method);
                        let told = || {
                            format!(
                                "{kind:?} {samples} 2^{} 2^{:?}: {} {}",
                                change.time, change.state, expected.1, found.1
                            )
                        };
                        let detail = (found != expected).then(told);
                        self.verdict.note(&format!("Events, {name}{}", self.numbers), change.part, detail);
                    }
                }
            }
        }
    }

    fn all<T: Real>(&mut self) {
        let w = T::from_f64;
        self.of::<T, _>("Dopri5", false, |_, unit| Dopri5::new().rtol(w(1e-5)).atol(w(1e-6) * unit));
        self.of::<T, _>("Vern9", true, |_, _| Vern9::new().rtol(w(1e-5)).atol(w(0.0)));
        self.of::<T, _>("Rk4", true, |tau, _| Rk4::new(w(0.1) * tau));
        self.of::<T, _>("Radau5", false, |_, unit| Radau5::new().rtol(w(1e-5)).atol(w(1e-6) * unit));
        self.of::<T, _>("Rodas5P", false, |_, unit| Rodas5P::new().rtol(w(1e-5)).atol(w(1e-6) * unit));
        self.of::<T, _>("ImplicitMidpoint", false, |tau, _| ImplicitMidpoint::new(w(0.1) * tau));
    }
}

#[test]
fn events_in_double_precision() {
    let mut trial = Trial { verdict: Verdict::default(), changes: changes(true), numbers: "" };
    trial.all::<f64>();
    trial.verdict.judge();
}

#[test]
fn events_in_single_precision() {
    let mut trial = Trial { verdict: Verdict::default(), changes: changes(false), numbers: " in f32" };
    trial.all::<f32>();
    trial.verdict.judge();
}

/// The impacts of a ball that keeps half of its speed, to where they accumulate: times and speeds of all.
fn bounces<T: Real, M: Method<Scaled<Problem<T>>>>(
    change: &Change,
    method: impl Fn(T, T) -> M,
) -> (Vec<u64>, String) {
    let problem = Problem::<T>::new(Kind::Stone);
    let scaled = Scaled::new(problem, change);
    let (course, _) = problem.course();
    let (tau, units, other) = (scaled.time, scaled.units, scaled.other);
    let floor = move |_: T, x: &Four<T>, (): &()| [x.0[0] / units.0[0] * other];
    let floor = Events::new(floor).directions([Direction::Falling]);
    let start = multiplied(&course.start, &units);
    let mut sim = Integrator::new(scaled, method(tau, units.0[0]), course.from * tau, start).max_steps(4000);
    let mut numbers = Vec::new();
    loop {
        match sim.advance_until(course.to * tau, &floor) {
            Ok(Some(impact)) if numbers.len() < 400 => {
                let Four([_, speed, c, d]) = impact.state;
                numbers.push((impact.time / tau).to_f64().to_bits());
                numbers.push((speed / units.0[1]).to_f64().to_bits());
                sim.reset(impact.time, Four([T::ZERO, -speed * T::from_f64(0.5), c, d]));
            }
            Ok(last) => return (numbers, format!("the end: {}", last.is_none())),
            Err(error) => return (numbers, told(&error, tau.to_f64())),
        }
    }
}

#[test]
fn impacts_that_accumulate() {
    let mut verdict = Verdict::default();
    macro_rules! each {
        ($($name:literal $method:expr;)*) => {$(
            let plain = Change { part: Part::Time, time: 0, state: [0; 4], other: 0 };
            let expected = bounces::<f64, _>(&plain, $method);
            assert!(expected.0.len() > 40, "{} {}", expected.0.len(), expected.1);
            for change in changes(true) {
                if change.part != Part::EachComponent {
                    let found = bounces::<f64, _>(&change, $method);
                    let told = || format!("{} {} {} {}", expected.0.len(), expected.1, found.0.len(), found.1);
                    verdict.note(concat!("impacts, ", $name), change.part, (found != expected).then(told));
                }
            }
        )*};
    }
    each! {
        "Dopri5" |_, unit| Dopri5::new().rtol(1e-6).atol(1e-9 * unit);
        "Rk4" |tau, _| Rk4::new(0.1 * tau);
        "Radau5" |_, unit| Radau5::new().rtol(1e-6).atol(1e-9 * unit);
    }
    verdict.judge();
}

/// What a change of units does to the powers of two that the tests use is exact.
#[test]
fn units_are_exact() {
    for power in [-300, -101, 2, 300] {
        assert_eq!(1.1 * two::<f64>(power) / two::<f64>(power), 1.1);
    }
}
