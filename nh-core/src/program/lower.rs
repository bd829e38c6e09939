//! From n-ary terms to binary steps.

use super::fold::is_short;
use super::fuse::{fuse, quotients};
use super::nary::{Arena, Nary, Source, Term};
use super::signs::absorb_signs;
use super::step::{Program, Step, Value};
use crate::algebra::{Function, Rational};
use crate::id::{Id, SymbolId, Table};
use rustc_hash::{FxBuildHasher, FxHashMap};
use std::collections::BTreeMap;

/// Longer sums are split in halves, which do not wait for each other.
const LONGEST_CHAIN: usize = 16;

/// The program of an arena without powers in its products, to be [`fused`].
///
/// Sines and cosines come first, since they take longest; everything else comes right before what
/// needs it first. Parameters are combined with each other before they meet anything that varies.
pub(super) fn lower(arena: &Arena) -> Program {
    let uses = arena.uses();
    let is_used = |term: &Term| uses[term.index()] > 0;
    let angles: Vec<Term> = Arena::live(&uses)
        .into_iter()
        .filter(|term| matches!(arena.get(*term), Nary::Apply(Function::Sin | Function::Cos, _)))
        .collect();
    let roots: Vec<Term> = angles.into_iter().chain(arena.outputs.iter().copied()).collect();
    let mut lowering = Lowering {
        arena,
        uses: &uses,
        steps: Table::new(),
        known: FxHashMap::with_capacity_and_hasher(arena.len(), FxBuildHasher),
        values: vec![None; arena.len()],
        fixed: vec![false; arena.len()],
        numbers: vec![false; arena.len()],
        names: BTreeMap::new(),
        operands: Vec::new(),
    };
    for term in arena.operands_first(&roots) {
        lowering.fixed[term.index()] = lowering.is_fixed(term);
        lowering.numbers[term.index()] = lowering.is_of_numbers(term);
        let value = lowering.term(term, &is_used);
        if let Nary::Symbol(symbol) = arena.get(term) {
            lowering.note_name(value, *symbol);
        }
        lowering.values[term.index()] = Some(value);
    }
    let outputs = arena.outputs.iter().map(|output| lowering.value(*output)).collect();
    without_dead_steps(&Program { steps: lowering.steps, outputs, names: lowering.names })
}

/// The program with products fused to sums, divisions in the place of reciprocals, and signs where they are free.
pub(super) fn fused(program: Program, is_parameter: impl Fn(SymbolId) -> bool) -> Program {
    let program = fuse(quotients(program, is_parameter));
    without_dead_steps(&absorb_signs(without_dead_steps(&program)))
}

struct Lowering<'a> {
    arena: &'a Arena,
    uses: &'a [u32],
    steps: Table<Value, Step>,
    known: FxHashMap<Step, Value>,
    values: Vec<Option<Value>>,
    /// Which terms are made of numbers and parameters alone.
    fixed: Vec<bool>,
    /// Which are made of numbers alone.
    numbers: Vec<bool>,
    names: BTreeMap<Value, SymbolId>,
    /// Room for the operands of the present term.
    operands: Vec<Term>,
}

/// The result of a step that need not be taken.
enum Folded {
    Number(Rational),
    Same(Value),
}

/// An operand of a sum.
#[derive(Clone, Copy, Debug)]
struct Operand {
    value: Value,
    /// Whether it is subtracted.
    negative: bool,
    /// Whether it is a product that nothing else uses.
    is_product: bool,
}

impl Lowering<'_> {
    fn is_fixed(&mut self, term: Term) -> bool {
        match self.arena.get(term) {
            Nary::Symbol(symbol) if !self.arena.sources.contains_key(symbol) => {
                self.arena.parameters.contains(symbol)
            }
            _ => {
                self.operands.clear();
                self.arena.dependencies(term, &mut self.operands);
                self.operands.iter().all(|operand| self.fixed[operand.index()])
            }
        }
    }

    /// Of a term of which [`Self::is_fixed`] has just told whether it is fixed.
    fn is_of_numbers(&self, term: Term) -> bool {
        let loads = match self.arena.get(term) {
            Nary::Symbol(symbol) => !matches!(self.arena.sources.get(symbol), Some(Source::Value(_))),
            _ => false,
        };
        self.fixed[term.index()]
            && !loads
            && self.operands.iter().all(|operand| self.numbers[operand.index()])
    }

    /// The value of a term that comes earlier.
    fn value(&self, term: Term) -> Value {
        self.values[term.index()].expect("operands are lowered first")
    }

    /// The first definition of a value names it.
    fn note_name(&mut self, value: Value, symbol: SymbolId) {
        if !self.steps[value].is_leaf() && !self.arena.nameless.contains(&symbol) {
            self.names.entry(value).or_insert(symbol);
        }
    }

    /// A step, or a value that is known to be its result.
    fn push(&mut self, step: Step) -> Value {
        match self.folded(&step) {
            Some(Folded::Number(number)) => self.push_new(Step::Constant(number)),
            Some(Folded::Same(value)) => value,
            None => self.push_new(step),
        }
    }

    /// The exact result of a step on numbers, and of one with the number 0 or 1.
    fn folded(&self, step: &Step) -> Option<Folded> {
        let number = |value: &Value| match &self.steps[*value] {
            Step::Constant(number) => Some(number),
            _ => None,
        };
        let exact = |result: Rational| is_short(&result).then_some(Folded::Number(result));
        match step {
            Step::Add(a, b) => match (number(a), number(b)) {
                (Some(x), Some(y)) => exact(x.clone() + y.clone()),
                (Some(x), None) if x.is_zero() => Some(Folded::Same(*b)),
                (None, Some(y)) if y.is_zero() => Some(Folded::Same(*a)),
                _ => None,
            },
            Step::Sub(a, b) => match (number(a), number(b)) {
                (Some(x), Some(y)) => exact(x.clone() - y.clone()),
                (None, Some(y)) if y.is_zero() => Some(Folded::Same(*a)),
                _ => None,
            },
            Step::Mul(a, b) => match (number(a), number(b)) {
                (Some(x), Some(y)) => exact(x.clone() * y.clone()),
                (Some(x), None) if x.is_one() => Some(Folded::Same(*b)),
                (None, Some(y)) if y.is_one() => Some(Folded::Same(*a)),
                (Some(x), None) | (None, Some(x)) if x.is_zero() => Some(Folded::Number(Rational::ZERO)),
                _ => None,
            },
            Step::Div(a, b) => exact(number(a)?.clone() * number(b)?.recip()?),
            Step::Sqrt(a) => number(a)?.sqrt().map(Folded::Number),
            _ => None,
        }
    }

    fn push_new(&mut self, step: Step) -> Value {
        let key = match step {
            Step::Add(a, b) => Step::Add(a.min(b), a.max(b)),
            Step::Mul(a, b) => Step::Mul(a.min(b), a.max(b)),
            _ => step.clone(),
        };
        if let Some(&value) = self.known.get(&key) {
            return value;
        }
        let value = self.steps.push(step);
        self.known.insert(key, value);
        value
    }

    fn term(&mut self, term: Term, is_used: &impl Fn(&Term) -> bool) -> Value {
        match self.arena.get(term) {
            Nary::Number(value) | Nary::Constant(_, value) => self.push(Step::Constant(value.clone())),
            Nary::Pi => self.push(Step::Pi),
            Nary::Symbol(symbol) => match self.arena.sources.get(symbol) {
                None => self.push(Step::Load(*symbol)),
                Some(Source::Value(value)) => self.value(*value),
                Some(Source::Call(call)) => self.call(*call),
                Some(Source::Unknown { system, component }) => self.unknown(*system, *component),
            },
            Nary::Sum(operands) => self.sum(operands),
            Nary::Product(factors) => self.product(factors),
            Nary::Quotient(a, b) => self.quotient(*a, *b),
            Nary::Power(base, exponent) => self.power(self.value(*base), *exponent),
            Nary::Neg(a) => self.negative(self.value(*a)),
            Nary::Recip(a) => self.reciprocal(self.value(*a)),
            Nary::Sqrt(a) => self.push(Step::Sqrt(self.value(*a))),
            Nary::Cbrt(a) => self.push(Step::Cbrt(self.value(*a))),
            Nary::PowReal(a, exponent) => self.push(Step::PowReal(self.value(*a), exponent.clone())),
            Nary::Apply(Function::Sin, angle) => self.sin_or_cos(Function::Sin, *angle, is_used),
            Nary::Apply(Function::Cos, angle) => self.sin_or_cos(Function::Cos, *angle, is_used),
            Nary::Apply(function, a) => self.push(Step::Apply(*function, self.value(*a))),
            Nary::Apply2(function, a, b) => {
                self.push(Step::Apply2(*function, self.value(*a), self.value(*b)))
            }
        }
    }

    fn call(&mut self, call: usize) -> Value {
        let call = &self.arena.calls[call];
        let arguments = call.arguments.iter().map(|term| self.value(*term)).collect();
        let method = call.method.clone();
        self.push(Step::Call { method, arguments })
    }

    fn unknown(&mut self, system: usize, component: usize) -> Value {
        let system = &self.arena.systems[system];
        let of = |terms: &Vec<Term>| terms.iter().map(|term| self.value(*term)).collect();
        let solve = Step::Solve { matrix: system.matrix.iter().map(of).collect(), right: of(&system.right) };
        let solve = self.push(solve);
        self.push(Step::Component(solve, component))
    }

    fn sin_or_cos(&mut self, function: Function, angle: Term, is_used: &impl Fn(&Term) -> bool) -> Value {
        let other = if function == Function::Sin { Function::Cos } else { Function::Sin };
        let other = self.arena.find(&Nary::Apply(other, angle)).filter(is_used);
        let angle = self.value(angle);
        if other.is_none() {
            return self.push(Step::Apply(function, angle));
        }
        let pair = self.push(Step::SinCos(angle));
        self.push(if function == Function::Sin { Step::SinOf(pair) } else { Step::CosOf(pair) })
    }

    fn negative(&mut self, value: Value) -> Value {
        let step = match &self.steps[value] {
            Step::Constant(number) => Step::Constant(-number.clone()),
            _ => Step::Neg(value),
        };
        self.push(step)
    }

    /// A divisor of parameters alone is inverted, once for all evaluations, and meets other parameters
    /// before anything that varies.
    fn quotient(&mut self, numerator: Term, divisor: Term) -> Value {
        let (above, below) = (self.value(numerator), self.value(divisor));
        if self.fixed[numerator.index()] || !self.fixed[divisor.index()] {
            return self.push(Step::Div(above, below));
        }
        let inverse = self.reciprocal(below);
        match self.arena.get(numerator) {
            Nary::Product(factors) if self.uses[numerator.index()] == 1 => {
                self.product_with(factors, Some(inverse))
            }
            _ => self.push(Step::Mul(above, inverse)),
        }
    }

    fn reciprocal(&mut self, value: Value) -> Value {
        let step = match &self.steps[value] {
            Step::Constant(number) => number.recip().map_or(Step::Recip(value), Step::Constant),
            _ => Step::Recip(value),
        };
        self.push(step)
    }

    fn sum(&mut self, operands: &[(Term, bool)]) -> Value {
        let of = |(term, negative): &(Term, bool)| Operand {
            value: self.value(*term),
            negative: *negative,
            is_product: self.uses[term.index()] == 1 && matches!(self.arena.get(*term), Nary::Product(_)),
        };
        // numbers meet each other first, then parameters, then what varies
        let mut all: Vec<(Operand, [bool; 2])> = operands
            .iter()
            .map(|operand| (of(operand), [&self.numbers, &self.fixed].map(|of| of[operand.0.index()])))
            .collect();
        for kind in 0..2 {
            let (alike, others): (Vec<_>, Vec<_>) = all.iter().partition(|(_, is)| is[kind]);
            if alike.len() > 1 && !others.is_empty() {
                let alike: Vec<_> = alike.into_iter().map(|(operand, _)| operand).collect();
                all = std::iter::once((self.signed_sum(&alike), [true; 2])).chain(others).collect();
            }
        }
        let all: Vec<_> = all.into_iter().map(|(operand, _)| operand).collect();
        let Operand { value, negative, .. } = self.signed_sum(&all);
        if negative { self.negative(value) } else { value }
    }

    /// The sum up to a sign: something added comes first, if there is such, then what is no product,
    /// so that every product is added to something and can be fused with that addition.
    fn signed_sum(&mut self, operands: &[Operand]) -> Operand {
        if operands.len() > LONGEST_CHAIN {
            let (left, right) = operands.split_at(operands.len() / 2);
            let halves = [self.signed_sum(left), self.signed_sum(right)];
            return self.signed_sum(&halves);
        }
        let all_negative = operands.iter().all(|operand| operand.negative);
        let mut ordered = operands.to_vec();
        ordered.sort_by_key(|operand| operand.is_product);
        if let Some(first) = ordered.iter().position(|operand| !operand.negative) {
            ordered[..=first].rotate_right(1);
        }
        let mut sum = ordered[0].value;
        for Operand { value, negative, .. } in &ordered[1..] {
            let subtract = *negative && !all_negative;
            sum = self.push(if subtract { Step::Sub(sum, *value) } else { Step::Add(sum, *value) });
        }
        Operand { value: sum, negative: all_negative, is_product: false }
    }

    /// Numbers, then parameters, then what varies.
    fn product(&mut self, factors: &[(Term, i32)]) -> Value {
        self.product_with(factors, None)
    }

    /// A product with one more factor, of parameters alone.
    fn product_with(&mut self, factors: &[(Term, i32)], inverse: Option<Value>) -> Value {
        let class = |term: Term| match self.arena.get(term) {
            Nary::Number(_) | Nary::Pi | Nary::Constant(..) => 0,
            _ if self.fixed[term.index()] => 1,
            _ => 2,
        };
        let mut ordered = factors.to_vec();
        ordered.sort_by_key(|(term, _)| class(*term));
        let varying = ordered.partition_point(|(term, _)| class(*term) < 2);
        let mut powers: Vec<Value> = Vec::with_capacity(ordered.len() + 1);
        for (term, exponent) in &ordered {
            powers.push(self.power(self.value(*term), exponent.unsigned_abs()));
        }
        // nothing that it could meet: it comes last
        let position = if varying == 0 { powers.len() } else { varying };
        powers.splice(position..position, inverse);
        let product = powers.into_iter().reduce(|before, power| self.push(Step::Mul(before, power)));
        product.unwrap_or_else(|| self.push(Step::Constant(Rational::ONE)))
    }

    /// By squaring; intermediate powers are shared.
    fn power(&mut self, base: Value, exponent: u32) -> Value {
        let mut power = base;
        for bit in (0..exponent.ilog2()).rev() {
            power = self.push(Step::Mul(power, power));
            if exponent >> bit & 1 == 1 {
                power = self.push(Step::Mul(power, base));
            }
        }
        power
    }
}

impl Program {
    /// The same as far as some of its outputs.
    #[must_use]
    pub fn giving(&self, outputs: &[Value]) -> Self {
        without_dead_steps(&Self { outputs: outputs.to_vec(), ..self.clone() })
    }
}

/// Keeps what outputs depend on.
pub(super) fn without_dead_steps(program: &Program) -> Program {
    let live = program.needed_by(&program.outputs);
    let mut renamed: Vec<Option<Value>> = vec![None; program.steps.len()];
    let mut steps = Table::new();
    for (value, step) in program.steps.iter_ids().filter(|(value, _)| live[*value]) {
        let step = rename(step, &|old: Value| renamed[old.index()].unwrap_or(old));
        renamed[value.index()] = Some(steps.push(step));
    }
    let outputs = program.outputs.iter().filter_map(|output| renamed[output.index()]).collect();
    let names = program.names.iter().filter_map(|(value, symbol)| Some((renamed[value.index()]?, *symbol)));
    let names = names.collect();
    Program { steps, outputs, names }
}

pub(super) fn rename(step: &Step, new: &impl Fn(Value) -> Value) -> Step {
    let all = |list: &Vec<Value>| list.iter().map(|value| new(*value)).collect::<Vec<_>>();
    match step {
        Step::Constant(_) | Step::Pi | Step::Load(_) => step.clone(),
        Step::Add(a, b) => Step::Add(new(*a), new(*b)),
        Step::Sub(a, b) => Step::Sub(new(*a), new(*b)),
        Step::Mul(a, b) => Step::Mul(new(*a), new(*b)),
        Step::MulAdd { a, b, c, minus_product, minus_c } => Step::MulAdd {
            a: new(*a),
            b: new(*b),
            c: new(*c),
            minus_product: *minus_product,
            minus_c: *minus_c,
        },
        Step::Div(a, b) => Step::Div(new(*a), new(*b)),
        Step::Neg(a) => Step::Neg(new(*a)),
        Step::Recip(a) => Step::Recip(new(*a)),
        Step::Sqrt(a) => Step::Sqrt(new(*a)),
        Step::Cbrt(a) => Step::Cbrt(new(*a)),
        Step::PowReal(a, exponent) => Step::PowReal(new(*a), exponent.clone()),
        Step::SinCos(a) => Step::SinCos(new(*a)),
        Step::SinOf(a) => Step::SinOf(new(*a)),
        Step::CosOf(a) => Step::CosOf(new(*a)),
        Step::Apply(function, a) => Step::Apply(*function, new(*a)),
        Step::Apply2(function, a, b) => Step::Apply2(*function, new(*a), new(*b)),
        Step::Call { method, arguments } => Step::Call { method: method.clone(), arguments: all(arguments) },
        Step::Solve { matrix, right } => {
            Step::Solve { matrix: matrix.iter().map(all).collect(), right: all(right) }
        }
        Step::Component(a, index) => Step::Component(new(*a), *index),
    }
}
