//! Position constraints.

use std::collections::{BTreeMap, BTreeSet};

use nonholonomic_core::id::{ConstraintId, Origin, Table};
use nonholonomic_core::model::{ConstraintDecl, PositionDecl};

use super::context::Context;
use super::dynamics::by_label;
use super::reports::Outcome;
use super::resolver::Resolver;
use crate::report::Diagnostic;
use crate::syntax::ast::{Equation, Item, Name, PositionLine};

/// The labels of equations that were read.
#[derive(Default)]
pub(super) struct Labels {
    /// How many indices stand behind each.
    ranks: BTreeMap<String, usize>,
    /// With these.
    taken: BTreeSet<String>,
}

impl Resolver {
    /// f = lhs − rhs, vectors entry by entry; and where redundant ones are permitted.
    pub(super) fn positions(
        &mut self,
        items: &[Item<PositionLine>],
        labels: &mut Labels,
    ) -> (Vec<PositionDecl>, Option<Origin>) {
        let (mut found, mut redundant) = (Vec::new(), None);
        self.section(Context::Holonomic, items, &mut |this, line| {
            match line {
                PositionLine::Equation(equation) => {
                    found.extend(this.position(equation, labels)?);
                    if let Some(label) = &equation.label {
                        this.abbreviates(&label.text);
                    }
                }
                PositionLine::Redundant(extent) => redundant = Some(this.origin(*extent)),
            }
            Ok(())
        });
        (by_label(found, |position| position.label.as_deref()), redundant)
    }

    fn position(&mut self, equation: &Equation, labels: &mut Labels) -> Outcome<Vec<PositionDecl>> {
        let (left, right) = self.sides(equation)?;
        let origin = self.origin(equation.extent);
        let around = self.scope.loop_values();
        let is_entry = left.entries.len() > 1;
        let mut found = Vec::new();
        for (k, (left_entry, right_entry)) in left.entries.iter().zip(&right.entries).enumerate() {
            let indices = left.shape.indices(k);
            let label = self.new_label(equation.label.as_ref(), &around, &indices, labels)?;
            let value = self.residual(equation, *left_entry, *right_entry)?;
            found.push(PositionDecl { label, value, is_entry, origin });
        }
        Ok(found)
    }

    /// The velocity forms of position constraints, and the constraints on velocities behind them.
    pub(super) fn with_velocity_forms(
        &mut self,
        positions: &[PositionDecl],
        constraints: Vec<ConstraintDecl>,
    ) -> Table<ConstraintId, ConstraintDecl> {
        let mut table = Table::new();
        for position in positions {
            table.push(position.velocity_form(&mut self.graph, &self.tables.coordinates, self.time));
        }
        for constraint in constraints {
            table.push(constraint);
        }
        table
    }

    /// The label of an entry, `roll[1]`, which no other has; those of a `for` around it come first.
    pub(super) fn new_label(
        &mut self,
        label: Option<&Name>,
        around: &[i64],
        indices: &[usize],
        labels: &mut Labels,
    ) -> Outcome<Option<String>> {
        let Some(name) = label else { return Ok(None) };
        let around = around.iter().map(ToString::to_string);
        let indices: Vec<String> = around.chain(indices.iter().map(ToString::to_string)).collect();
        let text = indices.iter().fold(name.text.clone(), |text, index| format!("{text}[{index}]"));
        let rank = *labels.ranks.entry(name.text.clone()).or_insert(indices.len());
        if rank == indices.len() && labels.taken.insert(text.clone()) {
            return Ok(Some(text));
        }
        let text = &name.text;
        let error = Diagnostic::new(name.extent(), format!("the label `{text}` is given twice"))
            .way_out("choose another label");
        Err(self.report(name, error))
    }
}
