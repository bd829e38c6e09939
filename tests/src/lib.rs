//! The catalogue of reference systems, and how generated code is compared with reference data.

pub mod random;
pub mod reference;
pub mod values;
