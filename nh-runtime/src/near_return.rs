//! The return to position constraints from near to them, as generated code takes it after every step of a run: what is
//! computed at one place is computed together, and what an iteration has to look at is here.

use crate::arrays::all_finite;
use crate::projection::{holds, largest};
use crate::rounding::{further, is_last, is_settled, left_over, sizes};
use crate::{ProjectionError, Scalar};

/// What a look at the constraints leads to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Next {
    /// The positions move, and another look follows.
    Positions,
    /// The positions move by their last digits and the velocities by what they are off here: no look follows.
    Both,
    /// Positions are where they belong, and the velocities move.
    Velocities,
    /// Nothing moves.
    Nothing,
}

impl Next {
    /// Whether velocities move.
    #[inline]
    #[must_use]
    pub fn moves_velocities(self) -> bool {
        matches!(self, Self::Both | Self::Velocities)
    }

    /// Whether positions move.
    #[inline]
    #[must_use]
    pub fn moves_positions(self) -> bool {
        matches!(self, Self::Both | Self::Positions)
    }
}

/// The steps after which a way is no near one: it began where rounding was some ten times as large.
const MOST_STEPS: u32 = 8;

/// Newton's iteration for positions on which M constraints act, then one step for the velocities.
///
/// Positions have arrived where [`newton`](crate::newton_return::newton) stops, or by a step that moves each by at most 64
/// units of its last place. Velocities move beside that step, by what they are off where it starts: what it makes of the
/// rows of their constraints is no more of these either. They have arrived after their step where each moves by at most
/// 2⁻¹³ of itself: constraints that are affine in them then hold but for round-off, as long as their condition is below
/// 2¹⁰. Where changes do not fall as they do near to the constraints, where velocities change by more, and where something
/// is not finite, the way is left to iterations that lead back from further away. Lanes go together.
#[derive(Clone, Copy, Debug)]
pub struct NearReturn<T, const N: usize, const M: usize> {
    /// The sizes of the positions: where they were at first, and how far they have moved.
    sizes: [T; N],
    /// The largest residual at the start.
    residual: T,
    /// The residuals of the positions at the last look.
    before: [T; M],
    /// The last change of positions, and the one before.
    change: [T; N],
    preceding: [T; N],
    /// How often positions have moved.
    steps: u32,
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
            change: [T::ZERO; N],
            preceding: [T::ZERO; N],
            steps: 0,
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
        let is_on = holds(positions);
        if self.steps == 0 {
            self.residual = largest(positions).max(largest(velocities));
        } else if !(self.is_there || is_on) {
            let left_over = left_over(&self.before, positions);
            self.is_there = is_last(&self.change, &self.sizes, left_over);
            // what falls by three digits is on its way
            let falls = T::from_f64(1.0 / 1024.0).all_ge(left_over);
            if !self.is_there && !falls {
                self.look_closer(left_over);
            } else if !self.is_there && T::DERIVATIVES == 0 {
                let left_over = left_over * T::from_f64(1.0 / 128.0);
                if is_last(&self.change, &self.sizes, left_over) {
                    return Next::Both;
                }
            }
        }
        self.before = *positions;
        if self.is_there && !is_on && self.further > 0 {
            self.further -= 1;
            return Next::Positions;
        }
        match (self.is_there || is_on, self.is_far) {
            (true, _) if !holds(velocities) => Next::Velocities,
            (false, false) => Next::Positions,
            _ => Next::Nothing,
        }
    }

    /// Whether it has arrived although more than a little is left, or is far away, or among noise.
    #[inline(never)]
    fn look_closer(&mut self, left_over: T) {
        let preceding = (self.steps > 1).then_some(&self.preceding);
        self.is_there = is_settled(&self.change, &self.sizes, preceding)
            || (preceding.is_some() && is_held_up(&self.change, &self.sizes, left_over));
        let falls = |preceding: &[T; N]| falls(preceding, &self.change, &self.sizes);
        self.is_far = self.steps > MOST_STEPS || (!self.is_there && !preceding.is_none_or(falls));
    }

    /// Positions after a change.
    #[inline]
    pub fn positions(&mut self, mut present: [T; N], change: [T; N]) -> [T; N] {
        self.preceding = self.change;
        self.steps += 1;
        for (size, (x, change)) in self.sizes.iter_mut().zip(present.iter_mut().zip(&change)) {
            *x += *change;
            *size += change.abs();
        }
        self.change = change;
        self.is_far |= !all_finite::<T, _>(&present);
        present
    }

    /// Velocities after their change.
    #[inline]
    pub fn velocities<const K: usize>(&mut self, mut present: [T; K], change: [T; K]) -> [T; K] {
        let mut large = T::ZERO;
        for (v, change) in present.iter_mut().zip(&change) {
            *v += *change;
            large += (change.abs() * T::from_f64(8192.0)).select_gt(v.abs(), T::ONE, T::ZERO);
        }
        self.is_far |= !(T::ZERO.all_ge(large) && all_finite::<T, _>(&present));
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
#[inline(never)]
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

/// Whether some variable has not the digits that are asked of it, a crank that has turned for long, and others would move by
/// less than 4096 units of their last places to make up for that. They would by ever less, as it takes its share again and
/// again.
#[inline(never)]
fn is_held_up<T: Scalar, const N: usize>(change: &[T; N], sizes: &[T; N], left_over: T) -> bool {
    let stays = |(change, size): (&T, &T)| {
        let change = change.abs();
        change.all_ne(T::ZERO) && size.all_ge(*size + change)
    };
    change.iter().zip(sizes).any(stays) && is_last(change, sizes, left_over * T::from_f64(1.0 / 8192.0))
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
            let next = way.next(&[open], &[rate]);
            let at = [x, y];
            if next.moves_velocities() {
                let part = -rate / square;
                [u, v] = way.velocities([u, v], at.map(|x| part * x));
            }
            if next.moves_positions() {
                let part = -0.5 * open / square;
                [x, y] = way.positions(at, at.map(|x| part * x));
            }
            if next != Next::Positions {
                break;
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

    /// After one step positions are off by digits that one more sets right, without a look at them.
    #[test]
    fn last_digits_take_no_further_look() {
        for off in [1e-8, 3e-8, 1e-7, 1.5e-7] {
            let mut state = [0.6 + off, 0.8 - 0.3 * off, 8.0, -6.0 + 1e-5];
            let (residual, looks, from_far) = returned(&mut state);
            let [x, y, u, v] = state;
            assert!((x * x + y * y - 1.0).abs() < 3e-16 && (x * u + y * v).abs() < 2e-14, "{state:?}");
            assert_eq!((residual.is_ok(), looks, from_far), (true, 2, 0), "{off}");
        }
    }

    /// Where positions take their last digits and velocities are far away, these are left to others all the same.
    #[test]
    fn far_velocities_beside_last_digits_are_left_to_others() {
        for velocity in [-5.0, f64::NAN] {
            let mut state = [0.6 + 1e-7, 0.8, 8.0, velocity];
            let (residual, looks, from_far) = returned(&mut state);
            assert!(residual.is_err() && (looks, from_far) == (2, 1), "{velocity}: {looks} {from_far}");
        }
    }

    /// A crank that has turned for long has not the digits by which a slide follows it: it costs no look after a thousand turns,
    /// and the slide is as near to where it belongs as the crank's digits are apart.
    #[test]
    fn a_variable_with_fewer_digits_holds_nothing_up() {
        for (turns, most) in [(0.0, 3), (10.0, 3), (1e3, 3), (1e5, 8)] {
            let (mut a, mut s, mut looks) = (0.7 + core::f64::consts::TAU * turns, 0.0, 0_u32);
            s += a.sin() + 1e-7;
            let mut way = NearReturn::from(&[a, s]);
            loop {
                looks += 1;
                let (open, slope) = (s - a.sin(), a.cos());
                let next = way.next(&[open], &[]);
                if next.moves_positions() {
                    let part = -open / (1.0 + slope * slope);
                    [a, s] = way.positions([a, s], [-slope * part, part]);
                }
                if next != Next::Positions {
                    break;
                }
            }
            let grain = a * f64::EPSILON;
            assert!((s - a.sin()).abs() <= grain && !way.is_far && looks <= most, "{turns} {looks}");
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

    /// Each step halves the distance, and rounding where it began would be taken for that of the circle.
    #[test]
    fn a_way_of_many_halvings_is_left_to_others() {
        for (power, most) in [(2, 0), (20, 1), (60, 1)] {
            let far = 2.0_f64.powi(power);
            let (_, _, from_far) = returned(&mut [0.6 * far, 0.8 * far, 8.0, -6.0]);
            assert_eq!(from_far, most, "{power}");
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
