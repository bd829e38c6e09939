//! Where a declaration is too large.

use nonholonomic_core::limits::{Subject, TooLarge};

use super::ast::{Name, Section, SystemDecl};
use crate::report::{Diagnostic, Extent};

impl SystemDecl {
    /// That the limits of a derivation were met, at the section that takes the most.
    pub(crate) fn too_large(&self, too_large: TooLarge) -> Diagnostic {
        let sections = &self.sections;
        let kinematics = || keyword(sections.anchor.as_ref()).or(keyword(sections.velocities.as_ref()));
        let place = match too_large.subject {
            Subject::Declaration
            | Subject::Equations
            | Subject::Solution
            | Subject::Code
            | Subject::Map
            | Subject::Quotient => None,
            Subject::Kinematics => kinematics(),
            Subject::Embedding => keyword(sections.on.as_ref()),
            Subject::Brackets => sections.brackets.first().map(|section| &section.keyword).or(kinematics()),
            Subject::Constraints => {
                let velocities = keyword(sections.constraints.as_ref());
                velocities
                    .or(keyword(sections.holonomic.as_ref()))
                    .or(keyword(sections.distribution.as_ref()))
            }
            Subject::Symmetries => keyword(sections.symmetries.as_ref()),
            Subject::Claims => keyword(sections.conserved.as_ref()),
            Subject::Requests => keyword(sections.emit.as_ref()).or(keyword(sections.outputs.as_ref())),
        };
        let place = place.or(keyword(sections.lagrangian.as_ref()));
        let span = place.map_or(self.structure.name.span(), |keyword| keyword.ident.span());
        Extent::at(span).too_large(too_large)
    }
}

impl Extent {
    /// That the limits of a derivation were met by what stands here.
    pub(crate) fn too_large(self, too_large: TooLarge) -> Diagnostic {
        Diagnostic::new(self, too_large.what()).way_out(too_large.way_out().to_owned())
    }
}

fn keyword<T>(section: Option<&Section<T>>) -> Option<&Name> {
    section.map(|section| &section.keyword)
}
