//! What a system is to an integrator.

use crate::error::{InputFault, ParameterError, ProjectionError, StateFault};
use crate::held::Held;
use crate::{Dim, Scalar};

/// A point of the phase space: a plain struct with one named field per component.
///
/// Derivatives have the same type; the field `x` of a derivative is ẋ.
pub trait State: Copy + 'static {
    /// The type of the components.
    type Scalar: Scalar;
    /// The number of components: `D<N>`.
    type Dim: Dim;

    /// The components in order: base coordinates, then velocities.
    fn to_array(&self) -> <Self::Dim as Dim>::Vec<Self::Scalar>;
    /// The state with these components.
    fn from_array(components: <Self::Dim as Dim>::Vec<Self::Scalar>) -> Self;
    /// The names of the components in order, for messages.
    fn names() -> <Self::Dim as Dim>::Vec<&'static str>;
}

/// The numbers that a system computes with.
pub type ScalarOf<S> = <<S as Dynamics>::State as State>::Scalar;
/// The dimension of a system's state.
pub type DimOf<S> = <<S as Dynamics>::State as State>::Dim;
/// The components of a system's state as an array.
pub type VecOf<S> = <DimOf<S> as Dim>::Vec<ScalarOf<S>>;
/// A square matrix of the size of a system's state, as an array of rows.
pub type MatOf<S> = <DimOf<S> as Dim>::Mat<ScalarOf<S>>;

/// A system of ordinary differential equations ẋ = f(t, x, u).
///
/// Implemented by `#[nonholonomic]`, or by hand as at the head of the [crate]. The state must be
/// everything that `derivative` depends on: a method evaluates it at points and times of its
/// choice, rejected ones included. Within a step the input is constant.
pub trait Dynamics {
    /// A point of the phase space.
    type State: State;
    /// The control inputs; `()` if there are none.
    type Input: Copy + Default;

    /// The time derivative of the state: f(t, x, u).
    fn derivative(&self, t: ScalarOf<Self>, state: &Self::State, input: &Self::Input) -> Self::State;

    /// Checks the parameters; an integrator does so before its first step.
    ///
    /// # Errors
    /// The first parameter that is not finite, breaks an assumption or makes a pivot zero.
    #[inline]
    fn validate(&self) -> Result<(), ParameterError> {
        Ok(())
    }

    /// Checks a state that a user gives, beyond that it is finite: the identities that embedded
    /// coordinates have to satisfy. An integrator does so before it steps from such a state.
    ///
    /// # Errors
    /// The first identity that does not hold, with its residual.
    #[inline]
    fn check_state(&self, t: ScalarOf<Self>, state: &Self::State) -> Result<(), StateFault> {
        let _ = (t, state);
        Ok(())
    }

    /// Whether the state has to satisfy position constraints: an [`Integrator`](crate::Integrator) then returns
    /// it to them at the end of every step.
    #[inline]
    fn has_positions(&self) -> bool {
        false
    }

    /// Moves a state to where its position constraints hold, and its velocities to all constraints there, and
    /// gives the largest residual that was found. Without position constraints nothing happens.
    ///
    /// # Errors
    /// If the constraints are not reached; the state is then as it was.
    #[inline]
    fn return_to_positions(
        &self,
        t: ScalarOf<Self>,
        state: &mut Self::State,
    ) -> Result<ScalarOf<Self>, ProjectionError> {
        let _ = (t, state);
        Ok(ScalarOf::<Self>::ZERO)
    }

    /// By how much a return has moved each component of a state: what a start is judged by, and what statistics say. What
    /// goes beside a state and follows it, as the columns of a [`Variational`](crate::sensitivity::Variational) do, is not
    /// moved.
    fn correction(&self, before: &Self::State, after: &Self::State) -> VecOf<Self> {
        let mut moved = after.to_array();
        for (moved, before) in moved.as_mut().iter_mut().zip(before.to_array().as_ref()) {
            *moved = (*moved - *before).abs();
        }
        moved
    }

    /// One step of that return for the positions and one for the velocities, whatever they lead to: the same
    /// instructions at every call.
    #[inline]
    fn correct_positions(&self, t: ScalarOf<Self>, state: &mut Self::State) {
        let _ = (t, state);
    }

    /// The sign of what the velocities in the state leave to be divided by, 1 or −1: where it changes, as at the dead
    /// centre of a crank, they do not determine the others.
    #[inline]
    fn side(&self, t: ScalarOf<Self>, state: &Self::State) -> ScalarOf<Self> {
        let _ = (t, state);
        ScalarOf::<Self>::ONE
    }

    /// The constraint that a state leaves the largest residual in.
    fn worst_constraint(&self, t: ScalarOf<Self>, state: &Self::State) -> StateFault {
        let _ = (t, state);
        StateFault { identity: "", residual: 0.0 }
    }

    /// Checks an input that a user gives. An integrator does so before it steps with it.
    ///
    /// # Errors
    /// The first input that is not finite.
    #[inline]
    fn check_input(&self, input: &Self::Input) -> Result<(), InputFault> {
        let _ = input;
        Ok(())
    }
}

/// A system with an energy.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no energy",
    label = "needs the trait `Energy`",
    note = "systems declared with `#[nonholonomic]` have one; implement `Energy` by hand for others"
)]
pub trait Energy: Dynamics {
    /// E(t, x) = yᵅ ∂L/∂yᵅ − L, which is conserved where the system is autonomous, its constraints
    /// are homogeneous in the velocities, and no forces act.
    fn energy(&self, t: ScalarOf<Self>, state: &Self::State) -> ScalarOf<Self>;
}

/// A system that moves by its energy alone, ẋ = Π(x) ∂E(x) with an antisymmetric Π: the nonholonomic
/// bracket. Declared with `emit { discrete_gradient }`, which is refused where the energy is not
/// conserved.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no gradient of its energy and bracket",
    label = "needs the trait `AlmostPoisson`",
    note = "add `emit {{ discrete_gradient }}` to its declaration, or implement `AlmostPoisson` by hand"
)]
pub trait AlmostPoisson: Energy {
    /// ∂E/∂x.
    fn energy_gradient(&self, t: ScalarOf<Self>, state: &Self::State) -> VecOf<Self>;

    /// Π(x) applied to a covector, antisymmetric at every x: also where the state does not satisfy its
    /// constraints. With the gradient of the energy it gives the derivative of the state where it does.
    fn almost_poisson(&self, t: ScalarOf<Self>, state: &Self::State, covector: &VecOf<Self>) -> VecOf<Self>;

    /// Whether steps have to hold equations beside the energy: position constraints.
    const HOLDS: bool = false;

    /// As [`Holding::held`](crate::Holding::held).
    #[inline]
    fn held_equations(&self, t: ScalarOf<Self>, state: &Self::State) -> Held<Self::State> {
        let _ = (t, state);
        Held::none()
    }

    /// As [`Holding::equations`](crate::Holding::equations).
    #[inline]
    fn residuals(&self, t: ScalarOf<Self>, state: &Self::State) -> VecOf<Self> {
        let _ = (t, state);
        DimOf::<Self>::vec(ScalarOf::<Self>::ZERO)
    }
}

/// A system with stated first integrals: declared with `conserved { … }` and `emit { invariants }`.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no first integrals",
    label = "needs the trait `Invariants`",
    note = "state them in `conserved {{ … }}` and add `emit {{ invariants }}` to its declaration, or implement `Invariants` by hand"
)]
pub trait Invariants: Dynamics {
    /// The number of first integrals: `D<K>`.
    type Count: Dim;

    /// The first integrals at a state.
    fn invariants(&self, t: ScalarOf<Self>, state: &Self::State)
    -> <Self::Count as Dim>::Vec<ScalarOf<Self>>;

    /// The gradient of each by the components of the state.
    fn invariant_gradients(
        &self,
        t: ScalarOf<Self>,
        state: &Self::State,
    ) -> <Self::Count as Dim>::Vec<VecOf<Self>>;
}

/// A system on TQ with constant masses, for the leapfrog method: declared with `emit { leapfrog }`.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no kick",
    label = "needs the trait `Leapfrog`",
    note = "add `emit {{ leapfrog }}` to its declaration, or implement `Leapfrog` by hand"
)]
pub trait Leapfrog: Dynamics {
    /// The state after a kick of length h at its place: velocities v⁺ with W (v⁺ − v⁻) = −h ∂V + Aᵀμ and
    /// A (v⁺ + v⁻) = 0.
    fn kick(&self, state: &Self::State, h: ScalarOf<Self>) -> Self::State;
}

/// A system on a Lie algebra with its discrete momentum: declared with
/// `emit { euler_poincare_suslov }`.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no discrete momentum",
    label = "needs the trait `EulerPoincareSuslov`",
    note = "add `emit {{ euler_poincare_suslov }}` to its declaration, or implement `EulerPoincareSuslov` by hand"
)]
pub trait EulerPoincareSuslov: Dynamics {
    /// ⟨p, B_a − h/2 [y, B_a] + h²/12 [y, [y, B_a]]⟩ at the velocities y = B v, for each a.
    fn discrete_momentum(&self, state: &Self::State, h: ScalarOf<Self>) -> VecOf<Self>;
}

/// A system with named observables.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no observables",
    label = "needs the trait `Observed`",
    note = "name some in `outputs {{ … }}` of its declaration, or implement `Observed` by hand"
)]
pub trait Observed: Dynamics {
    /// The observables, one named field each.
    type Outputs;

    /// The observables at a state.
    fn outputs(&self, t: ScalarOf<Self>, state: &Self::State, input: &Self::Input) -> Self::Outputs;
}

/// A system whose derivative has a derivative.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no Jacobian",
    label = "needs the trait `Jacobian`",
    note = "add `emit {{ jacobian }}` to its declaration, or implement `Jacobian` by hand"
)]
pub trait Jacobian: Dynamics {
    /// The number of scalar inputs: `D<M>`.
    type InputDim: Dim;

    /// A = ∂f/∂x: in row i, the derivatives of component i of ẋ by the components of the state.
    fn state_jacobian(&self, t: ScalarOf<Self>, state: &Self::State, input: &Self::Input) -> MatOf<Self>;

    /// B = ∂f/∂u: in row i, the derivatives of component i of ẋ by the inputs.
    fn input_jacobian(
        &self,
        t: ScalarOf<Self>,
        state: &Self::State,
        input: &Self::Input,
    ) -> RowsByInput<Self>;

    /// f, A and B at once. Generated code computes all of them in one program, where what they share is computed
    /// once; they are then those of the other functions up to rounding.
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
    /// let oscillator = Oscillator { m: 2.0, k: 8.0 };
    /// let state = OscillatorState { x: 1.0, x_dot: 0.5 };
    /// let (rates, a, b) = oscillator.linearized(0.0, &state, &OscillatorInput { push: 2.0 });
    /// assert_eq!(rates, OscillatorState { x: 0.5, x_dot: -3.0 });
    /// assert_eq!((a, b), ([[0.0, 1.0], [-4.0, 0.0]], [[0.0], [0.5]]));
    /// ```
    #[inline]
    fn linearized(
        &self,
        t: ScalarOf<Self>,
        state: &Self::State,
        input: &Self::Input,
    ) -> (Self::State, MatOf<Self>, RowsByInput<Self>) {
        (
            self.derivative(t, state, input),
            self.state_jacobian(t, state, input),
            self.input_jacobian(t, state, input),
        )
    }

    /// The derivative, by rows, of one step of the return to position constraints
    /// ([`correct_positions`](Dynamics::correct_positions)), by which steps of methods are differentiated that end with it:
    /// at a state where they hold, what it makes of a displacement keeps them. Systems with position constraints are
    /// declared with `emit { jacobian, return_jacobian }` for it, and give NaN without; others give 1.
    ///
    /// ```
    /// use nonholonomic::prelude::*;
    ///
    /// /// A weight on a rope.
    /// #[nonholonomic(
    ///     base       { x, y }
    ///     lagrangian { m / 2 * (der(x)^2 + der(y)^2) - m * g * y }
    ///     holonomic  { rope: x^2 + y^2 = l^2; }
    ///     emit       { jacobian, return_jacobian }
    /// )]
    /// #[derive(Clone, Copy, Debug)]
    /// struct Pendulum { m: f64, g: f64, l: f64 }
    ///
    /// let pendulum = Pendulum { m: 1.0, g: 9.81, l: 1.0 };
    /// let hanging = PendulumState { x: 0.0, y: -1.0, ..Default::default() };
    /// // aside is along the circle, and upwards is not
    /// let slopes = pendulum.return_jacobian(0.0, &hanging);
    /// assert_eq!((slopes[0][0], slopes[1][1]), (1.0, 0.0));
    /// ```
    fn return_jacobian(&self, t: ScalarOf<Self>, state: &Self::State) -> MatOf<Self> {
        let _ = (t, state);
        let zero = ScalarOf::<Self>::ZERO;
        let other = if self.has_positions() { ScalarOf::<Self>::from_f64(f64::NAN) } else { zero };
        let mut rows = DimOf::<Self>::mat(other);
        for (i, row) in rows.as_mut().iter_mut().enumerate() {
            if let Some(own) = row.as_mut().get_mut(i) {
                *own = other + ScalarOf::<Self>::ONE;
            }
        }
        rows
    }

    /// Whether component `row` of ẋ may depend on component `column` of the state: where this is false, A has a zero there
    /// at every state. Generated code knows its zeros; products with A leave them out, at no cost where loops over the
    /// components are unrolled.
    ///
    /// ```
    /// use nonholonomic::prelude::*;
    ///
    /// /// A mass on a spring.
    /// #[nonholonomic(base { x } lagrangian { m / 2 * der(x)^2 - k / 2 * x^2 } emit { jacobian })]
    /// #[derive(Clone, Copy, Debug)]
    /// struct Oscillator { m: f64, k: f64 }
    ///
    /// // ẋ is a velocity, which depends on the position alone
    /// let depends = [0, 1].map(|row| [0, 1].map(|column| Oscillator::state_depends(row, column)));
    /// assert_eq!(depends, [[false, true], [true, false]]);
    /// ```
    #[inline]
    #[must_use]
    fn state_depends(row: usize, column: usize) -> bool {
        let _ = (row, column);
        true
    }
}

/// In row i, the derivatives of component i of ẋ by the inputs of a system: what [`Jacobian::input_jacobian`] returns.
pub type RowsByInput<S> = <DimOf<S> as Dim>::Vec<<<S as Jacobian>::InputDim as Dim>::Vec<ScalarOf<S>>>;

/// A system with the recurrences of the Taylor coefficients of its solutions.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no Taylor coefficients",
    label = "needs the trait `TaylorSeries`",
    note = "add `emit {{ taylor }}` to its declaration, or implement `TaylorSeries` by hand"
)]
pub trait TaylorSeries: Dynamics {
    /// What an expansion keeps from order to order, with room for `P` coefficients.
    type Workspace<const P: usize>: Copy + Default;

    /// Fills `series` with the first coefficients of the solution through `state` at `t` with a constant
    /// input, x(t + τ) = Σ x_k (τ/unit)ᵏ; `P` at most.
    ///
    /// A unit near the length of the step keeps the coefficients in the range of the numbers, however
    /// fast or slow the motion is. The workspace may come from an earlier expansion.
    fn expand<const P: usize>(
        &self,
        t: ScalarOf<Self>,
        state: &Self::State,
        input: &Self::Input,
        unit: ScalarOf<Self>,
        series: &mut [Self::State],
        workspace: &mut Self::Workspace<P>,
    );

    /// The first `P` coefficients in powers of the time: x(t + τ) = Σ x_k τᵏ.
    #[inline]
    fn taylor<const P: usize>(
        &self,
        t: ScalarOf<Self>,
        state: &Self::State,
        input: &Self::Input,
    ) -> [Self::State; P] {
        let mut series = [*state; P];
        self.expand::<P>(t, state, input, Scalar::ONE, &mut series, &mut Self::Workspace::default());
        series
    }
}

/// A system whose state has to satisfy equations that a numerical solution drifts away from: the
/// identities of embedded coordinates, and the constraints of the projected formulation.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no equations that its state has to satisfy",
    label = "needs the trait `Constrained`",
    note = "add `formulation {{ projected }}` to its declaration, which keeps all velocities in the state, or integrate it without `Projected`"
)]
pub trait Constrained: Dynamics {
    /// The number of equations: `D<M>`.
    type Constraints: Dim;

    /// φ(t, x), which is zero where the state belongs: the identities first, then the constraints.
    fn constraint_residual(
        &self,
        t: ScalarOf<Self>,
        state: &Self::State,
    ) -> <Self::Constraints as Dim>::Vec<ScalarOf<Self>>;

    /// What the equations are called in the declaration, in the same order: an identity as it is written there, a
    /// constraint by its name. Empty where they have none.
    #[must_use]
    fn constraint_names() -> <Self::Constraints as Dim>::Vec<&'static str> {
        Self::Constraints::vec("")
    }

    /// Moves the state to where it belongs: embedded coordinates by the shortest way, and then the
    /// velocities along the kinetic energy's orthogonal complement of the constraint distribution.
    ///
    /// That is meant for states that are nearly right. From one that is as far away as the manifold is curved, which has several
    /// ways back, it leads to some point of it, or none, and that need not be the nearest one: the distance tells.
    ///
    /// # Errors
    /// If the manifold is not reached, in lanes by any of them; the state is then as it was, in all of them.
    fn project(&self, t: ScalarOf<Self>, state: &mut Self::State) -> Result<(), ProjectionError>;
}
