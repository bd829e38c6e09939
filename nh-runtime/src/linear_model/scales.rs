//! Sizes of rows and columns, so that the entries of a matrix are compared without units.

use crate::{Real, Scalar};

/// How often rows and columns are brought to one size in turn, at most.
const SWEEPS: u32 = 200;
/// How often units are found, without the entries that were small in the last ones.
const FITS: u32 = 4;
/// Changes of logarithms by which a sweep is the last one.
const SETTLED: f64 = 1e-2;

/// Factors of rows and columns with which the squares of the logarithms of the entries add up to the least (A. R. Curtis,
/// J. K. Reid, *On the automatic scaling of matrices for Gaussian elimination*, 1972). In other units of rows and columns
/// the sizes of the entries are the same: that is not so of factors that bring the largest entries to one size, of which
/// there are many.
#[derive(Clone, Copy)]
pub(super) struct Scales<T, const N: usize, const R: usize> {
    /// Logarithms of the factors.
    rows: [T; R],
    columns: [T; N],
}

impl<T: Real, const N: usize, const R: usize> Scales<T, N, R> {
    /// Those of the columns that count, and of the rows by these columns; then those of the others.
    pub(super) fn of(matrix: &[[T; N]; R], counts: impl Fn(usize) -> bool) -> Self {
        let logarithms = matrix.map(|row| row.map(|entry| (entry != T::ZERO).then(|| entry.abs().ln())));
        let mut scales = Self { rows: [T::ZERO; R], columns: [T::ZERO; N] };
        for _ in 0..SWEEPS {
            let by_rows = scales.set_rows(&logarithms, |_, column| counts(column));
            let by_columns = scales.set_columns(&logarithms, |_, column| counts(column));
            if Scalar::max(by_rows, by_columns) < T::from_f64(SETTLED) {
                break;
            }
        }
        let has_entry = |row: usize, is_meant: &dyn Fn(usize) -> bool| {
            logarithms.get(row).is_some_and(|row| {
                row.iter().enumerate().any(|(column, entry)| entry.is_some() && is_meant(column))
            })
        };
        let is_by_others = |row: usize| !has_entry(row, &counts);
        scales.set_columns(&logarithms, |row, column| !counts(column) && !is_by_others(row));
        scales.set_rows(&logarithms, |row, _| is_by_others(row));
        scales.set_columns(&logarithms, |_, column| !counts(column));
        scales
    }

    /// The size of an entry at a place.
    pub(super) fn size(&self, entry: T, (row, column): (usize, usize)) -> T {
        if entry == T::ZERO {
            return T::ZERO;
        }
        let by = |scales: &[T], index: usize| scales.get(index).copied().unwrap_or(T::ZERO);
        (entry.abs().ln() + by(&self.rows, row) + by(&self.columns, column)).exp()
    }

    /// Brings the mean of some entries of each row to 0; the largest change.
    fn set_rows(&mut self, logarithms: &[[Option<T>; N]; R], is_meant: impl Fn(usize, usize) -> bool) -> T {
        let mut most = T::ZERO;
        for (i, (row, scale)) in logarithms.iter().zip(&mut self.rows).enumerate() {
            let entries = row.iter().zip(&self.columns).enumerate().filter(|(j, _)| is_meant(i, *j));
            most = Scalar::max(
                most,
                settle(scale, entries.filter_map(|(_, (entry, by))| Some((*entry)? + *by))),
            );
        }
        most
    }

    /// The same of each column.
    fn set_columns(
        &mut self,
        logarithms: &[[Option<T>; N]; R],
        is_meant: impl Fn(usize, usize) -> bool,
    ) -> T {
        let mut most = T::ZERO;
        for (j, scale) in self.columns.iter_mut().enumerate() {
            let entries = logarithms.iter().zip(&self.rows).enumerate().filter(|(i, _)| is_meant(*i, j));
            let entries = entries.filter_map(|(_, (row, by))| Some(row.get(j).copied()?? + *by));
            most = Scalar::max(most, settle(scale, entries));
        }
        most
    }
}

impl<T: Real, const N: usize> Scales<T, N, N> {
    /// Those of the derivatives of rates by the same variables: a row is in the unit of its variable by the unit of time,
    /// a column in the inverse of the unit of its variable. The units are those with which the squares of the logarithms
    /// add up to the least; entries that are small in them say nothing of units, and are left out once more.
    pub(super) fn of_rates(matrix: &[[T; N]; N]) -> Self {
        let mut logarithms = matrix.map(|row| row.map(|entry| (entry != T::ZERO).then(|| entry.abs().ln())));
        let mut scales = Self { rows: [T::ZERO; N], columns: [T::ZERO; N] };
        let small = T::EPSILON.sqrt().ln();
        for _ in 0..FITS {
            scales.fit_units(&logarithms);
            let mut is_same = true;
            for (row, by_row) in logarithms.iter_mut().zip(&scales.rows) {
                for (entry, by_column) in row.iter_mut().zip(&scales.columns) {
                    let kept = entry.filter(|entry| *entry + *by_row + *by_column >= small);
                    is_same &= kept.is_some() == entry.is_some();
                    *entry = kept;
                }
            }
            if is_same {
                break;
            }
        }
        scales
    }

    fn fit_units(&mut self, logarithms: &[[Option<T>; N]; N]) {
        let logarithm = |row: usize, column: usize| logarithms.get(row)?.get(column).copied()?;
        let (mut units, mut time) = (self.columns, T::ZERO);
        for _ in 0..SWEEPS {
            let mut most = T::ZERO;
            for k in 0..N {
                let unit = |other: usize| units.get(other).copied().unwrap_or(T::ZERO);
                let others = || (0..N).filter(|other| *other != k);
                let in_row = others().filter_map(|j| Some(time - logarithm(k, j)? - unit(j)));
                let in_column = others().filter_map(|i| Some(logarithm(i, k)? - unit(i) - time));
                let mut next = unit(k);
                most = Scalar::max(most, settle(&mut next, in_row.chain(in_column)));
                if let Some(unit) = units.get_mut(k) {
                    *unit = next;
                }
            }
            let unit = |other: usize| units.get(other).copied().unwrap_or(T::ZERO);
            let all = (0..N).flat_map(|i| (0..N).map(move |j| (i, j)));
            let sizes = all.filter_map(|(i, j)| Some(unit(i) - logarithm(i, j)? - unit(j)));
            most = Scalar::max(most, settle(&mut time, sizes));
            if most < T::from_f64(SETTLED) {
                break;
            }
        }
        (self.rows, self.columns) = (units.map(|unit| -unit - time), units);
    }
}

/// Sets a scale to the negative of the mean, where there is one; by how much it changes.
fn settle<T: Real>(scale: &mut T, entries: impl Iterator<Item = T>) -> T {
    let (sum, count) = entries.fold((T::ZERO, T::ZERO), |(sum, count), entry| (sum + entry, count + T::ONE));
    if count == T::ZERO {
        return T::ZERO;
    }
    let before = core::mem::replace(scale, -sum / count);
    (*scale - before).abs()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// In other units sizes are the same.
    #[test]
    fn sizes_have_no_units() {
        let matrix = [[3.0, 0.0, -1e-3, 0.5], [0.2, 7.0, 0.0, 1e4], [0.0, 0.0, 2.0, -30.0]];
        let sizes = |matrix: &[[f64; 4]; 3]| {
            let scales = Scales::of(matrix, |column| column != 3);
            let size = |i: usize| [0, 1, 2, 3].map(|j: usize| scales.size(matrix[i][j], (i, j)));
            [0, 1, 2].map(size)
        };
        let plain = sizes(&matrix);
        for (rows, columns) in [([1e9, 1.0, 1e-12], [1e-7, 1e3, 1e15, 1e-20]), ([1e-100; 3], [1e90; 4])] {
            let mut scaled = matrix;
            for (row, by) in scaled.iter_mut().zip(rows) {
                for (entry, of) in row.iter_mut().zip(columns) {
                    *entry *= by * of;
                }
            }
            for (size, plain) in sizes(&scaled).iter().flatten().zip(plain.iter().flatten()) {
                assert!((size - plain).abs() <= 0.1 * plain, "{size} {plain}");
            }
        }
    }

    /// In other units of variables and of time sizes are the same; a variable that nothing feels but for rounding is told
    /// from one that is felt weakly.
    #[test]
    fn sizes_of_rates_have_no_units() {
        // x, angle that turns, their rates: (angle) is felt by rounding
        let matrix =
            [[0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0], [-9.0, 1e-113, -0.3, 0.4], [0.2, 0.0, 0.1, 0.0]];
        let sizes = |matrix: &[[f64; 4]; 4]| {
            let scales = Scales::of_rates(matrix);
            [0, 1, 2, 3].map(|i: usize| [0, 1, 2, 3].map(|j: usize| scales.size(matrix[i][j], (i, j))))
        };
        let plain = sizes(&matrix);
        assert!(plain[2][1] < 1e-20 && plain[2][0] > 1e-3, "{plain:?}");
        for (time, units) in [(1e-6, [1e-9, 1e9, 1.0, 1e3]), (1e12, [1e50, 1e-50, 1e20, 1.0])] {
            let mut scaled = matrix;
            for (row, of) in scaled.iter_mut().zip(units) {
                for (entry, by) in row.iter_mut().zip(units) {
                    *entry *= time * of / by;
                }
            }
            for (size, plain) in sizes(&scaled).iter().flatten().zip(plain.iter().flatten()) {
                assert!((size - plain).abs() <= 0.1 * plain, "{size} {plain}");
            }
        }
    }
}
