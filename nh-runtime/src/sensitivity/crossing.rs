//! What an event with a jump makes of the derivatives of a motion.

use super::no_derivative::SensitivityError;
use super::pull_back::add;
use crate::Real;

/// A motion at an event g(t, x, p) = 0 where the state jumps, x⁺ = R(t, x⁻, p): what is known there to first order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing<T, const N: usize, const K: usize> {
    /// ẋ before the event.
    pub rate_before: [T; N],
    /// ẋ after it, by the equations of motion that hold then.
    pub rate_after: [T; N],
    /// ∂g/∂t.
    pub event_by_time: T,
    /// ∂g/∂x.
    pub event_by_state: [T; N],
    /// ∂g/∂p, by what each column is taken by: zero for starts and inputs, unless g contains them.
    pub event_by_columns: [T; K],
    /// ∂R/∂t.
    pub reset_by_time: [T; N],
    /// ∂R/∂x: in row i, the derivatives of component i.
    pub reset_by_state: [[T; N]; N],
    /// ∂R/∂p: an array for each column.
    pub reset_by_columns: [[T; N]; K],
}

/// The columns after an event, and how its time changes.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct AfterEvent<T, const N: usize, const K: usize> {
    /// X⁺.
    pub columns: [[T; N]; K],
    /// δτ: the derivative of the time of the event by what each column is taken by.
    pub times: [T; K],
}

impl<T: Real, const N: usize, const K: usize> Crossing<T, N, K> {
    /// The columns after the event,
    ///
    /// δτ = −(∂_x g X⁻ + ∂_p g)/(∂_t g + ∂_x g F⁻), X⁺ = ∂_xR X⁻ + ∂_pR + (∂_xR F⁻ + ∂_tR − F⁺) δτ, mathematics (53).
    ///
    /// Of several events at one time there is no derivative: what follows depends on their order. That they are is for
    /// the caller to see, as [`advance_across`](super::advance_across) does.
    ///
    /// # Errors
    /// [`SensitivityError::Grazing`] where ∂_t g + ∂_x g F⁻ is zero to the rounding of its terms, with event 0 at `time`.
    ///
    /// ```
    /// use nonholonomic::sensitivity::Crossing;
    ///
    /// // a ball that fell from rest at height 1 with g = 2 arrives at t = 1 with speed −2, and keeps half of it
    /// let bounce = Crossing {
    ///     rate_before: [-2.0, -2.0],
    ///     rate_after: [1.0, -2.0],
    ///     event_by_time: 0.0,
    ///     event_by_state: [1.0, 0.0],
    ///     event_by_columns: [0.0],
    ///     reset_by_time: [0.0, 0.0],
    ///     reset_by_state: [[1.0, 0.0], [0.0, -0.5]],
    ///     reset_by_columns: [[0.0, 0.0]],
    /// };
    /// // by the height it fell from: t = √h, speed after it √h
    /// let after = bounce.columns(1.0, &[[1.0, 0.0]])?;
    /// assert_eq!(after.times, [0.5]);
    /// // later by δτ: at the same time it has risen less by the speeds before and after
    /// assert_eq!(after.columns, [[-0.5, 1.5]]);
    /// # Ok::<(), nonholonomic::sensitivity::SensitivityError>(())
    /// ```
    #[doc(alias("saltation matrix", "jump condition", "hybrid system"))]
    pub fn columns(&self, time: T, before: &[[T; N]; K]) -> Result<AfterEvent<T, N, K>, SensitivityError> {
        let product =
            |a: &[T; N], b: &[T; N], start: T| a.iter().zip(b).fold(start, |sum, (a, b)| a.mul_add(*b, sum));
        let transported = |x: &[T; N], shift: &[T; N]| {
            let mut moved = *shift;
            moved
                .iter_mut()
                .zip(&self.reset_by_state)
                .for_each(|(moved, row)| *moved = product(row, x, *moved));
            moved
        };
        let mut event = [T::ZERO; K];
        let mut reset = self.reset_by_columns;
        let columns = before.iter().zip(&self.event_by_columns).zip(&self.reset_by_columns);
        for ((event, reset), ((column, by), shift)) in event.iter_mut().zip(&mut reset).zip(columns) {
            *event = product(&self.event_by_state, column, *by);
            *reset = transported(column, shift);
        }
        let sizes = self.event_by_state.iter().zip(&self.rate_before);
        Passage {
            rate: product(&self.event_by_state, &self.rate_before, self.event_by_time),
            size: sizes.fold(self.event_by_time.abs(), |sum, (a, b)| sum + (*a * *b).abs()),
            event,
            reset,
            along: transported(&self.rate_before, &self.reset_by_time),
            rate_after: self.rate_after,
        }
        .columns((0, time))
    }
}

/// The same in the directions of the columns and of the motion.
pub(super) struct Passage<T, const N: usize, const K: usize> {
    /// ∂_t g + ∂_x g F⁻.
    pub(super) rate: T,
    /// The sum of the sizes of its terms.
    pub(super) size: T,
    /// ∂_x g X⁻ + ∂_p g.
    pub(super) event: [T; K],
    /// ∂_xR X⁻ + ∂_pR.
    pub(super) reset: [[T; N]; K],
    /// ∂_xR F⁻ + ∂_tR.
    pub(super) along: [T; N],
    /// F⁺.
    pub(super) rate_after: [T; N],
}

impl<T: Real, const N: usize, const K: usize> Passage<T, N, K> {
    /// The columns after the event of this number, mathematics (53).
    pub(super) fn columns(&self, (event, time): (usize, T)) -> Result<AfterEvent<T, N, K>, SensitivityError> {
        // what is not a number grazes, too
        if !self.rate.abs().all_gt(T::EPSILON * self.size) {
            let rate = (self.rate / self.size).to_f64();
            return Err(SensitivityError::Grazing { event, time: time.to_f64(), rate });
        }
        let mut jump = self.along;
        jump.iter_mut().zip(self.rate_after).for_each(|(jump, after)| *jump -= after);
        let mut found = AfterEvent { columns: self.reset, times: [T::ZERO; K] };
        for ((column, delay), event) in found.columns.iter_mut().zip(&mut found.times).zip(self.event) {
            *delay = -event / self.rate;
            add(column, *delay, &jump);
        }
        let is_finite = found.columns.iter().flatten().chain(&found.times).all(|entry| entry.is_finite());
        if is_finite {
            Ok(found)
        } else {
            Err(SensitivityError::NotFinite { what: "derivative of the jump", time: time.to_f64() })
        }
    }
}
