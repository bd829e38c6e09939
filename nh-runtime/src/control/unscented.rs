//! The unscented Kalman filter, a step at a time.

use nalgebra::{SMatrix, SVector};

use super::cholesky::{root, semidefinite};
use super::square_root::{Measured, with_more};
use super::{ControlError, Correction, Entry, Estimate, finite, squares, symmetrized};

/// The scaled unscented transformation (Julier, Proc. American Control Conference 2002, 4555–4559; van
/// der Merwe's weights): a covariance carried through a map by 2N + 1 points instead of a derivative.
///
/// The default `spread` 1, `kurtosis` 2 and `shift` 0 suit states of a few components; a smaller
/// spread keeps the points nearer to the mean, at the price of digits: second differences of images are divided by
/// c² = `spread`² (N + `shift`), which is refused below the root of the rounding unit, 1.5e-8 in `f64` and 3.5e-4
/// in `f32`.
///
/// The weights of 1/c² that cancel in the literature's sums do not occur: with the odd and the even parts o, e of
/// the images about that of the mean, the mean is Σ e/c² =: m from there, and the covariance
/// Σ (o oᵀ + e eᵀ)/c² + (β − α²) m mᵀ. As a sum of squares that is positive semidefinite wherever
/// κ ≥ 0 and β ≥ 0, and so is what a correction leaves. Where other settings make it indefinite that is an
/// error.
#[doc(alias("UKF", "sigma points"))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unscented<T> {
    /// α: how far the points lie from the mean.
    pub spread: T,
    /// β: what is known of the fourth moments; 2 for normal distributions.
    pub kurtosis: T,
    /// κ.
    pub shift: T,
}

impl<T: Entry> Default for Unscented<T> {
    fn default() -> Self {
        Self { spread: T::ONE, kurtosis: T::from_f64(2.0), shift: T::ZERO }
    }
}

/// The points x̄, x̄ + c Lᵢ, x̄ − c Lᵢ, with the columns Lᵢ of the Cholesky factor.
struct Points<T, const N: usize> {
    centre: SVector<T, N>,
    plus: [SVector<T, N>; N],
    minus: [SVector<T, N>; N],
    /// L.
    lower: SMatrix<T, N, N>,
    /// c.
    distance: T,
    /// (β − α²)/c², the weight of the square of Σ e/c.
    bend: T,
}

impl<T: Entry> Unscented<T> {
    /// The estimate after a step of time; `step` carries a state over it, and `noise` is the
    /// covariance of what the model does not know of the step.
    ///
    /// ```
    /// use nalgebra::{Matrix2, matrix, vector};
    /// use nonholonomic::control::{Estimate, Unscented};
    ///
    /// // of a linear map the result is exact
    /// let prior = Estimate { mean: vector![1.0, 0.0], covariance: Matrix2::identity() };
    /// let map = matrix![1.0, 0.5; 0.0, 1.0];
    /// let next = Unscented::default().predicted(&prior, |x| map * x, &Matrix2::zeros()).unwrap();
    /// assert!((next.covariance - map * map.transpose()).norm() < 1e-14);
    /// ```
    ///
    /// # Errors
    /// [`ControlError::NotDefinite`] if the covariance or `noise` is not positive semidefinite, or the result is not;
    /// [`ControlError::NotFinite`] for an argument, the result, or a point that is carried out of the numbers;
    /// [`ControlError::Setting`] if α²(n + κ) is not finite or too small for the digits, or β no number.
    pub fn predicted<const N: usize>(
        &self,
        prior: &Estimate<T, N>,
        mut step: impl FnMut(SVector<T, N>) -> SVector<T, N>,
        noise: &SMatrix<T, N, N>,
    ) -> Result<Estimate<T, N>, ControlError> {
        let noise = squares(&root("noise", noise)?);
        let points = self.points(prior)?;
        let centre = step(points.centre);
        let (plus, minus) = (points.plus.map(&mut step), points.minus.map(&mut step));
        // states do not wrap: differences are plain ones
        let carried = Carried::new(&points, centre, &plus, &minus, |a, b| a - b)?;
        let covariance = carried.covariance() + noise;
        let mean = centre + carried.mean;
        finite("the predicted mean", &mean)?;
        finite("the predicted covariance", &covariance)?;
        if !carried.is_complete() {
            semidefinite("the predicted covariance", &covariance)?;
        }
        Ok(Estimate { mean, covariance: symmetrized(&covariance) })
    }

    /// The estimate after a measurement of `P` quantities.
    ///
    /// `observe` gives what a state would show; `difference(a, b)` is a − b with angles taken the
    /// short way round; `noise` is the covariance of the measurement.
    ///
    /// # Errors
    /// As [`predicted`](Self::predicted), and [`ControlError::NotDefinite`] if the covariance of the
    /// innovation is not positive definite.
    pub fn corrected<const N: usize, const P: usize>(
        &self,
        prior: &Estimate<T, N>,
        measured: &SVector<T, P>,
        mut observe: impl FnMut(SVector<T, N>) -> SVector<T, P>,
        difference: impl Fn(SVector<T, P>, SVector<T, P>) -> SVector<T, P>,
        noise: &SMatrix<T, P, P>,
    ) -> Result<Correction<T, N>, ControlError> {
        finite("measured", measured)?;
        semidefinite("noise", noise)?;
        let points = self.points(prior)?;
        let centre = observe(points.centre);
        let (plus, minus) = (points.plus.map(&mut observe), points.minus.map(&mut observe));
        let carried = Carried::new(&points, centre, &plus, &minus, &difference)?;
        let innovation = difference(*measured, centre) - carried.mean;
        finite("innovation", &innovation)?;
        let measured = Measured::new(carried.beside(noise)?, carried.odd, points.lower)?;
        let (change, surprise) = measured.change(&innovation);
        let (mean, covariance) = (prior.mean + change, squares(&measured.rest));
        finite("the corrected mean", &mean)?;
        finite("the corrected covariance", &covariance)?;
        let estimate = Estimate { mean, covariance: symmetrized(&covariance) };
        Ok(Correction { estimate, surprise })
    }

    fn points<const N: usize>(&self, prior: &Estimate<T, N>) -> Result<Points<T, N>, ControlError> {
        finite("mean", &prior.mean)?;
        let lower = root("covariance", &prior.covariance)?;
        let count = T::from_u32(u32::try_from(N).unwrap_or(u32::MAX));
        // c² = n + λ = α²(n + κ)
        let squared = self.spread * self.spread * (count + self.shift);
        if !(squared >= T::EPSILON.sqrt() && squared.is_finite()) {
            let expected = "such that spread² (N + shift) is finite and at least the root of the rounding unit, \
                            1.5e-8 in f64 and 3.5e-4 in f32";
            return Err(ControlError::Setting { setting: "spread", value: self.spread.to_f64(), expected });
        }
        if !self.kurtosis.is_finite() {
            let (setting, value) = ("kurtosis", self.kurtosis.to_f64());
            return Err(ControlError::Setting { setting, value, expected: "finite" });
        }
        let distance = squared.sqrt();
        let column = |i: usize| lower.column(i) * distance;
        let bend = (self.kurtosis - self.spread * self.spread) / squared;
        Ok(Points {
            centre: prior.mean,
            plus: core::array::from_fn(|i| prior.mean + column(i)),
            minus: core::array::from_fn(|i| prior.mean - column(i)),
            lower,
            distance,
            bend,
        })
    }
}

/// What a map makes of the points: moments about the image of the centre.
struct Carried<T, const N: usize, const P: usize> {
    /// The mean less the image of the centre.
    mean: SVector<T, P>,
    /// The odd parts over c: the derivative along the columns of L, where the map is linear.
    odd: SMatrix<T, P, N>,
    /// The even parts over c, with their weights.
    even: SMatrix<T, P, N>,
    /// What the square of the even parts lacks; zero where that is positive semidefinite.
    lacking: SVector<T, P>,
}

impl<T: Entry, const N: usize, const P: usize> Carried<T, N, P> {
    fn new(
        points: &Points<T, N>,
        centre: SVector<T, P>,
        plus: &[SVector<T, P>; N],
        minus: &[SVector<T, P>; N],
        difference: impl Fn(SVector<T, P>, SVector<T, P>) -> SVector<T, P>,
    ) -> Result<Self, ControlError> {
        let half = (points.distance + points.distance).recip();
        let (mut odd, mut even) = (SMatrix::<T, P, N>::zeros(), SMatrix::<T, P, N>::zeros());
        let mut sum = SVector::<T, P>::zeros();
        for (i, (a, b)) in plus.iter().zip(minus).enumerate() {
            let (a, b) = (difference(*a, centre), difference(*b, centre));
            let part = (a + b) * half;
            odd.set_column(i, &((a - b) * half));
            even.set_column(i, &part);
            sum += part;
        }
        let mean = sum * points.distance.recip();
        finite("an image of a point", &mean)?;
        finite("an image of a point", &odd)?;
        // e eᵀ + bend (Σ e)(Σ e)ᵀ = ẽ ẽᵀ with ẽᵢ = eᵢ + share Σ e
        let count = T::from_u32(u32::try_from(N).unwrap_or(u32::MAX));
        let whole = T::ONE + points.bend * count;
        let mut lacking = SVector::<T, P>::zeros();
        if whole >= T::ZERO {
            let share = points.bend / (whole.sqrt() + T::ONE);
            for i in 0..N {
                let moved = even.column(i) + sum * share;
                even.set_column(i, &moved);
            }
        } else {
            lacking = sum * (-points.bend).sqrt();
        }
        Ok(Self { mean, odd, even, lacking })
    }

    fn covariance(&self) -> SMatrix<T, P, P> {
        squares(&self.odd) + squares(&self.even) - squares(&self.lacking)
    }

    /// A root of what noise and curvature make of a measurement beside its derivative.
    fn beside(&self, noise: &SMatrix<T, P, P>) -> Result<SMatrix<T, P, P>, ControlError> {
        if self.is_complete() {
            return Ok(with_more(root("noise", noise)?, self.even));
        }
        root("the covariance beside the linear part", &(squares(&self.even) - squares(&self.lacking) + noise))
    }

    /// Whether nothing is lacking.
    fn is_complete(&self) -> bool {
        self.lacking == SVector::<T, P>::zeros()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Matrix2, matrix, vector};

    #[test]
    fn a_linear_measurement_gives_the_kalman_filter() {
        let prior = Estimate { mean: vector![1.0_f64, 2.0], covariance: matrix![2.0, 0.3; 0.3, 0.7] };
        let observation = matrix![1.0, -0.4; 0.2, 3.0];
        let noise = matrix![0.1, 0.02; 0.02, 0.2];
        let measured = vector![0.3, 6.5];
        let linear = prior.corrected(&(measured - observation * prior.mean), &observation, &noise).unwrap();
        for spread in [1.0, 0.1] {
            let filter = Unscented { spread, ..Unscented::default() };
            let points =
                filter.corrected(&prior, &measured, |x| observation * x, |a, b| a - b, &noise).unwrap();
            assert!((points.estimate.mean - linear.estimate.mean).norm() < 1e-12);
            assert!((points.estimate.covariance - linear.estimate.covariance).norm() < 1e-12);
            assert!((points.surprise - linear.surprise).abs() < 1e-11);
        }
    }

    /// E sin² of a normal distribution is (1 − exp(−2σ²))/2: second-order terms are right.
    #[test]
    fn a_square_has_the_right_mean() {
        let prior = Estimate { mean: vector![0.5_f64], covariance: matrix![0.04] };
        let none = matrix![0.0];
        let squared = Unscented::default().predicted(&prior, |x| x.map(|x| x * x), &none).unwrap();
        assert!((squared.mean[0] - 0.29).abs() < 1e-15);
        // var x² = 4 μ²σ² + 2 σ⁴
        assert!((squared.covariance[(0, 0)] - (0.04 + 2.0 * 0.0016)).abs() < 1e-15);
    }

    /// What is known for certain, such as a parameter among the states, has no points of its own.
    #[test]
    fn what_is_certain_stays_so() {
        let prior = Estimate { mean: vector![1.0_f64, 2.0], covariance: matrix![4.0, 0.0; 0.0, 0.0] };
        let map = |x: SVector<f64, 2>| vector![x[0] * x[1], x[1]];
        let next = Unscented::default().predicted(&prior, map, &Matrix2::zeros()).unwrap();
        assert!((next.mean - vector![2.0, 2.0]).norm() < 1e-15);
        assert!((next.covariance - matrix![16.0, 0.0; 0.0, 0.0]).norm() < 1e-14);
        let indefinite = Estimate { covariance: matrix![1.0, 2.0; 2.0, 1.0], ..prior };
        let refused = Unscented::default().predicted(&indefinite, map, &Matrix2::identity());
        assert!(matches!(refused, Err(ControlError::NotDefinite { matrix: "covariance", .. })));
    }
}
