//! Wrong forms, planted into the registry, are refused, however cheap they are.

use crate::builder::{Builder, origin};
use crate::systems;
use nonholonomic_core::algebra::{Graph, Rational};
use nonholonomic_core::choose::{Fate, Ledger};
use nonholonomic_core::compile::{compile, compile_with};
use nonholonomic_core::forms::{Form, Registry, Setting};
use nonholonomic_core::id::{ExprId, SymbolId};
use nonholonomic_core::mechanics::{Definition, ReducedEquations, equations_in_wheel_frames};
use nonholonomic_core::model::{Located, Model};
use nonholonomic_core::program::{interpret, schedule};
use nonholonomic_core::system::System;

/// The plain form with something done to it.
struct Planted {
    name: &'static str,
    spoil: fn(&mut Graph, &Setting, &mut ReducedEquations),
}

impl Form for Planted {
    fn name(&self) -> &'static str {
        self.name
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
    fn derive(&self, graph: &mut Graph, setting: &Setting) -> Option<ReducedEquations> {
        let mut equations = Registry::plain().derive(graph, setting)?;
        (self.spoil)(graph, setting, &mut equations);
        Some(equations)
    }
}

fn symbol(graph: &mut Graph, name: &str) -> ExprId {
    let found = graph.symbols().iter_ids().find(|(_, known)| *known == name).map(|(id, _)| id);
    graph.symbol(found.expect("a declared name"))
}

/// The declared expressions at which forms could differ, at a point.
fn values(system: &System) -> Vec<f64> {
    let program = schedule(&system.model.graph, &system.derivative);
    let at = |symbol: SymbolId| {
        let index = nonholonomic_core::id::Id::index(symbol);
        0.3 + 0.17 * f64::from(u32::try_from(index % 11).expect("small"))
    };
    interpret(&program, at)
}

/// Why a planted form was not admitted, at each decision, and that what is emitted is right all the same.
fn refused(model: &Model, planted: &'static Planted) -> Vec<String> {
    let right = compile(model.clone()).expect("the declaration is right");
    let registry = Registry::of(vec![planted]);
    let found = compile_with(model.clone(), &registry).expect("the plain form is emitted");
    let reasons = reasons(&found.ledger, planted.name);
    for (found, right) in values(&found).into_iter().zip(values(&right)) {
        assert!((found - right).abs() <= 1e-9 * right.abs().max(1.0), "{}: {found}, {right}", planted.name);
    }
    let text = found.ledger.to_string();
    assert!(["expanded: chosen", "plain: chosen"].iter().any(|chosen| text.contains(chosen)), "{text}");
    reasons
}

fn reasons(ledger: &Ledger, name: &str) -> Vec<String> {
    let contenders = ledger.decisions.iter().flat_map(|decision| &decision.contenders);
    let found: Vec<_> = contenders.filter(|contender| contender.form == name).collect();
    let reason = |fate: &Fate| match fate {
        Fate::NotAdmitted(reason) => Some(reason.clone()),
        _ => None,
    };
    let reasons: Vec<String> = found.iter().filter_map(|contender| reason(&contender.fate)).collect();
    let emitted = ledger.at("derivative").and_then(|decision| decision.chosen());
    assert!(emitted.is_some_and(|chosen| chosen.form != name), "{name} was admitted: {ledger}");
    reasons
}

#[test]
fn a_flipped_sign() {
    static PLANTED: Planted = Planted {
        name: "a flipped sign",
        spoil: |graph, _, equations| equations.force[0] = graph.formula(-equations.force[0]),
    };
    let reason = "the equation along a section is not that of the declaration";
    assert_eq!(refused(&systems::sleigh(), &PLANTED), [reason]);
    assert_eq!(refused(&systems::car(), &PLANTED), [reason]);
}

#[test]
fn a_term_of_relative_order_1e_9() {
    static PLANTED: Planted = Planted {
        name: "a missing term",
        spoil: |graph, _, equations| {
            let less = Rational::ONE - Rational::new(1, 1_000_000_000);
            equations.force[0] = graph.scale(less, equations.force[0]);
        },
    };
    assert_eq!(refused(&systems::sleigh(), &PLANTED).len(), 1);
    assert_eq!(refused(&systems::robot(), &PLANTED).len(), 1);
}

#[test]
fn a_wrong_mass_matrix_and_wrong_rates() {
    static MASS: Planted = Planted {
        name: "a wrong mass",
        spoil: |graph, _, equations| {
            equations.mass[0][0] = graph.scale(Rational::new(3, 2), equations.mass[0][0]);
        },
    };
    static RATES: Planted =
        Planted { name: "wrong rates", spoil: |_, _, equations| equations.rates.swap(1, 2) };
    assert_eq!(refused(&systems::sleigh(), &MASS).len(), 1);
    assert_eq!(
        refused(&systems::sleigh(), &RATES),
        ["the rates of the coordinates are not those of the anchor"]
    );
}

/// The sleigh, with everything multiplied and divided by J, which is the moment of inertia about the
/// centre of mass: that of a point mass is zero.
#[test]
fn a_divisor_that_is_a_parameter_that_may_be_zero() {
    static PLANTED: Planted = Planted {
        name: "by a parameter",
        spoil: |graph, _, equations| {
            let (j, theta) = (symbol(graph, "J"), symbol(graph, "theta"));
            let shift = graph.formula(j * theta);
            for force in &mut equations.force {
                // (J f + J θ)/J − θ
                let product = graph.formula(j * *force);
                let sum = graph.formula(product + shift);
                let name = equations.definitions.define(graph, "product", sum);
                *force = graph.formula(name / j - theta);
            }
        },
    };
    let reasons = refused(&systems::sleigh(), &PLANTED);
    assert_eq!(reasons, ["it divides by J, which may vanish where the declared equations are regular"]);
    // a point mass is what the declaration allows
    let system = compile(systems::sleigh()).expect("the declaration is right");
    assert!(system.parameter_checks.iter().all(|check| check.text != "J"), "{:?}", system.parameter_checks);
}

/// A divisor that vanishes nowhere but where the equations are singular is no condition.
#[test]
fn a_divisor_of_the_declaration_is_none() {
    static PLANTED: Planted = Planted {
        name: "by the mass",
        spoil: |graph, _, equations| {
            let (m, theta) = (symbol(graph, "m"), symbol(graph, "theta"));
            let shift = graph.formula(m * theta);
            for force in &mut equations.force {
                let product = graph.formula(m * *force);
                let sum = graph.formula(product + shift);
                let name = equations.definitions.define(graph, "product", sum);
                *force = graph.formula(name / m - theta);
            }
        },
    };
    // without mass the equation along v1 is 0 = 0
    let system = compile_with(systems::sleigh(), &Registry::of(vec![&PLANTED])).expect("it is right");
    let decision = system.ledger.at("derivative").expect("there is a derivative");
    assert_eq!(decision.chosen().map(|chosen| chosen.form), Some("by the mass"), "{}", system.ledger);
}

/// |γ|².
fn norm(graph: &mut Graph) -> ExprId {
    let squares = ["g1", "g2", "g3"].map(|name| {
        let component = symbol(graph, name);
        graph.square(component)
    });
    graph.sum(&squares)
}

/// On |γ| = 1 a factor |γ|² changes nothing, and it is said that the form is proved there alone; what is wrong there by
/// 1e-9 is refused.
#[test]
fn a_form_that_is_equal_on_an_embedded_base_only() {
    static EQUAL: Planted = Planted {
        name: "on the sphere",
        spoil: |graph, _, equations| {
            let norm = norm(graph);
            for force in &mut equations.force {
                *force = graph.formula(norm * *force);
            }
        },
    };
    static WRONG: Planted = Planted {
        name: "near the sphere",
        spoil: |graph, _, equations| {
            let (norm, height) = (norm(graph), symbol(graph, "g3"));
            let little = graph.number(Rational::new(1, 1_000_000_000));
            for force in &mut equations.force {
                *force = graph.formula((norm + little * height) * *force);
            }
        },
    };
    let mut b = Builder::new(&["I1", "I2", "I3", "c"], &["g1", "g2", "g3"], &["w1", "w2", "w3"]);
    b.anchor(&[
        &[(1, 1, "g2*w3"), (-1, 1, "g3*w2")],
        &[(1, 1, "g3*w1"), (-1, 1, "g1*w3")],
        &[(1, 1, "g1*w2"), (-1, 1, "g2*w1")],
    ]);
    b.bracket(0, 1, &[(1, 1, "w3")]);
    b.bracket(1, 2, &[(1, 1, "w1")]);
    b.bracket(2, 0, &[(1, 1, "w2")]);
    b.lagrangian(&[(1, 2, "I1*w1*w1"), (1, 2, "I2*w2*w2"), (1, 2, "I3*w3*w3"), (-1, 1, "c*g3")]);
    let mut norm = b.sum(&[(1, 1, "g1*g1"), (1, 1, "g2*g2"), (1, 1, "g3*g3")]);
    let one = b.model.graph.one();
    norm = b.model.graph.formula(norm - one);
    b.model.identities.push(Located { value: norm, origin: origin() });
    assert_eq!(refused(&b.model, &WRONG).len(), 1);
    let system = compile_with(b.model, &Registry::of(vec![&EQUAL])).expect("it is right");
    let decision = system.ledger.at("derivative").expect("there is a derivative");
    let chosen = decision.chosen().expect("it is proved");
    assert!(matches!(chosen.fate, Fate::Chosen(proof) if proof.is_on_base), "{}", system.ledger);
    assert!(system.ledger.to_string().contains("points of the base"), "{}", system.ledger);
}

/// Why a form was not admitted beside all others, though it is the cheapest, and that what is emitted is right.
fn refused_beside_others(model: &Model, planted: &'static dyn Form) -> Vec<String> {
    let right = compile(model.clone()).expect("the declaration is right");
    let forms = Registry::standard().forms().iter().copied().chain([planted]).collect();
    let found = compile_with(model.clone(), &Registry::of(forms)).expect("other forms are right");
    assert_eq!(values(&found), values(&right));
    reasons(&found.ledger, planted.name())
}

#[test]
fn the_cheapest_form_of_all() {
    static PLANTED: Planted = Planted {
        name: "no forces",
        spoil: |graph, _, equations| equations.force.iter_mut().for_each(|force| *force = graph.zero()),
    };
    for model in [systems::sleigh(), systems::robot(), systems::trailers(true, false)] {
        let reason = "the accelerations do not satisfy the declared equations";
        assert_eq!(refused_beside_others(&model, &PLANTED), [reason]);
    }
}

/// The form by wheels, with one of the velocities lost that move the points together: what once was emitted.
struct Apart;

impl Form for Apart {
    fn name(&self) -> &'static str {
        "points that do not move together"
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
    fn derive(&self, graph: &mut Graph, setting: &Setting) -> Option<ReducedEquations> {
        let Setting { system, distribution, residuals, .. } = setting;
        let mut equations = equations_in_wheel_frames(graph, system, distribution, (*residuals)?)?;
        let lost = *distribution.independent.last()?;
        for definition in &mut equations.definitions.definitions {
            if let Definition::Value { value, .. } = definition
                && graph.depends_on(*value, &[lost])
            {
                *value = graph.at_zero(*value, &[lost]);
            }
        }
        // nor are they coupled
        for (a, row) in equations.mass.iter_mut().enumerate() {
            for (_, entry) in row.iter_mut().enumerate().filter(|(b, _)| *b != a) {
                *entry = graph.zero();
            }
        }
        for force in &mut equations.force {
            *force = graph.at_zero(*force, &[lost]);
        }
        Some(equations)
    }
}

#[test]
fn points_that_do_not_move_together() {
    for relative in [true, false] {
        let reasons = refused_beside_others(&systems::trailers(relative, false), &Apart);
        assert_eq!(reasons.len(), 1, "{reasons:?}");
    }
}
