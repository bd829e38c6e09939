//! Which variables linear equations determine, and by which others.

use crate::Real;

/// Entries of a row beside its largest that are taken for rounding, in units of the last place.
const ROUNDING: f64 = 256.0;

/// Linear equations a x = b, each solved for one of the columns that may be solved for, as far as they are independent.
pub(crate) struct Reduced<T, const N: usize, const R: usize> {
    rows: [[T; N]; R],
    right: [T; R],
    /// The column that a row is solved for.
    pivots: [Option<usize>; R],
}

/// Eliminates by Gauss and Jordan with complete pivoting, on rows of one size. Columns may be solved for in the order
/// of their `phase`, or not at all.
pub(crate) fn reduce<T: Real, const N: usize, const R: usize>(
    rows: &[[T; N]; R],
    right: &[T; R],
    phase: impl Fn(usize) -> Option<u8>,
) -> Reduced<T, N, R> {
    reduce_in_order(rows, right, |_| true, phase)
}

/// The same with rows that are solved before the others.
pub(crate) fn reduce_in_order<T: Real, const N: usize, const R: usize>(
    rows: &[[T; N]; R],
    right: &[T; R],
    is_first: impl Fn(usize) -> bool,
    phase: impl Fn(usize) -> Option<u8>,
) -> Reduced<T, N, R> {
    let mut reduced = Reduced { rows: *rows, right: *right, pivots: [None; R] };
    for (row, right) in reduced.rows.iter_mut().zip(&mut reduced.right) {
        let largest = row.iter().fold(T::ZERO, |largest, x| largest.max(x.abs()));
        if largest > T::ZERO {
            for entry in row.iter_mut() {
                *entry = *entry / largest;
            }
            *right = *right / largest;
        }
    }
    let last = (0..N).filter_map(&phase).max().map_or(0, |last| last + 1);
    for (are_all, present) in [false, true].into_iter().flat_map(|all| (0..last).map(move |p| (all, p))) {
        let is_meant =
            |row: usize, column: usize| (are_all || is_first(row)) && phase(column) == Some(present);
        while let Some((row, column)) = reduced.largest(is_meant) {
            reduced.eliminate(row, column);
        }
    }
    reduced
}

impl<T: Real, const N: usize, const R: usize> Reduced<T, N, R> {
    /// The largest entry that is not rounding, in a row that is not solved, among some entries.
    fn largest(&self, is_meant: impl Fn(usize, usize) -> bool) -> Option<(usize, usize)> {
        let mut best: Option<(usize, usize, T)> = None;
        for (i, row) in self.rows.iter().enumerate().filter(|(i, _)| self.is_open(*i)) {
            for (j, entry) in row.iter().enumerate().filter(|(j, _)| is_meant(i, *j) && !self.is_pivot(*j)) {
                if best.is_none_or(|(_, _, size)| entry.abs() > size) {
                    best = Some((i, j, entry.abs()));
                }
            }
        }
        best.filter(|(_, _, size)| *size > T::from_f64(ROUNDING) * T::EPSILON).map(|(i, j, _)| (i, j))
    }

    fn eliminate(&mut self, row: usize, column: usize) {
        let (Some(pivot_row), Some(pivot_right)) =
            (self.rows.get(row).copied(), self.right.get(row).copied())
        else {
            return;
        };
        let pivot = pivot_row.get(column).copied().unwrap_or(T::ONE);
        for (i, (other, right)) in self.rows.iter_mut().zip(&mut self.right).enumerate() {
            let factor = other.get(column).copied().unwrap_or(T::ZERO) / pivot;
            if i == row || factor == T::ZERO {
                continue;
            }
            for (entry, above) in other.iter_mut().zip(&pivot_row) {
                *entry -= factor * *above;
            }
            if let Some(entry) = other.get_mut(column) {
                *entry = T::ZERO;
            }
            *right -= factor * pivot_right;
        }
        if let Some(solved) = self.pivots.get_mut(row) {
            *solved = Some(column);
        }
    }

    /// Whether a row is solved for nothing.
    pub(crate) fn is_open(&self, row: usize) -> bool {
        self.pivots.get(row).is_some_and(Option::is_none)
    }

    /// Whether a row is solved for the column.
    pub(crate) fn is_pivot(&self, column: usize) -> bool {
        self.pivots.contains(&Some(column))
    }

    /// The column with the largest entry that is not rounding in a row that could not be solved.
    pub(crate) fn bound(&self) -> Option<usize> {
        self.largest(|_, _| true).map(|(_, column)| column)
    }

    /// By how much what is solved for changes with a column that is not.
    pub(crate) fn change(&self, solved: usize, column: usize) -> T {
        let row = self.pivots.iter().position(|pivot| *pivot == Some(solved));
        let Some(row) = row.and_then(|row| self.rows.get(row)) else { return T::ZERO };
        match (row.get(column), row.get(solved)) {
            (Some(entry), Some(pivot)) => -*entry / *pivot,
            _ => T::ZERO,
        }
    }

    /// What is solved for, with zero for all other columns.
    pub(crate) fn solution(&self) -> [T; N] {
        let mut solution = [T::ZERO; N];
        for ((row, right), pivot) in self.rows.iter().zip(&self.right).zip(&self.pivots) {
            let Some(column) = *pivot else { continue };
            if let (Some(x), Some(pivot)) = (solution.get_mut(column), row.get(column)) {
                *x = *right / *pivot;
            }
        }
        solution
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dependent_rows_are_left_open() {
        let rows = [[1.0, 2.0, 3.0], [2.0, 4.0, 6.0], [0.0, 1.0, 1.0]];
        let reduced = reduce(&rows, &[6.0, 12.0, 2.0], |column| (column < 2).then_some(0));
        assert_eq!((0..3).filter(|row| reduced.is_open(*row)).count(), 1);
        assert!(reduced.bound().is_none());
        // x = 6 − 2·2 at z = 0, and x + 2 y + 3 z, y + z stay as z grows
        let [x, y, z]: [f64; 3] = reduced.solution();
        assert!((x - 2.0).abs() < 1e-14 && (y - 2.0).abs() < 1e-14 && z.abs() < 1e-300);
        assert!((reduced.change(0, 2) + 1.0).abs() < 1e-14 && (reduced.change(1, 2) + 1.0).abs() < 1e-14);
    }

    #[test]
    fn what_may_not_be_solved_for_is_told() {
        let reduced = reduce(&[[1.0, 0.0], [1.0, 1e-3]], &[0.0; 2], |column| (column == 0).then_some(0));
        assert_eq!(reduced.bound(), Some(1));
        let in_order = reduce(&[[1.0, 0.1]], &[0.0], |column| Some(u8::from(column == 0)));
        assert!(in_order.is_pivot(1) && !in_order.is_pivot(0));
    }
}
