//! Evaluation at random points of the prime field: one pass over the graph.
//!
//! Sine and cosine of an angle go through the rational parametrisation of the circle, one random
//! parameter for each term of the angle's normal form, so that the addition theorems and
//! `sin² + cos² = 1` hold; multiples of π/12 have their exact values. `exp` likewise through one
//! random unit for each term. Square roots are roots in the field; other functions are independent
//! kernels of their argument's value.

use super::field::Residue;
use super::graph::{Function, Function2, Graph, Node};
use super::number::Rational;
use crate::id::{ExprId, Id, SymbolId};
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
    pub(super) known: FxHashMap<ExprId, Residue>,
    /// The points of the circle above values: sine and cosine share them, and so do sums of angles.
    pub(super) units: FxHashMap<u64, (Residue, Residue)>,
    /// Cosine and sine of the angles that have occurred.
    pub(super) circles: FxHashMap<ExprId, (Residue, Residue)>,
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
        let (known, units, circles) = Default::default();
        Self { graph, point, division, known, units, circles }
    }

    pub(crate) fn graph(&self) -> &'a Graph {
        self.graph
    }

    /// The values of `roots`.
    ///
    /// # Errors
    /// Where some root has no value there, or ever.
    pub(crate) fn evaluate(&mut self, roots: &[ExprId]) -> Result<Vec<Residue>, NoValue> {
        if roots.iter().any(|root| !self.known.contains_key(root)) {
            let order = self.graph.reachable(roots);
            self.evaluate_in_order(order)?;
        }
        Ok(roots.iter().map(|root| self.known[root]).collect())
    }

    fn evaluate_in_order(&mut self, order: Vec<ExprId>) -> Result<(), NoValue> {
        for id in order {
            if !self.known.contains_key(&id) {
                limits::spend(1 + self.graph.node(id).breadth());
                let value = self.value(id)?;
                self.known.insert(id, value);
            }
        }
        Ok(())
    }

    /// Gives a symbol a value before it occurs; false where it has another value already.
    #[must_use]
    pub(crate) fn choose(&mut self, symbol: SymbolId, value: Residue) -> bool {
        *self.point.chosen.entry(symbol).or_insert(value) == value
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
            Node::Number(value) => Residue::of(value).ok_or(NoValue::Here),
            Node::Pi => Ok(self.random(Stream::Pi, 0)),
            Node::Constant(constant) => {
                Residue::of(&self.graph.constants()[*constant].value).ok_or(NoValue::Here)
            }
            Node::Symbol(symbol) => Ok(self.point.chosen.get(symbol).copied().unwrap_or_else(|| {
                let word = u64::try_from(symbol.index()).unwrap_or(0);
                self.random(Stream::Symbol, word)
            })),
            Node::Sum { constant, terms } => {
                let mut sum = Residue::of(constant).ok_or(NoValue::Here)?;
                for (term, coefficient) in terms.iter() {
                    sum = sum + Residue::of(coefficient).ok_or(NoValue::Here)? * self.known[term];
                }
                Ok(sum)
            }
            Node::Product { coefficient, factors } => {
                let mut product = Residue::of(coefficient).ok_or(NoValue::Here)?;
                for (base, exponent) in factors.iter() {
                    product = product * self.power(*base, exponent)?;
                }
                Ok(product)
            }
            Node::Apply(function, x) => self.function(*function, *x),
            Node::Apply2(function, x, y) => {
                let kernel = Residue::mixed(self.known[x].word(), self.known[y].word()).word();
                let kind = match function {
                    Function2::Atan2 => 101,
                    Function2::Min => 102,
                    Function2::Max => 103,
                };
                Ok(self.random(Stream::Kernel, Residue::mixed(kind, kernel).word()))
            }
        }
    }

    pub(super) fn power(&self, base: ExprId, exponent: &Rational) -> Value {
        let x = self.known[&base];
        match exponent.to_small() {
            Some((n, 1)) => x.integer_power(n).ok_or(NoValue::Here),
            Some((n, d)) => {
                let root = match self.graph.as_number(base) {
                    Some(number) => self.root_of_number(number, d.unsigned_abs())?,
                    None => self.root(x, d.unsigned_abs())?,
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
        x.root(order).ok_or(NoValue::Here)
    }

    /// The root of a positive number. Where the field has none, any number stands for it: what vanishes then
    /// does so whatever the root is, and what needs its square is left to the roots of real numbers.
    fn root_of_number(&self, number: &Rational, order: u64) -> Value {
        if number.is_negative() {
            return Err(NoValue::Ever(format!("a root of {number} is outside what the zero test can treat")));
        }
        let value = Residue::of(number).ok_or(NoValue::Here)?;
        let root = if Residue::has_roots(order) { value.root(order) } else { None };
        Ok(root.unwrap_or_else(|| self.random(Stream::Kernel, Residue::mixed(order, value.word()).word())))
    }

    fn function(&mut self, function: Function, x: ExprId) -> Value {
        match function {
            Function::Sin => Ok(self.circle(x)?.1),
            Function::Cos => Ok(self.circle(x)?.0),
            Function::Exp => self.exponential(x),
            Function::Sinh | Function::Cosh | Function::Tanh => {
                let half = Residue::of_word(2).inverse().ok_or(NoValue::Here)?;
                let up = self.exponential(x)?;
                let down = up.inverse().ok_or(NoValue::Here)?;
                match function {
                    Function::Sinh => Ok((up - down) * half),
                    Function::Cosh => Ok((up + down) * half),
                    _ => Ok((up - down) * (up + down).inverse().ok_or(NoValue::Here)?),
                }
            }
            Function::Sign => Ok(self.sign(self.known[&x])),
            Function::Asin | Function::Atan => {
                let (x, is_negative) = self.known[&x].up_to_sign();
                let value = self.of_kernel(function, x);
                Ok(if is_negative { -value } else { value })
            }
            Function::Abs => Ok(self.of_kernel(function, self.known[&x].up_to_sign().0)),
            Function::Acos | Function::Ln => Ok(self.of_kernel(function, self.known[&x])),
        }
    }

    /// The kernel of the sign, an odd function.
    pub(super) fn sign(&self, x: Residue) -> Residue {
        let (x, is_negative) = x.up_to_sign();
        let value = self.of_kernel(Function::Sign, x);
        if is_negative { -value } else { value }
    }

    fn of_kernel(&self, function: Function, x: Residue) -> Residue {
        self.random(Stream::Kernel, Residue::mixed(function as u64, x.word()).word())
    }
}
