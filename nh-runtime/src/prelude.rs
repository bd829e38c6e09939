//! Everything that a model and its simulation name: `use nh_runtime::prelude::*;`.

pub use crate::{
    Constrained, Dopri5, Dynamics, Energy, Euler, Fast, ImplicitMidpoint, IntegrationError, Integrator,
    Jacobian, Observed, ParameterError, Projected, Real, Rk4, Scalar, State, Statistics,
};

#[cfg(feature = "macros")]
pub use nh_macros::nonholonomic;
