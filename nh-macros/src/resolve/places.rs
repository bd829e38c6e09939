//! Sections and directions that lists and left-hand sides name.

use std::rc::Rc;

use nonholonomic_core::id::{CoordId, Id, SectionId, SymbolId};
use nonholonomic_core::model::ForceDirection;

use super::array::Part;
use super::reports::{Outcome, Reported};
use super::resolver::Resolver;
use super::scope::{Meaning, Named, Role};
use crate::report::{Diagnostic, Extent};
use crate::syntax::ast::{Place, Velocity};

const VELOCITIES: [Role; 2] = [Role::Velocity, Role::ImpliedVelocity];
const WITH_FRAME: [Role; 3] = [Role::Velocity, Role::ImpliedVelocity, Role::FrameVelocity];

impl Resolver {
    /// A section of the basis, a family of them, or a row.
    pub(super) fn sections(&mut self, place: &Place) -> Outcome<Vec<SectionId>> {
        let text = &place.name.text;
        if let Some(Meaning::Named(named)) = self.scope.get(text).cloned()
            && VELOCITIES.contains(&named.role)
        {
            let part = self.part(&format!("`{text}`"), named.shape, &place.indices)?;
            return Ok(section_ids(&named, part));
        }
        Err(self.no_section(place))
    }

    /// The velocities of a section of the basis or of the frame, of a family, or of a row.
    pub(super) fn section_velocities(&mut self, place: &Place) -> Outcome<Vec<SymbolId>> {
        if let Some(Meaning::Named(named)) = self.scope.get(&place.name.text).cloned()
            && named.role == Role::FrameVelocity
        {
            let part = self.part(&format!("`{}`", place.name.text), named.shape, &place.indices)?;
            return Ok(named.symbols[part.positions()].to_vec());
        }
        let sections = self.sections(place)?;
        Ok(sections.into_iter().map(|section| self.tables.sections[section].symbol).collect())
    }

    /// A single section.
    pub(super) fn single_section(&mut self, place: &Place) -> Outcome<SectionId> {
        let sections = self.sections(place)?;
        if let [only] = sections.as_slice() {
            return Ok(*only);
        }
        let text = &place.name.text;
        let error = Diagnostic::new(place.extent, format!("`{text}` is a family of sections"))
            .way_out(format!("name one of them, as in `{text}[0]`; `for` goes over all"));
        Err(self.report(place, error))
    }

    fn no_section(&mut self, place: &Place) -> Reported {
        let text = &place.name.text;
        let extent = place.name.extent();
        let error = match self.scope.get(text) {
            Some(Meaning::Broken) => return Reported,
            Some(Meaning::Named(named)) => {
                Diagnostic::new(extent, format!("`{text}` is {}, not a section", named.role.noun()))
                    .way_out("name one of the quasi-velocities")
            }
            Some(_) => Diagnostic::new(extent, format!("`{text}` is not a section"))
                .way_out("name one of the quasi-velocities"),
            None => {
                let error = Diagnostic::new(extent, format!("there is no section `{text}`"));
                let way_out = self.scope.did_you_mean(text, &VELOCITIES).unwrap_or_else(|| {
                    "sections are declared in `basis { omega, v1 }` or by `velocities`".to_owned()
                });
                return self.reports.report_unknown(place, text, error.way_out(way_out));
            }
        };
        self.report(place, error)
    }

    /// The velocities that an entry of `independent` names, with its extent.
    pub(super) fn velocities(&mut self, velocity: &Velocity) -> Outcome<(Vec<SymbolId>, Extent)> {
        match velocity {
            Velocity::Named(place) => match self.scope.get(&place.name.text).cloned() {
                Some(Meaning::Named(named)) if named.role == Role::Coordinate => {
                    let text = &place.name.text;
                    let error = Diagnostic::new(
                        place.extent,
                        format!("`{text}` is a base coordinate, not a velocity"),
                    );
                    let error = match self.rate_sections(&named, Part { first: 0, shape: named.shape }) {
                        Some(_) => error.way_out(format!("write `der({text})`")),
                        None => error.way_out("name one of the quasi-velocities"),
                    };
                    Err(self.report(place, error))
                }
                _ => Ok((self.section_velocities(place)?, place.extent)),
            },
            Velocity::Der(place, extent) => {
                let (named, part) = self.coordinate(place)?;
                if let Some(sections) = self.rate_sections(&named, part) {
                    return Ok((sections, *extent));
                }
                let what = format!("`der({})` is not one of the quasi-velocities", place.name.text);
                let error = Diagnostic::new(*extent, what)
                    .evidence(
                        "the declaration has its own quasi-velocities, and the state keeps some of them",
                    )
                    .way_out("name them as they are declared");
                Err(self.report(place, error))
            }
        }
    }

    /// Where E = TM: the sections whose velocities are the rates of these coordinates.
    fn rate_sections(&self, named: &Named, part: Part) -> Option<Vec<SymbolId>> {
        let of = |position: usize| {
            let rate = *named.rates.get(position)?;
            self.tables.sections.iter().any(|section| section.symbol == rate).then_some(rate)
        };
        part.positions().map(of).collect()
    }

    /// What a force acts along: sections, or base coordinates. Where E = TM these are the same.
    pub(super) fn directions(&mut self, place: &Place) -> Outcome<(Vec<ForceDirection>, Part)> {
        let text = &place.name.text;
        let extent = place.name.extent();
        let named: Option<Rc<Named>> = match self.scope.get(text) {
            Some(Meaning::Named(named)) => Some(Rc::clone(named)),
            Some(Meaning::Broken) => return Err(Reported),
            _ => None,
        };
        let error = match named {
            Some(named) if named.role == Role::Coordinate || WITH_FRAME.contains(&named.role) => {
                let part = self.part(&format!("`{text}`"), named.shape, &place.indices)?;
                let sections = match named.role {
                    Role::Coordinate => self.rate_sections(&named, part),
                    _ => Some(named.symbols[part.positions()].to_vec()),
                };
                let directions = match sections {
                    Some(sections) => sections.into_iter().map(ForceDirection::Section).collect(),
                    None => part
                        .positions()
                        .map(|k| ForceDirection::Coordinate(CoordId::from_index(named.first + k)))
                        .collect(),
                };
                return Ok((directions, part));
            }
            Some(named) => {
                Diagnostic::new(extent, format!("`{text}` is {}, not a direction", named.role.noun()))
                    .way_out("a force acts along a section of the basis or along a base coordinate")
            }
            None => {
                let roles = [Role::Velocity, Role::ImpliedVelocity, Role::FrameVelocity, Role::Coordinate];
                let what = format!("a force along the unknown direction `{text}`");
                let way_out = self.scope.did_you_mean(text, &roles).unwrap_or_else(|| {
                    "a force acts along a section of the basis or along a base coordinate".to_owned()
                });
                let error = Diagnostic::new(extent, what).way_out(way_out);
                return Err(self.reports.report_unknown(place, text, error));
            }
        };
        Err(self.report(place, error))
    }
}

fn section_ids(named: &Named, part: Part) -> Vec<SectionId> {
    part.positions().map(|k| SectionId::from_index(named.first + k)).collect()
}
