//! Symbolic geometry and mechanics of nonholonomic Lagrangian systems on Lie algebroids.
//!
//! The engine behind `#[nonholonomic]`: it knows expressions, anchors, brackets and constraint
//! distributions, and nothing of tokens. Formulas are cited by the tags
//! CLMM (Cortés, de León, Marrero, Martínez, *Nonholonomic Lagrangian systems on Lie algebroids*),
//! CNS (Cariñena, Nunes da Costa, Santos, *Quasi-coordinates from the point of view of Lie
//! algebroid structures*), CM (Crampin, Mestdag, *Reduction of invariant constrained systems using
//! anholonomic frames*) and M (Marrero, *Nonholonomic mechanics: a Lie algebroid perspective*).

pub mod algebra;
pub mod check;
pub mod choose;
pub mod compile;
pub mod count;
mod findings;
pub mod forms;
pub mod functions;
pub mod geometry;
pub mod id;
pub mod limits;
pub mod mechanics;
pub mod model;
pub mod phase_space;
pub mod program;
pub mod reduction;
pub mod report;
pub mod system;
pub mod units;
pub mod violation;
