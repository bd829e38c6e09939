//! Symmetric positive definite systems: A = L D Lᵀ (Golub, Van Loan, Matrix Computations, 4.1.2), without roots of
//! what has a unit.

use nalgebra::{SMatrix, SVector};

use super::square_root::with_more;
use super::{ControlError, Entry, symmetrized};

/// The factors of a positive definite matrix.
pub(super) struct Cholesky<T, const N: usize> {
    /// L below its diagonal of ones, which is not stored.
    lower: SMatrix<T, N, N>,
    /// D.
    pivots: SVector<T, N>,
}

impl<T: Entry, const N: usize> Cholesky<T, N> {
    /// Factorizes a symmetric matrix, of which the lower triangle is read. A pivot that is round-off of what it was is not
    /// positive, whatever its sign.
    pub(super) fn new(name: &'static str, a: &SMatrix<T, N, N>) -> Result<Self, ControlError> {
        let mut lower = SMatrix::<T, N, N>::zeros();
        let mut pivots = SVector::<T, N>::zeros();
        let rounding = T::from_u32(u32::try_from(N).unwrap_or(u32::MAX)) * T::EPSILON;
        for j in 0..N {
            let dot = |rows: &SMatrix<T, N, N>, i: usize| {
                (0..j).fold(T::ZERO, |sum, k| sum + rows[(i, k)] * (rows[(j, k)] * pivots[k]))
            };
            let pivot = a[(j, j)] - dot(&lower, j);
            if !pivot.is_finite() {
                return Err(ControlError::NotFinite { argument: name, value: pivot.to_f64() });
            }
            if pivot <= rounding * a[(j, j)].abs() {
                return Err(ControlError::NotDefinite { matrix: name, pivot: pivot.to_f64() });
            }
            for i in j + 1..N {
                lower[(i, j)] = (a[(i, j)] - dot(&lower, i)) / pivot;
            }
            pivots[j] = pivot;
        }
        Ok(Self { lower, pivots })
    }

    /// A⁻¹ b for every column b.
    pub(super) fn solve<const C: usize>(&self, b: &SMatrix<T, N, C>) -> SMatrix<T, N, C> {
        let mut x = *b;
        for c in 0..C {
            for i in 0..N {
                let known = (0..i).fold(T::ZERO, |sum, k| sum + self.lower[(i, k)] * x[(k, c)]);
                x[(i, c)] -= known;
            }
            for i in (0..N).rev() {
                let known = (i + 1..N).fold(T::ZERO, |sum, k| sum + self.lower[(k, i)] * x[(k, c)]);
                x[(i, c)] = x[(i, c)] / self.pivots[i] - known;
            }
        }
        x
    }
}

/// The sum of absolute values on the diagonal: how large a matrix of squares is.
fn trace<T: Entry, const N: usize>(a: &SMatrix<T, N, N>) -> T {
    (0..N).fold(T::ZERO, |sum, k| sum + a[(k, k)].abs())
}

/// Refuses a matrix that is not finite, or whose quadratic form is not positive semidefinite up to round-off: a
/// covariance or a weight.
pub(super) fn semidefinite<T: Entry, const N: usize>(
    name: &'static str,
    a: &SMatrix<T, N, N>,
) -> Result<(), ControlError> {
    semidefinite_beside(a, name, a)
}

/// The same for what is left of a difference of matrices, of which `larger` is the larger. The count of operations does
/// not depend on the numbers.
///
/// Components have units of their own: what is left of one is compared with its own place on the diagonal of the larger
/// matrix, and an entry beside the diagonal with both of its. Where that place is zero or negative, it is the round-off
/// of others in whatever unit: √ε of the trace is what it is compared with.
///
/// Schur complements are taken by the component of which the largest share is left, as long as that is no round-off: what is
/// divided by a small pivot that another one would have taken away is round-off beyond all digits. What is left then has to
/// vanish. Round-off means √ε of the scale, and more than rounding explains.
pub(super) fn semidefinite_beside<T: Entry, const N: usize>(
    larger: &SMatrix<T, N, N>,
    name: &'static str,
    a: &SMatrix<T, N, N>,
) -> Result<(), ControlError> {
    super::finite(name, a)?;
    let nothing = T::EPSILON.sqrt();
    let floor = nothing * trace(larger);
    let scales = larger.diagonal().map(|place| place.select_gt(T::ZERO, place, floor));
    let mut rest = symmetrized(a);
    for _ in 0..N {
        let (mut most, mut pivot) = (nothing, T::ONE);
        // one at the component that is chosen, if there is one, and its column
        let (mut chosen, mut column) = (SVector::<T, N>::zeros(), SVector::<T, N>::zeros());
        for (k, (of_column, scale)) in rest.column_iter().zip(&scales).enumerate() {
            let place = rest[(k, k)];
            let share = place / *scale;
            let takes = |then: T, otherwise: T| share.select_gt(most, then, otherwise);
            column.iter_mut().zip(of_column.iter()).for_each(|(x, here)| *x = takes(*here, *x));
            for (j, mark) in chosen.iter_mut().enumerate() {
                *mark = takes(if j == k { T::ONE } else { T::ZERO }, *mark);
            }
            (most, pivot) = (takes(share, most), takes(place, pivot));
        }
        for ((mut of_column, factor), of_chosen) in rest.column_iter_mut().zip(&column).zip(&chosen) {
            let factor = *factor / pivot;
            for ((x, along), of_row) in of_column.iter_mut().zip(&column).zip(&chosen) {
                let less = *x - factor * *along;
                *x = of_row.select_gt(T::ZERO, T::ZERO, of_chosen.select_gt(T::ZERO, T::ZERO, less));
            }
        }
    }
    // the lowest place that is left, and the widest entry beside the diagonal, with their shares
    let (mut lowest, mut widest) = ((T::ZERO, T::ZERO), (T::ZERO, T::ZERO));
    let mut vanishes = true;
    for k in 0..N {
        let (place, scale) = (rest[(k, k)], scales[k]);
        let share = place / scale;
        lowest = (lowest.1.select_gt(share, place, lowest.0), lowest.1.select_gt(share, share, lowest.1));
        // what is zero is none of anything
        vanishes &= !place.all_ne(T::ZERO) || share.all_ge(-nothing);
        for j in k + 1..N {
            let beside = rest[(j, k)].abs();
            // squares of shares: the product of two ratios
            let square = (beside / scale) * (beside / scales[j]);
            widest =
                (square.select_gt(widest.1, beside, widest.0), square.select_gt(widest.1, square, widest.1));
            vanishes &= !beside.all_ne(T::ZERO) || (nothing * nothing).all_ge(square);
        }
    }
    if vanishes {
        return Ok(());
    }
    let pivot = if lowest.1 < -nothing { lowest.0 } else { -widest.0 };
    Err(ControlError::NotDefinite { matrix: name, pivot: pivot.to_f64() })
}

/// The lower triangular L with L Lᵀ = a of a positive semidefinite matrix.
///
/// The pivot is the component of which the largest share is left, so that what is divided by it is known as well as the
/// pivot (Higham, Accuracy and Stability of Numerical Algorithms, 2002, 10.3): of two components that are one but for
/// round-off, the second has a pivot of round-off, which says nothing of the others. Nothing is left where all shares are
/// round-off.
pub(super) fn root<T: Entry, const N: usize>(
    name: &'static str,
    a: &SMatrix<T, N, N>,
) -> Result<SMatrix<T, N, N>, ControlError> {
    semidefinite(name, a)?;
    let count = T::from_u32(u32::try_from(N).unwrap_or(u32::MAX));
    let mut rest = symmetrized(a);
    let mut half = SMatrix::<T, N, N>::zeros();
    let mut is_open = [true; N];
    for step in 0..N {
        // relative to what it was, since components have units of their own
        let (mut most, mut chosen) = (count * T::EPSILON, None);
        for (k, is_open) in is_open.iter().enumerate() {
            let share = rest[(k, k)] / a[(k, k)];
            if *is_open && a[(k, k)] > T::ZERO && share > most {
                (most, chosen) = (share, Some((k, rest[(k, k)], rest.column(k).into_owned())));
            }
        }
        let Some((chosen, pivot, column)) = chosen else { break };
        let size = pivot.sqrt();
        let column = column.map(|x| x / size);
        for (k, is_open) in is_open.iter_mut().enumerate() {
            *is_open &= k != chosen;
        }
        for ((of_column, scale), is_open) in rest.column_iter_mut().zip(&column).zip(&is_open) {
            if *is_open {
                of_column.into_iter().zip(&column).for_each(|(x, along)| *x -= *along * *scale);
            }
        }
        half.set_column(step, &column);
    }
    // by rotations of the columns
    Ok(with_more(SMatrix::zeros(), half))
}

#[cfg(test)]
mod tests {
    use super::super::draws::Draws;
    use super::*;
    use nalgebra::{matrix, vector};

    #[test]
    fn semidefinite_is_told_from_indefinite() {
        let fine = [
            matrix![0.0, 0.0; 0.0, 0.0],
            matrix![1.0, 1.0; 1.0, 1.0],
            matrix![0.0, 0.0; 0.0, 3.0],
            matrix![1e-12, 1e-6; 1e-6, 1.0],
            matrix![-1e-17, 0.0; 0.0, 1.0],
            matrix![1e300, 0.0; 0.0, 1e-300],
            // of rank one, whatever the units
            matrix![1e300, 1.0; 1.0, 1e-300],
        ];
        for a in fine {
            assert_eq!(semidefinite("a", &a), Ok(()), "{a}");
        }
        let wrong = [
            matrix![1.0, 2.0; 2.0, 1.0],
            matrix![0.0, 1.0; 1.0, 0.0],
            matrix![0.0, 1.0; 1.0, 5.0],
            matrix![1.0, 0.0; 0.0, -1e-3],
            matrix![-1.0, 0.0; 0.0, -1.0],
            // by its symmetric part
            matrix![1.0, 100.0; 0.0, 1.0],
            matrix![1.0, 0.0; 100.0, 1.0],
            // by components in small units
            matrix![1e6, 0.0; 0.0, -1e-4],
            matrix![1e12, 1e3; 1e3, 1e-9],
            matrix![1e200, 2.0; 2.0, 1e-200],
        ];
        for a in wrong {
            let refused = semidefinite("a", &a);
            assert!(matches!(refused, Err(ControlError::NotDefinite { matrix: "a", .. })), "{a} {refused:?}");
        }
        for bad in [f64::NAN, f64::INFINITY] {
            let refused = semidefinite("a", &matrix![1.0, bad; bad, 1.0]);
            assert!(matches!(refused, Err(ControlError::NotFinite { argument: "a", .. })));
        }
    }

    /// A sum of squares is semidefinite, whatever its rank and the scales in it.
    #[test]
    fn rounding_is_not_taken_for_indefiniteness() {
        let mut draws = Draws(1);
        let mut number = || <f32 as crate::Scalar>::from_f64(draws.draw() - 0.5);
        let scales = [1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0];
        for _ in 0..1000 {
            let half = SMatrix::<f32, 6, 2>::from_fn(|i, _| number() * scales[i]);
            assert_eq!(semidefinite("a", &(half * half.transpose())), Ok(()));
        }
    }

    /// Components that are nearly one, in every order and in units of their own: they are a covariance, and the squares of
    /// the root are the matrix, to the rounding of its diagonal.
    fn roots<T: Entry>() {
        let mut draws = Draws(1);
        let mut number = || T::from_f64(draws.draw() - 0.5);
        for exponent in 0..240 {
            let share = T::from_f64(2.0_f64.powf(-0.25 * f64::from(exponent)));
            for order in [[0, 1, 2, 3], [2, 1, 0, 3], [3, 0, 2, 1], [1, 2, 3, 0]] {
                let mut half = SMatrix::<T, 4, 4>::from_fn(|_, _| number());
                // of rank three; the second is the first but for a share, and the third but for a share what they differ by
                half.set_column(3, &SVector::<T, 4>::zeros());
                let second = half.row(0) + half.row(1) * share;
                let third = half.row(1) + half.row(2) * share;
                half.set_row(1, &second);
                half.set_row(2, &third);
                let half = SMatrix::<T, 4, 4>::from_fn(|i, j| half[(order[i], j)]);
                let a = symmetrized(&super::super::squares(&half));
                let lower = root("a", &a).unwrap();
                assert!((0..4).all(|i| (i + 1..4).all(|j| lower[(i, j)] == T::ZERO)), "{lower:?}");
                let off = super::super::squares(&lower) - a;
                for i in 0..4 {
                    for j in 0..4 {
                        let permitted = T::from_f64(32.0) * T::EPSILON * (a[(i, i)] * a[(j, j)]).sqrt();
                        assert!(
                            off[(i, j)].abs() <= permitted,
                            "{share:?} {order:?} {i} {j} {:?}",
                            off[(i, j)]
                        );
                    }
                }
                // in units of powers of two, the same digits
                let units = SVector::<T, 4>::from_fn(|i, _| T::from_f64([1.0, 1024.0, 0.25, 65536.0][i]));
                let scaled = SMatrix::<T, 4, 4>::from_fn(|i, j| a[(i, j)] * units[i] * units[j]);
                let expected = SMatrix::<T, 4, 4>::from_fn(|i, j| lower[(i, j)] * units[i]);
                assert_eq!(root("a", &scaled), Ok(expected));
            }
        }
    }

    #[test]
    fn the_squares_of_a_root_are_the_matrix() {
        roots::<f64>();
        roots::<f32>();
    }

    #[test]
    fn it_solves_and_refuses() {
        let a = matrix![4.0, 2.0, 1.0; 2.0, 5.0, 3.0; 1.0, 3.0, 6.0];
        let x = vector![1.0, -2.0, 0.5];
        let factors = Cholesky::new("a", &a).unwrap();
        assert!((factors.solve(&(a * x)) - x).norm() < 1e-14);
        let lower = root("a", &a).unwrap();
        assert!((lower * lower.transpose() - a).norm() < 1e-14);
        let indefinite = matrix![1.0, 2.0; 2.0, 1.0];
        assert_eq!(
            Cholesky::new("a", &indefinite).err(),
            Some(ControlError::NotDefinite { matrix: "a", pivot: -3.0 })
        );
    }
}
