//! Wrong programs, each one step away from the right one, are refused.

use crate::systems;
use nonholonomic_core::algebra::Rational;
use nonholonomic_core::choose::{Unproved, prove_program, prove_split};
use nonholonomic_core::compile::compile;
use nonholonomic_core::id::Id;
use nonholonomic_core::model::Model;
use nonholonomic_core::program::{Program, Step, Value, corrected, schedule_grouping, split};
use nonholonomic_core::system::System;

/// What a slip in lowering could make of a step.
fn spoiled(step: &Step) -> Vec<Step> {
    match step.clone() {
        Step::Constant(number) => vec![Step::Constant(number + Rational::new(1, 1_000_000_000))],
        Step::Add(a, b) => vec![Step::Sub(a, b), Step::Add(a, a), Step::Mul(a, b)],
        Step::Sub(a, b) => vec![Step::Sub(b, a), Step::Add(a, b), Step::Neg(b)],
        Step::Mul(a, b) => vec![Step::Mul(a, a), Step::Div(a, b), Step::Add(a, b)],
        Step::Div(a, b) => vec![Step::Div(b, a), Step::Mul(a, b), Step::Recip(b)],
        Step::MulAdd { a, b, c, minus_product, minus_c } => vec![
            Step::MulAdd { a, b, c, minus_product: !minus_product, minus_c },
            Step::MulAdd { a, b, c, minus_product, minus_c: !minus_c },
            Step::MulAdd { a: c, b, c: a, minus_product, minus_c },
            Step::Mul(a, b),
        ],
        Step::Neg(a) => vec![Step::Recip(a)],
        Step::Recip(a) => vec![Step::Neg(a)],
        Step::SinOf(pair) => vec![Step::CosOf(pair)],
        Step::CosOf(pair) => vec![Step::SinOf(pair)],
        Step::Component(solution, index) => vec![Step::Component(solution, 1 - index.min(1))],
        _ => Vec::new(),
    }
}

/// The program with one step replaced.
fn with(program: &Program, at: Value, step: Step) -> Program {
    let mut program = program.clone();
    program.steps[at] = step;
    program
}

/// Whether a replacement is the same step, or the same but for the names of its operands.
fn is_same(program: &Program, step: &Step, other: &Step) -> bool {
    let value = |value: &Value| program.steps[*value].clone();
    let of =
        |step: &Step| (std::mem::discriminant(step), step.operands().iter().map(value).collect::<Vec<_>>());
    let is_named = matches!(step, Step::Constant(_) | Step::MulAdd { .. });
    step == other || (!is_named && of(step) == of(other))
}

/// How many wrong programs of the derivative were tried, all of which are refused.
fn refused(model: Model) -> usize {
    let System { model, derivative, .. } = compile(model).expect("the declaration is right");
    let parameters: Vec<_> = model.parameters.iter().map(|parameter| parameter.symbol).collect();
    let program = schedule_grouping(&model.graph, &derivative, &parameters);
    let proof = prove_program(&model.graph, &derivative, &program).expect("the right one is proved");
    assert!(proof.bits >= 80.0, "{proof:?}");
    prove_program(&model.graph, &derivative, &corrected(&program)).expect("so it is with corrections");
    let parts = split(&program, &parameters, model.graph.symbols().len());
    prove_split(&model.graph, &derivative, &parts).expect("and in two parts");
    let mut tried = 0;
    for (value, step) in program.steps.iter_ids() {
        for wrong in spoiled(step) {
            if is_same(&program, step, &wrong) {
                continue;
            }
            let wrong = with(&program, value, wrong);
            let verdict = prove_program(&model.graph, &derivative, &wrong);
            assert_eq!(verdict, Err(Unproved::Wrong), "step {} of {program:?}", value.index());
            tried += 1;
        }
    }
    tried
}

#[test]
fn a_sign_a_missing_term_or_a_swapped_operand() {
    let tried = [systems::sleigh(), systems::robot(), systems::sleigh_on_the_plane()].map(refused);
    assert!(tried.iter().all(|tried| *tried > 30), "{tried:?}");
}

#[test]
fn outputs_in_another_order_and_parts_that_are_mixed_up() {
    let System { model, derivative, .. } = compile(systems::robot()).expect("the declaration is right");
    let parameters: Vec<_> = model.parameters.iter().map(|parameter| parameter.symbol).collect();
    let program = schedule_grouping(&model.graph, &derivative, &parameters);
    let mut swapped = program.clone();
    swapped.outputs.swap(0, 1);
    assert_eq!(prove_program(&model.graph, &derivative, &swapped), Err(Unproved::Wrong));
    let mut parts = split(&program, &parameters, model.graph.symbols().len());
    assert!(parts.ahead.outputs.len() > 1, "there is something to mix up");
    parts.ahead.outputs.rotate_left(1);
    assert_eq!(prove_split(&model.graph, &derivative, &parts), Err(Unproved::Wrong));
}

/// The same numbers, multiplied and divided by some value.
fn with_a_divisor(program: &Program, output: usize, divisor: Value) -> Program {
    let mut program = program.clone();
    let value = program.outputs[output];
    let product = program.steps.push(Step::Mul(value, divisor));
    program.outputs[output] = program.steps.push(Step::Div(product, divisor));
    program
}

#[test]
fn a_divisor_that_the_procedure_does_not_have() {
    let mut counts = [0, 0];
    for model in [systems::sleigh(), systems::robot(), systems::sleigh_on_the_plane()] {
        let System { model, derivative, .. } = compile(model).expect("the declaration is right");
        let parameters: Vec<_> = model.parameters.iter().map(|parameter| parameter.symbol).collect();
        let program = schedule_grouping(&model.graph, &derivative, &parameters);
        for (value, step) in program.steps.iter_ids() {
            if matches!(step, Step::SinCos(_) | Step::Constant(_) | Step::Solve { .. }) {
                continue;
            }
            let is_divisor = |other: &Step| matches!(other, Step::Div(_, b) | Step::Recip(b) if *b == value);
            let is_harmless = program.steps.iter().any(is_divisor) || matches!(step, Step::Recip(_));
            let output = value.index() % program.outputs.len();
            let verdict = prove_program(&model.graph, &derivative, &with_a_divisor(&program, output, value));
            match verdict {
                Ok(_) => counts[0] += 1,
                Err(Unproved::Unknown(reason)) => {
                    assert!(reason.contains("it divides by what was not recognised"), "{reason}");
                    assert!(!is_harmless, "{step:?} in {program:?}");
                    counts[1] += 1;
                }
                Err(Unproved::Wrong) => panic!("it computes the same: {step:?}"),
            }
        }
    }
    assert!(counts[0] < 20 && counts[1] > 100, "{counts:?}");
}
