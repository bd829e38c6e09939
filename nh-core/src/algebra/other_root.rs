//! Expressions with the other sign of a square root.

use super::graph::Graph;
use super::node::Node;
use crate::id::ExprId;
use std::collections::BTreeMap;

impl Graph {
    /// Expressions in which every square root of what is a square times `radicand` has the other sign.
    pub(crate) fn with_the_other_root(&mut self, expressions: &[ExprId], radicand: ExprId) -> Vec<ExprId> {
        let mut known: BTreeMap<ExprId, ExprId> = BTreeMap::new();
        for id in self.reachable(expressions) {
            let node = self.node(id).clone();
            let mut signs = 0;
            if let Node::Product { factors, .. } = &node {
                for (base, exponent) in factors.iter() {
                    let twice = exponent.clone() + exponent.clone();
                    if exponent.is_integer() || !twice.is_integer() {
                        continue;
                    }
                    let product = self.mul(*base, radicand);
                    signs += usize::from(self.is_square_everywhere(product));
                }
            }
            let rebuilt = self.rebuilt(node, |operand| known.get(&operand).copied().unwrap_or(operand));
            let image = if signs % 2 == 1 { self.neg(rebuilt) } else { rebuilt };
            known.insert(id, image);
        }
        expressions.iter().map(|id| known.get(id).copied().unwrap_or(*id)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_change_their_signs_and_squares_do_not() {
        let mut g = Graph::new();
        let x = g.new_symbol("x");
        let (x, one, four) = (g.symbol(x), g.one(), g.number(4));
        let radicand = g.formula(one + x * x);
        let larger = g.formula(four * radicand);
        let (root, double) = (g.sqrt(radicand), g.sqrt(larger));
        let other = g.sqrt(x);
        let expressions = [g.formula(x + root), g.formula(root * root), g.formula(one / double), other];
        let expected = [g.formula(x - root), radicand, g.formula(-(one / double)), other];
        assert_eq!(g.with_the_other_root(&expressions, radicand), expected);
    }
}
