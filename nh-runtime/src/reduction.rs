//! Reductions between systems: the motion of one determines that of the other.

use core::fmt;
use core::marker::PhantomData;

use crate::error::{InputFault, ParameterError, ProjectionError, StateFault};
use crate::newton_return::worst;
use crate::{Dynamics, Scalar, ScalarOf};

/// A system whose motion is carried to that of `R` by a map that was proved to do so.
///
/// `morphism!` writes the implementation: the map is a morphism of Lie algebroids, onto on the
/// fibres, that relates the Lagrangians, the constraints and the forces (CLMM Theorems 4.6 and 7.8).
/// A solution of the system is mapped to a solution of `R`.
pub trait Reduction<R: Dynamics>: Dynamics {
    /// What was proved, and the map, as text.
    const REPORT: &'static str;

    /// The reduced system, with the parameters that belong to those of this one.
    fn reduced(&self) -> R;

    /// The state of the reduced system that belongs to a state.
    fn reduce(&self, t: ScalarOf<Self>, state: &Self::State) -> R::State;

    /// The input of the reduced system that belongs to an input at a state.
    fn reduce_input(&self, t: ScalarOf<Self>, state: &Self::State, input: &Self::Input) -> R::Input;
}

/// A reduction with a way back: what it drops follows from the reduced motion.
///
/// The dropped coordinates g obey ġ = f(t, g, reduced state), a quadrature where they are cyclic.
/// [`Reconstructed`] integrates them with the reduced motion.
pub trait Reconstruction<R: Dynamics>: Reduction<R> {
    /// The reduced state and the dropped coordinates: the fields `reduced` and `group`.
    type Joint: crate::State<Scalar = ScalarOf<Self>>;

    /// The reduced state and the dropped coordinates of a state.
    fn join(&self, t: ScalarOf<Self>, state: &Self::State) -> Self::Joint;

    /// The reduced part.
    fn reduced_part(joint: &Self::Joint) -> R::State;

    /// The rate of both, where the reduced state has the rate `reduced_rate`.
    fn joint_rate(&self, t: ScalarOf<Self>, joint: &Self::Joint, reduced_rate: &R::State) -> Self::Joint;

    /// The state that belongs to a reduced state and dropped coordinates.
    fn reconstruct(&self, t: ScalarOf<Self>, joint: &Self::Joint) -> Self::State;
}

/// The reduced motion with the coordinates that the reduction drops: a system that any method
/// integrates, and whose state gives that of the full one by [`full_state`](Self::full_state).
#[derive(Clone, Copy, Debug)]
pub struct Reconstructed<F, R> {
    full: F,
    reduced: R,
}

impl<R: Dynamics, F: Reconstruction<R>> Reconstructed<F, R> {
    /// With the reduction of `full`.
    pub fn new(full: F) -> Self {
        let reduced = full.reduced();
        Self { full, reduced }
    }

    /// The state to start from.
    pub fn start(&self, t: ScalarOf<F>, state: &F::State) -> F::Joint {
        self.full.join(t, state)
    }

    /// The state of the full system.
    pub fn full_state(&self, t: ScalarOf<F>, joint: &F::Joint) -> F::State {
        self.full.reconstruct(t, joint)
    }

    /// The full system.
    pub fn full(&self) -> &F {
        &self.full
    }

    /// The reduced system.
    pub fn reduced(&self) -> &R {
        &self.reduced
    }
}

impl<F, R> Dynamics for Reconstructed<F, R>
where
    R: Dynamics,
    F: Reconstruction<R>,
    R::State: crate::State<Scalar = ScalarOf<F>>,
{
    type State = F::Joint;
    type Input = R::Input;

    #[inline]
    fn derivative(&self, t: ScalarOf<F>, joint: &F::Joint, input: &R::Input) -> F::Joint {
        let rate = self.reduced.derivative(t, &F::reduced_part(joint), input);
        self.full.joint_rate(t, joint, &rate)
    }

    fn validate(&self) -> Result<(), ParameterError> {
        self.full.validate()?;
        self.reduced.validate()
    }

    fn check_state(&self, t: ScalarOf<F>, joint: &F::Joint) -> Result<(), StateFault> {
        self.reduced.check_state(t, &F::reduced_part(joint))?;
        self.full.check_state(t, &self.full.reconstruct(t, joint))
    }

    fn has_positions(&self) -> bool {
        self.full.has_positions() || self.reduced.has_positions()
    }

    fn return_to_positions(
        &self,
        t: ScalarOf<F>,
        joint: &mut F::Joint,
    ) -> Result<ScalarOf<F>, ProjectionError> {
        let mut state = self.full.reconstruct(t, joint);
        let residual = self.full.return_to_positions(t, &mut state)?;
        // what the full system meets by its choice of coordinates, the reduced state may have come off
        let of_reduced = self.reduced.return_to_positions(t, &mut F::reduced_part(joint))?;
        let residual = residual.max(of_reduced);
        // what holds keeps the digits that it has
        if residual != ScalarOf::<F>::ZERO {
            *joint = self.full.join(t, &state);
        }
        Ok(residual)
    }

    fn correct_positions(&self, t: ScalarOf<F>, joint: &mut F::Joint) {
        if self.has_positions() {
            let mut state = self.full.reconstruct(t, joint);
            self.full.correct_positions(t, &mut state);
            *joint = self.full.join(t, &state);
        }
    }

    fn side(&self, t: ScalarOf<F>, joint: &F::Joint) -> ScalarOf<F> {
        self.reduced.side(t, &F::reduced_part(joint))
    }

    fn worst_constraint(&self, t: ScalarOf<F>, joint: &F::Joint) -> StateFault {
        let of_full = self.full.worst_constraint(t, &self.full.reconstruct(t, joint));
        let of_reduced = self.reduced.worst_constraint(t, &F::reduced_part(joint));
        worst([of_full, of_reduced].map(|fault| (fault.identity, fault.residual)))
    }

    fn check_input(&self, input: &R::Input) -> Result<(), InputFault> {
        self.reduced.check_input(input)
    }
}

/// Reduction by stages: the composition of reductions to `B` and from there on is a reduction.
///
/// `ByStages::<_, B>::new(system)` is the system itself, with the reductions that `B` has.
pub struct ByStages<A, B> {
    system: A,
    stage: PhantomData<fn() -> B>,
}

impl<A, B> ByStages<A, B> {
    /// The system, whose reductions lead through `B`.
    pub const fn new(system: A) -> Self {
        Self { system, stage: PhantomData }
    }

    /// The system.
    pub const fn system(&self) -> &A {
        &self.system
    }
}

impl<A: Clone, B> Clone for ByStages<A, B> {
    fn clone(&self) -> Self {
        Self::new(self.system.clone())
    }
}

impl<A: fmt::Debug, B> fmt::Debug for ByStages<A, B> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("ByStages").field(&self.system).finish()
    }
}

impl<A, B, C> Reduction<C> for ByStages<A, B>
where
    A: Reduction<B>,
    B: Reduction<C>,
    B::State: crate::State<Scalar = ScalarOf<A>>,
    C: Dynamics,
{
    /// That of the last stage; those before have their own.
    const REPORT: &'static str = <B as Reduction<C>>::REPORT;

    fn reduced(&self) -> C {
        self.system.reduced().reduced()
    }

    fn reduce(&self, t: ScalarOf<A>, state: &A::State) -> C::State {
        let stage = self.system.reduced();
        stage.reduce(t, &self.system.reduce(t, state))
    }

    fn reduce_input(&self, t: ScalarOf<A>, state: &A::State, input: &A::Input) -> C::Input {
        let stage = self.system.reduced();
        let (between, control) = (self.system.reduce(t, state), self.system.reduce_input(t, state, input));
        stage.reduce_input(t, &between, &control)
    }
}
