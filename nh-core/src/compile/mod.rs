//! From a declaration to its proved functions: the stages, and the functions that are asked for.

mod adapted_functions;
mod analytic;
mod assembly;
mod cancellation;
mod competition;
mod connection_functions;
mod constraint_forces;
mod discrete;
mod embedded;
mod folded_constants;
mod gibbs_appell_function;
mod given;
mod gyroscopic;
mod kept_volume;
mod levels;
mod linearization;
mod momenta;
mod momentum_equation;
mod observed_brackets;
mod on_request;
mod phase_space_functions;
mod position_return;
mod power;
mod projected_functions;
mod proved;
mod proved_functions;
mod routh;
mod slice;
mod stages;
mod strangers;
mod velocities_of_state;
mod vertical_splitting;

pub(crate) use proved::{Derived, Proved};
pub(crate) use stages::prove;
pub use stages::{compile, compile_with};
pub(crate) use vertical_splitting::{Reduced, declared, frame_names, moved, with_translations};
