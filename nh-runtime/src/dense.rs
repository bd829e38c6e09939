//! The state between the ends of a step.

use core::fmt;

use crate::arrays::{Array, first_non_finite};
use crate::methods::{Arrival, Method, Start, component};
use crate::{Dynamics, IntegrationError, Integrator, Real, Scalar, ScalarOf, State};

/// The states within the last step of an integration: see [`Integrator::dense`].
pub struct DenseOutput<'a, S: Dynamics, M: Method<S>> {
    method: &'a M,
    /// The step as the method took it, with what it has prepared; none before the first step.
    step: Option<(Start<'a, S>, Arrival<S>, M::Dense)>,
    /// The state that the integration stands at.
    here: Arrival<S>,
    /// Whether states are returned to position constraints.
    returns: bool,
}

impl<S: Dynamics, M: Method<S>> fmt::Debug for DenseOutput<'_, S, M>
where
    S::State: fmt::Debug,
{
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let from = self.step.as_ref().map(|(start, ..)| start);
        f.debug_struct("DenseOutput").field("from", &from).field("here", &self.here).finish_non_exhaustive()
    }
}

impl<'a, S: Dynamics, M: Method<S>> DenseOutput<'a, S, M>
where
    ScalarOf<S>: Real,
{
    pub(crate) fn new(sim: &'a Integrator<S, M>) -> Self {
        let (method, memory) = sim.recollection();
        let step = sim.last_step().map(|(start, arrival)| {
            let dense = method.dense(memory, &start, &arrival);
            (start, arrival, dense)
        });
        let here = Arrival { time: sim.time(), state: *sim.state() };
        Self { method, step, here, returns: sim.is_returned() }
    }

    /// The state at a time within the step.
    ///
    /// # Errors
    /// As [`Integrator::at`].
    pub fn at(&self, time: ScalarOf<S>) -> Result<S::State, IntegrationError> {
        let to = self.here.time;
        if time == to {
            return Ok(self.here.state);
        }
        let from = self.step.as_ref().map_or(to, |(start, ..)| start.time);
        let within = (from <= time && time <= to) || (to <= time && time <= from);
        let (true, Some((start, arrival, dense))) = (within, &self.step) else {
            let (time, from, to) = (time.to_f64(), from.to_f64(), to.to_f64());
            return Err(IntegrationError::OutsideLastStep { time, from, to });
        };
        if time == from {
            return Ok(*start.state);
        }
        let mut state = self.method.interpolate(dense, start, arrival, time);
        if let Some(found) = first_non_finite(state.to_array().as_ref()) {
            let (index, value) = found;
            let component = component::<S::State>(index);
            return Err(IntegrationError::NonFiniteWithin { component, time: time.to_f64(), value });
        }
        if self.returns {
            let returned = start.system.return_to_positions(time, &mut state);
            returned.map_err(|error| IntegrationError::Projection { time: time.to_f64(), error })?;
        }
        Ok(state)
    }
}

/// The cubic with given values and derivatives at both ends, at the fraction s of the step:
/// (1−s) x₀ + s x₁ + s (s−1) ((1−2s)(x₁−x₀) + (s−1) h f₀ + s h f₁)
/// (Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I, II.6 eq. (6.7)).
pub(crate) fn hermite<T: Scalar, V: Array<T>>((x0, f0): (&V, &V), (x1, f1): (&V, &V), h: T, s: T) -> V {
    let rest = T::ONE - s;
    let bend = -(s * rest);
    let slope = rest - s;
    let mut x = *x0;
    let ends = x1.as_ref().iter().zip(f0.as_ref().iter().zip(f1.as_ref()));
    for (x, (&x1, (&f0, &f1))) in x.as_mut().iter_mut().zip(ends) {
        let change = x1 - *x;
        *x = *x + s * change + bend * (slope * change - rest * h * f0 + s * h * f1);
    }
    x
}

#[cfg(test)]
mod tests {
    use super::hermite;

    #[test]
    fn cubics_are_reproduced() {
        let x = |t: f64| 2.0 - t + 3.0 * t * t - 0.5 * t * t * t;
        let f = |t: f64| -1.0 + 6.0 * t - 1.5 * t * t;
        let (t0, h) = (0.3, 1.7);
        for s in [0.0, 0.25, 0.6, 1.0] {
            let [at] = hermite((&[x(t0)], &[f(t0)]), (&[x(t0 + h)], &[f(t0 + h)]), h, s);
            assert!((at - x(t0 + s * h)).abs() < 1e-14);
        }
    }
}
