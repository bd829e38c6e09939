//! What is known of units in the end.

use super::dimension::Dimension;
use super::elimination::Elimination;
use super::form::Form;

/// The units of everything, as far as they are determined.
#[derive(Clone, Debug, Default)]
pub struct Inferred {
    pub(super) equations: Elimination,
}

/// A named quantity and its unit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Quantity {
    /// Its name: `x`, or `q[2]`.
    pub name: String,
    /// Its unit.
    pub unit: Unit,
    /// The dimension of that, if it is known.
    pub dimension: Option<Dimension>,
}

/// What is known of a unit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Unit {
    /// It is this.
    Known(String),
    /// Nothing determines it.
    Free,
}

impl Inferred {
    /// What a dimension is, if it is determined.
    #[must_use]
    pub fn dimension(&self, form: &Form) -> Option<Dimension> {
        self.equations.reduced(form).value().cloned()
    }

    /// The unit of a dimension.
    #[must_use]
    pub fn unit(&self, form: &Form) -> Unit {
        self.dimension(form).map_or(Unit::Free, |dimension| Unit::Known(dimension.to_string()))
    }
}

/// The quantities, those with the same unit in one line.
pub(crate) fn lines(quantities: &[Quantity]) -> Vec<String> {
    let mut lines: Vec<(&str, Vec<&str>)> = Vec::new();
    for quantity in quantities {
        let unit = match &quantity.unit {
            Unit::Known(text) => text,
            Unit::Free => "not determined",
        };
        match lines.iter_mut().find(|(known, _)| *known == unit) {
            Some((_, names)) => names.push(&quantity.name),
            None => lines.push((unit, vec![&quantity.name])),
        }
    }
    lines.into_iter().map(|(unit, names)| format!("{unit}: {}", names.join(", "))).collect()
}
