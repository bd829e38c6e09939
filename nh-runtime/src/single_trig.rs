//! Sine and cosine in single precision alone, for hardware that has no other: `libm` computes
//! them in double precision, which such hardware emulates at some thirty times the cost.
//!
//! The reduction to [−π/4, π/4] subtracts a multiple of π/2 in three parts (Cody, Waite, Software
//! Manual for the Elementary Functions, 1980, chapter 8), the polynomials are those of Moshier's
//! Cephes library (`sinf.c`). The error is below 10⁻⁷ for |x| ≤ 8192, the range that the three
//! parts are good for.

/// The largest argument.
pub(crate) const RANGE: f32 = 8192.0;

/// π/2 in three parts, the first of which have so few digits that their multiples are exact.
const HALF_PI: [f32; 3] = [1.570_312_5, 4.837_513e-4, 7.549_79e-8];

/// Sine and cosine of an angle of at most [`RANGE`] in absolute value.
#[inline]
#[allow(clippy::cast_possible_truncation, clippy::cast_precision_loss)] // small integers
pub(crate) fn sin_cos(x: f32) -> (f32, f32) {
    let turns = x * core::f32::consts::FRAC_2_PI;
    let quarter = (turns + if turns < 0.0 { -0.5 } else { 0.5 }) as i32;
    let n = quarter as f32;
    let [a, b, c] = HALF_PI;
    let r = ((x - n * a) - n * b) - n * c;
    let z = r * r;
    let sin = ((-1.951_529_6e-4 * z + 8.332_161e-3) * z - 0.166_666_55) * z * r + r;
    let cos = ((2.443_315_7e-5 * z - 1.388_731_6e-3) * z + 4.166_664_6e-2) * z * z - 0.5 * z + 1.0;
    match quarter & 3 {
        0 => (sin, cos),
        1 => (cos, -sin),
        2 => (-sin, -cos),
        _ => (-cos, sin),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_error_is_below_its_bound() {
        let mut worst = 0.0_f64;
        let steps = 2_000_000_u32;
        for i in 0..=steps {
            for range in [10.0, f64::from(RANGE)] {
                #[allow(clippy::cast_possible_truncation)]
                let x = (range * (2.0 * f64::from(i) / f64::from(steps) - 1.0)) as f32;
                let (sin, cos) = sin_cos(x);
                let exact = f64::from(x).sin_cos();
                worst = worst.max((f64::from(sin) - exact.0).abs()).max((f64::from(cos) - exact.1).abs());
            }
        }
        assert!(worst < 1e-7, "{worst:e}");
    }

    #[test]
    fn small_angles_keep_their_relative_accuracy() {
        for x in [1e-30_f32, -1e-10, 1e-4, 0.0] {
            assert!((sin_cos(x).0 - x).abs() <= 2e-9 * x.abs());
        }
    }
}
