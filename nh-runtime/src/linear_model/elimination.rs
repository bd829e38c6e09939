//! Which variables linear equations determine, and by which others.

use super::scales::Scales;
use crate::{Real, Scalar};

/// What an entry may be off by, in units of its rounding and of what rounding of the variables makes of it.
const SAFETY: f64 = 32.0;
/// What is rounding of an entry beside the others of its row and its column, brought to one size, in units of the last
/// place.
const BESIDE_OTHERS: f64 = 4.0;

/// Neighbours of numbers, each on this side or that: where derivatives are the same but for their rounding.
pub(crate) fn beside<T: Real, const N: usize>(x: &[T; N]) -> [[T; N]; 2] {
    let unit = T::from_f64(2.0) * T::EPSILON;
    [0, 1].map(|pattern| {
        let mut place = 0_usize;
        x.map(|x| {
            place += 1;
            let step = unit * x;
            if (place >> pattern).is_multiple_of(2) { x + step } else { x - step }
        })
    })
}

/// Linear equations a x = b with what the entries of a may be off by.
pub(crate) struct Uncertain<T, const N: usize, const R: usize> {
    rows: [[T; N]; R],
    right: [T; R],
    errors: [[T; N]; R],
    /// By which entries of different units are compared.
    scales: Scales<T, N, R>,
}

impl<T: Real, const N: usize, const R: usize> Uncertain<T, N, R> {
    /// Equations whose entries are derivatives, with these derivatives at other roundings of the variables: by what they
    /// differ is rounding. Some columns count where sizes are compared.
    pub(crate) fn new<const K: usize>(
        rows: &[[T; N]; R],
        right: &[T; R],
        nearby: &[[[T; N]; R]; K],
        counts: impl Fn(usize) -> bool,
    ) -> Self {
        let at = |matrix: &[[T; N]; R], i: usize, j: usize| {
            matrix.get(i).and_then(|row| row.get(j)).copied().unwrap_or(T::ZERO)
        };
        let by_place = |value: &dyn Fn(usize, usize) -> T| -> [[T; N]; R] {
            core::array::from_fn(|i| core::array::from_fn(|j| value(i, j)))
        };
        let safety = T::from_f64(SAFETY);
        let own = by_place(&|i, j| {
            let entry = at(rows, i, j);
            let spread = nearby.iter().map(|other| (at(other, i, j) - entry).abs());
            // and numbers below the normal ones have lost their digits
            safety * (spread.fold(T::ZERO, Scalar::max) + T::EPSILON * entry.abs()) + T::MIN_POSITIVE
        });
        let certain = by_place(&|i, j| {
            let entry = at(rows, i, j);
            if entry.abs() > at(&own, i, j) { entry } else { T::ZERO }
        });
        let scales = Scales::of(&certain, counts);
        let beside_others = T::from_f64(BESIDE_OTHERS) * T::EPSILON;
        let errors = by_place(&|i, j| {
            let size = scales.size(T::ONE, (i, j));
            // what is compared with nothing is itself alone
            let least = if at(&certain, i, j) == T::ZERO { T::ZERO } else { beside_others / size };
            at(&own, i, j) + least
        });
        Self { rows: *rows, right: *right, errors, scales }
    }
}

/// Linear equations, each solved for one of the columns that may be solved for, as far as they are independent.
pub(crate) struct Reduced<T, const N: usize, const R: usize> {
    rows: [[T; N]; R],
    right: [T; R],
    errors: [[T; N]; R],
    /// The column that a row is solved for.
    pivots: [Option<usize>; R],
    /// By which entries of different units are compared.
    scales: Scales<T, N, R>,
}

/// Eliminates by Gauss and Jordan with complete pivoting, on rows and columns of one size. An entry that is not larger than
/// its error, which is carried along, is no pivot: so units matter to nothing. Columns may be solved for in the order of
/// their `phase`, or not at all; some rows before others.
pub(crate) fn reduce<T: Real, const N: usize, const R: usize>(
    equations: &Uncertain<T, N, R>,
    is_first: impl Fn(usize) -> bool,
    phase: impl Fn(usize) -> Option<u8>,
) -> Reduced<T, N, R> {
    let Uncertain { rows, right, errors, scales } = *equations;
    let mut reduced = Reduced { rows, right, errors, pivots: [None; R], scales };
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
        for (i, (row, errors)) in self.rows.iter().zip(&self.errors).enumerate() {
            if !self.is_open(i) {
                continue;
            }
            for (j, (entry, error)) in row.iter().zip(errors).enumerate() {
                let is_certain = entry.abs() > *error;
                if !is_certain || !is_meant(i, j) || self.is_pivot(j) {
                    continue;
                }
                let size = self.scales.size(*entry, (i, j));
                if best.is_none_or(|(_, _, largest)| size > largest) {
                    best = Some((i, j, size));
                }
            }
        }
        best.map(|(i, j, _)| (i, j))
    }

    fn eliminate(&mut self, row: usize, column: usize) {
        let (Some(pivot_row), Some(pivot_errors), Some(pivot_right)) =
            (self.rows.get(row).copied(), self.errors.get(row).copied(), self.right.get(row).copied())
        else {
            return;
        };
        let of = |list: &[T; N]| list.get(column).copied().unwrap_or(T::ONE);
        let (pivot, pivot_error) = (of(&pivot_row), of(&pivot_errors));
        let others = self.rows.iter_mut().zip(&mut self.errors).zip(&mut self.right).enumerate();
        for (_, ((other, errors), right)) in others.filter(|(i, _)| *i != row) {
            let (entry, error) = (of(other), of(errors));
            let factor = entry / pivot;
            let factor_error = error / pivot.abs() + factor.abs() * (pivot_error / pivot.abs());
            if factor == T::ZERO && factor_error == T::ZERO {
                continue;
            }
            for ((entry, error), (above, above_error)) in
                other.iter_mut().zip(errors.iter_mut()).zip(pivot_row.iter().zip(&pivot_errors))
            {
                let taken = factor * *above;
                let by_factor = factor_error * (above.abs() + *above_error);
                let rounding = T::EPSILON * Scalar::max(entry.abs(), taken.abs());
                *error = *error + by_factor + factor.abs() * *above_error + rounding;
                *entry -= taken;
            }
            if let (Some(entry), Some(error)) = (other.get_mut(column), errors.get_mut(column)) {
                (*entry, *error) = (T::ZERO, T::ZERO);
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

    /// The first column that moves along the family of solutions in which a column that is not solved for does.
    pub(crate) fn first_of_family(&self, column: usize) -> usize {
        (0..column).find(|other| self.depends(*other, column)).unwrap_or(column)
    }

    /// Whether what is solved for changes with a column that is not, by more than rounding.
    pub(crate) fn depends(&self, solved: usize, column: usize) -> bool {
        let row = self.pivots.iter().position(|pivot| *pivot == Some(solved));
        let of = |matrix: &[[T; N]; R]| matrix.get(row?).and_then(|row| row.get(column)).copied();
        of(&self.rows).zip(of(&self.errors)).is_some_and(|(entry, error)| entry.abs() > error)
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

    /// Equations of numbers that are as they stand.
    fn exact<const N: usize, const R: usize>(
        rows: [[f64; N]; R],
        right: [f64; R],
        phase: impl Fn(usize) -> Option<u8>,
    ) -> Reduced<f64, N, R> {
        let equations = Uncertain::new(&rows, &right, &[], |column| phase(column).is_some());
        reduce(&equations, |_| true, phase)
    }

    #[test]
    fn dependent_rows_are_left_open() {
        for units in [[1.0; 3], [1e9, 1.0, 1e-9], [1e-30, 1e20, 1e150]] {
            let rows = [[1.0, 2.0, 3.0], [2.0, 4.0, 6.0], [0.0, 1.0, 1.0]];
            let scaled = rows.map(|[x, y, z]| [x / units[0], y / units[1], z / units[2]]);
            let reduced = exact(scaled, [6.0, 12.0, 2.0], |column| (column < 2).then_some(0));
            assert_eq!((0..3).filter(|row| reduced.is_open(*row)).count(), 1);
            assert!(reduced.bound().is_none());
            // x = 6 − 2·2 at z = 0, and x + 2 y + 3 z, y + z stay as z grows
            let [x, y, z]: [f64; 3] = reduced.solution();
            let [x, y] = [x / units[0], y / units[1]];
            assert!((x - 2.0).abs() < 1e-14 && (y - 2.0).abs() < 1e-14 && z.abs() < 1e-300);
            let change = |column: usize| reduced.change(column, 2) * units[2] / units[column];
            assert!((change(0) + 1.0).abs() < 1e-14 && (change(1) + 1.0).abs() < 1e-14);
        }
    }

    #[test]
    fn what_may_not_be_solved_for_is_told() {
        let reduced = exact([[1.0, 0.0], [1.0, 1e-3]], [0.0; 2], |column| (column == 0).then_some(0));
        assert_eq!(reduced.bound(), Some(1));
        let in_order = exact([[1.0, 0.1]], [0.0], |column| Some(u8::from(column == 0)));
        assert!(in_order.is_pivot(1) && !in_order.is_pivot(0));
    }

    /// x + 2 z = 0, y = 0: whichever of x and z is solved for, x is the first that moves.
    #[test]
    fn families_are_named_by_their_first_column() {
        for unit in [1.0, 1e6, 1e-6] {
            let reduced = exact([[1.0, 0.0, 2.0 * unit], [0.0, 1.0, 0.0]], [0.0; 2], |_| Some(0));
            let open = (0..3).find(|column| !reduced.is_pivot(*column)).unwrap();
            assert_eq!(reduced.first_of_family(open), 0, "{unit}");
        }
        let alone = exact([[0.0, 1.0]], [0.0], |_| Some(0));
        assert_eq!(alone.first_of_family(0), 0);
    }

    /// A derivative that is all rounding, alone in its row and its column, and a small one that is not.
    #[test]
    fn rounding_is_told_from_small_derivatives() {
        let rows = [[1.0, 0.0], [0.0, 1.2e-16]];
        let elsewhere = [[1.0, 0.0], [0.0, -3e-16]];
        for (nearby, pivots) in [(elsewhere, 1), (rows, 2)] {
            let equations = Uncertain::new(&rows, &[1.0; 2], &[nearby], |_| true);
            let reduced = reduce(&equations, |_| true, |_| Some(0));
            assert_eq!((0..2).filter(|column| reduced.is_pivot(*column)).count(), pivots);
        }
    }
}
