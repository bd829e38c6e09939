//! Lines of `impacts`.

use super::{Equation, Expr, Name};

/// `label: row, row with restitution e`
#[derive(Debug)]
pub(crate) struct ImpactLine {
    /// The label before the colon.
    pub(crate) label: Name,
    /// What acts together.
    pub(crate) rows: Vec<ImpactRow>,
    /// The coefficient behind `with restitution`.
    pub(crate) restitution: Option<Expr>,
}

/// One row: `left = right`, `left >= right` or `left <= right`.
#[derive(Debug)]
pub(crate) struct ImpactRow {
    /// Both sides as they are written.
    pub(crate) sides: Equation,
    /// Whether it is an inequality.
    pub(crate) is_unilateral: bool,
    /// Whether the right side is the larger one.
    pub(crate) is_turned: bool,
}
