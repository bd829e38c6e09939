//! Evaluation in balls, and exactly where the value is known exactly: one pass over the graph.
//!
//! At a *given* point every symbol has a rational value, and the balls enclose the values of the
//! expressions there. At a *random* point symbols are random integers, and what is transcendental is
//! replaced by random numbers that satisfy the same identities: sine and cosine by a rational point of the
//! circle for each term of the angle, exponentials by a positive number for each term of the exponent,
//! π by a number close to it unless arcs of numbers occur. What vanishes there for many choices vanishes by an identity; roots have the
//! sign that they have on the reals.

mod functions;

use super::ball::{Ball, Bits, NoBall};
use super::exact::{Decision, Form, Number};
use super::field::Residue;
use super::graph::Graph;
use super::node::{Function, Function2, Node};
use super::number::Rational;
use crate::id::{ExprId, Id, SymbolId};
use crate::limits;
pub(super) use functions::of_function;
use rustc_hash::{FxHashMap, FxHashSet};

/// Where an expression is evaluated.
#[derive(Clone, Copy)]
pub(super) enum Point<'a> {
    /// At these values of the symbols.
    Given(&'a dyn Fn(SymbolId) -> Rational),
    /// At random numbers. With `tied`, symbols in exponents are the logarithms of their exponentials,
    /// so that `ln(exp(x)) = x` holds, but products of them are out of reach.
    Random { seed: u64, tied: bool },
}

/// The value of an expression.
#[derive(Clone, Debug)]
pub(super) struct Value {
    pub(super) ball: Ball,
    /// The exact value, where it can be written down.
    pub(super) form: Option<Form>,
}

impl Value {
    /// The steps that an operation with a result like this takes: digits are multiplied by digits, and for
    /// quotients of integers common divisors are sought.
    fn work(&self) -> usize {
        let words = |bits: u64| usize::try_from(bits / 64).unwrap_or(usize::MAX);
        let squared = |words: usize| words.saturating_mul(words);
        let exact = self.form.as_ref().and_then(|form| form.algebraic.rational.as_ref());
        let exact = exact.map_or(0, |value| squared(words(value.bits())));
        1 + squared(words(self.ball.bits())) / 16 + exact
    }
}

/// The terms of the series of a function.
const SERIES: usize = 16;

/// The values of some expressions at one point.
pub(super) struct Evaluated {
    pub(super) values: Vec<Value>,
    /// The degree of the field in which the exact ones lie.
    pub(super) degree: u64,
}

impl Graph {
    /// Evaluates expressions with so many digits.
    pub(super) fn evaluate_exactly(
        &self,
        roots: &[ExprId],
        point: Point<'_>,
        bits: Bits,
    ) -> Result<Evaluated, NoBall> {
        let order = self.reachable(roots);
        let division = match point {
            Point::Given(_) => 1,
            Point::Random { .. } => self.angle_division(roots),
        };
        let mut pass = Pass {
            graph: self,
            point,
            bits,
            division,
            known: FxHashMap::default(),
            roots: FxHashSet::default(),
            degree: 1,
            parts_of_a_turn: 1,
            exponents: self.symbols_in_exponents(&order, point),
            has_arcs: order.iter().any(|id| self.is_arc(*id)),
        };
        pass.known.reserve(order.len());
        for id in order {
            let value = pass.value(id)?;
            let node = self.node(id);
            let terms =
                if matches!(node, Node::Apply(..) | Node::Apply2(..)) { SERIES } else { node.breadth() };
            limits::spend(terms.saturating_mul(value.work()));
            pass.known.insert(id, value);
        }
        let degree = pass.degree.saturating_mul((totient(pass.parts_of_a_turn) / 2).max(1));
        let values = roots.iter().map(|root| pass.known[root].clone()).collect();
        Ok(Evaluated { values, degree })
    }

    fn is_arc(&self, id: ExprId) -> bool {
        let is_arc = |function| matches!(function, Function::Asin | Function::Acos | Function::Atan);
        match self.node(id) {
            Node::Apply(function, _) => is_arc(*function),
            Node::Apply2(function, ..) => *function == Function2::Atan2,
            _ => false,
        }
    }

    /// The symbols that stand alone in exponents, if they are tied to them.
    fn symbols_in_exponents(&self, order: &[ExprId], point: Point<'_>) -> FxHashSet<ExprId> {
        if !matches!(point, Point::Random { tied: true, .. }) {
            return FxHashSet::default();
        }
        let exponents = order.iter().filter_map(|id| match self.node(*id) {
            Node::Apply(Function::Exp | Function::Sinh | Function::Cosh | Function::Tanh, x) => Some(*x),
            _ => None,
        });
        exponents
            .flat_map(|x| self.angle_terms(x))
            .filter_map(|(term, _)| {
                Some(self.without_coefficient(term?)).filter(|e| self.as_symbol(*e).is_some())
            })
            .collect()
    }

    /// The only factor of a product of a number and it, or the expression itself.
    fn without_coefficient(&self, id: ExprId) -> ExprId {
        match self.node(id) {
            Node::Product { factors, .. } => match &**factors {
                [(base, exponent)] if exponent.is_one() => *base,
                _ => id,
            },
            _ => id,
        }
    }

    /// The number that stands apart from a term of an angle, in its coefficient.
    fn number_apart(&self, term: ExprId) -> Rational {
        let factor = self.angle_factor(term).unwrap_or(Rational::ONE);
        match self.node(term) {
            Node::Product { coefficient, .. } => factor * coefficient.clone(),
            _ => factor,
        }
    }
}

struct Pass<'a> {
    graph: &'a Graph,
    point: Point<'a>,
    bits: Bits,
    division: i64,
    known: FxHashMap<ExprId, Value>,
    /// The roots that have been adjoined, by base and degree.
    roots: FxHashSet<(ExprId, i64)>,
    degree: u64,
    /// The common order of the roots of unity whose real parts have occurred.
    parts_of_a_turn: u64,
    exponents: FxHashSet<ExprId>,
    /// Whether arcs of numbers occur, which π is compared with.
    has_arcs: bool,
}

/// Separate streams of random numbers for separate purposes.
#[derive(Clone, Copy)]
enum Stream {
    Symbol = 31,
    Circle,
    Exponential,
    Pi,
}

impl Pass<'_> {
    /// A random number of up to twenty bits that the purpose determines.
    fn random(&self, stream: Stream, number: u64) -> i64 {
        let seed = match self.point {
            Point::Random { seed, .. } => seed,
            Point::Given(_) => 0,
        };
        let word = Residue::mixed(seed.wrapping_mul(64).wrapping_add(stream as u64), number).word();
        i64::try_from(word % (1 << 20)).unwrap_or(0) + 2
    }

    fn is_random(&self) -> bool {
        matches!(self.point, Point::Random { .. })
    }

    fn of_form(&self, form: Form) -> Result<Value, NoBall> {
        Ok(Value { ball: form.ball(self.bits)?, form: Some(form) })
    }

    fn rational(&self, value: &Rational) -> Result<Value, NoBall> {
        self.of_form(Form::rational(value, self.bits))
    }

    fn algebraic(&self, number: Number) -> Result<Value, NoBall> {
        self.of_form(Form::of(number))
    }

    fn value(&mut self, id: ExprId) -> Result<Value, NoBall> {
        match self.graph.node(id) {
            Node::Number(value) => self.rational(value),
            Node::Constant(constant) => self.rational(&self.graph.constants()[*constant].value),
            Node::Pi if self.is_random() && !self.has_arcs => {
                let shift = Rational::new(self.random(Stream::Pi, 0), 1 << 40);
                self.rational(&(Rational::new(355, 113) + shift))
            }
            Node::Pi => {
                let zero = Form::rational(&Rational::ZERO, self.bits);
                self.of_form(Form { turns: Rational::ONE, ..zero })
            }
            Node::Symbol(symbol) => self.symbol(id, *symbol),
            Node::Sum { constant, terms } => self.sum(constant, terms),
            Node::Product { coefficient, factors } => {
                let mut product = self.rational(coefficient)?;
                for (base, exponent) in factors.iter() {
                    let power = self.power(*base, exponent)?;
                    product = self.times(&product, &power)?;
                }
                Ok(product)
            }
            Node::Apply(function, x) => self.function(id, *function, *x),
            Node::Apply2(function, x, y) => self.function2(*function, *x, *y),
        }
    }

    fn symbol(&self, id: ExprId, symbol: SymbolId) -> Result<Value, NoBall> {
        if let Point::Given(values) = self.point {
            return self.rational(&values(symbol));
        }
        if self.exponents.contains(&id) {
            let base = self.exponential_of(Some(id));
            let zero = Form::rational(&Rational::ZERO, self.bits);
            return self.of_form(Form { logarithms: vec![(self.division.into(), base)], ..zero });
        }
        let index = symbol.index() as u64;
        let value = self.random(Stream::Symbol, index);
        let sign = if self.has_signs() && self.random(Stream::Symbol, !index) % 2 == 0 { -1 } else { 1 };
        self.rational(&(sign * value).into())
    }

    fn sum(&self, constant: &Rational, terms: &[(ExprId, Rational)]) -> Result<Value, NoBall> {
        let start = Form::rational(constant, self.bits);
        let forms: Option<Vec<(Rational, &Form)>> = terms
            .iter()
            .map(|(term, coefficient)| Some((coefficient.clone(), self.known[term].form.as_ref()?)))
            .chain([Some((Rational::ONE, &start))])
            .collect();
        if let Some(parts) = forms {
            return self.of_form(Form::sum(&parts, self.bits));
        }
        let ball = terms.iter().fold(Ball::of(constant, self.bits), |sum, (term, coefficient)| {
            sum.plus(&self.known[term].ball.scaled(coefficient))
        });
        Ok(Value { ball, form: None })
    }

    fn times(&self, a: &Value, b: &Value) -> Result<Value, NoBall> {
        if let (Some(x), Some(y)) = (&a.form, &b.form)
            && let Some(product) = x.times(y, self.bits)?
        {
            return self.of_form(product);
        }
        Ok(Value { ball: a.ball.times(&b.ball)?, form: None })
    }

    fn power(&mut self, base: ExprId, exponent: &Rational) -> Result<Value, NoBall> {
        let x = self.known[&base].clone();
        if exponent.is_one() {
            return Ok(x);
        }
        let Some(form) = x.form.filter(Form::is_algebraic) else {
            return Ok(Value { ball: x.ball.power(exponent)?, form: None });
        };
        let Some((n, d)) = exponent.to_small().filter(|(_, d)| *d < 1 << 16) else {
            return Ok(Value { ball: x.ball.power(exponent)?, form: None });
        };
        let is_zero = self.is_zero(&form)?;
        if is_zero && n < 0 {
            return Err(NoBall::Undefined);
        }
        if is_zero {
            return self.rational(&Rational::ZERO);
        }
        if d == 1 {
            return self.algebraic(form.algebraic.power(n)?);
        }
        let root = self.root(base, &form.algebraic, d)?;
        self.algebraic(root.power(n)?)
    }

    /// Whether an algebraic value is zero; an error where more digits are needed.
    fn is_zero(&self, form: &Form) -> Result<bool, NoBall> {
        match form.algebraic.decided(self.degree_so_far()) {
            Decision::Zero => Ok(true),
            Decision::NonZero => Ok(false),
            Decision::Digits(_) => Err(NoBall::TooWide),
        }
    }

    fn degree_so_far(&self) -> u64 {
        self.degree.saturating_mul((totient(self.parts_of_a_turn) / 2).max(1))
    }

    /// The root of a number that is not zero.
    fn root(&mut self, base: ExprId, number: &Number, degree: i64) -> Result<Number, NoBall> {
        if number.ball.is_negative() {
            return Err(NoBall::Undefined);
        }
        if !number.ball.is_positive() {
            return Err(NoBall::TooWide);
        }
        if degree == 2
            && let Some(exact) = number.rational.as_ref().and_then(Rational::sqrt)
        {
            return Ok(Number::of(&exact, self.bits));
        }
        if self.roots.insert((base, degree)) {
            self.degree = self.degree.saturating_mul(degree.unsigned_abs());
        }
        number.root(u32::try_from(degree).map_err(|_| NoBall::TooLong)?)
    }
}

/// Euler's function.
fn totient(n: u64) -> u64 {
    let (mut rest, mut result, mut divisor) = (n, n, 2);
    while divisor * divisor <= rest {
        if rest % divisor == 0 {
            result -= result / divisor;
            while rest % divisor == 0 {
                rest /= divisor;
            }
        }
        divisor += 1;
    }
    if rest > 1 { result - result / rest } else { result }
}
