//! What is derived on request: Jacobians, and systems without what is not tracked.

use crate::systems;

use nonholonomic_core::compile::compile;
use nonholonomic_core::id::Id;
use nonholonomic_core::model::{Model, Request, TrackedItem};
use nonholonomic_core::program::{Cost, interpret, schedule};
use nonholonomic_core::system::System;

fn compiled(model: Model) -> System {
    compile(model).unwrap_or_else(|violations| panic!("{violations:#?}"))
}

#[test]
fn jacobians_agree_with_differences() {
    let models = [
        systems::sleigh(),
        systems::robot(),
        systems::veselova(),
        systems::sleigh_on_the_plane(),
        systems::snakeboard(true),
    ];
    for mut model in models {
        model.requests.push((Request::Jacobian, systems::origin()));
        let system = compiled(model);
        let graph = &system.model.graph;
        let derivative = schedule(graph, &system.derivative);
        let jacobian = interpret(&schedule(graph, &system.jacobian().unwrap()), sample);
        let coordinates = system.model.coordinates.iter().map(|c| c.symbol);
        let arguments: Vec<_> = coordinates.chain(system.state_velocities.iter().copied()).collect();
        for (column, argument) in arguments.iter().enumerate() {
            let at = |shift: f64| {
                interpret(&derivative, |s| if s == *argument { sample(s) + shift } else { sample(s) })
            };
            let step = 1e-3;
            // Richardson's extrapolation of central differences: error O(h⁴)
            let (near, far) = ([at(step), at(-step)], [at(2.0 * step), at(-2.0 * step)]);
            for row in 0..arguments.len() {
                let (close, wide) = (near[0][row] - near[1][row], far[0][row] - far[1][row]);
                let expected = (8.0 * close - wide) / (12.0 * step);
                let found = jacobian[row * arguments.len() + column];
                assert!(
                    (found - expected).abs() <= 1e-8 * (1.0 + expected.abs()),
                    "{found} is not {expected}"
                );
            }
        }
    }
}

#[test]
fn what_does_not_flow_into_the_tracked_is_left_out() {
    let tracking = |mut model: Model, names: &[&str]| {
        let symbols = model.graph.symbols();
        let named = |name: &&str| symbols.ids().find(|id| symbols[*id] == *name).unwrap();
        let tracked: Vec<_> =
            names.iter().map(|name| (TrackedItem::Variable(named(name)), systems::origin())).collect();
        model.tracked = Some(tracked);
        let system = compiled(model);
        let graph = &system.model.graph;
        let kept: Vec<String> =
            system.state().iter().map(|symbol| graph.symbols()[*symbol].clone()).collect();
        assert_eq!(system.derivative.outputs.len(), kept.len());
        (kept, schedule(graph, &system.derivative))
    };
    let (kept, program) = tracking(systems::sleigh(), &["omega", "v1"]);
    assert_eq!(kept, ["omega", "v1"]);
    assert_eq!(Cost::of(&program).sin_cos, 0);
    let (kept, _) = tracking(systems::sleigh(), &["x"]);
    assert_eq!(kept, ["theta", "x", "omega", "v1"]);
    // with multipliers all velocities stay, and what the constraints depend on
    let (kept, _) = tracking(systems::sleigh_on_the_plane(), &["theta"]);
    assert_eq!(kept, ["theta", "theta_dot", "x_dot", "y_dot"]);
}

/// A value for every symbol.
fn sample(symbol: nonholonomic_core::id::SymbolId) -> f64 {
    0.4 + f64::from(u8::try_from((symbol.index() * 7919) % 13).unwrap()) / 11.0
}
