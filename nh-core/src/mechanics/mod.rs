//! Lagrangian mechanics on a Lie algebroid.

mod procedure;

pub use procedure::{Definition, Procedure};
