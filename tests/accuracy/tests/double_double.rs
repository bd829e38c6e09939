//! The tests of the numbers of 31 digits, without the systems that are declared beside them.

#[path = "../src/double_double/mod.rs"]
pub mod double_double;
