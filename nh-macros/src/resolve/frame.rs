//! New sections as combinations of the declared ones, and the sections that span D.

use std::collections::BTreeSet;
use std::rc::Rc;

use nonholonomic_core::id::{Origin, SymbolId};
use nonholonomic_core::model::FrameDecl;

use super::alike::Measured;
use super::context::Context;
use super::definitions::Entry;
use super::resolver::Resolver;
use super::scope::{Meaning, Role};
use crate::emit::Family;
use crate::report::Diagnostic;
use crate::syntax::ast::{Definition, Item, Section, Velocity};

impl Resolver {
    /// The sections of a frame, whose names have a meaning from here on, and their families.
    pub(super) fn frame(&mut self, items: &[Item<Definition>]) -> Vec<Family> {
        let (defined, broken) = self.definitions(Context::Frame, items);
        self.spoil(&broken);
        let mut families = Vec::new();
        for family in &defined {
            let checked = self.scope.check_new(family.name);
            if self.keep(family.name, checked).is_err() {
                continue;
            }
            let text = &family.name.text;
            let Ok(named) = self.enter(text, family.shape(), Role::FrameVelocity, family.extent) else {
                continue;
            };
            for (k, Entry { value, extent, place }) in family.entries.iter().copied().enumerate() {
                let name = family.shape().entry_name(text, k);
                let origin = self.origin(extent);
                let expected = Measured::expected(format!("the section `{name}`"), extent);
                let given = self.shown(value, extent);
                self.same_unit_of(place, "equals", vec![expected.section(named.symbols[k]), given]);
                self.tables.frame.push(FrameDecl { name, symbol: named.symbols[k], value, origin });
            }
            self.scope.insert(text.clone(), Meaning::Named(Rc::new(named)));
            families.push(family.family());
        }
        families
    }

    /// The sections that span D, each once.
    pub(super) fn distribution(&mut self, section: &Section<Vec<Velocity>>) -> Vec<(SymbolId, Origin)> {
        if section.body.is_empty() {
            let error = Diagnostic::new(
                section.keyword.extent(),
                "no section spans the distribution: nothing can move",
            )
            .way_out("name the sections that span D, or leave `distribution` out");
            self.report(section, error);
        }
        let mut found = Vec::new();
        let mut seen = BTreeSet::new();
        for entry in &section.body {
            let Ok((symbols, extent)) = self.velocities(entry) else { continue };
            let origin = self.origin(extent);
            for symbol in symbols {
                if seen.insert(symbol) {
                    found.push((symbol, origin));
                } else {
                    let name = &self.graph.symbols()[symbol];
                    let error = Diagnostic::new(extent, format!("the section `{name}` is listed twice"));
                    self.report(entry, error);
                }
            }
        }
        found
    }
}
