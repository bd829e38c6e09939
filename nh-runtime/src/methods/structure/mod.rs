//! Methods that keep what the flow keeps.

mod blur;
mod composition;
mod conserving;
mod discrete_gradient;
mod leapfrog;
mod rattle;
mod suslov;
mod symmetric_projection;

pub use composition::{Composed, KahanLi6, Substeps, Suzuki4, Symmetric};
pub use conserving::Conserving;
pub use discrete_gradient::{DiscreteGradient, Gonzalez};
pub use leapfrog::{DriftKickDrift, ReflectedLeapfrog};
pub use rattle::{DiscreteAction, Rattle};
pub use suslov::{DiscreteMomentum, DiscreteSuslov};
pub use symmetric_projection::SymmetricProjection;
