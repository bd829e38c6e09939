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
pub(super) fn absorb_signs(program: Program) -> Program {
    let negates = program.steps.iter().any(|step| matches!(step, Step::Neg(_)));
    if program.steps.len() > LONGEST || !negates {
        return program;
    }
    let mut open = Open::of(program);
    let mut settled = 0;
    while let Some((negation, start, opposite)) = open.improvement(settled) {
        let before = open.count_before(negation);
        if !open.turn(start, &opposite) {
            let (program, start, opposite) = open.without_gaps(start, &opposite);
            open = Open::of(rebuilt(program, start, &opposite));
        }
        settled = open.place(before.saturating_sub(1));
    }
    let is_whole = open.stands.iter().all(|stands| *stands);
    if is_whole { open.program } else { open.compact().0 }
}

/// A program in which steps disappear, and others change where they stand.
struct Open {
    program: Program,
    /// The steps that have not disappeared.
    stands: Vec<bool>,
    users: Users,
}

impl Open {
    fn of(program: Program) -> Self {
        Self { stands: vec![true; program.steps.len()], users: Users::of(&program), program }
    }

    /// How many steps stand before one.
    fn count_before(&self, value: Value) -> usize {
        self.stands[..value.index()].iter().filter(|stands| **stands).count()
    }

    /// Where the step stands before which there are so many.
    fn place(&self, count: usize) -> usize {
        let standing = self.stands.iter().enumerate().filter(|(_, stands)| **stands);
        standing.map(|(place, _)| place).nth(count).unwrap_or(self.stands.len())
    }

    /// The first negation from `settled` on that can be got rid of, where that begins, and what is opposite then.
    fn improvement(&self, settled: usize) -> Option<(Value, Value, Opposite)> {
        let Self { program, users, .. } = self;
        for value in (settled..program.steps.len()).map(Value::from_index) {
            let Step::Neg(inner) = program.steps[value] else { continue };
            for candidate in candidates(program, inner) {
                let opposite = opposite(program, users, candidate);
                if gain(program, users, &opposite) > 0 {
                    return Some((value, candidate, opposite));
                }
            }
        }
        None
    }

    /// Computes values with the opposite sign where no step has to be added for it; whether that is so.
    fn turn(&mut self, start: Value, opposite: &Opposite) -> bool {
        let Self { program, stands, users } = self;
        let Some(turned) = turned_in_place(&program.steps[start]) else { return false };
        if program.outputs.iter().any(|output| opposite.contains(*output)) {
            return false;
        }
        let mut concerned: Vec<Value> =
            opposite.values.iter().flat_map(|value| users.of_value(*value)).copied().collect();
        concerned.sort_unstable();
        concerned.dedup();
        let mut changes = Vec::with_capacity(concerned.len());
        let mut gone = Vec::new();
        for user in concerned {
            match change(&program.steps[user], |operand| opposite.contains(*operand)) {
                Change::Same(step) | Change::Opposite(step) => changes.push((user, step)),
                Change::Vanishes(_) => gone.push(user),
                Change::None => {}
                Change::Refused => return false,
            }
        }
        program.steps[start] = turned;
        for (user, step) in changes {
            program.steps[user] = step;
        }
        for value in opposite.values.iter().chain(&gone) {
            program.names.remove(value);
        }
        for negation in gone {
            let Step::Neg(image) = program.steps[negation] else { continue };
            let moved = users.hand_on(negation, image);
            for user in moved {
                let renamed = rename(&program.steps[user], &|old| if old == negation { image } else { old });
                program.steps[user] = renamed;
            }
            for output in program.outputs.iter_mut().filter(|output| **output == negation) {
                *output = image;
            }
            program.steps[negation] = Step::Constant(Rational::ZERO);
            stands[negation.index()] = false;
        }
        true
    }

    /// The program without the places of steps that have disappeared, and where each value is in it.
    fn compact(self) -> (Program, Vec<Value>) {
        let Program { steps, outputs, names } = self.program;
        let mut compact = Table::new();
        let mut images = Vec::with_capacity(steps.len());
        for (step, stands) in steps.iter().zip(&self.stands) {
            images.push(Value::from_index(compact.len()));
            if *stands {
                compact.push(rename(step, &|old: Value| images[old.index()]));
            }
        }
        let names = names.into_iter().map(|(value, name)| (images[value.index()], name)).collect();
        let outputs = outputs.into_iter().map(|output| images[output.index()]).collect();
        (Program { steps: compact, outputs, names }, images)
    }

    /// The same with some of its values.
    fn without_gaps(self, start: Value, opposite: &Opposite) -> (Program, Value, Opposite) {
        let (program, images) = self.compact();
        let mut moved = Opposite { values: Vec::new(), is: vec![false; program.steps.len()] };
        for value in &opposite.values {
            moved.add(images[value.index()]);
        }
        (program, images[start.index()], moved)
    }
}

/// The steps that use each value, those twice that use it twice.
struct Users {
    lists: Vec<Vec<Value>>,
}

impl Users {
    fn of(program: &Program) -> Self {
        let mut lists = vec![Vec::new(); program.steps.len()];
        for (value, step) in program.steps.iter_ids() {
            step.each_operand(|operand| lists[operand.index()].push(value));
        }
        Self { lists }
    }

    fn of_value(&self, value: Value) -> &[Value] {
        &self.lists[value.index()]
    }

    /// Those of a value use another one in its place, which it has used until now.
    fn hand_on(&mut self, value: Value, to: Value) -> Vec<Value> {
        let moved = std::mem::take(&mut self.lists[value.index()]);
        let list = &mut self.lists[to.index()];
        list.retain(|user| *user != value);
        list.extend_from_slice(&moved);
        moved
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

/// A step with the opposite sign that takes no other.
fn turned_in_place(step: &Step) -> Option<Step> {
    match *step {
        Step::Sub(a, b) => Some(Step::Sub(b, a)),
        Step::MulAdd { a, b, c, minus_product, minus_c } => {
            Some(Step::MulAdd { a, b, c, minus_product: !minus_product, minus_c: !minus_c })
        }
        _ => None,
    }
}

/// Takes a step with the opposite sign, whose operands stay where they are.
fn turned(steps: &mut Table<Value, Step>, step: &Step) -> Value {
    if let Some(turned) = turned_in_place(step) {
        return steps.push(turned);
    }
    let turned = match *step {
        Step::Recip(a) => Step::Div(steps.push(Step::Constant(Rational::MINUS_ONE)), a),
        _ => match number(steps, step).map(|(number, other)| (-number.clone(), other)) {
            Some((minus, other)) => Step::Mul(steps.push(Step::Constant(minus)), other),
            None => step.clone(),
        },
    };
    steps.push(turned)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::Residue;
    use crate::program::interpret;

    /// A program of sums, products and negations that a seed determines.
    fn random(seed: u64) -> Program {
        let mut steps: Table<Value, Step> = Table::new();
        let word = |k: usize| Residue::mixed(seed, k as u64).word();
        for number in [2, 3, 5] {
            steps.push(Step::Constant(Rational::from(number)));
        }
        for k in 3..40 {
            let of =
                |salt: u64| Value::from_index(usize::try_from((word(k) >> salt) % k as u64).unwrap_or(0));
            let (a, b, c) = (of(3), of(17), of(31));
            steps.push(match word(k) % 7 {
                0 | 1 => Step::Neg(a),
                2 => Step::Sub(a, b),
                3 => Step::Add(a, b),
                4 => Step::Mul(a, b),
                5 => Step::Div(a, Value::from_index(0)),
                _ => Step::MulAdd { a, b, c, minus_product: word(k) & 8 == 0, minus_c: word(k) & 16 == 0 },
            });
        }
        let outputs = steps.ids().rev().step_by(5).take(4).collect();
        Program { steps, outputs, names: std::iter::empty().collect() }
    }

    /// Where steps stand or in a new program, what disappears and what is left are the same, and so are the values.
    #[test]
    fn steps_that_stand_become_those_of_a_new_program() {
        let mut in_place = 0;
        for seed in 0..400 {
            let program = random(seed);
            let mut open = Open::of(program.clone());
            let Some((_, start, opposite)) = open.improvement(0) else { continue };
            let expected = rebuilt(program.clone(), start, &opposite);
            if open.turn(start, &opposite) {
                in_place += 1;
                let (found, _) = open.compact();
                assert_eq!((&found.steps, &found.outputs), (&expected.steps, &expected.outputs), "{seed}");
            }
            let absorbed = absorb_signs(program.clone());
            for (found, value) in interpret(&absorbed, |_| 1.0).iter().zip(interpret(&program, |_| 1.0)) {
                let is_near = (found - value).abs() <= 1e-9 * value.abs();
                assert!(is_near || !value.is_finite(), "{seed}: {found} {value}");
            }
        }
        assert!(in_place > 40, "{in_place}");
    }
}
