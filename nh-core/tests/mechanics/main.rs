//! Derivations checked as wholes: equations against hand-worked ones, and different forms of the
//! theory against each other.

mod adapted_frame;
mod builder;
mod derivation;
mod laws;
mod operation_counts;
mod phase_space;
mod planted_forms;
mod planted_programs;
mod requests;
mod systems;
mod velocity_forms;
