//! How an integrated trajectory is compared with the reference.
//!
//! What the method and the arithmetic may add up to is measured on the trajectory itself:
//!
//! - the method: the run is repeated with a tolerance 1000 times larger. Dormand and Prince's pair
//!   controls an error of order h⁵ per step, so that the accumulated error falls at least as the
//!   power 4/5 of the tolerance: the finer run is allowed 1000^(−4/5) = 1/251 of the difference;
//! - the arithmetic and the rounding of the inputs: the run is repeated from a start, and with
//!   parameters, that are moved by a relative 1e-9 with alternating signs. That gives the growth of
//!   errors; each step rounds, and roundings of `n` steps add up like √n.
//!
//! The sum is allowed `MULTIPLE` times. Errors are measured in each component relative to its
//! largest value so far, and the largest component counts.

use nonholonomic::IntegrationError;

use crate::catalogue::{Entry, Run};
use crate::comparison::larger;
use crate::reference::{ParameterSet, Sample};
use crate::values::Values;

/// How often the measured error is allowed: neither the alternating signs nor the coarser run need
/// to show the worst case.
const MULTIPLE: f64 = 16.0;
/// The tolerance of the run that is compared.
const FINE: f64 = 1e-12;
/// The tolerance of the run that measures the method's error.
const COARSE: f64 = 1e-9;
/// How far the perturbed run starts away.
const PERTURBATION: f64 = 1e-9;
/// Where the measurements explain more than this, double precision can no longer follow the
/// trajectory, and it is not compared any further.
const VOID: f64 = 1e-3;

/// An error along a trajectory, and what was allowed there.
#[derive(Clone, Copy, Debug)]
pub struct Deviation {
    /// The time.
    pub t: f64,
    /// The error.
    pub error: f64,
    /// What the tolerance and the growth of errors explain, `MULTIPLE` times.
    pub allowed: f64,
}

/// Integrates a trajectory and compares it with the reference at each output time, as long as double
/// precision can follow.
///
/// # Errors
/// If the integrator gives up.
pub fn deviations(
    entry: &dyn Entry,
    set: &ParameterSet,
    trajectory: &[Sample],
) -> Result<Vec<Deviation>, IntegrationError> {
    let times: Vec<f64> = trajectory.iter().map(|sample| sample.t).collect();
    let expected: Vec<Vec<f64>> = trajectory
        .iter()
        .map(|sample| entry.state(&sample.state).iter().map(|x| x.value).collect())
        .collect();
    let start = &expected[0];
    let run = |values: &Values, start: &[f64], tolerance: f64| {
        entry.integrate(values, &Run { start, times: &times, tolerance })
    };
    let fine = run(&set.values, start, FINE)?;
    let coarse = run(&set.values, start, COARSE)?;
    let perturbed = run(&set.values.renewed(moved(set.values.iter())), &moved(start), FINE)?;

    #[expect(clippy::cast_precision_loss, reason = "a count of steps, below 2^53")]
    let roundings = (fine.steps as f64).sqrt().max(1.0);
    let method = (FINE / COARSE).powf(0.8);
    let arithmetic = f64::EPSILON / PERTURBATION * roundings;

    let mut scale = vec![0.0_f64; start.len()];
    let (mut difference, mut growth) = (0.0_f64, PERTURBATION);
    let mut deviations = Vec::new();
    for (k, expected) in expected.iter().enumerate() {
        for (scale, x) in scale.iter_mut().zip(expected) {
            *scale = scale.max(x.abs());
        }
        let distance = |a: &[f64], b: &[f64]| relative_distance(a, b, &scale, entry.angles());
        difference = difference.max(distance(&fine.states[k], &coarse.states[k]));
        growth = growth.max(distance(&fine.states[k], &perturbed.states[k]));
        let allowed = MULTIPLE * (method * difference + arithmetic * growth);
        if allowed > VOID {
            break;
        }
        deviations.push(Deviation { t: times[k], error: distance(&fine.states[k], expected), allowed });
    }
    Ok(deviations)
}

impl Deviation {
    /// Whether the error is explained.
    #[must_use]
    pub fn passes(&self) -> bool {
        self.error <= self.allowed
    }
}

/// The largest difference of a component, relative to the scale of that component; components that
/// stay tiny are measured against a millionth of the largest.
fn relative_distance(a: &[f64], b: &[f64], scale: &[f64], angles: &[usize]) -> f64 {
    let floor = 1e-6 * scale.iter().fold(f64::MIN_POSITIVE, |m, s| m.max(*s));
    a.iter().zip(b).zip(scale).enumerate().fold(0.0, |largest, (i, ((a, b), scale))| {
        let mut difference = a - b;
        if angles.contains(&i) {
            let turn = std::f64::consts::TAU;
            difference -= turn * (difference / turn).round();
        }
        larger(largest, difference / scale.max(floor))
    })
}

/// The numbers moved by a relative [`PERTURBATION`] with alternating signs.
fn moved<'a>(numbers: impl IntoIterator<Item = &'a f64>) -> Vec<f64> {
    let factors = [1.0 + PERTURBATION, 1.0 - PERTURBATION].into_iter().cycle();
    numbers.into_iter().zip(factors).map(|(x, factor)| x * factor).collect()
}
