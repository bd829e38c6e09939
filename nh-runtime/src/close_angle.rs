//! Sines and cosines at the next place of an iteration, from those at the first.
//!
//! With s = sin α and c = cos α of the first angle and δ = θ − α,
//!
//! sin θ = s + (c sin δ − s (1 − cos δ)),  cos θ = c − (s sin δ + c (1 − cos δ)),
//!
//! where three terms of the series of sin δ and two of 1 − cos δ are exact to rounding for |δ| ≤ 2⁻¹⁰. What is added is small beside
//! sine and cosine themselves, so that the errors of both stay below two units in their last places. Derivatives of the
//! series are not exact to rounding: numbers that carry some are not taken from the first angle.

use crate::Scalar;

/// An angle with its sine and cosine, in every lane.
#[derive(Clone, Copy, Debug)]
pub struct CloseAngle<T> {
    angle: T,
    sin: T,
    cos: T,
    /// How far an angle may be.
    reach: T,
}

impl<T: Scalar> CloseAngle<T> {
    /// Before the first angle.
    #[inline]
    #[must_use]
    pub fn none() -> Self {
        Self { angle: T::ZERO, sin: T::ZERO, cos: T::ZERO, reach: T::from_f64(f64::NAN) }
    }

    /// Sine and cosine of an angle: by those that are kept if it is close in every lane, also beside these, else they are
    /// computed and kept.
    #[inline]
    pub fn sin_cos(&mut self, angle: T) -> (T, T) {
        if T::DERIVATIVES > 0 {
            return angle.sin_cos();
        }
        let Self { sin, cos, reach, .. } = *self;
        let delta = angle - self.angle;
        if reach.all_ge(delta.abs()) {
            let square = delta * delta;
            let cube = square.mul_add(T::from_f64(1.0 / 120.0), T::from_f64(-1.0 / 6.0));
            let sine = (delta * square).mul_add(cube, delta);
            let versine = square * square.mul_add(T::from_f64(-1.0 / 24.0), T::from_f64(0.5));
            return (sin + (cos * sine - sin * versine), cos - (sin * sine + cos * versine));
        }
        // far away, or not a number
        let (sin, cos) = angle.sin_cos();
        let beside = sin.abs().min(cos.abs()) * T::from_f64(0.25);
        *self = Self { angle, sin, cos, reach: T::from_f64(CLOSE).min(beside) };
        (sin, cos)
    }
}

/// How far an angle may be at most.
const CLOSE: f64 = 1.0 / 1024.0;

#[cfg(test)]
mod tests {
    use super::CloseAngle;
    use crate::{Jet, Scalar};

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
            let relative = |found: f64, exact: f64| (found - exact).abs() / exact.abs();
            worst = worst.max(relative(sin, exact.0)).max(relative(cos, exact.1));
            #[allow(clippy::cast_possible_truncation, reason = "single precision is meant")]
            let (narrow, beside) = (angle as f32, (angle + delta) as f32);
            let mut close = CloseAngle::none();
            close.sin_cos(narrow);
            let (sin, cos) = close.sin_cos(beside);
            let exact = f64::from(beside).sin_cos();
            let single = relative(f64::from(sin), exact.0).max(relative(f64::from(cos), exact.1));
            worst_single = worst_single.max(single);
        }
        assert!(worst < 2.0 * f64::EPSILON, "{worst}");
        assert!(worst_single < 2.0 * f64::from(f32::EPSILON), "{worst_single}");
    }

    /// Near to zero and to a quarter of a turn, where what is added would be all that there is.
    #[test]
    fn small_sines_and_cosines_keep_their_digits() {
        for small in [1e-4, 1e-7, 1e-12, 1e-200] {
            for part in [0.5, 1e-3, -1.0, 1e-9] {
                for about in [0.0, core::f64::consts::FRAC_PI_2] {
                    let mut close = CloseAngle::none();
                    close.sin_cos(about + small);
                    let angle = about + part * small;
                    let (found, exact) = (close.sin_cos(angle), computed(angle));
                    assert!(
                        (found.0 - exact.0).abs() <= 2.0 * f64::EPSILON * exact.0.abs(),
                        "{small} {part}"
                    );
                    assert!(
                        (found.1 - exact.1).abs() <= 2.0 * f64::EPSILON * exact.1.abs(),
                        "{small} {part}"
                    );
                }
            }
        }
    }

    /// Derivatives of all orders that a number carries are those of the functions.
    #[test]
    fn derivatives_are_not_those_of_a_series() {
        type Twice = Jet<Jet<f64, 1>, 1>;
        let angle = |angle: f64| {
            let inner = Jet { value: angle, by: [1.0], by_others: [] };
            Twice { value: inner, by: [Jet::constant(1.0)], by_others: [] }
        };
        let mut close = CloseAngle::none();
        close.sin_cos(angle(0.7));
        let (sin, cos) = close.sin_cos(angle(0.7 + 9e-4));
        let (s, c) = computed(0.7 + 9e-4);
        let pairs =
            [(sin.by[0].value, c), (sin.by[0].by[0], -s), (cos.by[0].value, -s), (cos.by[0].by[0], -c)];
        for (found, exact) in pairs {
            assert!((found - exact).abs() < 1e-15, "{found} {exact}");
        }
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
