//! The tests of what reads profiles, without the systems that are declared beside it.
#![allow(dead_code, reason = "what the benchmark uses of this file")]
#![allow(clippy::cast_precision_loss, reason = "counts stay far below 2⁵²")]

#[path = "../src/callgrind.rs"]
pub mod callgrind;
