//! Limits hold for whatever takes steps: of steps, of evaluations, and those that the user asks about.

use core::ops::ControlFlow;

use nonholonomic::Method;
use nonholonomic::methods::Interruptible;
use nonholonomic::prelude::*;

use crate::systems::{Contact, ContactState, contact, every_adaptive, every_fixed, start};

/// Everything that takes steps, one call of each to a time that is out of reach.
fn every_run<T: Real, M: Method<Contact<T>>>(
    sim: &mut Integrator<Contact<T>, M>,
    mut check: impl FnMut(
        &mut Integrator<Contact<T>, M>,
        &dyn Fn(&mut Integrator<Contact<T>, M>) -> Result<(), IntegrationError>,
    ),
) {
    let far = T::from_f64(1e4);
    check(sim, &|sim| sim.advance_to(far));
    check(sim, &|sim| sim.sample([far], |_, _| {}));
    check(sim, &|sim| {
        let soon = sim.time();
        sim.sample([soon, far], |_, _| {})
    });
    check(sim, &|sim| {
        let watched = Events::new(|_, x: &ContactState<T>, (): &()| [x.y, x.z]);
        sim.advance_watching(far, &watched, |_| ControlFlow::Continue(())).map(|_| ())
    });
    check(sim, &|sim| {
        let nowhere = Events::new(|_, _: &ContactState<T>, (): &()| [T::ONE]);
        sim.advance_until(far, &nowhere).map(|_| ())
    });
    check(sim, &|sim| sim.advance_through([far, far + far], |_| {}));
    // what all stops spend counts
    check(sim, &|sim| {
        let (from, each) = (sim.time(), T::from_f64(0.01));
        sim.advance_through((1..=400).map(|i| from + T::from_u32(i) * each), |_| {})
    });
    check(sim, &|sim| {
        while sim.time() < far {
            sim.step_towards(far)?;
        }
        Ok(())
    });
}

fn of_steps<T: Real>(name: &str, method: impl Method<Contact<T>>) {
    let mut sim = Integrator::new(contact(), method, T::ZERO, start()).max_steps(5);
    let mut count = 0;
    every_run(&mut sim, |sim, run| {
        count += 1;
        if count == 8 {
            // single steps are calls of their own
            return;
        }
        let (from, before) = (sim.time(), sim.statistics().steps);
        let refused = run(sim);
        let is_so = matches!(refused, Err(IntegrationError::TooManySteps { limit: 5, .. }));
        assert!(is_so, "{name}, {count}: {refused:?}");
        // all of them are kept
        assert_eq!(sim.statistics().steps, before + 5, "{name}, {count}");
        assert!(sim.time() > from, "{name}, {count}");
    });
    // none is permitted
    let mut sim = sim.max_steps(0);
    every_run(&mut sim, |sim, run| {
        let (from, before) = (sim.time(), sim.statistics().steps);
        let refused = run(sim);
        let is_so = matches!(refused, Err(IntegrationError::TooManySteps { limit: 0, .. }));
        assert!(is_so, "{name}: {refused:?}");
        assert_eq!((sim.time(), sim.statistics().steps), (from, before), "{name}");
    });
}

/// Refused with the first step that begins beyond the limit.
fn of_evaluations<T: Real>(name: &str, method: impl Method<Contact<T>> + Clone) {
    let mut single = Integrator::new(contact(), method.clone(), T::ZERO, start());
    let mut most = 0;
    for _ in 0..40 {
        let before = single.statistics().evaluations;
        single.step().unwrap_or_else(|error| panic!("{name}: {error}"));
        most = most.max(single.statistics().evaluations - before);
    }
    let limit = 3 * most;
    let mut sim = Integrator::new(contact(), method, T::ZERO, start()).max_evaluations(limit);
    let mut count = 0;
    every_run(&mut sim, |sim, run| {
        count += 1;
        if count == 8 {
            return;
        }
        sim.reset(T::ZERO, start());
        let refused = run(sim);
        let told =
            matches!(refused, Err(IntegrationError::TooManyEvaluations { limit: told, .. }) if told == limit);
        assert!(told, "{name}, {count}: {refused:?}");
        let spent = sim.statistics().evaluations;
        assert!((limit..limit + 2 * most).contains(&spent), "{name}, {count}: {spent} for {limit}");
    });
}

/// Refused where the function says so, with the steps before, and again until it says otherwise.
fn asked<T: Real>(name: &str, method: impl Method<Contact<T>>) {
    let permitted = core::cell::Cell::new(0);
    let goes_on = |statistics: &Statistics| statistics.steps < permitted.get();
    let mut sim = Integrator::new(contact(), Interruptible::new(method, goes_on), T::ZERO, start());
    every_run(&mut sim, |sim, run| {
        permitted.set(sim.statistics().steps + 4);
        for _ in 0..2 {
            let refused = run(sim);
            assert!(matches!(refused, Err(IntegrationError::Interrupted { .. })), "{name}: {refused:?}");
            assert_eq!(sim.statistics().steps, permitted.get(), "{name}");
        }
    });
}

/// Asking changes no step.
fn asked_for_nothing<T: Real>(name: &str, method: impl Method<Contact<T>> + Clone) {
    let target = T::from_f64(0.375);
    let mut plain = Integrator::new(contact(), method.clone(), T::ZERO, start());
    let always = Interruptible::new(method, |_: &Statistics| true);
    let mut sim = Integrator::new(contact(), always, T::ZERO, start());
    plain.advance_to(target).unwrap_or_else(|error| panic!("{name}: {error}"));
    sim.advance_to(target).unwrap_or_else(|error| panic!("{name}: {error}"));
    assert_eq!((sim.state(), sim.statistics()), (plain.state(), plain.statistics()), "{name}");
}

#[test]
fn no_run_takes_more_steps_than_permitted() {
    every_fixed!(of_steps, 0.01);
    every_adaptive!(of_steps::<f64>);
    every_fixed!(of_steps, 0.01_f32);
    every_adaptive!(of_steps::<f32>);
}

#[test]
fn no_run_evaluates_more_often_than_permitted() {
    every_fixed!(of_evaluations, 0.01);
    every_adaptive!(of_evaluations::<f64>);
}

#[test]
fn every_run_can_be_interrupted() {
    every_fixed!(asked, 0.01);
    every_adaptive!(asked::<f64>);
    every_fixed!(asked_for_nothing, 0.01);
    every_adaptive!(asked_for_nothing::<f64>);
}

#[test]
fn limits_are_told() {
    let told = [
        IntegrationError::TooManyEvaluations { time: 0.5, target: 2.0, limit: 100 },
        IntegrationError::Interrupted { time: 0.5 },
    ];
    assert_eq!(
        told.map(|error| error.to_string()),
        [
            "100 evaluations of the derivative have led to t = 0.5 and not to 2.0: permit more with \
             `max_evaluations`, take a larger tolerance, or an implicit method if the system is stiff",
            "the run was interrupted at t = 0.5 by the function that `Interruptible` asks: call again to go on",
        ]
    );
}

/// No step is longer than permitted, but for a hundredth where it lands on a target.
fn of_length<T: Real>(name: &str, longest: f64, method: impl Method<Contact<T>> + Clone) {
    for distance in [1.0, 1.005, 1.01, 2.01, 2.5, 7.0] {
        for sign in [1.0, -1.0] {
            let target = T::from_f64(sign * distance * longest);
            let mut sim = Integrator::new(contact(), method.clone(), T::ZERO, start());
            while sim.time() != target {
                let before = sim.time();
                sim.step_towards(target).unwrap();
                let length = (sim.time() - before).to_f64().abs();
                let rounding = 2.0 * T::EPSILON.to_f64() * target.to_f64().abs();
                let most = if sim.time() == target { 1.01 * longest } else { longest };
                assert!(length <= most + rounding, "{name} to {target:?}: {length}");
            }
        }
    }
}

#[test]
fn steps_are_no_longer_than_permitted() {
    macro_rules! every {
        ($($method:expr),*) => {$(
            of_length(stringify!($method), 0.01, $method.first_step(0.01).max_step(0.01));
            of_length(stringify!($method), 0.01, $method.first_step(0.01_f32).max_step(0.01));
        )*};
    }
    every!(
        Bs23::new(),
        Dopri5::new(),
        Tsit5::new(),
        Dop853::new(),
        Vern9::new(),
        Radau5::new(),
        Rodas5P::new()
    );
    of_length("Taylor", 0.01, Taylor::<f64>::new().max_step(0.01));
    of_length("Taylor", 0.01, Taylor::<f32>::new().max_step(0.01));
}
