//! The checks: each proves one law of a declaration or says how it is broken.

mod brackets;
mod choice;
mod constraints;
mod declared;
mod evidence;
mod kinematics;
mod regularity;
mod structure_equations;

pub use brackets::structure_functions;
pub use choice::{Chosen, choose_formulation};
pub use constraints::linear_constraints;
pub use declared::declared_expressions;
pub use kinematics::{Motion, kinematics};
pub use regularity::{reduced_regularity, saddle_regularity};
pub use structure_equations::structure_equations;
