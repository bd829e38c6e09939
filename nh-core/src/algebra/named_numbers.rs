//! Constants in expressions: made, replaced by their numbers, and cancelled by their values.

use super::constants::{Constant, Rest};
use super::graph::Graph;
use super::node::Node;
use super::number::Rational;
use super::substitute::Substitution;
use crate::id::{ConstantId, ExprId, Table};
use rustc_hash::FxHashMap;

impl Graph {
    /// Introduces a constant. Two constants are never the same expression, whatever their values.
    pub fn new_constant(&mut self, constant: Constant) -> ConstantId {
        self.constants.table.push(constant)
    }

    /// The constants, with their names and values.
    #[must_use]
    pub fn constants(&self) -> &Table<ConstantId, Constant> {
        &self.constants.table
    }

    /// The expression that is just a constant.
    pub fn constant(&mut self, constant: ConstantId) -> ExprId {
        self.intern(Node::Constant(constant))
    }

    /// The value of an expression that is made of numbers and constants alone, by sums, products and
    /// integer powers.
    #[must_use]
    pub fn value_of(&self, id: ExprId) -> Option<&Rational> {
        self.as_number(id).or_else(|| self.constants.values.get(&id))
    }

    /// The number that an expression is a multiple of by its constants, as far as it is a product of
    /// them and of something else.
    pub(super) fn constant_factor(&self, id: ExprId) -> Rational {
        if self.constants.table.is_empty() {
            return Rational::ONE;
        }
        match self.node(id) {
            Node::Constant(constant) => self.constants.table[*constant].value.clone(),
            Node::Product { factors, .. } => {
                let powers = factors
                    .iter()
                    .filter_map(|(base, exponent)| self.constants.values.get(base)?.pow(exponent.to_i64()?));
                powers.fold(Rational::ONE, std::ops::Mul::mul)
            }
            _ => Rational::ONE,
        }
    }

    /// The expression with numbers for the constants.
    pub fn in_numbers(&mut self, expression: ExprId) -> ExprId {
        self.with_numbers(expression, |_| true)
    }

    /// The expression with numbers for the constants that are integers, as in sin(2x).
    pub fn in_integers(&mut self, expression: ExprId) -> ExprId {
        self.with_numbers(expression, Rational::is_integer)
    }

    fn with_numbers(&mut self, expression: ExprId, is_number: impl Fn(&Rational) -> bool) -> ExprId {
        if self.constants.table.is_empty() {
            return expression;
        }
        let mut numbers = Substitution::new([]);
        for id in self.reachable(&[expression]) {
            if let Node::Constant(constant) = self.node(id) {
                let value = self.constants.table[*constant].value.clone();
                if is_number(&value) {
                    let number = self.number(value);
                    numbers.insert_node(id, number);
                }
            }
        }
        numbers.apply(self, expression)
    }

    /// Drops terms that cancel for the values of the constants in them.
    pub(super) fn cancel_by_value(&self, constant: &mut Rational, terms: &mut Vec<(ExprId, Rational)>) {
        let constants = &self.constants;
        if constants.values.is_empty() || terms.is_empty() {
            return;
        }
        let mut sums: FxHashMap<Rest, Rational> = FxHashMap::default();
        sums.insert(Rest::new(), constant.clone());
        let mut rests = Vec::with_capacity(terms.len());
        for (term, coefficient) in terms.iter() {
            let (number, rest) = constants.split(self.node(*term), *term);
            let sum = sums.entry(rest.clone()).or_insert(Rational::ZERO);
            *sum = sum.clone() + coefficient.clone() * number;
            rests.push(rest);
        }
        let mut cancelled = rests.iter().map(|rest| sums[rest].is_zero());
        terms.retain(|_| !cancelled.next().unwrap_or(false));
        // a number among what cancels
        if sums[&Rest::new()].is_zero() {
            *constant = Rational::ZERO;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::{Facts, Verdict};

    fn constants<const N: usize>(g: &mut Graph, values: [(&str, i64, i64); N]) -> [ExprId; N] {
        values.map(|(name, n, d)| {
            let constant = g.new_constant(Constant { name: name.into(), value: Rational::new(n, d) });
            g.constant(constant)
        })
    }

    #[test]
    fn are_not_distributed() {
        let mut g = Graph::new();
        let [m] = constants(&mut g, [("m", 13, 10)]);
        let (x, y) = (g.new_symbol("x"), g.new_symbol("y"));
        let (x, y) = (g.symbol(x), g.symbol(y));
        let sum = g.add(x, y);
        let product = g.mul(m, sum);
        assert_eq!(g.text(product), "m*(x + y)");
        let numbers = g.in_numbers(product);
        assert_eq!(g.text(numbers), "13*x/10 + 13*y/10");
        let inverse = g.div(x, m);
        let back = g.mul(inverse, m);
        assert_eq!(back, x);
    }

    #[test]
    fn cancel_by_their_values() {
        let mut g = Graph::new();
        let [inertia, m, a] = constants(&mut g, [("J", 8, 25), ("m", 2, 1), ("a", 2, 5)]);
        let x = g.new_symbol("x");
        let x = g.symbol(x);
        let square = g.square(a);
        let steiner = g.mul(m, square);
        let (left, right) = (g.mul(inertia, x), g.mul(steiner, x));
        let difference = g.sub(left, right);
        assert!(g.is_literal_zero(difference));
        let difference = g.sub(inertia, steiner);
        assert!(g.is_literal_zero(difference));
        let two = g.number(2);
        let difference = g.sub(m, two);
        assert!(g.is_literal_zero(difference));
        let with_number = g.add(difference, x);
        assert_eq!(with_number, x);
        let sum = g.add(left, right);
        assert_eq!(g.text(sum), "J*x + m*a^2*x");
        assert_eq!(g.value_of(steiner), Some(&Rational::new(8, 25)));
    }

    #[test]
    fn are_numbers_to_proofs() {
        let mut g = Graph::new();
        let [k, l, m] = constants(&mut g, [("k", 2, 1), ("l", 4, 5), ("m", 3, 5)]);
        let x = g.new_symbol("x");
        let x = g.symbol(x);
        // sin(k x) = 2 sin x cos x
        let angle = g.mul(k, x);
        let (double, s, c) = (g.sin(angle), g.sin(x), g.cos(x));
        let product = g.mul(s, c);
        let twice = g.scale(Rational::from(2), product);
        let defect = g.sub(double, twice);
        assert_eq!(g.zero_test(defect), Verdict::Zero);
        // sin(x + l) with l = 4/5
        let (named, fifths) = (g.add(x, l), g.number(Rational::new(4, 5)));
        let plain = g.add(x, fifths);
        let (named, plain) = (g.cos(named), g.cos(plain));
        let defect = g.sub(named, plain);
        assert_eq!(g.zero_test(defect), Verdict::Zero);
        // l² + m² = 1
        let (ll, mm, one) = (g.square(l), g.square(m), g.one());
        let sum = g.add(ll, mm);
        let root = g.sqrt(sum);
        let defect = g.sub(root, one);
        assert_eq!(g.zero_test(defect), Verdict::Zero);
        let lower = g.sub(l, m);
        assert!(g.vanishes_nowhere(lower, &Facts::default()));
        let shifted = g.sub(x, m);
        assert!(g.zero_test(shifted).is_nonzero());
    }
}
