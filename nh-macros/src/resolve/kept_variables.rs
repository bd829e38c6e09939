//! What a linearisation keeps: variables of the state.

use nonholonomic_core::id::{Origin, SymbolId};
use nonholonomic_core::model::Kept;

use super::resolver::Resolver;
use super::track::STATE;
use crate::report::Diagnostic;
use crate::syntax::ast::{Section, Velocity};

impl Resolver {
    /// The kept variables, each once; a family stands for its entries. None where nothing is said of them: then the
    /// independent ones are kept.
    pub(super) fn linearization(&mut self, section: &Section<Option<Vec<Velocity>>>) -> Kept {
        let origin = self.origin(section.keyword.extent());
        let Some(listed) = &section.body else { return Kept { variables: Vec::new(), origin } };
        if listed.is_empty() {
            let error = Diagnostic::new(section.keyword.extent(), "the linearisation keeps nothing")
                .way_out("name variables of the state: `linearization { keep: x, der(x); }`");
            self.report(section, error);
        }
        let mut variables: Vec<(SymbolId, Origin)> = Vec::new();
        for named in listed {
            let (symbols, extent) = match named {
                Velocity::Named(place) => (self.variables_of_state(place), place.extent),
                Velocity::Der(_, extent) => {
                    (Some(self.velocities(named).map(|(symbols, _)| symbols)), *extent)
                }
            };
            let Some(symbols) = symbols else {
                let Velocity::Named(place) = named else { continue };
                let text = &place.name.text;
                let error = Diagnostic::new(extent, format!("`{text}` is no variable of the state"));
                let question = self.scope.did_you_mean(text, &STATE);
                let known = "`keep` names coordinates, velocities and auxiliary states";
                let error = error.way_out(question.unwrap_or_else(|| known.to_owned()));
                if self.scope.get(text).is_some() {
                    self.report(named, error);
                } else {
                    self.reports.report_unknown(named, text, error);
                }
                continue;
            };
            let Ok(symbols) = symbols else { continue };
            let origin = self.origin(extent);
            for symbol in symbols {
                if variables.iter().any(|(known, _)| *known == symbol) {
                    self.report(named, Diagnostic::new(extent, "this is kept already"));
                } else {
                    variables.push((symbol, origin));
                }
            }
        }
        Kept { variables, origin }
    }
}
