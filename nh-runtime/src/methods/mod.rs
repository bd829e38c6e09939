//! The integration methods, by their names in the literature.
//!
//! | method | order | step | keeps |
//! |---|---|---|---|
//! | [`Euler`] | 1 | fixed | |
//! | [`Rk4`] | 4 | fixed | |
//! | [`Dopri5`] | 5 | adaptive | |
//! | [`ImplicitMidpoint`] | 2 | fixed, stiff systems too | quadratic invariants, reversibility |
//! | [`Projected`] | that of the method it is made of | likewise | the constraints of the projected formulation |
//!
//! Implicit methods form the Jacobian ∂f/∂x by difference quotients, or take the one that the system
//! has: `ImplicitMidpoint::new(h).with_jacobian()`.
//!
//! The methods of fixed step are also one pure function each, `Rk4::step(&system, t, dt, &state,
//! &input)`, for a loop that keeps its own state and time.

mod adaptive;
mod dopri5;
mod euler;
mod fixed;
mod implicit_midpoint;
mod linearization;
mod projected;
mod rk4;

pub use dopri5::Dopri5;
pub use euler::Euler;
pub use implicit_midpoint::ImplicitMidpoint;
pub use linearization::{Analytic, FiniteDifferences, Linearization};
pub use projected::Projected;
pub use rk4::Rk4;

use crate::arrays::first_non_finite;
use crate::{Dynamics, IntegrationError, ScalarOf, State, Statistics};

/// The point that a step starts from.
pub struct Start<'a, S: Dynamics> {
    /// The system.
    pub system: &'a S,
    /// Its input during the step.
    pub input: &'a S::Input,
    /// The time.
    pub time: ScalarOf<S>,
    /// The state.
    pub state: &'a S::State,
}

/// The point that a step has led to.
pub struct Arrival<S: Dynamics> {
    /// The time.
    pub time: ScalarOf<S>,
    /// The state, which is finite.
    pub state: S::State,
}

/// A one-step method, as an [`Integrator`](crate::Integrator) drives it.
///
/// The method itself is its settings. What it has to remember from step to step is its `Memory`,
/// which the integrator keeps; a step that fails leaves it as it was.
pub trait Method<S: Dynamics> {
    /// What the method remembers from step to step.
    type Memory: Copy;
    /// What the states between the ends of a step are computed from.
    type Dense: Copy;

    /// The memory before the first step.
    fn memory(&self) -> Self::Memory;

    /// Removes from the memory what depends on the input or on the state at the end of the last
    /// step, because one of them has been changed.
    fn forget(&self, memory: &mut Self::Memory);

    /// Checks the settings.
    ///
    /// # Errors
    /// [`IntegrationError::Setting`] for the first setting that is out of its range.
    fn check(&self) -> Result<(), IntegrationError>;

    /// Takes one step, forwards in time if there is no `target`, and otherwise towards it, landing
    /// on it exactly rather than passing it.
    ///
    /// # Errors
    /// Why there is no step that the method can stand for.
    fn advance(
        &self,
        start: &Start<'_, S>,
        target: Option<ScalarOf<S>>,
        memory: &mut Self::Memory,
        statistics: &mut Statistics,
    ) -> Result<Arrival<S>, IntegrationError>;

    /// Prepares the dense output of the last step, which led from `start` to `arrival`: whatever it
    /// needs beyond what the step itself has computed is evaluated here, and only here.
    fn dense(&self, memory: &Self::Memory, start: &Start<'_, S>, arrival: &Arrival<S>) -> Self::Dense;

    /// The state at a time within the step that `dense` was prepared for.
    fn interpolate(
        &self,
        dense: &Self::Dense,
        start: &Start<'_, S>,
        arrival: &Arrival<S>,
        time: ScalarOf<S>,
    ) -> S::State;
}

impl<S: Dynamics> Start<'_, S> {
    /// The derivative at the start.
    #[inline]
    pub(crate) fn derivative(&self) -> crate::VecOf<S> {
        self.system.derivative(self.time, self.state, self.input).to_array()
    }

    /// The derivative at another point.
    #[inline]
    pub(crate) fn derivative_at(&self, t: ScalarOf<S>, x: crate::VecOf<S>) -> crate::VecOf<S> {
        self.system.derivative(t, &S::State::from_array(x), self.input).to_array()
    }
}

/// The name of a component.
#[cold]
pub(crate) fn component<X: State>(index: usize) -> &'static str {
    X::names().as_ref().get(index).copied().unwrap_or("?")
}

/// The error that a derivative of component `index` is not finite.
#[cold]
pub(crate) fn non_finite_derivative<X: State>((index, value): (usize, f64), time: f64) -> IntegrationError {
    IntegrationError::NonFiniteDerivative { component: component::<X>(index), time, value }
}

/// Explains why a step has led to a state that is not finite: the derivative at its start, or else
/// the step itself.
#[cold]
pub(crate) fn explain_non_finite<S: Dynamics>(
    start: &Start<'_, S>,
    step: ScalarOf<S>,
    reached: &[ScalarOf<S>],
) -> IntegrationError {
    use crate::Scalar;
    let time = start.time.to_f64();
    if let Some(found) = first_non_finite(start.derivative().as_ref()) {
        return non_finite_derivative::<S::State>(found, time);
    }
    let (index, _) = first_non_finite(reached).unwrap_or_default();
    IntegrationError::NonFiniteStep { component: component::<S::State>(index), time, step: step.to_f64() }
}
