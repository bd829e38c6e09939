//! Noise between two ticks.

use nalgebra::SMatrix;

use super::balance::{balanced, in_units, out_of_units};
use super::cholesky::semidefinite;
use super::hold::{MOST_HALVINGS, Witness};
use super::{ControlError, Entry, finite, norm, symmetrized};

/// The series is summed where its k-th term is at most 1/k! of the first: the rest is below 2⁻⁵³.
const TERMS: u32 = 18;

/// The covariance that white noise of the spectral density `density` in ẋ = a x + … adds to the state over a time
/// `dt`: ∫₀^dt exp(a s) W exp(aᵀs) ds, the `noise` of a filter's prediction.
///
/// The density has the unit of a covariance per second: of a torque disturbance w in ẋ = a x + g w it is
/// g gᵀ times the density of w. A cost ∫ xᵀ Q x dt between two ticks is the same integral of aᵀ and Q.
///
/// Summed as a series in X ↦ a X + X aᵀ for dt/2ⁿ, and doubled by Q(2h) = Q(h) + exp(a h) Q(h) exp(aᵀh) (Van Loan,
/// IEEE Trans. Automatic Control 23 (1978) 395–404, section 2, for the integral).
///
/// ```
/// use nalgebra::matrix;
/// use nonholonomic::control::held_noise;
///
/// // a mass that noise pushes: position and speed after a tenth of a second
/// let noise = held_noise(&matrix![0.0, 1.0; 0.0, 0.0], &matrix![0.0, 0.0; 0.0, 3.0], 0.1).unwrap();
/// assert!((noise - matrix![0.001, 0.015; 0.015, 0.3]).norm() < 1e-16);
/// ```
///
/// # Errors
/// [`ControlError::NotFinite`] if an argument, or the result, is not finite; [`ControlError::NotDefinite`] if
/// `density` is not positive semidefinite; [`ControlError::Setting`] for a negative `dt`; [`ControlError::TooFast`] as
/// for [`zero_order_hold`](super::zero_order_hold).
pub fn held_noise<T: Entry, const N: usize>(
    a: &SMatrix<T, N, N>,
    density: &SMatrix<T, N, N>,
    dt: T,
) -> Result<SMatrix<T, N, N>, ControlError> {
    finite("a", a)?;
    semidefinite("density", density)?;
    if !dt.is_finite() {
        return Err(ControlError::NotFinite { argument: "dt", value: dt.to_f64() });
    }
    if dt < T::ZERO {
        return Err(ControlError::Setting {
            setting: "dt",
            value: dt.to_f64(),
            expected: "positive or zero",
        });
    }
    let half = T::from_f64(0.5);
    let x = a * dt;
    finite("a dt", &x)?;
    let (mut x, units) = balanced(&x);
    let mut h = dt;
    let mut halvings = 0;
    while (norm(&x) > half || norm(&x.transpose()) > half) && halvings < MOST_HALVINGS {
        x *= half;
        h *= half;
        halvings += 1;
    }
    let mut term = in_units(symmetrized(density), &units) * h;
    let mut sum = term;
    for k in 2..=TERMS {
        let image = x * term;
        term = (image + image.transpose()) * T::from_u32(k).recip();
        sum += term;
    }
    let one = SMatrix::<T, N, N>::identity();
    let mut through = one;
    for k in (1..=TERMS).rev() {
        through = one + x * through * T::from_u32(k).recip();
    }
    let mut witness = Witness::new(&x, halvings);
    for _ in 0..halvings {
        sum += through * sum * through.transpose();
        through *= through;
        witness.compare(&through)?;
    }
    let sum = out_of_units(sum, &units);
    finite("the noise of a tick", &sum)?;
    Ok(symmetrized(&sum))
}

#[cfg(test)]
mod tests {
    use super::super::zero_order_hold;
    use super::*;
    use nalgebra::{Matrix2, matrix, vector};

    /// Gauss–Legendre quadrature of the integrand on many panels.
    #[test]
    fn it_is_the_integral() {
        let a = matrix![0.3, -4.0, 0.0; 2.5, -0.6, 1.0; 0.0, 0.4, -30.0];
        let half = matrix![1.0, 0.2; 0.0, 0.5; -0.3, 2.0];
        let density = half * half.transpose();
        let found = held_noise(&a, &density, 0.7).unwrap();
        let panels = 400;
        let h = 0.7 / f64::from(panels);
        let mut sum = nalgebra::Matrix3::zeros();
        for panel in 0..panels {
            for (node, weight) in
                [(-0.6_f64.sqrt(), 5.0 / 18.0), (0.0, 4.0 / 9.0), (0.6_f64.sqrt(), 5.0 / 18.0)]
            {
                let s = h * (f64::from(panel) + 0.5 + 0.5 * node);
                let (through, _) = zero_order_hold(&a, &vector![0.0, 0.0, 0.0], s).unwrap();
                sum += through * density * through.transpose() * (weight * h);
            }
        }
        // the error of the quadrature: h⁶ times derivatives of order six, 60⁶ at most
        assert!((found - sum).norm() < 1e-7 * sum.norm(), "{}", found - sum);
        // stationary noise of a stable system solves Lyapunov's equation
        let long = held_noise(&a, &density, 200.0).unwrap();
        assert!((a * long + long * a.transpose() + density).norm() < 1e-12 * density.norm());
    }

    #[test]
    fn two_halves_are_a_whole() {
        let a = matrix![0.0_f32, 1.0; -9.0, -0.4];
        let density = matrix![0.0, 0.0; 0.0, 2.0];
        let (half, _) = zero_order_hold(&a, &vector![0.0, 1.0], 0.1).unwrap();
        let first = held_noise(&a, &density, 0.1).unwrap();
        let whole = held_noise(&a, &density, 0.2).unwrap();
        assert!((half * first * half.transpose() + first - whole).norm() < 1e-6);
    }

    #[test]
    fn extremes_end() {
        let one = Matrix2::<f64>::identity();
        assert_eq!(held_noise(&one, &one, 0.0), Ok(Matrix2::zeros()));
        let back = held_noise(&one, &one, -1.0);
        assert!(matches!(back, Err(ControlError::Setting { setting: "dt", .. })));
        let overflow = held_noise(&(one * 1e6), &one, 1.0);
        assert!(matches!(overflow, Err(ControlError::NotFinite { .. })));
        let none = held_noise(&one, &-one, 1.0);
        assert!(matches!(none, Err(ControlError::NotDefinite { matrix: "density", .. })));
        let fast = held_noise(&(one * -1e200), &one, 1.0).unwrap();
        assert!(fast.iter().all(|x| x.is_finite()));
        let turn = held_noise(&(matrix![0.0, 1.0; -1.0, 0.0] * 1e200), &one, 1.0);
        assert!(matches!(turn, Err(ControlError::TooFast { .. })), "{turn:?}");
    }
}
