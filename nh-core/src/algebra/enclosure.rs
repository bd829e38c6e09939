//! Evaluation in balls, and exactly where the value is known exactly: one pass over the graph.
//!
//! At a *given* point every symbol has a rational value, and the balls enclose the values of the
//! expressions there. At a *random* point symbols are random integers, and what is transcendental is
//! replaced by random numbers that satisfy the same identities: sine and cosine by a rational point of the
//! circle for each term of the angle, exponentials by a positive number for each term of the exponent,
//! π by a number close to it unless arcs of numbers occur. What vanishes there for many choices vanishes by an identity; roots have the
//! sign that they have on the reals.

use super::ball::{Ball, Bits, Enclosed, NoBall};
use super::exact::{Decision, Form, Number, complex_product};
use super::field::Residue;
use super::graph::{Function, Function2, Graph, Node};
use super::number::Rational;
use crate::id::{ExprId, Id, SymbolId};
use num_integer::Integer;
use num_traits::ToPrimitive;
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
            Point::Random { .. } => self.angle_division(&order).map_err(|_| NoBall::TooLong)?,
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
            .filter_map(|(term, _)| term.filter(|term| self.as_symbol(*term).is_some()))
            .collect()
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
            let base = self.exponential_of(Some(id))?;
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
        if self.roots.insert((base, degree)) {
            self.degree = self.degree.saturating_mul(degree.unsigned_abs());
        }
        number.root(u32::try_from(degree).map_err(|_| NoBall::TooLong)?)
    }

    fn function(&mut self, id: ExprId, function: Function, x: ExprId) -> Result<Value, NoBall> {
        let exact = match function {
            Function::Sin | Function::Cos => self.circle(function == Function::Cos, x)?,
            Function::Exp | Function::Sinh | Function::Cosh | Function::Tanh => {
                self.exponential(function, x)?
            }
            Function::Abs | Function::Sign => self.signed(function, x)?,
            Function::Ln | Function::Atan | Function::Asin | Function::Acos => {
                self.inverse(id, function, x)?
            }
        };
        match exact {
            Some(form) => self.of_form(form),
            None => Ok(Value { ball: of_function(function, &self.known[&x].ball)?, form: None }),
        }
    }

    fn signed(&self, function: Function, x: ExprId) -> Result<Option<Form>, NoBall> {
        let value = &self.known[&x];
        let Some(form) = value.form.clone() else { return Ok(None) };
        let sign = match (value.ball.is_positive(), value.ball.is_negative()) {
            (true, _) => 1,
            (_, true) => -1,
            _ if form.is_algebraic() && self.is_zero(&form)? => 0,
            _ => return Err(NoBall::TooWide),
        };
        let number = Form::rational(&sign.into(), self.bits);
        Ok(if function == Function::Sign { Some(number) } else { form.times(&number, self.bits)? })
    }

    /// Logarithms and arcs of algebraic numbers.
    fn inverse(&mut self, id: ExprId, function: Function, x: ExprId) -> Result<Option<Form>, NoBall> {
        let Some(form) = self.known[&x].form.clone().filter(Form::is_algebraic) else { return Ok(None) };
        let number = form.algebraic.clone();
        let bits = self.bits;
        let (zero, one) = (Form::rational(&Rational::ZERO, bits), Number::of(&Rational::ONE, bits));
        if function == Function::Ln {
            return match (number.ball.is_positive(), self.is_zero(&form)? || number.ball.is_negative()) {
                (_, true) => Err(NoBall::Undefined),
                (true, _) => Ok(Some(Form { logarithms: vec![(Rational::ONE, number)], ..zero })),
                _ => Err(NoBall::TooWide),
            };
        }
        if function == Function::Atan {
            return Ok(Some(Form { arcs: vec![(Rational::ONE, [one, number])], ..zero }));
        }
        let squared = number.power(2)?;
        let rest = Number::sum([(Rational::ONE, &one), (Rational::MINUS_ONE, &squared)].into_iter(), bits);
        let other = if self.is_zero(&Form::of(rest.clone()))? {
            Number::of(&Rational::ZERO, bits)
        } else {
            self.root(id, &rest, 2)?
        };
        let point = if function == Function::Asin { [other, number] } else { [number, other] };
        Ok(Some(Form { arcs: vec![(Rational::ONE, point)], ..zero }))
    }

    /// Sine or cosine, where the angle is a rational part of a turn, or random.
    fn circle(&mut self, is_cosine: bool, x: ExprId) -> Result<Option<Form>, NoBall> {
        if !self.is_random() {
            let form = self.known[&x].form.clone();
            let is_part =
                |form: &Form| form.has_no_number() && form.logarithms.is_empty() && form.arcs.is_empty();
            let Some(form) = form.filter(is_part) else { return Ok(None) };
            let part = self.part_of_a_turn(&form.turns)?;
            return Ok(Some(Form::of(part[usize::from(!is_cosine)].clone())));
        }
        let mut product = [Number::of(&Rational::ONE, self.bits), Number::of(&Rational::ZERO, self.bits)];
        for (term, coefficient) in self.graph.angle_terms(x) {
            if term.is_some_and(|term| self.is_multiple_of_pi(term)) {
                let part = self.part_of_a_turn(&coefficient)?;
                product = complex_product(&product, &part, self.bits)?;
                continue;
            }
            let times = self.multiple(&coefficient)?;
            let factor = self.point_of_the_circle(term, times.signum());
            for _ in 0..times.unsigned_abs() {
                product = complex_product(&product, &factor, self.bits)?;
            }
        }
        let [cosine, sine] = product;
        Ok(Some(Form::of(if is_cosine { cosine } else { sine })))
    }

    /// Whether the term of an angle is π, or π with its coefficient.
    fn is_multiple_of_pi(&self, term: ExprId) -> bool {
        let is_pi = |id: ExprId| matches!(self.graph.node(id), Node::Pi);
        match self.graph.node(term) {
            Node::Pi => true,
            Node::Product { factors, .. } => matches!(&**factors, [(base, e)] if e.is_one() && is_pi(*base)),
            _ => false,
        }
    }

    /// A rational point of the circle for a term of an angle, or its mirror image.
    fn point_of_the_circle(&self, term: Option<ExprId>, side: i64) -> [Number; 2] {
        let word = self.random(Stream::Circle, self.key(term));
        let n = word % (1 << 14) + 2;
        let quadrant = |bit: i64| if self.has_signs() && word >> bit & 1 == 1 { -1 } else { 1 };
        let square = n * n + 1;
        let cosine = Rational::new(quadrant(18) * (n * n - 1), square);
        let sine = Rational::new(side * quadrant(19) * 2 * n, square);
        [Number::of(&cosine, self.bits), Number::of(&sine, self.bits)]
    }

    /// Whether the random numbers of this point have both signs.
    fn has_signs(&self) -> bool {
        matches!(self.point, Point::Random { seed, .. } if seed % 2 == 1)
    }

    /// cos(qπ) and sin(qπ) = cos(π/2 − qπ).
    fn part_of_a_turn(&mut self, turn: &Rational) -> Result<[Number; 2], NoBall> {
        let other = Rational::new(1, 2) - turn.clone();
        for part in [turn, &other] {
            let order = (part.clone() * Rational::new(1, 2)).denominator().to_u64();
            let order = order.filter(|order| *order < 1 << 16).ok_or(NoBall::TooLong)?;
            self.parts_of_a_turn = self.parts_of_a_turn.lcm(&order);
            if self.parts_of_a_turn >= 1 << 20 {
                return Err(NoBall::TooLong);
            }
        }
        Ok([Number::cosine_of_part(turn, self.bits)?, Number::cosine_of_part(&other, self.bits)?])
    }

    /// The exponential and its kin, where the exponent is made of logarithms, or random.
    fn exponential(&mut self, function: Function, x: ExprId) -> Result<Option<Form>, NoBall> {
        let form = self.known[&x].form.clone();
        let of_logarithms = form.filter(|form| {
            let has_more = !form.has_no_number() || !form.turns.is_zero() || !form.arcs.is_empty();
            !(has_more || self.is_random() && form.logarithms.is_empty())
        });
        let power = if of_logarithms.is_none() && self.is_random() {
            let mut product = Number::of(&Rational::ONE, self.bits);
            for (term, coefficient) in self.graph.angle_terms(x) {
                let times = self.multiple(&coefficient)?;
                product = product.times(&self.exponential_of(term)?.power(times)?)?;
            }
            product
        } else {
            let Some(form) = of_logarithms else { return Ok(None) };
            let mut product = Number::of(&Rational::ONE, self.bits);
            for (index, (q, base)) in form.logarithms.iter().enumerate() {
                let Some((n, d)) = q.to_small().filter(|(n, d)| n.abs() < 1 << 16 && *d < 1 << 8) else {
                    return Ok(None);
                };
                let degree = d * (1 + i64::try_from(index).unwrap_or(0) * (1 << 10));
                let root = if d == 1 { base.clone() } else { self.adjoined(x, degree, base, d)? };
                product = product.times(&root.power(n)?)?;
            }
            product
        };
        let inverse = power.power(-1)?;
        let half = Rational::new(1, 2);
        let odd = || Number::sum([(half.clone(), &power), (-half.clone(), &inverse)].into_iter(), self.bits);
        let even = || Number::sum([(half.clone(), &power), (half.clone(), &inverse)].into_iter(), self.bits);
        Ok(Some(Form::of(match function {
            Function::Sinh => odd(),
            Function::Cosh => even(),
            Function::Tanh => odd().times(&even().power(-1)?)?,
            _ => power,
        })))
    }

    /// A root that is told from others of the same expression by `key`.
    fn adjoined(&mut self, of: ExprId, key: i64, number: &Number, degree: i64) -> Result<Number, NoBall> {
        if self.roots.insert((of, key)) {
            self.degree = self.degree.saturating_mul(degree.unsigned_abs());
        }
        number.root(u32::try_from(degree).map_err(|_| NoBall::TooLong)?)
    }

    /// The random number that stands for the exponential of a term.
    fn exponential_of(&self, term: Option<ExprId>) -> Result<Number, NoBall> {
        let value = self.random(Stream::Exponential, self.key(term));
        Ok(Number::of(&value.into(), self.bits))
    }

    /// What distinguishes a term of an angle: its value where that is rational.
    fn key(&self, term: Option<ExprId>) -> u64 {
        let Some(term) = term else { return 1 };
        let rational =
            self.known.get(&term).and_then(|value| value.form.as_ref()?.algebraic.rational.clone());
        match rational.as_ref().and_then(Residue::of) {
            Some(value) if !self.exponents.contains(&term) => value.word(),
            _ => Residue::mixed(7, term.index() as u64).word(),
        }
    }

    /// `coefficient · division`, an integer that is not large.
    fn multiple(&self, coefficient: &Rational) -> Result<i64, NoBall> {
        const LARGEST: i64 = 1000;
        let times = (coefficient.clone() * Rational::from(self.division)).to_i64();
        times.filter(|n| n.abs() <= LARGEST).ok_or(NoBall::TooLong)
    }

    fn function2(&mut self, function: Function2, x: ExprId, y: ExprId) -> Result<Value, NoBall> {
        let (a, b) = (self.known[&x].clone(), self.known[&y].clone());
        if function == Function2::Atan2 {
            let numbers = [&b, &a].map(|value| value.form.clone().filter(Form::is_algebraic));
            let [Some(adjacent), Some(opposite)] = numbers else {
                return Ok(Value { ball: Ball::angle(&a.ball, &b.ball)?, form: None });
            };
            if self.is_zero(&adjacent)? && self.is_zero(&opposite)? {
                return Err(NoBall::Undefined);
            }
            let arcs = vec![(Rational::ONE, [adjacent.algebraic, opposite.algebraic])];
            return self.of_form(Form { arcs, ..Form::rational(&Rational::ZERO, self.bits) });
        }
        let difference = a.ball.minus(&b.ball);
        let first_is_larger = match (difference.is_positive(), difference.is_negative()) {
            (true, _) => true,
            (_, true) => false,
            _ if x == y => true,
            _ => return Err(NoBall::TooWide),
        };
        Ok(if first_is_larger == (function == Function2::Max) { a } else { b })
    }
}

/// A function of every number of a ball.
fn of_function(function: Function, x: &Ball) -> Enclosed {
    match function {
        Function::Sin => x.sine(),
        Function::Cos => x.cosine(),
        Function::Asin => x.arcsine(),
        Function::Acos => x.arccosine(),
        Function::Atan => x.arctangent(),
        Function::Exp => x.exp(),
        Function::Ln => x.ln(),
        Function::Abs => Ok(x.magnitude()),
        Function::Sign if x.is_positive() => Ok(Ball::of(&Rational::ONE, x.bits())),
        Function::Sign if x.is_negative() => Ok(Ball::of(&Rational::MINUS_ONE, x.bits())),
        Function::Sign => Err(NoBall::TooWide),
        Function::Sinh | Function::Cosh | Function::Tanh => {
            let (up, down) = (x.exp()?, x.negative().exp()?);
            match function {
                Function::Sinh => Ok(up.minus(&down).scaled(&Rational::new(1, 2))),
                Function::Cosh => Ok(up.plus(&down).scaled(&Rational::new(1, 2))),
                _ => up.minus(&down).over(&up.plus(&down)),
            }
        }
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
