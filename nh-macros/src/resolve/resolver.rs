//! The state of this stage, and what every part of it needs.

use std::collections::{BTreeMap, BTreeSet};

use nonholonomic_core::algebra::Graph;
use nonholonomic_core::geometry::Manifold;
use nonholonomic_core::id::{CoordId, ExprId, Id, InputId, Origin, ParamId, SectionId, SymbolId, Table};
use nonholonomic_core::model::{
    AuxiliaryDecl, Body, Claimed, Coordinate, FrameDecl, Input, Located, MethodCall, Parameter, Section,
};

use proc_macro2::Ident;

use super::alike::Homogeneity;
use super::array::{Part, Shape};
use super::between_sections::Shared;
use super::context::{Context, Usage};
use super::origins::Origins;
use super::reports::{Outcome, Reported, Reports};
use super::scope::{Meaning, Scope};
use super::turns::Rotations;
use crate::report::{Diagnostic, Extent};
use crate::syntax::ast::{Binder, Expr, ExprKind};
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
    /// Auxiliary states.
    pub(super) auxiliary: Vec<AuxiliaryDecl>,
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
    /// What stands between the sections.
    pub(super) shared: Shared,
    /// ẋ^i in the quasi-velocities, where the anchor is given and was read.
    pub(super) anchor_lines: Option<Vec<(SymbolId, ExprId)>>,
    /// What vanishes on an embedded base.
    pub(super) identities: Vec<ExprId>,
    /// The base, once it was asked for.
    pub(super) embedding: Option<Manifold>,
    /// Matrices that are rotations.
    pub(super) rotations: Rotations,
    /// What has to vanish on the base.
    pub(super) claimed: Vec<Claimed>,
    /// Entries of symmetric matrices that are one parameter: above the diagonal, and below.
    pub(super) symmetric: Vec<(ParamId, ParamId)>,
    /// Bodies and material points.
    pub(super) bodies: Vec<Body>,
    /// What drops out of the declaration.
    pub(super) dropped: Vec<Located>,
    /// Parameters and inputs that stand in an expression, by their names.
    pub(super) mentioned: BTreeSet<String>,
    /// What has to have the same unit.
    pub(super) homogeneity: Homogeneity,
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
            shared: Shared::default(),
            anchor_lines: None,
            identities: Vec::new(),
            embedding: None,
            rotations: Rotations::default(),
            claimed: Vec::new(),
            symmetric: Vec::new(),
            bodies: Vec::new(),
            dropped: Vec::new(),
            mentioned: BTreeSet::new(),
            homogeneity: Homogeneity::default(),
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
        if self.shared.reading() {
            self.shared.record(usage, written);
            return Ok(());
        }
        let context = self.context;
        context
            .check(usage, written, at)
            .map_err(|error| self.reports.report_unsuited(node, written, (context.keyword(), error)))
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
            let bounds = match &expr.kind {
                ExprKind::Range(from, to) => (self.index(from)?, Some(self.index(to)?)),
                _ => (self.index(expr)?, None),
            };
            let Some((length, inner)) = part.shape.split() else {
                let what = match shape {
                    Shape::Number => format!("{whole} is a number and has no entries"),
                    _ => format!("{whole} has only one index"),
                };
                return Err(
                    self.report(expr, Diagnostic::new(expr.extent, what).way_out("leave this index out"))
                );
            };
            let within = |index: i64, end: usize| usize::try_from(index).ok().filter(|index| *index < end);
            part = match bounds {
                (index, None) => match within(index, length) {
                    Some(index) => Part { first: part.first + index * inner.len(), shape: inner },
                    None => return Err(self.out_of_range(whole, expr, index, k, length)),
                },
                (from, Some(to)) => match (within(from, length), within(to, length + 1)) {
                    (Some(from), Some(to)) if from < to => Part {
                        first: part.first + from * inner.len(),
                        shape: part.shape.with_length(to - from),
                    },
                    _ => return Err(self.no_part(whole, expr, (from, to), length)),
                },
            };
        }
        Ok(part)
    }

    fn no_part(&mut self, whole: &str, expr: &Expr, bounds: (i64, i64), length: usize) -> Reported {
        let (from, to) = bounds;
        let error = if from < to {
            Diagnostic::new(expr.extent, format!("the part {from}..{to} is out of range"))
        } else {
            Diagnostic::new(expr.extent, format!("the part {from}..{to} has no entries"))
        };
        let entries = if length == 1 { "1 entry".to_owned() } else { format!("{length} entries") };
        let error =
            error.evidence(format!("{whole} has {entries}, counted from 0, and a range leaves out its end"));
        self.report(expr, error)
    }

    fn out_of_range(&mut self, whole: &str, expr: &Expr, index: i64, k: usize, length: usize) -> Reported {
        let owner = if k == 0 { whole.to_owned() } else { format!("a row of {whole}") };
        let entries = if length == 1 { "1 entry".to_owned() } else { format!("{length} entries") };
        let error = Diagnostic::new(expr.extent, format!("the index {index} is out of range"))
            .evidence(format!("{owner} has {entries}, counted from 0"));
        self.report(expr, error)
    }
}
