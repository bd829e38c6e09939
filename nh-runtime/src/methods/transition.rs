//! The derivative of a step: linearisation in discrete time.

use nalgebra::SMatrix;

use super::explicit::Tableau;
use super::fixed::Fixed;
use super::implicit::ImplicitMidpoint;
use super::implicit::newton::one_less;
use crate::linear::Factors;
use crate::{
    D, Dynamics, IntegrationError, Jacobian, Jet, MatOf, Real, RowsByInput, Scalar, ScalarOf, State,
};

/// A step with its exact derivative: x₁ = Φ(x, u), A_d = ∂Φ/∂x, B_d = ∂Φ/∂u.
///
/// It is the derivative of the numerical step, by the chain rule through its stages, and not that of the flow,
/// which differs from it by the error of the method. The input is constant during the step: this is
/// zero-order hold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transition<X, T, const N: usize, const M: usize> {
    /// The state at the end: that of the step alone, to rounding where the derivative comes in one program with its
    /// Jacobians ([`Jacobian::linearized`](crate::Jacobian::linearized)), as it does in generated systems.
    pub state: X,
    /// A_d: in row i, the derivatives of component i of it by the components of the state at the start.
    pub by_state: SMatrix<T, N, N>,
    /// B_d: in row i, the derivatives of component i of it by the inputs.
    pub by_input: SMatrix<T, N, M>,
}

impl<X, T: Scalar, const N: usize, const M: usize> Transition<X, T, N, M> {
    /// A step whose derivatives are yet to be found.
    pub(super) fn unknown(state: X) -> Self {
        let nan = T::from_f64(f64::NAN);
        Self { state, by_state: SMatrix::from([[nan; N]; N]), by_input: SMatrix::from([[nan; N]; M]) }
    }

    /// The step, if its derivatives are numbers.
    pub(super) fn regular(self, time: T, step: T) -> Result<Self, IntegrationError> {
        let mut entries = self.by_state.iter().chain(self.by_input.iter());
        if entries.all(|entry| entry.is_finite()) {
            return Ok(self);
        }
        Err(IntegrationError::SingularStep { time: time.to_f64(), step: step.to_f64() })
    }

    /// The step with the return to position constraints that follows it, at its end.
    pub(crate) fn returned<S>(mut self, system: &S, t: T) -> Self
    where
        S: Jacobian<State = X>,
        X: State<Scalar = T, Dim = D<N>>,
    {
        if system.has_positions() {
            let slopes = system.return_jacobian(t, &self.state);
            system.correct_positions(t, &mut self.state);
            self.by_state = image(&slopes, &self.by_state);
            self.by_input = image(&slopes, &self.by_input);
        }
        self
    }
}

/// A product of matrices.
fn image<T: Scalar, const N: usize, const M: usize>(
    rows: &[[T; N]; N],
    of: &SMatrix<T, N, M>,
) -> SMatrix<T, N, M> {
    let mut product = SMatrix::<T, N, M>::from([[T::ZERO; N]; M]);
    for (mut entries, column) in product.column_iter_mut().zip(of.column_iter()) {
        for (entry, row) in entries.iter_mut().zip(rows) {
            *entry = row.iter().zip(column.iter()).fold(T::ZERO, |sum, (a, x)| a.mul_add(*x, sum));
        }
    }
    product
}

/// A system whose states are not returned to position constraints.
pub(super) struct WithoutReturn<'a, S>(pub(super) &'a S);

impl<S: Dynamics> Dynamics for WithoutReturn<'_, S> {
    type State = S::State;
    type Input = S::Input;

    #[inline]
    fn derivative(&self, t: ScalarOf<S>, state: &S::State, input: &S::Input) -> S::State {
        self.0.derivative(t, state, input)
    }
}

impl<S: Jacobian> Jacobian for WithoutReturn<'_, S> {
    type InputDim = S::InputDim;

    #[inline]
    fn state_jacobian(&self, t: ScalarOf<S>, state: &S::State, input: &S::Input) -> MatOf<S> {
        self.0.state_jacobian(t, state, input)
    }
    #[inline]
    fn input_jacobian(&self, t: ScalarOf<S>, state: &S::State, input: &S::Input) -> RowsByInput<S> {
        self.0.input_jacobian(t, state, input)
    }
}

impl<P: Tableau, T: Scalar> Fixed<P, T> {
    /// One step of length `dt` with its derivatives by the state and the input, from the system's own Jacobian:
    /// a Runge–Kutta step of the variational equation Ẋ = A X, U̇ = A U + B is the derivative of the
    /// Runge–Kutta step (Hairer, Lubich, Wanner, Geometric Numerical Integration, lemma VI.4.1).
    ///
    /// Where the system returns to position constraints, the return is a part of the step, and differentiated with it if the
    /// system is declared with `emit { return_jacobian }` ([`Jacobian::return_jacobian`]); the derivatives are NaN if not.
    ///
    /// ```
    /// use nonholonomic::prelude::*;
    ///
    /// /// A mass on a spring, pushed.
    /// #[nonholonomic(
    ///     base       { x }
    ///     lagrangian { m / 2 * der(x)^2 - k / 2 * x^2 }
    ///     forces     { x: push; }
    ///     inputs     { push }
    ///     emit       { jacobian }
    /// )]
    /// #[derive(Clone, Copy, Debug)]
    /// struct Oscillator { m: f64, k: f64 }
    ///
    /// let oscillator = Oscillator { m: 1.0, k: 4.0 };
    /// let start = OscillatorState { x: 1.0, x_dot: 0.0 };
    /// let step = Rk4::linearized_step(&oscillator, 0.0, 0.1, &start, &OscillatorInput { push: 0.5 });
    /// assert_eq!(step.state, Rk4::step(&oscillator, 0.0, 0.1, &start, &OscillatorInput { push: 0.5 }));
    /// assert!((step.by_state[(0, 0)] - (2.0_f64 * 0.1).cos()).abs() < 1e-5);
    /// assert!((step.by_input[(0, 0)] - (1.0 - (2.0_f64 * 0.1).cos()) / 4.0).abs() < 1e-5);
    /// ```
    #[inline]
    pub fn linearized_step<S, const N: usize, const M: usize>(
        system: &S,
        t: T,
        dt: T,
        state: &S::State,
        input: &S::Input,
    ) -> Transition<S::State, T, N, M>
    where
        S: Jacobian<InputDim = D<M>>,
        S::State: State<Scalar = T, Dim = D<N>>,
    {
        let jets = Jets(Jet::variables(state.to_array()));
        let (from, length) = (Jet::constant(t), Jet::constant(dt));
        let Jets(end) = Fixed::<P, Jet<T, N, M>>::step(&Differentiated(system), from, length, &jets, input);
        let step = Transition {
            state: S::State::from_array(end.map(|jet| jet.value)),
            by_state: of_rows(&end.map(|jet| jet.by)),
            by_input: of_rows(&end.map(|jet| jet.by_others)),
        };
        step.returned(system, t + dt)
    }
}

/// The matrix with these rows.
pub(super) fn of_rows<T: Scalar, const N: usize, const M: usize>(rows: &[[T; M]; N]) -> SMatrix<T, N, M> {
    let mut matrix = SMatrix::<T, N, M>::from([[T::ZERO; N]; M]);
    for (mut entries, row) in matrix.row_iter_mut().zip(rows) {
        for (entry, number) in entries.iter_mut().zip(row) {
            *entry = *number;
        }
    }
    matrix
}

/// A state whose components carry their derivatives.
#[derive(Clone, Copy)]
struct Jets<T, const N: usize, const M: usize>([Jet<T, N, M>; N]);

impl<T: Scalar, const N: usize, const M: usize> State for Jets<T, N, M> {
    type Scalar = Jet<T, N, M>;
    type Dim = D<N>;

    #[inline]
    fn to_array(&self) -> [Jet<T, N, M>; N] {
        self.0
    }
    #[inline]
    fn from_array(components: [Jet<T, N, M>; N]) -> Self {
        Self(components)
    }
    fn names() -> [&'static str; N] {
        [""; N]
    }
}

/// A system whose derivative carries its own derivatives, by the chain rule from its Jacobian.
struct Differentiated<'a, S, const N: usize, const M: usize>(&'a S);

impl<S, T, const N: usize, const M: usize> Dynamics for Differentiated<'_, S, N, M>
where
    T: Scalar,
    S: Jacobian<InputDim = D<M>>,
    S::State: State<Scalar = T, Dim = D<N>>,
{
    type State = Jets<T, N, M>;
    type Input = S::Input;

    #[inline]
    fn derivative(&self, t: Jet<T, N, M>, state: &Jets<T, N, M>, input: &S::Input) -> Jets<T, N, M> {
        let point = S::State::from_array(state.0.map(|jet| jet.value));
        let (f, a, b) = self.0.linearized(t.value, &point, input);
        let f = f.to_array();
        let mut rates = [Jet::ZERO; N];
        for (i, (rate, ((f, a), b))) in rates.iter_mut().zip(f.iter().zip(&a).zip(&b)).enumerate() {
            rate.value = *f;
            rate.by_others = *b;
            for (j, (a, jet)) in a.iter().zip(&state.0).enumerate() {
                if S::state_depends(i, j) {
                    add(&mut rate.by, *a, &jet.by);
                    add(&mut rate.by_others, *a, &jet.by_others);
                }
            }
        }
        Jets(rates)
    }
}

/// sum += a x.
#[inline]
fn add<T: Scalar, const N: usize>(sum: &mut [T; N], a: T, x: &[T; N]) {
    for (sum, x) in sum.iter_mut().zip(x) {
        *sum = a.mul_add(*x, *sum);
    }
}

impl<T: Real> ImplicitMidpoint<T> {
    /// One step of length `dt` with its derivatives by the state and the input, from the system's own
    /// Jacobian A, B at the middle of the step: (1 − h/2 A) A_d = 1 + h/2 A and (1 − h/2 A) B_d = h B.
    ///
    /// # Errors
    /// As [`step_with_jacobian`](ImplicitMidpoint::step_with_jacobian), and
    /// [`IntegrationError::SingularStep`] for a singular matrix 1 − h/2 A.
    pub fn linearized_step<S, const N: usize, const M: usize>(
        system: &S,
        t: T,
        dt: T,
        state: &S::State,
        input: &S::Input,
    ) -> Result<Transition<S::State, T, N, M>, IntegrationError>
    where
        S: Jacobian<InputDim = D<M>>,
        S::State: State<Scalar = T, Dim = D<N>>,
    {
        let end = ImplicitMidpoint::step_with_jacobian(&WithoutReturn(system), t, dt, state, input)?;
        let half = dt * T::from_f64(0.5);
        let mut middle = state.to_array();
        for (middle, end) in middle.iter_mut().zip(end.to_array()) {
            *middle = (*middle + end) * T::from_f64(0.5);
        }
        let middle = S::State::from_array(middle);
        let a = system.state_jacobian(t + half, &middle, input);
        let b = system.input_jacobian(t + half, &middle, input);
        let (left, right) = (one_less::<D<N>, T>(half, a), one_less::<D<N>, T>(-half, a));
        let factors = Factors::<D<N>, T>::new(&left);
        let mut by_state = SMatrix::<T, N, N>::from([[T::ZERO; N]; N]);
        let mut by_input = SMatrix::<T, N, M>::from([[T::ZERO; N]; M]);
        solve_columns(&factors, &right, T::ONE, &mut by_state);
        solve_columns(&factors, &b, dt, &mut by_input);
        let step = Transition { state: end, by_state, by_input }.regular(t, dt)?;
        Ok(step.returned(system, t + dt))
    }
}

/// Solves for every column of a matrix that is given by its rows, times a factor.
fn solve_columns<T: Real, const N: usize, const M: usize>(
    factors: &Factors<D<N>, T>,
    rows: &[[T; M]; N],
    factor: T,
    solution: &mut SMatrix<T, N, M>,
) {
    for (j, mut column) in solution.column_iter_mut().enumerate() {
        let right = rows.map(|row| row.get(j).copied().unwrap_or(T::ZERO) * factor);
        for (entry, number) in column.iter_mut().zip(factors.solve(&right)) {
            *entry = number;
        }
    }
}
