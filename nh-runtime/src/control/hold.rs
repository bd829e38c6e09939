//! Inputs that are constant between two ticks.

use nalgebra::SMatrix;

use super::balance::{balanced, restored};
use super::{ControlError, Entry, finite, norm};

/// The highest power in the series of φ₁: the rest is below 2⁻⁵³ where the norm is at most 1/2.
const TERMS: u32 = 13;
/// So many halvings bring every finite matrix of f64, of up to 2³² rows, below the norm 1/2.
pub(super) const MOST_HALVINGS: u32 = 1025 + 32;

/// The discrete-time system x' = A_d x + B_d u of ẋ = a x + b u over a time `dt` with a constant
/// input: A_d = exp(a dt), B_d = ∫₀^dt exp(a s) ds b.
///
/// With φ₁(X) = Σ Xᵏ/(k+1)!, exp X = 1 + X φ₁(X) and B_d = dt φ₁(a dt) b; φ₁ is summed for X/2ⁿ of
/// norm at most 1/2 and doubled by φ₁(2X) = φ₁(X)(exp X + 1)/2 (Higham, Functions of Matrices, 10.7).
/// `a` may be singular, as it is where a position is a state.
///
/// ```
/// use nalgebra::{matrix, vector};
/// use nonholonomic::control::zero_order_hold;
///
/// // a mass pushed along a line: position and speed after a tenth of a second
/// let (a, b) = zero_order_hold(&matrix![0.0, 1.0; 0.0, 0.0], &vector![0.0, 2.0], 0.1).unwrap();
/// assert!((a - matrix![1.0, 0.1; 0.0, 1.0]).norm() < 1e-16);
/// assert!((b - vector![0.01, 0.2]).norm() < 1e-16);
/// ```
///
/// # Errors
/// [`ControlError::NotFinite`] if an argument, or the result, is not finite; [`ControlError::TooFast`] if a mode that
/// does not decay turns or drifts so fast that rounding decides the result.
#[doc(alias("c2d", "expm"))]
pub fn zero_order_hold<T: Entry, const N: usize, const M: usize>(
    a: &SMatrix<T, N, N>,
    b: &SMatrix<T, N, M>,
    dt: T,
) -> Result<(SMatrix<T, N, N>, SMatrix<T, N, M>), ControlError> {
    finite("a", a)?;
    finite("b", b)?;
    if !dt.is_finite() {
        return Err(ControlError::NotFinite { argument: "dt", value: dt.to_f64() });
    }
    let half = T::from_f64(0.5);
    let x = a * dt;
    finite("a dt", &x)?;
    let (mut x, units) = balanced(&x);
    let mut halvings = 0;
    while norm(&x) > half && halvings < MOST_HALVINGS {
        x *= half;
        halvings += 1;
    }
    let one = SMatrix::<T, N, N>::identity();
    // φ₁ by Horner's rule: 1 + X/2 (1 + X/3 (1 + …))
    let mut phi = one;
    for k in (2..=TERMS + 1).rev() {
        phi = one + x * phi * T::from_u32(k).recip();
    }
    let mut exponential = one + x * phi;
    let mut witness = Witness::new(&x, halvings);
    for _ in 0..halvings {
        phi = phi * (exponential + one) * half;
        exponential *= exponential;
        witness.compare(&exponential)?;
    }
    let (exponential, phi) = (restored(exponential, &units), restored(phi, &units));
    let held = phi * b * dt;
    finite("exp(a dt)", &exponential)?;
    finite("B_d", &held)?;
    Ok((exponential, held))
}

/// The same exponential with the last bits of a dt changed, where so many squarings may bring rounding errors, which
/// double each time, beyond a quarter of the digits.
pub(super) struct Witness<T, const N: usize> {
    exponential: Option<SMatrix<T, N, N>>,
    /// The norm of a dt.
    size: T,
}

impl<T: Entry, const N: usize> Witness<T, N> {
    /// Beside the exponential of x, which has been halved this often.
    pub(super) fn new(x: &SMatrix<T, N, N>, halvings: u32) -> Self {
        let two = T::from_f64(2.0);
        let mut error = T::EPSILON;
        let mut size = norm(x);
        for _ in 0..halvings {
            error *= two;
            size *= two;
        }
        if error <= negligible() {
            return Self { exponential: None, size };
        }
        let one = SMatrix::<T, N, N>::identity();
        let y = x * (T::ONE + T::from_f64(4.0) * T::EPSILON);
        let mut exponential = one;
        for k in (1..=TERMS + 1).rev() {
            exponential = one + y * exponential * T::from_u32(k).recip();
        }
        Self { exponential: Some(exponential), size }
    }

    /// Squares, and refuses what is not the same, unless it has decayed.
    pub(super) fn compare(&mut self, exponential: &SMatrix<T, N, N>) -> Result<(), ControlError> {
        let Some(mine) = &mut self.exponential else { return Ok(()) };
        *mine *= *mine;
        let size = norm(exponential);
        let is_same = norm(&(exponential - *mine)) <= negligible::<T>() * size;
        if is_same || size <= negligible() || !size.is_finite() {
            return Ok(());
        }
        Err(ControlError::TooFast { argument: "a dt", norm: self.size.to_f64() })
    }
}

/// What is left of an error that has lost a quarter of the digits.
fn negligible<T: Entry>() -> T {
    T::EPSILON.sqrt().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{matrix, vector};

    /// Computed with mpmath at 40 digits: expm(A dt) and the integral, dt = 0.7.
    #[test]
    fn it_agrees_with_high_precision() {
        let a = matrix![0.3, -4.0, 0.0; 2.5, -0.6, 1.0; 0.0, 0.4, -30.0];
        let b = matrix![1.0, 0.0; 0.0, 2.0; -1.0, 3.0];
        let (ad, bd) = zero_order_hold(&a, &b, 0.7).unwrap();
        let expected_a = matrix![
            -0.421_735_187_453_215_1, -0.939_991_658_970_365, -0.033_474_443_007_596_43;
            0.587_494_786_856_478, -0.629_885_866_420_787_6, -0.018_570_991_039_951_718;
            0.008_368_610_751_899_107, -0.007_428_396_415_980_688, -0.000_212_622_327_215_940_17
        ];
        let expected_b = matrix![
            0.343_361_860_009_944_8, -1.272_614_638_871_023_8;
            0.372_817_325_612_150_53, 0.399_655_563_825_553;
            -0.028_648_476_761_141_83, 0.105_845_229_511_461_01
        ];
        assert!((ad - expected_a).norm() < 1e-14 * expected_a.norm(), "{}", ad - expected_a);
        assert!((bd - expected_b).norm() < 1e-14 * expected_b.norm(), "{}", bd - expected_b);
    }

    #[test]
    fn two_halves_are_a_whole() {
        let a = matrix![0.0_f32, 1.0; -9.0, -0.4];
        let b = vector![0.0_f32, 1.0];
        let (whole, held) = zero_order_hold(&a, &b, 0.2).unwrap();
        let (half, half_held) = zero_order_hold(&a, &b, 0.1).unwrap();
        assert!((half * half - whole).norm() < 1e-6);
        assert!((half * half_held + half_held - held).norm() < 1e-7);
    }

    #[test]
    fn extremes_end() {
        let (ad, bd) = zero_order_hold(&matrix![-1e300_f64], &matrix![1.0_f64], 1.0).unwrap();
        assert!(ad[0].abs() < 1e-300 && bd[0].is_finite());
        let overflow = zero_order_hold(&matrix![1e6], &matrix![1.0], 1.0);
        assert!(matches!(overflow, Err(ControlError::NotFinite { .. })), "{overflow:?}");
        // a rotation that no digit of the angle is left of, and one that has most of them
        for fast in [1e15, 1e40, 1e200, 1e300] {
            let turn = zero_order_hold(&matrix![0.0, fast; -fast, 0.0], &vector![0.0, 1.0], 1.0);
            assert!(
                matches!(turn, Err(ControlError::TooFast { argument: "a dt", norm }) if norm >= fast),
                "{turn:?}"
            );
            let damped = matrix![-fast, fast; -fast, -fast];
            let (ad, _) = zero_order_hold(&damped, &vector![0.0, 1.0], 1.0).unwrap();
            assert!(ad.norm() < 1e-300);
            // a drift is exact, however fast
            let (drift, _) =
                zero_order_hold(&matrix![0.0, fast; 0.0, 0.0], &vector![0.0, 1e-9], 1.0).unwrap();
            assert!((drift[(0, 1)] / fast - 1.0).abs() < 1e-15);
        }
        for fast in [1e3_f64, 1e6, 1e9] {
            let (turn, _) =
                zero_order_hold(&matrix![0.0, fast; -fast, 0.0], &vector![0.0, 1.0], 1.0).unwrap();
            let exact = matrix![fast.cos(), fast.sin(); -fast.sin(), fast.cos()];
            assert!((turn - exact).norm() < 8.0 * f64::EPSILON * fast, "{turn} {exact}");
        }
        let nan = zero_order_hold(&matrix![f64::NAN], &matrix![1.0], 1.0);
        assert!(matches!(nan, Err(ControlError::NotFinite { argument: "a", .. })));
        let (same, none) = zero_order_hold(&matrix![5.0_f64], &matrix![1.0], 0.0).unwrap();
        assert_eq!((same[0].to_bits(), none[0].to_bits()), (1.0_f64.to_bits(), 0.0_f64.to_bits()));
    }
}
