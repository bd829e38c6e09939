//! Allocation-free integration of nonholonomic systems.
//!
//! A system is anything that implements [`Dynamics`]: the attribute macro `#[nonholonomic]` writes the
//! implementation from a declaration, and a few lines write it by hand. An [`Integrator`] carries
//! the state of such a system through time with one of the [`methods`].
//!
//! ```
//! use nh_runtime::prelude::*;
//! use nh_runtime::D;
//!
//! /// A mathematical pendulum of length `l` (m) in a field `g` (m/s²).
//! #[derive(Clone, Copy)]
//! struct Pendulum { g: f64, l: f64 }
//!
//! #[derive(Clone, Copy, Debug, PartialEq)]
//! struct PendulumState { theta: f64, omega: f64 }
//!
//! impl State for PendulumState {
//!     type Scalar = f64;
//!     type Dim = D<2>;
//!     fn to_array(&self) -> [f64; 2] { [self.theta, self.omega] }
//!     fn from_array([theta, omega]: [f64; 2]) -> Self { Self { theta, omega } }
//!     fn names() -> [&'static str; 2] { ["theta", "omega"] }
//! }
//!
//! impl Dynamics for Pendulum {
//!     type State = PendulumState;
//!     type Input = ();
//!     fn derivative(&self, _t: f64, x: &PendulumState, (): &()) -> PendulumState {
//!         PendulumState { theta: x.omega, omega: -self.g / self.l * x.theta.sin() }
//!     }
//! }
//!
//! # fn main() -> Result<(), IntegrationError> {
//! let start = PendulumState { theta: 1.0, omega: 0.0 };
//! let mut sim = Integrator::new(Pendulum { g: 9.81, l: 1.0 }, Dopri5::new().rtol(1e-10), 0.0, start);
//! sim.advance_to(2.0)?;
//! println!("{:?} at t = {}", sim.state(), sim.time());
//! # Ok(())
//! # }
//! ```
//!
//! # Features
//!
//! | feature | meaning |
//! |---|---|
//! | `std` (default) | elementary functions from the platform |
//! | `libm` | elementary functions from the `libm` crate, for targets without `std`; sine and cosine of `f32` in single precision alone, to 10⁻⁷ |
//! | `macros` (default) | re-exports `#[nonholonomic]` |
//! | `serde` | generated states can be serialized |
//!
//! The crate is `no_std` with or without them, allocates nothing, contains no `unsafe` and has no
//! code path that panics.
#![no_std]

#[cfg(any(feature = "std", test))]
extern crate std;

#[cfg(not(any(feature = "std", feature = "libm")))]
compile_error!(
    "nh-runtime needs a source of sin, sqrt and the other elementary functions: enable its feature \
     `std` on a target with an operating system, or `libm` on one without"
);

mod arrays;
mod dense;
mod dim;
mod dynamics;
mod elementary;
mod error;
mod integrator;
mod linear;
pub mod methods;
pub mod prelude;
mod projection;
mod scalar;
mod serde_impls;
#[cfg(any(test, not(feature = "std")))]
mod single_trig;
mod step_control;

pub use dim::{D, Dim};
pub use dynamics::{Constrained, DimOf, Dynamics, Energy, Jacobian, MatOf, Observed, ScalarOf, State, VecOf};
pub use error::{InputFault, IntegrationError, ParameterError, ParameterFault, ProjectionError, StateFault};
pub use integrator::{Integrator, Statistics};
pub use methods::{Dopri5, Euler, ImplicitMidpoint, Method, Projected, Rk4};
pub use scalar::{Real, Scalar};

#[cfg(feature = "macros")]
pub use nh_macros::nonholonomic;

/// What generated code names. Not part of the public interface: it may change in any release.
#[doc(hidden)]
pub mod __private {
    pub use crate::__nh_serde_impls as serde_impls;
    pub use crate::linear::solve_pivoted;
    pub use crate::projection::{check_identities, project};
    pub use crate::{
        Constrained, D, Dim, Dynamics, Energy, InputFault, Jacobian, Observed, ParameterError,
        ParameterFault, ProjectionError, Real, Scalar, ScalarOf, State, StateFault,
    };
    pub use core;
    pub use nalgebra;
    #[cfg(feature = "serde")]
    pub use serde;
}
