//! The equations of a step: the discrete gradient and its defect.

use crate::arrays::{Array, difference, displaced};
use crate::methods::Start;
use crate::projection::largest;
use crate::{AlmostPoisson, Dynamics, Real, Scalar, ScalarOf, State, VecOf};

/// η², below which share of all a component's part in c·(∂E(x₁) − ∂E(x₀)) no longer shows its sign.
const SMOOTHING: f64 = 0.01;

/// The share of the largest component that the size of a component counts as at least.
const LEAST: f64 = 0.01;

/// A step to be made: where it starts, and the energy that it ends at.
pub(super) struct Step<'a, 'b, S: AlmostPoisson> {
    pub(super) start: &'a Start<'b, S>,
    pub(super) x: &'a VecOf<S>,
    pub(super) h: ScalarOf<S>,
    pub(super) energy: ScalarOf<S>,
    /// ∂E(x₀).
    pub(super) gradient: VecOf<S>,
}

impl<S: AlmostPoisson> Step<'_, '_, S>
where
    ScalarOf<S>: Real,
{
    /// The size of a correction, relative in each component to the state at both ends, where that is no less than a
    /// hundredth of its largest component.
    pub(super) fn relative(&self, correction: &VecOf<S>, change: &VecOf<S>) -> ScalarOf<S> {
        let end = displaced(self.x, ScalarOf::<S>::ONE, change);
        let largest = largest(self.x.as_ref()).max(largest(end.as_ref()));
        let least = ScalarOf::<S>::from_f64(LEAST) * largest;
        let ends = self.x.as_ref().iter().zip(end.as_ref());
        let terms = correction.as_ref().iter().zip(ends);
        terms.fold(ScalarOf::<S>::ZERO, |most, (c, (a, b))| {
            let moved = c.abs();
            most.max(if moved == ScalarOf::<S>::ZERO {
                moved
            } else {
                moved / (least + a.abs().max(b.abs()))
            })
        })
    }

    /// The middle x̄ of a step with this change of the state.
    fn middle(&self, change: &VecOf<S>) -> S::State {
        S::State::from_array(displaced(self.x, ScalarOf::<S>::from_f64(0.5), change))
    }

    /// h Π(x̄) p for a covector p.
    pub(super) fn turned(&self, change: &VecOf<S>, covector: &VecOf<S>) -> VecOf<S> {
        let mut turned = self.start.system.almost_poisson(self.start.time, &self.middle(change), covector);
        turned.as_mut().iter_mut().for_each(|x| *x *= self.h);
        turned
    }

    /// h Π(x̄) ∂̄E − Δ, and f. With an f from before, what remains of the energy goes along Δ: that is round-off,
    /// and d may be nearly orthogonal to Δ.
    pub(super) fn defect(&self, change: &VecOf<S>, settled: Option<ScalarOf<S>>) -> (VecOf<S>, ScalarOf<S>) {
        let Parts { gradient, direction, gain, along, .. } = self.parts(change);
        let factor = settled.unwrap_or(gain / along);
        // where nothing changes, or a step is so short that round-off decides, d says nothing
        let is_small = factor.abs() <= ScalarOf::<S>::ONE;
        let (factor, part) =
            if is_small { (factor, factor * along) } else { (ScalarOf::<S>::ZERO, ScalarOf::<S>::ZERO) };
        let mut corrected = if is_small { displaced(&gradient, factor, &direction) } else { gradient };
        if settled.is_some() {
            let Along { unit, length } = Along::new(change);
            let rest = (gain - part) / length / dot::<S>(&unit, &unit);
            corrected = if rest.is_finite() { displaced(&corrected, rest, &unit) } else { corrected };
        }
        let turned = if S::HOLDS {
            self.turned_on_constraints(change, &corrected, (&direction, along))
        } else {
            self.turned(change, &corrected)
        };
        (difference(&turned, change), factor)
    }

    /// h P Π(x̄) Pᵀ p with the projection P for which ∂̄g P = 0, so that g(x₁) = 0: mathematics (37). The discrete
    /// gradient ∂̄g is corrected along d as that of the energy is.
    fn turned_on_constraints(
        &self,
        change: &VecOf<S>,
        covector: &VecOf<S>,
        (direction, along): (&VecOf<S>, ScalarOf<S>),
    ) -> VecOf<S> {
        let (time, system) = (self.start.time, self.start.system);
        let held = system.held_equations(time, &self.middle(change));
        let end = S::State::from_array(displaced(self.x, ScalarOf::<S>::ONE, change));
        // in place of g(x₀) stands 0, so that round-off does not add up
        let mut gains = difference(&system.residuals(time, &end), &held.rates(change));
        // where d says nothing, along Δ
        let (covector_of_gains, scale) = if along > ScalarOf::<S>::ZERO {
            (*direction, along)
        } else {
            let Along { unit, length } = Along::new(change);
            (unit, length * dot::<S>(&unit, &unit))
        };
        gains.as_mut().iter_mut().for_each(|gain| {
            let factor = *gain / scale;
            *gain = if factor.is_finite() { factor } else { ScalarOf::<S>::ZERO };
        });
        let projector = held.tilted(&gains, &covector_of_gains).projector();
        projector.of_vector(&self.turned(change, &projector.of_covector(covector)))
    }

    /// What ∂̄E = ∂E(x̄) + f d is made of.
    pub(super) fn parts(&self, change: &VecOf<S>) -> Parts<S> {
        let (time, system) = (self.start.time, self.start.system);
        let last = displaced(self.x, ScalarOf::<S>::ONE, change);
        let end = S::State::from_array(last);
        let gradient = system.energy_gradient(time, &self.middle(change));
        let energy = system.energy(time, &end);
        // each component of ∂E(x₁) − ∂E(x₀) with the sign of Δ there, and smoothly zero between the signs
        let mut direction = difference(&system.energy_gradient(time, &end), &self.gradient);
        let mut shares = direction;
        shares.as_mut().iter_mut().zip(change.as_ref()).for_each(|(share, c)| *share *= *c);
        let most = shares.as_ref().iter().fold(ScalarOf::<S>::ZERO, |most, share| most.max(share.abs()));
        shares.as_mut().iter_mut().for_each(|share| *share = *share / most);
        let smoothing = ScalarOf::<S>::from_f64(SMOOTHING) * dot::<S>(&shares, &shares);
        for (d, share) in direction.as_mut().iter_mut().zip(shares.as_ref()) {
            *d *= *share / share.mul_add(*share, smoothing).sqrt();
        }
        let along = dot::<S>(&direction, change);
        let gain = energy - self.energy - dot::<S>(&gradient, change);
        let terms = gradient.as_ref().iter().zip(last.as_ref());
        let size = terms.fold(energy.abs(), |size, (slope, x)| size + (*slope * *x).abs());
        // below the range of the numbers energies have no digits: what is left is the gradient at the middle
        let has_digits = size >= ScalarOf::<S>::MIN_POSITIVE / ScalarOf::<S>::EPSILON;
        let gain = if has_digits { gain } else { ScalarOf::<S>::ZERO };
        Parts { gradient, direction, gain, along, size }
    }
}

/// The gradient at the middle of a step, and its correction.
pub(super) struct Parts<S: Dynamics> {
    /// ∂E(x̄).
    gradient: VecOf<S>,
    /// d.
    pub(super) direction: VecOf<S>,
    /// E(x₁) − E(x₀) − ∂E(x̄)·Δ.
    gain: ScalarOf<S>,
    /// d·Δ: f is the one over the other.
    pub(super) along: ScalarOf<S>,
    /// The sum of the sizes of the energy's terms, which round-off goes with.
    pub(super) size: ScalarOf<S>,
}

/// A vector as one whose largest component is 1, times a length: its square may be beyond the numbers.
pub(super) struct Along<T, V> {
    pub(super) unit: V,
    pub(super) length: T,
}

impl<T: Real, V: Array<T>> Along<T, V> {
    pub(super) fn new(change: &V) -> Self {
        let length = largest(change.as_ref());
        let mut unit = *change;
        unit.as_mut().iter_mut().for_each(|x| *x = *x / length);
        Self { unit, length }
    }
}

pub(super) fn dot<S: Dynamics>(a: &VecOf<S>, b: &VecOf<S>) -> ScalarOf<S> {
    a.as_ref().iter().zip(b.as_ref()).fold(ScalarOf::<S>::ZERO, |sum, (a, b)| sum + *a * *b)
}
