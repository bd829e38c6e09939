//! Sums of sines and cosines of different angles, with which the addition theorems do nothing.

use crate::algebra::graph::Graph;
use crate::algebra::node::{Function, Node};
use crate::id::ExprId;
use rustc_hash::FxHashSet;

impl Graph {
    /// Whether an expression is a sum (perhaps of one term) with at most one sine or cosine in each
    /// term, of no more different angles than these have terms.
    ///
    /// Sines and cosines of different angles are linearly independent, so that nothing cancels when
    /// they are expanded; and no fewer angles than before are left to be evaluated.
    pub(super) fn gains_nothing_from_addition_theorems(&self, e: ExprId) -> bool {
        let (mut angles, mut parts) = (FxHashSet::default(), FxHashSet::default());
        let whole = [(e, 1.into())];
        let terms = match self.node(e) {
            Node::Sum { terms, .. } => &terms[..],
            _ => &whole[..],
        };
        for (term, _) in terms {
            let alone = [(*term, 1.into())];
            let factors = match self.node(*term) {
                Node::Product { factors, .. } => &factors[..],
                _ => &alone[..],
            };
            let mut seen = false;
            for (factor, exponent) in factors {
                match self.node(*factor) {
                    Node::Apply(Function::Sin | Function::Cos, angle) => {
                        if std::mem::replace(&mut seen, true) || !exponent.is_one() {
                            return false;
                        }
                        if angles.insert(*angle) {
                            parts.extend(self.as_linear(*angle).1.into_iter().map(|(part, _)| part));
                        }
                    }
                    Node::Symbol(_) | Node::Number(_) | Node::Constant(_) | Node::Pi => {}
                    _ => return false,
                }
            }
        }
        angles.len() <= parts.len()
    }
}
