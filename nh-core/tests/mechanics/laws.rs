//! Laws that a front end may enforce first, broken here in the model itself.

use crate::systems;
use nonholonomic_core::algebra::Function;
use nonholonomic_core::compile::compile;
use nonholonomic_core::model::{Kinematics, Model};
use nonholonomic_core::violation::Law;

fn broken(model: Model) -> Vec<Law> {
    compile(model).unwrap_err().iter().map(|violation| violation.law).collect()
}

#[test]
fn what_is_differentiated_is_smooth() {
    let mut b = systems::Builder { model: systems::sleigh() };
    let x = b.sum(&[(1, 1, "x")]);
    let fold = b.model.graph.apply(Function::Abs, x);
    b.model.lagrangian.value = b.model.graph.formula(b.model.lagrangian.value + fold);
    assert_eq!(broken(b.model), [Law::Smooth]);
}

#[test]
fn what_is_declared_has_a_real_value() {
    let mut b = systems::Builder { model: systems::sleigh() };
    let beyond = b.model.graph.number(2);
    let angle = b.model.graph.apply(Function::Asin, beyond);
    b.model.lagrangian.value = b.model.graph.formula(b.model.lagrangian.value + angle);
    assert_eq!(broken(b.model), [Law::Defined]);
}

/// Checks mathematics (1).
#[test]
fn every_coordinate_has_its_line_in_the_anchor() {
    let mut model = systems::sleigh();
    let Kinematics::Anchor(lines) = &mut model.kinematics else { panic!("an anchor") };
    lines.pop();
    assert_eq!(broken(model), [Law::Anchor]);
}

#[test]
fn contradictions_are_no_redundancies() {
    let mut b = systems::Builder { model: systems::sleigh() };
    b.constraint(&[(2, 1, "v2"), (1, 1, "m")]);
    let violations = compile(b.model).unwrap_err();
    assert_eq!(violations[0].law, Law::Independence);
    assert!(
        violations[0].what.contains("agrees with") && violations[0].what.ends_with("where m = 0"),
        "{violations:?}"
    );
}
