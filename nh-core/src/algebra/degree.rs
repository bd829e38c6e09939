//! Bounds on the degrees of expressions as rational functions of the random choices that make a point of the
//! field: symbols, a parameter of the circle for each angle, a unit for each exponential.
//!
//! A function of degree d that is not zero vanishes at a random point of the field of P elements with
//! probability d/P at most (Schwartz, Zippel).

use super::graph::Graph;
use super::node::{Function, Node};
use super::number::Rational;
use crate::id::{ExprId, Id, SymbolId};
use crate::id_map::IdMap;
use crate::limits;
use rustc_hash::FxHashMap;
use std::rc::Rc;

/// A bound on the degree of a function N Π D^k: N is a polynomial, and so are the D, of which the numerators of
/// divisors, and the denominators of points of the circle, are made. Kept apart they cancel where the terms of
/// a sum have them in common, which elimination would double again and again.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Degree {
    numerator: f64,
    /// The exponents k, ascending by what D belongs to, none of them zero.
    factors: Rc<[(Factor, f64)]>,
}

/// As many factors are read in a step of work.
const FACTORS_PER_STEP: usize = 2;

/// What a D belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Factor(usize);

/// The exponents of D, ascending by what D belongs to.
type Exponents = [(Factor, f64)];

/// Kinds of what a D belongs to.
const KINDS: usize = 3;

impl Factor {
    /// A divisor, or the argument of a periodic function.
    fn node(id: ExprId) -> Self {
        Self(KINDS * id.index())
    }

    /// The unknown of a linear system.
    fn unknown(symbol: SymbolId) -> Self {
        Self(KINDS * symbol.index() + 1)
    }

    /// A divisor, an angle or a linear system of a program, by its place there.
    fn step(place: usize) -> Self {
        Self(KINDS * place + 2)
    }
}

impl Id for Factor {
    const FIRST: Self = Self(0);
    fn from_index(index: usize) -> Self {
        Self(index)
    }
    #[inline(always)]
    fn index(self) -> usize {
        self.0
    }
}

impl Degree {
    pub(crate) fn polynomial(numerator: f64) -> Self {
        Self { numerator, factors: Rc::from([]) }
    }
}

/// The bounds of expressions, of which symbols may have values.
pub(crate) struct Degrees<'a> {
    graph: &'a Graph,
    division: i64,
    known: IdMap<ExprId, Degree>,
    named: FxHashMap<SymbolId, Degree>,
    /// The degrees of the D.
    sizes: IdMap<Factor, f64>,
}

impl<'a> Degrees<'a> {
    pub(crate) fn new(graph: &'a Graph, division: i64) -> Self {
        let (known, named, sizes) = Default::default();
        Self { graph, division, known, named, sizes }
    }

    /// Gives a symbol the bound of its value before it occurs.
    pub(crate) fn name(&mut self, symbol: SymbolId, degree: Degree) {
        self.named.insert(symbol, degree);
    }

    /// Gives an unknown the bound of a quotient of two polynomials of a degree before it occurs.
    pub(crate) fn name_quotient(&mut self, symbol: SymbolId, degree: f64) {
        let degree = self.quotient(Factor::unknown(symbol), degree);
        self.name(symbol, degree);
    }

    /// The bound of a quotient of two polynomials of a degree.
    fn quotient(&mut self, of: Factor, degree: f64) -> Degree {
        self.sizes.insert(of, degree);
        Degree { numerator: degree, factors: Rc::from([(of, -1.0)]) }
    }

    /// The bound of a quotient of two polynomials of a degree, at a step of a program.
    pub(crate) fn quotient_at(&mut self, step: usize, degree: f64) -> Degree {
        self.quotient(Factor::step(step), degree)
    }

    /// The bounds of several expressions.
    fn of_all(&mut self, roots: &[ExprId]) -> Vec<Degree> {
        if roots.iter().any(|root| !self.known.contains_key(root)) {
            for id in self.graph.reachable_beyond(roots, |id| self.known.contains_key(&id)) {
                let degree = self.of_node(id);
                self.known.insert(id, degree);
            }
        }
        roots.iter().map(|root| self.known[root].clone()).collect()
    }

    /// The bound of an expression.
    pub(crate) fn of(&mut self, root: ExprId) -> Degree {
        self.of_all(&[root])[0].clone()
    }

    /// The largest degree of a numerator or a denominator among several expressions, 1 at least.
    pub(crate) fn most(&mut self, roots: &[ExprId]) -> f64 {
        self.of_all(roots).iter().map(|degree| self.size(degree)).fold(1.0, f64::max)
    }

    /// The larger one of the degrees of numerator and denominator.
    pub(crate) fn size(&self, degree: &Degree) -> f64 {
        let (mut up, mut down) = (degree.numerator, 0.0);
        for (factor, exponent) in degree.factors.iter() {
            let size = self.sizes[factor] * exponent.abs();
            if *exponent > 0.0 { up += size } else { down += size }
        }
        f64::max(up, down)
    }

    fn of_node(&mut self, id: ExprId) -> Degree {
        match self.graph.node(id) {
            Node::Number(_) | Node::Pi | Node::Constant(_) => Degree::polynomial(0.0),
            Node::Symbol(symbol) => {
                self.named.get(symbol).cloned().unwrap_or_else(|| Degree::polynomial(1.0))
            }
            Node::Sum { constant, terms } => {
                let terms = terms.iter().map(|(term, _)| self.known[term].clone());
                let constant = (!constant.is_zero()).then(|| Degree::polynomial(0.0));
                self.of_sum(&terms.chain(constant).collect::<Vec<_>>())
            }
            Node::Product { factors, .. } => self.of_product(factors),
            Node::Apply(function, x) => self.of_function(*function, *x),
            Node::Apply2(..) => Degree::polynomial(1.0),
        }
    }

    /// Over the common denominator: of each D the least exponent.
    pub(crate) fn of_sum(&self, terms: &[Degree]) -> Degree {
        let Some(first) = terms.first() else { return Degree::polynomial(0.0) };
        if terms.iter().all(|term| Rc::ptr_eq(&term.factors, &first.factors) || term.factors == first.factors)
        {
            let numerator = terms.iter().map(|term| term.numerator).fold(0.0, f64::max);
            return Degree { numerator, factors: first.factors.clone() };
        }
        let mut least: Rc<Exponents> = first.factors.clone();
        let mut read = 0;
        for (place, term) in terms.iter().enumerate().skip(1) {
            // neighbours often are of one kind
            if !Rc::ptr_eq(&term.factors, &terms[place - 1].factors) {
                read += least.len() + term.factors.len();
                least = lower_ones(&least, &term.factors).into();
            }
        }
        limits::spend(read / FACTORS_PER_STEP);
        let common = self.size_together(&least);
        let mut numerator = 0.0_f64;
        for term in terms {
            numerator = numerator.max(term.numerator + self.size_together(&term.factors) - common);
        }
        Degree { numerator, factors: least }
    }

    /// `Σ k deg D`.
    fn size_together(&self, factors: &Exponents) -> f64 {
        let (mut sum, mut place) = (0.0, 0);
        while place < factors.len() {
            sum += self.sizes[&factors[place].0] * factors[place].1;
            place += 1;
        }
        sum
    }

    fn of_product(&mut self, factors: &[(ExprId, Rational)]) -> Degree {
        let factors = factors
            .iter()
            .map(|(base, power)| (Factor::node(*base), self.known[base].clone(), power.to_f64()));
        let factors: Vec<_> = factors.collect();
        self.of_powers(factors)
    }

    /// The product of powers of values at steps of a program.
    pub(crate) fn of_steps(&mut self, factors: &[(usize, &Degree, f64)]) -> Degree {
        let factors =
            factors.iter().map(|(step, degree, power)| (Factor::step(*step), (*degree).clone(), *power));
        self.of_powers(factors.collect())
    }

    #[allow(clippy::float_cmp, reason = "an exponent that is exactly one")]
    fn of_powers(&mut self, powers: Vec<(Factor, Degree, f64)>) -> Degree {
        let mut numerator = 0.0;
        let mut exponents: Rc<Exponents> = Rc::from([]);
        for (base, degree, power) in powers {
            if power < 0.0 && degree.numerator > 0.0 {
                self.sizes.insert(base, degree.numerator);
                exponents = with_multiple(&exponents, &[(base, 1.0)], power).into();
            } else if power > 0.0 {
                numerator += power * degree.numerator;
            }
            if exponents.is_empty() && power == 1.0 {
                exponents = degree.factors;
            } else if !degree.factors.is_empty() {
                limits::spend((exponents.len() + degree.factors.len()) / FACTORS_PER_STEP);
                exponents = with_multiple(&exponents, &degree.factors, power).into();
            }
        }
        Degree { numerator, factors: exponents }
    }

    /// Multiples of an angle are powers of a point of the circle, which has degree 2.
    fn of_function(&mut self, function: Function, x: ExprId) -> Degree {
        match function {
            Function::Sin
            | Function::Cos
            | Function::Exp
            | Function::Sinh
            | Function::Cosh
            | Function::Tanh => {
                let inside = self.graph.inside_arcs(x);
                let inside = inside.iter().map(|u| self.size(&self.known[u])).sum::<f64>();
                let turns = 2.0 * self.graph.angle_turns(x, self.division);
                self.quotient(Factor::node(x), turns * (1.0 + inside))
            }
            Function::Asin
            | Function::Acos
            | Function::Atan
            | Function::Ln
            | Function::Abs
            | Function::Sign => Degree::polynomial(1.0),
        }
    }
}

/// The lower one of two exponents of every D, of which those that are not listed are 0.
///
/// Plain loops, here and below: a proof reads the factors of every step, in unoptimised builds.
fn lower_ones(left: &Exponents, right: &Exponents) -> Vec<(Factor, f64)> {
    let mut found = Vec::with_capacity(left.len() + right.len());
    let (mut i, mut j) = (0, 0);
    while i < left.len() || j < right.len() {
        let first = if i < left.len() { left[i].0.index() } else { usize::MAX };
        let second = if j < right.len() { right[j].0.index() } else { usize::MAX };
        let one = if first <= second { left[i].1 } else { 0.0 };
        let other = if second <= first { right[j].1 } else { 0.0 };
        let exponent = if one < other { one } else { other };
        if exponent != 0.0 {
            found.push((if first <= second { left[i].0 } else { right[j].0 }, exponent));
        }
        i += usize::from(first <= second);
        j += usize::from(second <= first);
    }
    found
}

/// The exponents with a multiple of others.
fn with_multiple(left: &Exponents, right: &Exponents, times: f64) -> Vec<(Factor, f64)> {
    let mut found = Vec::with_capacity(left.len() + right.len());
    let (mut i, mut j) = (0, 0);
    while i < left.len() || j < right.len() {
        let first = if i < left.len() { left[i].0.index() } else { usize::MAX };
        let second = if j < right.len() { right[j].0.index() } else { usize::MAX };
        let one = if first <= second { left[i].1 } else { 0.0 };
        let other = if second <= first { times * right[j].1 } else { 0.0 };
        if one + other != 0.0 {
            found.push((if first <= second { left[i].0 } else { right[j].0 }, one + other));
        }
        i += usize::from(first <= second);
        j += usize::from(second <= first);
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quotients_and_angles_are_counted() {
        let mut g = Graph::new();
        let (x, a) = (g.new_symbol("x"), g.new_symbol("a"));
        let (ex, ea) = (g.symbol(x), g.symbol(a));
        let (square, twice) = (g.square(ex), g.scale(Rational::from(2), ea));
        let (one, sin) = (g.one(), g.sin(twice));
        let sum = g.add(one, square);
        let quotient = g.div(ex, sum);
        let whole = g.add(quotient, sin);
        let mut degrees = Degrees::new(&g, 1);
        // x/(1 + x²), 2 turns of degree 2, and both over a common denominator
        let found = [quotient, sin, whole].map(|root| degrees.most(&[root]).to_string());
        assert_eq!(found, ["2", "4", "6"]);
    }

    #[test]
    fn elimination_doubles_degrees_and_no_more() {
        let mut g = Graph::new();
        let entry = g.new_symbol("a");
        let mut degrees = Vec::new();
        // d ↦ a − d²/d', a pivot after the other
        let (mut last, mut value) = (g.symbol(entry), g.symbol(entry));
        for _ in 0..10 {
            let quotient = g.div(value, last);
            let (product, b) = (g.mul(value, quotient), g.new_symbol("b"));
            let b = g.symbol(b);
            last = value;
            value = g.sub(b, product);
            degrees.push(value);
        }
        let found = Degrees::new(&g, 1).most(&degrees[9..]);
        assert!(found > 10.0 && found < 2048.0, "{found}");
    }
}
