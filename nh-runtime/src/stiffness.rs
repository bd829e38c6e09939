//! Whether an explicit method is held back by stability
//! (Hairer, Wanner, Solving Ordinary Differential Equations II, section IV.2, the code DOPRI5).

use crate::Real;

/// What has been seen of the product of steps and eigenvalues.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stiffness<T> {
    /// The steps until one is watched; the step that was, with its length, is looked at before the next.
    steps_left: u32,
    watched: Option<T>,
    /// How often steps were at the bound of stability, and how often in a row they were not since.
    strikes: u32,
    passes: u32,
    /// The length of the last step that was judged.
    length: T,
    /// Whether so many strikes have been confirmed.
    is_confirmed: bool,
}

/// A step in so many is watched, as long as nothing is suspicious; then each.
const SELDOM: u32 = 32;
/// So many strikes, without so many passes in a row, are stiffness.
const STRIKES: u32 = 15;
const PASSES: u32 = 6;

impl<T: Real> Stiffness<T> {
    pub(crate) fn new() -> Self {
        Self {
            steps_left: SELDOM,
            watched: None,
            strikes: 0,
            passes: 0,
            length: T::ZERO,
            is_confirmed: false,
        }
    }

    /// Takes note of an accepted step; whether the next is to be watched.
    #[inline]
    pub(crate) fn count(&mut self, length: T) -> bool {
        if self.steps_left == 0 {
            self.watched = Some(length);
            self.steps_left = SELDOM;
        }
        self.steps_left -= 1;
        self.steps_left == 0
    }

    /// Whether a step was watched.
    #[inline]
    pub(crate) fn is_due(&self) -> bool {
        self.watched.is_some()
    }

    /// Takes note of an estimate of the largest eigenvalue, in a step that was watched; whether the next one is to be watched
    /// at once.
    pub(crate) fn judge(&mut self, rate: Option<T>, held: T) -> bool {
        let (Some(length), Some(rate)) = (self.watched.take(), rate) else { return false };
        self.length = length;
        if (length * rate).abs() > held {
            self.strikes = self.strikes.saturating_add(1);
            self.passes = 0;
        } else if self.strikes > 0 {
            self.passes += 1;
            if self.passes == PASSES {
                self.dismiss();
            }
        }
        if self.is_suspected() {
            self.steps_left = 0;
        }
        self.is_suspected()
    }

    /// Nothing is suspicious any more.
    fn dismiss(&mut self) {
        (self.strikes, self.passes, self.is_confirmed) = (0, 0, false);
    }

    /// Whether strikes have become so many that a better estimate has to confirm them: two states that are apart by chance
    /// stretch by the units of their components as well.
    pub(crate) fn is_to_be_confirmed(&self) -> bool {
        self.strikes >= STRIKES && !self.is_confirmed
    }

    /// Takes note of that estimate.
    pub(crate) fn confirm(&mut self, rate: T, held: T) {
        if (self.length * rate).abs() > held {
            self.is_confirmed = true;
        } else {
            self.dismiss();
            self.steps_left = SELDOM;
        }
    }

    /// Whether each step is watched.
    pub(crate) fn is_suspected(&self) -> bool {
        self.strikes > 0
    }

    /// Whether the equations are stiff for the method.
    pub(crate) fn is_certain(&self) -> bool {
        self.is_confirmed
    }
}
