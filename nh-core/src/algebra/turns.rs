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

    /// The sum of the magnitudes of the coefficients that a term is multiplied out to at most, if it is: 1 at least, as it
    /// stays whole where that takes too many terms.
    fn expanded_weight(
        &self,
        term: ExprId,
        levels: u32,
        images: &FxHashMap<SymbolId, ExprId>,
    ) -> Option<f64> {
        let of_image = |symbol| {
            let image = images.get(&symbol)?;
            Some(self.terms_weight(*image, |term| self.expanded_weight(term, levels, images)))
        };
        // a sum inside of a product
        let of_sum = |x: ExprId| {
            let is_multiplied_out =
                |term| self.multiplies_out(term, levels, |symbol| images.contains_key(&symbol));
            let inside = |term| {
                let levels = levels.saturating_sub(1);
                is_multiplied_out(term).then(|| self.expanded_weight(term, levels, images)).flatten()
            };
            matches!(self.node(x), Node::Sum { .. }).then(|| self.terms_weight(x, inside))
        };
        let of = |x: ExprId| self.as_symbol(x).map_or_else(|| of_sum(x), of_image);
        let weight = match self.node(term) {
            Node::Product { factors, .. } => {
                let multiplied_out = factors.iter().filter_map(|(base, exponent)| {
                    let times = times_multiplied_out(exponent)?;
                    Some(of(*base)?.powi(times))
                });
                multiplied_out.reduce(|product, weight| product * weight)?
            }
            _ => of_image(self.as_symbol(term)?)?,
        };
        Some(weight.max(1.0))
    }

    /// The magnitudes of the coefficients of terms, each times what is inside of the term, or 1.
    fn terms_weight(&self, x: ExprId, inside: impl Fn(ExprId) -> Option<f64>) -> f64 {
        let weights = self
            .angle_terms(x)
            .into_iter()
            .map(|(term, coefficient)| coefficient.abs().to_f64() * term.and_then(&inside).unwrap_or(1.0));
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
        // what stays whole has all of its turns
        let halves = g.formula(a * Rational::new(1, 2) + b * Rational::new(1, 4));
        let images: FxHashMap<_, _> = [(v, halves)].into_iter().collect();
        let thousand = g.formula(with_image * Rational::from(1000));
        assert!(g.angle_turns(thousand, 1, &images) >= 1000.0);
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
