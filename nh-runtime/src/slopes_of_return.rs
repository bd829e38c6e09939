//! The derivative of a return to position constraints, from those of its two steps.

use crate::Scalar;

/// The derivatives, by rows, of a state that is returned by one step of positions, x + δ(x), and one of velocities, at the
/// next positions: from the derivatives of δ, and from those of the change of velocities by positions and velocities; or of
/// the next velocities by the positions, by the velocities where the step starts and by the present ones, which are the
/// same. What follows in the state stays as it is.
#[must_use]
pub fn slopes_of_return<T: Scalar, const N: usize, const X: usize, const Y: usize, const W: usize>(
    of_positions: &[[T; X]; X],
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
        let (by_positions, by_velocities) = by.split_at(X.min(W));
        if by_velocities.len() > Y {
            *row = [T::ZERO; N];
        }
        for (by, position) in by_positions.iter().zip(positions.iter()) {
            for (entry, x) in row.iter_mut().zip(position) {
                *entry = by.mul_add(*x, *entry);
            }
        }
        for by in by_velocities.chunks(Y.max(1)) {
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
        let of_positions = [[-0.5, -0.5], [-0.5, -0.5]];
        // changes of the velocities: by the positions, by the velocities
        let changes = [[2.0, 0.0, -0.5, -0.5], [0.0, 3.0, -0.5, -0.5]];
        let found: [[f64; 5]; 5] = slopes_of_return(&of_positions, &changes);
        let expected = [
            [0.5, -0.5, 0.0, 0.0, 0.0],
            [-0.5, 0.5, 0.0, 0.0, 0.0],
            [1.0, -1.0, 0.5, -0.5, 0.0],
            [-1.5, 1.5, -0.5, 0.5, 0.0],
            [0.0, 0.0, 0.0, 0.0, 1.0],
        ];
        assert_eq!(found, expected);
        // the next velocities: by the positions, by those of the start, by the present ones
        let next = [[2.0, 0.0, 1.0, 0.0, -0.5, -0.5], [0.0, 3.0, 0.0, 1.0, -0.5, -0.5]];
        assert_eq!(slopes_of_return::<f64, 5, 2, 2, 6>(&of_positions, &next), expected);
        // none are moved
        let alone: [[f64; 3]; 3] = slopes_of_return(&of_positions, &[[0.0; 2]; 0]);
        assert_eq!(alone, [[0.5, -0.5, 0.0], [-0.5, 0.5, 0.0], [0.0, 0.0, 1.0]]);
    }
}
