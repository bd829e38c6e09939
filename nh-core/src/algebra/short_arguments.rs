//! Arguments of functions in their short form: `sin((m x + n x)/(m + n))` is `sin(x)`.
//!
//! Expressions that are derived are simplified, inside of functions as well, and the zero test knows identities between
//! arguments that are polynomials. So the others are put in their short form where they are declared: what is derived
//! and what is compared with it then contain the same functions.

use super::graph::Graph;
use super::node::Node;
use super::number::Rational;
use crate::id::ExprId;
use rustc_hash::FxHashSet;

impl Graph {
    /// An argument of a function, or what it is equal to with fewer operations.
    pub(super) fn short_argument(&mut self, x: ExprId) -> ExprId {
        if !self.may_cancel(x) {
            return x;
        }
        let short = self.simplify(x);
        if self.operation_count(&[short]) < self.operation_count(&[x]) { short } else { x }
    }

    /// Whether there are terms, and divisions or products with functions, of which some may cancel.
    fn may_cancel(&self, x: ExprId) -> bool {
        let (mut open, mut seen) = (vec![x], FxHashSet::default());
        let [mut has_sums, mut has_divisions, mut has_functions, mut has_products] = [false; 4];
        while let Some(id) = open.pop() {
            let parts = match self.node(id) {
                Node::Sum { terms, .. } => {
                    has_sums = true;
                    terms
                }
                Node::Product { factors, .. } => {
                    let is_atom = |(base, _): &(ExprId, Rational)| self.as_symbol(*base).is_some();
                    let is_one = |(_, exponent): &(ExprId, Rational)| exponent.is_one();
                    has_divisions |= factors.iter().any(|(_, exponent)| exponent.is_negative());
                    has_products |=
                        !factors.iter().all(is_atom) && (factors.len() > 1 || !factors.iter().all(is_one));
                    factors
                }
                // what stands inside of it was looked at before
                Node::Apply(..) | Node::Apply2(..) => {
                    has_functions = true;
                    continue;
                }
                _ => continue,
            };
            open.extend(parts.iter().map(|(part, _)| *part).filter(|part| seen.insert(*part)));
        }
        has_sums && (has_divisions || (has_functions && has_products))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::{Facts, Function};

    #[test]
    fn arguments_lose_what_cancels() {
        let mut g = Graph::new();
        let [m, n, x] = ["m", "n", "x"].map(|name| g.new_symbol(name)).map(|symbol| g.symbol(symbol));
        let mean = g.formula((m * x + n * x) / (m + n));
        let (sin, cos, two) = (g.sin(x), g.cos(x), g.number(2));
        let one = g.formula(sin * sin + cos * cos);
        let turned = g.formula(x * one);
        let sum = g.formula(m * x + n * x);
        let functions = [(mean, x), (turned, x), (sum, sum), (x, x)].map(|(long, short)| {
            let (long, short) = (g.apply(Function::Exp, long), g.apply(Function::Exp, short));
            let nested = g.formula(two * long + x);
            (nested, g.formula(two * short + x))
        });
        for (long, short) in functions {
            assert_eq!(g.assuming(&[long], &Facts::default()), [short]);
        }
        let mut long = Vec::new();
        let exponentials = [mean, sum].map(|x| g.apply(Function::Exp, x));
        g.assuming_and_noting(&exponentials, &Facts::default(), &mut long);
        assert_eq!(long, [mean]);
    }
}
