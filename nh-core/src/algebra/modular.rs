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
use num_integer::Integer;
use num_traits::ToPrimitive;
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

type Value = Result<Residue, NoValue>;

impl Graph {
    /// Evaluates `roots` at a point of the field.
    ///
    /// # Errors
    /// Where some root has no value there, or ever.
    pub fn evaluate_in_field(&self, roots: &[ExprId], point: &FieldPoint) -> Result<Vec<Residue>, NoValue> {
        let order = self.reachable(roots);
        let division = self.angle_division(&order)?;
        let (known, units) = (FxHashMap::default(), FxHashMap::default());
        let mut pass = Pass { graph: self, point, division, known, units };
        pass.known.reserve(order.len());
        for id in order {
            let value = pass.value(id)?;
            pass.known.insert(id, value);
        }
        Ok(roots.iter().map(|root| pass.known[root]).collect())
    }

    /// The common denominator of the coefficients inside sine, cosine and exp.
    pub(super) fn angle_division(&self, order: &[ExprId]) -> Result<i64, NoValue> {
        let mut division: i64 = 1;
        for id in order {
            let Node::Apply(
                Function::Sin
                | Function::Cos
                | Function::Exp
                | Function::Sinh
                | Function::Cosh
                | Function::Tanh,
                x,
            ) = self.node(*id)
            else {
                continue;
            };
            for (_, coefficient) in self.angle_terms(*x) {
                division = coefficient
                    .denominator()
                    .to_i64()
                    .map(|d| division.lcm(&d))
                    .filter(|lcm| *lcm < 1 << 20)
                    .ok_or_else(|| {
                        NoValue::Ever("an angle has coefficients with large denominators".into())
                    })?;
            }
        }
        Ok(division)
    }

    /// The argument of a periodic function as terms with coefficients; the number among them
    /// stands as a multiple of itself being 1.
    pub(super) fn angle_terms(&self, x: ExprId) -> Vec<(Option<ExprId>, Rational)> {
        let scaled = |term: ExprId, coefficient: &Rational| {
            let factor = self.angle_factor(term).unwrap_or(Rational::ONE);
            (Some(term), coefficient.clone() * factor)
        };
        match self.node(x) {
            Node::Number(value) => vec![(None, value.clone())],
            Node::Sum { constant, terms } => {
                let mut list: Vec<_> = terms.iter().map(|(term, c)| scaled(*term, c)).collect();
                if !constant.is_zero() {
                    list.push((None, constant.clone()));
                }
                list
            }
            Node::Product { coefficient, .. } => vec![scaled(x, coefficient)],
            _ => vec![scaled(x, &Rational::ONE)],
        }
    }

    /// The constants among the factors of a term of an angle, which count as its coefficient. With a long
    /// denominator they do not: then an identity has to hold for any value.
    fn angle_factor(&self, term: ExprId) -> Option<Rational> {
        let factor = self.constant_factor(term);
        (factor.is_one() || factor.denominator() <= LONGEST_DENOMINATOR.into()).then_some(factor)
    }
}

/// Denominators of constants in angles up to which these are numbers: common denominators stay short.
const LONGEST_DENOMINATOR: i64 = 1000;

struct Pass<'a> {
    graph: &'a Graph,
    point: &'a FieldPoint,
    division: i64,
    known: FxHashMap<ExprId, Residue>,
    /// The points of the circle above values: sine and cosine share them, and so do sums of angles.
    units: FxHashMap<u64, (Residue, Residue)>,
}

/// Separate streams of random numbers for separate purposes.
#[derive(Clone, Copy)]
enum Stream {
    Symbol = 1,
    Circle,
    Exponential,
    Kernel,
    Pi,
}

impl Pass<'_> {
    fn random(&self, stream: Stream, number: u64) -> Residue {
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

    fn power(&self, base: ExprId, exponent: &Rational) -> Value {
        let x = self.known[&base];
        match exponent.to_small() {
            Some((n, 1)) => x.integer_power(n).ok_or(NoValue::Here),
            Some((n, 2)) => {
                let root = match self.graph.as_number(base) {
                    Some(number) => root_of_number(number)?,
                    None => x.sqrt().ok_or(NoValue::Here)?,
                };
                root.integer_power(n).ok_or(NoValue::Here)
            }
            // other roots: one kernel for each base and denominator
            Some((n, d)) => {
                let kernel = Residue::mixed(d.unsigned_abs(), x.word()).word();
                self.random(Stream::Kernel, kernel).integer_power(n).ok_or(NoValue::Here)
            }
            None => Err(NoValue::Ever("an exponent is too large".into())),
        }
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
            Function::Asin
            | Function::Acos
            | Function::Atan
            | Function::Ln
            | Function::Abs
            | Function::Sign => {
                let kind = function as u64;
                Ok(self.random(Stream::Kernel, Residue::mixed(kind, self.known[&x].word()).word()))
            }
        }
    }

    /// The terms of an angle, products of sums multiplied out, as field values with coefficients.
    fn normal_terms(&self, x: ExprId) -> Vec<(Option<SymbolId>, Residue, Rational)> {
        let mut list = Vec::new();
        for (term, coefficient) in self.graph.angle_terms(x) {
            match term {
                None => list.push((None, Residue::ONE, coefficient)),
                Some(term) => list.extend(self.expanded(term, &coefficient)),
            }
        }
        list
    }

    /// Multiplies out the positive powers of sums in a product, within a budget.
    fn expanded(&self, term: ExprId, scale: &Rational) -> Vec<(Option<SymbolId>, Residue, Rational)> {
        const BUDGET: usize = 256;
        let whole =
            |coefficient: Rational, value: Residue| vec![(self.graph.as_symbol(term), value, coefficient)];
        let constant = self.graph.angle_factor(term);
        let over = |number: Rational| Residue::of(&number).and_then(Residue::inverse).unwrap_or(Residue::ONE);
        let unit = over(constant.clone().unwrap_or(Rational::ONE));
        let Node::Product { coefficient, factors } = self.graph.node(term) else {
            return whole(scale.clone(), self.known[&term] * unit);
        };
        let unit = over(coefficient.clone()) * unit;
        let mut list = vec![(Residue::ONE, scale.clone())];
        let is_coefficient = |(base, exponent): &&(ExprId, Rational)| {
            constant.is_some() && exponent.is_integer() && self.graph.value_of(*base).is_some()
        };
        let factors: Vec<_> = factors.iter().filter(|factor| !is_coefficient(factor)).collect();
        for (base, exponent) in &factors {
            let times = exponent.to_i64().filter(|n| (1..=4).contains(n)).unwrap_or(0);
            if let (Node::Sum { constant, terms }, 1..) = (self.graph.node(*base), times) {
                for _ in 0..times {
                    if list.len() * (terms.len() + 1) > BUDGET {
                        return whole(scale.clone(), self.known[&term] * unit);
                    }
                    let mut next = Vec::new();
                    for (value, c) in &list {
                        next.extend(terms.iter().map(|(t, d)| {
                            let factor = self.graph.angle_factor(*t).unwrap_or(Rational::ONE);
                            let of_rest = *value * self.known[t] * over(factor.clone());
                            (of_rest, c.clone() * d.clone() * factor)
                        }));
                        if !constant.is_zero() {
                            next.push((*value, c.clone() * constant.clone()));
                        }
                    }
                    list = next;
                }
            } else if let Ok(power) = self.power(*base, exponent) {
                for (value, _) in &mut list {
                    *value = *value * power;
                }
            }
        }
        let symbol = match factors.as_slice() {
            [(base, exponent)] if exponent.is_one() => self.graph.as_symbol(*base),
            _ => None,
        };
        list.into_iter().map(|(value, c)| (symbol, value, c)).collect()
    }

    /// `(cos x, sin x)`.
    fn circle(&mut self, x: ExprId) -> Result<(Residue, Residue), NoValue> {
        let mut turned = (Residue::ONE, Residue::ZERO);
        let pi = self.random(Stream::Pi, 0);
        for (symbol, value, coefficient) in self.normal_terms(x) {
            if value == pi
                && let Some(twelfths) = (coefficient.clone() * Rational::from(12)).to_i64()
            {
                turned = rotate(turned, circle_power(twelfth_of_pi()?, twelfths));
                continue;
            }
            let times = self.multiple(&coefficient)?;
            let chosen = symbol.and_then(|symbol| self.point.circle.get(&symbol));
            let (unit, times) = match chosen {
                Some(unit) => {
                    let whole = coefficient.to_i64().ok_or(NoValue::Here)?;
                    (*unit, whole)
                }
                None => (self.unit_of(value)?, times),
            };
            turned = rotate(turned, circle_power(unit, times));
        }
        Ok(turned)
    }

    /// The random point of the circle above `value / division`.
    fn unit_of(&mut self, value: Residue) -> Result<(Residue, Residue), NoValue> {
        if let Some(unit) = self.units.get(&value.word()) {
            return Ok(*unit);
        }
        let u = self.random(Stream::Circle, value.word());
        let scale = (Residue::ONE + u * u).inverse().ok_or(NoValue::Here)?;
        let unit = ((Residue::ONE - u * u) * scale, (u + u) * scale);
        self.units.insert(value.word(), unit);
        Ok(unit)
    }

    fn exponential(&self, x: ExprId) -> Value {
        let mut product = Residue::ONE;
        for (_, value, coefficient) in self.normal_terms(x) {
            let times = self.multiple(&coefficient)?;
            let unit = self.random(Stream::Exponential, value.word());
            product = product * unit.integer_power(times).ok_or(NoValue::Here)?;
        }
        Ok(product)
    }

    /// `coefficient · division`, an integer.
    fn multiple(&self, coefficient: &Rational) -> Result<i64, NoValue> {
        (coefficient.clone() * Rational::from(self.division)).to_i64().ok_or(NoValue::Here)
    }
}

/// `(cos π/12, sin π/12)`. Either choice of either root gives a point whose sixth power is (0, 1).
fn twelfth_of_pi() -> Result<(Residue, Residue), NoValue> {
    let root = |n| Residue::of_word(n).sqrt().ok_or(NoValue::Here);
    let (r2, r6) = (root(2)?, root(6)?);
    let quarter = Residue::of_word(4).inverse().ok_or(NoValue::Here)?;
    Ok(((r6 + r2) * quarter, (r6 - r2) * quarter))
}

fn rotate(a: (Residue, Residue), b: (Residue, Residue)) -> (Residue, Residue) {
    (a.0 * b.0 - a.1 * b.1, a.0 * b.1 + a.1 * b.0)
}

fn circle_power(unit: (Residue, Residue), times: i64) -> (Residue, Residue) {
    let mut base = if times < 0 { (unit.0, -unit.1) } else { unit };
    let mut exponent = times.unsigned_abs();
    let mut result = (Residue::ONE, Residue::ZERO);
    while exponent > 0 {
        if exponent & 1 == 1 {
            result = rotate(result, base);
        }
        base = rotate(base, base);
        exponent >>= 1;
    }
    result
}

/// The square root of a positive number whose prime factors are small.
fn root_of_number(number: &Rational) -> Value {
    let unsupported = || NoValue::Ever(format!("sqrt({number}) is outside what the zero test can treat"));
    if number.is_negative() {
        return Err(unsupported());
    }
    Residue::of(number).and_then(Residue::sqrt).ok_or_else(unsupported)
}
