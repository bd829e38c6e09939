//! Linear systems of tests, solved by nothing that the project contains otherwise.

/// The solution of a regular system, by Gauss and Jordan with the largest pivots of each column.
///
/// # Panics
/// Where there are fewer rows than unknowns.
#[must_use]
pub fn solved(mut rows: Vec<Vec<f64>>, mut right: Vec<f64>) -> Vec<f64> {
    let n = right.len();
    for i in 0..n {
        let pivot = (i..n).max_by(|a, b| rows[*a][i].abs().total_cmp(&rows[*b][i].abs())).expect("a row");
        rows.swap(i, pivot);
        right.swap(i, pivot);
        for k in (0..n).filter(|k| *k != i) {
            let factor = rows[k][i] / rows[i][i];
            let pivots = rows[i].clone();
            for (entry, pivot) in rows[k].iter_mut().zip(pivots) {
                *entry -= factor * pivot;
            }
            right[k] -= factor * right[i];
        }
    }
    (0..n).map(|i| right[i] / rows[i][i]).collect()
}
