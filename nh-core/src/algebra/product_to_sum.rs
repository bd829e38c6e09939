//! Products of sines and cosines as sums:
//!
//! | identity | condition |
//! |---|---|
//! | `2 cos x cos y = cos(x − y) + cos(x + y)` and its kin | – |

use super::graph::Graph;
use super::node::{Function, Node};
use super::number::Rational;
use crate::id::ExprId;

/// Products with more sines and cosines are left as they are.
const FACTORS: usize = 3;

impl Graph {
    /// The expression with the products of sines and cosines in its terms written as sums, if that
    /// takes less work: `sin a cos b − cos a sin b` becomes `sin(a − b)`. A sine or cosine times a sum
    /// is multiplied out for that.
    pub fn products_to_sums(&mut self, e: ExprId) -> ExprId {
        let (constant, terms) = self.as_linear(e);
        let one = self.one();
        let mut summands = vec![(constant, one)];
        for (term, coefficient) in terms {
            for (part, times) in self.spread(term) {
                let sum = self.linearised(part).unwrap_or(part);
                summands.push((coefficient.clone() * times, sum));
            }
        }
        let result = self.linear_combination(&summands);
        if self.operation_count(&[result]) < self.operation_count(&[e]) { result } else { e }
    }

    /// The same with what is inside of products first, as a rotation of a rotation is.
    pub fn nested_products_to_sums(&mut self, e: ExprId) -> ExprId {
        let (constant, terms) = self.as_linear(e);
        let one = self.one();
        let mut summands = vec![(constant, one)];
        for (term, times) in terms {
            let Node::Product { coefficient, factors } = self.node(term).clone() else {
                summands.push((times, term));
                continue;
            };
            let inside = factors.iter().map(|(base, exponent)| {
                let is_sum = exponent.is_one() && matches!(self.node(*base), Node::Sum { .. });
                (if is_sum { self.nested_products_to_sums(*base) } else { *base }, exponent.clone())
            });
            let inside: Vec<_> = inside.collect();
            summands.push((times * coefficient, self.product(&inside)));
        }
        let inside = self.linear_combination(&summands);
        self.multiplied_out(inside)
    }

    /// As [`products_to_sums`](Self::products_to_sums), with sums of sums multiplied out.
    fn multiplied_out(&mut self, e: ExprId) -> ExprId {
        let (constant, mut open) = self.as_linear(e);
        let one = self.one();
        let mut summands = vec![(constant, one)];
        while let Some((term, coefficient)) = open.pop() {
            match self.spread(term).as_slice() {
                [(same, _)] if *same == term => {
                    let sum = self.linearised(term).unwrap_or(term);
                    summands.push((coefficient, sum));
                }
                parts => open
                    .extend(parts.iter().map(|(part, times)| (*part, coefficient.clone() * times.clone()))),
            }
        }
        let result = self.linear_combination(&summands);
        if self.operation_count(&[result]) < self.operation_count(&[e]) { result } else { e }
    }

    /// A product of sines or cosines with one sum as its terms, any other expression as it is.
    fn spread(&mut self, term: ExprId) -> Vec<(ExprId, Rational)> {
        let whole = vec![(term, Rational::ONE)];
        let Node::Product { coefficient, factors } = self.node(term).clone() else { return whole };
        let is_harmonic = |graph: &Self, base: ExprId| {
            matches!(graph.node(base), Node::Apply(Function::Sin | Function::Cos, _))
        };
        let (sums, others): (Vec<_>, Vec<_>) = factors
            .iter()
            .cloned()
            .partition(|(base, exponent)| exponent.is_one() && matches!(self.node(*base), Node::Sum { .. }));
        let [(sum, _)] = *sums else { return whole };
        if !others.iter().any(|(base, _)| is_harmonic(self, *base)) {
            return whole;
        }
        let outside = self.product(&others);
        let (constant, terms) = self.as_linear(sum);
        let mut parts = vec![(outside, constant * coefficient.clone())];
        parts.extend(
            terms.into_iter().map(|(inside, times)| (self.mul(outside, inside), times * coefficient.clone())),
        );
        parts
    }

    /// One product as a sum; `None` if it has fewer than two sines and cosines, or too many.
    fn linearised(&mut self, term: ExprId) -> Option<ExprId> {
        let Node::Product { coefficient, factors } = self.node(term).clone() else { return None };
        let mut angles: Vec<(Function, ExprId)> = Vec::new();
        let mut rest: Vec<(ExprId, Rational)> = Vec::new();
        for (base, exponent) in factors.iter() {
            let times = exponent.to_i64().filter(|n| (1..=2).contains(n));
            match (self.node(*base), times) {
                (Node::Apply(function @ (Function::Sin | Function::Cos), angle), Some(times)) => {
                    angles.extend((0..times).map(|_| (*function, *angle)));
                }
                _ => rest.push((*base, exponent.clone())),
            }
        }
        if !(2..=FACTORS).contains(&angles.len()) {
            return None;
        }
        let (first, others) = angles.split_first()?;
        // a sum Σ c f(x), multiplied by one factor after the other
        let mut sum = vec![(Rational::ONE, *first)];
        for (g, y) in others {
            let mut product = Vec::new();
            for (c, (f, x)) in sum {
                let half = c * Rational::new(1, 2);
                let difference = self.sub(x, *y);
                let total = self.add(x, *y);
                let minus = -half.clone();
                product.extend(match (f, g) {
                    (Function::Cos, Function::Cos) => {
                        [(half.clone(), (Function::Cos, difference)), (half, (Function::Cos, total))]
                    }
                    (Function::Sin, Function::Sin) => {
                        [(half, (Function::Cos, difference)), (minus, (Function::Cos, total))]
                    }
                    (Function::Sin, _) => {
                        [(half.clone(), (Function::Sin, difference)), (half, (Function::Sin, total))]
                    }
                    _ => [(minus, (Function::Sin, difference)), (half, (Function::Sin, total))],
                });
            }
            sum = product;
        }
        let factor = self.product(&rest);
        let terms: Vec<(Rational, ExprId)> = sum
            .into_iter()
            .map(|(c, (function, angle))| {
                let value = self.apply(function, angle);
                (c * coefficient.clone(), self.mul(factor, value))
            })
            .collect();
        Some(self.linear_combination(&terms))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn differences_of_angles_come_out() {
        let mut g = Graph::new();
        let [a, b, d] = ["a", "b", "d"].map(|name| {
            let symbol = g.new_symbol(name);
            g.symbol(symbol)
        });
        let (sa, ca, sb, cb) = (g.sin(a), g.cos(a), g.sin(b), g.cos(b));
        let (first, second) = (g.product(&[d, sa, cb].map(|f| (f, Rational::ONE))), g.mul(ca, sb));
        let second = g.mul(d, second);
        let difference = g.sub(first, second);
        let angle = g.sub(a, b);
        let sine = g.sin(angle);
        let expected = g.mul(d, sine);
        assert_eq!(g.products_to_sums(difference), expected);
        let (ss, cc) = (g.square(sa), g.square(ca));
        let unit = g.add(ss, cc);
        let one = g.one();
        assert_eq!(g.products_to_sums(unit), one);
        // alone a product stays what it is
        assert_eq!(g.products_to_sums(first), first);
        // sin a (d cos b + 1) − d cos a sin b
        let inside = g.mul(d, cb);
        let inside = g.add(inside, one);
        let product = g.mul(sa, inside);
        let whole = g.sub(product, second);
        let expected = g.add(expected, sa);
        assert_eq!(g.products_to_sums(whole), expected);
    }

    #[test]
    fn rotations_of_rotations_come_out() {
        let mut g = Graph::new();
        let [a, b, d, h] = ["a", "b", "d", "h"].map(|name| {
            let symbol = g.new_symbol(name);
            g.symbol(symbol)
        });
        let (sum, both) = (g.add(a, b), g.add(d, h));
        let (sa, ca, sb, cb) = (g.sin(a), g.cos(a), g.sin(b), g.cos(b));
        let (sin, cos) = (g.sin(sum), g.cos(sum));
        // sin(a + b) (h + cos b (d + h)) − cos(a + b) sin b (d + h), a sum in a sum
        let expression = g.formula(sin * (h + cb * both) - cos * (sb * both));
        let expected = g.formula(sin * h + sa * d + sa * h);
        let found = g.nested_products_to_sums(expression);
        let difference = g.sub(found, expected);
        assert!(g.zero_test(difference).is_zero());
        assert!(g.operation_count(&[found]) <= g.operation_count(&[expected]), "{}", g.text(found));
        // (cos a cos b − sin a sin b) cos b + (sin a cos b + cos a sin b) sin b
        let (first, second) = (g.formula(ca * cb - sa * sb), g.formula(sa * cb + ca * sb));
        let expression = g.formula(first * cb + second * sb);
        assert_eq!(g.nested_products_to_sums(expression), ca);
    }
}
