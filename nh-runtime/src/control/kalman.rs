//! The extended Kalman filter, a step at a time.

use nalgebra::{SMatrix, SVector};

use super::cholesky::root;
use super::square_root::Measured;
use super::{ControlError, Entry, finite, squares, symmetrized};

/// What is known of a state: a mean and a covariance.
#[doc(alias("EKF", "Kalman"))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate<T, const N: usize> {
    /// The mean; a generated state is made of it with `into()`, and the other way round.
    pub mean: SVector<T, N>,
    /// The covariance, symmetric and positive semidefinite.
    pub covariance: SMatrix<T, N, N>,
}

/// An estimate after a measurement.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Correction<T, const N: usize> {
    /// What is known now.
    pub estimate: Estimate<T, N>,
    /// The squared innovation in units of its standard deviations, νᵀS⁻¹ν: of a consistent filter
    /// χ²-distributed with as many degrees of freedom as the measurement has components. A large
    /// value tells of an outlier, or of a model that no longer holds, such as a wheel that slips;
    /// infinity is a large value.
    pub surprise: T,
}

impl<T: Entry, const N: usize> Estimate<T, N> {
    /// The estimate after a step of time.
    ///
    /// `mean` is where the step takes the old mean, `transition` the derivative of the step by the
    /// state there, `noise` the covariance of what the model does not know of the step.
    ///
    /// ```
    /// use nalgebra::{Matrix2, matrix, vector};
    /// use nonholonomic::control::Estimate;
    ///
    /// let prior = Estimate { mean: vector![1.0, 0.5], covariance: Matrix2::identity() };
    /// let step = matrix![1.0, 0.1; 0.0, 1.0];
    /// let next = prior.predicted(step * prior.mean, &step, &(Matrix2::identity() * 0.01)).unwrap();
    /// assert!((next.covariance - matrix![1.02, 0.1; 0.1, 1.01]).norm() < 1e-15);
    /// ```
    ///
    /// # Errors
    /// [`ControlError::NotFinite`] for an argument or the result, [`ControlError::NotDefinite`] for a
    /// covariance that is not positive semidefinite.
    pub fn predicted(
        &self,
        mean: SVector<T, N>,
        transition: &SMatrix<T, N, N>,
        noise: &SMatrix<T, N, N>,
    ) -> Result<Self, ControlError> {
        finite("mean", &mean)?;
        finite("transition", transition)?;
        let lower = root("covariance", &self.covariance)?;
        let covariance = squares(&(transition * lower)) + squares(&root("noise", noise)?);
        finite("the predicted covariance", &covariance)?;
        Ok(Self { mean, covariance: symmetrized(&covariance) })
    }

    /// The estimate after a measurement of `P` quantities.
    ///
    /// `innovation` is the measurement less what the mean would have given: subtract angles the
    /// short way round. `observation` is the derivative of the measured quantities by the state at
    /// the mean, `noise` the covariance of the measurement. The correction is done on the square roots
    /// of the covariances, by rotations (Kailath, Sayed, Hassibi, Linear Estimation, 12.3): what comes out is
    /// positive semidefinite, however exact the measurement and in single precision too.
    ///
    /// ```
    /// use nalgebra::{Matrix2, matrix, vector};
    /// use nonholonomic::control::Estimate;
    ///
    /// let prior = Estimate { mean: vector![0.0, 0.0], covariance: Matrix2::identity() };
    /// let seen = prior.corrected(&vector![1.0], &matrix![1.0, 0.0], &matrix![1.0]).unwrap();
    /// assert!((seen.estimate.mean - vector![0.5, 0.0]).norm() < 1e-15);
    /// assert!((seen.estimate.covariance - matrix![0.5, 0.0; 0.0, 1.0]).norm() < 1e-15);
    /// assert!((seen.surprise - 0.5_f64).abs() < 1e-15);
    /// ```
    ///
    /// # Errors
    /// [`ControlError::NotFinite`] for an argument or the result, [`ControlError::NotDefinite`] if a
    /// covariance is not positive semidefinite, or that of the innovation not positive definite.
    pub fn corrected<const P: usize>(
        &self,
        innovation: &SVector<T, P>,
        observation: &SMatrix<T, P, N>,
        noise: &SMatrix<T, P, P>,
    ) -> Result<Correction<T, N>, ControlError> {
        finite("innovation", innovation)?;
        finite("mean", &self.mean)?;
        finite("observation", observation)?;
        let lower = root("covariance", &self.covariance)?;
        let measured = Measured::new(root("noise", noise)?, observation * lower, lower)?;
        let (change, surprise) = measured.change(innovation);
        let (mean, covariance) = (self.mean + change, squares(&measured.rest));
        finite("the corrected mean", &mean)?;
        finite("the corrected covariance", &covariance)?;
        Ok(Correction { estimate: Self { mean, covariance: symmetrized(&covariance) }, surprise })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Matrix2, matrix, vector};

    /// For a linear system the information form gives the same: P⁻¹ + HᵀR⁻¹H.
    #[test]
    fn a_correction_adds_information() {
        let prior = Estimate { mean: vector![1.0, 2.0], covariance: matrix![2.0, 0.3; 0.3, 0.7] };
        let observation = matrix![1.0, -0.4; 0.2, 3.0; 0.0, 1.0];
        let noise = nalgebra::Matrix3::from_diagonal(&vector![0.1, 0.2, 0.5]);
        let measured = vector![0.3, 6.5, 2.2];
        let correction =
            prior.corrected(&(measured - observation * prior.mean), &observation, &noise).unwrap();
        let information = prior.covariance.try_inverse().unwrap()
            + observation.transpose() * noise.try_inverse().unwrap() * observation;
        let vector = prior.covariance.try_inverse().unwrap() * prior.mean
            + observation.transpose() * noise.try_inverse().unwrap() * measured;
        let covariance = information.try_inverse().unwrap();
        assert!((correction.estimate.covariance - covariance).norm() < 1e-14);
        assert!((correction.estimate.mean - covariance * vector).norm() < 1e-14);
    }

    #[test]
    fn bad_measurements_leave_the_estimate() {
        let prior = Estimate { mean: vector![1.0, 2.0], covariance: Matrix2::identity() };
        let nan = prior.corrected(&vector![f64::NAN], &matrix![1.0, 0.0], &matrix![1.0]);
        assert!(matches!(nan, Err(ControlError::NotFinite { argument: "innovation", .. })));
        let exact = prior.corrected(&vector![1.0], &matrix![0.0, 0.0], &matrix![0.0]);
        assert!(matches!(exact, Err(ControlError::NotDefinite { .. })));
    }

    #[test]
    fn a_precise_sensor_keeps_the_covariance_positive_in_single_precision() {
        let mut estimate = Estimate { mean: vector![0.0_f32, 0.0], covariance: Matrix2::identity() * 1e4 };
        for _ in 0..100 {
            let step = matrix![1.0, 0.01; 0.0, 1.0];
            estimate =
                estimate.predicted(step * estimate.mean, &step, &(Matrix2::identity() * 1e-9)).unwrap();
            let seen = estimate.corrected(&vector![1e-3], &matrix![1.0, 0.0], &matrix![1e-8]).unwrap();
            estimate = seen.estimate;
            assert!(estimate.covariance.determinant() >= 0.0 && estimate.covariance[(0, 0)] > 0.0);
        }
    }
}
