//! Starts: a method that keeps a state on the constraints does not move one there without a word.

use nonholonomic::Method;
use nonholonomic::prelude::*;

use crate::systems::{Contact, ContactState, contact, every_adaptive, every_fixed, start};

/// A start that is off by the tolerance times `factor`, in a velocity that the constraint determines.
fn off<T: Real>(tolerance: T, factor: f64) -> ContactState<T> {
    let on = start::<T>();
    ContactState { x_dot: on.x_dot + tolerance * T::from_f64(factor), ..on }
}

fn law<T: Real>(name: &str, method: impl Method<Contact<T>> + Clone, tolerance: T) {
    let run = |state, every| {
        let mut sim = Integrator::new(contact(), Projected::new(method.clone(), every), T::ZERO, state);
        let result = sim.advance_to(T::from_f64(0.05));
        let singly = {
            let mut sim = Integrator::new(contact(), Projected::new(method.clone(), every), T::ZERO, state);
            sim.step().and_then(|()| sim.step()).map(|()| *sim.state())
        };
        assert_eq!(result.is_ok(), singly.is_ok(), "{name}: {result:?} {singly:?}");
        result.map(|()| *sim.state()).inspect_err(|_| {
            assert_eq!((*sim.state(), sim.time(), sim.statistics()), (state, T::ZERO, Statistics::default()));
        })
    };
    for every in [1, 100] {
        // up to a million times as far away as the state is large
        let far = (0..=6).map(|decade| 2.0 * 10.0_f64.powi(decade) / tolerance.to_f64());
        for factor in [-10.0, 10.0].into_iter().chain(far) {
            let refused = run(off(tolerance, factor), every);
            assert!(
                matches!(refused, Err(IntegrationError::InconsistentStart { constraint: 0, name: "roll", residual, correction, .. })
                    if residual > 0.0 && correction > tolerance.to_f64()),
                "{name}, {factor}: {refused:?}"
            );
        }
        for factor in [0.0, 0.2, -0.2] {
            run(off(tolerance, factor), every).unwrap_or_else(|error| panic!("{name}, {factor}: {error}"));
        }
        // the way out
        let mut state = off(T::ONE, 2.0);
        contact().project(T::ZERO, &mut state).unwrap();
        run(state, every).unwrap_or_else(|error| panic!("{name}: {error}"));
    }
    // from a new start again, and not after a change of the input
    let mut sim = Integrator::new(contact(), Projected::new(method, 1), T::ZERO, start());
    sim.step().unwrap();
    sim.set_input(());
    sim.step().unwrap();
    sim.reset(T::ZERO, off(T::ONE, 1.0));
    assert!(matches!(sim.step(), Err(IntegrationError::InconsistentStart { .. })), "{name}");
    sim.reset(T::ZERO, start());
    sim.step().unwrap();
}

#[test]
fn a_start_off_the_constraints_is_refused() {
    // of fixed steps, √ε of the largest component, which is 1
    every_fixed!(|name, method| law::<f64>(name, method, f64::EPSILON.sqrt()), 0.01);
    every_fixed!(|name, method| law::<f32>(name, method, f32::EPSILON.sqrt()), 0.01_f32);
    // atol + rtol |x|
    every_adaptive!(|name, method| law::<f64>(name, method, 1.3e-6));
    every_adaptive!(|name, method| law::<f32>(name, method, 1.3e-4));
    let each = ContactState { x: 1e-3, y: 1e-3, z: 1e-3, x_dot: 1e-2, y_dot: 1e-2, z_dot: 1e-2 };
    law("tolerances", Dopri5::new().tolerances(each, each), 1.3e-2);
    law("tolerances", Taylor::new().tolerances(each, each), 1.3e-2);
    let told = |name| {
        let (component, residual, correction) = ("x_dot", 3.0, 2.0);
        IntegrationError::InconsistentStart { constraint: 0, name, residual, component, correction }
            .to_string()
    };
    assert_eq!(
        told("roll"),
        "the given state leaves a residual of 3.0 in the constraint `roll`, and a return to the constraints would \
         move `x_dot` by 2.0: give a state that satisfies them, or `project` it first"
    );
    assert!(told("").starts_with("the given state leaves a residual of 3.0 in constraint 0, and a return"));
}
