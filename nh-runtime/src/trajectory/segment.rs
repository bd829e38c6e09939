//! One step of a motion, as a polynomial.

use core::fmt;

use crate::{Dim, Real, Scalar, State};

/// One step of a motion: the polynomial through `P` states at Chebyshev's points of it, the ends among them
/// (Berrut, Trefethen, Barycentric Lagrange interpolation, SIAM Review 46 (2004), section 5).
#[derive(Clone, Copy)]
pub struct Segment<X: State, const P: usize = 8> {
    pub(super) from: X::Scalar,
    pub(super) to: X::Scalar,
    pub(super) nodes: [X; P],
}

impl<X: State + fmt::Debug, const P: usize> fmt::Debug for Segment<X, P> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { from, to, nodes } = self;
        f.debug_struct("Segment").field("from", from).field("to", to).field("nodes", nodes).finish()
    }
}

/// No step: what a buffer is filled with before anything is kept.
impl<X: State, const P: usize> Default for Segment<X, P> {
    fn default() -> Self {
        let zero = X::Scalar::ZERO;
        Self { from: zero, to: zero, nodes: [X::from_array(X::Dim::vec(zero)); P] }
    }
}

/// The place of a node, as a fraction of the step: (1 − cos(π j/(P − 1)))/2, which is sin² of half the angle.
pub(super) fn node<T: Real, const P: usize>(index: usize) -> T {
    place(index, 2 * P.saturating_sub(1))
}

/// The place halfway, by the angle, between a node and the next.
pub(super) fn between<T: Real, const P: usize>(index: usize) -> T {
    place(2 * index + 1, 4 * P.saturating_sub(1))
}

/// sin²(π part/whole).
fn place<T: Real>(part: usize, whole: usize) -> T {
    let count = |n: usize| T::from_u32(u32::try_from(n).unwrap_or(u32::MAX));
    let sine = (T::from_f64(core::f64::consts::PI) * (count(part) / count(whole))).sin();
    sine * sine
}

impl<X: State, const P: usize> Segment<X, P>
where
    X::Scalar: Real,
{
    /// The polynomial through the states at the nodes.
    pub(super) fn new(from: X::Scalar, to: X::Scalar, nodes: [X; P]) -> Self {
        Self { from, to, nodes }
    }

    /// The time at which the step begins.
    #[must_use]
    pub fn from(&self) -> X::Scalar {
        self.from
    }

    /// The time at which it ends: before that in a run backwards.
    #[must_use]
    pub fn to(&self) -> X::Scalar {
        self.to
    }

    /// The states at the nodes, from the start of the step to its end.
    #[must_use]
    pub fn nodes(&self) -> &[X; P] {
        &self.nodes
    }

    /// The state at a time of the step; none outside of it.
    #[must_use]
    pub fn at(&self, time: X::Scalar) -> Option<X> {
        let Self { from, to, .. } = *self;
        if time == from {
            return self.nodes.first().copied();
        }
        if time == to {
            return self.nodes.last().copied();
        }
        let is_within = (from < time && time < to) || (to < time && time < from);
        is_within.then(|| self.at_fraction((time - from) / (to - from)))
    }

    /// The barycentric formula: Σ wⱼ δ/(s − sⱼ) xⱼ / Σ wⱼ δ/(s − sⱼ), wⱼ = ±1, halved at the ends, with the distance δ of
    /// the nearest node, since the inverse of what is as near as time resolves is beyond all numbers.
    pub(super) fn at_fraction(&self, s: X::Scalar) -> X {
        let zero = X::Scalar::ZERO;
        let distances: [X::Scalar; P] = core::array::from_fn(|index| s - node::<X::Scalar, P>(index));
        let nearest = distances.iter().fold(X::Scalar::ONE, |least, distance| least.min(distance.abs()));
        let mut sum = X::Dim::vec(zero);
        let mut weights = zero;
        let mut sign = X::Scalar::ONE;
        for (index, (state, &distance)) in self.nodes.iter().zip(&distances).enumerate() {
            if distance == zero {
                return *state;
            }
            let is_end = index == 0 || index + 1 == P;
            let half = if is_end { X::Scalar::from_f64(0.5) } else { X::Scalar::ONE };
            let weight = half * sign * (nearest / distance);
            for (sum, &x) in sum.as_mut().iter_mut().zip(state.to_array().as_ref()) {
                *sum = x.mul_add(weight, *sum);
            }
            weights += weight;
            sign = -sign;
        }
        for sum in sum.as_mut() {
            *sum = *sum / weights;
        }
        X::from_array(sum)
    }

    /// The state at the start.
    pub(super) fn first(&self) -> X {
        self.nodes.first().copied().unwrap_or_else(|| X::from_array(X::Dim::vec(X::Scalar::ZERO)))
    }

    /// The state at the end.
    pub(super) fn last(&self) -> X {
        self.nodes.last().copied().unwrap_or_else(|| X::from_array(X::Dim::vec(X::Scalar::ZERO)))
    }

    /// Whether the next step begins where this one ends.
    pub(super) fn meets(&self, next: &Self) -> bool {
        self.last().to_array().as_ref() == next.first().to_array().as_ref()
    }
}
