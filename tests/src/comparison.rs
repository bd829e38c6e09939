//! How a generated number is compared with the reference.
//!
//! A reference number is exact, but a test reads it into the nearest `f64`, and near a singular
//! state that rounding alone moves the result. So every comparison measures its own conditioning:
//! each number that was read is moved by one unit in its last place, up and down, and the changes
//! of the difference between generated and expected number are added up. Half of that sum bounds
//! what rounding of the inputs explains to first order. A difference passes if it is below 1e-12 of
//! the expected number, or below eight times that bound; and the bound itself must stay small, so
//! that the comparison cannot become void.

use crate::catalogue::Entry;
use crate::reference::Sample;
use crate::values::{Moving, Reading, Values};

/// A difference that is this small relative to the expected number passes.
const RELATIVE: f64 = 1e-12;
/// How often the error that rounding of the inputs explains is allowed: the evaluation itself
/// rounds too, in each of its operations.
const MULTIPLE: f64 = 8.0;
/// What rounding may explain at most, relative to the largest of the numbers that are compared.
const VOID: f64 = 1e-5;
/// Near an equilibrium all numbers are small differences: none counts as smaller than this.
const EQUILIBRIUM: f64 = 1e-8;
/// A multiplier below this stands for zero: it is computed from numbers of some forty digits.
const VANISHING: f64 = 1e-30;

/// A generated number and what it should be.
#[derive(Clone, Copy, Debug)]
pub struct Pair {
    /// What the generated code computes.
    pub generated: f64,
    /// What it should compute.
    pub expected: f64,
}

/// The worst of many comparisons.
#[derive(Clone, Copy, Debug, Default)]
pub struct Worst {
    /// The largest difference relative to the largest expected number it was compared with.
    pub relative: f64,
    /// Among the differences above 1e-12, the largest in units of what rounding explains.
    pub explained: f64,
}

impl Worst {
    /// The worse of the two, in each respect.
    pub fn include(&mut self, other: Self) {
        self.relative = self.relative.max(other.relative);
        self.explained = self.explained.max(other.explained);
    }
}

/// The larger of what was found so far and the size of a number; infinite where that is none, so that
/// it fails.
#[must_use]
pub fn larger(so_far: f64, number: f64) -> f64 {
    if number.is_nan() { f64::INFINITY } else { so_far.max(number.abs()) }
}

/// The size of the largest number; infinite where one is none.
pub fn largest(numbers: impl IntoIterator<Item = f64>) -> f64 {
    numbers.into_iter().fold(0.0, larger)
}

/// Compares numbers that depend on inputs which have been rounded.
///
/// # Errors
/// The differences that rounding does not explain, one line each.
pub fn compare(
    what: &str,
    inputs: &[f64],
    pairs: impl Fn(&[f64]) -> Vec<Pair>,
) -> Result<Worst, Vec<String>> {
    let at = pairs(inputs);
    let explained = explained_by_rounding(inputs, &at, &pairs);
    let largest = at.iter().fold(EQUILIBRIUM, |m, pair| m.max(pair.expected.abs()));
    let mut worst = Worst::default();
    let mut failures = Vec::new();
    for (i, (pair, bound)) in at.iter().zip(explained).enumerate() {
        let error = (pair.generated - pair.expected).abs();
        let exact = error <= RELATIVE * pair.expected.abs();
        // written so that a NaN fails
        let sound = exact || (error <= MULTIPLE * bound && bound <= VOID * largest);
        if !sound {
            failures.push(format!(
                "{what} [{i}]: generated {:e}, expected {:e}, rounding explains {bound:e}",
                pair.generated, pair.expected,
            ));
        }
        let explained = if exact { 0.0 } else { error / bound };
        worst.include(Worst { relative: error / largest, explained });
    }
    if failures.is_empty() { Ok(worst) } else { Err(failures) }
}

/// Half the sum of the changes that moving each input by one unit in its last place makes.
fn explained_by_rounding(inputs: &[f64], at: &[Pair], pairs: impl Fn(&[f64]) -> Vec<Pair>) -> Vec<f64> {
    let mut sum = vec![0.0; at.len()];
    let mut moved = inputs.to_vec();
    for (position, input) in inputs.iter().enumerate() {
        let [up, down] = [input.next_up(), input.next_down()].map(|neighbour| {
            moved[position] = neighbour;
            pairs(&moved)
        });
        moved[position] = *input;
        for (i, total) in sum.iter_mut().enumerate() {
            let error = |pair: &Pair| pair.generated - pair.expected;
            let change = |pair: &Pair| (error(pair) - error(&at[i])).abs();
            *total += change(&up[i]).max(change(&down[i]));
        }
    }
    sum.into_iter().map(|sum| sum / 2.0).collect()
}

/// Compares an entry with the reference at every sample of every parameter set: the derivative, the
/// energy, all quasi-velocities and, where they are computed, the multipliers.
///
/// # Errors
/// The differences that rounding does not explain, one line each.
pub fn compare_with_reference(entry: &dyn Entry) -> Result<Worst, String> {
    let mut worst = Worst::default();
    let mut failures = Vec::new();
    for set in &entry.reference().parameter_sets {
        if !entry.covers(&set.values) {
            continue;
        }
        let along = set.trajectories.iter().flatten();
        for sample in set.samples.iter().chain(along) {
            for (kind, pairs) in KINDS {
                let what = format!("{} ({}, t = {}): {kind}", entry.name(), set.name, sample.t);
                let inputs = flattened(&set.values, &sample.state);
                let at = |inputs: &[f64]| {
                    let (values, state) = unflattened(inputs, &set.values, &sample.state);
                    pairs(entry, &values, sample, &state)
                };
                match compare(&what, &inputs, at) {
                    Ok(here) => worst.include(here),
                    Err(lines) => failures.extend(lines),
                }
            }
        }
    }
    if failures.is_empty() { Ok(worst) } else { Err(failures.join("\n")) }
}

type Pairs = fn(&dyn Entry, &Values, &Sample, &Reading) -> Vec<Pair>;

/// What is compared at a sample.
const KINDS: [(&str, Pairs); 4] = [
    ("derivative", derivatives),
    ("energy", energies),
    ("velocity", velocities),
    ("multipliers", multipliers),
];

fn derivatives(entry: &dyn Entry, values: &Values, sample: &Sample, reading: &Reading) -> Vec<Pair> {
    let moving = entry.state(reading);
    let generated = entry.derivative(values, sample.t, &values_of(&moving));
    paired(&generated, moving.iter().map(|x| x.rate))
}

fn energies(entry: &dyn Entry, values: &Values, sample: &Sample, reading: &Reading) -> Vec<Pair> {
    let generated = entry.energy(values, sample.t, &values_of(&entry.state(reading)));
    vec![Pair { generated, expected: sample.energy }]
}

fn velocities(entry: &dyn Entry, values: &Values, sample: &Sample, reading: &Reading) -> Vec<Pair> {
    let state = values_of(&entry.state(reading));
    let generated = entry.generated_velocities(values, sample.t, &state);
    paired(&generated, entry.velocities(reading).iter().map(|x| x.value))
}

fn multipliers(entry: &dyn Entry, values: &Values, sample: &Sample, reading: &Reading) -> Vec<Pair> {
    let state = values_of(&entry.state(reading));
    let generated = entry.generated_multipliers(values, sample.t, &state).unwrap_or_default();
    let pairs = generated.into_iter().map(|(label, generated)| {
        // what the data's own precision leaves of a zero
        let expected = sample.multipliers[label];
        Pair { generated, expected: if expected.abs() < VANISHING { 0.0 } else { expected } }
    });
    pairs.collect()
}

/// Each generated number with the expected one.
///
/// # Panics
/// If there are not as many.
pub fn paired(generated: &[f64], expected: impl ExactSizeIterator<Item = f64>) -> Vec<Pair> {
    assert_eq!(generated.len(), expected.len(), "as many numbers as expected");
    generated.iter().zip(expected).map(|(&generated, expected)| Pair { generated, expected }).collect()
}

/// The numbers without their rates.
#[must_use]
pub fn values_of(moving: &[Moving]) -> Vec<f64> {
    moving.iter().map(|x| x.value).collect()
}

/// Everything that was read for a state: parameters, the state, its rate.
fn flattened(values: &Values, state: &Reading) -> Vec<f64> {
    let numbers = values.iter().copied();
    numbers.chain(state.iter().flat_map(|x| [x.value, x.rate])).collect()
}

fn unflattened(inputs: &[f64], values: &Values, state: &Reading) -> (Values, Reading) {
    let (parameters, moving) = inputs.split_at(values.len());
    let state = state.renewed(moving.chunks_exact(2).map(|x| Moving { value: x[0], rate: x[1] }));
    (values.renewed(parameters.iter().copied()), state)
}
