//! Squares in disguise: something whose square divides an expression.

use super::branches::wide;
use super::graph::Graph;
use super::node::{Function, Node};
use super::number::Rational;
use super::zero_test::sample;
use crate::id::{ExprId, SymbolId};

/// Points at which signs are looked at.
const POINTS: u64 = 48;

impl Graph {
    /// A function f that is not a number or made of `fixed` symbols alone, whose square is the expression up to a factor: where it is
    /// quadratic in a symbol with discriminant 0, or sin², cos² or sinh² by the theorem of Pythagoras.
    pub fn square_factor(&mut self, expression: ExprId, fixed: &[SymbolId]) -> Option<ExprId> {
        let symbols = self.symbols_in(&[expression]);
        let free = symbols.iter().filter(|symbol| !fixed.contains(symbol));
        for symbol in free.copied().collect::<Vec<_>>() {
            let first = self.partial(expression, symbol);
            let second = self.partial(first, symbol);
            let third = self.partial(second, symbol);
            if !self.zero_test(third).is_zero() || !self.zero_test(second).is_nonzero() {
                continue;
            }
            // b² = 4 a c for a x² + b x + c
            let (b, c) = (self.at_zero(first, &[symbol]), self.at_zero(expression, &[symbol]));
            let (bb, ac) = (self.square(b), self.mul(second, c));
            let discriminant = self.linear_combination(&[(Rational::ONE, bb), ((-2).into(), ac)]);
            if !self.is_undefined(discriminant) && self.zero_test(discriminant).is_zero() {
                let factor = self.simplify(first);
                let content = self.content(factor).recip().unwrap_or(Rational::ONE);
                let (_, factor) = self.split_coefficient(factor);
                return Some(self.scale(content, factor));
            }
        }
        let candidates: Vec<(Function, ExprId)> = self
            .reachable(&[expression])
            .into_iter()
            .filter_map(|id| match self.node(id) {
                Node::Apply(Function::Cos, x) => Some((Function::Sin, *x)),
                Node::Apply(Function::Sin, x) => Some((Function::Cos, *x)),
                Node::Apply(Function::Cosh, x) => Some((Function::Sinh, *x)),
                _ => None,
            })
            .collect();
        candidates.into_iter().find_map(|(function, x)| {
            let candidate = self.apply(function, x);
            let square = self.square(candidate);
            let defect = self.sub(expression, square);
            self.zero_test(defect).is_zero().then_some(candidate)
        })
    }

    /// Whether the expression is certainly positive at one of some points, and negative at another: numbers of order one
    /// for the `fixed` symbols, and for the others of order one and in many decades.
    #[must_use]
    pub fn has_both_signs(&self, expression: ExprId, fixed: &[SymbolId]) -> bool {
        let symbols = self.symbols_in(&[expression]);
        let mut evaluator = self.evaluator(&[expression]);
        let (mut positive, mut negative) = (false, false);
        for attempt in 0..2 * POINTS {
            let value = |symbol| {
                let index = symbols.iter().position(|known| *known == symbol).unwrap_or(0);
                if attempt < POINTS || fixed.contains(&symbol) {
                    sample(attempt, index)
                } else {
                    wide(attempt, index)
                }
            };
            let found = evaluator.at(value)[0];
            if found.is_certainly_nonzero() {
                positive |= found.value > 0.0;
                negative |= found.value < 0.0;
            }
            if positive && negative {
                return true;
            }
        }
        false
    }
}
