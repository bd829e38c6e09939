//! The tests of what reads the reference data, without the systems that are declared beside it.
#![allow(dead_code, reason = "what other tests use of these files")]

#[path = "../src/reference.rs"]
pub mod reference;
#[path = "../src/values.rs"]
pub mod values;
