//! The return to position constraints from near to them, as generated code takes it after every step of a run: what is
//! computed at one place is computed together, and what an iteration has to look at is here.

use crate::arrays::all_finite;
use crate::projection::{holds, largest};
use crate::rounding::{further, grow, is_last, is_settled, sizes};
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
/// each moves by at most 2⁻¹³ of itself: constraints that are affine in them then hold but for round-off, as long as
/// their condition is below 2¹⁰. Where changes do not fall as they do near to the constraints, where velocities change
/// by more, and where something is not finite, the way is left to iterations that lead back from further away.
/// Lanes go together.
#[derive(Clone, Copy, Debug)]
pub struct NearReturn<T, const N: usize, const M: usize> {
    /// The largest values of the positions so far.
    sizes: [T; N],
    /// The largest residual at the start.
    residual: T,
    /// The residuals of the positions at the last look.
    before: [T; M],
    /// The last change of positions, and the one before.
    change: Option<[T; N]>,
    preceding: Option<[T; N]>,
    /// How often positions move on for the derivatives that numbers carry, once they have arrived.
    further: u32,
    is_there: bool,
    /// Whether this is no way that is near.
    is_far: bool,
}

impl<T: Scalar, const N: usize, const M: usize> NearReturn<T, N, M> {
    /// The way from these positions.
    #[inline]
    #[must_use]
    pub fn from(start: &[T; N]) -> Self {
        Self {
            sizes: sizes(start),
            residual: T::ZERO,
            before: [T::ZERO; M],
            change: None,
            preceding: None,
            further: further::<T>(),
            is_there: false,
            is_far: false,
        }
    }

    /// What comes next where the constraints on positions leave these residuals, and those on velocities these.
    #[inline]
    pub fn next<const R: usize>(&mut self, positions: &[T; M], velocities: &[T; R]) -> Next {
        if self.is_far {
            return Next::Nothing;
        }
        if let (Some(change), false) = (&self.change, self.is_there) {
            self.is_there = is_settled(change, &self.sizes, self.preceding.as_ref())
                || is_last(change, &self.sizes, &self.before, positions);
            // far away, or among noise
            let falls = |preceding: &[T; N]| falls(preceding, change, &self.sizes);
            self.is_far = !self.is_there && !self.preceding.as_ref().is_none_or(falls);
        }
        if self.change.is_none() {
            self.residual = largest(positions).max(largest(velocities));
        }
        self.before = *positions;
        let is_on = holds(positions);
        if self.is_there && !is_on && self.further > 0 {
            self.further -= 1;
            return Next::Positions;
        }
        let is_there = self.is_there || is_on;
        match (is_there, self.is_far && !is_on) {
            (true, _) if !holds(velocities) => Next::Velocities,
            (false, false) => Next::Positions,
            _ => Next::Nothing,
        }
    }

    /// Positions after a change.
    #[inline]
    pub fn positions(&mut self, mut present: [T; N], change: [T; N]) -> [T; N] {
        self.preceding = self.change;
        for (x, change) in present.iter_mut().zip(&change) {
            *x += *change;
        }
        grow(&mut self.sizes, &present);
        self.change = Some(change);
        self.is_far = !all_finite::<T, _>(&present);
        present
    }

    /// Velocities after their change.
    #[inline]
    pub fn velocities<const K: usize>(&mut self, mut present: [T; K], change: [T; K]) -> [T; K] {
        let mut large = T::ZERO;
        for (v, change) in present.iter_mut().zip(&change) {
            *v += *change;
            large = large.max((change.abs() * T::from_f64(8192.0)).select_gt(v.abs(), T::ONE, T::ZERO));
        }
        self.is_far = !(T::ZERO.all_ge(large) && all_finite::<T, _>(&present));
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

/// Whether a change is, in every lane, less than half of the preceding one, nothing, or rounding.
#[inline]
fn falls<T: Scalar, const N: usize>(preceding: &[T; N], change: &[T; N], sizes: &[T; N]) -> bool {
    let mut level = T::ZERO;
    for ((preceding, change), size) in preceding.iter().zip(change).zip(sizes) {
        let change = change.abs();
        let is_level = (change * T::from_f64(2.0)).select_gt(preceding.abs(), T::ONE, T::ZERO);
        let moves = (*size + change * T::from_f64(0.125)).select_gt(*size, T::ONE, T::ZERO);
        level = level.max(is_level * moves);
    }
    T::ZERO.all_ge(level)
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

    /// A coordinate in any unit, beside one that is large: looks are the same, and bits.
    #[test]
    fn units_matter_to_nothing() {
        let ended = |unit: f64, large: f64| {
            let (mut x, mut y, mut z, mut looks) = (0.6 + 1e-3, 0.8 * unit, large, 0);
            let mut way = NearReturn::from(&[x, y, z]);
            loop {
                looks += 1;
                let square = x * x + (y / unit) * (y / unit);
                let part = -0.5 * (square - 1.0) / square;
                if way.next(&[square - 1.0], &[]) != Next::Positions {
                    break;
                }
                [x, y, z] = way.positions([x, y, z], [part * x, part * y, 0.0]);
            }
            ([x, y / unit].map(f64::to_bits), looks)
        };
        let plain = ended(1.0, 0.0);
        for unit in [1e-100, 1e-12, 1e-3, 1e9, 1e100].map(|unit: f64| unit.log2().round().exp2()) {
            assert_eq!((ended(unit, 0.0), ended(1.0, unit)), (plain, plain), "{unit}");
        }
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
