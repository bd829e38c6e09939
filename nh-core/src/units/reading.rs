//! The dimensions of expressions.

use std::collections::BTreeMap;

use rustc_hash::FxHashMap;

use super::form::{Form, Unknown};
use crate::algebra::{Function, Function2, Graph, Node};
use crate::id::{ExprId, SymbolId};

/// What the velocities in an expression stand for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Kind {
    /// Velocities: y^α.
    Velocities,
    /// The sections `e_α` of which they are the velocities, as in `brackets`: the dimension of e is s⁻¹ over that of y.
    Sections,
}

/// Reads dimensions off expressions.
///
/// The automatic identities of the graph keep dimensions, but what is 0 has lost its own.
#[derive(Debug, Default)]
pub struct Reading {
    /// What symbols mean that are no unknowns of their own: rates and results of methods.
    pub(super) meanings: BTreeMap<SymbolId, Form>,
    /// The velocities that are sections in places.
    pub(super) velocities: Vec<SymbolId>,
    time: Form,
    known: FxHashMap<(ExprId, Kind), Option<Form>>,
}

impl Reading {
    /// With the symbol of the time, rates with their coordinates, the other velocities, and the results of methods.
    #[must_use]
    pub fn new(
        time: SymbolId,
        rates: impl IntoIterator<Item = (SymbolId, SymbolId)>,
        velocities: impl IntoIterator<Item = SymbolId>,
        calls: impl IntoIterator<Item = (SymbolId, String)>,
    ) -> Self {
        let time = Form::of(Unknown::Symbol(time));
        let mut meanings = BTreeMap::new();
        let mut all: Vec<SymbolId> = velocities.into_iter().collect();
        for (rate, coordinate) in rates {
            meanings.insert(rate, Form::of(Unknown::Symbol(coordinate)).over(&time));
            all.push(rate);
        }
        meanings
            .extend(calls.into_iter().map(|(symbol, method)| (symbol, Form::of(Unknown::Method(method)))));
        all.sort_unstable();
        Self { meanings, velocities: all, time, known: FxHashMap::default() }
    }

    /// The dimension of the time.
    #[must_use]
    pub fn time(&self) -> &Form {
        &self.time
    }

    /// The dimension of what a symbol stands for.
    #[must_use]
    pub fn symbol(&self, symbol: SymbolId, kind: Kind) -> Form {
        let own = self.meanings.get(&symbol).cloned().unwrap_or_else(|| Form::of(Unknown::Symbol(symbol)));
        if kind == Kind::Sections && self.velocities.binary_search(&symbol).is_ok() {
            return Form::none().over(&self.time).over(&own);
        }
        own
    }

    /// The dimension of an expression; that of 0 is any.
    pub fn expression(&mut self, graph: &Graph, root: ExprId, kind: Kind) -> Option<Form> {
        let mut open = vec![root];
        let mut new = Vec::new();
        while let Some(id) = open.pop() {
            if self.known.contains_key(&(id, kind)) {
                continue;
            }
            // operands are read before what is made of them
            self.known.insert((id, kind), None);
            new.push(id);
            open.extend(graph.node(id).operands());
        }
        new.sort_unstable();
        for id in new {
            let form = self.node(graph, id, kind);
            self.known.insert((id, kind), form);
        }
        self.known.get(&(root, kind)).cloned().flatten()
    }

    fn node(&self, graph: &Graph, id: ExprId, kind: Kind) -> Option<Form> {
        let of = |id: ExprId| self.known.get(&(id, kind)).cloned().flatten();
        match graph.node(id) {
            Node::Number(value) => (!value.is_zero()).then(Form::none),
            Node::Constant(constant) => Some(Form::of(Unknown::Constant(*constant))),
            Node::Symbol(symbol) => Some(self.symbol(*symbol, kind)),
            Node::Sum { terms, .. } => Some(terms.iter().find_map(|(term, _)| of(*term)).unwrap_or_default()),
            Node::Product { factors, .. } => {
                let product = factors.iter().fold(Form::none(), |product, (base, exponent)| {
                    product.times(&of(*base).unwrap_or_default(), exponent)
                });
                Some(product)
            }
            Node::Apply(Function::Abs, x) => of(*x),
            Node::Apply2(Function2::Min | Function2::Max, x, y) => of(*x).or_else(|| of(*y)),
            Node::Pi | Node::Apply(..) | Node::Apply2(Function2::Atan2, ..) => Some(Form::none()),
        }
    }
}
