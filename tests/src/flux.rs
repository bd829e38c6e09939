//! Whether a density is kept by a motion, by differences.

/// Asserts that Σ ∂ᵢ(μ Fⁱ) = 0 at a point, by differences of fourth order.
///
/// # Panics
/// If the sum is more than the error of the differences.
///
/// Their error falls by 16 where the step is halved: the difference of two is what it may be, and it has to
/// be small beside the terms.
pub fn assert_kept<const N: usize>(flux: impl Fn(&[f64; N]) -> [f64; N], at: [f64; N]) {
    const STEP: f64 = 1e-3;
    const ROUNDING: f64 = 64.0 * f64::EPSILON / STEP;
    let slope = |index: usize, step: f64| {
        let there = |steps: f64| {
            let mut moved = at;
            moved[index] += steps * step;
            flux(&moved)[index]
        };
        (8.0 * (there(1.0) - there(-1.0)) - (there(2.0) - there(-2.0))) / (12.0 * step)
    };
    let (mut sum, mut size, mut error) = (0.0, 0.0, 0.0);
    for (index, rate) in flux(&at).iter().enumerate() {
        let (fine, coarse) = (slope(index, STEP), slope(index, 2.0 * STEP));
        sum += fine;
        size += fine.abs();
        error += (fine - coarse).abs() / 8.0 + rate.abs() * ROUNDING;
    }
    assert!(sum.abs() < error, "{sum} of {size}, the differences' error below {error}");
    assert!(error < 1e-4 * size, "{error} of {size}: nothing is tested");
}
