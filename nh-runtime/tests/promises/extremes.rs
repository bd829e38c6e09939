//! States near the ends of the range of the numbers: the same motion, or a refusal.

use nonholonomic::Method;
use nonholonomic::prelude::*;

use crate::systems::{Contact, ContactState, start};

/// The contact oscillator whose lengths are in another unit: the motion is the same.
fn scaled<T: Real>(size: T) -> (Contact<T>, ContactState<T>) {
    let unit = start::<T>();
    let state = ContactState::from_array(unit.to_array().map(|x| x * size));
    (Contact { k: T::ONE, b: size.recip() }, state)
}

fn end<T: Real>(method: impl Method<Contact<T>>, size: T) -> Result<[f64; 6], IntegrationError> {
    let (system, state) = scaled(size);
    let mut sim = Integrator::new(system, method, T::ZERO, state);
    sim.advance_to(T::from_u32(2))?;
    Ok(sim.state().to_array().map(|x| (x / size).to_f64()))
}

/// Sizes whose squares are in the range of the numbers, at its lower end, and out of it.
fn law<T: Real>(name: &str, method: impl Method<Contact<T>> + Clone) {
    let exact = end(method.clone(), T::ONE).unwrap();
    let edge = T::MIN_POSITIVE.sqrt();
    let c = T::from_f64;
    for (size, may_refuse) in [
        (edge * c(1024.0) / T::EPSILON, false),
        (edge * c(16.0), false),
        (edge, false),
        (edge * c(0.01), false),
        (edge * edge.sqrt(), false),
        (edge.recip() * c(1.0 / 16.0), false),
        (edge.recip() * c(16.0), true),
    ] {
        match end(method.clone(), size) {
            Ok(found) => {
                let off = found.iter().zip(&exact).fold(0.0, |most, (a, b)| Scalar::max(most, (a - b).abs()));
                // iterations end elsewhere in round-off
                assert!(off < 1e4 * T::EPSILON.to_f64(), "{name} at {size:?}: {off:e}");
            }
            Err(error) => {
                let is_typed = matches!(error, IntegrationError::NonFiniteEnergy { .. });
                assert!(may_refuse && is_typed, "{name} at {size:?}: {error}");
            }
        }
    }
    // at rest where nothing has a size
    let (system, _) = scaled(T::ONE);
    let mut sim = Integrator::new(system, method, T::ZERO, ContactState::default());
    sim.advance_to(T::ONE).unwrap();
    assert_eq!(*sim.state(), ContactState::default(), "{name}");
}

#[test]
fn discrete_gradients_at_the_ends_of_the_range() {
    law("DiscreteGradient", DiscreteGradient::<f64>::new(0.05));
    law("with Jacobian", DiscreteGradient::<f64>::new(0.05).with_jacobian());
    law("compensated", DiscreteGradient::<f64>::new(0.05).compensated());
    law("order 4", DiscreteGradient::<f64>::new(0.1).fourth_order());
    law("order 6", DiscreteGradient::<f64>::new(0.1).sixth_order());
    law("DiscreteGradient", DiscreteGradient::<f32>::new(0.05));
    law("with Jacobian", DiscreteGradient::<f32>::new(0.05).with_jacobian());
    law("order 4", DiscreteGradient::<f32>::new(0.1).fourth_order());
    assert_eq!(
        IntegrationError::NonFiniteEnergy { time: 0.5, value: f64::INFINITY }.to_string(),
        "the energy is inf at t = 0.5, so that no step can keep it: look at the state and the parameters, or \
         measure in units that keep squares within the range of the numbers"
    );
}
