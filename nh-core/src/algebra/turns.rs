//! How many times points of the circle, and units of the exponential, are multiplied for an argument: its terms are
//! multiplied out as in `circle.rs`, and their coefficients say so.

use super::circle::{BUDGET, DEEPEST, times_multiplied_out};
use super::graph::Graph;
use super::node::Node;
use super::number::Rational;
use crate::id::{ExprId, SymbolId};
use rustc_hash::FxHashMap;

impl Graph {
    /// How many times units of the circle, or of the exponential, are multiplied at most for an argument, where symbols
    /// may stand for expressions.
    pub(crate) fn angle_turns(&self, x: ExprId, division: i64, images: &FxHashMap<SymbolId, ExprId>) -> f64 {
        let of_division = Rational::from(division).to_f64();
        let mut turns = 0.0;
        for (term, coefficient) in self.angle_terms(x) {
            let scaled = coefficient * Rational::from(division);
            let times = scaled.to_i64().map_or(of_division, |_| scaled.abs().to_f64());
            turns += match term.and_then(|term| self.expanded_weight(term, DEEPEST, images)) {
                // a term whose coefficient is a fraction of the division takes the division
                Some(weight) => times * weight + of_division * f64::from(BUDGET),
                None => times,
            };
        }
        turns
    }

    /// The sum of the magnitudes of the coefficients that a term is multiplied out to at most, if it is.
    fn expanded_weight(
        &self,
        term: ExprId,
        levels: u32,
        images: &FxHashMap<SymbolId, ExprId>,
    ) -> Option<f64> {
        if let Some(image) = self.as_symbol(term).and_then(|symbol| images.get(&symbol)) {
            return Some(self.terms_weight(*image, levels, images));
        }
        let Node::Product { factors, .. } = self.node(term) else { return None };
        let mut weight = None;
        for (base, exponent) in factors.iter() {
            let inside = match self.as_symbol(*base) {
                Some(symbol) => images.get(&symbol).map(|image| self.terms_weight(*image, levels, images)),
                None => matches!(self.node(*base), Node::Sum { .. })
                    .then(|| self.sum_weight(*base, levels, images)),
            };
            if let (Some(inside), Some(times)) = (inside, times_multiplied_out(exponent)) {
                weight = Some(weight.unwrap_or(1.0) * inside.powi(times));
            }
        }
        weight
    }

    /// The same of all terms of an argument together.
    fn terms_weight(&self, x: ExprId, levels: u32, images: &FxHashMap<SymbolId, ExprId>) -> f64 {
        let weights = self.angle_terms(x).into_iter().map(|(term, coefficient)| {
            let inside = term.and_then(|term| self.expanded_weight(term, levels, images)).unwrap_or(1.0);
            coefficient.abs().to_f64() * inside
        });
        weights.sum()
    }

    /// The same of a sum inside of a product.
    fn sum_weight(&self, x: ExprId, levels: u32, images: &FxHashMap<SymbolId, ExprId>) -> f64 {
        let is_image = |symbol| images.contains_key(&symbol);
        let weights = self.angle_terms(x).into_iter().map(|(term, coefficient)| {
            let inside = term.filter(|term| self.multiplies_out(*term, levels, is_image));
            let inside = inside.and_then(|term| self.expanded_weight(term, levels.saturating_sub(1), images));
            coefficient.abs().to_f64() * inside.unwrap_or(1.0)
        });
        weights.sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `cos(3 k (a + 2 b)^2)` has nine times 3 turns, and what it is multiplied out to may be fractions of the division.
    #[test]
    fn turns_are_those_of_the_terms_that_arguments_are_multiplied_out_to() {
        let mut g = Graph::new();
        let [k, a, b, v] = ["k", "a", "b", "v"].map(|name| g.new_symbol(name));
        let [k, a, b, image] = [k, a, b, v].map(|symbol| g.symbol(symbol));
        let (two, three) = (Rational::from(2), Rational::from(3));
        let beside = f64::from(BUDGET);
        let none = FxHashMap::default();
        let sum = g.formula(a + b * two.clone());
        let square = g.formula(k * sum * sum * three.clone());
        assert_eq!(g.angle_turns(square, 1, &none).to_bits(), (27.0 + beside).to_bits());
        assert_eq!(g.angle_turns(sum, 2, &none).to_bits(), 6.0_f64.to_bits());
        // (3 (a + 2 b) k + a)^2 inside of a product: ten times ten
        let inner = g.formula(k * sum * three + a);
        let nested = g.formula(b * inner * inner);
        assert_eq!(g.angle_turns(nested, 1, &none).to_bits(), (100.0 + beside).to_bits());
        // v stands for 2 a + k b, a sum of weight 3
        let stands_for = g.formula(a * two + k * b);
        let images: FxHashMap<_, _> = [(v, stands_for)].into_iter().collect();
        let with_image = g.formula(k * image * image * image);
        assert_eq!(g.angle_turns(with_image, 1, &images).to_bits(), (27.0 + beside).to_bits());
        assert_eq!(g.angle_turns(with_image, 1, &none).to_bits(), 1.0_f64.to_bits());
    }

    /// Each of a chain of products of sums is above two of the one before.
    #[test]
    fn a_chain_of_products_of_sums_is_no_tree() {
        let mut g = Graph::new();
        let [a, b] = ["a", "b"].map(|name| {
            let symbol = g.new_symbol(name);
            g.symbol(symbol)
        });
        let mut chain = a;
        for _ in 0..200 {
            let (left, right) = (g.formula(chain + a), g.formula(chain + b));
            chain = g.formula(left * right);
        }
        assert!(g.angle_turns(chain, 1, &FxHashMap::default()).is_finite());
    }
}
