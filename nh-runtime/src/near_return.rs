//! The return to position constraints from near to them, as generated code takes it after every step of a run: what is
//! computed at one place is computed together, and what an iteration has to look at is here.

use crate::arrays::all_finite;
use crate::newton_return::is_last;
use crate::projection::{holds, is_settled, largest};
use crate::{ProjectionError, Scalar};

/// What a look at the constraints leads to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Next {
    /// The positions move.
    Positions,
    /// They are where they belong, and the velocities move.
    Velocities,
    /// Nothing moves.
    Nothing,
}

/// Newton's iteration for positions on which M constraints act, then one step for the velocities.
///
/// Positions have arrived where [`newton`](crate::newton_return::newton) stops. Velocities have after their step where
/// it is at most 2⁻¹³ of the largest: constraints that are affine in them then hold but for round-off, as long as
/// their condition is below 2¹⁰. Where changes do not fall as they do near to the constraints, where velocities change
/// by more, and where something is not finite, the way is left to iterations that lead back from further away.
/// Lanes go together.
#[derive(Clone, Copy, Debug)]
pub struct NearReturn<T, const M: usize> {
    /// The largest component of the positions at the start.
    scale: T,
    /// The largest residual at the start.
    residual: T,
    /// The residuals of the positions at the last look.
    before: [T; M],
    /// The size of the last change of positions, and of the one before.
    change: Option<T>,
    preceding: Option<T>,
    /// Whether this is no way that is near.
    is_far: bool,
}

impl<T: Scalar, const M: usize> NearReturn<T, M> {
    /// The way from these positions.
    #[inline]
    #[must_use]
    pub fn from<const N: usize>(start: &[T; N]) -> Self {
        Self {
            scale: largest(start),
            residual: T::ZERO,
            before: [T::ZERO; M],
            change: None,
            preceding: None,
            is_far: false,
        }
    }

    /// What comes next where the constraints on positions leave these residuals, and those on velocities these.
    #[inline]
    pub fn next<const R: usize>(&mut self, positions: &[T; M], velocities: &[T; R]) -> Next {
        if self.is_far {
            return Next::Nothing;
        }
        let mut is_there = holds(positions);
        if let Some(change) = self.change {
            is_there |= is_settled(change, self.scale, self.preceding)
                || is_last(change, self.scale, &self.before, positions);
            // far away, or among noise
            self.is_far = !is_there && self.preceding.is_some_and(|preceding| !falls(preceding, change));
        } else {
            self.residual = largest(positions).max(largest(velocities));
        }
        self.before = *positions;
        match (is_there, self.is_far) {
            (true, _) if !holds(velocities) => Next::Velocities,
            (false, false) => Next::Positions,
            _ => Next::Nothing,
        }
    }

    /// Positions after a change.
    #[inline]
    pub fn positions<const N: usize>(&mut self, mut present: [T; N], change: [T; N]) -> [T; N] {
        self.preceding = self.change;
        for (x, change) in present.iter_mut().zip(&change) {
            *x += *change;
        }
        self.change = Some(largest(&change));
        self.is_far = !all_finite::<T, _>(&present);
        present
    }

    /// Velocities after their change.
    #[inline]
    pub fn velocities<const N: usize>(&mut self, mut present: [T; N], change: [T; N]) -> [T; N] {
        for (v, change) in present.iter_mut().zip(&change) {
            *v += *change;
        }
        let is_small = largest(&present).all_ge(largest(&change) * T::from_f64(8192.0));
        self.is_far = !(is_small && all_finite::<T, _>(&present));
        present
    }

    /// Takes over the state that was moved, or lets the given one be moved from further away; the largest residual that
    /// was found.
    ///
    /// # Errors
    /// That of the latter.
    #[inline]
    pub fn end<S>(
        self,
        given: &mut S,
        moved: S,
        from_far: impl FnOnce(&mut S) -> Result<(), ProjectionError>,
    ) -> Result<T, ProjectionError> {
        if self.is_far {
            from_far(given)?;
        } else {
            *given = moved;
        }
        Ok(self.residual)
    }
}

/// Whether a change is, in every lane, less than half of the preceding one, or nothing.
#[inline]
fn falls<T: Scalar>(preceding: T, change: T) -> bool {
    let is_level = (change * T::from_f64(2.0)).select_gt(preceding, T::ONE, T::ZERO);
    T::ZERO.all_ge(is_level)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A return to x² + y² = 1 and x u + y v = 0, as it is generated, with the numbers of looks at the circle and of ways
    /// from far away.
    fn returned(given: &mut [f64; 4]) -> (Result<f64, ProjectionError>, u32, u32) {
        let [mut x, mut y, mut u, mut v] = *given;
        let (mut looks, mut from_far) = (0, 0);
        let mut way = NearReturn::from(&[x, y]);
        loop {
            looks += 1;
            let square = x * x + y * y;
            let (open, rate) = (square - 1.0, x * u + y * v);
            match way.next(&[open], &[rate]) {
                Next::Positions => {
                    let part = -0.5 * open / square;
                    [x, y] = way.positions([x, y], [part * x, part * y]);
                }
                Next::Velocities => {
                    let part = -rate / square;
                    [u, v] = way.velocities([u, v], [part * x, part * y]);
                    break;
                }
                Next::Nothing => break,
            }
        }
        let residual = way.end(given, [x, y, u, v], |_| {
            from_far += 1;
            Err(ProjectionError { iterations: 7, residual: 0.0 })
        });
        (residual, looks, from_far)
    }

    #[test]
    fn what_is_near_takes_two_looks_and_what_holds_takes_one() {
        let mut state = [0.6 + 1e-9, 0.8, 8.0, -6.0 + 1e-6];
        let (residual, looks, from_far) = returned(&mut state);
        let [x, y, u, v] = state;
        assert!((x * x + y * y - 1.0).abs() < 3e-16 && (x * u + y * v).abs() < 2e-15, "{state:?}");
        assert!((residual.unwrap() - 8e-7).abs() < 1e-8);
        assert_eq!((looks, from_far), (2, 0));
        let mut state = [1.0, 0.0, 0.0, 3.0];
        assert_eq!((returned(&mut state), state), ((Ok(0.0), 1, 0), [1.0, 0.0, 0.0, 3.0]));
    }

    #[test]
    fn it_goes_on_while_changes_fall() {
        let mut state = [3.0, 4.0, 8.0, -6.0 + 1e-6];
        let (residual, looks, from_far) = returned(&mut state);
        let [x, y, u, v] = state;
        assert!(
            (x - 0.6).abs() < 1e-6 && (x * x + y * y - 1.0).abs() < 3e-16 && (x * u + y * v).abs() < 2e-15
        );
        assert!(residual.is_ok() && looks <= 9 && from_far == 0, "{looks}");
    }

    #[test]
    fn what_is_far_away_is_left_to_others() {
        // velocities that change by more than a small part, what is no number, and no change that leads back
        for start in [[0.6, 0.8, 8.0, -5.0], [f64::NAN, 0.8, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]] {
            let mut state = start;
            let (residual, _, from_far) = returned(&mut state);
            assert!(residual.unwrap_err().iterations == 7 && from_far == 1, "{start:?}");
            assert_eq!(state.map(f64::to_bits), start.map(f64::to_bits));
        }
    }

    #[test]
    fn changes_that_do_not_fall_end_it() {
        let mut way = NearReturn::from(&[1.0]);
        let mut x = [1.0];
        assert_eq!(way.next(&[1.0], &[]), Next::Positions);
        x = way.positions(x, [0.3]);
        assert_eq!(way.next(&[1.0], &[]), Next::Positions);
        x = way.positions(x, [0.2]);
        assert_eq!(way.next(&[1.0], &[]), Next::Nothing);
        let mut given = 7.0;
        let from_far = |given: &mut f64| {
            *given = 8.0;
            Ok(())
        };
        assert_eq!((way.end(&mut given, x[0], from_far), given), (Ok(1.0), 8.0));
    }
}
