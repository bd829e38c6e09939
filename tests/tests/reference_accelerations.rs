//! Every declared system computes the accelerations, energies and velocities of the reference data.

use nh_tests::comparison::compare_with_reference;
use nh_tests::systems::catalogue;

/// Checks mathematics (6), (8) and (9).
#[test]
fn every_system_agrees_with_the_reference_at_every_state() {
    let mut failures = Vec::new();
    for entry in catalogue() {
        match compare_with_reference(&*entry) {
            Ok(worst) => println!(
                "{:28} relative {:.1e}, in units of what rounding explains {:.2}",
                entry.name(),
                worst.relative,
                worst.explained,
            ),
            Err(lines) => failures.push(lines),
        }
    }
    assert!(failures.is_empty(), "\n{}", failures.join("\n"));
}

#[test]
fn states_list_base_coordinates_then_velocities() {
    for entry in catalogue() {
        let reference = entry.reference();
        let sample = &reference.parameter_sets[0].samples[0];
        assert_eq!(entry.components().len(), entry.state(&sample.state).len(), "{}", entry.name());
    }
}
