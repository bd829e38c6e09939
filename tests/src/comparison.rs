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
use crate::values::Values;

/// A difference that is this small relative to the expected number passes.
const RELATIVE: f64 = 1e-12;
/// How often the error that rounding of the inputs explains is allowed: the evaluation itself
/// rounds too, in each of its operations.
const MULTIPLE: f64 = 8.0;
/// What rounding may explain at most, relative to the largest number of the same kind.
const VOID: f64 = 1e-5;

/// The three things that are compared at a state.
const KINDS: [&str; 3] = ["derivative", "energy", "velocity"];

/// The worst of many comparisons.
#[derive(Clone, Copy, Debug, Default)]
pub struct Worst {
    /// The largest difference relative to the expected number's kind.
    pub relative: f64,
    /// The largest difference relative to what rounding of the inputs explains.
    pub explained: f64,
}

impl Worst {
    fn include(&mut self, other: Self) {
        self.relative = self.relative.max(other.relative);
        self.explained = self.explained.max(other.explained);
    }
}

/// Compares an entry with the reference at every sample of every parameter set.
///
/// # Errors
/// The differences that rounding does not explain, one line each.
pub fn compare(entry: &dyn Entry) -> Result<Worst, String> {
    let mut worst = Worst::default();
    let mut failures = Vec::new();
    for set in &entry.reference().parameter_sets {
        if !entry.covers(&set.values) {
            continue;
        }
        let along = set.trajectories.iter().flatten();
        for sample in set.samples.iter().chain(along) {
            match compare_at(entry, &set.values, sample) {
                Ok(here) => worst.include(here),
                Err(lines) => failures
                    .extend(lines.into_iter().map(|line| format!("{}, {}: {line}", entry.name(), set.name))),
            }
        }
    }
    if failures.is_empty() { Ok(worst) } else { Err(failures.join("\n")) }
}

fn compare_at(entry: &dyn Entry, values: &Values, sample: &Sample) -> Result<Worst, Vec<String>> {
    let difference = differences(entry, values, sample);
    let explained = explained_by_rounding(entry, values, sample, &difference);
    let mut worst = Worst::default();
    let mut failures = Vec::new();
    for (kind, what) in KINDS.iter().enumerate() {
        let largest = difference[kind].iter().fold(0.0, |m: f64, d| m.max(d.expected.abs()));
        for (i, d) in difference[kind].iter().enumerate() {
            let error = (d.generated - d.expected).abs();
            let bound = explained[kind][i];
            let void = bound > VOID * largest.max(f64::MIN_POSITIVE) && bound > f64::EPSILON;
            // written so that a NaN fails
            let passes = error <= RELATIVE * d.expected.abs() || error <= MULTIPLE * bound;
            if !passes || void {
                failures.push(format!(
                    "{what} [{i}] at t = {}: generated {:e}, expected {:e}, rounding explains {bound:e}",
                    sample.t, d.generated, d.expected,
                ));
            }
            if error > 0.0 {
                worst.include(Worst {
                    relative: error / largest.max(f64::MIN_POSITIVE),
                    explained: if error <= RELATIVE * d.expected.abs() { 0.0 } else { error / bound },
                });
            }
        }
    }
    if failures.is_empty() { Ok(worst) } else { Err(failures) }
}

#[derive(Clone, Copy, Debug)]
struct Pair {
    generated: f64,
    expected: f64,
}

fn pairs(generated: Vec<f64>, expected: impl Iterator<Item = f64>) -> Vec<Pair> {
    generated.into_iter().zip(expected).map(|(generated, expected)| Pair { generated, expected }).collect()
}

fn differences(entry: &dyn Entry, values: &Values, sample: &Sample) -> [Vec<Pair>; 3] {
    let moving = entry.state(&sample.state);
    let state: Vec<f64> = moving.iter().map(|x| x.value).collect();
    let derivative = entry.derivative(values, sample.t, &state);
    let energy = entry.energy(values, sample.t, &state);
    let velocity = entry.generated_velocities(values, sample.t, &state);
    [
        pairs(derivative, moving.iter().map(|x| x.rate)),
        pairs(vec![energy], std::iter::once(sample.energy)),
        pairs(velocity, entry.velocities(&sample.state).iter().map(|x| x.value)),
    ]
}

/// Half the sum of the changes that moving each input by one unit in its last place makes.
fn explained_by_rounding(
    entry: &dyn Entry,
    values: &Values,
    sample: &Sample,
    at: &[Vec<Pair>; 3],
) -> [Vec<f64>; 3] {
    let mut sum = at.each_ref().map(|kind| vec![0.0; kind.len()]);
    for position in 0..values.len() {
        let moved = [f64::next_up, f64::next_down].map(|step| {
            let mut values = values.clone();
            let value = values.at_mut(position);
            *value = step(*value);
            differences(entry, &values, sample)
        });
        add_larger_change(&mut sum, at, &moved);
    }
    for position in 0..sample.state.len() {
        let moved = [f64::next_up, f64::next_down].map(|step| {
            let mut sample = sample.clone();
            let moving = sample.state.at_mut(position);
            moving.value = step(moving.value);
            differences(entry, values, &sample)
        });
        add_larger_change(&mut sum, at, &moved);
        let moved = [f64::next_up, f64::next_down].map(|step| {
            let mut sample = sample.clone();
            let moving = sample.state.at_mut(position);
            moving.rate = step(moving.rate);
            differences(entry, values, &sample)
        });
        add_larger_change(&mut sum, at, &moved);
    }
    sum.map(|kind| kind.into_iter().map(|sum| sum / 2.0).collect())
}

fn add_larger_change(sum: &mut [Vec<f64>; 3], at: &[Vec<Pair>; 3], moved: &[[Vec<Pair>; 3]; 2]) {
    for (kind, sums) in sum.iter_mut().enumerate() {
        for (i, total) in sums.iter_mut().enumerate() {
            let here = at[kind][i];
            let change = |there: &[Vec<Pair>; 3]| {
                let there = there[kind][i];
                ((there.generated - here.generated) - (there.expected - here.expected)).abs()
            };
            *total += change(&moved[0]).max(change(&moved[1]));
        }
    }
}
