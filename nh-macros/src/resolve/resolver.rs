//! The state of this stage, and what every part of it needs.

use std::collections::BTreeMap;

use nonholonomic_core::algebra::Graph;
use nonholonomic_core::id::{CoordId, ExprId, Id, InputId, Origin, ParamId, SectionId, SymbolId, Table};
use nonholonomic_core::model::{Coordinate, FrameDecl, Input, Located, MethodCall, Parameter, Section};

use proc_macro2::Ident;

use super::array::{Part, Shape};
use super::context::{Context, Usage};
use super::origins::Origins;
use super::reports::{Outcome, Reported, Reports};
use super::scope::{Meaning, Scope};
use crate::report::{Diagnostic, Extent};
use crate::syntax::ast::{Binder, Expr};
use crate::syntax::limits;

/// The declared quantities of the model.
#[derive(Default)]
pub(super) struct Tables {
    /// Scalar parameters.
    pub(super) parameters: Table<ParamId, Parameter>,
    /// Base coordinates.
    pub(super) coordinates: Table<CoordId, Coordinate>,
    /// Sections.
    pub(super) sections: Table<SectionId, Section>,
    /// Inputs.
    pub(super) inputs: Table<InputId, Input>,
    /// Sections of the frame.
    pub(super) frame: Vec<FrameDecl>,
}

/// Resolves one declaration.
pub(super) struct Resolver {
    /// The expressions.
    pub(super) graph: Graph,
    /// The time.
    pub(super) time: SymbolId,
    /// What is declared.
    pub(super) tables: Tables,
    /// Calls of the user's methods.
    pub(super) calls: Vec<MethodCall>,
    /// The methods that are called or named as derivatives, where they stand first.
    pub(super) methods: BTreeMap<String, Ident>,
    /// The names.
    pub(super) scope: Scope,
    /// The section that is read.
    pub(super) context: Context,
    /// What drops out of the declaration.
    pub(super) dropped: Vec<Located>,
    /// The span table.
    pub(super) origins: Origins,
    /// What went wrong.
    pub(super) reports: Reports,
}

impl Resolver {
    /// Nothing is known but `t` and `pi`. The origin of the whole declaration is the first one.
    pub(super) fn new(whole: Extent) -> Self {
        let mut origins = Origins::default();
        origins.at(whole);
        let mut graph = Graph::new();
        let time = graph.new_symbol("t");
        Self {
            graph,
            time,
            tables: Tables::default(),
            calls: Vec::new(),
            methods: BTreeMap::new(),
            scope: Scope::new(),
            context: Context::Lagrangian,
            dropped: Vec::new(),
            origins,
            reports: Reports::new(),
        }
    }

    /// Reports an error about a node of the declaration.
    pub(super) fn report<T>(&mut self, node: &T, error: Diagnostic) -> Reported {
        self.reports.report(node, error)
    }

    /// The value, or its error is reported.
    pub(super) fn keep<T, N>(&mut self, node: &N, result: Result<T, Diagnostic>) -> Outcome<T> {
        result.map_err(|error| self.report(node, error))
    }

    /// The origin of the whole declaration.
    pub(super) fn whole() -> Origin {
        Origin::from_index(0)
    }

    /// The expression `t`.
    pub(super) fn time(&mut self) -> ExprId {
        self.graph.symbol(self.time)
    }

    /// A new origin.
    pub(super) fn origin(&mut self, extent: Extent) -> Origin {
        self.origins.at(extent)
    }

    /// Refuses what has no place in this section.
    pub(super) fn check_usage<N>(
        &mut self,
        node: &N,
        usage: Usage,
        written: &str,
        at: Extent,
    ) -> Outcome<()> {
        let checked = self.context.check(usage, written, at);
        self.keep(node, checked)
    }

    /// Runs `body` once for all values of the variables; a later range may use earlier variables.
    pub(super) fn each_value(&mut self, binders: &[Binder], body: &mut dyn FnMut(&mut Self)) -> Outcome<()> {
        let Some((binder, inner)) = binders.split_first() else {
            body(self);
            return Ok(());
        };
        let range = self.range(binder)?;
        let checked = self.scope.check_new(&binder.name);
        let outcome = self.keep(&binder.name, checked);
        let depth = self.scope.depth();
        for value in range {
            self.reports.spend(binder.extent, 1)?;
            // a name that has a meaning already has none in here: its uses are silent
            let meaning = if outcome.is_ok() { Meaning::Index(value) } else { Meaning::Broken };
            self.scope.bind(&binder.name.text, meaning);
            let inside = self.each_value(inner, body);
            self.scope.leave(depth);
            inside?;
        }
        outcome
    }

    /// The values of a variable.
    fn range(&mut self, binder: &Binder) -> Outcome<std::ops::Range<i64>> {
        let (from, to) = (self.index(&binder.from), self.index(&binder.to));
        let (from, to) = (from?, to?);
        if to.saturating_sub(from) > i64::from(limits::FAMILY) {
            let error =
                Diagnostic::new(binder.extent, format!("a range of {} values", to.saturating_sub(from)))
                    .way_out(format!("ranges have at most {} values", limits::FAMILY));
            return Err(self.report(binder, error));
        }
        Ok(from..to)
    }

    /// Finds a part by its indices. `whole` is what is indexed, in words.
    pub(super) fn part(&mut self, whole: &str, shape: Shape, indices: &[Expr]) -> Outcome<Part> {
        let mut part = Part { first: 0, shape };
        for (k, expr) in indices.iter().enumerate() {
            let index = self.index(expr)?;
            let Some((length, inner)) = part.shape.split() else {
                let what = match shape {
                    Shape::Number => format!("{whole} is a number and has no entries"),
                    _ => format!("{whole} has only one index"),
                };
                return Err(
                    self.report(expr, Diagnostic::new(expr.extent, what).way_out("leave this index out"))
                );
            };
            match usize::try_from(index).ok().filter(|index| *index < length) {
                Some(index) => part = Part { first: part.first + index * inner.len(), shape: inner },
                None => return Err(self.out_of_range(whole, expr, index, k, length)),
            }
        }
        Ok(part)
    }

    fn out_of_range(&mut self, whole: &str, expr: &Expr, index: i64, k: usize, length: usize) -> Reported {
        let owner = if k == 0 { whole.to_owned() } else { format!("a row of {whole}") };
        let entries = if length == 1 { "1 entry".to_owned() } else { format!("{length} entries") };
        let error = Diagnostic::new(expr.extent, format!("the index {index} is out of range"))
            .evidence(format!("{owner} has {entries}, counted from 0"));
        self.report(expr, error)
    }
}
