//! Elimination from the tips of chains, mathematics (39): on random trees of bodies it is admitted, and it says what the
//! other forms say; every step of it that is changed is noticed.

use nonholonomic_core::algebra::{Graph, Rational};
use nonholonomic_core::choose::Fate;
use nonholonomic_core::compile::{compile, compile_with};
use nonholonomic_core::forms::{Form, Registry, Setting};
use nonholonomic_core::mechanics::{Definition, OtherAxes, Procedure, ReducedEquations};

use super::proved::{Dice, planar_tree};
use super::{derivative_of, fates, model};

const BODIES: &str = "struct S { m: [f64; 6], J: [f64; 6], l: [f64; 5], c: [f64; 4] }";

const NAME: &str = "from the tips";

fn form() -> &'static dyn Form {
    let registry = Registry::standard();
    registry.forms().iter().copied().find(|form| form.name() == NAME).expect("a form of the registry")
}

#[test]
fn trees_of_bodies_are_solved_from_the_tips() {
    let mut competed = 0;
    for seed in 0..12 {
        let mut dice = Dice::of(seed);
        let wheels = usize::from(seed % 3 == 0);
        let declared = planar_tree(&mut dice, 4 + usize::try_from(seed % 2).expect("small"), wheels);
        let all = compile(model(&declared, BODIES)).expect("regular");
        let alone = compile_with(model(&declared, BODIES), &Registry::of(vec![form()])).expect("regular");
        let fates = fates(&alone);
        let refused = fates.iter().any(|(_, fate)| matches!(fate, Fate::NotAdmitted(_)));
        assert!(!refused, "{declared}\n{}", alone.ledger);
        competed += usize::from(fates.iter().any(|(name, _)| *name == NAME));
        for (one, other) in derivative_of(&all).into_iter().zip(derivative_of(&alone)) {
            assert!((one - other).abs() <= 1e-9 * one.abs().max(1.0), "{declared}: {one}, {other}");
        }
    }
    assert!(competed >= 9, "{competed} of 12");
}

/// The form with one of its steps changed.
struct Planted {
    step: usize,
    slip: fn(&mut Graph, &mut Definition),
}

impl Form for Planted {
    fn name(&self) -> &'static str {
        "planted"
    }
    fn condition(&self) -> &'static str {
        "in tests"
    }
    fn formulas(&self) -> &'static str {
        "none"
    }
    fn rank(&self) -> u8 {
        u8::MAX
    }
    fn derive(&self, _: &mut Graph, _: &Setting) -> Option<ReducedEquations> {
        None
    }
    fn solve(&self, graph: &mut Graph, setting: &Setting) -> Option<(Procedure, Vec<OtherAxes>)> {
        let (mut procedure, axes) = form().solve(graph, setting)?;
        (self.slip)(graph, procedure.definitions.get_mut(self.step)?);
        Some((procedure, axes))
    }
}

fn value(definition: &mut Definition) -> &mut nonholonomic_core::id::ExprId {
    match definition {
        Definition::Value { value, .. } => value,
        _ => panic!("values alone are defined"),
    }
}

#[test]
fn every_step_that_is_changed_is_noticed() {
    let declared = "base { q[4] } lagrangian {
            let th[i in 0..4] = sum(j in 0..i + 1: q[j]);
            let px[i in 0..4] = sum(j in 0..i: l[j]*cos(th[j])) + c[i]*cos(th[i]);
            let py[i in 0..4] = sum(j in 0..i: l[j]*sin(th[j])) + c[i]*sin(th[i]);
            sum(i in 0..4: kinetic(m[i], J[i], [px[i], py[i]], th[i]) - m[i]*l[4]*py[i])
        } inputs { u } forces { q[1]: u; }";
    let slips: [fn(&mut Graph, &mut Definition); 2] = [
        |graph, definition| {
            let value = value(definition);
            *value = graph.formula(-*value);
        },
        |graph, definition| {
            let value = value(definition);
            *value = graph.scale(Rational::ONE + Rational::new(1, 1_000_000_000), *value);
        },
    ];
    for slip in slips {
        let mut steps = 0;
        for step in (0..).step_by(4) {
            let planted: &'static Planted = Box::leak(Box::new(Planted { step, slip }));
            let system =
                compile_with(model(declared, BODIES), &Registry::of(vec![planted])).expect("regular");
            let Some((_, fate)) = fates(&system).into_iter().find(|(name, _)| *name == "planted") else {
                break;
            };
            assert!(matches!(fate, Fate::NotAdmitted(_)), "step {step}: {}", system.ledger);
            steps += 1;
        }
        assert!(steps > 10, "{steps} steps");
    }
}
