//! Starts of the benchmark bicycle: its constraints have values of the size of the wheels where all coordinates are near
//! to zero.

use nonholonomic::prelude::*;

nh_models::bicycle! {
    #[derive(Clone, Copy, Debug)]
    struct Bicycle<T>;
    forces { steer: torque; }
    inputs { torque }
    linearization { keep: lean, steer, der(lean), der(steer); }
}

fn straight(speed: f64) -> BicycleState<f64> {
    BicycleState { rear_dot: -speed / 0.3, ..BicycleState::default() }
}

#[test]
fn a_ride_starts_where_a_trim_ends() {
    use BicycleVariable::{rear_dot, torque};
    let system = nh_models::published_bicycle!(Bicycle, 9.81, |number: f64| number);
    for speed in [2.0, 3.0, 3.5, 4.6, 5.0, 5.9, 8.0] {
        for lean in [0.01, -0.003, 1e-4, 1e-9, 1e-15, 1e-18, 1e-25, 1e-300] {
            let guess = BicycleState { lean, ..straight(speed) };
            let found = system.trim(0.0, &guess, &BicycleInput::default(), &[rear_dot, torque]);
            let (mut start, _) = found.unwrap_or_else(|error| panic!("{speed} m/s from {lean}: {error}"));
            assert!(start.lean.abs() < 1e-14 && start.steer.abs() < 1e-14, "{start:?}");
            start.lean_dot = 0.3;
            system
                .project(0.0, &mut start)
                .unwrap_or_else(|error| panic!("{speed} {lean} {start:?}: {error}"));
            let mut pushed = BicycleState { lean, steer: -lean, lean_dot: 0.3, ..straight(speed) };
            system.project(0.0, &mut pushed).unwrap_or_else(|error| panic!("{speed} m/s at {lean}: {error}"));
            for start in [start, pushed] {
                let mut sim = Integrator::new(system, Dopri5::new(), 0.0, start);
                sim.set_input(BicycleInput { torque: 0.01 });
                sim.advance_to(0.1).unwrap_or_else(|error| panic!("{speed} m/s at {start:?}: {error}"));
            }
        }
    }
}
