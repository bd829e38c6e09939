//! Implicit methods, for stiff systems and for invariants.

mod collocation;
mod gauss;
mod linearization;
mod linearized;
mod midpoint;
pub(super) mod newton;
mod radau5;
mod rodas5p;
mod starting_values;

pub use gauss::{Gauss, GaussLegendre4, GaussLegendre6};
pub use linearization::{Analytic, FiniteDifferences, Linearization};
pub use midpoint::{ImplicitMidpoint, Midpoint};
pub use radau5::{Radau, Radau5};
pub use rodas5p::{Rodas, Rodas5P};
