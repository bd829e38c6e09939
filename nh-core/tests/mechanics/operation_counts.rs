//! Ceilings on the work of derivatives, and what they divide by: growth is a failing test.

use crate::systems;

use nonholonomic_core::compile::compile;
use nonholonomic_core::id::SymbolId;
use nonholonomic_core::model::Model;
use nonholonomic_core::program::{Cost, schedule_grouping};
use nonholonomic_core::system::System;

fn compiled(model: Model) -> System {
    compile(model).unwrap_or_else(|violations| panic!("{violations:#?}"))
}

/// Operations of the derivative, sines and cosines among them.
fn operations(model: Model) -> (usize, usize) {
    let system = compiled(model);
    let parameters: Vec<SymbolId> = system.model.parameters.iter().map(|p| p.symbol).collect();
    let cost = Cost::of(&schedule_grouping(&system.model.graph, &system.derivative, &parameters));
    (cost.operations(), cost.sin_cos)
}

#[test]
fn derivatives_stay_below_their_ceilings() {
    let ceilings = [
        ("sleigh", systems::sleigh(), 17, 1),
        ("veselova", systems::veselova(), 42, 0),
        ("snakeboard", systems::snakeboard(false), 13, 1),
        ("ball on a rotating table", systems::ball_on_rotating_table(), 9, 0),
        ("car", systems::car(), 21, 2),
        ("trailers, absolute angles", systems::trailers(false, false), 122, 2),
        ("trailers, relative angles", systems::trailers(true, false), 119, 2),
    ];
    let mut above = Vec::new();
    for (name, model, most, angles) in ceilings {
        let (operations, sin_cos) = operations(model);
        if operations > most || sin_cos > angles {
            above.push(format!("{name}: {operations} operations, {sin_cos} of them sin_cos"));
        }
    }
    assert!(above.is_empty(), "{above:#?}");
}

#[test]
fn divisors_of_parameters_alone_are_checked() {
    let texts = |model: Model| -> Vec<String> {
        compiled(model).parameter_checks.into_iter().map(|check| check.text).collect()
    };
    // the inertia about the contact point; a mass with which everything scales is no divisor
    assert!(texts(systems::sleigh()).iter().any(|text| text.contains('J')));
    // projected: the moments of inertia
    let found = texts(systems::veselova());
    for name in ["I1", "I2", "I3"] {
        assert!(found.iter().any(|text| text == name), "{name} in {found:?}");
    }
}
