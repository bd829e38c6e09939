//! Units of components in which a matrix is of one size.

use nalgebra::{SMatrix, SVector};

use super::Entry;
use crate::Scalar;

/// Sweeps over the components; each brings a unit of a chain one component further at least.
const MOST_SWEEPS: usize = 64;

/// D⁻¹ A D and D, diagonal and of powers of two, such that rows and columns beside the diagonal are of one size up to a
/// factor of two (Parlett, Reinsch, Numer. Math. 13 (1969) 293–304): how often a matrix is squared, and what is round-off
/// in it, should not depend on the units of its components.
pub(super) fn balanced<T: Entry, const N: usize>(a: &SMatrix<T, N, N>) -> (SMatrix<T, N, N>, SVector<T, N>) {
    let (mut a, mut units) = (*a, SVector::repeat(T::ONE));
    for _ in 0..MOST_SWEEPS {
        let mut has_changed = false;
        for k in 0..N {
            let other = |sum: T, i: usize, x: T| if i == k { sum } else { sum.max(Scalar::abs(x)) };
            let row = (0..N).fold(T::ZERO, |sum, i| other(sum, i, a[(k, i)]));
            let column = (0..N).fold(T::ZERO, |sum, i| other(sum, i, a[(i, k)]));
            let unit = unit(row, column);
            let next = units[k] * unit;
            if unit == T::ONE || !(next.is_finite() && next.recip().is_finite()) {
                continue;
            }
            has_changed = true;
            units[k] = next;
            for i in (0..N).filter(|i| *i != k) {
                a[(i, k)] *= unit;
                a[(k, i)] = a[(k, i)] / unit;
            }
        }
        if !has_changed {
            break;
        }
    }
    (a, units)
}

/// The power of two by which a column grows and its row shrinks, so that both are of one size up to a factor of two.
fn unit<T: Entry>(row: T, column: T) -> T {
    let mut unit = T::ONE;
    if row > T::ZERO && column > T::ZERO {
        let (two, four) = (T::from_f64(2.0), T::from_f64(4.0));
        // row/unit and column·unit, in steps of two: no square, which may be out of range
        let (mut row, mut column) = (row, column);
        while row / column >= four {
            (row, column, unit) = (row / two, column * two, unit * two);
        }
        while column / row >= four {
            (row, column, unit) = (row * two, column / two, unit / two);
        }
    }
    unit
}

/// The rows of a matrix, divided by units.
pub(super) fn in_units<T: Entry, const N: usize, const M: usize>(
    a: &SMatrix<T, N, M>,
    units: &SVector<T, N>,
) -> SMatrix<T, N, M> {
    SMatrix::from_fn(|i, j| a[(i, j)] / units[i])
}

/// D A D⁻¹.
pub(super) fn restored<T: Entry, const N: usize>(
    a: &SMatrix<T, N, N>,
    units: &SVector<T, N>,
) -> SMatrix<T, N, N> {
    // what is zero stays so where the quotient is out of range
    SMatrix::from_fn(|i, j| if a[(i, j)] == T::ZERO { T::ZERO } else { a[(i, j)] * (units[i] / units[j]) })
}
