//! Symbolic algebra: a hash-consed expression graph, its derivatives, and the one zero test.

mod accuracy;
mod assuming;
mod derivative;
mod display;
mod evaluate;
mod field;
mod graph;
mod linear_form;
mod linear_system;
mod matrix;
mod modular;
mod normal_form;
mod number;
mod product;
mod product_to_sum;
mod range;
mod substitute;
mod sum;
mod transcendental;
mod transplant;
mod zero_test;

pub use accuracy::Accuracy;
pub use derivative::Derivation;
pub use evaluate::Bounded;
pub use field::Residue;
pub use graph::{Function, Function2, Graph, Node};
pub use linear_form::{LinearForm, NotLinear};
pub use linear_system::Solution;
pub use matrix::{Echelon, Matrix, determinant_in_field};
pub use modular::{FieldPoint, NoValue};
pub use number::Rational;
pub use range::{Facts, Range};
pub use substitute::Substitution;
pub use transplant::Transplant;
pub use zero_test::{Verdict, Witness};
