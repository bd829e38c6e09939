//! Labelled sections whose momenta are wanted.

use std::collections::BTreeSet;

use nonholonomic_core::id::ExprId;
use nonholonomic_core::model::{RouthDecl, SymmetryDecl};
use nonholonomic_core::units::Kind;

use super::alike::Measured;
use super::array::Shape;
use super::context::Context;
use super::reports::{Outcome, Reported};
use super::resolver::Resolver;
use crate::report::Diagnostic;
use crate::suggest::did_you_mean;
use crate::syntax::ast::{Definition, Item, Subscript, Symmetry};

impl Resolver {
    /// The sections, vectors entry by entry; and the labels of those in error.
    pub(super) fn symmetries(&mut self, items: &[Item<Symmetry>]) -> (Vec<SymmetryDecl>, BTreeSet<String>) {
        let (mut found, mut broken) = (Vec::new(), BTreeSet::new());
        let mut labels = BTreeSet::new();
        self.section(Context::Symmetries, items, &mut |this, symmetry| {
            let sections = this.symmetry(symmetry, &mut labels);
            this.abbreviates(&symmetry.label.text);
            if sections.is_err() {
                broken.insert(symmetry.label.text.clone());
            }
            sections.map(|sections| found.extend(sections))
        });
        (found, broken)
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
            if let (Some(gauge), Some(at)) = (gauge, &symmetry.gauge) {
                let expected = Measured::expected(format!("the momentum of `{name}`"), symmetry.extent);
                let expected = expected.expression(*section, Kind::Sections, 1).energy(1).time(1);
                let given = self.written(at, gauge, None);
                self.same_unit(at, "is compared with", vec![expected, given]);
            }
            found.push(SymmetryDecl { name, value: *section, gauge, origin });
        }
        Ok(found)
    }
}

/// The label of an entry: `spin_1` for the second of a vector, `spin_0_1` in a `for` around it.
fn entry_label(label: &str, around: &[i64], indices: &[usize]) -> String {
    let around = around.iter().map(ToString::to_string);
    let parts = around.chain(indices.iter().map(ToString::to_string));
    parts.fold(label.to_owned(), |text, part| text + "_" + &part)
}

impl Resolver {
    /// Momenta that become parameters, vectors entry by entry.
    pub(super) fn routh(
        &mut self,
        items: &[Item<Definition>],
        (symmetries, broken): (&[SymmetryDecl], &BTreeSet<String>),
    ) -> Vec<RouthDecl> {
        let mut found: Vec<RouthDecl> = Vec::new();
        self.section(Context::Routh, items, &mut |this, definition| {
            if broken.contains(&definition.name.text) {
                return Err(Reported);
            }
            for level in this.levels(definition, symmetries)? {
                if found.iter().any(|earlier| earlier.symmetry == level.symmetry) {
                    let what = format!("the momentum of `{}` is on two levels", level.symmetry);
                    return Err(this.report(definition, Diagnostic::new(definition.extent, what)));
                }
                found.push(level);
            }
            Ok(())
        });
        found
    }

    /// `spin = mu`: a label of `symmetries` or a coordinate, or a vector of them.
    fn levels(&mut self, definition: &Definition, symmetries: &[SymmetryDecl]) -> Outcome<Vec<RouthDecl>> {
        let (mut entry, mut label) = (definition.name.text.clone(), definition.name.text.clone());
        for subscript in &definition.subscripts {
            let Subscript::Entry(index) = subscript else {
                let error = Diagnostic::new(definition.extent, "one momentum stands on the left")
                    .way_out("write `for i in 0..3 { spin[i] = mu[i]; }`");
                return Err(self.report(definition, error));
            };
            let index = self.index(index)?;
            entry.extend(["[", &index.to_string(), "]"]);
            label.extend(["_", &index.to_string()]);
        }
        let labels = symmetries.iter().map(|symmetry| symmetry.name.clone());
        let coordinates = self.tables.coordinates.iter().map(|coordinate| coordinate.name.clone());
        let known: Vec<String> = labels.chain(coordinates).collect();
        let is_known = |name: &String| known.contains(name);
        let alone = [&entry, &label].into_iter().find(|name| is_known(name));
        let names: Vec<String> = if let Some(name) = alone {
            vec![name.clone()]
        } else {
            let entries = (0..).map(|k: usize| format!("{entry}[{k}]")).take_while(is_known);
            let labels = (0..).map(|k: usize| format!("{label}_{k}")).take_while(is_known);
            let entries: Vec<String> = entries.collect();
            if entries.is_empty() { labels.collect() } else { entries }
        };
        if names.is_empty() {
            let name = &definition.name.text;
            let what = format!("`{name}` is neither a symmetry nor a coordinate");
            let way_out = did_you_mean(name, known.iter().map(String::as_str))
                .unwrap_or_else(|| "declare its section: `symmetries { spin: omega; }`".to_owned());
            let error = Diagnostic::new(definition.extent, what).way_out(way_out);
            return Err(self.reports.report_unknown(definition, name, error));
        }
        let value = self.value(&definition.value)?;
        let values = if names == [entry] || names == [label] {
            vec![self.as_number(&definition.value, &value)?]
        } else {
            let shape = Shape::Vector(names.len());
            let Some(value) = self.in_shape(&value, shape) else {
                let error = Diagnostic::new(definition.value.extent, "the two sides have different shapes")
                    .evidence(format!("on the left is {shape}, on the right {}", value.shape));
                return Err(self.report(definition, error));
            };
            value.entries
        };
        let levels = names.into_iter().zip(values);
        Ok(levels.map(|(symmetry, level)| self.level(definition, symmetries, symmetry, level)).collect())
    }

    /// The momentum of a symmetry or of a coordinate on its level.
    fn level(
        &mut self,
        definition: &Definition,
        symmetries: &[SymmetryDecl],
        symmetry: String,
        level: ExprId,
    ) -> RouthDecl {
        let momentum = Measured::expected(format!("the momentum of `{symmetry}`"), definition.extent);
        let momentum = momentum.energy(1).time(1);
        let coordinate = self.tables.coordinates.iter().find(|coordinate| coordinate.name == symmetry);
        let momentum = match (symmetries.iter().find(|section| section.name == symmetry), coordinate) {
            (Some(section), _) => Some(momentum.expression(section.value, Kind::Sections, 1)),
            (None, coordinate) => coordinate.map(|coordinate| momentum.symbol(coordinate.symbol, -1)),
        };
        if let Some(momentum) = momentum {
            let given = self.written(&definition.value, level, None);
            self.same_unit(definition, "is compared with", vec![momentum, given]);
        }
        let origin = self.origin(definition.extent.to(definition.value.extent));
        RouthDecl { symmetry, level, origin }
    }
}
