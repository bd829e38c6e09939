//! The derivatives of the steps that an integrator takes, by implicit methods too.

use nalgebra::SMatrix;

use super::motion::Variational;
use super::no_derivative::SensitivityError;
use super::pull_back::add;
use crate::integrator::Spent;
use crate::methods::{Adaptive, Fixed, Gauss, Method, Midpoint, Radau, Tableau, Transition};
use crate::{
    D, Dynamics, GaussLegendre4, GaussLegendre6, ImplicitMidpoint, IntegrationError, Integrator, Jacobian,
    Radau5, Real, RowsByInput, Scalar, State,
};

/// A method whose steps have derivatives, from the system's Jacobian: the explicit ones, [`ImplicitMidpoint`],
/// [`GaussLegendre4`], [`GaussLegendre6`] and [`Radau5`].
pub trait LinearizedStep<T> {
    /// The step of length `dt`, with its derivatives.
    ///
    /// # Errors
    /// Why there is no step.
    fn linearized<S, const N: usize, const M: usize>(
        system: &S,
        t: T,
        dt: T,
        state: &S::State,
        input: &S::Input,
    ) -> Result<Transition<S::State, T, N, M>, IntegrationError>
    where
        S: Jacobian<InputDim = D<M>>,
        S::State: State<Scalar = T, Dim = D<N>>;
}

macro_rules! linearized {
    ($([$($generics:tt)*] $method:ty: |$system:ident, $t:ident, $dt:ident, $state:ident, $input:ident| $step:expr;)*) => {$(
        impl<T: Real, $($generics)*> LinearizedStep<T> for $method {
            #[inline]
            fn linearized<S, const N: usize, const M: usize>(
                $system: &S,
                $t: T,
                $dt: T,
                $state: &S::State,
                $input: &S::Input,
            ) -> Result<Transition<S::State, T, N, M>, IntegrationError>
            where
                S: Jacobian<InputDim = D<M>>,
                S::State: State<Scalar = T, Dim = D<N>>,
            {
                $step
            }
        }
    )*};
}
linearized! {
    [P: Tableau] Fixed<P, T>: |system, t, dt, state, input| {
        Ok(Fixed::<P, T>::linearized_step(system, t, dt, state, input))
    };
    [P: Tableau, W] Adaptive<P, T, W>: |system, t, dt, state, input| {
        Ok(Fixed::<P, T>::linearized_step(system, t, dt, state, input))
    };
    [J] Fixed<Midpoint<T, J>, T>: |system, t, dt, state, input| {
        ImplicitMidpoint::linearized_step(system, t, dt, state, input)
    };
    [J] Fixed<Gauss<T, J, 2>, T>: |system, t, dt, state, input| {
        GaussLegendre4::linearized_step(system, t, dt, state, input)
    };
    [J] Fixed<Gauss<T, J, 3>, T>: |system, t, dt, state, input| {
        GaussLegendre6::linearized_step(system, t, dt, state, input)
    };
    [J, W] Adaptive<Radau<J>, T, W>: |system, t, dt, state, input| {
        Radau5::linearized_step(system, t, dt, state, input)
    };
}

impl<S, F, T, const N: usize, const M: usize, const Q: usize, const K: usize> Variational<S, F, K>
where
    T: Real,
    S: Jacobian<InputDim = D<M>, State: State<Scalar = T, Dim = D<N>>>,
    F: Fn(&S, T, &S::State, &S::Input) -> SMatrix<T, N, Q>,
{
    /// Takes the steps of `sim` to `target`, and carries the columns along by the derivative of each step: the **exact
    /// derivative of the steps that are taken**, their lengths held, to round-off, by implicit methods too. The system
    /// of `sim` has to be that of this motion.
    ///
    /// Each step costs an evaluation of the Jacobian for each stage and, of an implicit method, the solution of its
    /// equations to round-off, for all columns together.
    ///
    /// # Errors
    /// As [`Integrator::advance_to`]; [`SensitivityError::Returned`] if the integration returns its states to position
    /// constraints, and a column is taken by a parameter or the return has no derivative; [`SensitivityError::NotFinite`] if a step has no derivative. The columns are those at the time of
    /// `sim` unless its last step has none.
    ///
    /// ```
    /// use nonholonomic::prelude::*;
    /// use nonholonomic::sensitivity::{By, Variational};
    ///
    /// /// A stiff spring with a damper.
    /// #[nonholonomic(
    ///     base       { x }
    ///     lagrangian { m / 2 * der(x)^2 - k / 2 * x^2 }
    ///     forces     { x: -c * der(x); }
    ///     emit       { jacobian, parameter_jacobian }
    /// )]
    /// #[derive(Clone, Copy, Debug)]
    /// struct Damped { m: f64, k: f64, c: f64 }
    ///
    /// # fn main() -> Result<(), Box<dyn core::error::Error>> {
    /// let system = Damped { m: 1.0, k: 1.0, c: 1e4 };
    /// let motion = Variational::new(system, [By::Parameter(1)])
    ///     .by_parameters(|system: &Damped, t, x, u| system.parameter_jacobian(t, x, u));
    /// let start = motion.start(&DampedState { x: 1.0, x_dot: 0.0 })?;
    /// let mut columns = start.columns;
    /// let mut sim = Integrator::new(system, Radau5::new().rtol(1e-9).with_jacobian(), 0.0, start.state);
    /// motion.advance(&mut sim, 5e3, &mut columns)?;
    /// // it creeps, x = exp(−k t/c)
    /// assert!((columns[0].x + 0.5 * (-0.5_f64).exp()).abs() < 1e-6);
    /// # Ok(())
    /// # }
    /// ```
    pub fn advance<A>(
        &self,
        sim: &mut Integrator<S, A>,
        target: T,
        columns: &mut [S::State; K],
    ) -> Result<(), SensitivityError>
    where
        A: Method<S> + LinearizedStep<T>,
    {
        sim.admit_target(target)?;
        if sim.is_returned()
            && (self.has_parameters() || !knows_its_return(&self.system, sim.time(), sim.state()))
        {
            return Err(SensitivityError::Returned);
        }
        let mut spent = Spent::default();
        while sim.time() != target {
            let (t, state, input) = (sim.time(), *sim.state(), *sim.input());
            sim.step_within(&mut spent, target)?;
            let dt = sim.time() - t;
            let mut step: Transition<_, T, N, K> = A::linearized(&Pushed(self), t, dt, &state, &input)?;
            if sim.is_returned() {
                // two steps of Newton's, as returns take where one does not reach the constraints
                step = step.returned(&self.system, sim.time()).returned(&self.system, sim.time());
            }
            let pairs = columns.iter_mut().zip(step.by_input.column_iter());
            for (column, push) in pairs {
                let mut moved = [T::ZERO; N];
                moved.iter_mut().zip(push.iter()).for_each(|(moved, push)| *moved = *push);
                for (x, along) in column.to_array().iter().zip(step.by_state.column_iter()) {
                    let mut by = [T::ZERO; N];
                    by.iter_mut().zip(along.iter()).for_each(|(by, along)| *by = *along);
                    add(&mut moved, *x, &by);
                }
                if !moved.iter().all(|entry| entry.is_finite()) {
                    return Err(SensitivityError::NotFinite {
                        what: "derivative of the step",
                        time: t.to_f64(),
                    });
                }
                *column = S::State::from_array(moved);
            }
        }
        Ok(())
    }
}

/// A system on which what columns are taken by acts as inputs do.
struct Pushed<'a, S, F, const K: usize>(&'a Variational<S, F, K>);

impl<S, F, T, const N: usize, const M: usize, const Q: usize, const K: usize> Dynamics for Pushed<'_, S, F, K>
where
    T: Scalar,
    S: Jacobian<InputDim = D<M>, State: State<Scalar = T, Dim = D<N>>>,
    F: Fn(&S, T, &S::State, &S::Input) -> SMatrix<T, N, Q>,
{
    type State = S::State;
    type Input = S::Input;

    #[inline]
    fn derivative(&self, t: T, state: &S::State, input: &S::Input) -> S::State {
        self.0.system.derivative(t, state, input)
    }
}

impl<S, F, T, const N: usize, const M: usize, const Q: usize, const K: usize> Jacobian for Pushed<'_, S, F, K>
where
    T: Scalar,
    S: Jacobian<InputDim = D<M>, State: State<Scalar = T, Dim = D<N>>>,
    F: Fn(&S, T, &S::State, &S::Input) -> SMatrix<T, N, Q>,
{
    type InputDim = D<K>;

    #[inline]
    fn state_jacobian(&self, t: T, state: &S::State, input: &S::Input) -> [[T; N]; N] {
        self.0.system.state_jacobian(t, state, input)
    }
    #[inline]
    fn input_jacobian(&self, t: T, state: &S::State, input: &S::Input) -> RowsByInput<Self> {
        self.linearized(t, state, input).2
    }
    #[inline]
    fn linearized(
        &self,
        t: T,
        state: &S::State,
        input: &S::Input,
    ) -> (S::State, [[T; N]; N], RowsByInput<Self>) {
        let (rate, a, pushes) = self.0.equations(t, state, input);
        let mut rows = [[T::ZERO; K]; N];
        for (i, row) in rows.iter_mut().enumerate() {
            for (entry, push) in row.iter_mut().zip(&pushes) {
                *entry = push.get(i).copied().unwrap_or(T::ZERO);
            }
        }
        (rate, a, rows)
    }
    #[inline]
    fn state_depends(row: usize, column: usize) -> bool {
        S::state_depends(row, column)
    }
}

/// Whether the return of a system to position constraints has a derivative at a state.
pub(super) fn knows_its_return<S, T, const N: usize>(system: &S, t: T, state: &S::State) -> bool
where
    T: Scalar,
    S: Jacobian<State: State<Scalar = T, Dim = D<N>>>,
{
    system.return_jacobian(t, state).iter().flatten().all(|slope| slope.is_finite())
}
