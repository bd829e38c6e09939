//! The parts of the benchmark of record: the contestants, and what measures them.
#![allow(clippy::cast_precision_loss, reason = "counts stay far below 2⁵²")]

pub mod contest;
pub mod contest_table;
pub mod peers;
pub mod runner;
pub mod systems;
