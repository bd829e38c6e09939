//! What holds a system is that system: references, prepared systems, systems with angles at hand, reductions by stages.
//!
//! Everything but the derivative is handed through in one place, so that no holder forgets a part: one that did not hand
//! on the return to position constraints would drift off them without a word.

use crate::discrete_lagrangian::DiscreteLagrangian;
use crate::dynamics::{
    AlmostPoisson, Constrained, Dynamics, Energy, EulerPoincareSuslov, Invariants, Jacobian, Leapfrog,
    Observed, TaylorSeries,
};
use crate::error::{InputFault, ParameterError, ProjectionError, StateFault};
use crate::held::{Held, Holding};
use crate::linear_model::FirstOrder;
use crate::reduction::ByStages;
use crate::{AngleCache, AngleCached, Dim, MatOf, Prepare, Prepared, RowsByInput, ScalarOf, VecOf};

/// All traits of a system for what holds one: the type of the system first, with what is asked of it.
macro_rules! holders {
    ($(
        [$s:ident $(, $other:ident)*: $($bound:tt)*] $holder:ty, |$this:ident| $system:expr,
        |$t:ident, $state:ident, $input:ident| $derivative:expr;
    )*) => {$(
        impl<$s: Dynamics + $($bound)*, $($other),*> Dynamics for $holder {
            type State = $s::State;
            type Input = $s::Input;

            #[inline]
            fn derivative(&self, $t: ScalarOf<$s>, $state: &$s::State, $input: &$s::Input) -> $s::State {
                let $this = self;
                $derivative
            }
            #[inline]
            fn validate(&self) -> Result<(), ParameterError> {
                let $this = self;
                $system.validate()
            }
            #[inline]
            fn check_state(&self, t: ScalarOf<$s>, state: &$s::State) -> Result<(), StateFault> {
                let $this = self;
                $system.check_state(t, state)
            }
            #[inline]
            fn has_positions(&self) -> bool {
                let $this = self;
                $system.has_positions()
            }
            #[inline]
            fn return_to_positions(
                &self,
                t: ScalarOf<$s>,
                state: &mut $s::State,
            ) -> Result<ScalarOf<$s>, ProjectionError> {
                let $this = self;
                $system.return_to_positions(t, state)
            }
            #[inline]
            fn correction(&self, before: &$s::State, after: &$s::State) -> VecOf<$s> {
                let $this = self;
                $system.correction(before, after)
            }
            #[inline]
            fn correct_positions(&self, t: ScalarOf<$s>, state: &mut $s::State) {
                let $this = self;
                $system.correct_positions(t, state);
            }
            #[inline]
            fn side(&self, t: ScalarOf<$s>, state: &$s::State) -> ScalarOf<$s> {
                let $this = self;
                $system.side(t, state)
            }
            fn worst_constraint(&self, t: ScalarOf<$s>, state: &$s::State) -> StateFault {
                let $this = self;
                $system.worst_constraint(t, state)
            }
            #[inline]
            fn check_input(&self, input: &$s::Input) -> Result<(), InputFault> {
                let $this = self;
                $system.check_input(input)
            }
        }

        impl<$s: Energy + $($bound)*, $($other),*> Energy for $holder {
            #[inline]
            fn energy(&self, t: ScalarOf<$s>, state: &$s::State) -> ScalarOf<$s> {
                let $this = self;
                $system.energy(t, state)
            }
        }

        impl<$s: AlmostPoisson + $($bound)*, $($other),*> AlmostPoisson for $holder {
            #[inline]
            fn energy_gradient(&self, t: ScalarOf<$s>, state: &$s::State) -> VecOf<$s> {
                let $this = self;
                $system.energy_gradient(t, state)
            }
            #[inline]
            fn almost_poisson(&self, t: ScalarOf<$s>, state: &$s::State, covector: &VecOf<$s>) -> VecOf<$s> {
                let $this = self;
                $system.almost_poisson(t, state, covector)
            }

            const HOLDS: bool = $s::HOLDS;

            #[inline]
            fn held_equations(&self, t: ScalarOf<$s>, state: &$s::State) -> Held<$s::State> {
                let $this = self;
                $system.held_equations(t, state)
            }
            #[inline]
            fn residuals(&self, t: ScalarOf<$s>, state: &$s::State) -> VecOf<$s> {
                let $this = self;
                $system.residuals(t, state)
            }
        }

        impl<$s: Holding + $($bound)*, $($other),*> Holding for $holder {
            #[inline]
            fn held(&self, t: ScalarOf<$s>, state: &$s::State) -> Held<$s::State> {
                let $this = self;
                $system.held(t, state)
            }
            #[inline]
            fn equations(&self, t: ScalarOf<$s>, state: &$s::State) -> VecOf<$s> {
                let $this = self;
                $system.equations(t, state)
            }
        }

        impl<$s: Invariants + $($bound)*, $($other),*> Invariants for $holder {
            type Count = $s::Count;

            #[inline]
            fn invariants(&self, t: ScalarOf<$s>, state: &$s::State) -> <$s::Count as Dim>::Vec<ScalarOf<$s>> {
                let $this = self;
                $system.invariants(t, state)
            }
            #[inline]
            fn invariant_gradients(
                &self,
                t: ScalarOf<$s>,
                state: &$s::State,
            ) -> <$s::Count as Dim>::Vec<VecOf<$s>> {
                let $this = self;
                $system.invariant_gradients(t, state)
            }
        }

        impl<$s: Leapfrog + $($bound)*, $($other),*> Leapfrog for $holder {
            #[inline]
            fn kick(&self, state: &$s::State, h: ScalarOf<$s>) -> $s::State {
                let $this = self;
                $system.kick(state, h)
            }
        }

        impl<$s: DiscreteLagrangian + $($bound)*, $($other),*> DiscreteLagrangian for $holder {
            #[inline]
            fn lagrangian_slopes(&self, state: &$s::State) -> VecOf<$s> {
                let $this = self;
                $system.lagrangian_slopes(state)
            }
            #[inline]
            fn position_constraints(&self, state: &$s::State) -> VecOf<$s> {
                let $this = self;
                $system.position_constraints(state)
            }
            #[inline]
            fn constrained(&self, state: &$s::State, given: &VecOf<$s>) -> VecOf<$s> {
                let $this = self;
                $system.constrained(state, given)
            }
        }

        impl<$s: EulerPoincareSuslov + $($bound)*, $($other),*> EulerPoincareSuslov for $holder {
            #[inline]
            fn discrete_momentum(&self, state: &$s::State, h: ScalarOf<$s>) -> VecOf<$s> {
                let $this = self;
                $system.discrete_momentum(state, h)
            }
        }

        impl<$s: Observed + $($bound)*, $($other),*> Observed for $holder {
            type Outputs = $s::Outputs;

            #[inline]
            fn outputs(&self, t: ScalarOf<$s>, state: &$s::State, input: &$s::Input) -> $s::Outputs {
                let $this = self;
                $system.outputs(t, state, input)
            }
        }

        impl<$s: Jacobian + $($bound)*, $($other),*> Jacobian for $holder {
            type InputDim = $s::InputDim;

            #[inline]
            fn state_jacobian(&self, t: ScalarOf<$s>, state: &$s::State, input: &$s::Input) -> MatOf<$s> {
                let $this = self;
                $system.state_jacobian(t, state, input)
            }
            #[inline]
            fn input_jacobian(
                &self,
                t: ScalarOf<$s>,
                state: &$s::State,
                input: &$s::Input,
            ) -> RowsByInput<$s> {
                let $this = self;
                $system.input_jacobian(t, state, input)
            }
            #[inline]
            fn linearized(
                &self,
                t: ScalarOf<$s>,
                state: &$s::State,
                input: &$s::Input,
            ) -> ($s::State, MatOf<$s>, RowsByInput<$s>) {
                let $this = self;
                $system.linearized(t, state, input)
            }
            #[inline]
            fn return_jacobian(&self, t: ScalarOf<$s>, state: &$s::State) -> MatOf<$s> {
                let $this = self;
                $system.return_jacobian(t, state)
            }
            #[inline]
            fn state_depends(row: usize, column: usize) -> bool {
                $s::state_depends(row, column)
            }
        }

        impl<$s: TaylorSeries + $($bound)*, $($other),*> TaylorSeries for $holder {
            type Workspace<const P: usize> = $s::Workspace<P>;

            #[inline]
            fn expand<const P: usize>(
                &self,
                t: ScalarOf<$s>,
                state: &$s::State,
                input: &$s::Input,
                unit: ScalarOf<$s>,
                series: &mut [$s::State],
                workspace: &mut $s::Workspace<P>,
            ) {
                let $this = self;
                $system.expand(t, state, input, unit, series, workspace);
            }
        }

        impl<$s: Constrained + $($bound)*, $($other),*> Constrained for $holder {
            type Constraints = $s::Constraints;

            #[inline]
            fn constraint_residual(
                &self,
                t: ScalarOf<$s>,
                state: &$s::State,
            ) -> <$s::Constraints as Dim>::Vec<ScalarOf<$s>> {
                let $this = self;
                $system.constraint_residual(t, state)
            }
            fn constraint_names() -> <$s::Constraints as Dim>::Vec<&'static str> {
                $s::constraint_names()
            }
            #[inline]
            fn project(&self, t: ScalarOf<$s>, state: &mut $s::State) -> Result<(), ProjectionError> {
                let $this = self;
                $system.project(t, state)
            }
        }

        impl<$s: FirstOrder + $($bound)*, $($other),*> FirstOrder for $holder {
            type Residuals = $s::Residuals;
            type Parts = $s::Parts;

            fn first_order(&self, t: ScalarOf<$s>, state: &$s::State, input: &$s::Input) -> $s::Parts {
                let $this = self;
                $system.first_order(t, state, input)
            }
            fn residuals(&self, t: ScalarOf<$s>, state: &$s::State, input: &$s::Input) -> $s::Residuals {
                let $this = self;
                $system.residuals(t, state, input)
            }
        }
    )*};
}

holders! {
    [S: ?Sized] &S, |this| (**this), |t, state, input| (**this).derivative(t, state, input);
    [A, B: Sized] ByStages<A, B>, |this| this.system(), |t, state, input| this.system().derivative(t, state, input);
    [S: Prepare] Prepared<S>, |this| this.system(), |t, state, input| this.system().derivative_from(this.ahead(), t, state, input);
    [S: AngleCache] AngleCached<S>, |this| this.system(), |t, state, input| this.derivative_near(t, state, input);
}
