//! An explicit method where the equations allow it, an implicit one where they are stiff.

use super::adaptive::{Adaptive, Memory as Remembered};
use super::power_iteration::largest_rate;
use super::trial::Scheme;
use super::{Arrival, Method, Radau, Return, Start, Step, ToPositions, Tsitouras5};
use crate::methods::FiniteDifferences;
use crate::tolerance::{Tolerance, Uniform};
use crate::{Dim, DimOf, Dynamics, IntegrationError, Real, ScalarOf, State, Statistics, VecOf};

/// An adaptive method that begins explicitly, goes on implicitly where that is held back by stability, and comes back where
/// it no longer is.
///
/// Stiffness is noticed as the explicit method does it ([`Statistics::stiff_at`]), or by steps that become too
/// short. While the implicit method steps, the largest eigenvalue is estimated after every fifth of them, by three
/// evaluations and two steps of power iteration; once three estimates in a row leave steps half as long as
/// stability permits, the explicit method goes on. Both keep the same tolerances if they are set here.
/// [`Statistics::switches`] counts the changes.
///
/// ```
/// use nonholonomic::prelude::*;
/// use nonholonomic::methods::Auto;
///
/// // a wheel on a motor with a current of its own, which settles in ten microseconds
/// #[nonholonomic(
///     base       { angle }
///     lagrangian { J / 2 * der(angle)^2 }
///     auxiliary  { der(current) = (volts - k * der(angle) - R * current) / L; }
///     forces     { angle: k * current; }
///     inputs     { volts }
///     assume     { J > 0; L > 0; }
/// )]
/// #[derive(Clone, Copy, Debug)]
/// struct Motor { J: f64, k: f64, R: f64, L: f64 }
///
/// # fn main() -> Result<(), IntegrationError> {
/// let motor = Motor { J: 0.01, k: 0.1, R: 1.0, L: 1e-5 };
/// let mut sim = Integrator::new(motor, Auto::new().rtol(1e-6), 0.0, MotorState::default());
/// sim.set_input(MotorInput { volts: 12.0 });
/// sim.advance_to(5.0)?;
/// assert!((sim.state().angle_dot - 120.0 * (1.0 - (-5.0_f64).exp())).abs() < 1e-2);
/// // explicitly it would be 150 000 steps
/// assert!(sim.statistics().steps < 500);
/// # Ok(())
/// # }
/// ```
#[doc(alias("LSODA", "switching", "stiffness"))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Auto<T, W = Uniform<T>, P = Tsitouras5, Q = Radau<FiniteDifferences>> {
    explicit: Adaptive<P, T, W>,
    implicit: Adaptive<Q, T, W>,
}

impl<T: Real> Auto<T> {
    /// [`Tsit5`](crate::Tsit5) and [`Radau5`](crate::Radau5) with the default tolerances.
    #[must_use]
    pub fn new() -> Self {
        Self::of(Adaptive::new(), Adaptive::new())
    }
}

impl<T: Real> Default for Auto<T> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T: Real, W, P, Q> Auto<T, W, P, Q> {
    /// These two, each with its own settings: the dense output and the tolerance of the run are those of the one that steps.
    /// [`Bs23`](crate::Bs23) does not notice stiffness but by steps that are too short.
    #[must_use]
    pub fn of(explicit: Adaptive<P, T, W>, implicit: Adaptive<Q, T, W>) -> Self {
        Self { explicit, implicit }
    }
}

impl<T: Real, P, Q> Auto<T, Uniform<T>, P, Q> {
    /// The relative tolerance of both.
    #[must_use]
    pub fn rtol(self, rtol: T) -> Self {
        Self { explicit: self.explicit.rtol(rtol), implicit: self.implicit.rtol(rtol) }
    }

    /// The absolute tolerance of both.
    #[must_use]
    pub fn atol(self, atol: T) -> Self {
        Self { explicit: self.explicit.atol(atol), implicit: self.implicit.atol(atol) }
    }
}

/// An estimate is made after so many implicit steps.
const EVERY: u32 = 5;
/// So many calm ones in a row lead back.
const CALM: u32 = 3;
/// And an explicit step may then be this share of what stability permits.
const SHARE: f64 = 0.5;

/// What the method remembers.
#[derive(Clone, Copy)]
pub struct Memory<V, A, B> {
    explicit: A,
    implicit: B,
    /// Which of the two takes the next step, and which took the last one.
    is_implicit: bool,
    was_implicit: bool,
    /// The implicit steps until the next estimate.
    steps_left: u32,
    /// The estimates in a row that were calm.
    calm: u32,
    /// The direction in which the derivative changes most, in units of the tolerance, its largest component 1.
    direction: V,
}

/// What the states within a step are computed from: by the method that took it.
#[derive(Clone, Copy)]
pub enum Dense<A, B> {
    /// The explicit one.
    Explicit(A),
    /// The implicit one.
    Implicit(B),
}

type MemoryOf<S, P, Q> = Memory<
    VecOf<S>,
    Remembered<ScalarOf<S>, <P as Scheme<S>>::Work>,
    Remembered<ScalarOf<S>, <Q as Scheme<S>>::Work>,
>;

impl<T, S, W, P, Q> Method<S> for Auto<T, W, P, Q>
where
    T: Real,
    S: Dynamics,
    S::State: State<Scalar = T>,
    W: Tolerance<S::State>,
    P: Scheme<S>,
    Q: Scheme<S>,
{
    type Memory = MemoryOf<S, P, Q>;
    type Dense = Dense<P::Dense, Q::Dense>;

    fn memory(&self) -> Self::Memory {
        Memory {
            explicit: Method::<S>::memory(&self.explicit),
            implicit: Method::<S>::memory(&self.implicit),
            is_implicit: false,
            was_implicit: false,
            steps_left: EVERY,
            calm: 0,
            direction: DimOf::<S>::vec(T::ONE),
        }
    }

    fn forget(&self, memory: &mut Self::Memory) {
        Method::<S>::forget(&self.explicit, &mut memory.explicit);
        Method::<S>::forget(&self.implicit, &mut memory.implicit);
    }

    fn restart(&self, memory: &mut Self::Memory) {
        Method::<S>::restart(&self.explicit, &mut memory.explicit);
        Method::<S>::restart(&self.implicit, &mut memory.implicit);
    }

    fn stand(&self, memory: &mut Self::Memory) {
        Method::<S>::stand(&self.explicit, &mut memory.explicit);
        Method::<S>::stand(&self.implicit, &mut memory.implicit);
    }

    fn moved(&self, memory: &mut Self::Memory) {
        Method::<S>::moved(&self.explicit, &mut memory.explicit);
        Method::<S>::moved(&self.implicit, &mut memory.implicit);
    }

    #[inline]
    fn judges(&self) -> bool {
        true
    }

    fn check(&self) -> Result<(), IntegrationError> {
        Method::<S>::check(&self.explicit)?;
        Method::<S>::check(&self.implicit)
    }

    fn permitted(&self, state: &S::State) -> VecOf<S> {
        Method::<S>::permitted(&self.explicit, state)
    }

    fn advance(
        &self,
        start: &Start<'_, S>,
        target: Option<T>,
        memory: &mut Self::Memory,
        statistics: &mut Statistics,
    ) -> Result<Arrival<S>, IntegrationError> {
        Ok(self.take::<false, S, _>(start, target, &ToPositions, memory, statistics)?.0)
    }

    fn advance_and_return<R: Return<S>>(
        &self,
        start: &Start<'_, S>,
        target: Option<T>,
        by: &R,
        memory: &mut Self::Memory,
        statistics: &mut Statistics,
    ) -> Result<Step<S>, IntegrationError> {
        self.take::<true, S, _>(start, target, by, memory, statistics)
    }

    fn dense(&self, memory: &Self::Memory, start: &Start<'_, S>, arrival: &Arrival<S>) -> Self::Dense {
        if memory.was_implicit {
            Dense::Implicit(self.implicit.dense(&memory.implicit, start, arrival))
        } else {
            Dense::Explicit(self.explicit.dense(&memory.explicit, start, arrival))
        }
    }

    fn interpolate(
        &self,
        dense: &Self::Dense,
        start: &Start<'_, S>,
        arrival: &Arrival<S>,
        time: T,
    ) -> S::State {
        match dense {
            Dense::Explicit(dense) => self.explicit.interpolate(dense, start, arrival, time),
            Dense::Implicit(dense) => self.implicit.interpolate(dense, start, arrival, time),
        }
    }
}

impl<T: Real, W, P, Q> Auto<T, W, P, Q> {
    /// Takes one step by the method that is at work, and returns its end `by` this if it is to.
    fn take<const RETURN: bool, S: Dynamics, R: Return<S>>(
        &self,
        start: &Start<'_, S>,
        target: Option<T>,
        by: &R,
        memory: &mut MemoryOf<S, P, Q>,
        statistics: &mut Statistics,
    ) -> Result<Step<S>, IntegrationError>
    where
        S::State: State<Scalar = T>,
        W: Tolerance<S::State>,
        P: Scheme<S>,
        Q: Scheme<S>,
    {
        if !memory.is_implicit {
            match self.explicit.take::<true, RETURN, S, R>(
                start,
                target,
                by,
                &mut memory.explicit,
                statistics,
            ) {
                Ok(step) => {
                    memory.was_implicit = false;
                    if memory.explicit.is_stiff() {
                        self.go_implicit::<S>(memory, statistics);
                    }
                    return Ok(step);
                }
                Err(IntegrationError::StepUnderflow { .. }) => self.go_implicit::<S>(memory, statistics),
                Err(error) => return Err(error),
            }
        }
        let step =
            self.implicit.take::<true, RETURN, S, R>(start, target, by, &mut memory.implicit, statistics)?;
        memory.was_implicit = true;
        memory.steps_left -= 1;
        if memory.steps_left == 0 {
            memory.steps_left = EVERY;
            self.look_back(start, &step.0, memory, statistics);
        }
        Ok(step)
    }

    /// The next steps are implicit, the first as long as an explicit one would be.
    fn go_implicit<S: Dynamics>(&self, memory: &mut MemoryOf<S, P, Q>, statistics: &mut Statistics)
    where
        S::State: State<Scalar = T>,
        W: Tolerance<S::State>,
        P: Scheme<S>,
        Q: Scheme<S>,
    {
        statistics.switches += 1;
        memory.is_implicit = true;
        memory.implicit = Method::<S>::memory(&self.implicit).proposing(memory.explicit.proposed());
        (memory.steps_left, memory.calm) = (EVERY, 0);
    }

    /// Estimates the largest eigenvalue at the end of an implicit step, and goes back to explicit ones where stability
    /// would hold these back no longer.
    #[cold]
    fn look_back<S: Dynamics>(
        &self,
        start: &Start<'_, S>,
        arrival: &Arrival<S>,
        memory: &mut MemoryOf<S, P, Q>,
        statistics: &mut Statistics,
    ) where
        S::State: State<Scalar = T>,
        W: Tolerance<S::State>,
        P: Scheme<S>,
        Q: Scheme<S>,
    {
        let Start { system, input, .. } = *start;
        let here = Start { system, input, time: arrival.time, state: &arrival.state };
        let rate = largest_rate(&here, &self.implicit.tolerance, &mut memory.direction, statistics);
        let length = (arrival.time - start.time).abs();
        let bound = T::from_f64(SHARE * P::HELD);
        memory.calm = if length * rate <= bound { memory.calm + 1 } else { 0 };
        if memory.calm >= CALM {
            statistics.switches += 1;
            memory.is_implicit = false;
            memory.explicit = Method::<S>::memory(&self.explicit).proposing(Some(length));
        }
    }
}
