//! Expressions that do not depend on symbols which occur in them.

use super::graph::Graph;
use super::node::{Function, Function2, Node};
use super::number::Rational;
use super::zero_test::sample;
use crate::id::{ExprId, SymbolId};
use std::collections::BTreeSet;

impl Graph {
    /// The expression where symbols that it does not depend on vanish, simplified: `(cos²θ + sin²θ) J` is
    /// `J`. `None` where it depends on all that occur, or where that divides by something else.
    ///
    /// That both are equal is proved by the zero test, from identities that the field knows: proofs of what is computed
    /// know no others.
    pub fn freed(&mut self, expression: ExprId) -> Option<ExprId> {
        let idle = self.seemingly_idle(expression, |_| true);
        let at_once = self.equal_at_zero(expression, &idle);
        let freed = at_once.or_else(|| {
            let mut freed = None;
            for symbol in idle {
                let next = self.equal_at_zero(freed.unwrap_or(expression), &[symbol]);
                freed = next.or(freed);
            }
            freed
        })?;
        let freed = self.simplify(freed);
        self.divisors(&[freed]).is_subset(&self.divisors(&[expression])).then_some(freed)
    }

    /// The expression where those of the symbols vanish that it holds and does not depend on, and these; nothing else in it
    /// changes. `None` where it depends on all that occur, or where that divides by something else.
    pub fn freed_of(&mut self, expression: ExprId, symbols: &[SymbolId]) -> Option<(ExprId, Vec<SymbolId>)> {
        if !self.depends_on(expression, symbols) {
            return None;
        }
        let idle = self.seemingly_idle(expression, |symbol| symbols.contains(&symbol));
        let freed = self.equal_at_zero(expression, &idle)?;
        self.divisors(&[freed]).is_subset(&self.divisors(&[expression])).then_some((freed, idle))
    }

    /// The bases of a product with their exponents; anything else is its own.
    #[must_use]
    pub fn factors(&self, expression: ExprId) -> Vec<(ExprId, Rational)> {
        match self.node(expression) {
            Node::Product { factors, .. } => factors.to_vec(),
            _ => vec![(expression, Rational::ONE)],
        }
    }

    /// What the expression divides by: the bases of negative powers.
    #[must_use]
    pub fn divisors(&self, roots: &[ExprId]) -> BTreeSet<ExprId> {
        let mut divisors = BTreeSet::new();
        self.each_reachable(roots, |id| {
            if let Node::Product { factors, .. } = self.node(id) {
                divisors.extend(factors.iter().filter(|(_, e)| e.is_negative()).map(|(base, _)| *base));
            }
            true
        });
        divisors
    }

    /// What vanishes where the expressions, or derivatives of them, may have no value: divisors, the bases of
    /// roots, the arguments of logarithms, and what inverse functions have under the root of their derivatives.
    pub fn singularities(&mut self, roots: &[ExprId]) -> BTreeSet<ExprId> {
        let mut found = self.divisors(roots);
        let one = self.one();
        for id in self.reachable(roots) {
            match self.node(id).clone() {
                Node::Product { factors, .. } => {
                    found.extend(factors.iter().filter(|(_, e)| !e.is_integer()).map(|(base, _)| *base));
                }
                Node::Apply(Function::Ln, x) => _ = found.insert(x),
                Node::Apply(Function::Asin | Function::Acos, x) => {
                    let square = self.square(x);
                    found.insert(self.sub(one, square));
                }
                Node::Apply2(Function2::Atan2, x, y) => {
                    let (xx, yy) = (self.square(x), self.square(y));
                    found.insert(self.add(xx, yy));
                }
                _ => {}
            }
        }
        found
    }

    /// The expression where the symbols vanish, if it is proved to be the same.
    fn equal_at_zero(&mut self, expression: ExprId, symbols: &[SymbolId]) -> Option<ExprId> {
        if symbols.is_empty() {
            return None;
        }
        let value = self.at_zero(expression, symbols);
        let difference = self.sub(expression, value);
        (!self.is_undefined(value) && self.vanishes_by_identity(difference)).then_some(value)
    }

    /// The symbols that occur in the expression, are asked about, and whose change is not felt at a point.
    fn seemingly_idle(&self, expression: ExprId, is_asked: impl Fn(SymbolId) -> bool) -> Vec<SymbolId> {
        let roots = [expression];
        let symbols = self.symbols_in(&roots);
        let asked: Vec<SymbolId> = symbols.iter().copied().filter(|symbol| is_asked(*symbol)).collect();
        let at = |symbol: SymbolId| sample(0, symbols.binary_search(&symbol).unwrap_or(0));
        let points = std::iter::once(None).chain(asked.iter().map(|symbol| Some(*symbol)));
        let points = points.map(|moved| {
            move |symbol: SymbolId| if moved == Some(symbol) { at(symbol) + MOVED } else { at(symbol) }
        });
        let mut values = self.evaluate_each(&roots, points).map(|values| values[0]);
        let Some(unmoved) = values.next() else { return Vec::new() };
        let feels = |value: super::Bounded| (value.value - unmoved.value).abs() > value.error + unmoved.error;
        let idle = asked.iter().zip(values).filter(|(_, value)| !feels(*value));
        idle.map(|(symbol, _)| *symbol).collect()
    }
}

/// How far a symbol is moved to see whether an expression feels it.
const MOVED: f64 = 0.375;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_felt_is_set_to_zero_among_the_symbols_that_are_named() {
        let mut g = Graph::new();
        let symbols = ["x", "y", "m"].map(|name| g.new_symbol(name));
        let [x, y, m] = symbols.map(|symbol| g.symbol(symbol));
        let (sin, cos) = (g.sin(x), g.cos(x));
        // m (cos x − y sin x)² + m (sin x + y cos x)² is m (1 + y²)
        let along = g.formula(cos - y * sin);
        let across = g.formula(sin + y * cos);
        let energy = g.formula(m * along.square() + m * across.square());
        let freed = g.formula(m + m * y.square());
        assert_eq!(g.freed_of(energy, &symbols[..2]), Some((freed, vec![symbols[0]])));
        assert_eq!(g.freed_of(energy, &symbols[1..]), None);
        // it depends on x by the last term
        let bent = g.formula(energy + sin);
        assert_eq!(g.freed_of(bent, &symbols), None);
        // 0/0 at x = 0
        let quotient = g.formula((m * sin) / (sin * m + sin));
        assert_eq!(g.freed_of(quotient, &symbols), None);
    }

    #[test]
    fn what_cancels_is_gone() {
        let mut g = Graph::new();
        let [x, m, j] = ["x", "m", "J"].map(|name| {
            let symbol = g.new_symbol(name);
            g.symbol(symbol)
        });
        let (sin, cos) = (g.sin(x), g.cos(x));
        let (ss, cc) = (g.square(sin), g.square(cos));
        // J + m cos² − m² cos² sin² / (m sin²) − … leaves J alone, though all is divided by m sin²
        let heavy = g.mul(m, ss);
        let product = g.mul(cc, ss);
        let square = g.square(m);
        let numerator = g.mul(square, product);
        let quotient = g.div(numerator, heavy);
        let one = g.one();
        let sum = g.linear_combination(&[(Rational::ONE, ss), (Rational::ONE, cc), (-Rational::ONE, one)]);
        let hidden = g.mul(sum, m);
        let light = g.mul(m, cc);
        let pivot = g.linear_combination(&[
            (Rational::ONE, j),
            (Rational::ONE, light),
            (-Rational::ONE, quotient),
            (Rational::ONE, hidden),
        ]);
        assert_eq!(g.freed(pivot), Some(j));
        assert_eq!(g.freed(heavy), None);
        // m / (m + J) + J / (m + J) is one, and 0/0 where both vanish
        let total = g.add(m, j);
        let (first, second) = (g.div(m, total), g.div(j, total));
        let sum = g.add(first, second);
        let shares = g.mul(x, sum);
        assert_eq!(g.freed(shares), Some(x));
    }
}
