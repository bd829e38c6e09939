//! A motion that comes to where its equations have no value: every method names the rate that has none, and where; and
//! motions of numbers below the normal ones.

use nonholonomic::prelude::*;
use nonholonomic::{IntegrationError, Method};

use crate::systems::{Contact, ContactState, every_adaptive, every_fixed, start};

/// A weight above a floor that pulls with the root of the height, and has no value below it.
#[nonholonomic(
    base { x, y, z }
    lagrangian { 1 / 2 * (der(x)^2 + der(y)^2 + der(z)^2) - k * z^(3/2) }
    constraints { roll: der(x) = -b * y * der(y); }
    formulation { projected }
    conserved { total = 1 / 2 * (der(x)^2 + der(y)^2 + der(z)^2) + k * z^(3/2); }
    assume { k > 0; }
    emit { discrete_gradient, invariants, taylor, jacobian, leapfrog }
)]
#[derive(Clone, Copy, Debug)]
struct Falling<T> {
    k: T,
    b: T,
}

fn names_the_rate<T: Real>(name: &str, method: impl Method<Falling<T>>) {
    let c = T::from_f64;
    let state = FallingState { y: c(0.5), z: c(0.025), z_dot: -T::ONE, ..FallingState::default() };
    let mut sim = Integrator::new(Falling { k: T::ONE, b: T::ONE }, method, T::ZERO, state);
    let Err(error) = sim.advance_to(T::ONE) else { panic!("{name}: below the floor at {:?}", sim.state()) };
    match error {
        IntegrationError::NonFiniteDerivative { component, time, .. } => {
            assert_eq!(component, "z_dot", "{name}: {error}");
            assert!((0.02..=0.1).contains(&time), "{name}: {error}");
        }
        // an energy that has no value stops the method that keeps it
        IntegrationError::NonFiniteEnergy { .. } if name.starts_with("DiscreteGradient") => {}
        // what grows without bound stops series before it is reached
        IntegrationError::StepUnderflow { .. } if name.starts_with("Taylor") => {}
        other => panic!("{name}: {other}"),
    }
}

#[test]
fn what_has_no_value_is_named() {
    every_fixed!(names_the_rate::<f64>, 0.05);
    every_adaptive!(names_the_rate::<f64>);
    every_fixed!(names_the_rate::<f32>, 0.05);
    every_adaptive!(names_the_rate::<f32>);
}

/// The linear part of the contact oscillator far below the normal numbers: a few of the least numbers off.
fn moves_below_the_normal_numbers<T: Real>(name: &str, method: impl Method<Contact<T>> + Clone) {
    let end = |size: T| {
        let level = ContactState { x_dot: T::ZERO, ..start::<T>() };
        let state = ContactState::from_array(level.to_array().map(|x| x * size));
        let mut sim = Integrator::new(Contact { k: T::ONE, b: T::ZERO }, method.clone(), T::ZERO, state);
        sim.advance_to(T::ONE).unwrap_or_else(|error| panic!("{name} at {size:?}: {error}"));
        sim.state().to_array()
    };
    let size = T::MIN_POSITIVE * T::from_f64(1e-3);
    let plain = end(T::ONE);
    for (found, plain) in end(size).into_iter().zip(plain) {
        let expected = plain * size;
        // squares are 0 there, so that what keeps them keeps nothing: the method's own error is left
        let allowed =
            (T::MIN_POSITIVE * T::EPSILON) * T::from_f64(4096.0) + expected.abs() * T::from_f64(1e-7);
        assert!((found - expected).abs() <= allowed, "{name}: {found:?} {expected:?}");
    }
}

#[test]
fn numbers_below_the_normal_ones_move() {
    every_fixed!(moves_below_the_normal_numbers::<f64>, 0.05);
}
