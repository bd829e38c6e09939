//! The error of emitted code in units in the last place.
//!
//! Every reference system is declared once and emitted at each level of accuracy. What is computed in
//! `f64` is compared with the same function in numbers of twice the precision ([`DoubleDouble`]), at the
//! same parameters, states and inputs, which are exact.

mod double_double;
pub mod errors_by_level;
pub mod measured;
pub mod places;
pub mod regular;
pub mod systems;

pub use double_double::DoubleDouble;
