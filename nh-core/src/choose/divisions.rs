//! What a program divides by is what its procedure divides by: lowering adds no condition.
//!
//! Divisors are compared in numbers: one of the program is a multiple by a number of one of the procedure, of a factor
//! of one, of a product of two to four, or of one or two over another, at two points of the field; or it is a
//! product of such. An angle whose sine and cosine are written by those of others is met like this, and so is a sum that
//! is written otherwise.

use super::pivots::is_multiple;
use crate::algebra::{FieldPass, Function, Graph, Node, Residue, determinant_in_field};
use crate::id::{ExprId, Table};
use crate::mechanics::{Definition, Procedure};
use crate::program::{Program, Step, Value};
use std::collections::BTreeSet;

/// What is said of a program with another divisor.
pub(super) const OTHER_DIVISOR: &str =
    "it divides by what was not recognised as a divisor, or a product of divisors, of its procedure";

/// What a procedure and the parts of its program divide by, at one point.
pub(super) struct Divisions {
    procedure: Vec<Option<Residue>>,
    /// All values of each part.
    parts: Vec<Table<Value, Residue>>,
}

impl Divisions {
    /// At a point where both have values: `pass` has run the procedure.
    pub(super) fn at(
        (graph, procedure): (&Graph, &Procedure),
        pass: &mut FieldPass,
        parts: Vec<Table<Value, Residue>>,
    ) -> Self {
        let mut known: Vec<Option<Residue>> = Vec::new();
        for divisor in factors(graph, procedure) {
            known.push(pass.evaluate(&[divisor]).ok().map(|values| values[0]));
        }
        for definition in &procedure.definitions {
            if let Definition::Solve { matrix, .. } = definition {
                let rows: Result<Vec<_>, _> = matrix.iter().map(|row| pass.evaluate(row)).collect();
                known.push(rows.ok().map(determinant_in_field));
            }
        }
        Self { procedure: known, parts }
    }
}

/// The divisors of a procedure, and the factors of those that are products.
fn factors(graph: &Graph, procedure: &Procedure) -> BTreeSet<ExprId> {
    let mut found = graph.divisors(&procedure.expressions());
    for divisor in found.clone() {
        if let Node::Product { factors, .. } = graph.node(divisor) {
            found.extend(factors.iter().map(|(base, _)| *base));
        }
    }
    found
}

/// Whether every divisor of the parts is recognised as one of the procedure.
pub(super) fn are_those_of_the_procedure(parts: &[&Program], points: &[Divisions; 2]) -> bool {
    let pair = |k: usize| Some([points[0].procedure[k]?, points[1].procedure[k]?]);
    let mut known: Vec<[Residue; 2]> = (0..points[0].procedure.len()).filter_map(pair).collect();
    parts.iter().enumerate().all(|(number, program)| {
        let values = points.each_ref().map(|point| &point.parts[number]);
        let mut part = Part { program, values, known: &mut known };
        program.steps.iter().all(|step| match step {
            Step::Div(_, divisor) | Step::Recip(divisor) => part.is_known(*divisor),
            Step::Solve { matrix, .. } => part.is_regular(matrix),
            _ => true,
        })
    })
}

/// A part of a program at two points.
struct Part<'p> {
    program: &'p Program,
    values: [&'p Table<Value, Residue>; 2],
    /// What the procedure divides by, and what was found to vanish nowhere else.
    known: &'p mut Vec<[Residue; 2]>,
}

impl Part<'_> {
    /// Whether something vanishes only where what the procedure divides by does.
    fn is_known(&mut self, divisor: Value) -> bool {
        let value = self.values.map(|values| values[divisor]);
        if is_recognised(self.known, value) {
            return true;
        }
        let is_known = match self.program.steps[divisor] {
            Step::Constant(_)
            | Step::Pi
            | Step::Recip(_)
            | Step::Apply(Function::Exp | Function::Cosh, _) => true,
            Step::Mul(a, b) => self.is_known(a) && self.is_known(b),
            // what it is divided by is asked by itself
            Step::Neg(a) | Step::Div(a, _) | Step::Sqrt(a) | Step::Cbrt(a) | Step::PowReal(a, _) => {
                self.is_known(a)
            }
            _ => false,
        };
        if is_known {
            self.known.push(value);
        }
        is_known
    }

    fn is_regular(&self, matrix: &[Vec<Value>]) -> bool {
        let determinant = |values: &Table<Value, Residue>| {
            let row = |row: &Vec<Value>| row.iter().map(|entry| values[*entry]).collect();
            determinant_in_field(matrix.iter().map(row).collect())
        };
        is_recognised(self.known, self.values.map(determinant))
    }
}

/// Of more divisors no products of four are tried.
const MOST_OF_FOUR: usize = 40;

/// Whether a value is a multiple of a, a b, a b c, a b c d, a/c or a b/c.
fn is_recognised(known: &[[Residue; 2]], value: [Residue; 2]) -> bool {
    let product = |a: [Residue; 2], b: [Residue; 2]| [a[0] * b[0], a[1] * b[1]];
    let is_one = |value: [Residue; 2]| known.iter().any(|a| is_multiple(value, *a));
    let pairs =
        || known.iter().enumerate().flat_map(|(k, a)| known[..=k].iter().map(move |b| product(*a, *b)));
    is_one(value)
        || pairs().any(|pair| is_multiple(value, pair))
        || known.iter().any(|c| {
            let times = product(value, *c);
            is_one(times)
                || pairs().any(|pair| is_multiple(times, pair) || is_multiple(value, product(pair, *c)))
        })
        || known.len() <= MOST_OF_FOUR
            && pairs().any(|pair| pairs().any(|other| is_multiple(value, product(pair, other))))
}
