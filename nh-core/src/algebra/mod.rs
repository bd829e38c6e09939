//! Symbolic algebra: a hash-consed expression graph, its derivatives, and the one zero test.

mod derivative;
mod display;
mod evaluate;
mod field;
mod graph;
mod modular;
mod number;
mod product;
mod substitute;
mod sum;
mod transcendental;
mod zero_test;

pub use derivative::Derivation;
pub use evaluate::Bounded;
pub use field::Residue;
pub use graph::{Function, Function2, Graph, Node};
pub use modular::{FieldPoint, NoValue};
pub use number::Rational;
pub use substitute::Substitution;
pub use zero_test::{Verdict, Witness};
