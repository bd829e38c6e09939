//! Sizes of rows and columns, so that the entries of a matrix are compared without units.

use crate::{Real, Scalar};

/// How often rows and columns are brought to one size in turn.
const SWEEPS: u32 = 12;

/// Factors that bring rows and columns to one size: with them the largest entries of each are 1, nearly (Ruiz, A scaling
/// algorithm to equilibrate both rows and columns norms in matrices, RAL-TR-2001-034).
pub(super) struct Scales<T, const N: usize, const R: usize> {
    rows: [T; R],
    columns: [T; N],
}

impl<T: Real, const N: usize, const R: usize> Scales<T, N, R> {
    /// Those of the columns that count, and of the rows by these columns; what has none, by all.
    pub(super) fn of(matrix: &[[T; N]; R], counts: impl Fn(usize) -> bool) -> Self {
        let mut scales = Self { rows: [T::ONE; R], columns: [T::ONE; N] };
        for _ in 0..SWEEPS {
            let largest = scales.largest(matrix, &counts);
            for (scale, largest) in scales.rows.iter_mut().zip(largest.rows) {
                if largest > T::ZERO {
                    *scale = *scale / largest.sqrt();
                }
            }
            for (scale, largest) in scales.columns.iter_mut().zip(largest.columns) {
                if largest > T::ZERO {
                    *scale = *scale / largest.sqrt();
                }
            }
        }
        // what does not count, after the rest
        let by_others = scales.largest(matrix, |_| true);
        let own = scales.largest(matrix, &counts);
        for ((scale, largest), own) in scales.rows.iter_mut().zip(by_others.rows).zip(own.rows) {
            if own == T::ZERO && largest > T::ZERO {
                *scale = *scale / largest;
            }
        }
        let by_others = scales.largest(matrix, |_| true);
        for (column, (scale, largest)) in scales.columns.iter_mut().zip(by_others.columns).enumerate() {
            if !counts(column) && largest > T::ZERO {
                *scale = *scale / largest;
            }
        }
        scales
    }

    /// The size of an entry at a place.
    pub(super) fn size(&self, entry: T, (row, column): (usize, usize)) -> T {
        let by = |scales: &[T], index: usize| scales.get(index).copied().unwrap_or(T::ONE);
        (entry.abs() * by(&self.rows, row)) * by(&self.columns, column)
    }

    /// The largest sizes in each row, and in each column that counts.
    fn largest(&self, matrix: &[[T; N]; R], counts: impl Fn(usize) -> bool) -> Self {
        let mut largest = Self { rows: [T::ZERO; R], columns: [T::ZERO; N] };
        for (i, (row, in_row)) in matrix.iter().zip(&mut largest.rows).enumerate() {
            for (j, (entry, in_column)) in row.iter().zip(&mut largest.columns).enumerate() {
                if counts(j) {
                    let size = self.size(*entry, (i, j));
                    *in_row = Scalar::max(*in_row, size);
                    *in_column = Scalar::max(*in_column, size);
                }
            }
        }
        largest
    }
}
