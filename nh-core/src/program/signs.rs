//! Moves signs to where they cost nothing.
//!
//! A difference, a multiply-add, a reciprocal and a multiple may as well be computed with the opposite sign. What
//! uses them changes with them: sums become differences, products change their sign in turn, and
//! negations disappear. That is done wherever more negations disappear than come.

use super::lower::rename;
use super::step::{Program, Step, Value};
use crate::algebra::Rational;
use crate::id::{Id, Table};
use std::collections::BTreeSet;

/// Values that may be tried for one negation.
const CANDIDATES: usize = 16;
/// Programs with more steps are left as they are: every attempt looks through all of them.
const LONGEST: usize = 3000;

/// The program with fewer negations.
pub(super) fn absorb_signs(mut program: Program) -> Program {
    let negates = program.steps.iter().any(|step| matches!(step, Step::Neg(_)));
    if program.steps.len() > LONGEST || !negates {
        return program;
    }
    let mut settled = 0;
    while let Some((negation, start, opposite)) = improvement(&program, settled) {
        program = rebuilt(program, start, &opposite);
        settled = negation.index().saturating_sub(1);
    }
    program
}

/// The first negation from `settled` on that can be got rid of, where that begins, and what is opposite then.
fn improvement(program: &Program, settled: usize) -> Option<(Value, Value, Opposite)> {
    let users = Users::of(program);
    for value in (settled..program.steps.len()).map(Value::from_index) {
        let Step::Neg(inner) = program.steps[value] else { continue };
        for candidate in candidates(program, inner) {
            let opposite = opposite(program, &users, candidate);
            if gain(program, &users, &opposite) > 0 {
                return Some((value, candidate, opposite));
            }
        }
    }
    None
}

/// The steps that use each value: one list, and where the users of a value begin in it.
struct Users {
    begin: Vec<usize>,
    list: Vec<Value>,
}

impl Users {
    fn of(program: &Program) -> Self {
        let mut begin = vec![0; program.steps.len() + 1];
        program.steps.iter().for_each(|step| step.each_operand(|operand| begin[operand.index()] += 1));
        let mut total = 0;
        for count in &mut begin {
            total += std::mem::replace(count, total);
        }
        let mut users = Self { list: vec![Value::from_index(0); total], begin };
        let mut end = users.begin.clone();
        for (value, step) in program.steps.iter_ids() {
            step.each_operand(|operand| {
                users.list[end[operand.index()]] = value;
                end[operand.index()] += 1;
            });
        }
        users
    }

    /// The steps that use a value, those twice that use it twice.
    fn of_value(&self, value: Value) -> &[Value] {
        &self.list[self.begin[value.index()]..self.begin[value.index() + 1]]
    }
}

/// The factors of a value that can be computed with either sign.
fn candidates(program: &Program, value: Value) -> Vec<Value> {
    let mut found = Vec::new();
    let mut open = vec![value];
    while let Some(value) = open.pop() {
        match &program.steps[value] {
            Step::Sub(..) | Step::MulAdd { .. } => found.push(value),
            Step::Recip(inner) => {
                found.push(value);
                open.push(*inner);
            }
            step @ (Step::Mul(a, b) | Step::Div(a, b)) => {
                if number(&program.steps, step).is_some() {
                    found.push(value);
                }
                open.extend([*b, *a]);
            }
            _ => {}
        }
        if found.len() + open.len() > CANDIDATES {
            break;
        }
    }
    found
}

/// The number that is a factor of a product, and the other factor.
fn number<'a>(steps: &'a Table<Value, Step>, step: &Step) -> Option<(&'a Rational, Value)> {
    let Step::Mul(a, b) = step else { return None };
    [(a, b), (b, a)].into_iter().find_map(|(factor, other)| match &steps[*factor] {
        Step::Constant(number) => Some((number, *other)),
        _ => None,
    })
}

/// What a step becomes if some of its operands have the opposite sign.
enum Change {
    /// It does not change.
    None,
    /// Another step of the same value.
    Same(Step),
    /// A step of the opposite value.
    Opposite(Step),
    /// A negation whose operand is its value now.
    Vanishes(Value),
    /// The operands are needed as they were.
    Refused,
}

fn change(step: &Step, is_opposite: impl Fn(&Value) -> bool) -> Change {
    let mut is_concerned = false;
    step.each_operand(|operand| is_concerned |= is_opposite(&operand));
    if !is_concerned {
        return Change::None;
    }
    match *step {
        Step::Neg(a) => Change::Vanishes(a),
        Step::Mul(a, b) | Step::Div(a, b) if is_opposite(&a) == is_opposite(&b) => Change::Same(step.clone()),
        Step::Mul(..) | Step::Div(..) | Step::Recip(_) => Change::Opposite(step.clone()),
        Step::Add(a, b) => match (is_opposite(&a), is_opposite(&b)) {
            (true, false) => Change::Same(Step::Sub(b, a)),
            (false, _) => Change::Same(Step::Sub(a, b)),
            (true, true) => Change::Opposite(step.clone()),
        },
        Step::Sub(a, b) => match (is_opposite(&a), is_opposite(&b)) {
            (true, false) => Change::Opposite(Step::Add(a, b)),
            (false, _) => Change::Same(Step::Add(a, b)),
            (true, true) => Change::Same(Step::Sub(b, a)),
        },
        Step::MulAdd { a, b, c, minus_product, minus_c } => Change::Same(Step::MulAdd {
            a,
            b,
            c,
            minus_product: minus_product ^ is_opposite(&a) ^ is_opposite(&b),
            minus_c: minus_c ^ is_opposite(&c),
        }),
        _ => Change::Refused,
    }
}

/// Values with the opposite sign: in order, and one by one.
struct Opposite {
    values: Vec<Value>,
    is: Vec<bool>,
}

impl Opposite {
    fn add(&mut self, value: Value) {
        self.values.push(value);
        self.is[value.index()] = true;
    }

    fn contains(&self, value: Value) -> bool {
        self.is[value.index()]
    }
}

/// The values that change their sign with `start`.
fn opposite(program: &Program, users: &Users, start: Value) -> Opposite {
    let mut opposite = Opposite { values: Vec::new(), is: vec![false; program.steps.len()] };
    opposite.add(start);
    let mut open: BTreeSet<Value> = users.of_value(start).iter().copied().collect();
    while let Some(value) = open.pop_first() {
        if let Change::Opposite(_) = change(&program.steps[value], |operand| opposite.contains(*operand)) {
            opposite.add(value);
            open.extend(users.of_value(value));
        }
    }
    opposite
}

/// How many negations fewer there are with these values of opposite sign.
fn gain(program: &Program, users: &Users, opposite: &Opposite) -> i32 {
    let mut gain = 0;
    for value in &opposite.values {
        let mut needed = program.outputs.contains(value);
        for user in users.of_value(*value) {
            match change(&program.steps[*user], |operand| opposite.contains(*operand)) {
                Change::Vanishes(_) => gain += 1,
                Change::Refused => needed = true,
                _ => {}
            }
        }
        gain -= i32::from(needed);
    }
    gain
}

/// The program with these values of opposite sign, the first of which is computed so.
fn rebuilt(program: Program, start: Value, opposite: &Opposite) -> Program {
    let Program { mut steps, outputs, mut names } = program;
    // what comes before stays where it is
    let rest = steps.split_off(start);
    let mut named = names.split_off(&start).into_iter().peekable();
    // where each value is now, with its own sign or, of those in `opposite`, with the other one
    let mut images: Table<Value, Value> = steps.ids().collect();
    let mut restored: Vec<Option<Value>> = vec![None; steps.len() + rest.len()];
    images.push(turned(&mut steps, &rest[0]));
    for step in &rest[1..] {
        let value = Value::from_index(images.len());
        match change(step, |operand| opposite.contains(*operand)) {
            Change::None => images.push(steps.push(rename(step, &|old: Value| images[old]))),
            Change::Same(step) | Change::Opposite(step) => {
                images.push(steps.push(rename(&step, &|old: Value| images[old])))
            }
            Change::Vanishes(operand) => {
                images.push(images[operand]);
                continue;
            }
            Change::Refused => {
                for operand in step.operands() {
                    if opposite.contains(operand) && restored[operand.index()].is_none() {
                        let image = images[operand];
                        restored[operand.index()] = Some(steps.push(Step::Neg(image)));
                    }
                }
                let of = |old: Value| restored[old.index()].unwrap_or(images[old]);
                images.push(steps.push(rename(step, &of)));
                continue;
            }
        };
        while named.next_if(|(other, _)| *other < value).is_some() {}
        if let Some((_, name)) = named.next_if(|(other, _)| *other == value && !opposite.contains(value)) {
            names.insert(images[value], name);
        }
    }
    let outputs = outputs.into_iter().map(|output| {
        let image = images[output];
        if opposite.contains(output) {
            *restored[output.index()].get_or_insert_with(|| steps.push(Step::Neg(image)))
        } else {
            image
        }
    });
    let outputs = outputs.collect();
    Program { steps, outputs, names }
}

/// Takes a step with the opposite sign, whose operands stay where they are.
fn turned(steps: &mut Table<Value, Step>, step: &Step) -> Value {
    let turned = match *step {
        Step::Sub(a, b) => Step::Sub(b, a),
        Step::MulAdd { a, b, c, minus_product, minus_c } => {
            Step::MulAdd { a, b, c, minus_product: !minus_product, minus_c: !minus_c }
        }
        Step::Recip(a) => Step::Div(steps.push(Step::Constant(Rational::MINUS_ONE)), a),
        _ => match number(steps, step).map(|(number, other)| (-number.clone(), other)) {
            Some((minus, other)) => Step::Mul(steps.push(Step::Constant(minus)), other),
            None => step.clone(),
        },
    };
    steps.push(turned)
}
