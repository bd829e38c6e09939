//! The impulses of rows that push and never pull.

use super::{ImpactError, MOST_ROWS};
use crate::Real;

/// What there is to solve: 0 ≤ μ ⊥ K μ + q ≥ 0 over the unilateral rows, K μ + q = 0 over the bilateral ones.
pub(super) struct Problem<'a, T, const R: usize> {
    pub(super) mobility: &'a [[T; R]; R],
    pub(super) offset: [T; R],
    /// Whether a row takes part.
    pub(super) present: [bool; R],
    pub(super) bilateral: [bool; R],
}

/// Why there is no impulse of a row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum NoImpulse<T> {
    /// It depends on the rows before it.
    Dependent(usize),
    /// Its impulse does not move it ahead, but by this.
    NoResponse(usize, T),
}

impl<T: Real> NoImpulse<T> {
    /// The same with the name of the row.
    pub(super) fn told<const R: usize>(self, names: [&'static str; R], time: f64) -> ImpactError {
        let row = |index: usize| names.get(index).copied().unwrap_or_default();
        match self {
            Self::Dependent(index) => ImpactError::Dependent { row: row(index), time },
            Self::NoResponse(index, response) => {
                ImpactError::NoResponse { row: row(index), time, response: response.to_f64() }
            }
        }
    }
}

impl<T: Real, const R: usize> Problem<'_, T, R> {
    /// The impulses: of all choices of the rows that push, the one that is violated least. With a positive definite K
    /// exactly one is not violated at all (Cottle, Pang, Stone, The Linear Complementarity Problem, 3.1.6), but by
    /// rounding.
    pub(super) fn solve(&self) -> Result<[T; R], NoImpulse<T>> {
        let mut best: Option<(T, [T; R])> = None;
        let mut without = None;
        for choice in 0..1_u32 << R.min(MOST_ROWS) {
            let is_chosen = |row: usize| choice >> row & 1 == 1;
            let mut active = [false; R];
            let mut is_canonical = true;
            for (row, active) in active.iter_mut().enumerate() {
                let (present, bilateral) = (at(&self.present, row), at(&self.bilateral, row));
                *active = present && (bilateral || is_chosen(row));
                // rows that have no choice are tried in one way
                is_canonical &= !is_chosen(row) || (present && !bilateral);
            }
            if !is_canonical {
                continue;
            }
            match self.with(&active) {
                Ok(impulses) => {
                    let violation = self.violation(&active, &impulses);
                    if best.is_none_or(|(least, _)| violation < least) {
                        best = Some((violation, impulses));
                    }
                }
                Err(none) => without = Some(none),
            }
        }
        match (best, without) {
            (Some((violation, impulses)), None) if violation.is_finite() => Ok(impulses),
            (_, none) => Err(none.unwrap_or(NoImpulse::Dependent(0))),
        }
    }

    /// The impulses with which these rows are met: K μ = −q by LDLᵀ, in which a pivot that is rounding shows a row
    /// that depends on those before it.
    fn with(&self, active: &[bool; R]) -> Result<[T; R], NoImpulse<T>> {
        let mut matrix = *self.mobility;
        let mut right = self.offset.map(|q| -q);
        for k in 0..R {
            if !at(active, k) {
                continue;
            }
            let (Some(&row), Some(&value)) = (matrix.get(k), right.get(k)) else { break };
            let pivot = at(&row, k);
            let size = self.mobility.get(k).map_or(T::ZERO, |row| at(row, k));
            if size <= T::ZERO {
                return Err(NoImpulse::NoResponse(k, size));
            }
            // what is no number is no pivot either
            if !pivot.is_finite() || pivot <= T::from_f64(64.0) * T::EPSILON * size {
                return Err(NoImpulse::Dependent(k));
            }
            for (i, (others, right)) in matrix.iter_mut().zip(right.iter_mut()).enumerate() {
                if i == k || !at(active, i) {
                    continue;
                }
                let factor = at(others, k) / pivot;
                for (entry, above) in others.iter_mut().zip(&row) {
                    *entry -= factor * *above;
                }
                *right -= factor * value;
            }
        }
        let mut impulses = [T::ZERO; R];
        for (k, impulse) in impulses.iter_mut().enumerate() {
            if at(active, k) {
                *impulse = at(&right, k) / matrix.get(k).map_or(T::ONE, |row| at(row, k));
            }
        }
        Ok(impulses)
    }

    /// By how much the inequalities are violated at most, each in the root of an energy: its speed over √K.
    fn violation(&self, active: &[bool; R], impulses: &[T; R]) -> T {
        let mut most = T::ZERO;
        for (row, (mobility, offset)) in self.mobility.iter().zip(self.offset).enumerate() {
            if !at(&self.present, row) || at(&self.bilateral, row) {
                continue;
            }
            let own = at(mobility, row).sqrt();
            let violated = if at(active, row) {
                -at(impulses, row) * own
            } else {
                let speed = mobility.iter().zip(impulses).fold(offset, |sum, (k, mu)| sum + *k * *mu);
                -speed / own
            };
            most = most.max(violated);
        }
        most
    }
}

fn at<T: Copy + Default, const R: usize>(array: &[T; R], index: usize) -> T {
    array.get(index).copied().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The conditions themselves, on matrices K = A Aᵀ + 0.1 of random numbers.
    #[test]
    fn impulses_push_or_rows_part() {
        let mut seed = 7_u64;
        let mut random = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            f64::from(u32::try_from(seed >> 32).unwrap()) / f64::from(u32::MAX) - 0.5
        };
        let mut pushed = [0_u32; 7];
        for _ in 0..2000 {
            let a: [[f64; 6]; 6] = core::array::from_fn(|_| core::array::from_fn(|_| random()));
            let dot = |i: usize, j: usize| -> f64 { a[i].iter().zip(&a[j]).map(|(x, y)| x * y).sum() };
            let mobility = core::array::from_fn(|i| {
                core::array::from_fn(|j| dot(i, j) + if i == j { 0.1 } else { 0.0 })
            });
            let problem = Problem {
                mobility: &mobility,
                offset: core::array::from_fn(|_| random()),
                present: [true, true, true, true, true, random() > 0.0],
                bilateral: [false, random() > 0.3, false, false, false, false],
            };
            let impulses = problem.solve().unwrap();
            let mut count = 0;
            for (i, mu) in impulses.iter().enumerate() {
                let speed: f64 =
                    mobility[i].iter().zip(&impulses).map(|(k, mu): (&f64, &f64)| k * mu).sum::<f64>()
                        + problem.offset[i];
                if !problem.present[i] {
                    assert!(mu.abs() == 0.0);
                } else if problem.bilateral[i] {
                    assert!(speed.abs() < 1e-12, "{speed:e}");
                } else {
                    assert!(*mu > -1e-13 && speed > -1e-12 && (mu * speed).abs() < 1e-12, "{mu:e} {speed:e}");
                    count += usize::from(*mu > 0.0);
                }
            }
            pushed[count] += 1;
        }
        // all numbers of rows that push occur
        assert!(pushed[..6].iter().all(|count| *count > 5), "{pushed:?}");
    }

    #[test]
    fn a_row_that_depends_on_another_is_told() {
        let mobility = [[1.0, 2.0], [2.0, 4.0]];
        let problem =
            Problem { mobility: &mobility, offset: [-1.0, -2.0], present: [true; 2], bilateral: [true; 2] };
        assert_eq!(problem.solve(), Err(NoImpulse::Dependent(1)));
    }
}
