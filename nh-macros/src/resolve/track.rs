//! What is tracked: state variables and outputs.

use nonholonomic_core::id::{Origin, SymbolId};
use nonholonomic_core::model::{OutputDecl, TrackedItem};

use super::reports::{Outcome, Reported};
use super::resolver::Resolver;
use super::scope::{Meaning, Role};
use crate::report::Diagnostic;
use crate::suggest::did_you_mean;
use crate::syntax::ast::{Place, Section, Velocity};

/// What the state consists of.
pub(super) const STATE: [Role; 5] =
    [Role::Coordinate, Role::Velocity, Role::ImpliedVelocity, Role::FrameVelocity, Role::Auxiliary];

impl Resolver {
    /// The tracked items; a family stands for its entries.
    pub(super) fn tracked(
        &mut self,
        section: &Section<Vec<Velocity>>,
        outputs: &[OutputDecl],
    ) -> Vec<(TrackedItem, Origin)> {
        if section.body.is_empty() {
            let error = Diagnostic::new(section.keyword.extent(), "nothing is tracked")
                .way_out("name the state variables and outputs that are needed, or leave the section out");
            self.report(section, error);
        }
        let mut found: Vec<(TrackedItem, Origin)> = Vec::new();
        for named in &section.body {
            let (items, extent) = match named {
                Velocity::Named(place) => (self.tracked_place(place, outputs), place.extent),
                Velocity::Der(_, extent) => {
                    let symbols = self.velocities(named).map(|(symbols, _)| symbols);
                    (symbols.map(variables), *extent)
                }
            };
            let Ok(items) = items else { continue };
            let origin = self.origin(extent);
            for item in items {
                if found.iter().any(|(known, _)| *known == item) {
                    self.report(named, Diagnostic::new(extent, "this is tracked already"));
                } else {
                    found.push((item, origin));
                }
            }
        }
        found
    }

    /// Coordinates, velocities, or outputs by their name.
    fn tracked_place(&mut self, place: &Place, outputs: &[OutputDecl]) -> Outcome<Vec<TrackedItem>> {
        let text = &place.name.text;
        if let Some(found) = self.variables_of_state(place) {
            return found.map(variables);
        }
        let mut entry = text.clone();
        for index in &place.indices {
            let index = self.index(index)?;
            entry.extend(["[", &index.to_string(), "]"]);
        }
        let family = format!("{entry}[");
        let is_meant = |output: &OutputDecl| output.name == entry || output.name.starts_with(&family);
        let meant: Vec<TrackedItem> = outputs
            .iter()
            .enumerate()
            .filter(|(_, output)| is_meant(output))
            .map(|(index, _)| TrackedItem::Output(index))
            .collect();
        if meant.is_empty() { Err(self.not_trackable(place, outputs)) } else { Ok(meant) }
    }

    /// Coordinates, velocities or auxiliary states by their name; nothing if the name is none of theirs.
    pub(super) fn variables_of_state(&mut self, place: &Place) -> Option<Outcome<Vec<SymbolId>>> {
        let text = &place.name.text;
        let named = match self.scope.get(text).cloned() {
            Some(Meaning::Named(named)) => named,
            Some(Meaning::Broken) => return Some(Err(Reported)),
            _ => return None,
        };
        match named.role {
            Role::Auxiliary => {
                let part = self.part(&format!("`{text}`"), named.shape, &place.indices);
                Some(part.map(|part| named.symbols[part.positions()].to_vec()))
            }
            Role::Coordinate => {
                let found = self.coordinate(place);
                Some(found.map(|(named, part)| named.symbols[part.positions()].to_vec()))
            }
            Role::Velocity | Role::ImpliedVelocity | Role::FrameVelocity => {
                Some(self.section_velocities(place))
            }
            _ => None,
        }
    }

    fn not_trackable(&mut self, place: &Place, outputs: &[OutputDecl]) -> Reported {
        let text = &place.name.text;
        let family = format!("{text}[");
        let is_known = outputs.iter().any(|output| output.name == *text || output.name.starts_with(&family));
        if !is_known && self.scope.outputs.contains(text) {
            // it is in error, which was reported
            return Reported;
        }
        let what = format!("`{text}` is neither a state variable nor an output");
        let error = Diagnostic::new(place.extent, what);
        let names = outputs.iter().map(|output| output.name.as_str());
        let question = did_you_mean(text, names).or_else(|| self.scope.did_you_mean(text, &STATE));
        let known = "`track` names coordinates, velocities and outputs";
        let error = error.way_out(question.unwrap_or_else(|| known.to_owned()));
        if self.scope.get(text).is_some() {
            return self.report(place, error);
        }
        self.reports.report_unknown(place, text, error)
    }
}

/// Each symbol as an item.
fn variables(symbols: Vec<SymbolId>) -> Vec<TrackedItem> {
    symbols.into_iter().map(TrackedItem::Variable).collect()
}
