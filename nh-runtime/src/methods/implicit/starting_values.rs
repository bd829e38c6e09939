//! Where iterations start from: what the last steps were, and by how much they missed what was expected of them.

use crate::Real;
use crate::arrays::Array;

/// The differences that are kept. In steps of equal length each is smaller than the one before by a factor of
/// about h, until only rounding is left.
const LEVELS: usize = 7;

/// By how much the steps so far missed a first guess, as backward differences ∇ᵏ of these vectors.
///
/// A guess that is mended by the first k of them, ∇⁰ + … + ∇ᵏ⁻¹, would have missed the last step by ∇ᵏ: the least
/// of them says how many to take, in each component by itself. Where the motion is smooth, they reach round-off
/// (Hairer, Lubich, Wanner, Geometric Numerical Integration, VIII.6.1, extrapolate the stages of one step
/// instead); where it is not, the guess is left as it is.
#[derive(Clone, Copy)]
pub(super) struct Misses<V> {
    differences: [V; LEVELS],
    known: usize,
}

impl<V> Misses<V> {
    /// Before any step.
    pub(super) fn none(zero: V) -> Self
    where
        V: Copy,
    {
        Self { differences: [zero; LEVELS], known: 0 }
    }

    /// Adds what the guess is likely to miss.
    pub(super) fn mend<T: Real>(&self, guess: &mut V)
    where
        V: Array<T>,
    {
        for (i, guess) in guess.as_mut().iter_mut().enumerate() {
            let mut differences = self.differences.iter().take(self.known);
            let mut next = || differences.next().and_then(|difference| difference.as_ref().get(i).copied());
            let Some(mut first) = next() else { return };
            while let Some(second) = next()
                && second.abs() < first.abs()
            {
                *guess += first;
                first = second;
            }
        }
    }

    /// Takes note of what has been missed.
    pub(super) fn note<T: Real>(&mut self, found: &V, guess: &V)
    where
        V: Array<T>,
    {
        let mut last = *found;
        for (last, guess) in last.as_mut().iter_mut().zip(guess.as_ref()) {
            *last -= *guess;
        }
        for difference in &mut self.differences {
            let before = core::mem::replace(difference, last);
            for (last, before) in last.as_mut().iter_mut().zip(before.as_ref()) {
                *last -= *before;
            }
        }
        self.known = LEVELS.min(self.known + 1);
    }
}

#[cfg(test)]
mod tests {
    use std::vec::Vec;

    use super::*;

    /// What each step is expected to be from those before, where the guess is the last one.
    fn expected(steps: impl IntoIterator<Item = f64>) -> Vec<f64> {
        let mut misses = Misses::none([0.0]);
        let mut last = None;
        let mut expected = Vec::new();
        for found in steps {
            let mut next = [last.unwrap_or(0.0)];
            misses.mend(&mut next);
            expected.extend(next);
            if let Some(last) = last {
                misses.note(&[found], &[last]);
            }
            last = Some(found);
        }
        expected
    }

    #[test]
    fn smooth_motions_are_foreseen() {
        // the seventh difference is 0.02⁷ = 1.3e-12
        let motion = |n: u8| (0.02 * f64::from(n)).sin();
        let foreseen = expected((0..40).map(motion));
        for (n, foreseen) in (0..40).zip(foreseen).skip(12) {
            assert!((foreseen - motion(n)).abs() < 2e-12, "{n}: {foreseen}");
        }
    }

    #[test]
    fn what_is_not_smooth_is_not_continued() {
        let motion = |n: u8| if n.is_multiple_of(2) { 1.0 } else { -1.0 };
        for foreseen in expected((0..40).map(motion)) {
            assert!(foreseen.abs() < 1.0 + 1e-15, "{foreseen}");
        }
    }
}
