//! Evaluation in floating point, with a bound on the rounding error of every value.

use super::graph::Graph;
use super::node::{Function, Function2, Node};
use super::number::Rational;
use crate::id::{ExprId, SymbolId};
use crate::id_map::IdMap;
use crate::limits;

/// A floating-point value and a bound on how far it is from the exact one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounded {
    /// The computed value.
    pub value: f64,
    /// The bound on its absolute error.
    pub error: f64,
}

impl Bounded {
    fn exact(value: f64) -> Self {
        Self { value, error: 0.0 }
    }

    /// Adds the rounding of the operation that produced the value.
    pub(crate) fn rounded(value: f64, error: f64) -> Self {
        // what is not normal has an absolute error
        Self { value, error: error + 2.0 * f64::EPSILON * value.abs() + f64::MIN_POSITIVE }
    }

    /// An exact number as it is read.
    pub(crate) fn of_number(number: &Rational) -> Self {
        Self::rounded(number.to_f64(), 0.0)
    }

    /// a/b, where b is certainly not zero.
    pub(super) fn over(self, b: Self) -> Self {
        let value = self.value / b.value;
        let error = (self.error + value.abs() * b.error) / (b.value.abs() - b.error);
        Self::rounded(value, error)
    }

    /// a − b c.
    pub(super) fn less_product(self, b: Self, c: Self) -> Self {
        let product = Self::rounded(
            b.value * c.value,
            b.value.abs() * c.error + c.value.abs() * b.error + b.error * c.error,
        );
        Self::rounded(self.value - product.value, self.error + product.error)
    }

    /// Whether the exact value certainly differs from zero.
    #[must_use]
    pub fn is_certainly_nonzero(self) -> bool {
        self.value.is_finite()
            && self.error.is_finite()
            && self.value.abs() > 4.0 * self.error
            && self.value != 0.0
    }

    /// Whether the value is zero as far as its error bound tells.
    #[must_use]
    pub fn may_be_zero(self) -> bool {
        self.value.is_finite() && self.value.abs() <= 4.0 * self.error
    }
}

/// Expressions that are evaluated at many points: the walk through the graph is taken once, and numbers are read once.
#[derive(Debug)]
pub(crate) struct Evaluator {
    /// All that the roots are made of, operands first.
    steps: Box<[Step]>,
    /// The places of the roots.
    roots: Vec<usize>,
    /// The values at the present point.
    known: Box<[Bounded]>,
}

/// A node with the places of its operands.
#[derive(Debug)]
enum Step {
    Given(Bounded),
    Symbol(SymbolId),
    Sum { constant: f64, terms: Box<[(usize, f64)]> },
    Product { coefficient: f64, factors: Box<[(usize, Power)]> },
    Apply(Function, usize),
    Apply2(Function2, [usize; 2]),
}

/// An exponent, and the correctly rounded operation where there is one.
#[derive(Clone, Copy, Debug)]
struct Power {
    operation: Operation,
    exponent: f64,
}

#[derive(Clone, Copy, Debug)]
enum Operation {
    Nothing,
    Square,
    Root,
    Reciprocal,
    Any,
}

impl Evaluator {
    /// The values of the roots at a point.
    pub(crate) fn at(&mut self, value: impl Fn(SymbolId) -> f64) -> Vec<Bounded> {
        let Self { steps, roots, known } = self;
        limits::spend(steps.len());
        let mut place = 0;
        while place < steps.len() {
            known[place] = steps[place].value(known, &value);
            place += 1;
        }
        roots.iter().map(|root| known[*root]).collect()
    }
}

impl Graph {
    /// Evaluates `roots` with the given values of the symbols.
    pub fn evaluate(&self, roots: &[ExprId], value: impl Fn(SymbolId) -> f64) -> Vec<Bounded> {
        self.evaluate_each(roots, std::iter::once(value)).next().unwrap_or_default()
    }

    /// The values of `roots` at one point after the other.
    pub(super) fn evaluate_each<F: Fn(SymbolId) -> f64>(
        &self,
        roots: &[ExprId],
        points: impl Iterator<Item = F>,
    ) -> impl Iterator<Item = Vec<Bounded>> {
        let mut evaluator = self.evaluator(roots);
        points.map(move |value| evaluator.at(value))
    }

    /// Makes `roots` ready to be evaluated at many points.
    #[must_use]
    pub(crate) fn evaluator(&self, roots: &[ExprId]) -> Evaluator {
        let order = self.reachable(roots);
        let mut places = IdMap::default();
        places.reserve(order.len());
        let mut steps = Vec::with_capacity(order.len());
        for (place, id) in order.iter().enumerate() {
            steps.push(self.step(*id, &places));
            places.insert(*id, place);
        }
        let roots = roots.iter().map(|root| places[root]).collect();
        let known = vec![Bounded::exact(0.0); steps.len()].into_boxed_slice();
        Evaluator { steps: steps.into_boxed_slice(), roots, known }
    }

    fn step(&self, id: ExprId, places: &IdMap<ExprId, usize>) -> Step {
        match self.node(id) {
            Node::Number(number) => Step::Given(Bounded::of_number(number)),
            Node::Constant(constant) => Step::Given(Bounded::of_number(&self.constants()[*constant].value)),
            Node::Pi => Step::Given(Bounded::rounded(std::f64::consts::PI, 0.0)),
            Node::Symbol(symbol) => Step::Symbol(*symbol),
            Node::Sum { constant, terms } => Step::Sum {
                constant: constant.to_f64(),
                terms: terms.iter().map(|(term, coefficient)| (places[term], coefficient.to_f64())).collect(),
            },
            Node::Product { coefficient, factors } => Step::Product {
                coefficient: coefficient.to_f64(),
                factors: factors.iter().map(|(base, exponent)| (places[base], Power::of(exponent))).collect(),
            },
            Node::Apply(function, x) => Step::Apply(*function, places[x]),
            Node::Apply2(function, x, y) => Step::Apply2(*function, [places[x], places[y]]),
        }
    }
}

impl Step {
    /// Written with indices: unoptimised builds spend much of a derivation here.
    fn value(&self, known: &[Bounded], value: &impl Fn(SymbolId) -> f64) -> Bounded {
        match self {
            Self::Given(number) => *number,
            Self::Symbol(symbol) => Bounded::exact(value(*symbol)),
            Self::Sum { constant, terms } => {
                let mut sum = *constant;
                let mut error = sum.abs() * f64::EPSILON;
                let mut number = 0;
                while number < terms.len() {
                    let (place, coefficient) = terms[number];
                    let x = known[place];
                    sum += coefficient * x.value;
                    error += coefficient.abs() * (x.error + 2.0 * f64::EPSILON * x.value.abs())
                        + f64::EPSILON * sum.abs();
                    number += 1;
                }
                Bounded { value: sum, error }
            }
            Self::Product { coefficient, factors } => {
                let mut product = *coefficient;
                let mut relative = 2.0 * f64::EPSILON;
                let mut number = 0;
                while number < factors.len() {
                    let (place, power) = factors[number];
                    let x = known[place];
                    product *= power.of_real(x.value);
                    relative += (2.0 + power.exponent.abs()) * f64::EPSILON;
                    if x.error > 0.0 {
                        relative += relative_spread(x, power.exponent);
                    }
                    number += 1;
                }
                if product == 0.0 {
                    // its factors moved by their errors
                    let moved = factors.iter().fold(coefficient.abs(), |product, (place, power)| {
                        let x = known[*place];
                        product * power.of_real(x.value.abs() + x.error)
                    });
                    return Bounded { value: product, error: moved };
                }
                // relative errors of factors multiply: a tenth more than their sum is left where they are small
                let relative = if relative > 0.1 { relative.exp_m1() } else { 1.1 * relative };
                Bounded { value: product, error: product.abs() * relative + f64::MIN_POSITIVE }
            }
            Self::Apply(function, x) => Bounded::of_function(*function, known[*x]),
            Self::Apply2(function, [x, y]) => Bounded::of_function2(*function, known[*x], known[*y]),
        }
    }
}

impl Power {
    fn of(exponent: &Rational) -> Self {
        let operation = match exponent.to_small() {
            Some((1, 1)) => Operation::Nothing,
            Some((2, 1)) => Operation::Square,
            Some((1, 2)) => Operation::Root,
            Some((-1, 1)) => Operation::Reciprocal,
            _ => Operation::Any,
        };
        Self { operation, exponent: exponent.to_f64() }
    }

    /// `x^exponent`.
    fn of_real(self, x: f64) -> f64 {
        match self.operation {
            Operation::Nothing => x,
            Operation::Square => x * x,
            Operation::Root => x.sqrt(),
            Operation::Reciprocal => x.recip(),
            Operation::Any => x.powf(self.exponent),
        }
    }
}

/// 1/√(1 − x²), the slope of asin and acos.
fn arc_slope(x: f64) -> f64 {
    if x < 1.0 { 1.0 / ((1.0 - x) * (1.0 + x)).sqrt() } else { f64::INFINITY }
}

/// A number r such that x^exponent moves by at most eʳ − 1 of itself while x, which is not zero, moves by its
/// error: infinite where x may be zero and is divided by.
fn relative_spread(x: Bounded, exponent: f64) -> f64 {
    let relative = x.error / x.value.abs();
    if relative < 1e-3 {
        1.001 * exponent.abs() * relative
    } else if relative < 1.0 {
        exponent.abs() * -(-relative).ln_1p()
    } else if exponent > 0.0 {
        exponent * relative.ln_1p() + 3f64.ln()
    } else {
        f64::INFINITY
    }
}

impl Bounded {
    /// A function of a number with an error.
    pub(crate) fn of_function(function: Function, x: Self) -> Self {
        let v = x.value;
        // the steepest slope within the error; where there is none, no bound
        let far = v.abs() + x.error;
        let (value, slope) = match function {
            Function::Sin => (v.sin(), 1.0),
            Function::Cos => (v.cos(), 1.0),
            Function::Asin => (v.asin(), arc_slope(far)),
            Function::Acos => (v.acos(), arc_slope(far)),
            Function::Atan => (v.atan(), 1.0),
            Function::Sinh => (v.sinh(), far.cosh()),
            Function::Cosh => (v.cosh(), far.sinh()),
            Function::Tanh => (v.tanh(), 1.0),
            Function::Exp => (v.exp(), (v + x.error).exp()),
            Function::Ln => (v.ln(), if v > x.error { 1.0 / (v - x.error) } else { f64::INFINITY }),
            Function::Abs => (v.abs(), 1.0),
            Function::Sign if v.abs() <= x.error => (if v == 0.0 { 0.0 } else { v.signum() }, f64::INFINITY),
            Function::Sign => (if v == 0.0 { 0.0 } else { v.signum() }, 0.0),
        };
        Bounded::rounded(value, if x.error == 0.0 { 0.0 } else { slope * x.error })
    }

    /// A function of two numbers with errors.
    pub(crate) fn of_function2(function: Function2, x: Self, y: Self) -> Self {
        match function {
            Function2::Atan2 => {
                let error = x.error + y.error;
                let radius = x.value.hypot(y.value) - error;
                // across the negative half of the axis the angle jumps by a turn
                let jumps = y.value < y.error && x.value.abs() <= x.error && x.error > 0.0;
                let jump = if jumps { std::f64::consts::TAU } else { 0.0 };
                let slope = if radius > 0.0 { error / radius } else { f64::INFINITY };
                Bounded::rounded(x.value.atan2(y.value), if error == 0.0 { 0.0 } else { slope + jump })
            }
            Function2::Min => Bounded { value: x.value.min(y.value), error: x.error.max(y.error) },
            Function2::Max => Bounded { value: x.value.max(y.value), error: x.error.max(y.error) },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bound_covers_cancellation() {
        let mut g = Graph::new();
        let x = g.new_symbol("x");
        let ex = g.symbol(x);
        let (sin, cos) = (g.sin(ex), g.cos(ex));
        let (ss, cc) = (g.square(sin), g.square(cos));
        let one = g.one();
        let sum = g.add(ss, cc);
        let defect = g.sub(sum, one);
        for value in [0.3, 1.1, 2.7, 1e3] {
            assert!(g.evaluate(&[defect], |_| value)[0].may_be_zero());
            assert!(g.evaluate(&[sum], |_| value)[0].is_certainly_nonzero());
        }
    }
}
