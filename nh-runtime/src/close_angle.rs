//! Sines and cosines at the next place of an iteration, from those at the first.
//!
//! With s = sin α and c = cos α of the first angle and δ = θ − α,
//!
//! sin θ = s + (c sin δ − s (1 − cos δ)),  cos θ = c − (s sin δ + c (1 − cos δ)),
//!
//! where two terms of the series of sin δ and 1 − cos δ are exact to rounding for |δ| ≤ 2⁻¹⁰. What is added is small, so
//! that the error stays below one unit in the last place of 1.

use crate::Scalar;

/// An angle with its sine and cosine, in every lane.
#[derive(Clone, Copy, Debug)]
pub struct CloseAngle<T> {
    angle: T,
    sin: T,
    cos: T,
}

impl<T: Scalar> CloseAngle<T> {
    /// Before the first angle.
    #[inline]
    #[must_use]
    pub fn none() -> Self {
        Self { angle: T::from_f64(f64::NAN), sin: T::ZERO, cos: T::ZERO }
    }

    /// Sine and cosine of an angle: by those that are kept if it is close in every lane, else they are computed and kept.
    #[inline]
    pub fn sin_cos(&mut self, angle: T) -> (T, T) {
        let Self { sin, cos, .. } = *self;
        let delta = angle - self.angle;
        let square = delta * delta;
        if T::from_f64(CLOSE * CLOSE).all_ge(square) {
            let sine = (delta * square).mul_add(T::from_f64(-1.0 / 6.0), delta);
            let versine = square * square.mul_add(T::from_f64(-1.0 / 24.0), T::from_f64(0.5));
            return (sin + (cos * sine - sin * versine), cos - (sin * sine + cos * versine));
        }
        // far away, or not a number
        let (sin, cos) = angle.sin_cos();
        *self = Self { angle, sin, cos };
        (sin, cos)
    }
}

/// How far an angle may be.
const CLOSE: f64 = 1.0 / 1024.0;

#[cfg(test)]
mod tests {
    use super::CloseAngle;
    use crate::Scalar;

    /// As the crate computes them.
    fn computed(angle: f64) -> (f64, f64) {
        Scalar::sin_cos(angle)
    }

    #[test]
    fn sines_of_close_angles_stay_within_a_unit_of_the_last_place() {
        let (mut worst, mut worst_single) = (0.0_f64, 0.0_f64);
        for step in 0..20_000_u32 {
            let angle = 40.0 * (f64::from(step) * 1.1e-3).sin() + f64::from(step) * 1e-3;
            let delta = (f64::from(step) * 0.7).sin() * 10.0_f64.powi(-3 - (step % 12).cast_signed());
            let mut close = CloseAngle::none();
            assert_eq!(close.sin_cos(angle), computed(angle));
            assert_eq!(close.sin_cos(angle), computed(angle));
            let (sin, cos) = close.sin_cos(angle + delta);
            let exact = (angle + delta).sin_cos();
            worst = worst.max((sin - exact.0).abs()).max((cos - exact.1).abs());
            #[allow(clippy::cast_possible_truncation, reason = "single precision is meant")]
            let (narrow, beside) = (angle as f32, (angle + delta) as f32);
            let mut close = CloseAngle::none();
            close.sin_cos(narrow);
            let (sin, cos) = close.sin_cos(beside);
            let exact = f64::from(beside).sin_cos();
            worst_single =
                worst_single.max((f64::from(sin) - exact.0).abs()).max((f64::from(cos) - exact.1).abs());
        }
        assert!(worst < f64::EPSILON, "{worst}");
        assert!(worst_single < f64::from(f32::EPSILON), "{worst_single}");
    }

    #[test]
    fn what_is_far_is_computed() {
        let mut close = CloseAngle::none();
        close.sin_cos(0.3_f64);
        assert_eq!(close.sin_cos(0.4), computed(0.4));
        assert!(close.sin_cos(f64::NAN).0.is_nan());
        assert_eq!(close.sin_cos(0.3), computed(0.3));
    }
}
