//! Lie algebroids and constraint distributions.

mod known_algebra;

pub use known_algebra::{KnownAlgebra, KnownBracket};
