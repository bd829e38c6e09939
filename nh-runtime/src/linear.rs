//! Small dense linear systems on the stack, by Gaussian elimination with scaled partial pivoting
//! (Golub, Van Loan, Matrix Computations, 3.4.4 and 3.5.2).
//!
//! Rows are exchanged as they pass rather than after a search: no index depends on data, so there
//! is nothing that could be out of bounds, and the same code works for lanes that pivot differently.

use core::ops::{Div, Mul, Sub, SubAssign};

use crate::complex::Complex;
use crate::{Dim, Real, Scalar};

/// A number that matrices are made of: real or complex.
pub(crate) trait Entry:
    Copy + 'static + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + SubAssign
{
    /// Its real numbers.
    type Real: Real;
    /// Zero.
    const NOUGHT: Self;
    /// A bound of the absolute value, at most twice of it.
    fn size(self) -> Self::Real;
}

impl<T: Real> Entry for T {
    type Real = T;
    const NOUGHT: T = T::ZERO;
    #[inline]
    fn size(self) -> T {
        self.abs()
    }
}

impl<T: Real> Entry for Complex<T> {
    type Real = T;
    const NOUGHT: Self = Self { re: T::ZERO, im: T::ZERO };
    #[inline]
    fn size(self) -> T {
        self.re.abs() + self.im.abs()
    }
}

/// The largest absolute value of a row, inverted.
#[inline]
fn scale<T: Scalar>(row: &[T]) -> T {
    row.iter().fold(T::ZERO, |largest, x| largest.max(x.abs())).recip()
}

/// Solves a x = b. A singular matrix gives a solution with components that are not finite.
///
/// Works lane by lane: there is no branch on a number.
#[inline]
#[must_use]
#[allow(clippy::needless_range_loop)] // the indices of the formulas, all below N
pub fn solve_pivoted<T: Scalar, const N: usize>(mut a: [[T; N]; N], mut b: [T; N]) -> [T; N] {
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
            (b[k], b[i]) = exchanged(b[k], b[i]);
            (scales[k], scales[i]) = exchanged(scales[k], scales[i]);
        }
        for i in k + 1..N {
            let factor = a[i][k] / a[k][k];
            for j in k + 1..N {
                a[i][j] -= factor * a[k][j];
            }
            let reduced = factor * b[k];
            b[i] -= reduced;
        }
    }
    for k in (0..N).rev() {
        let mut sum = b[k];
        for j in k + 1..N {
            sum -= a[k][j] * b[j];
        }
        b[k] = sum / a[k][k];
    }
    b
}

/// The inverse, column by column of the identity: what every order of a series is solved with.
/// A singular matrix gives entries that are not finite.
#[inline]
#[must_use]
pub fn inverse_pivoted<T: Scalar, const N: usize>(a: [[T; N]; N]) -> [[T; N]; N] {
    let mut inverse = [[T::ZERO; N]; N];
    for column in 0..N {
        let mut unit = [T::ZERO; N];
        unit[column] = T::ONE;
        for (row, entry) in inverse.iter_mut().zip(solve_pivoted(a, unit)) {
            row[column] = entry;
        }
    }
    inverse
}

/// The product of a matrix and a vector.
#[inline]
#[must_use]
pub fn times<T: Scalar, const N: usize>(a: &[[T; N]; N], b: [T; N]) -> [T; N] {
    let mut product = [T::ZERO; N];
    for (sum, row) in product.iter_mut().zip(a) {
        for (a, b) in row.iter().zip(b) {
            *sum = a.mul_add(b, *sum);
        }
    }
    product
}

/// A factorization P A = L U: L below the diagonal of `lu`, U on and above it.
#[derive(Clone, Copy)]
pub(crate) struct Factors<Dm: Dim, F: Copy + 'static> {
    lu: Dm::Mat<F>,
    /// The row of A that each row of L U stands for.
    rows: Dm::Vec<usize>,
}

impl<Dm: Dim, F: Entry> Factors<Dm, F> {
    /// Factorizes `a`. A singular matrix gives solutions with components that are not finite, and so does one with entries that
    /// are not: divided by infinity, what is left of an equation would be nothing, and count as solved.
    pub(crate) fn new(a: &Dm::Mat<F>) -> Self {
        let mut lu = *a;
        let mut rows = Dm::vec(0_usize);
        let mut scales = Dm::vec(F::Real::ZERO);
        let numbered = rows.as_mut().iter_mut().zip(scales.as_mut());
        for (i, ((row, s), a)) in numbered.zip(lu.as_mut()).enumerate() {
            *row = i;
            *s = a.as_ref().iter().fold(F::Real::ZERO, |largest, x| largest.max(x.size())).recip();
            if *s == F::Real::ZERO {
                // infinite entries become no numbers
                a.as_mut().iter_mut().for_each(|x| *x = *x * F::NOUGHT);
            }
        }
        for k in 0..Dm::N {
            let mut below = lu.as_mut().iter_mut().skip(k);
            let mut rows_below = rows.as_mut().iter_mut().skip(k);
            let mut scales_below = scales.as_mut().iter_mut().skip(k);
            let (Some(pivot), Some(row), Some(s)) = (below.next(), rows_below.next(), scales_below.next())
            else {
                break;
            };
            // bring the largest entry of the column, relative to its row, to the pivot
            for ((other, other_row), other_s) in below.zip(rows_below).zip(scales_below) {
                if entry(other, k).size() * *other_s > entry(pivot, k).size() * *s {
                    core::mem::swap(pivot, other);
                    core::mem::swap(row, other_row);
                    core::mem::swap(s, other_s);
                }
            }
            let pivot = *pivot;
            for other in lu.as_mut().iter_mut().skip(k + 1) {
                let factor = entry(other, k) / entry(&pivot, k);
                let mut tail = other.as_mut().iter_mut().zip(pivot.as_ref()).skip(k);
                if let Some((head, _)) = tail.next() {
                    *head = factor;
                }
                for (x, p) in tail {
                    *x -= factor * *p;
                }
            }
        }
        Self { lu, rows }
    }

    /// The sign of the determinant; 0 where a pivot is not above `least` in size, or not a number.
    pub(crate) fn sign(&self, least: F) -> i8
    where
        F: Real,
    {
        let mut sign = 1;
        for (k, lu) in self.lu.as_ref().iter().enumerate() {
            let pivot = entry(lu, k);
            sign *= i8::from(pivot > least) - i8::from(pivot < -least);
        }
        let rows = self.rows.as_ref();
        let later = |(k, row): (usize, &usize)| rows.iter().skip(k + 1).filter(|other| *other < row).count();
        let exchanges: usize = rows.iter().enumerate().map(later).sum();
        if exchanges.is_multiple_of(2) { sign } else { -sign }
    }

    /// The solution of A x = b.
    pub(crate) fn solve(&self, b: &Dm::Vec<F>) -> Dm::Vec<F> {
        let mut x = Dm::vec(F::NOUGHT);
        for (i, (lu, &row)) in self.lu.as_ref().iter().zip(self.rows.as_ref()).enumerate() {
            let known = lu.as_ref().iter().zip(x.as_ref()).take(i);
            let sum = known.fold(entry(b, row), |sum, (l, x)| sum - *l * *x);
            if let Some(x) = x.as_mut().get_mut(i) {
                *x = sum;
            }
        }
        for (i, lu) in self.lu.as_ref().iter().enumerate().rev() {
            let known = lu.as_ref().iter().zip(x.as_ref()).skip(i + 1);
            let sum = known.fold(entry(&x, i), |sum, (u, x)| sum - *u * *x);
            if let Some(x) = x.as_mut().get_mut(i) {
                *x = sum / entry(lu, i);
            }
        }
        x
    }
}

/// The component of an array; there is always one.
#[inline]
fn entry<F: Entry, V: AsRef<[F]>>(v: &V, i: usize) -> F {
    v.as_ref().get(i).copied().unwrap_or(F::NOUGHT)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::D;

    /// A reproducible number in [−1, 1).
    fn random(seed: &mut u64) -> f64 {
        *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        f64::from((*seed >> 32) as u32) / 2_147_483_648.0 - 1.0
    }

    #[test]
    fn both_solvers_solve() {
        let mut seed = 1;
        for _ in 0..200 {
            let a: [[f64; 6]; 6] = core::array::from_fn(|_| core::array::from_fn(|_| random(&mut seed)));
            let x: [f64; 6] = core::array::from_fn(|_| random(&mut seed));
            let b = a.map(|row| row.iter().zip(&x).map(|(a, x)| a * x).sum::<f64>());
            for solution in [solve_pivoted(a, b), Factors::<D<6>, f64>::new(&a).solve(&b)] {
                for (s, x) in solution.iter().zip(&x) {
                    assert!((s - x).abs() < 1e-9, "{s} {x}");
                }
            }
        }
    }

    #[test]
    fn saddle_systems_and_bad_scales_need_pivots() {
        let a = [[0.0, 1.0, 2.0], [1.0, 0.0, 0.0], [1e20, 1e20, -1e20]];
        let b = [8.0, 1.0, 0.0];
        for x in [solve_pivoted(a, b), Factors::<D<3>, f64>::new(&a).solve(&b)] {
            assert!((x[0] - 1.0).abs() < 1e-14, "{x:?}");
            assert!((x[1] - 2.0).abs() < 1e-14 && (x[2] - 3.0).abs() < 1e-14, "{x:?}");
        }
    }

    #[test]
    fn complex_systems_are_solved() {
        let c = |re, im| Complex { re, im };
        let a = [[c(0.0, 0.0), c(1.0, 1.0)], [c(2.0, -1.0), c(0.0, 3.0)]];
        let x = [c(1.0, -2.0), c(0.5, 4.0)];
        let b = a.map(|row| row[0] * x[0] + row[1] * x[1]);
        for (s, x) in Factors::<D<2>, Complex<f64>>::new(&a).solve(&b).into_iter().zip(x) {
            assert!((s - x).size() < 1e-14, "{s:?} {x:?}");
        }
    }

    #[test]
    fn determinants_have_signs() {
        let sign = |a| Factors::<D<3>, f64>::new(&a).sign(1e-15);
        assert_eq!(sign([[1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 3.0]]), 1);
        assert_eq!(sign([[0.0, 2.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 3.0]]), -1);
        assert_eq!(sign([[0.0, 2.0, 0.0], [0.0, 0.0, 3.0], [1.0, 0.0, 0.0]]), 1);
        assert_eq!(sign([[0.0, 2.0, 0.0], [0.0, 0.0, -3.0], [1.0, 0.0, 0.0]]), -1);
        assert_eq!(sign([[1.0, 2.0, 0.0], [2.0, 4.0, 0.0], [0.0, 0.0, 1.0]]), 0);
    }

    #[test]
    fn infinite_entries_leave_no_solution() {
        let infinite = f64::INFINITY;
        for a in [
            [[infinite, 0.0], [0.0, 1.0]],
            [[1.0, -infinite], [0.0, 1.0]],
            [[1.0, 0.0], [infinite, 1.0]],
            [[1.0, 2.0], [3.0, f64::NAN]],
        ] {
            let x = Factors::<D<2>, f64>::new(&a).solve(&[1.0, 1.0]);
            assert!(x.iter().any(|x| !x.is_finite()), "{a:?}: {x:?}");
        }
    }

    #[test]
    fn singular_matrices_are_not_hidden() {
        for a in [[[1.0, 2.0], [2.0, 4.0]], [[0.0, 0.0], [1.0, 1.0]], [[0.0, 1.0], [0.0, 2.0]]] {
            for x in [solve_pivoted(a, [1.0, 1.0]), Factors::<D<2>, f64>::new(&a).solve(&[0.0, 0.0])] {
                assert!(x.iter().any(|x: &f64| !x.is_finite()), "{a:?} {x:?}");
            }
        }
    }
}
