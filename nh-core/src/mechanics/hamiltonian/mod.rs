//! The Hamiltonian side of a constrained system: momenta, brackets, Hamilton's equations.

mod bracket;
mod legendre;

pub use bracket::NonholonomicBracket;
pub use legendre::{HamiltonianSide, NoInverse, hamiltonian_side};
