//! Symbolic algebra: a hash-consed expression graph, its derivatives, and the one zero test.

mod derivative;
mod display;
mod graph;
mod number;
mod product;
mod substitute;
mod sum;
mod transcendental;

pub use derivative::Derivation;
pub use graph::{Function, Function2, Graph, Node};
pub use number::Rational;
pub use substitute::Substitution;
