//! Expressions of one graph in the terms of another.

use super::graph::Graph;
use super::node::Node;
use crate::id::{ExprId, SymbolId};
use crate::id_map::IdMap;
use rustc_hash::FxHashMap;

/// Carries expressions from one graph to another, with expressions there for the symbols here: the
/// pull-back of functions along a map.
#[derive(Clone, Debug)]
pub struct Transplant<'a> {
    from: &'a Graph,
    images: FxHashMap<SymbolId, ExprId>,
    known: IdMap<ExprId, ExprId>,
}

impl<'a> Transplant<'a> {
    /// With these images of the symbols of `from`. A symbol without one gets a new symbol of the same
    /// name where it is met.
    pub fn new(from: &'a Graph, images: impl IntoIterator<Item = (SymbolId, ExprId)>) -> Self {
        Self { from, images: images.into_iter().collect(), known: IdMap::default() }
    }

    /// The image of an expression of the first graph in the second.
    pub fn apply(&mut self, into: &mut Graph, expression: ExprId) -> ExprId {
        for id in self.from.reachable(&[expression]) {
            if self.known.contains_key(&id) {
                continue;
            }
            let image = match self.from.node(id).clone() {
                Node::Symbol(symbol) => self.symbol(into, symbol),
                Node::Constant(constant) => {
                    let constant = into.new_constant(self.from.constants()[constant].clone());
                    into.constant(constant)
                }
                node => into.rebuilt(node, |operand| self.known[&operand]),
            };
            self.known.insert(id, image);
        }
        self.known[&expression]
    }

    /// The images of several expressions.
    pub fn apply_all(&mut self, into: &mut Graph, expressions: &[ExprId]) -> Vec<ExprId> {
        expressions.iter().map(|expression| self.apply(into, *expression)).collect()
    }

    fn symbol(&mut self, into: &mut Graph, symbol: SymbolId) -> ExprId {
        let from = self.from;
        *self.images.entry(symbol).or_insert_with(|| {
            let fresh = into.new_symbol(from.symbols()[symbol].clone());
            into.symbol(fresh)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pulls_a_function_back() {
        let mut far = Graph::new();
        let (x, v) = (far.new_symbol("x"), far.new_symbol("v"));
        let (ex, ev) = (far.symbol(x), far.symbol(v));
        let sine = far.sin(ex);
        let function = far.mul(sine, ev);
        let mut near = Graph::new();
        let theta = near.new_symbol("theta");
        let theta = near.symbol(theta);
        let double = near.scale(2.into(), theta);
        let mut pull_back = Transplant::new(&far, [(x, double)]);
        let image = pull_back.apply(&mut near, function);
        assert_eq!(near.text(image), "v*sin(2*theta)");
        assert_eq!(pull_back.apply(&mut near, function), image);
    }
}
