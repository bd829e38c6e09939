//! The Hamiltonian side of a constrained system: momenta, brackets, Hamilton's equations.

mod bracket;
mod drift;
mod legendre;

pub use bracket::NonholonomicBracket;
pub use drift::Drift;
pub use legendre::{HamiltonianSide, NoInverse, hamiltonian_side};
