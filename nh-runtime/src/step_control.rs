//! The choice of the step's length from an error estimate
//! (Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I, sections II.4 and IV.2).

use crate::arrays::Array;
use crate::{IntegrationError, Real};

/// The settings of an adaptive method.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct StepControl<T> {
    pub(crate) rtol: T,
    /// As `rtol` if not given.
    pub(crate) atol: Option<T>,
    /// Chosen from the equations if not given.
    pub(crate) first_step: Option<T>,
    /// Unlimited if not given.
    pub(crate) max_step: Option<T>,
}

/// How far the step may shrink and grow at once.
const SHRINK: f64 = 0.2;
const GROW: f64 = 10.0;
/// The share of the predicted step that is taken.
const SAFETY: f64 = 0.9;
/// The weight β of the preceding error (PI control after Gustafsson, section IV.2).
const BETA: f64 = 0.04;
/// The preceding error is taken to be at least 10⁻⁴, whose logarithm this is.
const LEAST_LOG_ERROR: f64 = -9.210_340_371_976_182;

impl<T: Real> StepControl<T> {
    pub(crate) fn new() -> Self {
        Self { rtol: T::DEFAULT_TOLERANCE, atol: None, first_step: None, max_step: None }
    }

    /// The logarithm of the preceding error, to begin with.
    pub(crate) fn first_log_error() -> T {
        T::from_f64(LEAST_LOG_ERROR)
    }

    pub(crate) fn check(&self) -> Result<(), IntegrationError> {
        let refuse = |setting, value: T, expected| {
            Err(IntegrationError::Setting { setting, value: value.to_f64(), expected })
        };
        let resolved = T::from_f64(4.0) * T::EPSILON;
        let zero_or_resolved = self.rtol == T::ZERO || self.rtol >= resolved;
        if !(self.rtol.is_finite() && zero_or_resolved) {
            return refuse(
                "rtol",
                self.rtol,
                "zero, or finite and at least four times the rounding unit of the numbers: \
                 8.9e-16 in f64, 4.8e-7 in f32",
            );
        }
        if let Some(atol) = self.atol
            && !(atol >= T::ZERO && atol.is_finite())
        {
            return refuse("atol", atol, "finite and not negative");
        }
        if self.rtol == T::ZERO && self.atol.unwrap_or(T::ZERO) == T::ZERO {
            return refuse("atol", T::ZERO, "positive where `rtol` is zero");
        }
        for (setting, value) in [("first_step", self.first_step), ("max_step", self.max_step)] {
            if let Some(value) = value
                && !(value > T::ZERO && value.is_finite())
            {
                return refuse(setting, value, "positive and finite");
            }
        }
        Ok(())
    }

    /// The weighted norm √(1/N Σ (eᵢ/scᵢ)²), scᵢ = atol + rtol max(|x₀ᵢ|, |x₁ᵢ|)
    /// (section II.4, eq. (4.10), (4.11)). NaN and infinity pass through it.
    #[inline]
    pub(crate) fn norm<V: Array<T>>(&self, e: &V, x0: &V, x1: &V) -> T {
        let atol = self.atol.unwrap_or(self.rtol);
        let mut sum = T::ZERO;
        let mut count = T::ZERO;
        for (&e, (x0, x1)) in e.as_ref().iter().zip(x0.as_ref().iter().zip(x1.as_ref())) {
            // not `max`, which would take care of NaN: an end that is not finite is refused anyway
            let larger = x0.abs().select_gt(x1.abs(), x0.abs(), x1.abs());
            let ratio = e / self.rtol.mul_add(larger, atol);
            // 0/0: a component that is exactly zero, with a relative tolerance only
            let ratio = if e == T::ZERO { T::ZERO } else { ratio };
            sum += ratio * ratio;
            count += T::ONE;
        }
        (sum / count.max(T::ONE)).sqrt()
    }

    /// The length of the step after an accepted one, after (4.13) with the PI term of section IV.2:
    /// `h · 0.9 · err^(−1/q + 3β/4) · err_old^β`; and the logarithm of the error, for the next time.
    /// `order` is q: one more than that of the estimate.
    #[inline]
    pub(crate) fn after_success(&self, h: T, error: T, preceding: T, order: u32) -> (T, T) {
        let beta = T::from_f64(BETA);
        let exponent = T::from_u32(order).recip() - T::from_f64(0.75 * BETA);
        let log_error = error.max(T::MIN_POSITIVE).ln();
        let factor = T::from_f64(SAFETY) * (beta * preceding - exponent * log_error).exp();
        let next = h * factor.max(T::from_f64(SHRINK)).min(T::from_f64(GROW));
        (self.limited(next), log_error.max(T::from_f64(LEAST_LOG_ERROR)))
    }

    /// The length of the step after a rejected one, without the PI term: h · 0.9 · err^(−1/q), and
    /// as short as permitted if the error is not even finite.
    #[inline]
    pub(crate) fn after_rejection(h: T, error: T, order: u32) -> T {
        let shortest = T::from_f64(SHRINK);
        if !error.is_finite() {
            return h * shortest;
        }
        let factor = T::from_f64(SAFETY) * (-error.ln() / T::from_u32(order)).exp();
        h * factor.max(shortest).min(T::from_f64(SAFETY))
    }

    /// The length, at most `max_step`.
    #[inline]
    pub(crate) fn limited(&self, h: T) -> T {
        match self.max_step {
            Some(longest) => h.min(longest),
            None => h,
        }
    }

    /// The shortest step that time can resolve.
    #[inline]
    pub(crate) fn shortest(time: T) -> T {
        (T::from_f64(4.0) * T::EPSILON * time.abs()).max(T::MIN_POSITIVE / T::EPSILON)
    }
}

#[cfg(test)]
#[allow(clippy::float_cmp)] // exact values are meant
mod tests {
    use super::*;

    #[test]
    fn settings_are_checked() {
        let good = StepControl::<f64>::new();
        assert_eq!(good.check(), Ok(()));
        let zero = Some(0.0);
        let nan = Some(f64::NAN);
        for bad in [
            StepControl { rtol: -1e-6, ..good },
            StepControl { rtol: f64::NAN, ..good },
            StepControl { rtol: f64::INFINITY, ..good },
            StepControl { rtol: 1e-17, ..good },
            StepControl { rtol: 0.0, ..good },
            StepControl { rtol: 0.0, atol: zero, ..good },
            StepControl { atol: Some(-1.0), ..good },
            StepControl { atol: nan, ..good },
            StepControl { first_step: zero, ..good },
            StepControl { max_step: nan, ..good },
        ] {
            assert!(matches!(bad.check(), Err(IntegrationError::Setting { .. })), "{bad:?}");
        }
    }

    #[test]
    fn the_norm_keeps_what_is_not_finite() {
        let control = StepControl::<f64>::new();
        assert!(control.norm(&[0.0, f64::NAN], &[1.0, 1.0], &[1.0, 1.0]).is_nan());
        assert!(control.norm(&[f64::INFINITY], &[1.0], &[1.0]).is_infinite());
        assert_eq!(control.norm::<[f64; 0]>(&[], &[], &[]), 0.0);
        let relative = StepControl { atol: Some(0.0), ..control };
        assert_eq!(relative.norm(&[0.0], &[0.0], &[0.0]), 0.0);
    }

    #[test]
    fn steps_change_within_bounds() {
        let control = StepControl::<f64> { max_step: Some(3.0), ..StepControl::new() };
        assert_eq!(control.after_success(0.1, 0.0, -9.0, 5).0, 1.0);
        assert_eq!(control.after_success(1.0, 0.0, -9.0, 5).0, 3.0);
        assert!((StepControl::after_rejection(1.0, f64::NAN, 5) - 0.2).abs() < 1e-15);
        assert!(StepControl::after_rejection(1.0_f64, 1.0 + 1e-12, 5) <= 0.9);
    }
}
