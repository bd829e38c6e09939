//! How a step of a wanted length goes towards a target.

use crate::Real;

/// A step on the way to the target.
pub(super) struct Leg<T> {
    /// Its length, with the sign of its direction.
    pub(super) length: T,
    /// The time at its end.
    pub(super) time: T,
    /// Whether the target has shortened it.
    pub(super) cut: bool,
}

impl<T: Real> Leg<T> {
    /// The step of length h: stretched by up to 1 % or cut to land on the target, and halved where
    /// otherwise a sliver would be left.
    #[inline]
    pub(super) fn new(now: T, h: T, target: Option<T>) -> Self {
        let mut length = h;
        let mut cut = false;
        if let Some(target) = target {
            let remaining = (target - now).abs();
            if h * T::from_f64(1.01) >= remaining {
                return Self { length: target - now, time: target, cut: remaining < h };
            }
            if h * T::from_f64(2.0) > remaining {
                length = remaining * T::from_f64(0.5);
                cut = true;
            }
            if target < now {
                length = -length;
            }
        }
        let time = now + length;
        // the length that the time has really moved by
        Self { length: time - now, time, cut }
    }
}
