//! The law over blocks of controllers and estimators with a unit for each component: what is found is the same to the
//! digits of each component. Not bit for bit, since pivots are chosen among components.

use nalgebra::{Matrix3, Matrix3x2, SMatrix, SVector, matrix, vector};
use nonholonomic::control::{ControlError, Estimate, Regulator, Unscented, held_noise, zero_order_hold};

/// Units of three components of a state and of two inputs or measurements.
#[derive(Clone, Copy, Debug)]
struct Units {
    state: [f64; 3],
    other: [f64; 2],
}

const UNITS: [Units; 7] = [
    Units { state: [1.0; 3], other: [1.0; 2] },
    Units { state: [1e6, 1.0, 1e-6], other: [1.0, 1.0] },
    Units { state: [1e-9, 1e9, 1.0], other: [1e-5, 1e5] },
    Units { state: [1e30, 1e-30, 1.0], other: [1e20, 1e-20] },
    Units { state: [1e-60, 1.0, 1e60], other: [1.0, 1e60] },
    Units { state: [1.0, 1e-12, 1e-12], other: [1e-40, 1.0] },
    Units { state: [1e80, 1.0, 1e-40], other: [1e80, 1.0] },
];

impl Units {
    /// A matrix whose rows have these units, and whose columns have their inverses or the same ones.
    fn matrix<const R: usize, const C: usize>(
        a: &SMatrix<f64, R, C>,
        rows: &[f64],
        columns: impl Fn(usize) -> f64,
    ) -> SMatrix<f64, R, C> {
        SMatrix::from_fn(|i, j| a[(i, j)] * rows[i] * columns(j))
    }
    fn map(&self, a: &Matrix3<f64>) -> Matrix3<f64> {
        SMatrix::from_fn(|i, j| a[(i, j)] * (self.state[i] / self.state[j]))
    }
    fn covariance(&self, a: &Matrix3<f64>) -> Matrix3<f64> {
        Self::matrix(a, &self.state, |j| self.state[j])
    }
    fn weight(&self, a: &Matrix3<f64>) -> Matrix3<f64> {
        SMatrix::from_fn(|i, j| a[(i, j)] / self.state[i] / self.state[j])
    }
    fn reach(&self, b: &Matrix3x2<f64>) -> Matrix3x2<f64> {
        SMatrix::from_fn(|i, j| b[(i, j)] * (self.state[i] / self.other[j]))
    }
}

/// What is found, made free of units, or the name of the error.
type Found = Result<Vec<f64>, String>;

fn word(error: &ControlError) -> String {
    format!("{error:?}").chars().take_while(|c| c.is_alphabetic()).collect()
}

/// Judges that all units find the same.
fn judge(name: &str, bound: f64, find: impl Fn(&Units) -> Found) {
    let expected = find(&UNITS[0]);
    for units in &UNITS[1..] {
        match (&expected, find(units)) {
            (Ok(expected), Ok(found)) => {
                for (place, (a, b)) in expected.iter().zip(&found).enumerate() {
                    let off = (a - b).abs();
                    assert!(off <= bound * a.abs().max(1e-3), "{name} {units:?}: {place}: {a} {b}");
                }
            }
            // which of the errors is a matter of pivots
            (Err(_), Err(_)) => {}
            (a, b) => panic!("{name} {units:?}: {a:?} {b:?}"),
        }
    }
}

const A: Matrix3<f64> = matrix![0.0, 1.0, 0.1; -2.0, -0.3, 0.7; 0.4, 0.0, -0.1];
const B: Matrix3x2<f64> = matrix![0.0, 0.1; 1.0, 0.0; 0.3, -0.7];
/// A place that a speed carries along, which a motor drives: nothing acts back.
const CHAIN: Matrix3<f64> = matrix![0.0, 1.0, 0.3; 0.0, -0.7, 1.7; 0.0, 0.0, -0.3];
const Q: Matrix3<f64> = matrix![2.0, 0.1, 0.0; 0.1, 0.7, 0.2; 0.0, 0.2, 0.3];

#[test]
fn held_motions_and_noises() {
    for (a, dt) in [A, CHAIN].into_iter().flat_map(|a| [0.01, 0.3, 20.0].map(|dt| (a, dt))) {
        judge("zero_order_hold", 1e-12, |u| {
            let (step, held) = zero_order_hold(&u.map(&a), &u.reach(&B), dt).map_err(|e| word(&e))?;
            let free = |i: usize, j: usize| step[(i, j)] / (u.state[i] / u.state[j]);
            let mut all: Vec<f64> = (0..9).map(|k| free(k / 3, k % 3)).collect();
            all.extend((0..6).map(|k| held[(k / 2, k % 2)] / (u.state[k / 2] / u.other[k % 2])));
            Ok(all)
        });
        judge("held_noise", 1e-11, |u| {
            let noise = held_noise(&u.map(&a), &u.covariance(&Q), dt).map_err(|e| word(&e))?;
            Ok((0..9).map(|k| noise[(k / 3, k % 3)] / u.state[k / 3] / u.state[k % 3]).collect())
        });
    }
}

#[test]
fn regulators() {
    let step = Matrix3::identity() + A * 0.1;
    // two loops that have nothing in common, one of them slow
    let apart = matrix![0.5, 0.0, 0.0; 0.0, 0.999, 0.01; 0.0, 0.0, 0.9999];
    let weak = matrix![1.0, 0.0; 0.0, 0.0; 0.0, 1e-3];
    let growing = matrix![1.1, 0.0, 0.0; 0.0, 1.2, 0.0; 0.0, 0.0, 0.9];
    let aside = matrix![0.0, 0.1; 0.0, 0.0; 0.0, -0.7];
    for (a, b) in [(step, B), (apart, weak), (growing, aside)] {
        judge("Regulator", 1e-8, |u| {
            let r = matrix![0.3, 0.05; 0.05, 0.6];
            let r = SMatrix::from_fn(|i, j| r[(i, j)] / u.other[i] / u.other[j]);
            let regulator =
                Regulator::stationary(&u.map(&a), &u.reach(&b), &u.weight(&Q), &r).map_err(|e| word(&e))?;
            let free = |k: usize| regulator.gain[(k / 3, k % 3)] / (u.other[k / 3] / u.state[k % 3]);
            let cost = |k: usize| regulator.cost[(k / 3, k % 3)] * u.state[k / 3] * u.state[k % 3];
            Ok((0..6).map(free).chain((0..9).map(cost)).collect())
        });
    }
}

#[test]
fn filters() {
    let full = matrix![1.3, 0.2, -0.1; 0.2, 0.8, 0.3; -0.1, 0.3, 0.9];
    let indefinite = matrix![1.0, 0.0, 0.0; 0.0, 1.0, 0.3; 0.0, 0.3, 0.05];
    let certain = matrix![1.0, 0.0, 0.2; 0.0, 0.0, 0.0; 0.2, 0.0, 0.05];
    let step = Matrix3::identity() + A * 0.05;
    let sight = matrix![1.0, 0.0, 0.3; 0.0, 0.6, -0.2];
    let spread = matrix![0.02, 0.003; 0.003, 0.05];
    for rows in [full, indefinite, certain] {
        let run = |u: &Units, is_unscented: bool| -> Found {
            let mean = vector![0.3, -1.2, 0.7].component_mul(&SVector::from(u.state));
            let mut estimate = Estimate { mean, covariance: u.covariance(&rows) };
            let sight = SMatrix::from_fn(|i, j| sight[(i, j)] * (u.other[i] / u.state[j]));
            let spread = SMatrix::from_fn(|i, j| spread[(i, j)] * u.other[i] * u.other[j]);
            let (map, noise) = (u.map(&step), u.covariance(&(Q * 1e-3)));
            let seen = vector![0.2 * u.other[0], -0.4 * u.other[1]];
            let mut all = vec![];
            for _ in 0..3 {
                let filter = Unscented::default();
                estimate = if is_unscented {
                    filter.predicted(&estimate, |x| map * x, &noise)
                } else {
                    estimate.predicted(map * estimate.mean, &map, &noise)
                }
                .map_err(|e| word(&e))?;
                let correction = if is_unscented {
                    filter.corrected(&estimate, &seen, |x| sight * x, |a, b| a - b, &spread)
                } else {
                    estimate.corrected(&(seen - sight * estimate.mean), &sight, &spread)
                }
                .map_err(|e| word(&e))?;
                estimate = correction.estimate;
                all.push(correction.surprise);
                all.extend((0..3).map(|k| estimate.mean[k] / u.state[k]));
                all.extend(
                    (0..9).map(|k| estimate.covariance[(k / 3, k % 3)] / u.state[k / 3] / u.state[k % 3]),
                );
            }
            Ok(all)
        };
        judge("Estimate", 1e-10, |u| run(u, false));
        judge("Unscented", 1e-10, |u| run(u, true));
    }
}
