//! The signs of the eigenvalues of symmetric matrices, in floating point with bounds on the errors.

use super::evaluate::Bounded;

/// The number of negative eigenvalues of a symmetric matrix, which is that of its negative pivots (Sylvester); `None`
/// where a pivot is not told from zero.
pub(crate) fn negative_eigenvalues(mut matrix: Vec<Vec<Bounded>>) -> Option<usize> {
    let mut left: Vec<usize> = (0..matrix.len()).collect();
    let mut negative = 0;
    while !left.is_empty() {
        let size = |row: usize| matrix[row][row].value.abs();
        let place = (0..left.len()).max_by(|a, b| size(left[*a]).total_cmp(&size(left[*b])))?;
        let pivot = left.swap_remove(place);
        let lead = matrix[pivot][pivot];
        if !lead.is_certainly_nonzero() {
            return None;
        }
        negative += usize::from(lead.value < 0.0);
        for row in &left {
            let share = matrix[*row][pivot].over(lead);
            for column in &left {
                matrix[*row][*column] = matrix[*row][*column].less_product(share, matrix[pivot][*column]);
            }
        }
    }
    Some(negative)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn signs_are_counted_where_they_are_certain() {
        let of = |entries: [[f64; 3]; 3]| {
            let row = |row: [f64; 3]| row.map(|value| Bounded { value, error: 1e-15 }).to_vec();
            negative_eigenvalues(entries.map(row).to_vec())
        };
        assert_eq!(of([[2.0, 1.0, 0.0], [1.0, 2.0, 1.0], [0.0, 1.0, 2.0]]), Some(0));
        assert_eq!(of([[1.0, 2.0, 0.0], [2.0, 1.0, 0.0], [0.0, 0.0, -3.0]]), Some(2));
        assert_eq!(of([[1.0, 1.0, 0.0], [1.0, 1.0, 0.0], [0.0, 0.0, 1.0]]), None);
    }
}
