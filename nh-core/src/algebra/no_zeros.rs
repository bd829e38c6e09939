//! Whether an expression has no real zeros, asked of more than its range: `x (x − 4) + 5` has none, whatever the ranges of
//! its terms say.

use super::graph::Graph;
use super::inequalities::Demand;
use super::node::Node;
use super::range::{Facts, Range};
use crate::id::ExprId;

impl Range {
    /// What a value in it satisfies.
    fn demand(self, value: ExprId) -> Option<(ExprId, Demand)> {
        let demand = match (self.low >= 0.0, self.nonzero) {
            (true, true) => Demand::Positive,
            (true, false) => Demand::NotNegative,
            (false, true) => Demand::Nonzero,
            (false, false) => return None,
        };
        Some((value, demand))
    }
}

impl Graph {
    /// Whether the expression vanishes nowhere within the facts, by its range or because nothing satisfies that it is 0.
    pub(crate) fn has_no_zeros(&mut self, expression: ExprId, facts: &Facts) -> bool {
        if self.vanishes_nowhere(expression, facts) {
            return true;
        }
        // most change their signs, and it is seen soon
        if !matches!(self.node(expression), Node::Sum { .. }) || self.has_both_signs(expression, &[]) {
            return false;
        }
        let mut demands = self.demands_of(facts, expression);
        demands.push((expression, Demand::Zero));
        self.contradiction(&demands).is_some()
    }

    /// The facts about the symbols of an expression.
    fn demands_of(&mut self, facts: &Facts, expression: ExprId) -> Vec<(ExprId, Demand)> {
        let mut demands = Vec::new();
        for symbol in self.symbols_in(&[expression]) {
            let Some(range) = facts.symbols.get(&symbol) else { continue };
            let value = self.symbol(symbol);
            demands.extend(range.demand(value));
            if range.high <= 0.0 {
                let opposite = self.neg(value);
                demands
                    .extend(Range { low: 0.0, high: f64::INFINITY, nonzero: range.nonzero }.demand(opposite));
            }
        }
        let mut known: Vec<(ExprId, Demand)> =
            facts.expressions.iter().filter_map(|(known, range)| range.demand(*known)).collect();
        known.sort_unstable_by_key(|(known, _)| *known);
        demands.extend(self.related_demands(&known, &[expression]));
        demands
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn squares_are_completed_and_zeros_are_not_overlooked() {
        let mut g = Graph::new();
        let [x, l] = ["x", "l"].map(|name| g.new_symbol(name));
        let facts = Facts { symbols: [(l, Range::POSITIVE)].into_iter().collect(), ..Facts::default() };
        let (x, l) = (g.symbol(x), g.symbol(l));
        let [one, four, five] = [1, 4, 5].map(|number| g.number(number));
        for (expression, none) in [
            (g.formula(x * (x - four) + five), true),
            (g.formula(x * (x - four) + four), false),
            (g.formula(x * (x - five) + five), false),
            (g.formula(x * (x - l) + l * l), true),
            (g.formula(x * x - x + l), false),
            (g.formula(x * x * x + one), false),
        ] {
            assert_eq!(g.has_no_zeros(expression, &facts), none, "{}", g.text(expression));
        }
    }
}
