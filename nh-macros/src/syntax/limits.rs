//! Limits that no honest declaration reaches, so that no other one hangs or overflows.

/// Nesting of expressions: parentheses, calls, exponents, signs.
pub(crate) const DEPTH: u32 = 64;
/// Digits of a number.
pub(crate) const DIGITS: usize = 1000;
/// Magnitude of a number's power of ten.
pub(crate) const EXPONENT: i32 = 1000;
/// Indices and parts behind one value.
pub(crate) const PARTS: usize = 8;
/// Entries of a family or an array.
pub(crate) const FAMILY: u32 = 4096;
/// Nesting of `for` blocks.
pub(crate) const BLOCKS: u32 = 8;
