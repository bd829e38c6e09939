//! The times of the methods of fixed step.

use crate::{IntegrationError, Real};

/// The share of a step up to which round-off in the time may be left out of its length.
const NEGLIGIBLE: f64 = 1e-3;

/// Checks the length of a step.
pub(super) fn check_step<T: Real>(step: T) -> Result<(), IntegrationError> {
    if step > T::ZERO && step.is_finite() {
        return Ok(());
    }
    Err(IntegrationError::Setting {
        setting: "step",
        value: step.to_f64(),
        expected: "positive and finite; the target says whether time goes forwards or backwards",
    })
}

/// The times origin + n h. They are computed from n, so that round-off does not accumulate.
#[derive(Clone, Copy)]
pub(crate) struct Grid<T> {
    origin: T,
    /// h with the sign of its direction.
    step: T,
    /// n; the origin is where time stands if this is 0.
    count: u32,
    /// Where the last step led to; from elsewhere the grid starts anew.
    now: T,
}

/// The next step along a grid.
pub(super) struct Leg<T> {
    /// Its length, with the sign of its direction.
    pub(super) length: T,
    /// The time at its end.
    pub(super) time: T,
    /// The grid from there on.
    pub(super) grid: Grid<T>,
}

/// Several steps along a grid, all of which time resolves.
pub(super) struct Stride<T> {
    origin: T,
    /// The length of each, with the sign of its direction.
    pub(super) step: T,
    count: u32,
    /// How many there are.
    pub(super) steps: u32,
}

impl<T: Real> Stride<T> {
    /// The time after `done` of them.
    #[inline]
    pub(super) fn time(&self, done: u32) -> T {
        self.origin + T::from_u32(self.count + done) * self.step
    }

    /// The grid after all of them.
    #[inline]
    pub(super) fn end(&self) -> Grid<T> {
        let Self { origin, step, count, steps } = *self;
        Grid { origin, step, count: count + steps, now: self.time(steps) }
    }
}

/// After this many steps the grid starts anew, so that n is exact in `f32` too.
const LONGEST_COUNT: u32 = 1 << 20;

impl<T: Real> Grid<T> {
    /// A grid whose origin is where time stands.
    #[inline]
    pub(super) fn new() -> Self {
        Self { origin: T::ZERO, step: T::ZERO, count: 0, now: T::ZERO }
    }

    /// Where the steps of length `step` from `now` are counted from, and how many have been taken.
    #[inline]
    fn counted(&self, now: T, step: T) -> (T, u32) {
        // far from the origin, n h leaves the range of the numbers before time does
        let is_going_on = self.count > 0
            && self.step == step
            && self.now == now
            && (T::from_u32(self.count + 1) * step).is_finite();
        if is_going_on { (self.origin, self.count) } else { (now, 0) }
    }

    /// The whole steps of length h from `now` that end well before the target, of at most `limit`: the
    /// signed length, and the times at their ends.
    #[inline]
    pub(super) fn stride(&self, now: T, h: T, target: T, limit: u64) -> Option<Stride<T>> {
        let step = if target < now { -h } else { h };
        let (origin, count) = self.counted(now, step);
        let room = ((target - now) / step).to_f64() - 3.0;
        let most = limit.min(u64::from(LONGEST_COUNT - 1 - count));
        // the conversion saturates, and NaN becomes 0
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        let steps = u32::try_from((room as u64).min(most)).ok()?;
        let is_resolved = resolution(now).max(resolution(target)) <= h;
        (steps > 0 && is_resolved).then_some(Stride { origin, step, count, steps })
    }

    /// The step of length h from `now` towards the target.
    ///
    /// A step that would end within 10⁻⁶ h, or within round-off, before the target is stretched to it, so that
    /// round-off never leaves a sliver; one that would pass it is shortened.
    ///
    /// # Errors
    /// [`IntegrationError::UnresolvedStep`] if time has no room for the step.
    #[inline]
    pub(super) fn next(&self, now: T, h: T, target: Option<T>) -> Result<Leg<T>, IntegrationError> {
        let backwards = target.is_some_and(|target| target < now);
        let step = if backwards { -h } else { h };
        let (origin, count) = self.counted(now, step);
        let count = count + 1;
        let time = origin + T::from_u32(count) * step;
        if resolution(now) > h {
            return Err(unresolved(now, h));
        }
        if let Some(target) = target {
            let beyond = if backwards { target - time } else { time - target };
            let round_off = T::from_f64(4.0) * T::EPSILON * now.abs().max(target.abs());
            let sliver = (h * T::from_f64(1e-6)).max(round_off.min(h * T::from_f64(0.125)));
            if beyond >= -sliver {
                let is_whole = beyond.abs() <= round_off.min(h * T::from_f64(NEGLIGIBLE));
                let length = if is_whole { step } else { target - now };
                return Ok(Leg { length, time: target, grid: Self::new() });
            }
        }
        let count = if count < LONGEST_COUNT { count } else { 0 };
        Ok(Leg { length: step, time, grid: Self { origin, step, count, now: time } })
    }
}

/// How far apart times are, at least half and at most one of it: a shorter step may be lost in rounding.
#[inline]
fn resolution<T: Real>(time: T) -> T {
    T::EPSILON * time.abs()
}

#[cold]
fn unresolved<T: Real>(time: T, step: T) -> IntegrationError {
    IntegrationError::UnresolvedStep {
        time: time.to_f64(),
        step: step.to_f64(),
        resolution: resolution(time).to_f64(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_do_not_accumulate_round_off() {
        let (mut grid, mut now) = (Grid::new(), 0.0_f64);
        for _ in 0..3_000_000 {
            let leg = grid.next(now, 0.1, None).unwrap();
            (grid, now) = (leg.grid, leg.time);
        }
        assert!((now - 300_000.0).abs() < 1e-9, "{now}");
    }

    #[test]
    fn an_end_on_the_grid_takes_whole_steps() {
        let (mut grid, mut now, mut steps) = (Grid::new(), 0.0_f64, 0);
        while now < 1.0 {
            let leg = grid.next(now, 0.1, Some(1.0)).unwrap();
            assert!((leg.length - 0.1).abs() == 0.0);
            (grid, now) = (leg.grid, leg.time);
            steps += 1;
        }
        assert_eq!((now, steps), (1.0, 10));
    }

    #[test]
    fn a_step_below_the_resolution_of_time_is_refused() {
        let refused = Grid::new().next(1.0_f32, 1e-8, Some(1.000_001)).err();
        assert!(matches!(refused, Some(IntegrationError::UnresolvedStep { time: 1.0, .. })), "{refused:?}");
        // coarse, but resolved: the lengths of the steps add up to the whole
        let (mut grid, mut now, mut travelled) = (Grid::new(), 1e15_f64, 0.0);
        let target = now + 3.625;
        while now < target {
            let leg = grid.next(now, 0.3, Some(target)).unwrap();
            travelled += leg.length;
            (grid, now) = (leg.grid, leg.time);
        }
        assert!((travelled - 3.625).abs() < 0.125, "{travelled}");
    }

    #[test]
    fn n_steps_that_leave_the_numbers_do_not_take_time_with_them() {
        let (mut grid, mut now) = (Grid::new(), -1.7e308_f64);
        for expected in [-0.7e308, 0.3e308, 1.3e308, 1.6e308] {
            let leg = grid.next(now, 1e308, Some(1.6e308)).unwrap();
            (grid, now) = (leg.grid, leg.time);
            assert!((now / expected - 1.0).abs() < 1e-15, "{now} {expected}");
        }
    }
}
