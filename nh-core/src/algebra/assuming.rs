//! Identities that hold under facts about the symbols:
//!
//! | identity | condition |
//! |---|---|
//! | `(x^2 y)^(1/2) = x y^(1/2)` and its kin | `x ≥ 0` |
//! | `abs(x) = x`, `abs(x) = −x` | `x ≥ 0`, `x ≤ 0` |
//! | `sign(x) = 1`, `sign(x) = −1` | `x > 0`, `x < 0` |
//! | `min(x, y)`, `max(x, y)` are one of the two | the sign of `x − y` |

use super::graph::{Function, Function2, Graph, Node};
use super::number::Rational;
use super::range::Facts;
use crate::id::ExprId;
use rustc_hash::FxHashMap;

impl Graph {
    /// The expressions with these identities applied throughout.
    pub fn assuming(&mut self, roots: &[ExprId], facts: &Facts) -> Vec<ExprId> {
        let mut known: FxHashMap<ExprId, ExprId> = FxHashMap::default();
        for id in self.reachable(roots) {
            let image = self.assuming_node(id, &known, facts);
            known.insert(id, image);
        }
        roots.iter().map(|root| known[root]).collect()
    }

    fn assuming_node(&mut self, id: ExprId, known: &FxHashMap<ExprId, ExprId>, facts: &Facts) -> ExprId {
        match self.node(id).clone() {
            Node::Number(_) | Node::Pi | Node::Constant(_) | Node::Symbol(_) => id,
            Node::Sum { constant, terms } => {
                let one = self.one();
                let mut summands: Vec<_> = terms.iter().map(|(term, c)| (c.clone(), known[term])).collect();
                summands.push((constant, one));
                self.linear_combination(&summands)
            }
            Node::Product { coefficient, factors } => {
                let mut powers = Vec::with_capacity(factors.len());
                for (base, exponent) in factors.iter() {
                    self.open_root(known[base], exponent, facts, &mut powers);
                }
                let product = self.product(&powers);
                self.scale(coefficient, product)
            }
            Node::Apply(function, x) => self.assuming_function(function, known[&x], facts),
            Node::Apply2(function, x, y) => self.assuming_pair(function, known[&x], known[&y], facts),
        }
    }

    /// Takes factors that are not negative out of a root.
    fn open_root(
        &mut self,
        base: ExprId,
        exponent: &Rational,
        facts: &Facts,
        powers: &mut Vec<(ExprId, Rational)>,
    ) {
        let Node::Product { coefficient, factors } = self.node(base).clone() else {
            return powers.push((base, exponent.clone()));
        };
        if exponent.is_integer() {
            return powers.push((base, exponent.clone()));
        }
        let mut rest = Vec::new();
        for (inner, power) in factors.iter().cloned() {
            if self.range(inner, facts).low >= 0.0 {
                powers.push((inner, power * exponent.clone()));
            } else {
                rest.push((inner, power));
            }
        }
        let rest = self.product(&rest);
        let rest = self.scale(coefficient, rest);
        powers.push((rest, exponent.clone()));
    }

    fn assuming_function(&mut self, function: Function, x: ExprId, facts: &Facts) -> ExprId {
        let range = self.range(x, facts);
        match function {
            Function::Abs if range.low >= 0.0 => x,
            Function::Abs if range.high <= 0.0 => self.neg(x),
            Function::Sign if range.is_positive() => self.one(),
            Function::Sign if range.high <= 0.0 && range.nonzero => self.number(-1),
            _ => self.apply(function, x),
        }
    }

    fn assuming_pair(&mut self, function: Function2, x: ExprId, y: ExprId, facts: &Facts) -> ExprId {
        let difference = self.sub(x, y);
        let range = self.range(difference, facts);
        match function {
            Function2::Min if range.low >= 0.0 => y,
            Function2::Min if range.high <= 0.0 => x,
            Function2::Max if range.low >= 0.0 => x,
            Function2::Max if range.high <= 0.0 => y,
            _ => self.apply2(function, x, y),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::Range;

    #[test]
    fn roots_and_signs_under_facts() {
        let mut g = Graph::new();
        let (m, x) = (g.new_symbol("m"), g.new_symbol("x"));
        let (em, ex) = (g.symbol(m), g.symbol(x));
        let facts = Facts { symbols: [(m, Range::POSITIVE)].into_iter().collect(), ..Facts::default() };
        let (mm, xx) = (g.square(em), g.square(ex));
        let product = g.mul(mm, xx);
        let root = g.sqrt(product);
        let absolute = g.apply(Function::Abs, em);
        let sign = g.apply(Function::Sign, em);
        let opened = g.assuming(&[root, absolute, sign], &facts);
        assert_eq!(g.text(opened[0]), "m*sqrt(x^2)");
        assert_eq!(opened[1], em);
        assert_eq!(g.text(opened[2]), "1");
        assert_eq!(g.assuming(&[root], &Facts::default()), [root]);
    }
}
