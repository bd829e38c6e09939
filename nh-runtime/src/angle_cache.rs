//! Sines and cosines from those of angles nearby.
//!
//! From one evaluation of a derivative to the next angles move little. With s = sin α and c = cos α of an earlier angle
//! α and δ = θ − α,
//!
//! sin θ = s + (c sin δ − s (1 − cos δ)),  cos θ = c − (s sin δ + c (1 − cos δ)),
//!
//! where a few terms of the series of sin δ and 1 − cos δ are exact to rounding for |δ| ≤ 1/8. What is added is small, so
//! that the error stays below two units in the last place of 1, however long the motion is: the angle α, whose sine is
//! computed, is replaced as soon as δ is larger.

use core::cell::Cell;
use core::fmt;

use crate::Real;
use crate::dynamics::{Dynamics, ScalarOf};

/// A system whose derivative can take sines and cosines from those of angles nearby: declared with
/// `emit { angle_cache }`.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no angles at hand",
    label = "needs the trait `AngleCache`",
    note = "add `emit {{ angle_cache }}` to its declaration"
)]
pub trait AngleCache: Dynamics {
    /// An [`Angle`] for each sine or cosine of the derivative.
    type Angles: Copy;

    /// The angles at 0.
    fn angles_at_zero() -> Self::Angles;

    /// The derivative, with sines and cosines from those at hand where they are near, which are replaced where they are
    /// not.
    fn derivative_near(
        &self,
        angles: &mut Self::Angles,
        t: ScalarOf<Self>,
        state: &Self::State,
        input: &Self::Input,
    ) -> Self::State;
}

/// A system that keeps the sines and cosines of its angles at hand: the same system, with errors of two units in the last
/// place of 1 in sines and cosines, which costs less where these are most of the work.
///
/// The last bits of a derivative depend on what was evaluated before: a motion that is resumed from a stored state
/// differs from one that went on by rounding errors. It is not `Sync`, as every thread needs angles of its own: clone it.
#[derive(Clone)]
pub struct AngleCached<S: AngleCache> {
    system: S,
    angles: Cell<S::Angles>,
}

impl<S: AngleCache> AngleCached<S> {
    /// The system, with its angles at hand at 0.
    #[inline]
    #[must_use]
    pub fn new(system: S) -> Self {
        Self { system, angles: Cell::new(S::angles_at_zero()) }
    }

    /// The system.
    #[inline]
    pub const fn system(&self) -> &S {
        &self.system
    }

    #[inline]
    pub(crate) fn derivative_near(&self, t: ScalarOf<S>, state: &S::State, input: &S::Input) -> S::State {
        let mut angles = self.angles.get();
        let rate = self.system.derivative_near(&mut angles, t, state, input);
        self.angles.set(angles);
        rate
    }
}

impl<S: AngleCache + fmt::Debug> fmt::Debug for AngleCached<S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("AngleCached").field(&self.system).finish()
    }
}

/// An angle with its sine and cosine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Angle<T> {
    size: T,
    sin: T,
    cos: T,
}

impl<T: Real> Angle<T> {
    /// The angle 0.
    #[must_use]
    pub fn zero() -> Self {
        Self { size: T::ZERO, sin: T::ZERO, cos: T::ONE }
    }

    /// Sine and cosine of an angle: from those at hand if it is near, within 1/8; else they are computed and kept.
    ///
    /// ```
    /// use nonholonomic::Angle;
    /// let mut near = Angle::zero();
    /// let (sin, cos): (f64, f64) = near.sin_cos(1.0); // computed
    /// assert_eq!((sin, cos), 1f64.sin_cos());
    /// let (sin, cos) = near.sin_cos(1.1); // rotated by 0.1
    /// assert!((sin - 1.1f64.sin()).abs() < 3e-16 && (cos - 1.1f64.cos()).abs() < 3e-16);
    /// ```
    #[inline]
    #[must_use]
    pub fn sin_cos(&mut self, angle: T) -> (T, T) {
        let delta = angle - self.size;
        let square = delta * delta;
        if square <= T::from_f64(1.0 / 64.0) {
            let (sine, versine) = (sine_series(square), versine_series(square));
            let (sine, versine) = ((delta * square).mul_add(sine, delta), square * versine);
            let (sin, cos) = (self.sin, self.cos);
            return (sin + (cos * sine - sin * versine), cos - (sin * sine + cos * versine));
        }
        // far away, or not a number
        let (sin, cos) = angle.sin_cos();
        *self = Self { size: angle, sin, cos };
        (sin, cos)
    }
}

/// Whether numbers are of single precision, which needs fewer terms.
#[inline]
fn is_single<T: Real>() -> bool {
    T::EPSILON > T::from_f64(1e-12)
}

/// (sin δ − δ)/δ³ as a polynomial in δ².
#[inline]
fn sine_series<T: Real>(square: T) -> T {
    let [a, b, c, d] = [-1.0 / 6.0, 1.0 / 120.0, -1.0 / 5_040.0, 1.0 / 362_880.0].map(T::from_f64);
    if is_single::<T>() {
        return square.mul_add(b, a);
    }
    square.mul_add(square.mul_add(square.mul_add(d, c), b), a)
}

/// (1 − cos δ)/δ² as a polynomial in δ².
#[inline]
fn versine_series<T: Real>(square: T) -> T {
    let [a, b, c, d, e] =
        [1.0 / 2.0, -1.0 / 24.0, 1.0 / 720.0, -1.0 / 40_320.0, 1.0 / 3_628_800.0].map(T::from_f64);
    if is_single::<T>() {
        return square.mul_add(square.mul_add(c, b), a);
    }
    square.mul_add(square.mul_add(square.mul_add(square.mul_add(e, d), c), b), a)
}

#[cfg(test)]
mod tests {
    use super::Angle;

    /// Over many steps forwards and back, the error of sine and cosine stays below two units in the last place of 1.
    #[test]
    fn rotated_sines_stay_within_two_units_of_the_last_place() {
        let (mut near, mut worst) = (Angle::zero(), 0.0_f64);
        let (mut single, mut worst_single) = (Angle::zero(), 0.0_f64);
        for step in 0..200_000_u32 {
            let angle = 40.0 * (f64::from(step) * 1.1e-3).sin() + f64::from(step) * 1e-3;
            let (sin, cos) = near.sin_cos(angle);
            worst = worst.max((sin - angle.sin()).abs()).max((cos - angle.cos()).abs());
            #[allow(clippy::cast_possible_truncation, reason = "single precision is meant")]
            let narrow = angle as f32;
            let (sin, cos) = single.sin_cos(narrow);
            let exact = f64::from(narrow).sin_cos();
            worst_single =
                worst_single.max((f64::from(sin) - exact.0).abs()).max((f64::from(cos) - exact.1).abs());
        }
        assert!(worst < 2.0 * f64::EPSILON, "{worst}");
        assert!(worst_single < 2.0 * f64::from(f32::EPSILON), "{worst_single}");
    }

    #[test]
    fn what_is_no_number_is_handed_on_and_forgotten() {
        let mut near = Angle::zero();
        assert!(near.sin_cos(f64::NAN).0.is_nan());
        assert_eq!(near.sin_cos(0.3), 0.3_f64.sin_cos());
    }
}
