//! Linear equations in floating point, where what is found proves nothing.

/// The determinant of the first columns, and the solution for the last where there is one more.
pub(crate) fn eliminated(mut rows: Vec<Vec<f64>>) -> (f64, Vec<f64>) {
    let n = rows.len();
    let mut determinant = 1.0;
    for column in 0..n {
        let largest = (column..n).max_by(|a, b| rows[*a][column].abs().total_cmp(&rows[*b][column].abs()));
        let pivot_row = largest.unwrap_or(column);
        if pivot_row != column {
            rows.swap(pivot_row, column);
            determinant = -determinant;
        }
        let pivot = rows[column][column];
        determinant *= pivot;
        let source = rows[column].clone();
        for row in rows.iter_mut().skip(column + 1) {
            let factor = row[column] / pivot;
            for (slot, entry) in row.iter_mut().zip(&source).skip(column) {
                *slot -= factor * entry;
            }
        }
    }
    let mut solution = vec![0.0; n];
    for column in (0..n).rev().filter(|column| rows[*column].len() > n) {
        let known: f64 = (column + 1..n).map(|k| rows[column][k] * solution[k]).sum();
        solution[column] = (rows[column][n] - known) / rows[column][column];
    }
    (determinant, solution)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_eliminated() {
        let (determinant, solution) = eliminated(vec![vec![0.0, 2.0, 4.0], vec![3.0, 1.0, 5.0]]);
        assert_eq!((determinant, solution), (-6.0, vec![1.0, 2.0]));
    }
}
