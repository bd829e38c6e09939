//! What has the same unit: the notes that are taken while expressions are read.

use std::collections::BTreeMap;
use std::ops::Range;

use nonholonomic_core::id::{ExprId, SymbolId};
use nonholonomic_core::units::{Dimension, Form, Kind, Reading, Unknown};

use crate::report::Extent;

/// What is noted; nothing, unless units are given.
#[derive(Debug, Default)]
pub(super) struct Homogeneity {
    /// Whether units are given.
    pub(super) wanted: bool,
    pub(super) noted: Vec<Noted>,
    /// What symbols have which unit, where the units of the declaration do not contradict each other.
    pub(super) reading: Option<Reading>,
    /// For every expression that is being read: how much was noted, and used, before.
    pub(super) open: Vec<(usize, usize)>,
    /// Where in the notes the abbreviations are that were used.
    pub(super) used: Vec<Range<usize>>,
    /// Where abbreviations are, and what they are made of.
    pub(super) abbreviations: BTreeMap<String, Vec<Range<usize>>>,
}

/// Things that have the same unit.
#[derive(Clone, Debug)]
pub(super) struct Noted {
    pub(super) sides: Vec<Measured>,
    pub(super) relation: &'static str,
    pub(super) section: &'static str,
    pub(super) place: usize,
    pub(super) within: Vec<Range<usize>>,
}

/// Something that has a unit: a product.
#[derive(Clone, Debug)]
pub(super) struct Measured {
    pub(super) text: String,
    pub(super) extent: Extent,
    pub(super) factors: Vec<(Quantity, i64)>,
}

#[derive(Clone, Debug)]
pub(super) enum Quantity {
    Expression(ExprId, Kind),
    Symbol(SymbolId, Kind),
    Time,
    Known(Form),
}

impl Measured {
    /// What is expected, in words, where a condition stands.
    pub(super) fn expected(text: impl Into<String>, extent: Extent) -> Self {
        Self { text: text.into(), extent, factors: Vec::new() }
    }

    pub(super) fn with(mut self, quantity: Quantity, exponent: i64) -> Self {
        self.factors.push((quantity, exponent));
        self
    }

    /// Times a power of an energy: the unit of the Lagrangian.
    pub(super) fn energy(self, exponent: i64) -> Self {
        self.with(Quantity::Known(Form::of(Unknown::Lagrangian)), exponent)
    }

    /// Times a power of the time.
    pub(super) fn time(self, exponent: i64) -> Self {
        self.with(Quantity::Time, exponent)
    }

    /// Times a power of what a symbol stands for.
    pub(super) fn symbol(self, symbol: SymbolId, exponent: i64) -> Self {
        self.with(Quantity::Symbol(symbol, Kind::Velocities), exponent)
    }

    /// Times the section of which a symbol is the velocity.
    pub(super) fn section(self, symbol: SymbolId) -> Self {
        self.with(Quantity::Symbol(symbol, Kind::Sections), 1)
    }

    /// Times a power of an expression.
    pub(super) fn expression(self, value: ExprId, kind: Kind, exponent: i64) -> Self {
        self.with(Quantity::Expression(value, kind), exponent)
    }

    /// Times a unit.
    pub(super) fn unit(self, unit: Dimension) -> Self {
        self.with(Quantity::Known(Form::known(unit)), 1)
    }

    /// Times something of unknown unit.
    pub(super) fn unknown(self, unknown: Unknown) -> Self {
        self.with(Quantity::Known(Form::of(unknown)), 1)
    }
}

impl Homogeneity {
    /// What was noted and used since what is being read was begun.
    pub(super) fn within(&self) -> Vec<Range<usize>> {
        let now = (self.noted.len(), self.used.len());
        let (noted, used) = self.open.last().copied().unwrap_or(now);
        let used = self.used[used..].iter().filter(|range| !range.is_empty()).cloned();
        std::iter::once(noted..now.0).chain(used).collect()
    }
}
