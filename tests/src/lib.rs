//! The catalogue of reference systems, and how generated code is compared with reference data.

pub mod catalogue;
pub mod comparison;
pub mod dual;
pub mod flux;
pub mod hygiene;
pub mod linear;
pub mod random;
pub mod reference;
pub mod silent;
pub mod systems;
pub mod trajectories;
pub mod twins;
pub mod values;
pub mod vectors;
