//! Labelled sections whose momenta are wanted.

use std::collections::BTreeSet;

use nh_core::model::SymmetryDecl;

use super::array::Shape;
use super::context::Context;
use super::dynamics::entry_label;
use super::reports::Outcome;
use super::resolver::Resolver;
use crate::report::Diagnostic;
use crate::syntax::ast::{Item, Symmetry};

impl Resolver {
    /// The sections, vectors entry by entry.
    pub(super) fn symmetries(&mut self, items: &[Item<Symmetry>]) -> Vec<SymmetryDecl> {
        let mut found = Vec::new();
        let mut labels = BTreeSet::new();
        self.section(Context::Symmetries, items, &mut |this, symmetry| {
            this.symmetry(symmetry, &mut labels).map(|sections| found.extend(sections))
        });
        found
    }

    fn symmetry(&mut self, symmetry: &Symmetry, labels: &mut BTreeSet<String>) -> Outcome<Vec<SymmetryDecl>> {
        let value = self.value(&symmetry.value);
        let gauge = symmetry.gauge.as_ref().map(|gauge| self.value(gauge)).transpose();
        let (value, gauge) = (value?, gauge?);
        if let (Some(array), Some(expr)) = (&gauge, &symmetry.gauge)
            && array.shape != value.shape
        {
            let error = Diagnostic::new(expr.extent, "a function stands behind `up to` for every section")
                .evidence(format!("in front is {}, behind {}", value.shape, array.shape));
            return Err(self.report(expr, error));
        }
        let origin = self.origin(symmetry.extent);
        let around = self.scope.loop_values();
        let mut found = Vec::new();
        for (k, section) in value.entries.iter().enumerate() {
            let indices = if value.shape == Shape::Number { Vec::new() } else { value.shape.indices(k) };
            let name = entry_label(&symmetry.label.text, &around, &indices);
            if !labels.insert(name.clone()) {
                let what = format!("the label `{name}` is given twice");
                let error = Diagnostic::new(symmetry.label.extent(), what).way_out("choose another label");
                return Err(self.report(&symmetry.label, error));
            }
            let gauge = gauge.as_ref().map(|array| array.entries[k]);
            found.push(SymmetryDecl { name, value: *section, gauge, origin });
        }
        Ok(found)
    }
}
