//! Numbers of 71 digits.

use f256::f256;
use nonholonomic_core::algebra::Rational;

/// The nearest `f64`, but for the last digit.
#[must_use]
#[allow(clippy::cast_precision_loss, reason = "the nearest number is wanted")]
pub(crate) fn rounded(x: f256) -> f64 {
    if !x.is_finite() {
        return f64::NAN;
    }
    let (sign, exponent, (high, low)) = x.as_sign_exp_signif();
    // in steps that neither overflow nor underflow where the result does not
    let signif = high as f64 * 2f64.powi(128) + low as f64;
    let half = exponent / 2;
    let size = signif * 2f64.powi(half) * 2f64.powi(exponent - half);
    if sign == 0 { size } else { -size }
}

/// An exact number.
pub(crate) fn exact(value: &Rational) -> f256 {
    if let Some((numerator, denominator)) = value.to_small() {
        return f256::from(numerator) / f256::from(denominator);
    }
    let integer = |text: String| text.parse::<f256>().unwrap_or(f256::NAN);
    integer(value.numerator().to_string()) / integer(value.denominator().to_string())
}

/// Σ a_k b_k.
pub(crate) fn inner(a: &[f256], b: &[f256]) -> f256 {
    a.iter().zip(b).fold(f256::ZERO, |sum, (a, b)| sum + *a * *b)
}

/// Solves `matrix · x = right` for several right-hand sides, with rows of any scale, by elimination with complete
/// pivoting. None where the matrix is singular to all digits.
pub(crate) fn solve(mut matrix: Vec<Vec<f256>>, mut right: Vec<Vec<f256>>) -> Option<Vec<Vec<f256>>> {
    let n = matrix.len();
    // 1. rows, then columns, of size one: powers of two would do as well
    let size = |row: &mut dyn Iterator<Item = f256>| row.map(|x| x.abs()).fold(f256::ZERO, f256::max);
    for (row, right) in matrix.iter_mut().zip(&mut right) {
        let largest = size(&mut row.iter().copied());
        if largest.eq_zero() {
            return None;
        }
        row.iter_mut().chain(right).for_each(|x| *x /= largest);
    }
    let mut unit = vec![f256::ONE; n];
    for column in 0..n {
        unit[column] = size(&mut matrix.iter().map(|row| row[column]));
        if unit[column].eq_zero() {
            return None;
        }
        for row in &mut matrix {
            row[column] /= unit[column];
        }
    }
    // 2. elimination
    let mut order: Vec<usize> = (0..n).collect();
    for k in 0..n {
        let places = (k..n).flat_map(|i| (k..n).map(move |j| (i, j)));
        let (i, j) = places.max_by(|a, b| {
            let [a, b] = [a, b].map(|(i, j)| matrix[*i][*j].abs());
            a.total_cmp(&b)
        })?;
        matrix.swap(k, i);
        right.swap(k, i);
        for row in &mut matrix {
            row.swap(k, j);
        }
        order.swap(k, j);
        let pivot = matrix[k][k];
        if !pivot.is_finite() || rounded(pivot.abs()) < 1e-50 {
            return None;
        }
        for row in k + 1..n {
            if matrix[row][k].eq_zero() {
                continue;
            }
            let factor = matrix[row][k] / pivot;
            for column in k..n {
                let change = factor * matrix[k][column];
                matrix[row][column] -= change;
            }
            for column in 0..right[row].len() {
                let change = factor * right[k][column];
                right[row][column] -= change;
            }
        }
    }
    // 3. back
    for k in (0..n).rev() {
        for column in 0..right[k].len() {
            let mut value = right[k][column];
            for (entry, other) in matrix[k][k + 1..].iter().zip(&right[k + 1..]) {
                value -= *entry * other[column];
            }
            right[k][column] = value / matrix[k][k];
        }
    }
    let mut solution = vec![Vec::new(); n];
    for (row, place) in right.into_iter().zip(order) {
        solution[place] = row.into_iter().map(|x| x / unit[place]).collect();
    }
    Some(solution)
}
