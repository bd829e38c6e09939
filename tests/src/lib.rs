//! The catalogue of reference systems.
