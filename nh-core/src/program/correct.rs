//! Rounding errors corrected to first order.
//!
//! Every value v goes with an estimate e of what is missing: the rounding error of the operation, which
//! for sums, products, quotients is itself a number that can be computed, and the errors of the operands
//! times its derivatives. Outputs are v + e (P. Langlois, *Automatic linear correction of rounding
//! errors*, BIT 41 (2001)):
//!
//! | operation | rounding error | |
//! |---|---|---|
//! | `s = a + b` | `(a − (s − z)) + (b − z)`, `z = s − a` | Knuth, *The Art of Computer Programming* 2, 4.2.2 |
//! | `p = a b` | `a b − p` | by a fused multiply-add |
//! | `q = a / b` | `(a − q b) / b` | by a fused multiply-add |
//!
//! A divisor in which terms may have cancelled is corrected before anything is divided by it: to first order nothing
//! is gained where its error is as large as itself.
//!
//! The errors of products and quotients are exact on every target ([`Program::is_rest`]). Sines and cosines keep the
//! error of their function, and pass on that of the angle. Where a program divides, what elimination leaves of light
//! inertias beside heavy ones may be smaller than an ulp of what they are made of: there the sine and the cosine of an
//! angle are brought back to the circle, mathematics (60), and solutions of linear systems are refined, mathematics
//! (61). Other functions and methods of the user's take corrected operands. What numbers alone give only with rounding errors
//! has none, since it becomes a number ([`Program::known_numbers`]).

use super::fuse::fuse;
use super::lower::{rename, without_dead_steps};
use super::signs::absorb_signs;
use super::step::{Program, Step, Value};
use crate::algebra::{Function, Rational};
use crate::id::{Id, Table};
use std::collections::{BTreeMap, BTreeSet};

/// The same program with the rounding errors of its outputs corrected.
#[must_use]
pub fn corrected(program: &Program) -> Program {
    let (steps, may_cancel, images) = Default::default();
    let mut corrector = Corrector { steps, may_cancel, images, defects: BTreeMap::new() };
    let pairs = pairs_beside_quotients(program);
    let known = program.known_numbers();
    for (value, step) in program.steps.iter_ids() {
        let image = if known.contains_key(&value) { corrector.as_it_is(step) } else { corrector.step(step) };
        corrector.images.push(image);
        if pairs.contains(&value) {
            corrector.turn_back(image.value);
        }
    }
    let outputs = program.outputs.iter().map(|output| corrector.whole(*output)).collect();
    let names = program.names.iter().map(|(value, symbol)| (corrector.of(*value).value, *symbol)).collect();
    let program = Program { steps: corrector.steps, outputs, names };
    without_dead_steps(&absorb_signs(fuse(without_dead_steps(&program))))
}

/// The pairs of which both sine and cosine are taken, in a program that divides.
fn pairs_beside_quotients(program: &Program) -> BTreeSet<Value> {
    let (mut sines, mut cosines, mut divides) = (BTreeSet::new(), BTreeSet::new(), false);
    for step in &program.steps {
        match step {
            Step::SinOf(pair) => {
                sines.insert(*pair);
            }
            Step::CosOf(pair) => {
                cosines.insert(*pair);
            }
            Step::Div(..) | Step::Recip(_) | Step::Solve { .. } => divides = true,
            _ => {}
        }
    }
    if divides { sines.intersection(&cosines).copied().collect() } else { BTreeSet::new() }
}

/// A value and what is missing, if it is not zero.
#[derive(Clone, Copy, Debug)]
struct Estimate {
    value: Value,
    error: Option<Value>,
}

struct Corrector {
    steps: Table<Value, Step>,
    /// Whether a value may be small against its own rounding error: sums may, and their products.
    may_cancel: Table<Value, bool>,
    /// Of each step of the program.
    images: Vec<Estimate>,
    /// By what sine and cosine of a pair are too short, relative to them.
    defects: BTreeMap<Value, Value>,
}

impl Corrector {
    fn push(&mut self, step: Step) -> Value {
        let may = |operand: &Value| self.may_cancel[*operand];
        self.may_cancel.push(match &step {
            Step::Add(..) | Step::Sub(..) | Step::MulAdd { .. } => true,
            Step::Mul(a, b) => may(a) || may(b),
            Step::Neg(a) | Step::Sqrt(a) | Step::Recip(a) | Step::Div(a, _) => may(a),
            _ => false,
        });
        self.steps.push(step)
    }

    fn of(&self, value: Value) -> Estimate {
        self.images[value.index()]
    }

    /// The corrected value.
    fn whole(&mut self, value: Value) -> Value {
        let estimate = self.of(value);
        self.corrected_value(estimate)
    }

    fn corrected_value(&mut self, Estimate { value, error }: Estimate) -> Value {
        error.map_or(value, |error| self.push(Step::Add(value, error)))
    }

    /// The corrected value and what is missing of that: where terms cancelled, the error may be as large as the
    /// value, or larger.
    fn renewed(&mut self, estimate: Estimate) -> Estimate {
        let Estimate { value, error: Some(error) } = estimate else { return estimate };
        let whole = self.corrected_value(estimate);
        let rest = self.push(Step::Sub(value, whole));
        Estimate { value: whole, error: Some(self.push(Step::Add(rest, error))) }
    }

    fn step(&mut self, step: &Step) -> Estimate {
        match *step {
            Step::Add(a, b) => self.sum(self.of(a), self.of(b)),
            Step::Sub(a, b) => self.difference(self.of(a), self.of(b)),
            Step::Mul(a, b) => self.product(self.of(a), self.of(b)),
            Step::MulAdd { a, b, c, minus_product, minus_c } => {
                let (product, c) = (self.product(self.of(a), self.of(b)), self.of(c));
                match (minus_product, minus_c) {
                    (false, false) => self.sum(product, c),
                    (false, true) => self.difference(product, c),
                    (true, false) => self.difference(c, product),
                    (true, true) => {
                        let sum = self.sum(product, c);
                        self.negative(sum)
                    }
                }
            }
            Step::Div(a, b) => self.quotient(self.of(a), self.of(b)),
            Step::Recip(b) => {
                let one = self.push(Step::Constant(Rational::ONE));
                self.quotient(Estimate { value: one, error: None }, self.of(b))
            }
            Step::Neg(a) => self.negative(self.of(a)),
            // its operand is the angle still
            Step::SinCos(angle) => {
                let Estimate { value, error } = self.of(angle);
                Estimate { value: self.push(Step::SinCos(value)), error }
            }
            Step::SinOf(pair) => self.turned(self.of(pair), Function::Sin),
            Step::CosOf(pair) => self.turned(self.of(pair), Function::Cos),
            Step::Apply(function @ (Function::Sin | Function::Cos), angle) => {
                let Estimate { value, error } = self.of(angle);
                if error.is_none() {
                    return self.exact(Step::Apply(function, value));
                }
                let pair = self.push(Step::SinCos(value));
                self.turned(Estimate { value: pair, error }, function)
            }
            Step::Solve { ref matrix, ref right } => self.refined(matrix, right),
            // a component, and what was missing of it
            Step::Component(system, index) => {
                let value = self.push(Step::Component(self.of(system).value, index));
                let error = self.of(system).error;
                let error = error.map(|system| self.push(Step::Component(system, index)));
                Estimate { value, error }
            }
            _ => self.of_wholes(step),
        }
    }

    /// The solution of a linear system, and as its error that with what the first one leaves of the right-hand side:
    /// S d = b − S x, mathematics (61), with the errors of S and b.
    fn refined(&mut self, matrix: &[Vec<Value>], right: &[Value]) -> Estimate {
        let mut renewed = |values: &[Value]| -> Vec<Estimate> {
            values.iter().map(|value| self.renewed(self.of(*value))).collect()
        };
        let (matrix, right): (Vec<_>, _) = (matrix.iter().map(|row| renewed(row)).collect(), renewed(right));
        let values = |list: &[Estimate]| list.iter().map(|estimate| estimate.value).collect::<Vec<Value>>();
        let rows: Vec<Vec<Value>> = matrix.iter().map(|row| values(row)).collect();
        let solution = self.push(Step::Solve { matrix: rows.clone(), right: values(&right) });
        let unknowns: Vec<Estimate> =
            (0..right.len()).map(|index| self.exact(Step::Component(solution, index))).collect();
        let mut left = Vec::with_capacity(right.len());
        for (row, right) in matrix.into_iter().zip(right) {
            let mut rest = right;
            for (entry, unknown) in row.into_iter().zip(&unknowns) {
                let product = self.product(entry, *unknown);
                rest = self.difference(rest, product);
            }
            left.push(self.corrected_value(rest));
        }
        let error = self.push(Step::Solve { matrix: rows, right: left });
        Estimate { value: solution, error: Some(error) }
    }

    /// A step as it is, of corrected operands.
    fn of_wholes(&mut self, step: &Step) -> Estimate {
        let mut wholes: Vec<(Value, Value)> = Vec::new();
        for operand in step.operands() {
            wholes.push((operand, self.whole(operand)));
        }
        let image = |old: Value| wholes.iter().find(|(o, _)| *o == old).map_or(old, |(_, new)| *new);
        self.exact(rename(step, &image))
    }

    /// A step that becomes a number.
    fn as_it_is(&mut self, step: &Step) -> Estimate {
        let step = rename(step, &|operand| self.of(operand).value);
        self.exact(step)
    }

    fn exact(&mut self, step: Step) -> Estimate {
        Estimate { value: self.push(step), error: None }
    }

    fn negative(&mut self, a: Estimate) -> Estimate {
        let error = a.error.map(|error| self.push(Step::Neg(error)));
        Estimate { value: self.push(Step::Neg(a.value)), error }
    }

    fn sum(&mut self, a: Estimate, b: Estimate) -> Estimate {
        let sum = self.push(Step::Add(a.value, b.value));
        let rest = self.push(Step::Sub(sum, a.value));
        let first = self.push(Step::Sub(sum, rest));
        let first = self.push(Step::Sub(a.value, first));
        let second = self.push(Step::Sub(b.value, rest));
        let mut error = self.push(Step::Add(first, second));
        for inherited in [a.error, b.error].into_iter().flatten() {
            error = self.push(Step::Add(error, inherited));
        }
        Estimate { value: sum, error: Some(error) }
    }

    fn difference(&mut self, a: Estimate, b: Estimate) -> Estimate {
        let difference = self.push(Step::Sub(a.value, b.value));
        let rest = self.push(Step::Sub(difference, a.value));
        let first = self.push(Step::Sub(difference, rest));
        let first = self.push(Step::Sub(a.value, first));
        let second = self.push(Step::Add(b.value, rest));
        let mut error = self.push(Step::Sub(first, second));
        if let Some(inherited) = a.error {
            error = self.push(Step::Add(error, inherited));
        }
        if let Some(inherited) = b.error {
            error = self.push(Step::Sub(error, inherited));
        }
        Estimate { value: difference, error: Some(error) }
    }

    fn product(&mut self, a: Estimate, b: Estimate) -> Estimate {
        let value = self.push(Step::Mul(a.value, b.value));
        let mut error = if self.is_power_of_two(a.value) || self.is_power_of_two(b.value) {
            None
        } else {
            Some(self.multiply_add(a.value, b.value, value, false, true))
        };
        // where terms cancelled in both factors, what is missing of both counts, too
        let is_rough = self.may_cancel[a.value] && self.may_cancel[b.value];
        let other = if is_rough && a.error.is_some() { self.corrected_value(b) } else { b.value };
        for (inherited, factor) in [(a.error, other), (b.error, a.value)] {
            let Some(inherited) = inherited else { continue };
            error = Some(match error {
                Some(error) => self.multiply_add(inherited, factor, error, false, false),
                None => self.push(Step::Mul(inherited, factor)),
            });
        }
        Estimate { value, error }
    }

    fn quotient(&mut self, a: Estimate, b: Estimate) -> Estimate {
        let b = if self.may_cancel[b.value] { self.renewed(b) } else { b };
        let value = self.push(Step::Div(a.value, b.value));
        let mut rest = self.multiply_add(value, b.value, a.value, true, false);
        if let Some(inherited) = a.error {
            rest = self.push(Step::Add(rest, inherited));
        }
        if let Some(inherited) = b.error {
            rest = self.multiply_add(value, inherited, rest, true, false);
        }
        Estimate { value, error: Some(self.push(Step::Div(rest, b.value))) }
    }

    /// Finds what the squares of sine and cosine miss of one, mathematics (60).
    fn turn_back(&mut self, pair: Value) {
        let [sin, cos] = [Step::SinOf(pair), Step::CosOf(pair)].map(|step| self.exact(step));
        let [one, half] = [Rational::ONE, Rational::new(1, 2)].map(|n| self.exact(Step::Constant(n)));
        let (sin, cos) = (self.product(sin, sin), self.product(cos, cos));
        let squares = self.sum(sin, cos);
        let defect = self.difference(one, squares);
        let defect = self.corrected_value(defect);
        let defect = self.push(Step::Mul(half.value, defect));
        self.defects.insert(pair, defect);
    }

    /// The sine or cosine out of a pair, whose error is that of the angle, and of its length.
    fn turned(&mut self, pair: Estimate, function: Function) -> Estimate {
        let (sin, cos) = (Step::SinOf(pair.value), Step::CosOf(pair.value));
        let (this, slope) = if function == Function::Sin { (sin, cos) } else { (cos, sin) };
        let value = self.push(this);
        let length = self.defects.get(&pair.value).copied();
        let length = length.map(|defect| self.push(Step::Mul(value, defect)));
        let angle = pair.error.map(|error| {
            let slope = self.push(slope);
            let error = self.push(Step::Mul(slope, error));
            if function == Function::Sin { error } else { self.push(Step::Neg(error)) }
        });
        let error = match (length, angle) {
            (Some(length), Some(angle)) => Some(self.push(Step::Add(length, angle))),
            (length, angle) => length.or(angle),
        };
        Estimate { value, error }
    }

    fn multiply_add(&mut self, a: Value, b: Value, c: Value, minus_product: bool, minus_c: bool) -> Value {
        self.push(Step::MulAdd { a, b, c, minus_product, minus_c })
    }

    /// Whether products with a value are exact.
    fn is_power_of_two(&self, value: Value) -> bool {
        let Step::Constant(number) = &self.steps[value] else { return false };
        let power = |n: i64| n.unsigned_abs().is_power_of_two();
        number.to_small().is_some_and(|(p, q)| power(p) && power(q))
    }
}
