//! Steps of one value become one step.
//!
//! What is equal by an identity alone – the sum of the squares of a sine and a cosine, a minor of minors, a product that
//! is written out in one place and not in another – is several terms of an arena, and several steps. Here a program is
//! run at a few points; steps that have one value at all of them, up to its sign, are taken for one, and what has the
//! value of a short number for that number. This is a conjecture: a program that rests on it is emitted if it is proved
//! as a whole ([`lowered`](crate::choose::lowered)).

use super::interpret::interpret_in;
use super::lower::{rename, without_dead_steps};
use super::random_points::Sampled;
use super::rounding::sample;
use super::step::{Program, Step, Value};
use super::where_defined::{Conditions, is_partial};
use crate::algebra::{Bounded, Function, Rational};
use crate::id::{Id, SymbolId, Table};
use rustc_hash::FxHashMap;

/// The points at which values are compared.
const POINTS: [u32; 3] = [101, 102, 103];
/// Values that are less certain than this, relatively, are not compared.
const CERTAIN: f64 = 1e-9;
/// How often all steps are looked through for shorter ways.
const PASSES: usize = 8;
/// Numbers have denominators up to this.
const DENOMINATORS: i64 = 12;

/// The program in which what coincides is one step, by each way to choose this step; none where nothing does.
pub(super) fn coincided(program: &Program, is_parameter: impl Fn(SymbolId) -> bool) -> Vec<Program> {
    let classes = Classes::of(program);
    if !classes.coincide {
        return Vec::new();
    }
    let shortest = classes.shortest(program, &program.fixed(is_parameter));
    let mut found: Vec<Program> = Vec::new();
    for chosen in [classes.first(), shortest] {
        let program = classes.program(program, &chosen);
        if found.iter().all(|other| other.steps != program.steps) {
            found.push(program);
        }
    }
    found
}

/// A value at the points.
type Values = [Bounded; POINTS.len()];

/// Steps of one value, which all have it under the same conditions: a multiple of what is divided by zero somewhere may
/// not take the place of a value that exists there.
struct Class {
    /// The value, of the first of them.
    values: Values,
    /// Each, and whether it has the opposite value.
    members: Vec<(Value, bool)>,
    /// What it takes for them to have a value, by the number of this set.
    conditions: usize,
    /// The number that all of them are.
    number: Option<Rational>,
}

/// All steps by their values.
struct Classes {
    all: Vec<Class>,
    /// Whether any step is another one, or a number.
    coincide: bool,
    /// The class of each step, and whether it has the opposite value.
    of: Table<Value, (usize, bool)>,
}

impl Classes {
    fn of(program: &Program) -> Self {
        let mut everything = program.clone();
        everything.outputs = program.steps.ids().collect();
        let runs = POINTS.map(|point| {
            let at = |symbol| Sampled(Bounded { value: sample(point, symbol), error: 0.0 });
            interpret_in(&everything, at)
        });
        let numbers = program.fixed(|_| false);
        let mut found = Self { all: Vec::new(), coincide: false, of: Table::new() };
        let mut by_size: FxHashMap<u64, Vec<usize>> = FxHashMap::default();
        let mut angles: FxHashMap<(usize, bool), usize> = FxHashMap::default();
        let mut conditions = Conditions::new();
        for (value, step) in program.steps.iter_ids() {
            let values: Values = std::array::from_fn(|point| runs[point][value.index()].0);
            if let Step::Neg(operand) = step {
                let (class, minus) = found.of[*operand];
                found.join(class, value, !minus);
                continue;
            }
            let asked = found.asked(step, &mut conditions);
            let known = match step {
                Step::SinCos(angle) => angles.get(&found.of[*angle]).map(|class| (*class, false)),
                Step::Solve { .. } | Step::Call { .. } => None,
                _ if found.is_zero(&runs, step, &values) => {
                    found.add(value, values, 0, Some(Rational::ZERO));
                    continue;
                }
                _ => found.equal(&by_size, &values, asked),
            };
            if let Some((class, minus)) = known {
                found.coincide = true;
                found.join(class, value, minus);
                continue;
            }
            let is_compared = !matches!(step, Step::SinCos(_) | Step::Solve { .. } | Step::Call { .. });
            let number = (is_compared && !numbers[value.index()]).then(|| short_number(&values)).flatten();
            let asked = if number.is_some() { 0 } else { asked };
            let class = found.add(value, values, asked, number);
            if let Step::SinCos(angle) = step {
                angles.insert(found.of[*angle], class);
            } else if is_compared && is_certain(&values) {
                by_size.entry(key(values[0].value)).or_default().push(class);
            }
        }
        found
    }

    fn add(&mut self, value: Value, values: Values, conditions: usize, number: Option<Rational>) -> usize {
        self.coincide |= number.is_some();
        self.all.push(Class { values, members: vec![(value, false)], conditions, number });
        self.of.push((self.all.len() - 1, false));
        self.all.len() - 1
    }

    fn join(&mut self, class: usize, value: Value, minus: bool) {
        self.all[class].members.push((value, minus));
        self.of.push((class, minus));
    }

    /// What it takes for a step to have a value. Those of what is divided by, or under a root, are the class of that.
    fn asked(&self, step: &Step, conditions: &mut Conditions) -> usize {
        let mut asked = 0;
        step.each_operand(|operand| {
            asked = conditions.union(asked, self.all[self.of[operand].0].conditions);
        });
        if !is_partial(step) {
            return asked;
        }
        let operands = match step {
            Step::Div(_, divisor) => vec![*divisor],
            _ => step.operands(),
        };
        operands.into_iter().fold(asked, |asked, operand| {
            let single = conditions.single(self.of[operand].0);
            conditions.union(asked, single)
        })
    }

    /// Whether a step is zero: a sum that is nothing beside its operands, as far as rounding tells, or a multiple of zero.
    fn is_zero(&self, runs: &[Vec<Sampled>], step: &Step, values: &Values) -> bool {
        let is_known =
            |value: &Value| self.all[self.of[*value].0].number.as_ref().is_some_and(Rational::is_zero);
        match step {
            Step::Add(a, b) | Step::Sub(a, b) => values.iter().zip(runs).all(|(sum, run)| {
                let size = run[a.index()].0.value.abs().max(run[b.index()].0.value.abs());
                sum.may_be_zero() && sum.error <= CERTAIN * size
            }),
            Step::Mul(a, b) => is_known(a) || is_known(b),
            Step::Div(a, _) => is_known(a),
            _ => false,
        }
    }

    /// The class with a value under these conditions, and whether with the opposite one.
    fn equal(
        &self,
        by_size: &FxHashMap<u64, Vec<usize>>,
        values: &Values,
        asked: usize,
    ) -> Option<(usize, bool)> {
        if !is_certain(values) {
            return None;
        }
        let place = key(values[0].value);
        let near = [place - 1, place, place + 1];
        let near = near.iter().filter_map(|place| by_size.get(place)).flatten();
        near.filter(|class| self.all[**class].conditions == asked).find_map(|class| {
            let known = &self.all[*class].values;
            let is = |sign: f64| {
                known.iter().zip(values).all(|(a, b)| {
                    let apart = Bounded { value: a.value - sign * b.value, error: a.error + b.error };
                    apart.may_be_zero()
                })
            };
            if is(1.0) { Some((*class, false)) } else { is(-1.0).then_some((*class, true)) }
        })
    }

    /// The first step of each class.
    fn first(&self) -> Vec<usize> {
        vec![0; self.all.len()]
    }

    /// The step of each class that takes the least, with all that it is computed from.
    fn shortest(&self, program: &Program, fixed: &[bool]) -> Vec<usize> {
        let mut costs = vec![f64::INFINITY; self.all.len()];
        let mut chosen = vec![0; self.all.len()];
        // a step costs more than each of its operands at any time, so that no choice waits for itself
        for _ in 0..PASSES {
            let mut settled = true;
            for (class, Class { members, number, .. }) in self.all.iter().enumerate() {
                if number.is_some() {
                    costs[class] = 0.0;
                    continue;
                }
                for (place, (value, _)) in members.iter().enumerate() {
                    let step = &program.steps[*value];
                    let mut cost = own_cost(step, fixed[value.index()]);
                    step.each_operand(|operand| cost += costs[self.of[operand].0]);
                    if cost < costs[class] {
                        (costs[class], chosen[class], settled) = (cost, place, false);
                    }
                }
            }
            if settled {
                break;
            }
        }
        chosen
    }

    /// The program in which each class is one step.
    fn program(&self, program: &Program, chosen: &[usize]) -> Program {
        let mut rebuilt = Rebuilt {
            classes: self,
            program,
            chosen,
            steps: Table::new(),
            done: vec![None; self.all.len()],
            opposite: FxHashMap::default(),
        };
        let is_angle =
            |step: &Step| matches!(step, Step::SinCos(_) | Step::Apply(Function::Sin | Function::Cos, _));
        let angles = program.steps.iter_ids().filter(|(_, step)| is_angle(step)).map(|(value, _)| value);
        let roots: Vec<Value> = angles.chain(program.outputs.iter().copied()).collect();
        for root in roots {
            rebuilt.reach(self.of[root].0);
        }
        let outputs: Vec<Value> = program.outputs.iter().map(|output| rebuilt.value(*output)).collect();
        let mut named = Program { outputs, ..Program::default() };
        for (value, symbol) in &program.names {
            let (class, minus) = self.of[*value];
            if let Some((image, turned)) = rebuilt.done[class]
                && turned == minus
                && !rebuilt.steps[image].is_leaf()
            {
                named.names.entry(image).or_insert(*symbol);
            }
        }
        named.steps = rebuilt.steps;
        without_dead_steps(&named)
    }
}

/// A program as it is written anew.
struct Rebuilt<'p> {
    classes: &'p Classes,
    program: &'p Program,
    chosen: &'p [usize],
    steps: Table<Value, Step>,
    /// The step of each class, and whether it has the opposite value.
    done: Vec<Option<(Value, bool)>>,
    /// Negatives that something asked for.
    opposite: FxHashMap<Value, Value>,
}

impl Rebuilt<'_> {
    /// Computes the value of a class, and what it is computed from before that.
    fn reach(&mut self, class: usize) {
        let mut open = vec![class];
        while let Some(class) = open.last().copied() {
            if self.done[class].is_some() {
                open.pop();
                continue;
            }
            let Class { members, number, .. } = &self.classes.all[class];
            let (value, minus) = members[self.chosen[class]];
            let step = &self.program.steps[value];
            let before = open.len();
            if number.is_none() {
                step.each_operand(|operand| {
                    let operand = self.classes.of[operand].0;
                    if self.done[operand].is_none() {
                        open.push(operand);
                    }
                });
            }
            if open.len() == before {
                let (image, turned) = match number {
                    Some(number) => (self.steps.push(Step::Constant(number.clone())), false),
                    None => self.built(step),
                };
                self.done[class] = Some((image, turned != minus));
                open.pop();
            }
        }
    }

    /// Where the value of a step is now, and whether with the opposite sign.
    fn image(&self, value: Value) -> (Value, bool) {
        let (class, minus) = self.classes.of[value];
        self.done[class].map_or((value, minus), |(image, turned)| (image, turned != minus))
    }

    /// The value of a step itself.
    fn value(&mut self, value: Value) -> Value {
        match self.image(value) {
            (image, false) => image,
            (image, true) => {
                let steps = &mut self.steps;
                *self.opposite.entry(image).or_insert_with(|| steps.push(Step::Neg(image)))
            }
        }
    }

    /// A step on the values as they are now, and whether it has the opposite sign.
    fn built(&mut self, step: &Step) -> (Value, bool) {
        let (step, minus) = match *step {
            Step::Add(a, b) => match (self.image(a), self.image(b)) {
                ((a, false), (b, true)) => (Step::Sub(a, b), false),
                ((a, true), (b, false)) => (Step::Sub(b, a), false),
                ((a, minus), (b, _)) => (Step::Add(a, b), minus),
            },
            Step::Sub(a, b) => match (self.image(a), self.image(b)) {
                ((a, false), (b, false)) => (Step::Sub(a, b), false),
                ((a, true), (b, true)) => (Step::Sub(b, a), false),
                ((a, minus), (b, _)) => (Step::Add(a, b), minus),
            },
            Step::Mul(a, b) => {
                let ((a, minus), (b, turned)) = (self.image(a), self.image(b));
                (Step::Mul(a, b), minus != turned)
            }
            Step::Div(a, b) => {
                let ((a, minus), (b, turned)) = (self.image(a), self.image(b));
                (Step::Div(a, b), minus != turned)
            }
            Step::Recip(a) => {
                let (a, minus) = self.image(a);
                (Step::Recip(a), minus)
            }
            Step::SinOf(a) => (Step::SinOf(self.image(a).0), false),
            Step::CosOf(a) => (Step::CosOf(self.image(a).0), false),
            ref step => {
                let operands = step.operands();
                let values: FxHashMap<Value, Value> =
                    operands.into_iter().map(|operand| (operand, self.value(operand))).collect();
                (rename(step, &|operand: Value| values[&operand]), false)
            }
        };
        (self.steps.push(step), minus)
    }
}

/// What a step takes beyond its operands.
fn own_cost(step: &Step, is_fixed: bool) -> f64 {
    let cost = match step {
        Step::Constant(_) | Step::Pi | Step::Load(_) => 0.0,
        Step::Neg(_) | Step::SinOf(_) | Step::CosOf(_) | Step::Component(..) => 0.25,
        Step::Add(..) | Step::Sub(..) | Step::Mul(..) | Step::MulAdd { .. } => 1.0,
        Step::Div(..) | Step::Recip(_) => 4.0,
        _ => 16.0,
    };
    // what depends on parameters alone is computed once for many evaluations
    if is_fixed { 0.5 * cost } else { cost }
}

fn is_certain(values: &Values) -> bool {
    values.iter().all(|of| of.value.is_finite() && of.error <= CERTAIN * of.value.abs() && of.value != 0.0)
}

/// The size of a number to nine digits: what is equal differs by one at most.
fn key(value: f64) -> u64 {
    (value.abs().to_bits() >> 22).max(1)
}

/// The short number that values are at all points.
#[allow(clippy::cast_precision_loss, clippy::cast_possible_truncation, reason = "numerators are short")]
fn short_number(values: &Values) -> Option<Rational> {
    if !is_certain(values) || values[0].value.abs() > 1e3 {
        return None;
    }
    let apart = |value: &Bounded, number: f64| {
        Bounded { value: value.value - number, error: value.error + f64::EPSILON * number.abs() }
            .may_be_zero()
    };
    (1..=DENOMINATORS).find_map(|denominator| {
        let numerator = (values[0].value * denominator as f64).round();
        let number = numerator / denominator as f64;
        let is_number = values.iter().all(|value| apart(value, number));
        is_number.then(|| Rational::new(numerator as i64, denominator))
    })
}
