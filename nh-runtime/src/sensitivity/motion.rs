//! Forward sensitivities: a motion with its derivatives by its start, its inputs and its parameters.

use nalgebra::SMatrix;

use super::no_derivative::SensitivityError;
use super::stack::{Columns, Stack, Stacked};
use crate::error::{InputFault, ParameterError, ProjectionError, StateFault};
use crate::{D, Dim, Dynamics, Jacobian, Scalar, ScalarOf, State, VecOf};

/// What a column of derivatives is taken by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum By {
    /// A component of the state at the start, by its number.
    Start(usize),
    /// An input, constant from the start on, by its number.
    Input(usize),
    /// A parameter, by its column in the `parameter_jacobian`.
    Parameter(usize),
}

/// A state with `K` columns of derivatives, each with the components of the state: `columns[2].theta` is the derivative
/// of `state.theta` by what column 2 is taken by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WithColumns<X, const K: usize> {
    /// The state.
    pub state: X,
    /// Its derivatives.
    pub columns: [X; K],
}

impl<X, const N: usize, const K: usize> State for WithColumns<X, K>
where
    X: State<Dim = D<N>>,
    D<K>: Columns,
{
    type Scalar = X::Scalar;
    type Dim = Stack<N, K>;

    #[inline]
    fn to_array(&self) -> Stacked<X::Scalar, N, K> {
        Stacked::of(self.state.to_array(), &self.columns.map(|column| column.to_array()))
    }

    #[inline]
    fn from_array(components: Stacked<X::Scalar, N, K>) -> Self {
        let (state, columns) = components.parts();
        let mut parts = Self { state: X::from_array(*state), columns: [X::from_array(*state); K] };
        for (part, column) in parts.columns.iter_mut().zip(columns) {
            *part = X::from_array(*column);
        }
        parts
    }

    /// Every column has the names of the state's components.
    fn names() -> Stacked<&'static str, N, K> {
        Stacked::of(X::names(), &[X::names(); K])
    }
}

/// A closure that has no parameters to give derivatives by.
pub type NoParameters<S, T, const N: usize> =
    fn(&S, T, &<S as Dynamics>::State, &<S as Dynamics>::Input) -> SMatrix<T, N, 0>;

/// The variational equations of a system, beside it: ẋ = F(t, x, u, p) and Ẋ = (∂F/∂x) X + ∂F/∂s, mathematics (51), with a
/// column of X for each s.
///
/// It is a system like others, whose state is [`WithColumns`]. What an integration of it gives is
///
/// - the derivative of the **exact motion**, to the tolerance of an adaptive method: [`ColumnTolerance`](super::ColumnTolerance) says what the
///   columns may err by, and whether they are looked at;
/// - the derivative of the **steps that are taken**, their lengths held, to round-off, where the method is explicit:
///   a step of the variational equation is the derivative of the step (Hairer, Lubich, Wanner, Geometric Numerical
///   Integration, lemma VI.4.1). For an adaptive one the columns then should have no part in the choice of the lengths:
///   [`ColumnTolerance::of_state`](super::ColumnTolerance::of_state).
///
/// Implicit methods solve it like any other system, with a Jacobian by differences of (K + 1) times the size: for few
/// columns. [`advance`](Self::advance) differentiates the steps of an implicit method without that.
///
/// Where the system returns to position constraints, its state does, and with `emit { return_jacobian }` columns by starts
/// and inputs go through the return. Those by parameters, on which the constraints may depend, and all without it stay
/// as they are computed, tangent to the constraints to the error of the method.
///
/// ```
/// use nonholonomic::prelude::*;
/// use nonholonomic::sensitivity::{By, ColumnTolerance, Variational};
///
/// /// A mass on a spring.
/// #[nonholonomic(
///     base       { x }
///     lagrangian { m / 2 * der(x)^2 - k / 2 * x^2 }
///     emit       { jacobian, parameter_jacobian }
/// )]
/// #[derive(Clone, Copy, Debug)]
/// struct Spring { m: f64, k: f64 }
///
/// # fn main() -> Result<(), Box<dyn core::error::Error>> {
/// let spring = Spring { m: 1.0, k: 4.0 };
/// // by the place at the start, and by the second parameter, k
/// let motion = Variational::new(spring, [By::Start(0), By::Parameter(1)])
///     .by_parameters(|spring: &Spring, t, x, u| spring.parameter_jacobian(t, x, u));
/// let start = motion.start(&SpringState { x: 1.0, x_dot: 0.0 })?;
/// let method = Dopri5::new().tolerance(ColumnTolerance::new(1e-9, 1e-9));
/// let mut sim = Integrator::new(motion, method, 0.0, start);
/// sim.advance_to(3.0)?;
/// // x = cos ωt with ω = √(k/m), so ∂x/∂x₀ = cos ωt and ∂x/∂k = −t sin ωt / (2 m ω)
/// let [by_place, by_stiffness] = sim.state().columns;
/// assert!((by_place.x - 6.0_f64.cos()).abs() < 1e-7);
/// assert!((by_stiffness.x + 3.0 / 4.0 * 6.0_f64.sin()).abs() < 1e-7);
/// # Ok(())
/// # }
/// ```
#[doc(alias("sensitivity analysis", "variational equations", "tangent linear model", "CVODES"))]
#[derive(Clone, Copy, Debug)]
pub struct Variational<S, F, const K: usize> {
    pub(super) system: S,
    pub(super) columns: [By; K],
    pub(super) parameters: F,
}

impl<S, T, const N: usize, const K: usize> Variational<S, NoParameters<S, T, N>, K>
where
    T: Scalar,
    S: Dynamics<State: State<Scalar = T, Dim = D<N>>>,
{
    /// A system with a column for each of these.
    #[must_use]
    pub fn new(system: S, columns: [By; K]) -> Self {
        Self { system, columns, parameters: |_, _, _, _| SMatrix::from([[T::ZERO; N]; 0]) }
    }

    /// Gives the derivatives of F by the parameters: the generated `parameter_jacobian`, or what is made of it by the
    /// chain rule where parameters depend on each other.
    #[must_use]
    pub fn by_parameters<G, const Q: usize>(self, parameters: G) -> Variational<S, G, K>
    where
        G: Fn(&S, T, &S::State, &S::Input) -> SMatrix<T, N, Q>,
    {
        Variational { system: self.system, columns: self.columns, parameters }
    }
}

impl<S, F, T, const N: usize, const M: usize, const Q: usize, const K: usize> Variational<S, F, K>
where
    T: Scalar,
    S: Jacobian<InputDim = D<M>, State: State<Scalar = T, Dim = D<N>>>,
    F: Fn(&S, T, &S::State, &S::Input) -> SMatrix<T, N, Q>,
{
    /// The system.
    #[must_use]
    pub fn system(&self) -> &S {
        &self.system
    }

    /// A start with its columns: a unit for each [`By::Start`], zero otherwise. Where the start itself depends on what a
    /// column is taken by, put the derivative there.
    ///
    /// # Errors
    /// [`SensitivityError::NoSuchColumn`] if a column is taken by what there is not.
    pub fn start(&self, state: &S::State) -> Result<WithColumns<S::State, K>, SensitivityError> {
        let mut columns = [[T::ZERO; N]; K];
        for (column, by) in columns.iter_mut().zip(self.columns) {
            let (what, index, count) = match by {
                By::Start(index) => ("components of the state", index, N),
                By::Input(index) => ("inputs", index, M),
                By::Parameter(index) => ("parameters", index, Q),
            };
            if index >= count {
                return Err(SensitivityError::NoSuchColumn { what, index, count });
            }
            if let (By::Start(_), Some(entry)) = (by, column.get_mut(index)) {
                *entry = T::ONE;
            }
        }
        Ok(WithColumns { state: *state, columns: columns.map(S::State::from_array) })
    }

    /// Whether a column is taken by a parameter.
    pub(super) fn has_parameters(&self) -> bool {
        self.columns.iter().any(|by| matches!(by, By::Parameter(_)))
    }

    /// What the return of a state to position constraints makes of columns, to first order. Those by parameters, on which
    /// the constraints may depend, stay where their equations lead them, and so do all without `emit { return_jacobian }`.
    fn return_columns(&self, t: T, displaced: &S::State, columns: &mut [S::State; K]) {
        let slopes = self.system.return_jacobian(t, displaced);
        if !slopes.iter().flatten().all(|slope| slope.is_finite()) {
            return;
        }
        let by_state = columns.iter_mut().zip(self.columns).filter(|(_, by)| !matches!(by, By::Parameter(_)));
        for (column, _) in by_state {
            let before = column.to_array();
            let image =
                |row: &[T; N]| row.iter().zip(&before).fold(T::ZERO, |sum, (a, x)| a.mul_add(*x, sum));
            *column = S::State::from_array(core::array::from_fn(|i| slopes.get(i).map_or(T::ZERO, image)));
        }
    }

    /// F, ∂F/∂x by rows, and ∂F/∂s, a column for each s. What a column is taken by and there is not is NaN.
    #[inline]
    pub(super) fn equations(
        &self,
        t: T,
        state: &S::State,
        input: &S::Input,
    ) -> (S::State, [[T; N]; N], [[T; N]; K]) {
        let (rate, a, b) = self.system.linearized(t, state, input);
        let parameters = self.has_parameters().then(|| (self.parameters)(&self.system, t, state, input));
        let mut pushes = [[T::ZERO; N]; K];
        for (push, by) in pushes.iter_mut().zip(self.columns) {
            for (row, push) in push.iter_mut().enumerate() {
                let found = match by {
                    By::Start(_) => Some(T::ZERO),
                    By::Input(index) => b.get(row).and_then(|row| row.get(index)).copied(),
                    By::Parameter(index) => {
                        parameters.as_ref().and_then(|matrix| matrix.get((row, index))).copied()
                    }
                };
                *push = found.unwrap_or_else(|| T::from_f64(f64::NAN));
            }
        }
        (rate, a, pushes)
    }
}

impl<S, F, T, const N: usize, const M: usize, const Q: usize, const K: usize> Dynamics
    for Variational<S, F, K>
where
    T: Scalar,
    S: Jacobian<InputDim = D<M>, State: State<Scalar = T, Dim = D<N>>>,
    F: Fn(&S, T, &S::State, &S::Input) -> SMatrix<T, N, Q>,
    D<K>: Columns,
{
    type State = WithColumns<S::State, K>;
    type Input = S::Input;

    #[inline]
    fn derivative(&self, t: T, point: &Self::State, input: &S::Input) -> Self::State {
        let (state, a, mut columns) = self.equations(t, &point.state, input);
        for (rate, column) in columns.iter_mut().zip(&point.columns) {
            let column = column.to_array();
            for (i, (rate, row)) in rate.iter_mut().zip(&a).enumerate() {
                for (j, (a, x)) in row.iter().zip(&column).enumerate() {
                    if S::state_depends(i, j) {
                        *rate = a.mul_add(*x, *rate);
                    }
                }
            }
        }
        WithColumns { state, columns: columns.map(S::State::from_array) }
    }

    fn validate(&self) -> Result<(), ParameterError> {
        self.system.validate()
    }

    fn check_state(&self, t: T, point: &Self::State) -> Result<(), StateFault> {
        self.system.check_state(t, &point.state)
    }

    fn has_positions(&self) -> bool {
        self.system.has_positions()
    }

    fn return_to_positions(&self, t: T, point: &mut Self::State) -> Result<T, ProjectionError> {
        let displaced = point.state;
        let residual = self.system.return_to_positions(t, &mut point.state)?;
        // a state that stays where it is has neighbours that are moved; returns take two steps of Newton's where one does
        // not reach the constraints, and a second one leaves what lies along them as it is
        let mut between = displaced;
        for _ in 0..2 {
            self.return_columns(t, &between, &mut point.columns);
            self.system.correct_positions(t, &mut between);
        }
        Ok(residual)
    }

    fn correction(&self, before: &Self::State, after: &Self::State) -> VecOf<Self> {
        let mut all = Stack::<N, K>::vec(T::ZERO);
        let (state, _) = all.parts_mut();
        *state = self.system.correction(&before.state, &after.state);
        all
    }

    fn correct_positions(&self, t: T, point: &mut Self::State) {
        if self.system.has_positions() {
            self.return_columns(t, &point.state, &mut point.columns);
            self.system.correct_positions(t, &mut point.state);
        }
    }

    fn side(&self, t: T, point: &Self::State) -> ScalarOf<Self> {
        self.system.side(t, &point.state)
    }

    fn worst_constraint(&self, t: T, point: &Self::State) -> StateFault {
        self.system.worst_constraint(t, &point.state)
    }

    fn check_input(&self, input: &S::Input) -> Result<(), InputFault> {
        self.system.check_input(input)
    }
}
