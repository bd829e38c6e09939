//! Impacts: equations and inequalities that velocities jump to.

use super::Located;
use crate::id::{ExprId, Origin};

/// Equations and inequalities that act together at one instant.
#[derive(Clone, Debug)]
pub struct ImpactDecl {
    /// Its label.
    pub label: String,
    /// What acts.
    pub rows: Vec<ImpactRowDecl>,
    /// The coefficient of restitution, an expression of parameters; 0 if none is given.
    pub restitution: Option<Located>,
    /// Where it stands.
    pub origin: Origin,
}

/// One equation or inequality between positions or velocities.
#[derive(Clone, Copy, Debug)]
pub struct ImpactRowDecl {
    /// lhs − rhs; t, x, y, rates and auxiliary states may occur in it.
    pub value: ExprId,
    /// Whether it says ≥ 0 rather than = 0.
    pub is_unilateral: bool,
    /// Where it stands.
    pub origin: Origin,
}

impl ImpactDecl {
    /// What the row is called: the label, with the row's number where there are several.
    #[must_use]
    pub fn row_name(&self, row: usize) -> String {
        let label = &self.label;
        if self.rows.len() > 1 { format!("{label}[{row}]") } else { label.clone() }
    }
}
