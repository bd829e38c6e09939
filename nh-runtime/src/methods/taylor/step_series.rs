//! The series of a step and its sums.

use crate::{Dim, Dynamics, Real, Scalar, State, VecOf};

/// A series with the unit of time that its coefficients are in.
#[derive(Clone, Copy)]
pub struct Series<X: State, const P: usize> {
    pub(super) terms: [X; P],
    pub(super) unit: X::Scalar,
}

impl<X: State, const P: usize> Series<X, P> {
    /// Σ k x_k (τ/unit)^(k−1)/unit by Horner's rule.
    #[inline]
    pub(super) fn rate_at<S: Dynamics<State = X>>(&self, order: usize, elapsed: X::Scalar) -> VecOf<S>
    where
        X::Scalar: Real,
    {
        let s = elapsed / self.unit;
        let zero = X::Scalar::ZERO;
        let mut sum = crate::DimOf::<S>::vec(zero);
        let mut factor = X::Scalar::from_u32(u32::try_from(order).unwrap_or(u32::MAX));
        for term in self.terms.get(1..=order).unwrap_or_default().iter().rev() {
            for (sum, term) in sum.as_mut().iter_mut().zip(term.to_array().as_ref()) {
                *sum = sum.mul_add(s, factor * *term);
            }
            factor -= X::Scalar::ONE;
        }
        let per_unit = self.unit.recip();
        sum.as_mut().iter_mut().for_each(|sum| *sum *= per_unit);
        sum
    }

    /// Σ |x_k|: how large the components are over a unit of time.
    #[cold]
    pub(super) fn sizes(&self, order: usize) -> <X::Dim as Dim>::Vec<X::Scalar> {
        let mut sum = <X::Dim as Dim>::vec(X::Scalar::ZERO);
        for term in self.terms.get(..=order).unwrap_or(&self.terms) {
            for (sum, term) in sum.as_mut().iter_mut().zip(term.to_array().as_ref()) {
                *sum += term.abs();
            }
        }
        sum
    }

    /// Σ x_k (τ/unit)ᵏ without its first term, by Horner's rule: what is small is summed before it meets the state.
    #[inline]
    pub(super) fn change<S: Dynamics<State = X>>(&self, order: usize, elapsed: X::Scalar) -> VecOf<S> {
        let s = elapsed / self.unit;
        let mut sum: VecOf<S> = crate::DimOf::<S>::vec(X::Scalar::ZERO);
        for term in self.terms.get(1..=order).unwrap_or_default().iter().rev() {
            let term = term.to_array();
            for (sum, term) in sum.as_mut().iter_mut().zip(term.as_ref()) {
                *sum = sum.mul_add(s, *term);
            }
        }
        sum.as_mut().iter_mut().for_each(|sum| *sum *= s);
        sum
    }

    /// Σ x_k (τ/unit)ᵏ by Horner's rule.
    #[inline]
    pub(super) fn at<S: Dynamics<State = X>>(&self, order: usize, elapsed: X::Scalar) -> VecOf<S> {
        let s = elapsed / self.unit;
        let mut terms = self.terms.get(..=order).unwrap_or(&self.terms).iter().rev();
        let mut sum = match terms.next() {
            Some(last) => last.to_array(),
            None => crate::DimOf::<S>::vec(Scalar::ZERO),
        };
        for term in terms {
            let term = term.to_array();
            for (sum, term) in sum.as_mut().iter_mut().zip(term.as_ref()) {
                *sum = sum.mul_add(s, *term);
            }
        }
        sum
    }
}
