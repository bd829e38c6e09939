//! What the API guidelines ask of public types: Debug, errors with their sources.

use core::error::Error;
use core::fmt::Debug;

use nonholonomic::methods::{
    Analytic, Arrival, Compensated, FiniteDifferences, Interruptible, Place, Start, Transition, Trial,
    Uniform,
};
use nonholonomic::prelude::*;
use nonholonomic::{DenseOutput, InputFault, ProjectionError, StateFault};

use crate::systems::{Driven, Plane};

#[test]
fn public_types_are_debug() {
    fn is_debug<T: Debug>() {}
    type Sim = Integrator<Driven, Dopri5<f64>>;
    is_debug::<Sim>();
    is_debug::<DenseOutput<'_, Driven, Dopri5<f64>>>();
    is_debug::<Start<'_, Driven>>();
    is_debug::<Arrival<Driven>>();
    is_debug::<Place<Driven>>();
    is_debug::<Trial<Driven>>();
    is_debug::<Transition<Plane<f64>, f64, 2, 0>>();
    is_debug::<(Analytic, FiniteDifferences, Uniform<f64>)>();
    is_debug::<Interruptible<Rk4<f64>, fn(&Statistics) -> bool>>();
    is_debug::<Compensated<nonholonomic::methods::Kutta4, f64>>();
    is_debug::<nonholonomic::sensitivity::Stacked<f64, 2, 1>>();
    is_debug::<(Taylor<f64>, Radau5<f64>, Rodas5P<f64>, GaussLegendre6<f64>, Conserving<Rk4<f64>>)>();
}

#[test]
fn faults_are_errors_and_sources() {
    let state = StateFault { identity: "c^2 + s^2 = 1", residual: 0.5 };
    let input = InputFault { input: "torque", value: f64::INFINITY };
    let projection = ProjectionError { iterations: 3, residual: 0.5 };
    let told = [
        (IntegrationError::InvalidState(state), state.to_string()),
        (IntegrationError::Input(input), input.to_string()),
        (IntegrationError::Projection { time: 1.0, error: projection }, projection.to_string()),
    ];
    for (error, expected) in told {
        assert_eq!(error.source().map(ToString::to_string), Some(expected));
    }
    assert_eq!(
        state.to_string(),
        "the given state does not satisfy `c^2 + s^2 = 1`, by 0.5: normalize it first"
    );
}
