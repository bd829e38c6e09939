//! What makes a cost convex in the inputs where it is not.

use nalgebra::{SMatrix, SVector};

use super::Entry;
use crate::Scalar;

/// The factor by which it grows and shrinks.
const FACTOR: f64 = 4.0;
/// Where it starts to grow from, and what it vanishes below.
const LEAST: f64 = 1e-6;
/// Beyond this there is no step to be found.
const MOST: f64 = 1e10;

/// A share of the curvature by the inputs that is added to it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Regularization<T>(T);

impl<T: Entry> Regularization<T> {
    pub(super) fn none() -> Self {
        Self(T::ZERO)
    }

    /// Grows; says whether that may still help.
    pub(super) fn grow(&mut self) -> bool {
        let may_help = self.0 <= T::from_f64(MOST);
        if may_help {
            self.0 = (self.0 * T::from_f64(FACTOR)).max(T::from_f64(LEAST));
        }
        may_help
    }

    /// Shrinks, at last to nothing.
    pub(super) fn shrink(&mut self) {
        let lighter = self.0 / T::from_f64(FACTOR);
        self.0 = if lighter < T::from_f64(LEAST) { T::ZERO } else { lighter };
    }

    /// What is added to the diagonal of a curvature that is the sum of these parts. Without any curvature, a slope
    /// that changes over the range of the input says as much; nothing does where that has no bounds.
    pub(super) fn of<const M: usize>(
        self,
        parts: [&SMatrix<T, M, M>; 2],
        slope: &SVector<T, M>,
        range: &SVector<T, M>,
    ) -> SMatrix<T, M, M> {
        let entries = parts.iter().flat_map(|part| part.iter());
        let most = entries.fold(T::ZERO, |most, x| most.max(Scalar::abs(*x)));
        SMatrix::from_diagonal(&SVector::from_fn(|i, _| {
            let own = parts.iter().fold(T::ZERO, |own, part| own.max(Scalar::abs(part[(i, i)])));
            let by_range = Scalar::abs(slope[i]) / range[i];
            // what has no range stays where it is, and what has no bounds says nothing
            let is_size = |size: &T| *size > T::ZERO && size.is_finite();
            let is_bounded = is_size(&range[i]) && range[i] < T::MIN_POSITIVE.recip();
            let by_range = if is_bounded { by_range } else { T::ZERO };
            let size = [own, most, by_range].into_iter().find(is_size);
            size.unwrap_or(T::ZERO) * self.0
        }))
    }
}
