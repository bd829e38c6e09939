//! Everything that a model and its simulation name: `use nh_runtime::prelude::*;`.

pub use crate::{
    AlmostPoisson, Bs23, Constrained, Dop853, Dopri5, Dynamics, Energy, Euler, Fast, Heun, ImplicitMidpoint,
    IntegrationError, Integrator, Jacobian, Lanes, Observed, ParameterError, Projected, Ralston, Real, Rk4,
    Scalar, State, Statistics, Tsit5, Vern9,
};
pub use crate::{Reconstructed, Reconstruction, Reduction};

#[cfg(feature = "macros")]
pub use nh_macros::{morphism, nonholonomic};
