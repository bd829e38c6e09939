//! Time: where a run starts on the clock does not matter, it ends where it was asked to, and what time cannot
//! resolve is refused.

use nonholonomic::Method;
use nonholonomic::prelude::*;

use crate::systems::{Contact, ContactState, contact, distance, every_adaptive, every_fixed, start};

/// A run of length `length` from t₀: its end, and the steps.
fn run<T: Real, M: Method<Contact<T>>>(
    method: M,
    t0: T,
    length: T,
) -> Result<(Integrator<Contact<T>, M>, u64), IntegrationError> {
    let mut sim = Integrator::new(contact(), method, t0, start());
    sim.advance_to(t0 + length)?;
    let steps = sim.statistics().steps;
    Ok((sim, steps))
}

/// The system does not depend on time, so that only the rounding of times tells two clocks apart.
fn clocks<T: Real, M: Method<Contact<T>> + Clone>(name: &str, method: M) {
    let ulp = |t: T| T::EPSILON.to_f64() * t.abs().to_f64();
    for length in [0.125, -0.125, 1.0] {
        let length = T::from_f64(length);
        let (reference, _) = run(method.clone(), T::ZERO, length).unwrap();
        for exponent in [0, 4, 8, 12, 16, 20, 30, 40, 50] {
            for sign in [1.0, -1.0] {
                let t0 = T::from_f64(sign * 2.0_f64.powi(exponent));
                if (t0 + length) - t0 != length {
                    continue;
                }
                match run(method.clone(), t0, length) {
                    Ok((sim, _)) => {
                        assert_eq!(sim.time(), t0 + length);
                        // speeds are of the order of one; a method chooses its steps anew on another clock
                        let permitted = 40.0 * T::DEFAULT_TOLERANCE.to_f64() + 20.0 * ulp(t0);
                        let off = distance(sim.state(), reference.state());
                        assert!(off < permitted, "{name} from {t0:?} by {length:?}: {off:e}");
                    }
                    Err(IntegrationError::UnresolvedStep { time, step, resolution }) => {
                        assert!(resolution > step && ulp(T::from_f64(time)) >= resolution, "{name}");
                    }
                    Err(IntegrationError::StepUnderflow { step, .. }) => {
                        assert!(step.abs() < 10.0 * ulp(t0), "{name} from {t0:?}");
                    }
                    Err(other) => panic!("{name} from {t0:?} by {length:?}: {other}"),
                }
            }
        }
    }
}

#[test]
fn where_the_clock_stands_does_not_matter() {
    every_fixed!(clocks, 0.01);
    every_adaptive!(clocks::<f64, _>);
    every_fixed!(clocks, 0.01_f32);
    every_adaptive!(clocks::<f32, _>);
}

/// A step of fixed length that time has no room for is refused, and nothing has happened.
fn unresolved<T: Real>(name: &str, method: impl Method<Contact<T>>) {
    let t0 = T::from_f64(0.01) / T::EPSILON * T::from_f64(16.0);
    let mut sim = Integrator::new(contact(), method, t0, start());
    for refused in
        [sim.step(), sim.advance_to(t0 + t0), sim.step_towards(T::ZERO), sim.sample([t0 + t0], |_, _| {})]
    {
        assert!(matches!(refused, Err(IntegrationError::UnresolvedStep { .. })), "{name}: {refused:?}");
    }
    assert_eq!((sim.time(), sim.statistics().steps), (t0, 0), "{name}");
    assert_eq!(*sim.state(), start());
}

#[test]
fn steps_below_the_resolution_of_time_are_refused() {
    every_fixed!(unresolved, 0.01);
    every_fixed!(unresolved, 0.01_f32);
    // nor are longer steps taken than permitted
    unresolved("Bs23", Bs23::<f32>::new().max_step(0.01));
    unresolved("Dopri5", Dopri5::<f64>::new().max_step(0.01));
    unresolved("Tsit5", Tsit5::<f64>::new().max_step(0.01));
    unresolved("Dop853", Dop853::<f32>::new().max_step(0.01));
    unresolved("Vern9", Vern9::<f64>::new().max_step(0.01));
    unresolved("Taylor", Taylor::<f64>::new().max_step(0.01));
    unresolved("Radau5", Radau5::<f64>::new().max_step(0.01));
    unresolved("Rodas5P", Rodas5P::<f32>::new().max_step(0.01));
    assert_eq!(
        Integrator::new(contact(), Rk4::new(1e-3), 1e15, start()).step().unwrap_err().to_string(),
        "a step of length 0.001 is lost at t = 1000000000000000.0, where time is resolved to 2.2e-1: take \
         longer steps, or count time from an origin nearer by"
    );
}

/// The steps of fixed length: whole ones, and a shorter last one where the target asks for it.
fn counted<T: Real>(name: &str, method: impl Method<Contact<T>> + Clone) {
    for (target, steps) in [(1.0, 100), (0.125, 13), (0.013, 2), (0.5, 50), (10.0, 1000), (0.004, 1)] {
        for sign in [1.0, -1.0] {
            let (sim, taken) = run(method.clone(), T::ZERO, T::from_f64(sign * target)).unwrap();
            assert_eq!((taken, sim.time()), (steps, T::from_f64(sign * target)), "{name}");
        }
    }
}

#[test]
fn fixed_steps_are_whole_but_for_the_last() {
    every_fixed!(counted, 0.01);
    every_fixed!(counted, 0.01_f32);
}

/// Many short legs are as long as one.
fn legs<T: Real>(name: &str, method: impl Method<Contact<T>> + Clone) {
    for t0 in [0.0, 1e3] {
        let t0 = T::from_f64(t0);
        let (whole, _) = run(method.clone(), t0, T::ONE).unwrap();
        let mut sim = Integrator::new(contact(), method.clone(), t0, start());
        for i in 1..=256_u32 {
            sim.advance_to(t0 + T::from_u32(i) / T::from_u32(256)).unwrap();
        }
        assert_eq!(sim.time(), t0 + T::ONE);
        let off = distance(sim.state(), whole.state());
        assert!(off < 0.02, "{name} from {t0:?}: {off:e}");
        // time steps of the same length, but for round-off in the clock
        let unit = T::EPSILON.to_f64() * 1e3;
        let mut sim = Integrator::new(contact(), method.clone(), t0, start());
        for i in 1..=100_u32 {
            sim.advance_to(t0 + T::from_u32(i) / T::from_u32(100)).unwrap();
        }
        let off = distance(sim.state(), whole.state());
        assert!(off < 200.0 * unit + 1e3 * T::DEFAULT_TOLERANCE.to_f64(), "{name} from {t0:?}: {off:e}");
    }
}

#[test]
fn many_legs_are_as_long_as_one() {
    every_fixed!(legs, 0.01);
    every_adaptive!(legs::<f64>);
    every_fixed!(legs, 0.01_f32);
    every_adaptive!(legs::<f32>);
}

/// A run that stops at ticks between its steps errs no more than one that does not: what a step leaves behind does not add
/// up where the next one has another length.
fn ticks(name: &str, method: impl Method<Contact<f64>> + Clone, exact: &ContactState<f64>, h: f64) {
    let (whole, _) = run(method.clone(), 0.0, 2.0).unwrap();
    let permitted = 1.5 * distance(whole.state(), exact) + 1e-10;
    for share in [1.5, 3.5, 0.75, 2.25] {
        let count = (2.0 / (share * h)).round();
        let mut sim = Integrator::new(contact(), method.clone(), 0.0, start());
        let mut tick = 0.0;
        while tick < count {
            tick += 1.0;
            sim.set_input(());
            sim.advance_to(2.0 * tick / count).unwrap();
        }
        let off = distance(sim.state(), exact);
        assert!(off <= permitted, "{name}, ticks of {share} steps: {off:e}, {permitted:e}");
    }
}

#[test]
fn ticks_between_steps_cost_no_order() {
    let (exact, _) = run(Dop853::new().rtol(1e-13).atol(1e-13), 0.0, 2.0).unwrap();
    let h = 2.5e-3;
    every_fixed!(|name, method| ticks(name, method, exact.state(), h), h);
}

/// The smallest times that there are, forwards and backwards.
fn tiny<T: Real>(name: &str, method: impl Method<Contact<T>> + Clone) {
    let mut target = T::MIN_POSITIVE * T::EPSILON;
    while target < T::from_f64(1e-20) {
        for target in [target, -target] {
            let mut sim = Integrator::new(contact(), method.clone(), T::ZERO, start());
            let reached = sim.advance_to(target);
            assert_eq!(reached, Ok(()), "{name} to {target:?}");
            assert_eq!(sim.time(), target);
            assert!(distance(sim.state(), &start()) < 1e-6, "{name} to {target:?}: {:?}", sim.state());
            // and on from there
            assert_eq!(sim.advance_to(T::from_f64(0.1)), Ok(()), "{name} by {target:?}");
            let (whole, _) = run(method.clone(), T::ZERO, T::from_f64(0.1)).unwrap();
            let off = distance(sim.state(), whole.state());
            assert!(off < 20.0 * T::DEFAULT_TOLERANCE.to_f64() + 2e-3, "{name} by {target:?}: {off:e}");
            assert!(sim.statistics().steps < 60, "{name} by {target:?}: {:?}", sim.statistics());
        }
        target *= T::from_f64(1e7);
    }
}

#[test]
fn the_smallest_times_are_reached() {
    every_fixed!(tiny, 0.01);
    every_adaptive!(tiny::<f64>);
    every_fixed!(tiny, 0.01_f32);
    every_adaptive!(tiny::<f32>);
}

fn hostile<T: Real>(name: &str, method: impl Method<Contact<T>>) {
    let mut sim = Integrator::new(contact(), method, T::ZERO, start()).max_steps(20);
    let huge = T::MIN_POSITIVE.recip();
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let bad = T::from_f64(bad);
        for refused in [sim.advance_to(bad), sim.step_towards(bad), sim.sample([bad], |_, _| {})] {
            assert!(matches!(refused, Err(IntegrationError::NonFiniteTime { .. })), "{name}: {refused:?}");
        }
    }
    for target in [T::ZERO, -T::ZERO] {
        assert_eq!((sim.advance_to(target), sim.step_towards(target)), (Ok(()), Ok(())), "{name}");
    }
    assert_eq!((*sim.state(), sim.statistics()), (start(), Statistics::default()), "{name}");
    for target in [huge, -huge] {
        let refused = sim.advance_to(target);
        assert!(matches!(refused, Err(IntegrationError::TooManySteps { .. })), "{name}: {refused:?}");
    }
}

#[test]
fn times_that_are_none_are_refused_and_far_ones_limited() {
    every_fixed!(hostile, 0.01);
    every_adaptive!(hostile::<f64>);
    every_fixed!(hostile, 0.01_f32);
    every_adaptive!(hostile::<f32>);
}

fn all_of_time<T: Real>(name: &str, method: impl Method<Contact<T>>) {
    // at rest, where steps grow as they like, over a time that is no number
    let end = T::MIN_POSITIVE.recip() * T::from_f64(3.5);
    let rest = ContactState::from_array([T::ZERO; 6]);
    let mut sim = Integrator::new(contact::<T>(), method, -end, rest).max_steps(2000);
    let ended = sim.advance_to(end);
    assert!(ended.is_ok() && sim.time() == end, "{name}: {ended:?} {}", sim.time().to_f64());
    assert!(sim.state().to_array().iter().all(|x| *x == T::ZERO), "{name}");
}

#[test]
fn runs_over_all_of_time_end() {
    every_adaptive!(all_of_time::<f64>);
    every_adaptive!(all_of_time::<f32>);
}
