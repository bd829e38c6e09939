//! Entries of vector equations that are 0 = 0, as the height of a point of contact above level ground: they are left out.

use crate::algebra::Graph;
use crate::geometry::Manifold;
use crate::id::{ExprId, Origin};

/// An equation, as the left side less the right one.
#[derive(Clone, Copy)]
pub(super) struct Equation {
    pub(super) value: ExprId,
    /// Whether it is one of several entries of a vector equation.
    pub(super) is_entry: bool,
    pub(super) origin: Origin,
}

/// Which of these are such entries on a base, beside others of the same vector equation that are not.
pub(super) fn empty_entries(graph: &mut Graph, base: &Manifold, equations: &[Equation]) -> Vec<bool> {
    let is_zero: Vec<bool> = equations
        .iter()
        .map(|equation| equation.is_entry && base.zero_test(graph, equation.value).is_zero())
        .collect();
    let says_something = |origin: Origin| {
        equations.iter().zip(&is_zero).any(|(equation, is_zero)| equation.origin == origin && !is_zero)
    };
    let equations = equations.iter().zip(&is_zero);
    equations.map(|(equation, is_zero)| *is_zero && says_something(equation.origin)).collect()
}

/// The line of the report.
pub(super) fn told(name: &str) -> String {
    format!("{name} is left out: its sides are equal everywhere")
}
