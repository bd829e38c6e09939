//! What has to have the same unit: noted while expressions are read, as they were written.

use nonholonomic_core::algebra::Rational;
use nonholonomic_core::id::ExprId;
use nonholonomic_core::units::{Condition, Form, Kind, Reading, Side};

use super::alike::{Homogeneity, Measured, Noted, Quantity};
use super::context::Context;
use super::resolver::Resolver;
use super::written::quoted;
use crate::report::Extent;
use crate::syntax::ast::Expr;

/// Letters of an expression that is shown in the words of the graph.
const SHOWN: usize = 60;

impl Resolver {
    /// What velocities stand for in the section that is read, or that uses what is read between the sections.
    fn kind(&self) -> Kind {
        let context = match self.context {
            Context::Shared => self.shared.user().unwrap_or(Context::Shared),
            context => context,
        };
        match context {
            Context::Frame | Context::Brackets | Context::Symmetries => Kind::Sections,
            _ => Kind::Velocities,
        }
    }

    /// An expression or a line is about to be read.
    pub(super) fn open_conditions(&mut self) {
        let Homogeneity { noted, open, used, .. } = &mut self.homogeneity;
        open.push((noted.len(), used.len()));
    }

    /// Whatever was noted since the last [`Resolver::open_conditions`] is about this name: an abbreviation, or an output, a
    /// claim or a label.
    pub(super) fn abbreviates(&mut self, name: &str) {
        if self.homogeneity.wanted {
            let within = self.homogeneity.within();
            self.homogeneity.abbreviations.entry(name.to_owned()).or_default().extend(within);
        }
    }

    /// An abbreviation is used.
    pub(super) fn uses_abbreviation(&mut self, name: &str) {
        let Homogeneity { used, abbreviations, .. } = &mut self.homogeneity;
        used.extend(abbreviations.get(name).into_iter().flatten().cloned());
    }

    /// What was about to be read, since [`Resolver::open_conditions`], has been.
    pub(super) fn close_conditions(&mut self) {
        self.homogeneity.open.pop();
    }

    /// A value as it is written; entry `k` of an array.
    pub(super) fn written(&self, expr: &Expr, value: ExprId, entry: Option<usize>) -> Measured {
        let mut measured = Measured::expected(String::new(), expr.extent);
        if self.homogeneity.wanted {
            measured.text = match entry {
                None => quoted(expr, &self.scope),
                Some(k) => format!("entry {k} of {}", quoted(expr, &self.scope)),
            };
        }
        measured.expression(value, self.kind(), 1)
    }

    /// A value in the words of the graph.
    pub(super) fn shown(&self, value: ExprId, extent: Extent) -> Measured {
        self.shown_as(value, extent, self.kind())
    }

    /// The same, where velocities stand for this.
    pub(super) fn shown_as(&self, value: ExprId, extent: Extent, kind: Kind) -> Measured {
        let mut measured = Measured::expected(String::new(), extent);
        if self.homogeneity.wanted {
            measured.text = format!("`{}`", self.graph.text_within(value, SHOWN));
        }
        measured.expression(value, kind, 1)
    }

    /// Notes that things have the same unit; what is expected comes first. `relation` is how the later ones belong
    /// to the first, and `node` the part of the declaration that says so.
    pub(super) fn same_unit<N>(&mut self, node: &N, relation: &'static str, sides: Vec<Measured>) {
        self.same_unit_of(std::ptr::from_ref(node).addr(), relation, sides);
    }

    /// The same of a part of the declaration by where it is in memory. One contradiction of each is told.
    pub(super) fn same_unit_of(&mut self, place: usize, relation: &'static str, sides: Vec<Measured>) {
        self.same_unit_in(self.context.keyword(), place, relation, sides);
    }

    /// The same for a line of `units`, which stands in no section.
    pub(super) fn same_unit_in(
        &mut self,
        section: &'static str,
        place: usize,
        relation: &'static str,
        sides: Vec<Measured>,
    ) {
        let homogeneity = &mut self.homogeneity;
        if !homogeneity.wanted || sides.len() < 2 {
            return;
        }
        let within = homogeneity.within();
        homogeneity.noted.push(Noted { sides, relation, section, place, within });
    }

    /// Notes that the terms of a sum have the same unit.
    pub(super) fn terms_are_alike(&mut self, at: &Expr, terms: &[(Rational, ExprId)]) {
        if self.homogeneity.wanted && terms.len() > 1 {
            let sides = terms.iter().map(|(_, term)| self.shown(*term, at.extent)).collect();
            self.same_unit(at, ADDED, sides);
        }
    }

    /// Everything that was noted, with the dimensions of its sides.
    pub(super) fn conditions(&mut self, reading: &mut Reading) -> Vec<Condition> {
        let noted = self.homogeneity.noted.clone();
        noted.into_iter().map(|noted| self.condition(noted, reading)).collect()
    }

    fn condition(&mut self, noted: Noted, reading: &mut Reading) -> Condition {
        let Noted { sides, relation, section, place, within } = noted;
        let side = |side: Measured| {
            let form = self.form_of(&side, reading);
            Side { text: side.text, form, origin: self.origins.at(side.extent) }
        };
        Condition { sides: sides.into_iter().map(side).collect(), relation, section, place, within }
    }

    /// The unit of something; that of 0 is any.
    pub(super) fn form_of(&self, measured: &Measured, reading: &mut Reading) -> Option<Form> {
        measured.factors.iter().try_fold(Form::none(), |product, (quantity, exponent)| {
            let factor = match quantity {
                Quantity::Expression(value, kind) => reading.expression(&self.graph, *value, *kind)?,
                Quantity::Symbol(symbol, kind) => reading.symbol(*symbol, *kind),
                Quantity::Time => reading.time().clone(),
                Quantity::Known(form) => form.clone(),
            };
            Some(product.times(&factor, &Rational::from(*exponent)))
        })
    }
}

/// The relation of the terms of a sum.
pub(super) const ADDED: &str = "is added to";
