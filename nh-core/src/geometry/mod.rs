//! Lie algebroids and constraint distributions.

mod algebroid;
mod anchor;
pub mod choice;
mod distribution;
pub mod hamel;
mod known_algebra;
mod pivot;
mod structure;

pub use algebroid::Algebroid;
pub use anchor::Anchor;
pub use distribution::{ConstraintDistribution, LinearConstraints};
pub use known_algebra::{KnownAlgebra, KnownBracket};
pub use pivot::{PivotSetting, PivotZeros};
pub use structure::StructureFunctions;
