//! Derivatives at rest: where a length `r = √s` vanishes, a derivative may divide by it and have a value all the same.
//!
//! The drag `−c |v| v` has the derivative `−c (|v| δᵢⱼ + vᵢ vⱼ/|v|)`, which tends to 0 with v. Where `s` is a sum of squares of
//! pᵢ, each |pᵢ| is at most r, so that a product of k of these and of `r^−j` is at most `r^(k−j)`. Orders of vanishing
//! are counted through a program: if they prove that all its outputs go on continuously to r = 0, and that whatever `1/r` is
//! there is multiplied by 0, then `1/r` may be any number there. It becomes `1/(r + (1 − sign r))`, which is `1/r` where r is
//! not 0, and 1 where it is.

use super::lower::{rename, without_dead_steps};
use super::orders_at_rest::{Length, Lengths, Limits, without_values};
use super::step::{Program, Step, Value};
use crate::algebra::{Function, Range, Rational};
use crate::id::{Id, SymbolId, Table};
use std::collections::{BTreeMap, BTreeSet};

/// A program that was looked at for lengths by which it divides.
#[derive(Clone, Debug)]
pub struct AtRest {
    /// It computes the same, and has values where some lengths vanish by which the program divides; if there are any.
    pub mended: Option<Program>,
    /// Whether roots are left that may vanish and are divided by.
    pub divides_by_roots: bool,
}

/// Mends the divisions by lengths of a program whose results are derivatives, by what is known of parameters.
#[must_use]
pub fn at_rest(program: &Program, range: &impl Fn(SymbolId) -> Range, limits: Limits) -> AtRest {
    let known = known_signs(program, range);
    let mut lengths: Vec<Length> = Vec::new();
    let mut squares: Vec<Value> = Vec::new();
    let mut divides_by_roots = false;
    for (root, step) in program.steps.iter_ids() {
        let Step::Sqrt(square) = step else { continue };
        let divisors = divisors(program, root, *square);
        if divisors.is_empty() {
            continue;
        }
        match Squares::of(program, *square, &known) {
            Squares::Positive => {}
            Squares::Of(small) if lengths.len() < Lengths::BITS as usize => {
                lengths.push(Length { root, small, divisors });
                squares.push(*square);
            }
            Squares::Of(_) | Squares::Unknown => divides_by_roots = true,
        }
    }
    // without some lengths the others may do
    let mut asked: Lengths =
        if lengths.is_empty() { 0 } else { Lengths::MAX >> (Lengths::BITS as usize - lengths.len()) };
    while asked != 0 {
        let without = without_values(program, &lengths, (asked, limits)) & asked;
        if without == 0 {
            break;
        }
        asked &= !without;
        divides_by_roots = true;
    }
    let mut mended: BTreeMap<Value, Vec<Value>> = BTreeMap::new();
    let places = lengths.into_iter().zip(squares).enumerate();
    for (_, (length, square)) in places.filter(|(place, _)| asked >> place & 1 == 1) {
        length.divisors.into_keys().for_each(|divisor| mended.entry(divisor).or_default().push(square));
    }
    let mended = (!mended.is_empty()).then(|| with_numbers_at_rest(program, &mended));
    AtRest { mended, divides_by_roots }
}

/// What is known of the places where something vanishes.
enum Squares {
    /// There are none.
    Positive,
    /// It is a sum of squares of these, multiplied by what is positive, and these vanish there.
    Of(Vec<Value>),
    /// Nothing.
    Unknown,
}

impl Squares {
    /// A sum of what is not negative vanishes where all of it does.
    fn of(program: &Program, value: Value, known: &Signs) -> Self {
        let (mut small, mut is_positive) = (Vec::new(), false);
        let (mut left, mut seen) = (vec![value], BTreeSet::new());
        while let Some(summand) = left.pop() {
            if !seen.insert(summand) {
                continue;
            }
            let term = match &program.steps[summand] {
                Step::Add(a, b) => {
                    left.extend([*a, *b]);
                    continue;
                }
                Step::MulAdd { a, b, c, minus_product: false, minus_c: false } => {
                    left.push(*c);
                    Term::of(program, &[*a, *b], known)
                }
                Step::MulAdd { .. } => Term::Unknown,
                _ => Term::of(program, &[summand], known),
            };
            match term {
                Term::Unknown => return Self::Unknown,
                Term::Positive => is_positive = true,
                Term::Square(base) => small.push(base),
                Term::Sum(sum) => left.push(sum),
            }
        }
        if is_positive { Self::Positive } else { Self::Of(small) }
    }
}

/// A product as a term of such a sum.
enum Term {
    /// All its factors are positive.
    Positive,
    /// One is a square, and all others are positive.
    Square(Value),
    /// One is a sum.
    Sum(Value),
    /// None of these.
    Unknown,
}

impl Term {
    fn of(program: &Program, factors: &[Value], known: &Signs) -> Self {
        let mut counts: BTreeMap<Value, usize> = BTreeMap::new();
        let add = |counts: &mut BTreeMap<Value, usize>, factor: Value, times: usize| {
            let count = counts.entry(factor).or_default();
            *count = count.saturating_add(times);
        };
        for factor in factors {
            add(&mut counts, *factor, 1);
        }
        let mut term = Self::Positive;
        // operands come earlier, so that each factor is met once
        while let Some((factor, count)) = counts.pop_last() {
            let is_positive = |value: Value| match known[value] {
                Sign::Positive => true,
                Sign::Nonzero => count.is_multiple_of(2),
                Sign::Unknown => false,
            };
            match (&program.steps[factor], count, &term) {
                _ if is_positive(factor) => {}
                (Step::Mul(a, b), ..) => {
                    add(&mut counts, *a, count);
                    add(&mut counts, *b, count);
                }
                (Step::Div(dividend, divisor), ..) if is_positive(*divisor) => {
                    add(&mut counts, *dividend, count);
                }
                (_, 2, Self::Positive) => term = Self::Square(factor),
                (Step::Add(..) | Step::MulAdd { .. }, 1, Self::Positive) => term = Self::Sum(factor),
                _ => return Self::Unknown,
            }
        }
        term
    }
}

/// What is known of the sign of a value, wherever the program has values.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Sign {
    Positive,
    Nonzero,
    Unknown,
}

type Signs = Table<Value, Sign>;

/// The signs of all steps, as those of parameters and numbers give them.
fn known_signs(program: &Program, range: &impl Fn(SymbolId) -> Range) -> Signs {
    let of_range = |range: Range| match (range.is_positive(), range.nonzero) {
        (true, _) => Sign::Positive,
        (false, true) => Sign::Nonzero,
        (false, false) => Sign::Unknown,
    };
    let product = |a: Sign, b: Sign| match (a, b) {
        (Sign::Positive, Sign::Positive) => Sign::Positive,
        (Sign::Unknown, _) | (_, Sign::Unknown) => Sign::Unknown,
        _ => Sign::Nonzero,
    };
    let mut signs: Signs = Table::new();
    for step in &program.steps {
        signs.push(match step {
            Step::Constant(number) if number.is_zero() => Sign::Unknown,
            Step::Constant(number) if number.is_negative() => Sign::Nonzero,
            Step::Constant(_) | Step::Pi => Sign::Positive,
            Step::Load(symbol) => of_range(range(*symbol)),
            Step::Mul(a, b) if a == b && signs[*a] != Sign::Unknown => Sign::Positive,
            Step::Mul(a, b) | Step::Div(a, b) => product(signs[*a], signs[*b]),
            Step::Neg(a) => product(signs[*a], Sign::Nonzero),
            Step::Recip(a) | Step::Sqrt(a) => signs[*a],
            Step::Add(a, b) if [signs[*a], signs[*b]] == [Sign::Positive; 2] => Sign::Positive,
            _ => Sign::Unknown,
        });
    }
    signs
}

/// The power of a length, whose square is known as well, among the factors of what is divided by.
fn divisors(program: &Program, root: Value, square: Value) -> BTreeMap<Value, usize> {
    let mut powers: Table<Value, usize> = Table::new();
    for (value, step) in program.steps.iter_ids() {
        let power = match step {
            _ if value == root => 1,
            _ if value == square => 2,
            Step::Mul(a, b) => powers[*a].saturating_add(powers[*b]),
            Step::Add(a, b) if a == b => powers[*a],
            Step::Neg(a) => powers[*a],
            _ => 0,
        };
        powers.push(power);
    }
    let divisors = program.steps.iter().filter_map(|step| match step {
        Step::Div(_, divisor) | Step::Recip(divisor) => Some((*divisor, powers[*divisor])),
        _ => None,
    });
    divisors.filter(|(_, power)| (1..=HIGHEST).contains(power)).collect()
}

/// By higher powers of a length is not divided.
const HIGHEST: usize = 8;

/// The program with other divisors in place of some, each with the squares of its lengths: where one of these vanishes, it
/// is 1, and 2 where two do.
fn with_numbers_at_rest(program: &Program, mended: &BTreeMap<Value, Vec<Value>>) -> Program {
    let mut steps: Table<Value, Step> = Table::new();
    let mut renamed: Vec<Value> = Vec::with_capacity(program.steps.len());
    let mut at_rest: BTreeMap<Value, Value> = BTreeMap::new();
    let mut lengths: BTreeMap<Value, (Value, Value)> = BTreeMap::new();
    for (value, step) in program.steps.iter_ids() {
        let is_quotient = matches!(step, Step::Div(..) | Step::Recip(_)) || program.is_rest(step);
        let plain = |old: Value| renamed[old.index()];
        let divisor = |old: Value| at_rest.get(&old).filter(|_| is_quotient).copied().unwrap_or(plain(old));
        let known_root = if let Step::Sqrt(square) = step { lengths.get(square) } else { None };
        let result = match (step, known_root) {
            (_, Some((root, _))) => *root,
            (Step::Div(a, b), None) => steps.push(Step::Div(plain(*a), divisor(*b))),
            _ => steps.push(rename(step, &divisor)),
        };
        renamed.push(result);
        let mut at_rest_too = result;
        for square in mended.get(&value).into_iter().flatten() {
            let (_, gap) = *lengths.entry(*square).or_insert_with(|| {
                let root = Step::Sqrt(renamed[square.index()]);
                let known = steps.iter_ids().find(|(_, step)| **step == root).map(|(value, _)| value);
                let root = known.unwrap_or_else(|| steps.push(root));
                let sign = steps.push(Step::Apply(Function::Sign, root));
                let one = steps.push(Step::Constant(Rational::ONE));
                (root, steps.push(Step::Sub(one, sign)))
            });
            at_rest_too = steps.push(Step::Add(at_rest_too, gap));
            at_rest.insert(value, at_rest_too);
        }
    }
    let outputs = program.outputs.iter().map(|output| renamed[output.index()]).collect();
    let names = program.names.iter().map(|(value, symbol)| (renamed[value.index()], *symbol)).collect();
    without_dead_steps(&Program { steps, outputs, names })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::Graph;
    use crate::id::ExprId;
    use crate::mechanics::Procedure;
    use crate::program::{interpret, schedule};

    /// What a program gives where all symbols but the third are 0, as it is and mended.
    fn at_zero(
        limits: Limits,
        outputs: impl FnOnce(&mut Graph, [ExprId; 3]) -> Vec<ExprId>,
    ) -> (AtRest, Vec<f64>) {
        let mut graph = Graph::new();
        let symbols = ["x", "y", "z"].map(|name| graph.new_symbol(name));
        let expressions = symbols.map(|symbol| graph.symbol(symbol));
        let outputs = outputs(&mut graph, expressions);
        let program = schedule(&graph, &Procedure::of(outputs));
        let found = at_rest(&program, &|_| Range::ALL, limits);
        let value = |symbol: SymbolId| if symbol == symbols[2] { 0.7 } else { 0.0 };
        let values = found.mended.as_ref().map(|program| interpret(program, value)).unwrap_or_default();
        (found, values)
    }

    #[test]
    fn quotients_that_tend_to_zero_are_zero() {
        let (found, values) = at_zero(Limits::Open, |graph, [x, y, z]| {
            let square = graph.formula(x * x + y * y);
            let (root, sine) = (graph.sqrt(square), graph.sin(z));
            vec![
                graph.formula(root + x * x / root),
                graph.formula(sine * x * y / root + z),
                graph.formula(x * z),
            ]
        });
        assert!(!found.divides_by_roots);
        assert_eq!(values, [0.0, 0.7, 0.0]);
    }

    /// Of a graph, a root in it, and three symbols.
    type Quotient = fn(&mut Graph, ExprId, [ExprId; 3]) -> ExprId;

    #[test]
    fn what_tends_to_nothing_stays() {
        let jumps: [Quotient; 4] = [
            |graph, root, [x, ..]| graph.formula(x / root),
            |graph, root, [x, _, z]| graph.formula(x * z * z / root),
            |graph, root, [_, _, z]| graph.formula(z * z / root),
            |graph, root, [x, ..]| {
                let quotient = graph.formula(x * x / root);
                let sign = graph.apply(Function::Sign, quotient);
                graph.formula(sign + quotient)
            },
        ];
        for jump in jumps {
            let (found, _) = at_zero(Limits::Open, |graph, symbols @ [x, y, _]| {
                let square = graph.formula(x * x + y * y);
                let root = graph.sqrt(square);
                vec![jump(graph, root, symbols)]
            });
            assert!(found.mended.is_none() && found.divides_by_roots);
        }
        // the square of one factor alone is as small as that, and a root of what may be negative is no length
        for other in [1, -1] {
            let (found, _) = at_zero(Limits::Open, |graph, [x, y, _]| {
                let other = graph.number(other);
                let square = graph.formula(x * x * y * y + other * y);
                let root = graph.sqrt(square);
                vec![graph.formula(x * x / root)]
            });
            assert!(found.mended.is_none() && found.divides_by_roots);
        }
    }

    /// Two lengths: what is divided by one of them has to vanish with it, whatever vanishes with the other.
    #[test]
    fn each_length_is_paid_for_by_its_own() {
        let of_two = |limits: Limits, numerator: fn(&mut Graph, [ExprId; 3]) -> ExprId| {
            at_zero(limits, |graph, symbols @ [x, y, z]| {
                let (first, second) = (graph.formula(x * x), graph.formula(y * y + z * z));
                let (first, second) = (graph.sqrt(first), graph.sqrt(second));
                let numerator = numerator(graph, symbols);
                vec![graph.formula(numerator / (first * second)), graph.formula(x * x / first)]
            })
        };
        let (found, values) = of_two(Limits::Open, |graph, [x, y, z]| graph.formula(x * x * y * z));
        assert!(!found.divides_by_roots && found.mended.is_some());
        assert_eq!(values, [0.0, 0.0]);
        let (found, values) = of_two(Limits::Open, |graph, [x, _, z]| graph.formula(x * x * z));
        assert!(found.divides_by_roots);
        assert_eq!(values, [0.0, 0.0], "the second length does not vanish here");
        let (found, _) = of_two(Limits::Open, |graph, [_, y, z]| graph.formula(y * y * z * z));
        assert!(found.divides_by_roots);
    }

    /// Where terms with 1/r tend to 0 together, each of them has to be 0 as it is computed; r over r is not.
    #[test]
    fn what_is_known_to_tend_to_zero_is_zero() {
        let of_quotient = |numerator: Quotient| {
            at_zero(Limits::WithoutQuotients, |graph, symbols @ [x, y, _]| {
                let square = graph.formula(x * x + y * y);
                let root = graph.sqrt(square);
                let numerator = numerator(graph, root, symbols);
                vec![graph.formula(numerator / root)]
            })
        };
        let (found, values) = of_quotient(|graph, _, [x, _, z]| graph.formula(x * z));
        assert!(!found.divides_by_roots && values == [0.0]);
        let (found, _) = of_quotient(|graph, _, [x, y, z]| graph.formula(x * y + z));
        assert!(found.divides_by_roots && found.mended.is_none());
    }
}
