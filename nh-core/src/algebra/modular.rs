//! Evaluation at random points of the prime field: one pass over the graph.
//!
//! Sine and cosine of an angle go through the rational parametrisation of the circle, one random
//! parameter for each term of the angle's normal form, so that the addition theorems and
//! `sin² + cos² = 1` hold; multiples of π/12 have their exact values. `exp` likewise through one
//! random unit for each term. Square roots are roots in the field; other functions are independent
//! kernels of their argument's value.

use super::field::Residue;
use super::graph::Graph;
use super::node::{Function, Function2, Node};
use super::number::Rational;
use crate::id::{ExprId, Id, SymbolId};
use crate::id_map::IdMap;
use crate::limits;
use rustc_hash::FxHashMap;

/// A random point: values of the symbols, and of the circle above each angle.
#[derive(Clone, Debug, Default)]
pub struct FieldPoint {
    /// Distinguishes the random choices of one point from those of another.
    pub seed: u64,
    /// Values chosen by the caller instead of at random.
    pub chosen: FxHashMap<SymbolId, Residue>,
    /// `(cos, sin)` of angles that are a single symbol, chosen by the caller.
    pub circle: FxHashMap<SymbolId, (Residue, Residue)>,
    /// exp of symbols over the common denominator of the coefficients, chosen by the caller.
    pub exponentials: FxHashMap<SymbolId, Residue>,
}

impl FieldPoint {
    /// The random point number `seed`.
    #[must_use]
    pub fn random(seed: u64) -> Self {
        Self { seed, ..Self::default() }
    }
}

/// Why a point gives no value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NoValue {
    /// A pole, or a square root outside the field, at this point: another may do.
    Here,
    /// Outside what the method can treat, with the reason.
    Ever(String),
}

pub(super) type Value = Result<Residue, NoValue>;

impl Graph {
    /// A root of a number that the field has not, as text.
    pub(crate) fn root_outside_field(&self, roots: &[ExprId]) -> Option<String> {
        let is_missing = |base: ExprId, order: u64| match self.value_of(base) {
            Some(number) if order == 2 => Residue::root_of_number(number).is_none(),
            Some(_) => !Residue::has_roots(order),
            None => {
                let value = self.evaluate_in_field(&[base], &FieldPoint::random(0));
                let root =
                    |value: Residue| if order == 2 { value.root_of_constant() } else { value.root(order) };
                value.is_ok_and(|values| root(values[0]).is_none())
            }
        };
        self.reachable(roots).into_iter().find_map(|id| {
            let Node::Product { factors, .. } = self.node(id) else { return None };
            let roots = factors.iter().filter_map(|(base, exponent)| {
                let order = exponent.to_small().map_or(1, |(_, d)| d.unsigned_abs());
                (order > 1 && self.symbols_in(&[*base]).is_empty()).then_some((*base, order))
            });
            let (base, order) = roots.into_iter().find(|(base, order)| is_missing(*base, *order))?;
            Some(format!("root of order {order} of {}", self.text(base)))
        })
    }

    /// Evaluates `roots` at a point of the field.
    ///
    /// # Errors
    /// Where some root has no value there, or ever.
    pub fn evaluate_in_field(&self, roots: &[ExprId], point: &FieldPoint) -> Result<Vec<Residue>, NoValue> {
        let order = self.reachable(roots);
        let mut pass = FieldPass::new(self, point.clone(), self.angle_division_among(&order));
        pass.known.reserve(order.len());
        pass.evaluate_in_order(order)?;
        Ok(roots.iter().map(|root| pass.known[root]).collect())
    }
}

/// The evaluation of expressions at one point: what has a value once keeps it.
#[derive(Clone)]
pub(crate) struct FieldPass<'a> {
    pub(super) graph: &'a Graph,
    pub(super) point: FieldPoint,
    /// The common denominator of the coefficients inside sine, cosine and exp.
    pub(super) division: i64,
    pub(super) known: IdMap<ExprId, Residue>,
    /// What is yet to be evaluated.
    open: Vec<ExprId>,
    /// The points of the circle above values: sine and cosine share them, and so do sums of angles.
    pub(super) units: FxHashMap<u64, (Residue, Residue)>,
    /// Cosine and sine of the angles that have occurred.
    pub(super) circles: IdMap<ExprId, (Residue, Residue)>,
    /// The arguments of the exponentials that have occurred, by the magnitudes of their values.
    pub(super) logarithms: FxHashMap<u64, Residue>,
    /// What symbols stand for: in sines and exponentials they count as that.
    pub(super) images: FxHashMap<SymbolId, ExprId>,
    /// Whether functions are those of the values of their arguments alone.
    by_value: bool,
    /// Whether sines of arcs are algebraic, as exponentials of logarithms are, and logarithms of products sums.
    pub(super) relates_arcs: bool,
}

/// What a root is taken of.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Radicand<'n> {
    /// A rational number.
    Number(&'n Rational),
    /// A number that is made of such.
    Constant,
    /// Something that has other values at other points.
    Varying,
}

/// Separate streams of random numbers for separate purposes.
#[derive(Clone, Copy)]
pub(super) enum Stream {
    Symbol = 1,
    Circle,
    Exponential,
    Kernel,
    Pi,
}

impl<'a> FieldPass<'a> {
    /// At a point; `division` is the [`Graph::angle_division`] of all that will be evaluated.
    pub(crate) fn new(graph: &'a Graph, point: FieldPoint, division: i64) -> Self {
        let (known, open, units, circles, logarithms, images) = Default::default();
        let (by_value, relates_arcs) = (false, true);
        Self {
            graph,
            point,
            division,
            known,
            open,
            units,
            circles,
            logarithms,
            images,
            by_value,
            relates_arcs,
        }
    }

    /// The same with arcs and logarithms as kernels of their values: what is written in other steps has these.
    pub(crate) fn without_arcs(graph: &'a Graph, point: FieldPoint, division: i64) -> Self {
        Self { relates_arcs: false, ..Self::new(graph, point, division) }
    }

    /// The same without the addition theorems: sine, cosine and exponential are kernels of the values of their
    /// arguments. What is equal then is equal with them, and need not be written with the same angles.
    pub(crate) fn by_value(graph: &'a Graph, point: FieldPoint) -> Self {
        Self { by_value: true, ..Self::without_arcs(graph, point, 1) }
    }

    pub(crate) fn graph(&self) -> &'a Graph {
        self.graph
    }

    /// The number of the point.
    pub(crate) fn seed(&self) -> u64 {
        self.point.seed
    }

    /// The values of `roots`.
    ///
    /// # Errors
    /// Where some root has no value there, or ever.
    pub(crate) fn evaluate(&mut self, roots: &[ExprId]) -> Result<Vec<Residue>, NoValue> {
        let mut values = Vec::with_capacity(roots.len());
        for root in roots {
            values.push(self.evaluate_one(*root)?);
        }
        Ok(values)
    }

    /// The value of one expression.
    ///
    /// # Errors
    /// Where it has no value there, or ever.
    pub(crate) fn evaluate_one(&mut self, root: ExprId) -> Value {
        if let Some(value) = self.known.get(&root) {
            return Ok(*value);
        }
        let graph = self.graph;
        let mut open = std::mem::take(&mut self.open);
        open.clear();
        open.push(root);
        let mut steps = 0;
        // operands first; most of what is asked for is one step from what is known
        while let Some(&id) = open.last() {
            let before = open.len();
            match graph.node(id) {
                Node::Number(_) | Node::Pi | Node::Constant(_) | Node::Symbol(_) => {}
                Node::Sum { terms: list, .. } | Node::Product { factors: list, .. } => {
                    let (list, mut place): (&[(ExprId, Rational)], usize) = (list, 0);
                    while place < list.len() {
                        if !self.known.contains_key(&list[place].0) {
                            open.push(list[place].0);
                        }
                        place += 1;
                    }
                    steps += place;
                }
                Node::Apply(_, x) => {
                    if !self.known.contains_key(x) {
                        open.push(*x);
                    }
                }
                Node::Apply2(_, x, y) => {
                    for operand in [*x, *y] {
                        if !self.known.contains_key(&operand) {
                            open.push(operand);
                        }
                    }
                }
            }
            if open.len() == before {
                open.pop();
                if !self.known.contains_key(&id) {
                    steps += 1;
                    let value = self.value(id)?;
                    self.known.insert(id, value);
                }
            }
        }
        self.open = open;
        limits::spend(steps);
        Ok(self.known[&root])
    }

    /// Gives a symbol another value; what depends on it is to be evaluated again.
    pub(super) fn change(&mut self, symbol: SymbolId, value: Residue) {
        self.point.chosen.insert(symbol, value);
        if !self.circles.is_empty() {
            self.circles.clear();
        }
    }

    /// The value of one of some expressions, operands first, all of which are evaluated whether they have values or not.
    pub(super) fn evaluate_again(&mut self, expressions: &[ExprId], root: ExprId) -> Value {
        for id in expressions {
            let value = self.value(*id)?;
            self.known.insert(*id, value);
        }
        self.known.get(&root).copied().ok_or(NoValue::Here)
    }

    /// The point with all that was chosen.
    pub(super) fn into_point(self) -> FieldPoint {
        self.point
    }

    fn evaluate_in_order(&mut self, order: Vec<ExprId>) -> Result<(), NoValue> {
        limits::spend(order.iter().map(|id| 1 + self.graph.node(*id).breadth()).sum());
        for id in order {
            let value = self.value(id)?;
            self.known.insert(id, value);
        }
        Ok(())
    }

    /// Gives a symbol a value before it occurs; false where it has another value already.
    #[must_use]
    pub(crate) fn choose(&mut self, symbol: SymbolId, value: Residue) -> bool {
        *self.point.chosen.entry(symbol).or_insert(value) == value
    }

    /// Gives a symbol the value of an expression that has one, and says that it stands for it: sin(w) is sin(a + b) where
    /// w is a + b. Whether no other value was chosen before.
    pub(crate) fn choose_image(&mut self, symbol: SymbolId, image: ExprId) -> bool {
        if self.graph.as_symbol(image) != Some(symbol) {
            self.images.insert(symbol, image);
        }
        self.choose(symbol, self.known[&image])
    }

    /// The value of a function that is no formula, of its arguments' values alone.
    pub(crate) fn kernel(&self, name: &str, arguments: &[Residue]) -> Residue {
        let letters = name.bytes().map(|letter| Residue::of_word(letter.into()));
        let word = letters.chain(arguments.iter().copied());
        let word = word.fold(104, |hash, next| Residue::mixed(hash, next.word()).word());
        self.random(Stream::Kernel, word)
    }

    pub(super) fn random(&self, stream: Stream, number: u64) -> Residue {
        Residue::mixed(self.point.seed.wrapping_mul(8).wrapping_add(stream as u64), number)
    }

    fn value(&mut self, id: ExprId) -> Value {
        match self.graph.node(id) {
            Node::Number(value) => residue(value),
            Node::Pi => Ok(self.pi()),
            Node::Constant(constant) => residue(&self.graph.constants()[*constant].value),
            Node::Symbol(symbol) => Ok(self.symbol(*symbol)),
            Node::Sum { constant, terms } => {
                let mut sum = if constant.is_zero() { Residue::ZERO } else { residue(constant)? };
                let (terms, mut place): (&[(ExprId, Rational)], usize) = (terms, 0);
                while place < terms.len() {
                    let (term, coefficient) = &terms[place];
                    let value = self.known[term];
                    sum = sum + if coefficient.is_one() { value } else { residue(coefficient)? * value };
                    place += 1;
                }
                Ok(sum)
            }
            Node::Product { coefficient, factors } => {
                let mut product = if coefficient.is_one() { Residue::ONE } else { residue(coefficient)? };
                let (factors, mut place): (&[(ExprId, Rational)], usize) = (factors, 0);
                while place < factors.len() {
                    let (base, exponent) = &factors[place];
                    let power =
                        if exponent.is_one() { self.known[base] } else { self.power(*base, exponent)? };
                    product = product * power;
                    place += 1;
                }
                Ok(product)
            }
            Node::Apply(function, x) => {
                let value = self.known[x];
                match function {
                    Function::Sin | Function::Cos if !self.by_value => {
                        let (cos, sin) = self.circle(*x)?;
                        Ok(if *function == Function::Sin { sin } else { cos })
                    }
                    Function::Exp if !self.by_value => self.noted_exponential(*x),
                    Function::Ln if self.relates_arcs => self.logarithm(*x),
                    Function::Sinh | Function::Cosh | Function::Tanh if !self.by_value => {
                        hyperbolic(*function, self.noted_exponential(*x)?)
                    }
                    _ => self.function_of_value(*function, value),
                }
            }
            Node::Apply2(function, x, y) => {
                let (x, y) = (self.known[x], self.known[y]);
                Ok(self.function_of_values(*function, x, y))
            }
        }
    }

    /// The value of a symbol.
    pub(crate) fn symbol(&self, symbol: SymbolId) -> Residue {
        self.point.chosen.get(&symbol).copied().unwrap_or_else(|| {
            let word = u64::try_from(symbol.index()).unwrap_or(0);
            self.random(Stream::Symbol, word)
        })
    }

    /// What stands for π.
    pub(crate) fn pi(&self) -> Residue {
        self.random(Stream::Pi, 0)
    }

    pub(super) fn power(&self, base: ExprId, exponent: &Rational) -> Value {
        if let Some((times, 1)) = exponent.to_small() {
            return self.known[&base].integer_power(times).ok_or(NoValue::Here);
        }
        let root = |kind| self.power_of_value(self.known[&base], kind, exponent);
        match self.graph.value_of(base) {
            Some(number) => root(Radicand::Number(number)),
            None if !self.graph.symbols_in(&[base]).is_empty() => root(Radicand::Varying),
            None => root(Radicand::Constant),
        }
    }

    /// The power of a value.
    pub(crate) fn power_of_value(&self, x: Residue, kind: Radicand, exponent: &Rational) -> Value {
        match exponent.to_small() {
            Some((n, 1)) => x.integer_power(n).ok_or(NoValue::Here),
            Some((n, d)) => {
                let order = d.unsigned_abs();
                let root = match kind {
                    Radicand::Number(number) => self.root_of_number(number, order)?,
                    Radicand::Constant => self.root_of_constant(x, order),
                    Radicand::Varying => self.root(x, order)?,
                };
                root.integer_power(n).ok_or(NoValue::Here)
            }
            None => Err(NoValue::Ever("an exponent is too large".into())),
        }
    }

    /// The root of a value; one kernel for each value and order where the field has no such roots.
    fn root(&self, x: Residue, order: u64) -> Value {
        if !Residue::has_roots(order) {
            return Ok(self.random(Stream::Kernel, Residue::mixed(order, x.word()).word()));
        }
        limits::spend(Residue::ROOT_WORK);
        x.root(order).ok_or(NoValue::Here)
    }

    /// The root of a positive number. Where the field has none, any number stands for it: what vanishes then
    /// does so whatever the root is, and what needs its square is left to the roots of real numbers.
    fn root_of_number(&self, number: &Rational, order: u64) -> Value {
        if number.is_negative() {
            return Err(NoValue::Ever(format!("a root of {number} is outside what the zero test can treat")));
        }
        let value = Residue::of(number).ok_or(NoValue::Here)?;
        let root = match order {
            2 => Residue::root_of_number(number),
            _ if Residue::has_roots(order) => value.root(order),
            _ => None,
        };
        Ok(root.unwrap_or_else(|| self.random(Stream::Kernel, Residue::mixed(order, value.word()).word())))
    }

    /// The root of a number that is made of others, nested roots, say: another point has no other one. Where the field
    /// has none, any number stands for it, as for those of rational numbers.
    fn root_of_constant(&self, x: Residue, order: u64) -> Residue {
        let root = match order {
            2 => x.root_of_constant(),
            _ => x.root(order),
        };
        root.unwrap_or_else(|| self.random(Stream::Kernel, Residue::mixed(order, x.word()).word()))
    }

    /// A function of two values.
    pub(crate) fn function_of_values(&self, function: Function2, x: Residue, y: Residue) -> Residue {
        let kernel = Residue::mixed(x.word(), y.word()).word();
        let kind = match function {
            Function2::Atan2 => 101,
            Function2::Min => 102,
            Function2::Max => 103,
        };
        self.random(Stream::Kernel, Residue::mixed(kind, kernel).word())
    }

    /// A function of a value; sine, cosine and exponential without the addition theorems.
    pub(crate) fn function_of_value(&mut self, function: Function, x: Residue) -> Value {
        match function {
            Function::Sin | Function::Cos => {
                let (x, is_negative) = x.up_to_sign();
                let (cos, sin) = self.unit_of(x)?;
                let sin = if is_negative { -sin } else { sin };
                Ok(if function == Function::Sin { sin } else { cos })
            }
            Function::Exp => self.exponential_of_value(x),
            Function::Sinh | Function::Cosh | Function::Tanh => {
                hyperbolic(function, self.exponential_of_value(x)?)
            }
            Function::Sign => Ok(self.sign(x)),
            Function::Asin | Function::Atan => {
                let (x, is_negative) = x.up_to_sign();
                let value = self.of_kernel(function, x);
                Ok(if is_negative { -value } else { value })
            }
            Function::Abs => Ok(self.sign(x) * x),
            // a quarter of a turn less the arc of the sine
            Function::Acos => {
                let quarter = self.pi() * Residue::of_word(2).inverse().ok_or(NoValue::Here)?;
                Ok(quarter - self.function_of_value(Function::Asin, x)?)
            }
            Function::Ln => Ok(self.of_kernel(function, x)),
        }
    }

    /// exp(−x) is 1/exp x.
    fn exponential_of_value(&self, x: Residue) -> Value {
        let (x, is_negative) = x.up_to_sign();
        let value = self.random(Stream::Exponential, x.word());
        if is_negative { value.inverse().ok_or(NoValue::Here) } else { Ok(value) }
    }

    /// The kernel of the sign, an odd function.
    pub(super) fn sign(&self, x: Residue) -> Residue {
        let (x, is_negative) = x.up_to_sign();
        let value = self.of_kernel(Function::Sign, x);
        if is_negative { -value } else { value }
    }

    pub(super) fn of_kernel(&self, function: Function, x: Residue) -> Residue {
        self.random(Stream::Kernel, Residue::mixed(function as u64, x.word()).word())
    }
}

fn residue(number: &Rational) -> Value {
    match Residue::of(number) {
        Some(value) => Ok(value),
        None => Err(NoValue::Here),
    }
}

/// A hyperbolic function of what has this exponential.
fn hyperbolic(function: Function, up: Residue) -> Value {
    let half = Residue::of_word(2).inverse().ok_or(NoValue::Here)?;
    let down = up.inverse().ok_or(NoValue::Here)?;
    match function {
        Function::Sinh => Ok((up - down) * half),
        Function::Cosh => Ok((up + down) * half),
        _ => Ok((up - down) * (up + down).inverse().ok_or(NoValue::Here)?),
    }
}
