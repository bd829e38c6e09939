//! The answer of the zero test.

use crate::id::SymbolId;

/// A point where an expression is not zero.
#[derive(Clone, Debug, PartialEq)]
pub struct Witness {
    /// The values of the symbols in the expression.
    pub point: Vec<(SymbolId, f64)>,
    /// The value there.
    pub value: f64,
}

/// The answer of the zero test.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// The expression vanishes wherever it is defined.
    Zero,
    /// It does not, and here is where.
    NonZero(Witness),
    /// It could not be decided, and why.
    Unknown(String),
}

impl Verdict {
    /// Whether the expression is proved to vanish.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        matches!(self, Self::Zero)
    }

    /// Whether the expression is proved not to vanish identically.
    #[must_use]
    pub fn is_nonzero(&self) -> bool {
        matches!(self, Self::NonZero(_))
    }
}
