//! Differences of functions in which shared terms cancel.

use super::graph::Graph;
use super::number::Rational;
use crate::id::{ExprId, SymbolId};
use std::collections::BTreeSet;

/// More multiples are not tried.
const TRIED: usize = 4;

impl Graph {
    /// A function less a multiple of another, if it depends on less than the function by itself: as x² + (z − s)² − l² less
    /// x² + z² − l² does, which is s (s − 2 z).
    pub fn less_a_multiple(&mut self, function: ExprId, other: ExprId) -> Option<ExprId> {
        let symbols: BTreeSet<SymbolId> = self.symbols_in(&[function]).into_iter().collect();
        if self.symbols_in(&[other]).iter().all(|symbol| !symbols.contains(symbol)) {
            return None;
        }
        let (terms, others) = (self.polynomial_terms(function)?, self.polynomial_terms(other)?);
        let mut multiples: Vec<Rational> = Vec::new();
        for (monomial, coefficient) in terms.iter().filter(|(monomial, _)| !monomial.is_empty()) {
            let Some(inverse) = others.get(monomial).and_then(Rational::recip) else { continue };
            let multiple = coefficient.clone() * inverse;
            if !multiples.contains(&multiple) {
                multiples.push(multiple);
            }
        }
        let differences: Vec<ExprId> = multiples
            .into_iter()
            .take(TRIED)
            .map(|multiple| {
                let difference = self.linear_combination(&[(Rational::ONE, function), (-multiple, other)]);
                self.simplify(difference)
            })
            .collect();
        differences.into_iter().find(|difference| {
            let left = self.symbols_in(&[*difference]);
            left.len() < symbols.len() && left.iter().all(|symbol| symbols.contains(symbol))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The links of a governor less its arms; and what shares no term, or gets a further symbol.
    #[test]
    fn what_is_left_depends_on_less() {
        let mut g = Graph::new();
        let [x, z, s, l, r] = ["x", "z", "s", "l", "r"].map(|name| {
            let symbol = g.new_symbol(name);
            g.symbol(symbol)
        });
        let arm = g.formula(x * x + z * z - l * l);
        let link = g.formula(x * x + (z - s) * (z - s) - l * l);
        let [arm, link] = [arm, link].map(|function| g.simplify(function));
        let left = g.less_a_multiple(link, arm).expect("shorter");
        let wanted = g.formula(s * (s - 2 * z));
        let difference = g.formula(left - wanted);
        assert!(g.zero_test(difference).is_zero());
        let doubled = g.formula(2 * arm);
        assert!(g.less_a_multiple(link, doubled).is_some());
        let other = g.formula(x * x + z * z - r * r);
        assert!(g.less_a_multiple(link, other).is_none());
        let apart = g.formula(r * r - s);
        assert!(g.less_a_multiple(arm, apart).is_none());
    }
}
