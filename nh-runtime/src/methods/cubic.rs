//! Dense output of methods of fixed step: the cubic through both ends of a step, with the derivatives there.

use super::{Arrival, Start};
use crate::dense::hermite;
use crate::{Dynamics, Real, ScalarOf, State, VecOf};

/// The derivatives at both ends of a step.
#[derive(Clone, Copy)]
pub struct Slopes<V> {
    first: V,
    last: V,
}

/// Evaluates the derivatives at both ends of the step.
pub(super) fn slopes<S: Dynamics>(start: &Start<'_, S>, arrival: &Arrival<S>) -> Slopes<VecOf<S>> {
    Slopes { first: start.derivative(), last: start.derivative_at(arrival.time, arrival.state.to_array()) }
}

/// The cubic at an instant.
pub(super) fn interpolate<S: Dynamics>(
    Slopes { first, last }: &Slopes<VecOf<S>>,
    start: &Start<'_, S>,
    arrival: &Arrival<S>,
    time: ScalarOf<S>,
) -> S::State
where
    ScalarOf<S>: Real,
{
    let x1 = arrival.state.to_array();
    let length = arrival.time - start.time;
    let fraction = (time - start.time) / length;
    S::State::from_array(hermite((&start.state.to_array(), first), (&x1, last), length, fraction))
}

/// The dense output of a [`OneStep`](super::OneStep) over a system `S` by that cubic.
macro_rules! dense_by_cubic {
    () => {
        type Dense = $crate::methods::cubic::Slopes<VecOf<S>>;

        fn dense(&self, _work: &Self::Work, start: &Start<'_, S>, arrival: &Arrival<S>) -> Self::Dense {
            $crate::methods::cubic::slopes(start, arrival)
        }

        fn interpolate(
            &self,
            dense: &Self::Dense,
            start: &Start<'_, S>,
            arrival: &Arrival<S>,
            time: ScalarOf<S>,
        ) -> S::State {
            $crate::methods::cubic::interpolate(dense, start, arrival, time)
        }
    };
}
