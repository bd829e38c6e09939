//! The checks: each proves one law of a declaration or says how it is broken.

mod assumptions;
mod brackets;
mod choice;
mod claims;
mod conservative;
mod constraints;
mod declared;
mod dependence;
mod embedding;
pub(crate) mod evidence;
mod frame;
mod hamilton_jacobi;
mod kinematics;
mod orthonormal;
mod regularity;
mod sections;
mod structure_equations;
mod symmetries;
mod volume;

pub use assumptions::facts;
pub use brackets::structure_functions;
pub use choice::{Chosen, choose_formulation};
pub use claims::claims;
pub use conservative::{moving_constraint, not_conservative};
pub(crate) use constraints::name_of;
pub use constraints::{Constraints, constraints};
pub use declared::declared_expressions;
pub use embedding::embedding;
pub use frame::{change_to_frame, spanned_distribution};
pub use hamilton_jacobi::hamilton_jacobi;
pub use kinematics::{Motion, kinematics};
pub use orthonormal::orthonormal;
pub use regularity::{reduced_regularity, saddle_regularity, singular_where};
pub use structure_equations::structure_equations;
pub use symmetries::{Invariance, Setting, Symmetry, no_momenta, of_cyclic_coordinates, symmetries};
pub use volume::{claimed_density, volume};
