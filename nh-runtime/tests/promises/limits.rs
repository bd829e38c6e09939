//! A limit to the steps holds for whatever takes steps.

use core::ops::ControlFlow;

use nonholonomic::Method;
use nonholonomic::prelude::*;

use crate::systems::{Contact, ContactState, contact, every_adaptive, every_fixed, start};

/// Refused after exactly five steps, all of which are kept.
fn obeys<T: Real, M: Method<Contact<T>>>(
    name: &str,
    sim: &mut Integrator<Contact<T>, M>,
    run: impl FnOnce(&mut Integrator<Contact<T>, M>) -> Result<(), IntegrationError>,
) {
    let before = sim.statistics().steps;
    let from = sim.time();
    let refused = run(sim);
    assert!(matches!(refused, Err(IntegrationError::TooManySteps { limit: 5, .. })), "{name}: {refused:?}");
    assert_eq!(sim.statistics().steps, before + 5, "{name}");
    assert!(sim.time() > from, "{name}");
}

fn law<T: Real>(name: &str, method: impl Method<Contact<T>>) {
    let far = T::from_f64(1e4);
    let watched = || Events::new(|_, x: &ContactState<T>, (): &()| [x.y, x.z]);
    let mut sim = Integrator::new(contact(), method, T::ZERO, start()).max_steps(5);
    obeys(name, &mut sim, |sim| sim.advance_to(far));
    obeys(name, &mut sim, |sim| sim.sample([far], |_, _| {}));
    obeys(name, &mut sim, |sim| {
        let soon = sim.time();
        sim.sample([soon, far], |_, _| {})
    });
    obeys(name, &mut sim, |sim| {
        sim.advance_watching(far, &watched(), |_| ControlFlow::Continue(())).map(|_| ())
    });
    obeys(name, &mut sim, |sim| {
        let nowhere = Events::new(|_, _: &ContactState<T>, (): &()| [T::ONE]);
        sim.advance_until(far, &nowhere).map(|_| ())
    });
    obeys(name, &mut sim, |sim| sim.advance_through([far, far + far], |_| {}));
    // the steps of all stops count
    let stops = 40_u32;
    obeys(name, &mut sim, |sim| {
        let from = sim.time();
        let each = T::from_f64(0.01);
        sim.advance_through((1..=stops).map(|i| from + T::from_u32(i) * each), |_| {})
    });
    // none is permitted
    let mut sim = sim.max_steps(0);
    let (time, steps) = (sim.time(), sim.statistics().steps);
    for refused in [sim.step_towards(far), sim.advance_to(far), sim.sample([far], |_, _| {})] {
        assert!(
            matches!(refused, Err(IntegrationError::TooManySteps { limit: 0, .. })),
            "{name}: {refused:?}"
        );
    }
    assert_eq!((sim.time(), sim.statistics().steps), (time, steps), "{name}");
}

#[test]
fn no_run_takes_more_steps_than_permitted() {
    every_fixed!(law, 0.01);
    every_adaptive!(law::<f64>);
    every_fixed!(law, 0.01_f32);
    every_adaptive!(law::<f32>);
}
