//! The return to position constraints from near to them, as generated code takes it after every step of a run: what is
//! computed at one place is computed together, and what an iteration has to look at is here.

use crate::arrays::all_finite;
use crate::projection::largest;
use crate::rounding::{is_last, is_settled, rounding_of_one, sizes};
use crate::{ProjectionError, Scalar};

/// The looks after which a way is no near one: it began where rounding was some ten times as large.
const MOST_LOOKS: u32 = 8;
/// How often positions change by what is foreseen at the first place.
const FORESEEN: u32 = 3;
/// How many roundings of the terms of an equation are nothing.
const ROUNDINGS: f64 = 2.0;
/// How many times as much is nothing of constraints on velocities that further changes do not mend.
const HELD_UP: f64 = 16.0;
/// So many roundings tell how constraints bend.
const TELLING: f64 = 1024.0;

/// Newton's iteration for N positions on which M constraints act, and for the velocities beside them, by the factors of the
/// first place.
///
/// An equation holds where what is left of it is a few roundings of its terms. How constraints change near to the first place is
/// known to second order. Where what that leaves of them is rounding, and the third order would be, positions have arrived
/// without a further look: the part of the change that is of second order is to the first as the third is to the second. Velocities
/// move by what they are off where the positions go to, to first order.
///
/// Else looks follow. What the factors leave of an equation is to what was before as the way is to the distance at which constraints
/// bend, and so is what they would leave of what is left now: positions have arrived where all equations hold, and by a step
/// that moves each by at most 64 units of its last place while the step after it would be none. Velocities have arrived with a step of at most
/// 2⁻¹³ of themselves of which no more than a few dozen units of their last places are left at worst. Where equations do not fall as they do near
/// to the constraints, where velocities change by more, and where something is not finite, the way is left to iterations that
/// lead back from further away, and so is that of derivatives that numbers carry. Lanes go together.
#[derive(Clone, Copy, Debug)]
#[expect(clippy::struct_excessive_bools, reason = "they stay in registers, and are asked for one by one")]
pub struct NearReturn<T, const N: usize, const M: usize> {
    /// The largest residual at the start.
    residual: T,
    /// What is nothing of each equation.
    rounding: [T; M],
    /// What was left of them at the last look.
    before: [T; M],
    /// How far positions have gone since.
    change: [T; N],
    preceding: [T; N],
    /// What the factors leave of a change.
    left_of_change: T,
    looks: u32,
    /// How often positions have changed since the last look.
    changes: u32,
    /// Whether positions are where they belong.
    holds: bool,
    /// Whether the next change leads there.
    is_last: bool,
    /// Whether velocities are where they belong.
    are_settled: bool,
    /// Whether this is no way that is near.
    is_far: bool,
}

impl<T: Scalar, const N: usize, const M: usize> NearReturn<T, N, M> {
    /// The way from where the constraints on positions leave these residuals, beside terms of these sizes, and those on velocities
    /// these.
    #[inline]
    #[must_use]
    pub fn from<const R: usize>(positions: &[T; M], velocities: &[T; R], sizes: &[T; M]) -> Self {
        Self {
            residual: largest(positions).max(largest(velocities)),
            rounding: sizes.map(rounding_of),
            before: *positions,
            change: [T::ZERO; N],
            preceding: [T::ZERO; N],
            left_of_change: T::ZERO,
            looks: 1,
            changes: 0,
            holds: are_rounding(positions, sizes),
            is_last: false,
            are_settled: true,
            is_far: T::DERIVATIVES > 0,
        }
    }

    /// Whether positions are where they belong.
    #[inline]
    #[must_use]
    pub fn holds(&self) -> bool {
        self.holds
    }

    /// Whether positions are where they were looked at first.
    #[inline]
    #[must_use]
    pub fn is_first(&self) -> bool {
        self.looks == 1
    }

    /// Whether positions go from there to where it is foreseen that they belong.
    #[inline]
    #[must_use]
    pub fn has_foreseen(&self) -> bool {
        self.looks == 1 && self.changes > 0
    }

    /// Whether this is no way that is near.
    #[inline]
    #[must_use]
    pub fn is_far(&self) -> bool {
        self.is_far
    }

    /// Whether positions change before the next look.
    #[inline]
    #[must_use]
    pub fn moves_positions(&self) -> bool {
        let most = if self.looks == 1 { FORESEEN } else { 1 };
        !self.holds && self.changes < most
    }

    /// Whether everything is where it belongs, or far away.
    #[inline]
    #[must_use]
    pub fn ends(&self) -> bool {
        self.is_far || ((self.holds || self.is_last) && self.are_settled)
    }

    /// Whether velocities alone were not where they belong, and are, but for what the next change would be made of: rounding of
    /// terms of these sizes. One of them is small beside others, or constraints are nearly dependent.
    #[must_use]
    pub fn is_held_up_by<const R: usize>(&self, velocities: &[T; R], sizes: &[T; R]) -> bool {
        let nothing = |size: T| rounding_of(size) * T::from_f64(HELD_UP);
        let mut pairs = velocities.iter().zip(sizes);
        self.holds && !self.are_settled && pairs.all(|(left, size)| nothing(*size).all_ge(left.abs()))
    }

    /// How far positions have moved after a further change: as far as the numbers have digits for it.
    #[inline]
    pub fn displaced(&mut self, present: &[T; N], moved: &[T; N], change: &[T; N]) -> [T; N] {
        self.changes += 1;
        let mut displaced = *moved;
        for (moved, (x, change)) in displaced.iter_mut().zip(present.iter().zip(change)) {
            *moved = (*x + (*moved + *change)) - *x;
        }
        displaced
    }

    /// What is left of equations by how they change, to first and by the second order.
    #[inline]
    pub fn foresees(&mut self, open: &mut [T], nearby: &[T]) {
        let (slopes, bends) = nearby.split_at(nearby.len() / 2);
        let mut part = T::ZERO;
        let mut hold = true;
        let equations = self.before.iter().zip(&self.rounding).zip(slopes.iter().zip(bends));
        for (open, ((before, rounding), (slope, bend))) in open.iter_mut().zip(equations) {
            *open = (*before + *slope) + *bend;
            hold &= rounding.all_ge(open.abs());
            let (bend, before) = (bend.abs(), before.abs());
            // rounding tells nothing of how constraints bend
            part += before.select_gt(T::from_f64(TELLING) * *rounding, bend / before, T::ZERO);
        }
        for (bend, rounding) in bends.iter().zip(&self.rounding) {
            hold &= rounding.all_ge(bend.abs() * part);
        }
        self.left_of_change = part + part;
        self.holds = hold;
    }

    /// What is left of constraints on velocities where positions go to, which changes by these beside terms of these sizes.
    #[inline]
    pub fn turns(&mut self, open: &mut [T], turns: &[T], sizes: &[T]) {
        let of_velocities = open.len().saturating_sub(turns.len());
        let mut part = T::ZERO;
        for (open, (turn, size)) in open.iter_mut().skip(of_velocities).zip(turns.iter().zip(sizes)) {
            *open += *turn;
            let turn = turn.abs();
            part += turn.select_gt(T::ZERO, turn / *size, T::ZERO);
        }
        self.left_of_change = self.left_of_change.max(part + part);
    }

    /// The way on from what is left where the positions are now: by value, so that what is known stays in registers where no
    /// further look follows.
    #[inline(never)]
    #[must_use]
    pub fn next(mut self, present: &[T; N], positions: &[T; M]) -> Self {
        let mut left = T::ZERO;
        let mut of_change = T::ZERO;
        for ((before, now), rounding) in self.before.iter_mut().zip(positions).zip(&self.rounding) {
            let (left_before, left_now) = (before.abs(), now.abs());
            let ratio = left_now / left_before;
            left += left_now.select_gt(*rounding, ratio, T::ZERO);
            of_change += left_before.select_gt(T::from_f64(TELLING) * *rounding, ratio, T::ZERO);
            *before = *now;
        }
        // what is foreseen goes by its own factors, and others follow it by those of the first place
        if self.looks > 1 {
            self.left_of_change = self.left_of_change.max(of_change);
        }
        self.looks += 1;
        self.changes = 0;
        (self.holds, self.is_last) = (T::ZERO.all_ge(left), false);
        if !self.holds {
            if T::from_f64(1.0 / 1024.0).all_ge(left) {
                self.is_last = is_last(&self.change, &sizes(present), left * T::from_f64(1.0 / 128.0));
            } else {
                self.look_closer(present, left);
            }
        }
        self.is_far |= self.looks > MOST_LOOKS;
        self
    }

    /// Whether it has arrived although more than a little is left, or is far away, or among noise.
    #[inline(never)]
    fn look_closer(&mut self, present: &[T; N], left: T) {
        let sizes = sizes(present);
        let preceding = (self.looks > 2).then_some(&self.preceding);
        self.holds = is_settled(&self.change, &sizes, preceding)
            || (preceding.is_some() && is_held_up(&self.change, &sizes, left));
        let falls = |preceding: &[T; N]| falls(preceding, &self.change, &sizes);
        // what is no number is no end
        let is_number = left.all_ge(T::ZERO) && all_finite::<T, _>(present);
        self.holds &= is_number;
        self.is_far = !is_number || (!self.holds && !preceding.is_none_or(falls));
    }

    /// Positions where they go to.
    #[inline]
    pub fn positions(&mut self, mut present: [T; N], moved: [T; N]) -> [T; N] {
        for (x, moved) in present.iter_mut().zip(&moved) {
            *x += *moved;
        }
        self.preceding = self.change;
        self.change = moved;
        present
    }

    /// Velocities after a change.
    #[inline]
    pub fn velocities<const K: usize>(&mut self, mut present: [T; K], change: [T; K]) -> [T; K] {
        let left = self.left_of_change * T::from_f64(1.0 / 64.0);
        // of second order where positions have turned the constraints
        let square = of_roundings(self.left_of_change * self.left_of_change);
        let is_near = self.looks > 1 || T::from_f64(32.0).all_ge(square);
        let mut open = T::ZERO;
        for (v, change) in present.iter_mut().zip(&change) {
            let (size, moved) = (v.abs(), change.abs());
            *v += *change;
            open += (moved * T::from_f64(8192.0)).select_gt(size, T::ONE, T::ZERO);
            open += (size + moved * left) - size;
        }
        self.are_settled = is_near && T::ZERO.all_ge(open);
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

/// A number in units of the rounding of 1.
#[inline]
fn of_roundings<T: Scalar>(number: T) -> T {
    number / rounding_of_one::<T>()
}

/// What is nothing beside terms of a size.
#[inline]
fn rounding_of<T: Scalar>(size: T) -> T {
    size * (rounding_of_one::<T>() * T::from_f64(ROUNDINGS))
}

/// Whether, in every lane, what is left of each equation is a few roundings of its terms.
#[inline]
#[must_use]
pub fn are_rounding<T: Scalar, const M: usize>(residuals: &[T; M], sizes: &[T; M]) -> bool {
    residuals.iter().zip(sizes).fold(true, |all, (left, size)| all & rounding_of(*size).all_ge(left.abs()))
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
        let (mut looks, mut from_far) = (1, 0);
        let look = |[x, y, u, v]: [f64; 4]| ([x * x + y * y - 1.0], [x * u + y * v]);
        let size = |[x, y, u, v]: [f64; 4]| ([x * x + y * y + 1.0], [(x * u).abs() + (y * v).abs()]);
        let state = [x, y, u, v];
        let ((circle, rates), (sizes, of_rates)) = (look(state), size(state));
        let mut way = NearReturn::from(&circle, &rates, &sizes);
        if !(way.is_far() || (way.holds() && are_rounding(&rates, &of_rates))) {
            let mut open = [circle[0], rates[0]];
            let (at, over) = ([x, y], 1.0 / (x * x + y * y));
            loop {
                let mut moved = [0.0; 2];
                while way.moves_positions() {
                    let change = at.map(|along| -0.5 * open[0] * over * along);
                    moved = way.displaced(&[x, y], &moved, &change);
                    if way.is_first() {
                        let slope = 2.0 * (x * moved[0] + y * moved[1]);
                        let bend = moved[0] * moved[0] + moved[1] * moved[1];
                        way.foresees(&mut open, &[slope, bend]);
                    }
                }
                if way.has_foreseen() {
                    way.turns(&mut open, &[u * moved[0] + v * moved[1]], &of_rates);
                }
                [u, v] = way.velocities([u, v], at.map(|along| -open[1] * over * along));
                [x, y] = way.positions([x, y], moved);
                if way.ends() {
                    break;
                }
                looks += 1;
                let (circle, rates) = look([x, y, u, v]);
                open = [circle[0], rates[0]];
                way = way.next(&[x, y], &circle);
                if way.is_held_up_by(&rates, &size([x, y, u, v]).1) {
                    break;
                }
            }
        }
        let residual = way.end(given, [x, y, u, v], |_| {
            from_far += 1;
            Err(ProjectionError { iterations: 7, residual: 0.0 })
        });
        (residual, looks, from_far)
    }

    #[test]
    fn what_is_near_and_what_holds_take_one_look() {
        let mut state = [0.6 + 1e-9, 0.8, 8.0, -6.0 + 1e-6];
        let (residual, looks, from_far) = returned(&mut state);
        let [x, y, u, v] = state;
        assert!((x * x + y * y - 1.0).abs() < 2e-15 && (x * u + y * v).abs() < 1e-14, "{state:?}");
        assert!((residual.unwrap() - 8e-7).abs() < 1e-8);
        assert_eq!((looks, from_far), (1, 0));
        let mut state = [1.0, 0.0, 0.0, 3.0];
        assert_eq!((returned(&mut state), state), ((Ok(0.0), 1, 0), [1.0, 0.0, 0.0, 3.0]));
    }

    /// What has been returned is returned as it is.
    #[test]
    fn a_return_is_not_repeated() {
        for off in [0.0, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3] {
            for angle in [0.1_f64, 0.7, 1.5, 2.9, 4.0] {
                let (sin, cos) = angle.sin_cos();
                let mut state = [cos + off, sin - 0.3 * off, -9.0 * sin, 9.0 * cos + off];
                // the last digits of velocities, where it came from farther
                assert!(returned(&mut state).0.is_ok() && returned(&mut state).0.is_ok());
                let before = state;
                assert_eq!((returned(&mut state).1, state), (1, before), "{off} {angle}");
            }
        }
    }

    /// Velocities turn with the positions, and what is farther takes more looks.
    #[test]
    fn velocities_follow_the_positions() {
        for (off, most) in [(1e-10, 1), (1e-9, 1), (1e-7, 2), (1e-5, 3), (1e-3, 4)] {
            let mut state = [0.6 + off, 0.8 - 0.3 * off, 8.0, -6.0 + 100.0 * off.min(1e-6)];
            let (residual, looks, from_far) = returned(&mut state);
            let [x, y, u, v] = state;
            assert!((x * x + y * y - 1.0).abs() < 2e-15 && (x * u + y * v).abs() < 4e-14, "{off} {state:?}");
            assert!(residual.is_ok() && looks <= most && from_far == 0, "{off} {looks} {from_far}");
        }
    }

    #[test]
    fn far_velocities_are_left_to_others() {
        for velocity in [f64::NAN, f64::INFINITY] {
            let mut state = [0.6 + 1e-7, 0.8, 8.0, velocity];
            let (residual, _, from_far) = returned(&mut state);
            assert!(residual.is_err() && from_far == 1, "{velocity}: {from_far}");
        }
    }

    #[test]
    fn what_is_far_away_is_left_to_others() {
        // far from the circle, what is no number, and no change that leads back
        for start in [[1e9, 2e9, 8.0, -5.0], [f64::NAN, 0.8, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]] {
            let mut state = start;
            let (residual, _, from_far) = returned(&mut state);
            assert!(residual.unwrap_err().iterations == 7 && from_far == 1, "{start:?}");
            assert_eq!(state.map(f64::to_bits), start.map(f64::to_bits));
        }
    }

    #[test]
    fn derivatives_that_numbers_carry_are_left_to_others() {
        let open = [crate::Jet::<f64, 1>::ZERO];
        let way = NearReturn::<_, 1, 1>::from(&open, &open, &open);
        assert!(way.is_far() && way.ends());
    }
}
