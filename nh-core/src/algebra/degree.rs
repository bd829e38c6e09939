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
    /// Symbols that stand for expressions.
    images: FxHashMap<SymbolId, ExprId>,
}

impl<'a> Degrees<'a> {
    pub(crate) fn new(graph: &'a Graph, division: i64) -> Self {
        let (known, named, sizes, images) = Default::default();
        Self { graph, division, known, named, sizes, images }
    }

    /// The same where symbols stand for expressions: in sines and exponentials these are multiplied out.
    pub(crate) fn with_images(
        graph: &'a Graph,
        division: i64,
        images: impl Iterator<Item = (SymbolId, ExprId)>,
    ) -> Self {
        let others = images.filter(|(symbol, image)| graph.as_symbol(*image) != Some(*symbol));
        Self { images: others.collect(), ..Self::new(graph, division) }
    }

    /// How many times a point of the circle is multiplied for an angle.
    fn turns(&self, x: ExprId) -> f64 {
        self.graph.angle_turns(x, self.division, &self.images)
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
        let mut kinds: Vec<Rc<Exponents>> = Vec::with_capacity(terms.len());
        for term in terms {
            // neighbours often are of one kind
            if !kinds.last().is_some_and(|last| Rc::ptr_eq(last, &term.factors)) {
                kinds.push(term.factors.clone());
            }
        }
        let least = together(kinds, lower_ones);
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
        let mut kinds: Vec<Rc<Exponents>> = Vec::with_capacity(powers.len());
        for (base, degree, power) in powers {
            if power < 0.0 && degree.numerator > 0.0 {
                self.sizes.insert(base, degree.numerator);
                kinds.push(Rc::from([(base, power)]));
            } else if power > 0.0 {
                numerator += power * degree.numerator;
            }
            if degree.factors.is_empty() {
                continue;
            }
            if power == 1.0 {
                kinds.push(degree.factors);
            } else {
                limits::spend(degree.factors.len() / FACTORS_PER_STEP);
                kinds.push(multiple(&degree.factors, power));
            }
        }
        Degree { numerator, factors: together(kinds, sums) }
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
                let turns = 2.0 * self.turns(x);
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

/// The sums of exponents.
fn sums(left: &Exponents, right: &Exponents) -> Vec<(Factor, f64)> {
    let mut found = Vec::with_capacity(left.len() + right.len());
    let (mut i, mut j) = (0, 0);
    while i < left.len() || j < right.len() {
        let first = if i < left.len() { left[i].0.index() } else { usize::MAX };
        let second = if j < right.len() { right[j].0.index() } else { usize::MAX };
        let one = if first <= second { left[i].1 } else { 0.0 };
        let other = if second <= first { right[j].1 } else { 0.0 };
        if one + other != 0.0 {
            found.push((if first <= second { left[i].0 } else { right[j].0 }, one + other));
        }
        i += usize::from(first <= second);
        j += usize::from(second <= first);
    }
    found
}

/// A multiple of exponents.
fn multiple(exponents: &Exponents, times: f64) -> Rc<Exponents> {
    exponents.iter().map(|(factor, exponent)| (*factor, times * exponent)).collect()
}

/// Lists of exponents taken together, two of equal length where possible: the first with all others, one after the
/// other, would be read as often as there are others.
fn together(
    mut lists: Vec<Rc<Exponents>>,
    two: fn(&Exponents, &Exponents) -> Vec<(Factor, f64)>,
) -> Rc<Exponents> {
    let mut apart = 1;
    while apart < lists.len() {
        for place in (0..lists.len() - apart).step_by(2 * apart) {
            let (left, right) = (&lists[place], &lists[place + apart]);
            limits::spend((left.len() + right.len()) / FACTORS_PER_STEP);
            lists[place] = two(left, right).into();
        }
        apart *= 2;
    }
    lists.into_iter().next().unwrap_or_else(|| Rc::from([]))
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

    /// Of a sum, or of a product, of sines of different angles.
    #[allow(clippy::cast_precision_loss, clippy::float_cmp, reason = "small whole numbers")]
    fn work_of_many(count: i64, build: fn(&mut Graph, &[ExprId]) -> ExprId) -> u64 {
        let mut g = Graph::new();
        let x = g.new_symbol("x");
        let x = g.symbol(x);
        let sines: Vec<ExprId> = (1..=count)
            .map(|times| {
                let angle = g.scale(Rational::from(times), x);
                g.sin(angle)
            })
            .collect();
        let whole = build(&mut g, &sines);
        let work = limits::within_limits(|| {
            let turns = count * (count + 1);
            assert_eq!(Degrees::new(&g, 1).most(&[whole]), turns as f64);
            limits::spent()
        });
        work.unwrap()
    }

    #[test]
    fn long_sums_and_products_are_not_read_again_for_every_term() {
        let sum = |count| work_of_many(count, Graph::sum);
        let product = |count| {
            work_of_many(count, |g, sines| {
                let powers: Vec<_> = sines.iter().map(|sine| (*sine, Rational::from(1))).collect();
                g.product(&powers)
            })
        };
        assert!(sum(1600) < 5 * sum(400), "{} and {}", sum(400), sum(1600));
        assert!(product(1600) < 5 * product(400), "{} and {}", product(400), product(1600));
    }
}
