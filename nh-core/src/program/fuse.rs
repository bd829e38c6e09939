//! Products in sums become multiply-adds.
//!
//! A fused multiply-add takes one instruction and one rounding where the target has it; elsewhere
//! the emitted code takes the product and the sum, which is what stood there before.

use super::step::{Program, Step, Value};
use crate::algebra::Function;
use crate::id::{Id, SymbolId};

/// Fuses every sum with a product that nothing else uses.
///
/// Operands of functions that are not defined for all numbers stay as they are: the fused `x·x − y·y`
/// may lie below zero by a rounding where x = y.
pub(super) fn fuse(mut program: Program) -> Program {
    let uses = program.uses();
    let guarded = guarded(&program);
    let constant = constants(&program);
    for index in 0..program.steps.len() {
        let value = Value::from_index(index);
        if guarded[index] || constant[index] {
            continue;
        }
        let product = |operand: Value| match program.steps[operand] {
            Step::Mul(a, b) if uses[operand] == 1 && !constant[operand.index()] => Some((a, b)),
            _ => None,
        };
        let fused = match program.steps[value] {
            Step::Add(x, y) => match (product(x), product(y)) {
                (_, Some((a, b))) => Step::MulAdd { a, b, c: x, minus_product: false, minus_c: false },
                (Some((a, b)), None) => Step::MulAdd { a, b, c: y, minus_product: false, minus_c: false },
                (None, None) => continue,
            },
            Step::Sub(x, y) => match (product(x), product(y)) {
                (_, Some((a, b))) => Step::MulAdd { a, b, c: x, minus_product: true, minus_c: false },
                (Some((a, b)), None) => Step::MulAdd { a, b, c: y, minus_product: false, minus_c: true },
                (None, None) => continue,
            },
            Step::Neg(x) if uses[x] == 1 => match program.steps[x] {
                Step::MulAdd { a, b, c, minus_product, minus_c } => {
                    Step::MulAdd { a, b, c, minus_product: !minus_product, minus_c: !minus_c }
                }
                _ => continue,
            },
            _ => continue,
        };
        program.steps[value] = fused;
    }
    program
}

/// A reciprocal that only one product uses becomes a division, unless it is one of parameters that
/// multiplies what varies: where a derivative is evaluated again and again, that is computed once.
pub(super) fn quotients(mut program: Program, is_parameter: impl Fn(SymbolId) -> bool) -> Program {
    let uses = program.uses();
    let fixed = program.fixed(is_parameter);
    for index in 0..program.steps.len() {
        let value = Value::from_index(index);
        let Step::Mul(a, b) = program.steps[value] else { continue };
        let divisor = |factor: Value| match program.steps[factor] {
            Step::Recip(divisor) if uses[factor] == 1 && (fixed[index] || !fixed[divisor.index()]) => {
                Some(divisor)
            }
            _ => None,
        };
        if let Some(divisor) = divisor(a) {
            program.steps[value] = Step::Div(b, divisor);
        } else if let Some(divisor) = divisor(b) {
            program.steps[value] = Step::Div(a, divisor);
        }
    }
    program
}

/// Which values are operands of functions that are not defined for all numbers.
fn guarded(program: &Program) -> Vec<bool> {
    let mut guarded = vec![false; program.steps.len()];
    for step in &program.steps {
        if let Step::Sqrt(a)
        | Step::PowReal(a, _)
        | Step::Apply(Function::Asin | Function::Acos | Function::Ln, a) = step
        {
            guarded[a.index()] = true;
        }
    }
    guarded
}

/// Which values are made of numbers alone: compilers fold them.
pub(super) fn constants(program: &Program) -> Vec<bool> {
    program.fixed(|_| false)
}
