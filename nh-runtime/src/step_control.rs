//! The choice of the step's length from an error estimate
//! (Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I, sections II.4 and IV.2).

use crate::{IntegrationError, Real};

/// The settings of an adaptive method beside its tolerances.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct StepControl<T> {
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
        Self { first_step: None, max_step: None }
    }

    /// The logarithm of the preceding error, to begin with.
    pub(crate) fn first_log_error() -> T {
        T::from_f64(LEAST_LOG_ERROR)
    }

    pub(crate) fn check(&self) -> Result<(), IntegrationError> {
        for (setting, value) in [("first_step", self.first_step), ("max_step", self.max_step)] {
            if let Some(value) = value
                && !(value > T::ZERO && value.is_finite())
            {
                let expected = "positive and finite";
                return Err(IntegrationError::Setting { setting, value: value.to_f64(), expected });
            }
        }
        Ok(())
    }

    /// The length of the step after an accepted one, after (4.13) with the PI term of section IV.2:
    /// `h · 0.9 · err^(−1/q + 3β/4) · err_old^β`; and the logarithm of the error, for the next time.
    /// `order` is q: one more than that of the estimate.
    #[inline]
    pub(crate) fn after_success(&self, h: T, error: T, preceding: T, order: u32) -> (T, T) {
        let beta = T::from_f64(BETA);
        let exponent = T::from_f64(f64::from(order).recip() - 0.75 * BETA);
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
        for bad in
            [StepControl { first_step: Some(0.0), ..good }, StepControl { max_step: Some(f64::NAN), ..good }]
        {
            assert!(matches!(bad.check(), Err(IntegrationError::Setting { .. })), "{bad:?}");
        }
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
