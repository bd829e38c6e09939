//! Ceilings on the work of machines of the benchmark of record: growth is a failing test.

use nh_stages::declarations;
use nonholonomic_core::program::{Cost, schedule_grouping};

/// The operations of the derivative of the declaration in a file.
fn operations(source: &str) -> usize {
    let found = declarations(source);
    let system = found.first().expect("a declaration").system().expect("regular");
    let parameters: Vec<_> = system.model.parameters.iter().map(|parameter| parameter.symbol).collect();
    Cost::of(&schedule_grouping(&system.model.graph, &system.derivative, &parameters)).operations()
}

/// A hitch behind the axle, in the axes of the tractor; a pendulum on wheels.
#[test]
fn what_moves_one_body_with_another_is_named() {
    assert!(operations(include_str!("../../bench/src/systems/hitched_trailer.rs")) <= 42);
    assert!(operations(include_str!("../../bench/src/systems/balancing_robot.rs")) <= 49);
}
