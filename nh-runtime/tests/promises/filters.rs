//! What a filter returns is a covariance, and the filters accept it, for as long as they run.

use nalgebra::{Matrix2, Matrix3, SMatrix, SVector, Vector2, Vector3, matrix, vector};
use nonholonomic::control::{ControlError, Entry, Estimate, Unscented, held_noise};
use nonholonomic::prelude::*;

/// A reproducible number in (−1, 1).
struct Random(u32);

impl Random {
    fn number<T: Real>(&mut self) -> T {
        self.0 = self.0.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        T::from_f64(f64::from(self.0) / f64::from(u32::MAX) * 2.0 - 1.0)
    }

    fn matrix<T: Entry, const R: usize, const C: usize>(&mut self) -> SMatrix<T, R, C> {
        SMatrix::from_fn(|_, _| self.number())
    }
}

/// No direction has a negative variance, but for the rounding of the entries.
fn judge<T: Entry, const N: usize>(case: &str, covariance: &SMatrix<T, N, N>)
where
    nalgebra::Const<N>: nalgebra::DimSub<nalgebra::U1>,
    nalgebra::DefaultAllocator: nalgebra::allocator::Allocator<<nalgebra::Const<N> as nalgebra::DimSub<nalgebra::U1>>::Output>
        + nalgebra::allocator::Allocator<
            nalgebra::Const<N>,
            <nalgebra::Const<N> as nalgebra::DimSub<nalgebra::U1>>::Output,
        >,
{
    let wide = covariance.map(Scalar::to_f64);
    assert!((wide - wide.transpose()).norm() == 0.0, "{case}: {wide}");
    let values = wide.symmetric_eigenvalues();
    let count = f64::from(u32::try_from(N).unwrap());
    let round_off = 8.0 * count * T::EPSILON.to_f64() * values.max();
    assert!(values.min() >= -round_off, "{case}: {values}");
    assert!(wide.diagonal().min() >= 0.0, "{case}: {wide}");
}

/// What both filters are asked to do.
struct Task<T> {
    step: Matrix3<T>,
    noise: Matrix3<T>,
    observation: SMatrix<T, 2, 3>,
    sensor: Matrix2<T>,
}

fn run<T: Entry>(seed: u32, prior: f64, process: f64, sensor: f64) {
    let c = T::from_f64;
    let mut random = Random(seed);
    let half: Matrix3<T> = random.matrix();
    let rough: SMatrix<T, 3, 1> = random.matrix();
    let skew: Matrix2<T> = random.matrix();
    let task = Task {
        step: Matrix3::identity() + random.matrix::<T, 3, 3>() * c(0.3),
        // of rank 1
        noise: rough * rough.transpose() * c(process),
        observation: random.matrix(),
        sensor: (skew * skew.transpose() + Matrix2::identity()) * c(sensor),
    };
    let start = Estimate { mean: Vector3::zeros(), covariance: half * half.transpose() * c(prior) };
    let case =
        |filter: &str, tick: u32| format!("{filter}, seed {seed}, {prior:e} {process:e} {sensor:e}, {tick}");
    let mut extended = start;
    for tick in 0..25 {
        let next = extended.predicted(task.step * extended.mean, &task.step, &task.noise);
        extended = next.unwrap_or_else(|error| panic!("{}: {error}", case("extended", tick)));
        judge(&case("extended, predicted", tick), &extended.covariance);
        let seen = extended.corrected(&random.matrix(), &task.observation, &task.sensor);
        extended = seen.unwrap_or_else(|error| panic!("{}: {error}", case("extended", tick))).estimate;
        judge(&case("extended, corrected", tick), &extended.covariance);
    }
    for (spread, kurtosis, shift) in [(1.0, 2.0, 0.0), (0.1, 2.0, 0.0), (1.0, 0.0, 0.0), (0.5, 2.0, 1.0)] {
        let filter = Unscented { spread: c(spread), kurtosis: c(kurtosis), shift: c(shift) };
        let name = format!("unscented {spread} {kurtosis} {shift}");
        let mut belief = start;
        for tick in 0..25 {
            let bent = |x: Vector3<T>| {
                let y = task.step * x;
                vector![y[0] + c(0.1) * Scalar::sin(y[1]), y[1], y[2] * Scalar::cos(c(0.1) * y[0])]
            };
            let next = filter.predicted(&belief, bent, &task.noise);
            belief = next.unwrap_or_else(|error| panic!("{}: {error}", case(&name, tick)));
            judge(&case(&name, tick), &belief.covariance);
            let seen = filter.corrected(
                &belief,
                &random.matrix(),
                |x| task.observation * x,
                |a, b| a - b,
                &task.sensor,
            );
            belief = seen.unwrap_or_else(|error| panic!("{}: {error}", case(&name, tick))).estimate;
            judge(&case(&name, tick), &belief.covariance);
        }
    }
}

#[test]
fn filters_accept_what_they_return() {
    for seed in 1..3 {
        for prior in [1e-8, 1.0, 1e4, 1e8] {
            for process in [0.0, 1e-9, 1.0] {
                for sensor in [1e-12, 1e-6, 1.0, 1e6] {
                    run::<f64>(seed, prior, process, sensor);
                    // what is beside the sensor's noise has its digits there
                    if sensor > 1e-12 {
                        run::<f32>(seed, prior, process, sensor);
                    }
                }
            }
        }
    }
}

/// A sensor that is far more exact than the first guess, in single precision.
#[test]
fn an_exact_sensor_does_not_break_the_unscented_filter() {
    let filter = Unscented::<f32>::default();
    let mut belief = Estimate { mean: vector![0.0_f32, 0.0], covariance: Matrix2::identity() * 1e4 };
    let step = matrix![1.0, 0.01; 0.0, 1.0];
    for tick in 0..1000 {
        let noise = matrix![0.0, 0.0; 0.0, 1e-4];
        belief = filter.predicted(&belief, |x| step * x, &noise).unwrap();
        judge("predicted", &belief.covariance);
        let seen = filter.corrected(&belief, &vector![0.25], |x| vector![x[0]], |a, b| a - b, &matrix![1e-6]);
        belief = seen.unwrap_or_else(|error| panic!("{tick}: {error}")).estimate;
        judge("corrected", &belief.covariance);
        assert!(belief.covariance[(0, 0)] <= 1.01e-6 && (belief.mean[0] - 0.25).abs() < 1e-2, "{belief:?}");
    }
}

/// The moments of a map of second order, for every spread that is accepted.
fn spreads<T: Entry>() {
    let c = T::from_f64;
    let covariance = matrix![c(0.04), c(0.01); c(0.01), c(0.09)];
    let prior = Estimate { mean: vector![c(0.5), c(2.0)], covariance };
    let map = |x: Vector2<T>| vector![x[0] + x[1] * c(0.5), x[0] * x[0] + c(3.0)];
    let (mut accepted, mut refused) = (0, 0);
    for exponent in 0..40 {
        let filter = Unscented { spread: c(2.0_f64.powi(-exponent)), ..Unscented::default() };
        let found = filter.predicted(&prior, map, &Matrix2::zeros());
        let seen = filter.corrected(
            &prior,
            &vector![c(1.0)],
            |x| vector![map(x)[0]],
            |a, b| a - b,
            &matrix![c(0.1)],
        );
        match (found, seen) {
            (Ok(next), Ok(seen)) => {
                accepted += 1;
                // second differences of a square root of ε have half of the digits
                let permitted = 60.0 * T::EPSILON.to_f64().sqrt();
                let mean = next.mean.map(Scalar::to_f64) - vector![1.5, 0.25 + 0.04 + 3.0];
                let spread = [[0.04 + 0.01 + 0.0225, 0.045], [0.045, 4.0 * 0.25 * 0.04 + 2.0 * 0.0016]];
                let expected = Matrix2::from_fn(|i, j| spread[i][j]);
                let off = next.covariance.map(Scalar::to_f64) - expected;
                assert!(mean.norm() < permitted, "2^-{exponent}: {mean}");
                // at a spread of one, fourth moments of a coupled pair are those of the formula
                assert!(off.norm() < permitted + 0.01 * 4.0_f64.powi(-exponent), "2^-{exponent}: {off}");
                let linear =
                    prior.corrected(&vector![c(-0.5)], &matrix![c(1.0), c(0.5)], &matrix![c(0.1)]).unwrap();
                let off = (seen.estimate.covariance - linear.estimate.covariance).map(Scalar::to_f64);
                assert!(off.norm() < permitted, "2^-{exponent}: {off}");
            }
            (Err(error), Err(_)) => {
                refused += 1;
                assert!(matches!(error, ControlError::Setting { setting: "spread", .. }), "{error}");
            }
            other => panic!("{other:?}"),
        }
    }
    assert!(accepted > 4 && refused > 4, "{accepted} {refused}");
}

#[test]
fn a_spread_is_accepted_if_the_digits_bear_it() {
    spreads::<f64>();
    spreads::<f32>();
    let tiny = Unscented { spread: 1e-8, ..Unscented::default() };
    let prior = Estimate { mean: vector![1.0], covariance: matrix![1.0] };
    assert_eq!(
        tiny.predicted(&prior, |x| x, &matrix![0.0]).unwrap_err().to_string(),
        "`spread` is 1e-8: it has to be such that spread² (N + shift) is finite and at least the root of the \
         rounding unit, 1.5e-8 in f64 and 3.5e-4 in f32"
    );
}

/// With a negative weight in the middle a sum may be no covariance: then it is not returned.
#[test]
fn an_indefinite_result_is_an_error() {
    let filter = Unscented { spread: 1.0, kurtosis: 0.0, shift: -2.5 };
    let prior = Estimate { mean: Vector3::zeros(), covariance: Matrix3::identity() };
    let round = |x: Vector3<f64>| vector![x.norm_squared(), 0.0, 0.0];
    let refused = filter.predicted(&prior, round, &Matrix3::zeros());
    assert!(matches!(refused, Err(ControlError::NotDefinite { .. })), "{refused:?}");
    // of a linear map it is one
    let same = filter.predicted(&prior, |x| x, &Matrix3::zeros()).unwrap();
    assert!((same.covariance - prior.covariance).norm() < 1e-14);
}

/// The noise of a tick is a covariance to a filter, however the system is scaled.
fn noises<T: Entry>() {
    let c = T::from_f64;
    let mut random = Random(7);
    for exponent in -4..5 {
        for _ in 0..20 {
            let a: SMatrix<T, 4, 4> = random.matrix::<T, 4, 4>() * c(4.0_f64.powi(exponent));
            let push: SVector<T, 4> = random.matrix();
            let Ok(noise) = held_noise(&a, &(push * push.transpose()), c(0.1)) else { continue };
            judge("noise of a tick", &noise);
            let prior = Estimate { mean: SVector::zeros(), covariance: noise };
            prior.predicted(SVector::zeros(), &a, &noise).unwrap();
        }
    }
}

#[test]
fn the_noise_of_a_tick_is_a_covariance() {
    noises::<f64>();
    noises::<f32>();
}

/// A noise that is hardly semidefinite, or not at all, in components of any units: it is refused, or what is predicted
/// with it has no negative variance and no correlation beyond one.
#[test]
fn an_accepted_noise_makes_a_covariance() {
    let mut random = Random(3);
    let (mut accepted, mut refused) = (0, 0);
    let mut law = |noise: Matrix2<f64>| {
        let certain = Estimate { mean: Vector2::zeros(), covariance: Matrix2::zeros() };
        let extended = certain.predicted(certain.mean, &Matrix2::identity(), &noise);
        let unscented = Unscented::default().predicted(&certain, |x| x, &noise);
        for next in [extended, unscented] {
            let Ok(next) = next else {
                refused += 1;
                assert!(matches!(next, Err(ControlError::NotDefinite { matrix: "noise", .. })), "{next:?}");
                continue;
            };
            accepted += 1;
            let p = next.covariance;
            assert!(p[(0, 0)] >= 0.0 && p[(1, 1)] >= 0.0 && p[(0, 1)] == p[(1, 0)], "{noise} {p}");
            let most = p[(0, 0)].sqrt() * p[(1, 1)].sqrt();
            assert!(p[(0, 1)].abs() <= most * (1.0 + 8.0 * f64::EPSILON), "{noise} {p}");
        }
    };
    for exponent in 0..60 {
        let share = 2.0_f64.powi(-exponent);
        for unit in [1.0, 1e-10, 1e5, 1e10] {
            let half: Vector2<f64> = random.matrix();
            let half = vector![half[0], half[1] * unit];
            let square = half * half.transpose();
            let smaller = matrix![0.0, 0.0; 0.0, share * square[(1, 1)]];
            law(square - smaller);
            law(square + smaller);
            law(matrix![square[(0, 0)], 0.0; 0.0, -share * square[(1, 1)]]);
        }
    }
    assert!(accepted > 200 && refused > 200, "{accepted} {refused}");
}
