//! The equations with multipliers along free directions, mathematics (10″): chosen for closed loops, where they say what
//! (10) says; every step that is changed is noticed, and so is a divisor that may be 0.

use nonholonomic_core::algebra::{Graph, Rational};
use nonholonomic_core::choose::Fate;
use nonholonomic_core::compile::{compile, compile_with};
use nonholonomic_core::forms::{Judge, Registry, Solution};
use nonholonomic_core::id::ExprId;
use nonholonomic_core::mechanics::{Definition, Procedure, SaddleEquations};
use nonholonomic_core::program::{Cost, schedule};
use nonholonomic_core::system::System;

use super::{derivative_of, fates, model};

/// Two velocities and one constraint, three and two, four and two.
const LOOPS: [(&str, &str); 3] = [
    (
        "base { x, y } formulation { projected } lagrangian { m/2*(der(x)^2 + der(y)^2) - m*g*y }
         holonomic { rope: x^2 + y^2 = l^2; } assume { m > 0; l > 0; }",
        "struct S { m: f64, g: f64, l: f64 }",
    ),
    (
        "base { a, b, c } formulation { projected } let e(q) = [cos(q), sin(q)];
         lagrangian { kinetic(m[0], J[0], l[0]/2*e(a), a) + kinetic(m[1], J[1], l[0]*e(a) + l[1]/2*e(b), b)
             + kinetic(m[2], J[2], l[2]/2*e(c), c) }
         holonomic { closed: l[0]*e(a) + l[1]*e(b) = [l[3], 0] + l[2]*e(c); }
         assume { m[0] > 0; J[0] > 0; m[1] > 0; J[1] > 0; m[2] > 0; J[2] > 0; l[0] > 0; l[1] > 0; l[2] > 0; l[3] > 0; }",
        "struct S { m: [f64; 3], J: [f64; 3], l: [f64; 4] }",
    ),
    (
        "base { a, b, c, d } formulation { projected } let e(q) = [cos(q), sin(q)];
         lagrangian { kinetic(m[0], J[0], l[0]/2*e(a), a) + kinetic(m[1], J[1], l[0]*e(a) + l[1]/2*e(b), b)
             + kinetic(m[2], J[2], l[2]/2*e(c), c) + kinetic(m[3], J[3], l[2]*e(c) + l[3]/2*e(d), d) }
         holonomic { closed: l[0]*e(a) + l[1]*e(b) = [l[4], 0] + l[2]*e(c) + l[3]*e(d); }
         assume { m[0] > 0; J[0] > 0; m[1] > 0; J[1] > 0; m[2] > 0; J[2] > 0; m[3] > 0; J[3] > 0; l[0] > 0; l[1] > 0; l[2] > 0; l[3] > 0; l[4] > 0; }",
        "struct S { m: [f64; 4], J: [f64; 4], l: [f64; 5] }",
    ),
];

const NAME: &str = "along free directions";

fn solution() -> &'static dyn Solution {
    let registry = Registry::standard();
    registry.solutions().iter().copied().find(|solution| solution.name() == NAME).expect("in the registry")
}

fn alone(solution: &'static dyn Solution) -> Registry {
    Registry::of(Vec::new()).solving(vec![solution])
}

fn fate(system: &System, name: &str) -> Option<Fate> {
    fates(system).into_iter().find(|(form, _)| *form == name).map(|(_, fate)| fate)
}

#[test]
fn loops_are_solved_along_them() {
    let mut chosen = 0;
    for (declared, item) in LOOPS {
        let with = compile(model(declared, item)).expect("regular");
        let without = Registry::standard().solving(Vec::new());
        let without = compile_with(model(declared, item), &without).expect("regular");
        let fate = fate(&with, NAME).expect("it exists");
        assert!(!matches!(fate, Fate::NotAdmitted(_)), "{declared}: {}", with.ledger);
        chosen += usize::from(matches!(fate, Fate::Chosen(_)));
        for (one, other) in derivative_of(&with).into_iter().zip(derivative_of(&without)) {
            assert!((one - other).abs() <= 1e-9 * one.abs().max(1.0), "{declared}: {one}, {other}");
        }
    }
    assert!(chosen >= 2, "{chosen} of 3");
}

/// Links without weight turn together without a change, so that their angles are counted from one of them.
#[test]
fn loops_take_a_sine_and_a_cosine_less_than_they_have_angles() {
    for (declared, item) in &LOOPS[1..] {
        let system = compile(model(declared, item)).expect("regular");
        let program = schedule(&system.model.graph, &system.derivative);
        assert_eq!(Cost::of(&program).sin_cos, system.state_coordinates.len() - 1, "{}", system.ledger);
    }
}

/// The solution with one of its steps changed.
struct Planted {
    step: usize,
    slip: fn(&mut Graph, &mut Definition),
}

impl Solution for Planted {
    fn name(&self) -> &'static str {
        "planted"
    }
    fn condition(&self) -> &'static str {
        "in tests"
    }
    fn formulas(&self) -> &'static str {
        "none"
    }
    fn solve(
        &self,
        graph: &mut Graph,
        equations: &SaddleEquations,
        judge: Judge,
        procedure: &mut Procedure,
    ) -> Option<Vec<ExprId>> {
        let before = procedure.definitions.len();
        let found = solution().solve(graph, equations, judge, procedure)?;
        (self.slip)(graph, procedure.definitions.get_mut(before + self.step)?);
        Some(found)
    }
}

fn value(definition: &mut Definition) -> &mut ExprId {
    match definition {
        Definition::Value { value, .. } => value,
        _ => panic!("values alone are defined"),
    }
}

#[test]
fn every_step_that_is_changed_is_noticed() {
    let slips: [fn(&mut Graph, &mut Definition); 3] = [
        |graph, definition| {
            let value = value(definition);
            *value = graph.formula(-*value);
        },
        |graph, definition| {
            let value = value(definition);
            *value = graph.scale(Rational::ONE + Rational::new(1, 1_000_000_000), *value);
        },
        // ((l − l′) v + l)/(l − l′) − l/(l − l′): the loop is regular where lengths are equal
        |graph, definition| {
            let value = value(definition);
            let lengths = ["l[0]", "l[1]"].map(|name| {
                let found = graph.symbols().iter_ids().find(|(_, known)| *known == name).map(|(id, _)| id);
                graph.symbol(found.expect("a declared length"))
            });
            let [l, other] = lengths;
            let difference = graph.formula(l - other);
            let whole = graph.formula(*value * difference + l);
            *value = graph.formula(whole / difference - l / difference);
        },
    ];
    for (declared, item) in &LOOPS[1..] {
        for (kind, slip) in slips.into_iter().enumerate() {
            let (mut steps, mut refused) = (0, 0);
            for step in (0..).step_by(3) {
                let planted: &'static Planted = Box::leak(Box::new(Planted { step, slip }));
                let system = compile_with(model(declared, item), &alone(planted)).expect("regular");
                let Some(fate) = fate(&system, "planted") else { break };
                assert!(!matches!(fate, Fate::Chosen(_)), "slip {kind}, step {step}: {}", system.ledger);
                steps += 1;
                refused += usize::from(matches!(fate, Fate::NotAdmitted(_)));
            }
            assert!(steps > 4 && refused > 1, "slip {kind}: {refused} of {steps} steps were looked at");
        }
    }
}
