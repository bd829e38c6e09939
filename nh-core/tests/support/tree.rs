//! Expression trees, and their values by plain recursion.

use nonholonomic_core::algebra::{Function, Graph, Rational};
use nonholonomic_core::id::{ExprId, Id, SymbolId};
use proptest::prelude::*;
use std::f64::consts::PI;

/// The number of symbols that trees are made of.
pub(crate) const SYMBOLS: usize = 3;

/// An expression, defined wherever its generator can produce it.
#[derive(Clone, Debug)]
pub(crate) enum Tree {
    Symbol(usize),
    Pi,
    Number(Rational),
    Sum(Vec<Tree>),
    Product(Vec<Tree>),
    Power(Box<Tree>, Rational),
    Apply(Function, Box<Tree>),
}

use Tree::{Apply, Number, Pi, Power, Product, Sum, Symbol};

fn number() -> impl Strategy<Value = Rational> {
    (-6..=6i64, 1..=4i64).prop_map(|(n, d)| Rational::new(n, d))
}

/// `a x + b y + c z`, sometimes shifted by a multiple of π.
fn angle() -> impl Strategy<Value = Tree> {
    let coefficient = prop_oneof![
        3 => Just(Rational::ZERO),
        4 => (-2..=2i64).prop_map(Rational::from),
        1 => Just(Rational::new(1, 2)),
    ];
    let shift = prop_oneof![4 => Just(Rational::ZERO), 1 => (-4..=4i64).prop_map(|n| Rational::new(n, 4)),
        1 => (-3..=3i64).prop_map(|n| Rational::new(n, 3))];
    (prop::collection::vec(coefficient, SYMBOLS), shift).prop_map(|(coefficients, shift)| {
        let mut terms: Vec<_> = coefficients
            .into_iter()
            .enumerate()
            .map(|(symbol, coefficient)| Product(vec![Number(coefficient), Symbol(symbol)]))
            .collect();
        terms.push(Product(vec![Number(shift), Pi]));
        Sum(terms)
    })
}

fn square(tree: Tree) -> Tree {
    Power(Box::new(tree), 2.into())
}

/// Trees that are defined and smooth everywhere.
pub(crate) fn tree() -> impl Strategy<Value = Tree> {
    let one = || Number(Rational::ONE);
    let trigonometric = prop_oneof![Just(Function::Sin), Just(Function::Cos)];
    let other = prop_oneof![
        Just(Function::Exp),
        Just(Function::Sinh),
        Just(Function::Cosh),
        Just(Function::Tanh),
        Just(Function::Atan),
    ];
    let linear = (0..SYMBOLS, number()).prop_map(|(symbol, shift)| Sum(vec![Symbol(symbol), Number(shift)]));
    let leaf = prop_oneof![
        4 => (0..SYMBOLS).prop_map(Symbol),
        2 => number().prop_map(Number),
        3 => (trigonometric, angle()).prop_map(|(f, x)| Apply(f, Box::new(x))),
        1 => (other, linear).prop_map(|(f, x)| Apply(f, Box::new(x))),
    ];
    leaf.prop_recursive(4, 20, 3, move |inner| {
        prop_oneof![
            4 => prop::collection::vec(inner.clone(), 2..4).prop_map(Sum),
            4 => prop::collection::vec(inner.clone(), 2..4).prop_map(Product),
            2 => (inner.clone(), 1..4i64).prop_map(|(x, n)| Power(Box::new(x), n.into())),
            1 => (inner.clone(), inner.clone()).prop_map(move |(x, y)| {
                Product(vec![x, Power(Box::new(Sum(vec![square(y), one()])), Rational::MINUS_ONE)])
            }),
            1 => (inner.clone(), inner).prop_map(move |(x, y)| {
                Power(Box::new(Sum(vec![square(x), square(y), one()])), Rational::new(1, 2))
            }),
        ]
    })
}

/// Rational functions whose denominators vanish here and there.
pub(crate) fn fraction() -> impl Strategy<Value = Tree> {
    let leaf = prop_oneof![
        6 => (0..SYMBOLS).prop_map(Symbol),
        2 => (-2..=2i64).prop_map(|n| Number(n.into())),
        1 => (0..SYMBOLS).prop_map(|symbol| Apply(Function::Sin, Box::new(Symbol(symbol)))),
        1 => (0..SYMBOLS).prop_map(|symbol| Apply(Function::Cos, Box::new(Symbol(symbol)))),
    ];
    leaf.prop_recursive(4, 20, 3, |inner| {
        prop_oneof![
            4 => prop::collection::vec(inner.clone(), 2..4).prop_map(Sum),
            2 => prop::collection::vec(inner.clone(), 2..4).prop_map(Product),
            1 => (inner.clone(), 1..3i64).prop_map(|(x, n)| Power(Box::new(x), n.into())),
            4 => (inner.clone(), inner).prop_map(|(x, y)| {
                Product(vec![x, Power(Box::new(y), Rational::MINUS_ONE)])
            }),
        ]
    })
}

/// A number with the operations of the trees.
pub(crate) trait Value: Copy {
    fn constant(value: f64) -> Self;
    fn plus(self, other: Self) -> Self;
    fn times(self, other: Self) -> Self;
    /// A smooth function with its derivative.
    fn map(self, value: f64, slope: f64) -> Self;
    fn real(self) -> f64;
}

impl Value for f64 {
    fn constant(value: f64) -> Self {
        value
    }
    fn plus(self, other: Self) -> Self {
        self + other
    }
    fn times(self, other: Self) -> Self {
        self * other
    }
    fn map(self, value: f64, _: f64) -> Self {
        value
    }
    fn real(self) -> f64 {
        self
    }
}

/// A value with a derivative.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Dual {
    pub(crate) value: f64,
    pub(crate) slope: f64,
}

impl Value for Dual {
    fn constant(value: f64) -> Self {
        Self { value, slope: 0.0 }
    }
    fn plus(self, other: Self) -> Self {
        Self { value: self.value + other.value, slope: self.slope + other.slope }
    }
    fn times(self, other: Self) -> Self {
        Self { value: self.value * other.value, slope: self.slope * other.value + self.value * other.slope }
    }
    fn map(self, value: f64, slope: f64) -> Self {
        Self { value, slope: slope * self.slope }
    }
    fn real(self) -> f64 {
        self.value
    }
}

fn apply<V: Value>(function: Function, x: V) -> V {
    let v = x.real();
    let (value, slope) = match function {
        Function::Sin => (v.sin(), v.cos()),
        Function::Cos => (v.cos(), -v.sin()),
        Function::Asin => (v.asin(), (1.0 - v * v).sqrt().recip()),
        Function::Acos => (v.acos(), -(1.0 - v * v).sqrt().recip()),
        Function::Atan => (v.atan(), (1.0 + v * v).recip()),
        Function::Sinh => (v.sinh(), v.cosh()),
        Function::Cosh => (v.cosh(), v.sinh()),
        Function::Tanh => (v.tanh(), 1.0 - v.tanh().powi(2)),
        Function::Exp => (v.exp(), v.exp()),
        Function::Ln => (v.ln(), v.recip()),
        Function::Abs => (v.abs(), v.signum()),
        Function::Sign => (v.signum(), 0.0),
    };
    x.map(value, slope)
}

impl Tree {
    /// The value at a point.
    pub(crate) fn value<V: Value>(&self, point: &[V]) -> V {
        match self {
            Symbol(index) => point[*index],
            Pi => V::constant(PI),
            Number(number) => V::constant(number.to_f64()),
            Sum(terms) => terms.iter().fold(V::constant(0.0), |sum, term| sum.plus(term.value(point))),
            Product(factors) => {
                factors.iter().fold(V::constant(1.0), |product, factor| product.times(factor.value(point)))
            }
            Power(base, exponent) => {
                let (base, exponent) = (base.value(point), exponent.to_f64());
                let v = base.real();
                base.map(
                    v.powf(exponent),
                    if exponent == 0.0 { 0.0 } else { exponent * v.powf(exponent - 1.0) },
                )
            }
            Apply(function, x) => apply(*function, x.value(point)),
        }
    }

    /// The expression, node by node.
    pub(crate) fn build(&self, graph: &mut Graph) -> ExprId {
        match self {
            Symbol(index) => graph.symbol(SymbolId::from_index(*index)),
            Pi => graph.pi(),
            Number(number) => graph.number(number.clone()),
            Sum(terms) => {
                let terms: Vec<_> = terms.iter().map(|term| term.build(graph)).collect();
                graph.sum(&terms)
            }
            Product(factors) => {
                let factors: Vec<_> =
                    factors.iter().map(|factor| (factor.build(graph), Rational::ONE)).collect();
                graph.product(&factors)
            }
            Power(base, exponent) => {
                let base = base.build(graph);
                graph.pow(base, exponent.clone())
            }
            Apply(function, x) => {
                let x = x.build(graph);
                graph.apply(*function, x)
            }
        }
    }

    /// The expression another way: sums backwards, products multiplied out, angles taken apart.
    pub(crate) fn build_expanded(&self, graph: &mut Graph) -> ExprId {
        match self {
            Sum(terms) => {
                let mut sum = graph.zero();
                for term in terms.iter().rev() {
                    let term = term.build_expanded(graph);
                    sum = graph.formula(sum + term);
                }
                sum
            }
            Product(factors) => {
                let mut product = graph.one();
                for factor in factors.iter().rev() {
                    let factor = factor.build_expanded(graph);
                    product = distributed(graph, product, factor);
                }
                product
            }
            Power(base, exponent) => {
                let base = base.build_expanded(graph);
                match exponent.to_i64() {
                    Some(times @ 1..=3) => (1..times).fold(base, |power, _| distributed(graph, power, base)),
                    _ => graph.pow(base, exponent.clone()),
                }
            }
            Apply(function @ (Function::Sin | Function::Cos), x) => {
                let (cos, sin) = taken_apart(graph, x);
                if *function == Function::Sin { sin } else { cos }
            }
            Apply(Function::Exp, x) => {
                let Sum(terms) = &**x else { return self.build(graph) };
                let factors: Vec<_> = terms
                    .iter()
                    .map(|term| {
                        let term = term.build_expanded(graph);
                        (graph.apply(Function::Exp, term), Rational::ONE)
                    })
                    .collect();
                graph.product(&factors)
            }
            Apply(function, x) => {
                let x = x.build_expanded(graph);
                graph.apply(*function, x)
            }
            Symbol(_) | Pi | Number(_) => self.build(graph),
        }
    }
}

/// `(Σ a)(Σ b) = Σ ab`.
fn distributed(graph: &mut Graph, a: ExprId, b: ExprId) -> ExprId {
    let ((constant_a, terms_a), (constant_b, terms_b)) = (graph.as_linear(a), graph.as_linear(b));
    if terms_a.len() * terms_b.len() > 40 {
        return graph.formula(a * b);
    }
    let one = graph.one();
    let mut summands = Vec::new();
    for (x, c) in terms_a.iter().cloned().chain([(one, constant_a)]) {
        for (y, d) in terms_b.iter().cloned().chain([(one, constant_b.clone())]) {
            let product = graph.formula(x * y);
            summands.push((c.clone() * d, product));
        }
    }
    graph.linear_combination(&summands)
}

/// Cosine and sine of an angle by the addition theorems, from the back.
fn taken_apart(graph: &mut Graph, x: &Tree) -> (ExprId, ExprId) {
    let Sum(terms) = x else {
        let x = x.build_expanded(graph);
        return (graph.cos(x), graph.sin(x));
    };
    let (mut cos, mut sin) = (graph.one(), graph.zero());
    for term in terms.iter().rev() {
        let term = term.build_expanded(graph);
        let (c, s) = (graph.cos(term), graph.sin(term));
        let (cc, ss) = (distributed(graph, cos, c), distributed(graph, sin, s));
        let (cs, sc) = (distributed(graph, cos, s), distributed(graph, sin, c));
        (cos, sin) = (graph.formula(cc - ss), graph.formula(cs + sc));
    }
    (cos, sin)
}
