//! Adaptive runs of many parameter sets and starts: every member with steps and errors of its own.
//!
//! Where [`batch`](crate::batch) takes the same steps for a whole group, in lanes, members here go each at
//! its own pace. They stand in a slice of the caller and stay in its order; a member that fails keeps its error and its last
//! good state, and the others go on. With the feature `rayon`, `par_advance_to` and `par_each` share the members out to
//! all cores one by one, as their runs may be of very different lengths; the results are those of [`advance_to`] and
//! [`each`], bit for bit. Nothing is allocated.
//!
//! ```
//! use nonholonomic::ensemble::{self, Member};
//! use nonholonomic::prelude::*;
//!
//! #[nonholonomic(
//!     base       { theta }
//!     lagrangian { m * l^2 / 2 * der(theta)^2 + m * g * l * cos(theta) }
//!     assume     { m > 0; l > 0; }
//! )]
//! #[derive(Clone, Copy, Debug)]
//! struct Pendulum { m: f64, l: f64, g: f64 }
//!
//! // the third has no length
//! let mut members = [0.5, 1.0, 0.0, 2.0].map(|l| {
//!     let start = PendulumState { theta: 0.1, theta_dot: 0.0 };
//!     Member::new(Integrator::new(Pendulum { m: 1.0, l, g: 9.81 }, Dopri5::new().rtol(1e-9), 0.0, start))
//! });
//! assert_eq!(ensemble::advance_to(&mut members, 1.0), 3);
//! // half a period of the second
//! assert!((members[1].state().theta + 0.1).abs() < 1e-4);
//! let error = members[2].outcome.expect_err("it is refused");
//! assert!(error.to_string().starts_with("the parameter `l` is 0.0"));
//! ```

use core::fmt;

use crate::methods::Method;
use crate::{Dynamics, IntegrationError, Integrator, Real, ScalarOf};

/// One run of many.
pub struct Member<S: Dynamics, M: Method<S>, E = IntegrationError> {
    /// The integration.
    pub sim: Integrator<S, M>,
    /// How its last run has ended. A member with an error is left where it is until that is replaced by `Ok(())`.
    pub outcome: Result<(), E>,
}

impl<S: Dynamics + Clone, M: Method<S> + Clone, E: Clone> Clone for Member<S, M, E> {
    fn clone(&self) -> Self {
        Self { sim: self.sim.clone(), outcome: self.outcome.clone() }
    }
}

impl<S: Dynamics, M: Method<S>, E: fmt::Debug> fmt::Debug for Member<S, M, E>
where
    S::State: fmt::Debug,
{
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Member").field("sim", &self.sim).field("outcome", &self.outcome).finish()
    }
}

impl<S: Dynamics, M: Method<S>, E> Member<S, M, E> {
    /// A run that has not begun.
    #[must_use]
    pub fn new(sim: Integrator<S, M>) -> Self {
        Self { sim, outcome: Ok(()) }
    }

    /// Its state now: the last good one.
    #[must_use]
    pub fn state(&self) -> &S::State {
        self.sim.state()
    }

    fn go_on(&mut self, run: impl FnOnce(&mut Integrator<S, M>) -> Result<(), E>) -> usize {
        if self.outcome.is_ok() {
            self.outcome = run(&mut self.sim);
        }
        usize::from(self.outcome.is_ok())
    }
}

/// Takes every member that is well to `target`, and gives the number of those that have arrived.
pub fn advance_to<S: Dynamics, M: Method<S>>(members: &mut [Member<S, M>], target: ScalarOf<S>) -> usize
where
    ScalarOf<S>: Real,
{
    each(members, |sim| sim.advance_to(target))
}

/// Calls `run` with the integration of every member that is well, with inputs and events as it likes, and gives the
/// number of those that are well afterwards.
pub fn each<S: Dynamics, M: Method<S>, E>(
    members: &mut [Member<S, M, E>],
    mut run: impl FnMut(&mut Integrator<S, M>) -> Result<(), E>,
) -> usize {
    members.iter_mut().map(|member| member.go_on(&mut run)).sum()
}

/// As [`advance_to`], on all cores.
#[cfg(feature = "rayon")]
#[doc(alias("parallel", "Monte Carlo"))]
pub fn par_advance_to<S: Dynamics, M: Method<S>>(members: &mut [Member<S, M>], target: ScalarOf<S>) -> usize
where
    ScalarOf<S>: Real + Sync,
    Member<S, M>: Send,
{
    par_each(members, |sim| sim.advance_to(target))
}

/// As [`each`], on all cores.
#[cfg(feature = "rayon")]
pub fn par_each<S: Dynamics, M: Method<S>, E>(
    members: &mut [Member<S, M, E>],
    run: impl Fn(&mut Integrator<S, M>) -> Result<(), E> + Sync + Send,
) -> usize
where
    Member<S, M, E>: Send,
{
    use rayon::iter::{IndexedParallelIterator, IntoParallelRefMutIterator, ParallelIterator};

    // one by one: a stiff or chaotic member may take a thousand times as long as its neighbour
    members.par_iter_mut().with_max_len(1).map(|member| member.go_on(&run)).sum()
}
