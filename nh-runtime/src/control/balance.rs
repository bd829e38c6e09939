//! Units of components in which a matrix is of one size.

use nalgebra::{SMatrix, SVector};

use super::Entry;
use crate::Scalar;

/// Sweeps over the components; each brings a unit of a chain one component further at least.
const MOST_SWEEPS: usize = 64;

/// D⁻¹ A D and D, diagonal and of powers of two, such that rows and columns beside the diagonal are of one size up to a
/// factor of two (Parlett, Reinsch, Numer. Math. 13 (1969) 293–304): how often a matrix is squared, and what is round-off
/// in it, should not depend on the units of its components. Those that nothing depends on, as a place on the speed alone,
/// and those that depend on nothing have one of both: that becomes a share of 1.
pub(super) fn balanced<T: Entry, const N: usize>(a: &SMatrix<T, N, N>) -> (SMatrix<T, N, N>, SVector<T, N>) {
    let (mut a, mut units) = (*a, SVector::<T, N>::repeat(T::ONE));
    for _ in 0..MOST_SWEEPS {
        let mut has_changed = false;
        for (k, of_component) in units.iter_mut().enumerate() {
            let (row, column) = sizes(&a, k);
            let unit = unit(row, column);
            let next = *of_component * unit;
            if unit == T::ONE || !(next.is_finite() && next.recip().is_finite()) {
                continue;
            }
            has_changed = true;
            *of_component = next;
            each_beside(&mut a, k, |x| *x *= unit, |x| *x = *x / unit);
        }
        if !has_changed {
            break;
        }
    }
    (a, units)
}

/// The largest entries of row and column k beside the diagonal.
fn sizes<T: Entry, const N: usize>(a: &SMatrix<T, N, N>, k: usize) -> (T, T) {
    let (mut row, mut column) = (T::ZERO, T::ZERO);
    let mut a = *a;
    each_beside(&mut a, k, |x| column = column.max(Scalar::abs(*x)), |x| row = row.max(Scalar::abs(*x)));
    (row, column)
}

/// Visits the entries of column k and those of row k beside the diagonal. Entries are not asked for by their places,
/// which the compiler would have to prove to exist.
fn each_beside<T: Entry, const N: usize>(
    a: &mut SMatrix<T, N, N>,
    k: usize,
    mut of_column: impl FnMut(&mut T),
    mut of_row: impl FnMut(&mut T),
) {
    for (j, mut column) in a.column_iter_mut().enumerate() {
        for (i, x) in column.iter_mut().enumerate().filter(|(i, _)| *i != j) {
            if j == k {
                of_column(x);
            } else if i == k {
                of_row(x);
            }
        }
    }
}

/// The power of two by which a column grows and its row shrinks, so that both are of one size up to a factor of two, and
/// one without the other more than 1/8 and at most 1/4: not so large that it would have to be halved.
fn unit<T: Entry>(row: T, column: T) -> T {
    let mut unit = T::ONE;
    let (two, four, quarter) = (T::from_f64(2.0), T::from_f64(4.0), T::from_f64(0.25));
    if row > T::ZERO && column > T::ZERO {
        // row/unit and column·unit, in steps of two: no square, which may be out of range
        let (mut row, mut column) = (row, column);
        while row / column >= four {
            (row, column, unit) = (row / two, column * two, unit * two);
        }
        while column / row >= four {
            (row, column, unit) = (row * two, column / two, unit / two);
        }
    } else if row > T::ZERO || column > T::ZERO {
        let mut size = if row > T::ZERO { row } else { column };
        while size > quarter {
            (size, unit) = (size / two, unit * two);
        }
        while size + size <= quarter {
            (size, unit) = (size * two, unit / two);
        }
        if column > T::ZERO {
            unit = unit.recip();
        }
    }
    unit
}

/// D⁻¹ S D⁻¹ of a symmetric matrix.
pub(super) fn in_units<T: Entry, const N: usize>(
    mut s: SMatrix<T, N, N>,
    units: &SVector<T, N>,
) -> SMatrix<T, N, N> {
    for (mut column, of_column) in s.column_iter_mut().zip(units) {
        column.iter_mut().zip(units).for_each(|(x, of_row)| *x = *x / *of_row / *of_column);
    }
    s
}

/// D S D of a symmetric matrix.
pub(super) fn out_of_units<T: Entry, const N: usize>(
    mut s: SMatrix<T, N, N>,
    units: &SVector<T, N>,
) -> SMatrix<T, N, N> {
    for (mut column, of_column) in s.column_iter_mut().zip(units) {
        column.iter_mut().zip(units).for_each(|(x, of_row)| *x = *x * *of_row * *of_column);
    }
    s
}

/// D A D⁻¹.
pub(super) fn restored<T: Entry, const N: usize>(
    mut a: SMatrix<T, N, N>,
    units: &SVector<T, N>,
) -> SMatrix<T, N, N> {
    for (mut column, of_column) in a.column_iter_mut().zip(units) {
        // what is zero stays so where the quotient is out of range
        for (x, of_row) in column.iter_mut().zip(units).filter(|(x, _)| **x != T::ZERO) {
            *x *= *of_row / *of_column;
        }
    }
    a
}
