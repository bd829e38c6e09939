//! The adapted and the projected formulation of one declaration agree to round-off.

use nh_tests::catalogue::Entry;
use nh_tests::comparison::{Pair, Worst, compare, compare_with_reference, values_of};
use nh_tests::reference::Sample;
use nh_tests::twins::{Twins, systems_in_both_formulations};
use nh_tests::values::Values;

#[test]
fn the_projected_formulation_agrees_with_the_reference_in_all_velocities() {
    let mut failures = Vec::new();
    for twins in systems_in_both_formulations() {
        match compare_with_reference(&*twins.projected) {
            Ok(worst) => {
                println!("{:32} {:.1e} {:.2}", twins.projected.name(), worst.relative, worst.explained);
            }
            Err(lines) => failures.push(lines),
        }
    }
    assert!(failures.is_empty(), "\n{}", failures.join("\n"));
}

/// Checks mathematics (7), (8), (9) and (10).
#[test]
fn both_formulations_have_the_same_derivative_and_multipliers() {
    let mut failures = Vec::new();
    for twins in systems_in_both_formulations() {
        let mut worst = Worst::default();
        for set in &twins.adapted.reference().parameter_sets {
            if !twins.adapted.covers(&set.values) {
                continue;
            }
            for sample in &set.samples {
                match agree(&twins, &set.values, sample) {
                    Ok(here) => worst.include(here),
                    Err(lines) => failures.extend(lines),
                }
            }
        }
        println!("{:32} {:.1e} {:.2}", twins.adapted.name(), worst.relative, worst.explained);
    }
    assert!(failures.is_empty(), "\n{}", failures.join("\n"));
}

/// Compares what both compute at a state of the adapted formulation: the rates of the coordinates and
/// of the velocities that are kept, the energy, and the multipliers.
fn agree(twins: &Twins, values: &Values, sample: &Sample) -> Result<Worst, Vec<String>> {
    let (adapted, projected): (&dyn Entry, &dyn Entry) = (&*twins.adapted, &*twins.projected);
    let t = sample.t;
    let state = values_of(&adapted.state(&sample.state));
    let inputs: Vec<f64> = values.iter().chain(&state).copied().collect();
    let (kept, all) = (adapted.components(), projected.components());
    let pairs = |inputs: &[f64]| {
        let (parameters, state) = inputs.split_at(values.len());
        let values = values.renewed(parameters.iter().copied());
        let velocities = adapted.generated_velocities(&values, t, state);
        let whole = [&state[..all.len() - velocities.len()], &velocities].concat();
        let expected = adapted.derivative(&values, t, state);
        let generated = projected.derivative(&values, t, &whole);
        let mut pairs: Vec<Pair> = kept
            .iter()
            .zip(expected)
            .map(|(name, expected)| {
                let place =
                    all.iter().position(|other| other == name).expect("the twin keeps all velocities");
                Pair { generated: generated[place], expected }
            })
            .collect();
        pairs.push(Pair {
            generated: projected.energy(&values, t, &whole),
            expected: adapted.energy(&values, t, state),
        });
        let multipliers = |entry: &dyn Entry, state: &[f64]| {
            entry.generated_multipliers(&values, t, state).unwrap_or_default()
        };
        let (expected, generated) = (multipliers(adapted, state), multipliers(projected, &whole));
        assert_eq!(expected.len(), generated.len());
        pairs.extend(expected.iter().zip(generated).map(|(expected, generated)| {
            assert_eq!(expected.0, generated.0);
            Pair { generated: generated.1, expected: expected.1 }
        }));
        pairs
    };
    compare(&format!("{} (t = {t})", adapted.name()), &inputs, pairs)
}
