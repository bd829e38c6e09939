//! The integration methods, by their names in the literature.
//!
//! | method | order | step | keeps |
//! |---|---|---|---|
//! | [`Euler`] | 1 | fixed | |
//! | [`Heun`] | 2 | fixed | |
//! | [`Ralston`] | 3 | fixed | |
//! | [`Rk4`] | 4 | fixed | |
//! | [`Bs23`] | 3 | adaptive, for low accuracy | |
//! | [`Dopri5`], [`Tsit5`] | 5 | adaptive | |
//! | [`Dop853`] | 8 | adaptive, for high accuracy | |
//! | [`Vern9`] | 9 | adaptive, near round-off | |
//! | [`Taylor`] | by the tolerance, up to 24 and more | adaptive | |
//! | [`ImplicitMidpoint`] | 2 | fixed, stiff systems too | quadratic invariants, reversibility |
//! | [`DiscreteGradient`] | 2 | fixed | the energy, quadratic constraints and identities, reversibility |
//! | `.fourth_order()`, `.sixth_order()` of the two above and of [`Rattle`] | 4, 6 | fixed | what they keep |
//! | [`ReflectedLeapfrog`] | 2 | fixed, on TQ | reversibility; energy and constraints nearly |
//! | [`Rattle`] | 2 | fixed, on TQ | position constraints, the symplectic form, reversibility; the energy nearly |
//! | [`DiscreteSuslov`] | 2 | fixed, on a Lie algebra | the constraints, reversibility; the energy nearly |
//! | [`GaussLegendre4`] | 4 | fixed, stiff systems too | quadratic invariants, reversibility |
//! | [`GaussLegendre6`] | 6 | fixed, stiff systems too | quadratic invariants, reversibility |
//! | [`Radau5`] | 5 | adaptive, for stiff systems | |
//! | [`Rodas5P`] | 5 | adaptive, for stiff systems | |
//! | [`Auto`] | 5 | adaptive, explicit where it can be, implicit where the equations are stiff | |
//! | [`Conserving`] | that of the method it is made of | likewise | the first integrals stated in `conserved` |
//! | [`Projected`] | that of the method it is made of | likewise | the constraints of the projected formulation |
//!
//! Implicit methods form the Jacobian ∂f/∂x by difference quotients, or take the one that the system
//! has: `Radau5::new().with_jacobian()`.
//!
//! Adaptive methods take tolerances for all components or [for each](Adaptive::tolerances), and a
//! [`Controller`] of the step's length. Every explicit one is a method of fixed step too:
//! `Dop853::fixed(h)`. Fixed steps may be summed [with compensation](Fixed::compensated).
//!
//! A step of fixed length by an explicit method takes the same number of instructions on every call, where the
//! derivative does: with [`Fast`](crate::Fast) numbers as long as no angle is beyond 1.6 million radians (6400 in
//! single precision), while the platform's sine has branches. Implicit methods and those that keep structure
//! iterate, up to a bound: their cost varies from step to step.
//!
//! The methods of fixed step are also one pure function each, `Rk4::step(&system, t, dt, &state,
//! &input)`, for a loop that keeps its own state and time. Where the system has a Jacobian,
//! `Rk4::linearized_step` gives the [`Transition`] with it: the exact derivatives of the step. All
//! explicit methods have it, [`ImplicitMidpoint`], the Gauss methods and [`Radau5`]; not [`Rodas5P`], whose
//! step contains the Jacobian, so that its derivative would need second derivatives.

#[macro_use]
mod cubic;
#[macro_use]
mod handed_on;

mod adaptive;
mod auto;
mod explicit;
mod first_step;
mod fixed;
mod grid;
mod implicit;
mod interruptible;
mod leg;
mod plateau;
mod power_iteration;
mod projected;
mod return_to;
mod structure;
mod taylor;
mod transition;
#[cfg(test)]
mod trees;
mod trial;

pub use adaptive::Adaptive;
pub use auto::Auto;
pub use explicit::{
    BogackiShampine3, DormandPrince5, DormandPrince8, Euler1, Heun2, Kutta4, Pair, Ralston3, Tableau,
    Tsitouras5, Verner9,
};
pub use fixed::{Compensated, Fixed, OneStep};
pub use implicit::{
    Analytic, FiniteDifferences, Gauss, GaussLegendre4, GaussLegendre6, ImplicitMidpoint, Linearization,
    Midpoint, Radau, Radau5, Rodas, Rodas5P,
};
pub use interruptible::Interruptible;
pub use projected::Projected;
pub use return_to::{Return, ToPositions};
pub use structure::{
    Composed, Conserving, DiscreteAction, DiscreteGradient, DiscreteMomentum, DiscreteSuslov, DriftKickDrift,
    Gonzalez, KahanLi6, Rattle, ReflectedLeapfrog, Substeps, Suzuki4, Symmetric, SymmetricProjection,
};
pub use taylor::Taylor;
pub use transition::Transition;
pub use trial::{Scheme, Spread, Trial};

pub(crate) use explicit::stages_of;

pub use crate::integrator::Returned;
pub use crate::step_control::Controller;
pub use crate::tolerance::{PerComponent, Tolerance, Uniform};

/// The explicit Euler method x₁ = x₀ + h f(t₀, x₀) with fixed steps, of order 1
/// (Euler, Institutionum calculi integralis, 1768, § 650).
pub type Euler<T> = Fixed<Euler1, T>;

/// The method of Heun with fixed steps, the explicit trapezoidal rule, of order 2 (Heun, Neue Methoden
/// zur approximativen Integration der Differentialgleichungen, Z. Math. Phys. 45 (1900)).
pub type Heun<T> = Fixed<Heun2, T>;

/// The method of order 3 with fixed steps whose truncation error has the least bound
/// (Ralston, Runge–Kutta methods with minimum error bounds, Math. Comp. 16 (1962)).
pub type Ralston<T> = Fixed<Ralston3, T>;

/// The classical Runge–Kutta method with fixed steps, of order 4
/// (Kutta 1901; Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I, table II.1.2).
pub type Rk4<T> = Fixed<Kutta4, T>;

/// The adaptive method of Bogacki and Shampine, of order 3 with an error estimate of order 2 and a
/// continuous extension of order 3: for low accuracy. The last evaluation of an accepted step is the
/// first of the next one (Bogacki, Shampine, A 3(2) pair of Runge–Kutta formulas, Appl. Math. Lett. 2
/// (1989)).
pub type Bs23<T, W = Uniform<T>> = Adaptive<BogackiShampine3, T, W>;

/// The adaptive method of Dormand and Prince, of order 5 with an error estimate of order 4 and a
/// continuous extension of order 4.
///
/// The seventh evaluation of an accepted step is the first of the next one. Sources: Dormand,
/// Prince, A family of embedded Runge–Kutta formulae, J. Comp. Appl. Math. 6 (1980), table 2;
/// Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I, table II.5.2 and, for the
/// continuous extension, section II.6.
///
/// ```
/// use nonholonomic::Dopri5;
///
/// let method: Dopri5<f64> = Dopri5::new().rtol(1e-9).atol(1e-12).max_step(0.1);
/// ```
pub type Dopri5<T, W = Uniform<T>> = Adaptive<DormandPrince5, T, W>;

/// The adaptive method of Tsitouras, of order 5 with an error estimate of order 4 and a continuous
/// extension of order 4, with smaller errors than [`Dopri5`] at the same cost (Tsitouras, Runge–Kutta
/// pairs of order 5(4) satisfying only the first column simplifying assumption, Comput. Math. Appl. 62
/// (2011)).
pub type Tsit5<T, W = Uniform<T>> = Adaptive<Tsitouras5, T, W>;

/// The adaptive method of Dormand and Prince of order 8, with an error estimate from two embedded
/// solutions of orders 5 and 3, and a continuous extension of order 7 that evaluates the derivative
/// four times more when it is asked for (Hairer, Nørsett, Wanner, Solving Ordinary Differential
/// Equations I, section II.5, II.6 and II.10, the code DOP853).
pub type Dop853<T, W = Uniform<T>> = Adaptive<DormandPrince8, T, W>;

/// The adaptive method of Verner of order 9, with an error estimate of order 8 and a continuous
/// extension of order 9 that evaluates the derivative ten times more when it is asked for: for
/// tolerances near round-off (Verner, Numerically optimal Runge–Kutta pairs with interpolants, Numer.
/// Algorithms 53 (2010), the "most efficient" 9(8) pair with the coefficients that he publishes).
pub type Vern9<T, W = Uniform<T>> = Adaptive<Verner9, T, W>;

use core::fmt;

use crate::arrays::first_non_finite;
use crate::{Dim, DimOf, Dynamics, IntegrationError, Real, Scalar, ScalarOf, State, Statistics, VecOf};

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

impl<S: Dynamics> Clone for Arrival<S> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<S: Dynamics> Copy for Arrival<S> {}

/// Where a step has led to, and how its end was returned to where it belongs, if it was.
pub type Step<S> = (Arrival<S>, Option<Returned<S>>);

/// Where an integration stands, and where its last step came from.
pub struct Place<S: Dynamics> {
    /// The time.
    pub time: ScalarOf<S>,
    /// The state.
    pub state: S::State,
    /// Time and state at the start of the last step, once one has been taken.
    pub before: Option<(ScalarOf<S>, S::State)>,
}

/// Debug of a point by its time and state.
macro_rules! debug_point {
    ($($name:ident <$($life:lifetime)?>)*) => {$(
        impl<S: Dynamics> fmt::Debug for $name<$($life,)? S>
        where
            S::State: fmt::Debug,
        {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                let name = stringify!($name);
                f.debug_struct(name).field("time", &self.time).field("state", &self.state).finish_non_exhaustive()
            }
        }
    )*};
}
debug_point!(Start<'_> Arrival<> Place<>);

impl<S: Dynamics> Place<S> {
    /// Takes the step to `arrival`.
    #[inline]
    pub fn move_to(&mut self, arrival: Arrival<S>) {
        self.before = Some((self.time, self.state));
        self.time = arrival.time;
        self.state = arrival.state;
    }
}

/// A one-step method, as an [`Integrator`](crate::Integrator) drives it.
///
/// The method itself is its settings. What it has to remember from step to step is its `Memory`,
/// which the integrator keeps; a step that fails may be followed by another from the same start.
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

    /// Removes from the memory what depends on the state, because another one has been given.
    fn restart(&self, memory: &mut Self::Memory) {
        self.forget(memory);
    }

    /// Removes from the memory what holds at the state at the end of the last step alone, because that has been moved
    /// by no more than the method's own error: what has been learnt on the way, about the length of steps, the
    /// Jacobian, a level that is kept, still holds.
    fn moved(&self, memory: &mut Self::Memory) {
        self.forget(memory);
    }

    /// Removes from the memory what holds at the end of the last step, because that has been cut at a state within it: of
    /// the same motion, so that a level which is kept still holds.
    fn stand(&self, memory: &mut Self::Memory) {
        self.forget(memory);
        self.moved(memory);
    }

    /// Whether steps end where position constraints hold: an [`Integrator`](crate::Integrator) does not return them then.
    #[inline]
    fn keeps_positions(&self) -> bool {
        false
    }

    /// Whether how far the end of a step has come off where it belongs counts as error, as in methods that choose their
    /// steps.
    #[inline]
    fn judges(&self) -> bool {
        false
    }

    /// Checks the settings.
    ///
    /// # Errors
    /// [`IntegrationError::Setting`] for the first setting that is out of its range.
    fn check(&self) -> Result<(), IntegrationError>;

    /// How far each component of a given state may lie from where it belongs: its tolerance, and for a method of
    /// fixed step √ε of the largest component.
    fn permitted(&self, state: &S::State) -> VecOf<S>
    where
        ScalarOf<S>: Real,
    {
        let x = state.to_array();
        let largest = x.as_ref().iter().fold(ScalarOf::<S>::ZERO, |largest, x| largest.max(x.abs()));
        DimOf::<S>::vec(ScalarOf::<S>::EPSILON.sqrt() * largest)
    }

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

    /// As [`advance`](Self::advance), where the state at the end is to be returned `by` this, and how that was done, if it
    /// was: a method that evaluates the derivative at the end of a step returns the state before that, and one that
    /// chooses its steps counts as error how far they have come off.
    ///
    /// # Errors
    /// As [`advance`](Self::advance); a state that cannot be returned is left to the caller.
    fn advance_and_return<R: Return<S>>(
        &self,
        start: &Start<'_, S>,
        target: Option<ScalarOf<S>>,
        by: &R,
        memory: &mut Self::Memory,
        statistics: &mut Statistics,
    ) -> Result<Step<S>, IntegrationError> {
        let _ = by;
        Ok((self.advance(start, target, memory, statistics)?, None))
    }

    /// Takes steps towards `target` until it is reached or `limit` of them are done, and gives their
    /// number. They are the steps that [`advance`](Self::advance) takes; a method that can take many
    /// of them at less cost than one by one does so here.
    ///
    /// # Errors
    /// As [`advance`](Self::advance); `place` is then the last good one.
    #[inline]
    fn travel(
        &self,
        system: &S,
        input: &S::Input,
        place: &mut Place<S>,
        (target, limit): (ScalarOf<S>, u64),
        memory: &mut Self::Memory,
        statistics: &mut Statistics,
    ) -> Result<u64, IntegrationError> {
        let mut steps = 0;
        while place.time != target && steps < limit {
            let start = Start { system, input, time: place.time, state: &place.state };
            let arrival = self.advance(&start, Some(target), memory, statistics)?;
            place.move_to(arrival);
            statistics.steps += 1;
            steps += 1;
        }
        Ok(steps)
    }

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
    pub(crate) fn derivative(&self) -> VecOf<S> {
        self.system.derivative(self.time, self.state, self.input).to_array()
    }

    /// The derivative at another point.
    #[inline]
    pub(crate) fn derivative_at(&self, t: ScalarOf<S>, x: VecOf<S>) -> VecOf<S> {
        self.derivative_in_line(t, x)
    }

    /// The same, in one piece with the caller if the system wants to be: for the few stages of a short method.
    #[inline(always)]
    #[allow(clippy::inline_always)]
    pub(crate) fn derivative_in_line(&self, t: ScalarOf<S>, x: VecOf<S>) -> VecOf<S> {
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
    let time = start.time.to_f64();
    if let Some(found) = first_non_finite(start.derivative().as_ref()) {
        return non_finite_derivative::<S::State>(found, time);
    }
    let (index, _) = first_non_finite(reached).unwrap_or_default();
    IntegrationError::NonFiniteStep { component: component::<S::State>(index), time, step: step.to_f64() }
}
