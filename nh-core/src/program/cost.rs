//! What a program costs: the one model by which forms, schedules and solutions are compared.
//!
//! The unit is a cycle from operands to result in double precision, summed over all operations, as if each waited for
//! the one before. It follows what is executed closely enough to rank programs: BENCHMARKS.md has it beside the
//! instructions that callgrind counts, with the correlation.

use super::fuse::constants;
use super::step::{Program, Step, Value};
use crate::count::Count;
use crate::id::Id;
use std::fmt;

/// Operation counts. What is computed from numbers alone is not counted: compilers fold it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cost {
    /// Additions and subtractions; also negations, absolute values, signs, minima and maxima.
    pub additions: usize,
    /// Multiplications.
    pub multiplications: usize,
    /// Multiplications together with an addition.
    pub multiply_adds: usize,
    /// Divisions and reciprocals.
    pub divisions: usize,
    /// Square roots.
    pub square_roots: usize,
    /// Angles whose sine, cosine, or both are taken.
    pub sin_cos: usize,
    /// Other elementary functions.
    pub functions: usize,
}

/// Cycles from operands to result in double precision, rounded from the tables for x86-64 cores
/// since Skylake and for Cortex-A76; elementary functions from measurements of common libraries.
const ADDITION: u64 = 4;
const MULTIPLICATION: u64 = 4;
const MULTIPLY_ADD: u64 = 4;
const DIVISION: u64 = 14;
const SQUARE_ROOT: u64 = 18;
const SIN_COS: u64 = 70;
const FUNCTION: u64 = 60;

/// Instructions of the runtime's sine and cosine.
const SIN_COS_INSTRUCTIONS: u64 = 40;

impl Cost {
    /// The cost of one evaluation.
    #[must_use]
    pub fn of(program: &Program) -> Self {
        let mut cost = Self::default();
        for (step, folded) in program.steps.iter().zip(constants(program)) {
            if !folded {
                cost.count(step);
            }
        }
        cost
    }

    fn count(&mut self, step: &Step) {
        use crate::algebra::{Function, Function2};
        match step {
            Step::Constant(_)
            | Step::Pi
            | Step::Load(_)
            | Step::SinOf(_)
            | Step::CosOf(_)
            | Step::Component(..) => {}
            Step::Add(..)
            | Step::Sub(..)
            | Step::Neg(_)
            | Step::Apply(Function::Abs | Function::Sign, _)
            | Step::Apply2(Function2::Min | Function2::Max, ..) => self.additions += 1,
            Step::Mul(..) => self.multiplications += 1,
            Step::MulAdd { .. } => self.multiply_adds += 1,
            Step::Div(..) | Step::Recip(_) => self.divisions += 1,
            Step::Sqrt(_) => self.square_roots += 1,
            Step::SinCos(_) | Step::Apply(Function::Sin | Function::Cos, _) => self.sin_cos += 1,
            Step::Cbrt(_)
            | Step::PowReal(..)
            | Step::Apply(..)
            | Step::Apply2(Function2::Atan2, ..)
            | Step::Call { .. } => {
                self.functions += 1;
            }
            Step::Solve { right, .. } => {
                // elimination, then substitution forth and back
                let n = Count::from(right.len());
                let pairs = n * (n - 1) / 2;
                let updates = n * (n * n - 1) / 3 + pairs;
                self.multiply_adds = (Count::from(self.multiply_adds) + updates).to_usize();
                self.multiplications = (Count::from(self.multiplications) + pairs).to_usize();
                self.divisions += right.len();
            }
        }
    }

    /// All operations.
    #[must_use]
    pub fn operations(&self) -> usize {
        self.weighed([1; 7]).to_usize()
    }

    /// Roughly how many machine instructions one evaluation is, with the runtime's sine and cosine in line and
    /// other functions called.
    #[must_use]
    pub fn instructions(&self) -> usize {
        self.weighed([1, 1, 1, 1, 1, 1 + SIN_COS_INSTRUCTIONS, 1]).to_usize()
    }

    /// The latencies of all operations together, in cycles: what schedules are compared by.
    #[must_use]
    pub fn weighted(&self) -> usize {
        self.weighed([ADDITION, MULTIPLICATION, MULTIPLY_ADD, DIVISION, SQUARE_ROOT, SIN_COS, FUNCTION])
            .to_usize()
    }

    /// The sum of all counts with weights, in the order of the fields.
    fn weighed(&self, weights: [u64; 7]) -> Count {
        let counts = [
            self.additions,
            self.multiplications,
            self.multiply_adds,
            self.divisions,
            self.square_roots,
            self.sin_cos,
            self.functions,
        ];
        counts.into_iter().zip(weights).map(|(count, weight)| Count::from(count) * weight).sum()
    }
}

/// What programs of the same value are ordered by: the cost, then the loads.
#[must_use]
pub fn order(program: &Program) -> (usize, usize) {
    (Cost::of(program).weighted(), loads(program))
}

/// How many variables, parameters and numbers are loaded by an instruction of their own: those that are read
/// several times, and those that are not the one operand that an operation reads from memory.
fn loads(program: &Program) -> usize {
    let mut reads = vec![0_usize; program.steps.len()];
    program.steps.iter().for_each(|step| step.each_operand(|operand| reads[operand.index()] += 1));
    program.outputs.iter().for_each(|output| reads[output.index()] += 1);
    let is_leaf = |value: Value| program.steps[value].is_leaf();
    let several = program.steps.ids().filter(|value| is_leaf(*value) && reads[value.index()] > 1).count();
    let in_place = |value: Value| usize::from(is_leaf(value) && reads[value.index()] == 1);
    let apart = program.steps.iter().map(|step| match *step {
        Step::Sub(a, _) | Step::Div(a, _) => in_place(a),
        // the number one
        Step::Recip(_) => 1,
        _ => {
            let mut operands = 0;
            step.each_operand(|operand| operands += in_place(operand));
            operands.saturating_sub(1)
        }
    });
    several + apart.sum::<usize>()
}

impl fmt::Display for Cost {
    /// `12 additions, 20 multiplications, 1 division, 1 sin_cos`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let kinds = [
            (self.additions, "addition", "additions"),
            (self.multiplications, "multiplication", "multiplications"),
            (self.multiply_adds, "multiply-add", "multiply-adds"),
            (self.divisions, "division", "divisions"),
            (self.square_roots, "square root", "square roots"),
            (self.sin_cos, "sin_cos", "sin_cos"),
            (self.functions, "function", "functions"),
        ];
        let mut separator = "";
        for (count, one, many) in kinds.into_iter().filter(|(count, ..)| *count > 0) {
            write!(f, "{separator}{count} {}", if count == 1 { one } else { many })?;
            separator = ", ";
        }
        if separator.is_empty() { f.write_str("no operations") } else { Ok(()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::id::SymbolId;

    /// Between equal costs loads decide: an operation reads one operand from memory, and what is read twice is
    /// loaded once.
    #[test]
    fn loads_are_counted() {
        let [a, b, c] = [0, 1, 2].map(Value::from_index);
        let of = |steps: &[Step]| {
            let variables = (0..3).map(|index| Step::Load(SymbolId::from_index(index)));
            let steps = variables.chain(steps.iter().cloned()).collect();
            loads(&Program { steps, ..Program::default() })
        };
        // a b c: one of the first two, the third from memory
        let product = Value::from_index(3);
        assert_eq!(of(&[Step::Mul(a, b), Step::Mul(product, c)]), 1);
        // a/b, where b alone may be in memory; 1/b
        assert_eq!(of(&[Step::Div(a, b)]), 1);
        assert_eq!(of(&[Step::Recip(b)]), 1);
        // a in both
        assert_eq!(of(&[Step::Add(a, b), Step::Add(a, c)]), 1);
        assert_eq!(of(&[Step::Add(a, b), Step::Add(a, b)]), 2);
    }
}
