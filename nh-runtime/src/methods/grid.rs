//! The times of the methods of fixed step.

use crate::{IntegrationError, Real};

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

/// Several steps along a grid.
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

    /// The whole steps of length h from `now` that end well before the target, of at most `limit`: the
    /// signed length, and the times at their ends.
    #[inline]
    pub(super) fn stride(&self, now: T, h: T, target: T, limit: u64) -> Option<Stride<T>> {
        let step = if target < now { -h } else { h };
        let (origin, count) = if self.count == 0 || self.step != step || self.now != now {
            (now, 0)
        } else {
            (self.origin, self.count)
        };
        let room = ((target - now) / step).to_f64() - 3.0;
        let most = limit.min(u64::from(LONGEST_COUNT - 1 - count));
        // the conversion saturates, and NaN becomes 0
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        let steps = u32::try_from((room as u64).min(most)).ok()?;
        (steps > 0).then_some(Stride { origin, step, count, steps })
    }

    /// The step of length h from `now` towards the target.
    ///
    /// A step that would end within 10⁻⁶ h, or within round-off, before the target is stretched to it, so that
    /// round-off never leaves a sliver; one that would pass it is shortened.
    #[inline]
    pub(super) fn next(&self, now: T, h: T, target: Option<T>) -> Leg<T> {
        let backwards = target.is_some_and(|target| target < now);
        let step = if backwards { -h } else { h };
        let (origin, count) = if self.count == 0 || self.step != step || self.now != now {
            (now, 0)
        } else {
            (self.origin, self.count)
        };
        let count = count + 1;
        let time = origin + T::from_u32(count) * step;
        if let Some(target) = target {
            let beyond = if backwards { target - time } else { time - target };
            let round_off = T::from_f64(4.0) * T::EPSILON * now.abs().max(target.abs());
            let sliver = (h * T::from_f64(1e-6)).max(round_off.min(h * T::from_f64(0.5)));
            if beyond >= -sliver {
                let length = if beyond.abs() <= round_off { step } else { target - now };
                return Leg { length, time: target, grid: Self::new() };
            }
        }
        let count = if count < LONGEST_COUNT { count } else { 0 };
        Leg { length: step, time, grid: Self { origin, step, count, now: time } }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_do_not_accumulate_round_off() {
        let (mut grid, mut now) = (Grid::new(), 0.0_f64);
        for _ in 0..3_000_000 {
            let leg = grid.next(now, 0.1, None);
            (grid, now) = (leg.grid, leg.time);
        }
        assert!((now - 300_000.0).abs() < 1e-9, "{now}");
    }

    #[test]
    fn an_end_on_the_grid_takes_whole_steps() {
        let (mut grid, mut now, mut steps) = (Grid::new(), 0.0_f64, 0);
        while now < 1.0 {
            let leg = grid.next(now, 0.1, Some(1.0));
            assert!((leg.length - 0.1).abs() == 0.0);
            (grid, now) = (leg.grid, leg.time);
            steps += 1;
        }
        assert_eq!((now, steps), (1.0, 10));
    }

    #[test]
    fn a_step_below_the_resolution_of_time_still_gets_there() {
        let (mut grid, mut now, mut steps) = (Grid::new(), 1.0_f32, 0);
        while now < 1.000_001 {
            let leg = grid.next(now, 1e-8, Some(1.000_001));
            (grid, now) = (leg.grid, leg.time);
            steps += 1;
        }
        assert!((60..=140).contains(&steps), "{steps}");
    }
}
