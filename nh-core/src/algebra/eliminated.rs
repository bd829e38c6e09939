//! Linear equations in floating point, where what is found proves nothing.

use crate::limits;

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

/// The determinant of J Jᵀ + μ, and the step Jᵀ (J Jᵀ + μ)⁻¹ f, which for μ = 0 is the shortest that changes f by itself.
pub(crate) fn least_step(rows: &[Vec<f64>], f: impl Iterator<Item = f64>, damping: f64) -> (f64, Vec<f64>) {
    let matrix = rows.iter().zip(f).enumerate().map(|(k, (row, f))| {
        let mut products: Vec<f64> = rows.iter().map(|other| product(row, other)).collect();
        products[k] += damping;
        products.push(f);
        products
    });
    limits::spend(rows.len().pow(3));
    let (determinant, weights) = eliminated(matrix.collect());
    let along = |k: usize| rows.iter().zip(&weights).map(|(row, w)| row[k] * w).sum();
    (determinant, (0..rows.first().map_or(0, Vec::len)).map(along).collect())
}

/// Σ a b.
pub(crate) fn product(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_eliminated() {
        let (determinant, solution) = eliminated(vec![vec![0.0, 2.0, 4.0], vec![3.0, 1.0, 5.0]]);
        assert_eq!((determinant, solution), (-6.0, vec![1.0, 2.0]));
    }

    #[test]
    fn the_least_step_solves_the_equations() {
        // x + y = 2, from where it is the plane through the origin
        assert_eq!(least_step(&[vec![1.0, 1.0]], [2.0].into_iter(), 0.0), (2.0, vec![1.0, 1.0]));
        let (determinant, step) =
            least_step(&[vec![1.0, 0.0, 0.0], vec![0.0, 2.0, 0.0]], [3.0, 4.0].into_iter(), 0.0);
        assert_eq!((determinant, step), (4.0, vec![3.0, 2.0, 0.0]));
    }
}
