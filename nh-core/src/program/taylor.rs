//! The recurrences of the Taylor coefficients of a program's values along a solution of ẋ = f(t, x).
//!
//! With `a(t₀ + h) = Σ a_k h^k`, every step has a rule that gives its k-th coefficient from those of its
//! operands up to k and its own up to k − 1, mathematics (24): the Cauchy product, and what follows
//! from it for quotients, roots, powers, and functions with a differential equation (Jorba, Zou,
//! A software package for the numerical integration of ODEs by means of high-order Taylor methods,
//! Experimental Mathematics 14 (2005), section 2; Griewank, Walther, Evaluating Derivatives, chapter 13).
//!
//! The sums in them run over products of two series. Their inner part, over the orders 1 … k − 1, does
//! not wait for anything of order k: all inner sums of a program are one pass over its history.

use super::lower::rename;
use super::rule::{Factor, Inner, Rule};
use super::step::{Program, Step, Value};
use crate::algebra::{Function, Function2, Rational};
use crate::id::{SymbolId, Table};
use rustc_hash::FxHashMap;
use std::collections::BTreeMap;

/// A program whose values are power series in the time.
#[derive(Clone, Debug)]
pub struct Recurrences {
    /// Order 0: the program, with the companions that the rules of its functions need. No output
    /// stands here but the rates, and values may be needed by rules alone.
    pub start: Program,
    /// How the further coefficients of each value follow, in an order in which they can be computed.
    pub rules: Table<Value, Rule>,
    /// The inner sums of products.
    pub products: Vec<[Factor; 2]>,
    /// The series whose squares have inner sums.
    pub squares: Vec<Value>,
}

/// What a value depends on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Variation {
    /// Nothing that changes during a step: parameters and inputs.
    Constant,
    /// A variable of the state.
    Variable,
    /// The time itself.
    Time,
}

impl Recurrences {
    /// The recurrences of a program, all of whose steps are analytic where they vary; one that is not
    /// is taken for a constant.
    pub fn of(program: &Program, variation: impl Fn(SymbolId) -> Variation) -> Self {
        let mut builder = Builder {
            variation,
            steps: Table::new(),
            known: FxHashMap::default(),
            rules: Table::new(),
            products: Vec::new(),
            squares: Vec::new(),
            pairs: BTreeMap::new(),
        };
        let mut images: Table<Value, Value> = Table::new();
        let mut names = BTreeMap::new();
        for (value, step) in program.steps.iter_ids() {
            let image = builder.series(&rename(step, &|old: Value| images[old]));
            images.push(image);
            if let Some(symbol) = program.names.get(&value) {
                names.entry(image).or_insert(*symbol);
            }
        }
        let outputs = program.outputs.iter().map(|output| images[*output]).collect();
        let Builder { steps, rules, products, squares, .. } = builder;
        Self { start: Program { steps, outputs, names }, rules, products, squares }
    }
}

struct Builder<F> {
    variation: F,
    steps: Table<Value, Step>,
    known: FxHashMap<Step, Value>,
    rules: Table<Value, Rule>,
    products: Vec<[Factor; 2]>,
    squares: Vec<Value>,
    /// The sine and the cosine of each angle's `SinCos`.
    pairs: BTreeMap<Value, (Value, Value)>,
}

impl<F: Fn(SymbolId) -> Variation> Builder<F> {
    fn is_constant(&self, value: Value) -> bool {
        self.rules[value] == Rule::Constant
    }

    /// The value of a step at order 0.
    fn push(&mut self, step: Step) -> Value {
        if let Some(value) = self.known.get(&step) {
            return *value;
        }
        let value = self.steps.push(step.clone());
        self.known.insert(step, value);
        self.rules.push(Rule::Seed);
        value
    }

    /// A step with its rule.
    fn series(&mut self, step: &Step) -> Value {
        // a sine or a cosine alone needs the other
        if let Step::Apply(function @ (Function::Sin | Function::Cos), angle) = *step
            && !self.is_constant(angle)
        {
            let pair = self.series(&Step::SinCos(angle));
            let (sin, cos) = self.sin_cos(pair, angle);
            return if function == Function::Sin { sin } else { cos };
        }
        // a product has a rule of its own
        if let Step::MulAdd { a, b, c, minus_product, minus_c } = *step {
            let product = self.series(&Step::Mul(a, b));
            return match (minus_product, minus_c) {
                (false, false) => self.series(&Step::Add(product, c)),
                (false, true) => self.series(&Step::Sub(product, c)),
                (true, false) => self.series(&Step::Sub(c, product)),
                (true, true) => {
                    let sum = self.series(&Step::Add(product, c));
                    self.series(&Step::Neg(sum))
                }
            };
        }
        let value = self.push(step.clone());
        if self.rules[value] == Rule::Seed {
            let constant = match step {
                Step::Load(symbol) => (self.variation)(*symbol) == Variation::Constant,
                _ => step.operands().iter().all(|operand| self.is_constant(*operand)),
            };
            if constant {
                self.rules[value] = Rule::Constant;
            } else {
                // it varies, which its companions have to know before the rule is there
                self.rules[value] = Rule::Same(value);
                self.rules[value] = self.rule(value, step);
            }
        }
        value
    }

    fn rule(&mut self, value: Value, step: &Step) -> Rule {
        match step {
            Step::Load(symbol) if (self.variation)(*symbol) == Variation::Time => Rule::Time,
            Step::Load(symbol) => Rule::Variable(*symbol),
            Step::Add(a, b) if self.is_constant(*b) => Rule::Same(*a),
            Step::Add(a, b) if self.is_constant(*a) => Rule::Same(*b),
            Step::Add(a, b) => Rule::Sum(*a, *b),
            Step::Sub(a, b) if self.is_constant(*b) => Rule::Same(*a),
            Step::Sub(a, b) if self.is_constant(*a) => Rule::Negative(*b),
            Step::Sub(a, b) => Rule::Difference(*a, *b),
            Step::Neg(a) => Rule::Negative(*a),
            Step::Mul(a, b) if self.is_constant(*b) => Rule::Scaled(*a, *b),
            Step::Mul(a, b) if self.is_constant(*a) => Rule::Scaled(*b, *a),
            Step::Mul(a, b) if a == b => Rule::Square(*a, self.square(*a)),
            Step::Mul(a, b) => Rule::Product(*a, *b, self.product(Factor::Plain(*a), Factor::Plain(*b))),
            Step::Div(a, b) if self.is_constant(*b) => {
                let over = self.push(Step::Recip(*b));
                self.rules[over] = Rule::Constant;
                Rule::Scaled(*a, over)
            }
            Step::Div(a, b) => {
                let numerator = Some(*a).filter(|a| !self.is_constant(*a));
                self.quotient(value, numerator, *b)
            }
            Step::Recip(b) => self.quotient(value, None, *b),
            Step::Sqrt(a) => {
                let double = self.push(Step::Add(value, value));
                let over = self.push(Step::Recip(double));
                Rule::Root { of: *a, over, inner: self.square(value) }
            }
            Step::Cbrt(a) => self.power(value, *a, Rational::new(1, 3)),
            Step::PowReal(a, exponent) => self.power(value, *a, exponent.clone()),
            // it has no value of its own
            Step::SinCos(_) => Rule::Seed,
            Step::SinOf(pair) | Step::CosOf(pair) => {
                let (pair, angle) = (*pair, self.steps[*pair].operands()[0]);
                let (sin, cos) = self.sin_cos(pair, angle);
                let negative = value == cos;
                self.integral(angle, if negative { sin } else { cos }, negative)
            }
            Step::Apply(function, a) => self.function(value, *function, *a),
            Step::Apply2(Function2::Atan2, y, x) => self.angle(value, *y, *x),
            // not analytic; taken apart in `series`
            Step::MulAdd { .. }
            | Step::Apply2(Function2::Min | Function2::Max, ..)
            | Step::Call { .. }
            | Step::Constant(_)
            | Step::Pi => Rule::Constant,
            Step::Solve { matrix, .. } => self.system(value, matrix),
            Step::Component(..) => Rule::Unknown,
        }
    }

    /// The number of an inner sum.
    fn product(&mut self, a: Factor, b: Factor) -> Inner {
        let pair = [a.min(b), a.max(b)];
        number(&mut self.products, pair)
    }

    /// The number of the inner sum of a square.
    fn square(&mut self, a: Value) -> usize {
        number(&mut self.squares, a)
    }

    fn quotient(&mut self, value: Value, numerator: Option<Value>, denominator: Value) -> Rule {
        let over = self.push(Step::Recip(denominator));
        let inner = self.product(Factor::Plain(denominator), Factor::Plain(value));
        Rule::Quotient { numerator, denominator, over, inner }
    }

    fn power(&mut self, value: Value, of: Value, exponent: Rational) -> Rule {
        let over = self.push(Step::Recip(of));
        let inner = [
            self.product(Factor::Plain(value), Factor::Weighted(of)),
            self.product(Factor::Weighted(value), Factor::Plain(of)),
        ];
        Rule::Power { of, exponent, over, inner }
    }

    fn integral(&mut self, of: Value, rate: Value, negative: bool) -> Rule {
        let inner = self.product(Factor::Weighted(of), Factor::Plain(rate));
        Rule::Integral { of, rate, negative, inner }
    }

    fn integral_over(&mut self, value: Value, of: Value, divisor: Value, negative: bool) -> Rule {
        let over = self.push(Step::Recip(divisor));
        let inner = self.product(Factor::Weighted(value), Factor::Plain(divisor));
        Rule::IntegralOver { of, over, negative, inner }
    }

    /// Both functions of an angle.
    fn sin_cos(&mut self, pair: Value, angle: Value) -> (Value, Value) {
        if let Some(both) = self.pairs.get(&pair) {
            return *both;
        }
        let (sin, cos) = (self.push(Step::SinOf(pair)), self.push(Step::CosOf(pair)));
        self.pairs.insert(pair, (sin, cos));
        self.rules[sin] = self.integral(angle, cos, false);
        self.rules[cos] = self.integral(angle, sin, true);
        (sin, cos)
    }

    /// 1 − a² or 1 + a².
    fn one_and_square(&mut self, a: Value, plus: bool) -> Value {
        let one = self.series(&Step::Constant(Rational::ONE));
        let square = self.series(&Step::Mul(a, a));
        self.series(&if plus { Step::Add(one, square) } else { Step::Sub(one, square) })
    }

    fn function(&mut self, value: Value, function: Function, a: Value) -> Rule {
        match function {
            Function::Exp => self.integral(a, value, false),
            Function::Ln => self.integral_over(value, a, a, false),
            Function::Sinh => {
                let cosh = self.series(&Step::Apply(Function::Cosh, a));
                self.integral(a, cosh, false)
            }
            Function::Cosh => {
                // its rule refers back to this value, which is known by now
                let sinh = self.series(&Step::Apply(Function::Sinh, a));
                self.integral(a, sinh, false)
            }
            Function::Tanh => {
                let rate = self.one_and_square(value, false);
                self.integral(a, rate, false)
            }
            Function::Atan => {
                let divisor = self.one_and_square(a, true);
                self.integral_over(value, a, divisor, false)
            }
            Function::Asin | Function::Acos => {
                let square = self.one_and_square(a, false);
                let divisor = self.series(&Step::Sqrt(square));
                self.integral_over(value, a, divisor, function == Function::Acos)
            }
            // taken apart in `series`; not analytic
            Function::Sin | Function::Cos | Function::Abs | Function::Sign => Rule::Constant,
        }
    }

    fn angle(&mut self, value: Value, y: Value, x: Value) -> Rule {
        let (yy, xx) = (self.series(&Step::Mul(y, y)), self.series(&Step::Mul(x, x)));
        let square = self.series(&Step::Add(xx, yy));
        let over = self.push(Step::Recip(square));
        let inner = [
            self.product(Factor::Weighted(y), Factor::Plain(x)),
            self.product(Factor::Weighted(x), Factor::Plain(y)),
            self.product(Factor::Weighted(value), Factor::Plain(square)),
        ];
        Rule::Angle { y, x, over, inner }
    }

    fn system(&mut self, value: Value, matrix: &[Vec<Value>]) -> Rule {
        let mut varying = Vec::with_capacity(matrix.len());
        for row in matrix {
            let mut terms = Vec::new();
            for (column, entry) in row.iter().enumerate() {
                if !self.is_constant(*entry) {
                    let unknown = self.series(&Step::Component(value, column));
                    let inner = self.product(Factor::Plain(*entry), Factor::Plain(unknown));
                    terms.push((*entry, unknown, inner));
                }
            }
            varying.push(terms);
        }
        Rule::System { varying }
    }
}

/// The position of an entry, which is added if it is new.
fn number<T: PartialEq>(list: &mut Vec<T>, entry: T) -> usize {
    list.iter().position(|known| *known == entry).unwrap_or_else(|| {
        list.push(entry);
        list.len() - 1
    })
}
