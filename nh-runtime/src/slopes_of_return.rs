//! The derivative of a return to position constraints, from those of its two steps.

use crate::Scalar;

/// The derivatives, by rows, of a state that is returned by one step of positions, x + δ(x), and one of velocities, at the
/// next positions: from the derivatives of δ by the state, and from those of the change of velocities by the state with
/// these positions; or of the next velocities by the positions, by the velocities where the step starts, and by the present
/// ones, which are the same, with what follows. What follows the velocities in the state stays as it is.
#[must_use]
pub fn slopes_of_return<T: Scalar, const N: usize, const X: usize, const Y: usize, const W: usize>(
    of_positions: &[[T; N]; X],
    of_velocities: &[[T; W]; Y],
) -> [[T; N]; N] {
    let mut all = [[T::ZERO; N]; N];
    for (i, row) in all.iter_mut().enumerate() {
        if let Some(own) = row.get_mut(i) {
            *own = T::ONE;
        }
    }
    for (row, moved) in all.iter_mut().zip(of_positions) {
        for (entry, moved) in row.iter_mut().zip(moved) {
            *entry += *moved;
        }
    }
    let (positions, rest) = all.split_at_mut(X.min(N));
    for (row, by) in rest.iter_mut().zip(of_velocities) {
        let (by_positions, by_rest) = by.split_at(X.min(W));
        let (by_started, by_present) = by_rest.split_at(W.saturating_sub(N).min(by_rest.len()));
        if !by_started.is_empty() {
            *row = [T::ZERO; N];
        }
        for (by, position) in by_positions.iter().zip(positions.iter()) {
            for (entry, x) in row.iter_mut().zip(position) {
                *entry = by.mul_add(*x, *entry);
            }
        }
        for by in [by_started, by_present] {
            for (entry, by) in row.iter_mut().skip(X).zip(by) {
                *entry += *by;
            }
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two positions, two velocities, and a component behind them that stays.
    #[test]
    fn velocities_follow_the_positions_that_were_moved() {
        let of_positions = [[-0.5, -0.5, 0.0, 0.0, 0.0], [-0.5, -0.5, 0.0, 0.0, 0.0]];
        // changes of the velocities: by the positions, by the velocities, by what follows
        let changes = [[2.0, 0.0, -0.5, -0.5, 0.25], [0.0, 3.0, -0.5, -0.5, 0.0]];
        let found: [[f64; 5]; 5] = slopes_of_return(&of_positions, &changes);
        let expected = [
            [0.5, -0.5, 0.0, 0.0, 0.0],
            [-0.5, 0.5, 0.0, 0.0, 0.0],
            [1.0, -1.0, 0.5, -0.5, 0.25],
            [-1.5, 1.5, -0.5, 0.5, 0.0],
            [0.0, 0.0, 0.0, 0.0, 1.0],
        ];
        assert_eq!(found, expected);
        // the next velocities: by the positions, by those of the start, by the present ones, by what follows
        let next = [[2.0, 0.0, 1.0, 0.0, -0.5, -0.5, 0.25], [0.0, 3.0, 0.0, 1.0, -0.5, -0.5, 0.0]];
        assert_eq!(slopes_of_return::<f64, 5, 2, 2, 7>(&of_positions, &next), expected);
        // none are moved
        let of_positions = [[-0.5, -0.5, 0.0], [-0.5, -0.5, 0.0]];
        let alone: [[f64; 3]; 3] = slopes_of_return(&of_positions, &[[0.0; 3]; 0]);
        assert_eq!(alone, [[0.5, -0.5, 0.0], [-0.5, 0.5, 0.0], [0.0, 0.0, 1.0]]);
        // positions move with the velocities, and with what follows
        let of_positions = [[-0.5, 0.125, 0.0625]];
        let found: [[f64; 3]; 3] = slopes_of_return(&of_positions, &[[2.0, -1.0, 0.5]]);
        assert_eq!(found, [[0.5, 0.125, 0.0625], [1.0, 0.25, 0.625], [0.0, 0.0, 1.0]]);
    }
}
