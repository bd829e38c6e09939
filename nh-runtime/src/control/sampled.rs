//! Declared systems in discrete time.

use nalgebra::{SMatrix, SVector};

use super::{Entry, Model};
use crate::{D, Jacobian, Rk4, State};

/// A system as a [`Model`]: x' is the state one step of [`Rk4`] later, under a constant input.
///
/// Its derivatives are those of the step, exactly ([`Rk4::linearized_step`](crate::methods::Fixed::linearized_step)), with the
/// return of systems that have position constraints and are declared with `emit { return_jacobian }`.
///
/// ```
/// use nalgebra::vector;
/// use nonholonomic::control::{Model, Sampled};
/// use nonholonomic::prelude::*;
///
/// /// A cart that a force pushes.
/// #[nonholonomic(
///     base       { x }
///     lagrangian { m / 2 * der(x)^2 }
///     forces     { x: push; }
///     inputs     { push }
///     emit       { jacobian }
/// )]
/// #[derive(Clone, Copy, Debug)]
/// struct Cart { m: f64 }
///
/// let model = Sampled { system: Cart { m: 2.0 }, start: 0.0, dt: 0.1 };
/// let next = model.step(0, &vector![1.0, 0.5], &vector![4.0]);
/// assert!((next - vector![1.06, 0.7]).norm() < 1e-15);
/// let (a, b) = model.linearized(0, &vector![1.0, 0.5], &vector![4.0]);
/// assert!((a[(0, 1)] - 0.1).abs() < 1e-15 && (b[0] - 0.0025).abs() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sampled<S, T> {
    /// The system.
    pub system: S,
    /// The time of tick 0.
    pub start: T,
    /// The time from tick to tick.
    pub dt: T,
}

impl<S, T: Entry> Sampled<S, T> {
    /// The time of a tick.
    #[allow(clippy::cast_possible_truncation)] // horizons of 2³² ticks are not stored
    fn time(&self, tick: usize) -> T {
        self.start + T::from_u32(tick as u32) * self.dt
    }
}

impl<S, T, const N: usize, const M: usize> Model<T, N, M> for Sampled<S, T>
where
    T: Entry,
    S: Jacobian<InputDim = D<M>, Input: From<[T; M]>>,
    S::State: State<Scalar = T, Dim = D<N>>,
{
    fn step(&self, tick: usize, x: &SVector<T, N>, u: &SVector<T, M>) -> SVector<T, N> {
        let (state, input) = (S::State::from_array((*x).into()), S::Input::from((*u).into()));
        SVector::from(Rk4::step(&self.system, self.time(tick), self.dt, &state, &input).to_array())
    }

    fn linearized(
        &self,
        tick: usize,
        x: &SVector<T, N>,
        u: &SVector<T, M>,
    ) -> (SMatrix<T, N, N>, SMatrix<T, N, M>) {
        let (state, input) = (S::State::from_array((*x).into()), S::Input::from((*u).into()));
        let step = Rk4::linearized_step(&self.system, self.time(tick), self.dt, &state, &input);
        (step.by_state, step.by_input)
    }

    fn pulled_back(
        &self,
        tick: usize,
        x: &SVector<T, N>,
        u: &SVector<T, M>,
        covector: &SVector<T, N>,
    ) -> (SVector<T, N>, SVector<T, M>) {
        let (state, input) = (S::State::from_array((*x).into()), S::Input::from((*u).into()));
        let none = |_, _: &S::State, _: &S::Input| SMatrix::<T, N, 0>::from([[T::ZERO; N]; 0]);
        let covector = |_: &S::State| (*covector).into();
        let back =
            Rk4::pulled_back_step(&self.system, self.time(tick), self.dt, &state, &input, covector, none);
        (SVector::from(back.by_state), SVector::from(back.by_input))
    }
}
