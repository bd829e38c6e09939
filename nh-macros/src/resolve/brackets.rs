//! Declared brackets, and known algebras written out.

use std::collections::BTreeSet;
use std::ptr;

use nonholonomic_core::algebra::Rational;
use nonholonomic_core::geometry::KnownAlgebra;
use nonholonomic_core::id::SectionId;
use nonholonomic_core::model::BracketDecl;
use nonholonomic_core::units::Kind;

use super::alike::Measured;
use super::context::Context;
use super::reports::Outcome;
use super::resolver::Resolver;
use crate::report::{Diagnostic, Extent};
use crate::suggest::did_you_mean;
use crate::syntax::ast::{self, BracketLine, Brackets, Section};
use crate::syntax::vocabulary::ALGEBRAS;

/// The algebras, for messages.
const KNOWN: &str = "known are so(n) for n from 3 to 32, se(2), se(3), sl(2) and heisenberg(n)";

impl Resolver {
    /// All brackets in the order of the declaration; whether they agree is checked later.
    pub(super) fn brackets(&mut self, blocks: &[Section<Brackets>]) -> Vec<BracketDecl> {
        let mut found = Vec::new();
        for block in blocks {
            match &block.body {
                Brackets::Table(lines) => {
                    self.section(Context::Brackets, lines, &mut |this, line| {
                        found.push(this.bracket(line)?);
                        Ok(())
                    });
                }
                Brackets::Known(algebra) => found.extend(self.known_algebra(algebra).unwrap_or_default()),
            }
        }
        found
    }

    fn bracket(&mut self, line: &BracketLine) -> Outcome<BracketDecl> {
        let (left, right) = (self.single_section(&line.first), self.single_section(&line.second));
        let value = self.number_value(&line.value);
        let origin = self.origin(line.extent.to(line.value.extent));
        let (left, right, value) = (left?, right?, value?);
        let expected = self.bracket_of(left, right, line.extent);
        let given = self.written(&line.value, value, None);
        self.same_unit(line, "equals", vec![expected, given]);
        Ok(BracketDecl { left, right, value, origin, known: None })
    }

    /// A bracket of sections: its unit is the product of theirs.
    fn bracket_of(&self, left: SectionId, right: SectionId, extent: Extent) -> Measured {
        let (left, right) = (&self.tables.sections[left], &self.tables.sections[right]);
        let text = format!("the bracket `[{}, {}]`", left.name, right.name);
        Measured::expected(text, extent).section(left.symbol).section(right.symbol)
    }

    fn known_algebra(&mut self, written: &ast::KnownAlgebra) -> Outcome<Vec<BracketDecl>> {
        let sections = self.listed_sections(written);
        let count = sections.as_ref().map_or(0, Vec::len);
        let algebra = self.algebra(written, count)?;
        let sections = sections?;
        if count != algebra.dimension() {
            let name = name(algebra);
            let wanted = algebra.dimension();
            let plural = if count == 1 { "is" } else { "are" };
            let error = Diagnostic::new(
                written.extent,
                format!("`{name}` takes {wanted} sections, and {count} {plural} listed"),
            )
            .way_out(format!("list them in the order {}", order(algebra)));
            return Err(self.report(written, error));
        }
        let origin = self.origin(written.extent);
        let known = Some(match algebra {
            KnownAlgebra::So(3) => "so(3)",
            KnownAlgebra::So(_) => "so(n)",
            KnownAlgebra::Se2 => "se(2)",
            KnownAlgebra::Se3 => "se(3)",
            KnownAlgebra::Sl2 => "sl(2)",
            KnownAlgebra::Heisenberg(_) => "heisenberg(n)",
        });
        let mut found = Vec::new();
        for bracket in algebra.brackets() {
            self.reports.spend(written.extent, bracket.terms.len())?;
            let terms: Vec<_> = bracket
                .terms
                .iter()
                .map(|(index, coefficient)| {
                    let symbol = self.tables.sections[sections[*index]].symbol;
                    (Rational::from(*coefficient), self.graph.symbol(symbol))
                })
                .collect();
            let value = self.graph.linear_combination(&terms);
            let (left, right) = (sections[bracket.left], sections[bracket.right]);
            for (_, term) in &terms {
                let expected = self.bracket_of(left, right, written.extent);
                let given = self.shown_as(*term, written.extent, Kind::Sections);
                self.same_unit_in("brackets", ptr::from_ref(written).addr(), "equals", vec![expected, given]);
            }
            found.push(BracketDecl { left, right, value, origin, known });
        }
        Ok(found)
    }

    /// The sections in braces, each once.
    fn listed_sections(&mut self, written: &ast::KnownAlgebra) -> Outcome<Vec<SectionId>> {
        let mut listed = Vec::new();
        let mut seen = BTreeSet::new();
        let mut outcome = Ok(());
        for place in &written.sections {
            match self.sections(place) {
                Ok(sections) => {
                    if let Some(twice) = sections.iter().find(|section| !seen.insert(**section)) {
                        let name = &self.tables.sections[*twice].name;
                        let error =
                            Diagnostic::new(place.extent, format!("the section `{name}` is listed twice"));
                        outcome = Err(self.report(place, error));
                    }
                    listed.extend(sections);
                }
                Err(reported) => outcome = Err(reported),
            }
        }
        outcome.map(|()| listed)
    }

    /// The algebra that is meant.
    fn algebra(&mut self, written: &ast::KnownAlgebra, count: usize) -> Outcome<KnownAlgebra> {
        let text = written.algebra.text.as_str();
        let order = match (text, written.order) {
            (_, Some(order)) => Some(order as usize),
            // the number of sections tells
            ("heisenberg", None) => Some((count.max(3) - 1) / 2),
            _ => None,
        };
        if let Some(algebra) = order.and_then(|order| KnownAlgebra::named(text, order)) {
            return Ok(algebra);
        }
        let error = match (order, ALGEBRAS.contains(&text)) {
            (None, true) => Diagnostic::new(written.extent, format!("`{text}` without its number"))
                .way_out(format!("write `{text}({})`", if text == "so" { 3 } else { 2 })),
            (Some(order), true) => {
                Diagnostic::new(written.extent, format!("`{text}({order})` is not a known algebra"))
                    .way_out(KNOWN)
            }
            (_, false) => Diagnostic::new(written.extent, format!("`{text}` is not a known algebra"))
                .evidence(KNOWN)
                .way_out(did_you_mean(text, ALGEBRAS).unwrap_or_else(|| {
                    "give the brackets one by one: `brackets { [a, b] = c; }`".to_owned()
                })),
        };
        Err(self.report(written, error))
    }
}

/// As it is written.
fn name(algebra: KnownAlgebra) -> String {
    match algebra {
        KnownAlgebra::So(n) => format!("so({n})"),
        KnownAlgebra::Se2 => "se(2)".to_owned(),
        KnownAlgebra::Se3 => "se(3)".to_owned(),
        KnownAlgebra::Sl2 => "sl(2)".to_owned(),
        KnownAlgebra::Heisenberg(n) => format!("heisenberg({n})"),
    }
}

/// The order of the sections, with what their brackets are.
fn order(algebra: KnownAlgebra) -> &'static str {
    match algebra {
        KnownAlgebra::So(3) => "w1, w2, w3 with [w1, w2] = w3 and cyclic",
        KnownAlgebra::So(_) => "e_ij, i < j, lexicographically: e_12, e_13, …, e_23, …",
        KnownAlgebra::Se2 => "omega, v1, v2 with [omega, v1] = v2 and [omega, v2] = -v1",
        KnownAlgebra::Se3 => "w1, w2, w3, v1, v2, v3: rotations, then translations",
        KnownAlgebra::Sl2 => "h, e, f with [h, e] = 2*e, [h, f] = -2*f and [e, f] = h",
        KnownAlgebra::Heisenberg(_) => "x…, y…, z with [x_i, y_i] = z",
    }
}
