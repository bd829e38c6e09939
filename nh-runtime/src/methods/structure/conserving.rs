//! Any method, with a return to the level of the stated invariants after every step.

use crate::arrays::displaced;
use crate::linear::Factors;
use crate::methods::{Arrival, Method, Start};
use crate::{
    Dim, IntegrationError, Invariants, ProjectionError, Real, Scalar, ScalarOf, State, Statistics, VecOf,
};

/// A method whose state is moved, after every step, to the nearest point where the stated first
/// integrals have the values that they had at the first state (Hairer, Lubich, Wanner, Geometric
/// Numerical Integration, section IV.4). For systems with `conserved { … }` and `emit { invariants }`.
///
/// The invariants stay to round-off and the order of the method stays; a symmetric method does not stay
/// symmetric. The integrals have to be independent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conserving<M> {
    method: M,
}

impl<M> Conserving<M> {
    /// The method with a return to the invariants after every step.
    #[must_use]
    pub fn new(method: M) -> Self {
        Self { method }
    }
}

/// The numbers of a system's invariants.
type Values<S> = <<S as Invariants>::Count as Dim>::Vec<ScalarOf<S>>;

/// What the method remembers, and the values of the invariants at the first state.
pub struct Memory<S: Invariants, K> {
    method: K,
    values: Option<Values<S>>,
}

impl<S: Invariants, K: Copy> Clone for Memory<S, K> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<S: Invariants, K: Copy> Copy for Memory<S, K> {}

/// The iterations after which the level is given up.
const MOST_ITERATIONS: u32 = 12;

impl<S: Invariants, M: Method<S>> Method<S> for Conserving<M>
where
    ScalarOf<S>: Real,
{
    type Memory = Memory<S, M::Memory>;
    type Dense = M::Dense;

    fn memory(&self) -> Self::Memory {
        Memory { method: self.method.memory(), values: None }
    }

    fn forget(&self, memory: &mut Self::Memory) {
        self.method.forget(&mut memory.method);
        memory.values = None;
    }

    fn check(&self) -> Result<(), IntegrationError> {
        self.method.check()
    }

    fn advance(
        &self,
        start: &Start<'_, S>,
        target: Option<ScalarOf<S>>,
        memory: &mut Self::Memory,
        statistics: &mut Statistics,
    ) -> Result<Arrival<S>, IntegrationError> {
        let values = memory.values.unwrap_or_else(|| start.system.invariants(start.time, start.state));
        let mut arrival = self.method.advance(start, target, &mut memory.method, statistics)?;
        arrival.state = returned(start.system, &arrival, &values)
            .map_err(|error| IntegrationError::Projection { time: arrival.time.to_f64(), error })?;
        statistics.projections += 1;
        self.method.forget(&mut memory.method);
        memory.values = Some(values);
        Ok(arrival)
    }

    fn dense(&self, memory: &Self::Memory, start: &Start<'_, S>, arrival: &Arrival<S>) -> M::Dense {
        self.method.dense(&memory.method, start, arrival)
    }

    fn interpolate(
        &self,
        dense: &M::Dense,
        start: &Start<'_, S>,
        arrival: &Arrival<S>,
        time: ScalarOf<S>,
    ) -> S::State {
        self.method.interpolate(dense, start, arrival, time)
    }
}

/// The point with these values: x − Gᵀ (G Gᵀ)⁻¹ (c(x) − c₀) until it stagnates.
fn returned<S: Invariants>(
    system: &S,
    arrival: &Arrival<S>,
    values: &Values<S>,
) -> Result<S::State, ProjectionError>
where
    ScalarOf<S>: Real,
{
    let mut x = arrival.state.to_array();
    let mut best = ScalarOf::<S>::EPSILON.recip();
    for iteration in 0..MOST_ITERATIONS {
        let state = S::State::from_array(x);
        let mut defect = system.invariants(arrival.time, &state);
        for (defect, value) in defect.as_mut().iter_mut().zip(values.as_ref()) {
            *defect -= *value;
        }
        // at rest the gradients may vanish, and there is nothing to do
        if defect.as_ref().iter().all(|defect| *defect == ScalarOf::<S>::ZERO) {
            return Ok(state);
        }
        let gradients = system.invariant_gradients(arrival.time, &state);
        let mut gram = <S::Count as Dim>::mat(ScalarOf::<S>::ZERO);
        for (row, first) in gram.as_mut().iter_mut().zip(gradients.as_ref()) {
            for (entry, second) in row.as_mut().iter_mut().zip(gradients.as_ref()) {
                *entry = dot::<S>(first, second);
            }
        }
        let weights = Factors::<S::Count, ScalarOf<S>>::new(&gram).solve(&defect);
        let mut largest = ScalarOf::<S>::ZERO;
        for (gradient, weight) in gradients.as_ref().iter().zip(weights.as_ref()) {
            for slope in gradient.as_ref() {
                largest = largest.max((*slope * *weight).abs());
            }
            x = displaced(&x, -*weight, gradient);
        }
        let residual = defect.as_ref().iter().fold(ScalarOf::<S>::ZERO, |most, d| most.max(d.abs()));
        if !largest.is_finite() {
            return Err(ProjectionError { iterations: iteration + 1, residual: residual.to_f64() });
        }
        if largest == ScalarOf::<S>::ZERO || largest >= best * ScalarOf::<S>::from_f64(0.5) {
            return Ok(S::State::from_array(x));
        }
        best = largest;
    }
    Ok(S::State::from_array(x))
}

fn dot<S: Invariants>(a: &VecOf<S>, b: &VecOf<S>) -> ScalarOf<S> {
    a.as_ref().iter().zip(b.as_ref()).fold(ScalarOf::<S>::ZERO, |sum, (a, b)| sum + *a * *b)
}
