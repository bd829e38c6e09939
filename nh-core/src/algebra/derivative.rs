//! Derivatives on the graph, memoised: each distinct subexpression is differentiated once.

use super::graph::Graph;
use super::node::{Function, Function2, Node};
use super::number::Rational;
use crate::id::{ExprId, SymbolId};
use crate::id_map::IdMap;
use rustc_hash::FxHashMap;

/// A derivation: the linear map with the Leibniz rule that sends each symbol to its seed.
///
/// With one seed 1 it is a partial derivative; with seeds `ẋ^i` it is the derivative along a
/// vector field. Symbols without a seed are constants.
///
/// ```
/// use nonholonomic_core::algebra::{Derivation, Graph};
/// let mut g = Graph::new();
/// let x = g.new_symbol("x");
/// let e = { let x = g.symbol(x); g.square(x) };
/// let de = Derivation::partial(&mut g, x).apply(&mut g, e);
/// assert_eq!(g.text(de), "2*x");
/// ```
#[derive(Clone, Debug)]
pub struct Derivation {
    seeds: FxHashMap<SymbolId, ExprId>,
    known: IdMap<ExprId, ExprId>,
}

impl Derivation {
    /// The derivation with the given seeds.
    #[must_use]
    pub fn new(seeds: impl IntoIterator<Item = (SymbolId, ExprId)>) -> Self {
        Self { seeds: seeds.into_iter().collect(), known: IdMap::default() }
    }

    /// `∂/∂symbol`.
    #[must_use]
    pub fn partial(graph: &mut Graph, symbol: SymbolId) -> Self {
        let one = graph.one();
        Self::new([(symbol, one)])
    }

    /// Adds a seed for a symbol that has not occurred so far.
    pub fn insert(&mut self, symbol: SymbolId, seed: ExprId) {
        self.seeds.insert(symbol, seed);
    }

    /// The derivative of `expression`.
    pub fn apply(&mut self, graph: &mut Graph, expression: ExprId) -> ExprId {
        if let Some(&known) = self.known.get(&expression) {
            return known;
        }
        let order = graph.reachable(&[expression]);
        self.known.reserve(order.len());
        for id in order {
            if !self.known.contains_key(&id) {
                let derivative = self.of_node(graph, id);
                self.known.insert(id, derivative);
            }
        }
        self.known[&expression]
    }

    /// The derivatives of several expressions.
    pub fn apply_all(&mut self, graph: &mut Graph, expressions: &[ExprId]) -> Vec<ExprId> {
        expressions.iter().map(|expression| self.apply(graph, *expression)).collect()
    }

    /// The derivative of a node whose operands are known.
    fn of_node(&self, graph: &mut Graph, id: ExprId) -> ExprId {
        let node = graph.node(id);
        let is_constant = |operand| graph.is_literal_zero(self.known[&operand]);
        if !matches!(node, Node::Symbol(_)) && node.operands().all(is_constant) {
            return graph.zero();
        }
        match node.clone() {
            Node::Number(_) | Node::Pi | Node::Constant(_) => graph.zero(),
            Node::Symbol(symbol) => match self.seeds.get(&symbol) {
                Some(&seed) => seed,
                None => graph.zero(),
            },
            Node::Sum { terms, .. } => {
                let summands: Vec<_> = terms.iter().map(|(term, c)| (c.clone(), self.known[term])).collect();
                graph.linear_combination(&summands)
            }
            Node::Product { coefficient, factors } => self.of_product(graph, &coefficient, &factors),
            Node::Apply(function, x) => {
                let dx = self.known[&x];
                if graph.is_literal_zero(dx) {
                    return dx;
                }
                let outer = graph.derivative_of_function(function, x, id);
                graph.mul(outer, dx)
            }
            Node::Apply2(function, x, y) => {
                graph.derivative_of_function_of_two(function, (x, y), (self.known[&x], self.known[&y]))
            }
        }
    }

    /// `d(c Π b^e) = Σ c e b^(e−1) db Π' b'^e'`: exponents are lowered, nothing is divided by b.
    fn of_product(
        &self,
        graph: &mut Graph,
        coefficient: &Rational,
        factors: &[(ExprId, Rational)],
    ) -> ExprId {
        let mut summands = Vec::with_capacity(factors.len());
        for (position, (base, exponent)) in factors.iter().enumerate() {
            let derivative = self.known[base];
            if graph.is_literal_zero(derivative) {
                continue;
            }
            let lowered = factors.iter().enumerate().map(|(other, (base, exponent))| {
                let less = if other == position { Rational::ONE } else { Rational::ZERO };
                (*base, exponent.clone() - less)
            });
            let product = graph.product_of(lowered.chain([(derivative, Rational::ONE)]));
            summands.push((coefficient.clone() * exponent.clone(), product));
        }
        graph.linear_combination(&summands)
    }
}

impl Graph {
    /// The derivative of `f(x, y)`, where the arguments change by `dx` and `dy`.
    pub(crate) fn derivative_of_function_of_two(
        &mut self,
        function: Function2,
        (x, y): (ExprId, ExprId),
        (dx, dy): (ExprId, ExprId),
    ) -> ExprId {
        if self.is_literal_zero(dx) && self.is_literal_zero(dy) {
            return self.zero();
        }
        match function {
            // d atan2(y, x) with the arguments in that order
            Function2::Atan2 => {
                let (a, b) = (self.mul(y, dx), self.mul(x, dy));
                let numerator = self.sub(a, b);
                let (xx, yy) = (self.square(x), self.square(y));
                let radius = self.add(xx, yy);
                self.div(numerator, radius)
            }
            // the one-sided mean where the two agree
            Function2::Min | Function2::Max => {
                let gap = self.sub(x, y);
                let side = self.apply(Function::Sign, gap);
                let side = if function == Function2::Max { side } else { self.neg(side) };
                let (sum, difference) = (self.add(dx, dy), self.sub(dx, dy));
                let turned = self.mul(side, difference);
                self.linear_combination(&[(Rational::new(1, 2), sum), (Rational::new(1, 2), turned)])
            }
        }
    }

    /// `f'(x)`, where `value` is `f(x)`.
    pub(crate) fn derivative_of_function(&mut self, function: Function, x: ExprId, value: ExprId) -> ExprId {
        let one = self.one();
        match function {
            Function::Sin => self.cos(x),
            Function::Cos => {
                let sin = self.sin(x);
                self.neg(sin)
            }
            Function::Sinh => self.apply(Function::Cosh, x),
            Function::Cosh => self.apply(Function::Sinh, x),
            Function::Tanh => {
                let squared = self.square(value);
                self.sub(one, squared)
            }
            Function::Exp => value,
            Function::Ln => self.div(one, x),
            Function::Asin | Function::Acos => {
                let squared = self.square(x);
                let rest = self.sub(one, squared);
                let derivative = self.pow(rest, Rational::new(-1, 2));
                if function == Function::Asin { derivative } else { self.neg(derivative) }
            }
            Function::Atan => {
                let squared = self.square(x);
                let sum = self.add(one, squared);
                self.div(one, sum)
            }
            Function::Abs => self.apply(Function::Sign, x),
            Function::Sign => self.zero(),
        }
    }

    /// `∂expression/∂symbol`.
    pub fn partial(&mut self, expression: ExprId, symbol: SymbolId) -> ExprId {
        if let Some(&known) = self.partials.get(&(expression, symbol)) {
            return known;
        }
        let partial = Derivation::partial(self, symbol).apply(self, expression);
        self.partials.insert((expression, symbol), partial);
        partial
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_power_is_not_divided_by_its_base() {
        let mut g = Graph::new();
        let x = g.new_symbol("x");
        let ex = g.symbol(x);
        let square = g.square(ex);
        let cube_of_root = g.pow(square, Rational::new(3, 2));
        let derivative = g.partial(cube_of_root, x);
        assert_eq!(g.text(derivative), "3*x*sqrt(x^2)");
        assert!(g.evaluate(&[derivative], |_| 0.0)[0].value == 0.0);
    }
}
