//! Lie algebroids and constraint distributions.

mod algebroid;
mod anchor;
mod change_of_basis;
mod clock;
mod connection;
mod distribution;
mod fibres;
pub mod hamel;
pub mod independent_velocities;
mod invariant_frame;
mod known_algebra;
mod level_set;
mod manifold;
mod momentum_level;
mod orbits;
mod pivot;
mod rank;
mod structure;
pub mod suggested_velocities;

pub use algebroid::Algebroid;
pub use anchor::Anchor;
pub use change_of_basis::ChangeOfBasis;
pub use clock::Clock;
pub use connection::{Christoffel, koszul};
pub use distribution::{ConstraintDistribution, LinearConstraints};
pub use fibres::Fibres;
pub use invariant_frame::InvariantFrame;
pub use known_algebra::{KnownAlgebra, KnownBracket};
pub use level_set::NearManifold;
pub use manifold::Manifold;
pub use momentum_level::MomentumLevel;
pub use orbits::{Change, Varies, constant_along};
pub use pivot::{PivotSetting, PivotZeros};
pub use rank::{Drops, Rank, RankSetting};
pub use structure::StructureFunctions;
