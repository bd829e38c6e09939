//! Simultaneous substitution of expressions for symbols.

use super::graph::Graph;
use super::node::Node;
use crate::id::{ExprId, SymbolId};
use crate::id_map::IdMap;
use rustc_hash::FxHashMap;

/// Replaces symbols by expressions, all at once; each distinct subexpression is rebuilt once.
#[derive(Clone, Debug)]
pub struct Substitution {
    images: FxHashMap<SymbolId, ExprId>,
    known: IdMap<ExprId, ExprId>,
}

impl Substitution {
    /// The substitution with the given images; other symbols stay.
    #[must_use]
    pub fn new(images: impl IntoIterator<Item = (SymbolId, ExprId)>) -> Self {
        Self { images: images.into_iter().collect(), known: IdMap::default() }
    }

    /// Adds an image for a symbol that has not occurred so far.
    pub fn insert(&mut self, symbol: SymbolId, image: ExprId) {
        self.images.insert(symbol, image);
    }

    /// Adds an image for a whole subexpression that has not occurred so far.
    pub fn insert_node(&mut self, node: ExprId, image: ExprId) {
        self.known.insert(node, image);
    }

    /// The image of `expression`.
    pub fn apply(&mut self, graph: &mut Graph, expression: ExprId) -> ExprId {
        if self.images.is_empty() && self.known.is_empty() {
            return expression;
        }
        if let Some(&known) = self.known.get(&expression) {
            return known;
        }
        let order = graph.reachable(&[expression]);
        self.known.reserve(order.len());
        for id in order {
            if !self.known.contains_key(&id) {
                let image = self.of_node(graph, id);
                self.known.insert(id, image);
            }
        }
        self.known[&expression]
    }

    /// The images of several expressions.
    pub fn apply_all(&mut self, graph: &mut Graph, expressions: &[ExprId]) -> Vec<ExprId> {
        expressions.iter().map(|expression| self.apply(graph, *expression)).collect()
    }

    /// The image of a node whose operands are known.
    fn of_node(&self, graph: &mut Graph, id: ExprId) -> ExprId {
        let node = graph.node(id).clone();
        if let Node::Symbol(symbol) = node {
            return self.images.get(&symbol).copied().unwrap_or(id);
        }
        if node.operands().all(|operand| self.known[&operand] == operand) {
            return id;
        }
        graph.rebuilt(node, |operand| self.known[&operand])
    }
}

impl Graph {
    /// The node over the images of its operands. Symbols have no operands: they stay.
    pub(super) fn rebuilt(&mut self, node: Node, image: impl Fn(ExprId) -> ExprId) -> ExprId {
        match node {
            Node::Number(value) => self.number(value),
            Node::Pi => self.pi(),
            Node::Constant(constant) => self.constant(constant),
            Node::Symbol(symbol) => self.symbol(symbol),
            Node::Sum { constant, terms } => {
                let one = self.one();
                let summands = terms.iter().map(|(term, c)| (c, image(*term)));
                self.combination_of(summands.chain([(&constant, one)]))
            }
            Node::Product { coefficient, factors } => {
                let product = self.product_of(factors.iter().map(|(base, e)| (image(*base), e.clone())));
                self.scale(coefficient, product)
            }
            Node::Apply(function, x) => self.apply(function, image(x)),
            Node::Apply2(function, x, y) => self.apply2(function, image(x), image(y)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn is_simultaneous() {
        let mut g = Graph::new();
        let (x, y) = (g.new_symbol("x"), g.new_symbol("y"));
        let (ex, ey) = (g.symbol(x), g.symbol(y));
        let e = g.div(ex, ey);
        let swapped = Substitution::new([(x, ey), (y, ex)]).apply(&mut g, e);
        assert_eq!(swapped, g.div(ey, ex));
    }
}
