//! How instructions are counted: this program under callgrind, at states that are the same in every run.
#![allow(clippy::cast_precision_loss, reason = "counts stay far below 2⁵²")]

pub mod callgrind;
pub mod program;
pub mod random;
