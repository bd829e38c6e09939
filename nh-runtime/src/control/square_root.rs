//! A measurement in square-root form: what is known is carried as factors of covariances, so that none loses its
//! definiteness (Kailath, Sayed, Hassibi, Linear Estimation, 2000, section 12.3, the covariance array).

use nalgebra::{SMatrix, SVector};

use super::{ControlError, Entry};

/// The array
///
/// ```text
/// | √R  H L |            | √S  0  |
/// | 0    L  |  rotated to | K̄   L⁺ |,   S = H L Lᵀ Hᵀ + R,   K̄ = L Lᵀ Hᵀ √S⁻ᵀ,   L⁺ L⁺ᵀ = L Lᵀ − K̄ K̄ᵀ.
/// ```
pub(super) struct Measured<T, const N: usize, const P: usize> {
    /// √S, lower triangular.
    spread: SMatrix<T, P, P>,
    /// K̄: the gain times √S.
    gain: SMatrix<T, N, P>,
    /// L⁺.
    pub(super) rest: SMatrix<T, N, N>,
}

/// Rotates the entry (i, k) of `other` into the diagonal of `diagonal`; the rotation of column i and column k.
fn rotation<T: Entry>(a: T, b: T) -> Option<(T, T)> {
    let largest = a.abs().max(b.abs());
    if b == T::ZERO || !largest.is_finite() {
        return None;
    }
    let (a, b) = (a / largest, b / largest);
    let length = (a * a + b * b).sqrt();
    Some((a / length, b / length))
}

/// Applies a rotation to a column of each of two matrices. Of the entry that it takes away, rounding may be left.
fn rotate<T: Entry, const R: usize, const A: usize, const B: usize>(
    (cos, sin): (T, T),
    (first, i): (&mut SMatrix<T, R, A>, usize),
    (second, k): (&mut SMatrix<T, R, B>, usize),
) {
    for row in 0..R {
        let (a, b) = (first[(row, i)], second[(row, k)]);
        first[(row, i)] = cos * a + sin * b;
        second[(row, k)] = cos * b - sin * a;
    }
}

/// The lower triangular root of `lower lowerᵀ + more moreᵀ`.
pub(super) fn with_more<T: Entry, const P: usize, const C: usize>(
    mut lower: SMatrix<T, P, P>,
    mut more: SMatrix<T, P, C>,
) -> SMatrix<T, P, P> {
    for i in 0..P {
        for k in 0..C {
            if let Some(turn) = rotation(lower[(i, i)], more[(i, k)]) {
                rotate(turn, (&mut lower, i), (&mut more, k));
                more[(i, k)] = T::ZERO;
            }
        }
    }
    lower
}

/// What of a row is left by rounding alone where nothing should be left, in units of the last place.
const ROUNDING: f64 = 4.0;

impl<T: Entry, const N: usize, const P: usize> Measured<T, N, P> {
    /// The array with √R, H L and L.
    pub(super) fn new(
        mut spread: SMatrix<T, P, P>,
        mut seen: SMatrix<T, P, N>,
        mut rest: SMatrix<T, N, N>,
    ) -> Result<Self, ControlError> {
        let mut gain = SMatrix::<T, N, P>::zeros();
        let rounding = T::from_f64(ROUNDING) * T::EPSILON;
        for i in 0..P {
            // rotations leave the length of a row as it is, and rounding in each of its entries
            let row = spread.row(i).iter().chain(seen.row(i).iter()).fold(T::ZERO, |sum, x| sum + x.abs());
            for k in 0..N {
                if let Some(turn) = rotation(spread[(i, i)], seen[(i, k)]) {
                    rotate(turn, (&mut spread, i), (&mut seen, k));
                    seen[(i, k)] = T::ZERO;
                    rotate(turn, (&mut gain, i), (&mut rest, k));
                }
            }
            let (matrix, pivot) = ("the covariance of the innovation", spread[(i, i)]);
            if !pivot.is_finite() {
                return Err(ControlError::NotFinite { argument: matrix, value: pivot.to_f64() });
            }
            if pivot <= rounding * row {
                return Err(ControlError::NotDefinite { matrix, pivot: pivot.to_f64() });
            }
        }
        Ok(Self { spread, gain, rest })
    }

    /// What an innovation adds to the mean, and the squared innovation in units of its standard deviations.
    pub(super) fn change(&self, innovation: &SVector<T, P>) -> (SVector<T, N>, T) {
        let mut white = *innovation;
        for i in 0..P {
            let known = (0..i).fold(T::ZERO, |sum, k| sum + self.spread[(i, k)] * white[k]);
            white[i] = (white[i] - known) / self.spread[(i, i)];
        }
        (self.gain * white, white.iter().fold(T::ZERO, |sum, x| sum + *x * *x))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{matrix, vector};

    #[test]
    fn the_rotated_array_has_the_squares_of_the_first() {
        let root = matrix![0.3_f64, 0.0; 0.1, 0.5];
        let seen = matrix![1.0, -2.0, 0.3; 0.4, 0.0, 5.0];
        let lower = matrix![2.0, 0.0, 0.0; 0.3, 1.5, 0.0; -0.7, 0.2, 1.0];
        let found = Measured::new(root, seen, lower).unwrap();
        let spread = root * root.transpose() + seen * seen.transpose();
        assert!((found.spread * found.spread.transpose() - spread).norm() < 1e-14);
        assert!(found.spread[(0, 1)].abs() < 1e-15);
        assert!((found.gain * found.spread.transpose() - lower * seen.transpose()).norm() < 1e-14);
        let rest = lower * lower.transpose() - found.gain * found.gain.transpose();
        assert!((found.rest * found.rest.transpose() - rest).norm() < 1e-14);
        let (change, surprise) = found.change(&vector![0.2, -0.3]);
        let inverse = spread.try_inverse().unwrap();
        assert!((change - lower * seen.transpose() * inverse * vector![0.2, -0.3]).norm() < 1e-14);
        assert!(
            (surprise - (vector![0.2, -0.3].transpose() * inverse * vector![0.2, -0.3])[0]).abs() < 1e-14
        );
        let more = with_more(root, seen);
        assert!((more * more.transpose() - spread).norm() < 1e-14 && more[(0, 1)].abs() < 1e-15);
    }

    /// The same measured twice without noise: the second says nothing, whatever rounding leaves of it.
    #[test]
    fn what_is_certain_already_is_no_measurement() {
        for factor in [1.0_f64, 3.0, 0.7, 1e-9, -1e12] {
            for (a, b) in [(0.1_f64, 0.3), (1.1, -0.7), (1e-5, 1e5)] {
                let seen = matrix![a, b; factor * a, factor * b];
                let lower = matrix![0.3, 0.0; -0.2, 1.7];
                let twice = Measured::new(matrix![0.0, 0.0; 0.0, 0.0], seen * lower, lower);
                assert!(matches!(twice, Err(ControlError::NotDefinite { .. })), "{factor} {a} {b}");
                let noise = 1e-9 * (a.abs() + b.abs());
                let noisy = matrix![noise, 0.0; 0.0, noise * factor.abs()];
                assert!(Measured::new(noisy, seen * lower, lower).is_ok(), "{factor} {a} {b}");
            }
        }
    }
}
