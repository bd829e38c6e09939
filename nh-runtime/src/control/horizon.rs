//! Optimal control over a finite horizon: what a model and a cost are.

use nalgebra::{SMatrix, SVector};

use super::{ControlError, Entry, finite};

/// A system in discrete time, x' = f(k, x, u), with the derivatives of f.
///
/// A declared system becomes one by a step of fixed length and its derivative.
pub trait Model<T, const N: usize, const M: usize> {
    /// The state at tick `tick + 1`.
    fn step(&self, tick: usize, x: &SVector<T, N>, u: &SVector<T, M>) -> SVector<T, N>;
    /// ∂f/∂x and ∂f/∂u.
    fn linearized(
        &self,
        tick: usize,
        x: &SVector<T, N>,
        u: &SVector<T, M>,
    ) -> (SMatrix<T, N, N>, SMatrix<T, N, M>);
    /// A covector λ at tick `tick + 1`, pulled back to this one: λ ∂f/∂x and λ ∂f/∂u, as columns. By the matrices, unless
    /// there is a shorter way.
    fn pulled_back(
        &self,
        tick: usize,
        x: &SVector<T, N>,
        u: &SVector<T, M>,
        covector: &SVector<T, N>,
    ) -> (SVector<T, N>, SVector<T, M>)
    where
        T: Entry,
    {
        let (a, b) = self.linearized(tick, x, u);
        (a.transpose() * covector, b.transpose() * covector)
    }
}

/// What is to be made small: Σ stage(k, x_k, u_k) + end(x_H), with its derivatives.
///
/// [`Quadratic`] is the one that most start with; bounds on states are penalties of the user's own.
pub trait Cost<T, const N: usize, const M: usize> {
    /// The cost of a tick.
    fn stage(&self, tick: usize, x: &SVector<T, N>, u: &SVector<T, M>) -> T;
    /// The first and second derivatives of the cost of a tick.
    fn stage_expansion(&self, tick: usize, x: &SVector<T, N>, u: &SVector<T, M>) -> Expansion<T, N, M>;
    /// The cost of the state at the end of the horizon.
    fn end(&self, x: &SVector<T, N>) -> T;
    /// The first and second derivatives of the cost at the end; those by the input are not read.
    fn end_expansion(&self, x: &SVector<T, N>) -> Expansion<T, N, M>;
}

/// The derivatives of a cost. The second ones may be approximations that are positive semidefinite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Expansion<T, const N: usize, const M: usize> {
    /// By the state.
    pub x: SVector<T, N>,
    /// By the input.
    pub u: SVector<T, M>,
    /// Twice by the state.
    pub xx: SMatrix<T, N, N>,
    /// By the input, a row each, and by the state.
    pub ux: SMatrix<T, M, N>,
    /// Twice by the input.
    pub uu: SMatrix<T, M, M>,
}

impl<T: Entry, const N: usize, const M: usize> Expansion<T, N, M> {
    /// The derivatives of a constant, to be filled in.
    #[must_use]
    pub fn zero() -> Self {
        Self {
            x: SVector::zeros(),
            u: SVector::zeros(),
            xx: SMatrix::zeros(),
            ux: SMatrix::zeros(),
            uu: SMatrix::zeros(),
        }
    }

    /// Refuses derivatives that are not finite.
    pub(super) fn finite(&self, argument: &'static str) -> Result<(), ControlError> {
        finite(argument, &self.x)?;
        finite(argument, &self.u)?;
        finite(argument, &self.xx)?;
        finite(argument, &self.ux)?;
        finite(argument, &self.uu)
    }
}

/// ½ Σ (x − goal)ᵀ Q (x − goal) + uᵀ R u at every tick, and ½ (x − goal)ᵀ E (x − goal) at the end, with
/// diagonal weights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quadratic<T, const N: usize, const M: usize> {
    /// Where the state should be.
    pub goal: SVector<T, N>,
    /// The diagonal of Q, none of it negative.
    pub state: SVector<T, N>,
    /// The diagonal of R, all of it positive.
    pub input: SVector<T, M>,
    /// The diagonal of E, none of it negative.
    pub end: SVector<T, N>,
}

impl<T: Entry, const N: usize, const M: usize> Cost<T, N, M> for Quadratic<T, N, M> {
    fn stage(&self, _tick: usize, x: &SVector<T, N>, u: &SVector<T, M>) -> T {
        half_square(&(x - self.goal), &self.state) + half_square(u, &self.input)
    }
    fn stage_expansion(&self, _tick: usize, x: &SVector<T, N>, u: &SVector<T, M>) -> Expansion<T, N, M> {
        Expansion {
            x: (x - self.goal).component_mul(&self.state),
            u: u.component_mul(&self.input),
            xx: SMatrix::from_diagonal(&self.state),
            ux: SMatrix::zeros(),
            uu: SMatrix::from_diagonal(&self.input),
        }
    }
    fn end(&self, x: &SVector<T, N>) -> T {
        half_square(&(x - self.goal), &self.end)
    }
    fn end_expansion(&self, x: &SVector<T, N>) -> Expansion<T, N, M> {
        Expansion {
            x: (x - self.goal).component_mul(&self.end),
            xx: SMatrix::from_diagonal(&self.end),
            ..Expansion::zero()
        }
    }
}

/// ½ Σ wᵢ xᵢ².
fn half_square<T: Entry, const N: usize>(x: &SVector<T, N>, weights: &SVector<T, N>) -> T {
    let sum = x.iter().zip(weights.iter()).fold(T::ZERO, |sum, (x, w)| sum + *w * *x * *x);
    sum * T::from_f64(0.5)
}
