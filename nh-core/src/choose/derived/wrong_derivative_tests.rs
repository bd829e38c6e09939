//! Wrong derivatives of a small motion are refused.

use super::*;
use crate::algebra::{Facts, Rational};
use crate::geometry::{Algebroid, Anchor, Clock, StructureFunctions};
use crate::mechanics::{Definition, LagrangianSystem, divergence, jacobian};

/// ẋ = (y + 3) sin x + d, (2 + x²) d + e = y, d + y² e = self.f(x), ẏ = e cos(x y).
struct Moving {
    graph: Graph,
    derivative: Procedure,
    state: [SymbolId; 2],
    time: SymbolId,
}

fn moving() -> Moving {
    let mut g = Graph::new();
    let [x, y, time, d, e, call] = ["x", "y", "t", "d", "e", "f(x)"].map(|name| g.new_symbol(name));
    let state = [x, y];
    let [x, y, d_value, e_value, f] = [x, y, d, e, call].map(|symbol| g.symbol(symbol));
    let (one, three) = (g.one(), g.number(Rational::from(3)));
    let (xx, yy) = (g.square(x), g.square(y));
    let corner = g.formula(one + one + xx);
    let definitions = vec![
        Definition::Call {
            symbol: call,
            method: "f".into(),
            arguments: vec![x],
            derivatives: Some(vec!["f_by_x".into()]),
        },
        Definition::Solve {
            unknowns: vec![d, e],
            matrix: vec![vec![corner, one], vec![one, yy]],
            right: vec![y, f],
        },
    ];
    let (sin, product, sum) = (g.sin(x), g.formula(x * y), g.formula(y + three));
    let cos = g.cos(product);
    let outputs = vec![g.formula(sum * sin + d_value), g.formula(e_value * cos)];
    let mut derivative = Procedure::of(outputs);
    derivative.definitions = definitions;
    Moving { graph: g, derivative, state, time }
}

/// Nothing is declared but the motion.
fn is_proved(graph: &mut Graph, motion: Motion, claim: &Derived) -> bool {
    let anchor = Anchor { entries: Vec::new(), coordinates: Vec::new(), rank: 0 };
    let algebroid = Algebroid { anchor, structure: StructureFunctions::commuting(0), velocities: Vec::new() };
    let system = LagrangianSystem {
        algebroid,
        lagrangian: graph.zero(),
        forces: Vec::new(),
        forces_on_distribution: Vec::new(),
        clock: Clock::of_time(motion.time),
    };
    let reference = Reference::projected(graph, &system, Vec::new(), Vec::new());
    let facts = Facts::default();
    let allowed = Allowed { parameters: &[], may_vanish: &[], facts: &facts, conditions: &[] };
    match prove_derived(graph, (&reference, motion), claim, &[], &allowed) {
        Ok((proof, _)) => proof.bits >= 80.0,
        Err(Defect::Wrong(_)) => false,
        Err(other) => panic!("{other}"),
    }
}

#[test]
fn derivatives_with_a_slip_are_refused() {
    let Moving { mut graph, derivative, state, time } = moving();
    let motion = Motion { derivative: &derivative, state: &state, time };
    let right = jacobian(&mut graph, &derivative, &state).expect("f has a derivative");
    assert!(is_proved(&mut graph, motion, &Derived::Jacobian(&derivative, &right, &state)));
    for entry in 0..4 {
        for spoil in [Rational::MINUS_ONE, Rational::new(1_000_000_001, 1_000_000_000)] {
            let mut wrong = right.clone();
            wrong.outputs[entry] = graph.scale(spoil, wrong.outputs[entry]);
            assert!(
                !is_proved(&mut graph, motion, &Derived::Jacobian(&derivative, &wrong, &state)),
                "{entry}"
            );
        }
    }
    let mut swapped = right.clone();
    swapped.outputs.swap(1, 2);
    assert!(!is_proved(&mut graph, motion, &Derived::Jacobian(&derivative, &swapped, &state)));
}

#[test]
fn rates_and_divergences_with_a_slip_are_refused() {
    let Moving { mut graph, derivative, state, time } = moving();
    let motion = Motion { derivative: &derivative, state: &state, time };
    let right = divergence(&mut graph, &derivative, &state).expect("f has a derivative");
    assert!(is_proved(&mut graph, motion, &Derived::Divergence(&right, &[])));
    let x = graph.symbol(state[0]);
    let wrong = right.with_outputs(vec![graph.formula(right.outputs[0] + x)]);
    assert!(!is_proved(&mut graph, motion, &Derived::Divergence(&wrong, &[])));
    // d/dt (t x²) = x² + 2 t x ẋ
    let (xx, t) = (graph.square(x), graph.symbol(time));
    let (value, tx) = (graph.formula(t * xx), graph.formula(t * x));
    let moved = graph.formula(tx * derivative.outputs[0]);
    let one_less = graph.scale(Rational::from(2), moved);
    let rate = graph.formula(one_less + xx);
    let function = Procedure::of(vec![value]);
    let with = |rate| derivative.with_outputs(vec![rate]);
    assert!(is_proved(&mut graph, motion, &Derived::Rates(&function, &with(rate))));
    assert!(!is_proved(&mut graph, motion, &Derived::Rates(&function, &with(one_less))));
}
