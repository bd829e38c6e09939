//! The levels of accuracy that a declaration asks for.

/// What emitted code is made for, where speed and accuracy are at odds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Accuracy {
    /// Whatever is fastest.
    Fast,
    /// What is faster, unless it loses more than a factor of four.
    #[default]
    Balanced,
    /// What is more accurate, at some cost.
    Careful,
}

impl Accuracy {
    /// How many times larger the rounding error of an expression may become for fewer operations.
    #[must_use]
    pub fn growth(self) -> f64 {
        match self {
            Self::Fast => f64::INFINITY,
            Self::Balanced => 4.0,
            Self::Careful => 1.0,
        }
    }
}
