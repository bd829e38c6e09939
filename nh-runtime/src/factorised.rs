//! A matrix with its factors, for right-hand sides that come one after the other.

use crate::Scalar;
use crate::linear::scale;

/// The factors of a matrix, by the same operations as [`solve_pivoted`](crate::linear::solve_pivoted), lane by lane.
#[derive(Clone, Copy, Debug)]
pub struct Factorised<T, const N: usize> {
    /// What is left of the rows above the diagonal, with multiples of the rows above below it.
    rows: [[T; N]; N],
    /// 1 where two rows were exchanged as they passed, by the earlier one.
    exchanges: [[T; N]; N],
}

impl<T: Scalar, const N: usize> Factorised<T, N> {
    /// The factors of a matrix; those of a singular one give solutions with components that are not finite.
    #[inline]
    #[must_use]
    #[allow(clippy::needless_range_loop)] // the indices of the formulas, all below N
    pub fn of(mut a: [[T; N]; N]) -> Self {
        let mut exchanges = [[T::ZERO; N]; N];
        let mut scales = [T::ZERO; N];
        for (s, row) in scales.iter_mut().zip(&a) {
            *s = scale(row);
        }
        for k in 0..N {
            for i in k + 1..N {
                let (ours, theirs) = (a[k][k].abs() * scales[k], a[i][k].abs() * scales[i]);
                let exchanged = |x: T, y: T| (theirs.select_gt(ours, y, x), theirs.select_gt(ours, x, y));
                for j in k..N {
                    (a[k][j], a[i][j]) = exchanged(a[k][j], a[i][j]);
                }
                (scales[k], scales[i]) = exchanged(scales[k], scales[i]);
                exchanges[k][i] = theirs.select_gt(ours, T::ONE, T::ZERO);
            }
            for i in k + 1..N {
                let factor = a[i][k] / a[k][k];
                for j in k + 1..N {
                    a[i][j] -= factor * a[k][j];
                }
                // rows below are exchanged from the next column on: what stands to the left stays
                a[i][k] = factor;
            }
        }
        Self { rows: a, exchanges }
    }

    /// The solution for a right-hand side.
    #[inline]
    #[must_use]
    #[allow(clippy::needless_range_loop)] // the indices of the formulas, all below N
    pub fn solve(&self, mut b: [T; N]) -> [T; N] {
        let Self { rows, exchanges } = self;
        for k in 0..N {
            for i in k + 1..N {
                let is_exchanged = exchanges[k][i];
                (b[k], b[i]) = (
                    is_exchanged.select_gt(T::ZERO, b[i], b[k]),
                    is_exchanged.select_gt(T::ZERO, b[k], b[i]),
                );
            }
            for i in k + 1..N {
                let reduced = rows[i][k] * b[k];
                b[i] -= reduced;
            }
        }
        for k in (0..N).rev() {
            let mut sum = b[k];
            for j in k + 1..N {
                sum -= rows[k][j] * b[j];
            }
            b[k] = sum / rows[k][k];
        }
        b
    }
}

#[cfg(test)]
mod tests {
    use super::Factorised;
    use crate::linear::solve_pivoted;

    /// Bit for bit, whatever rows are exchanged.
    #[test]
    fn solutions_are_those_of_one_elimination() {
        let mut seed = 1_u32;
        let mut next = || {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(seed >> 8) / f64::from(1_u32 << 23) - 1.0
        };
        for _ in 0..200 {
            let matrix: [[f64; 5]; 5] = core::array::from_fn(|_| core::array::from_fn(|_| next()));
            let factorised = Factorised::of(matrix);
            for _ in 0..3 {
                let right: [f64; 5] = core::array::from_fn(|_| next());
                let bits = |x: [f64; 5]| x.map(f64::to_bits);
                assert_eq!(bits(factorised.solve(right)), bits(solve_pivoted(matrix, right)));
            }
        }
    }

    #[test]
    fn what_is_singular_has_no_finite_solution() {
        let factorised = Factorised::of([[1.0, 2.0], [2.0, 4.0]]);
        assert!(factorised.solve([1.0, 1.0]).iter().any(|x: &f64| !x.is_finite()));
    }
}
