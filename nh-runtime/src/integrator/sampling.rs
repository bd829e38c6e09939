//! States within steps, and stops on the way.

use super::{Integrator, Spent};
use crate::dense::DenseOutput;
use crate::methods::{Arrival, Method, Start};
use crate::{Dynamics, IntegrationError, Real, Scalar, ScalarOf};

impl<S: Dynamics, M: Method<S>> Integrator<S, M>
where
    ScalarOf<S>: Real,
{
    /// The state at a time within the last step (dense output).
    ///
    /// At the ends of the step it is exactly the state there; between them it is the method's
    /// continuous extension: of order 4 for `Dopri5`, 7 for `Dop853`, 9 for `Vern9`, and for simple methods the cubic
    /// Hermite interpolant, for which the derivatives at both ends are evaluated anew. The input is
    /// the one that acted during the step, whatever has been set since. Before the first step, and
    /// after a [`reset`](Self::reset), only the current time is within.
    ///
    /// # Errors
    /// [`IntegrationError::OutsideLastStep`], also for a time that is NaN;
    /// [`IntegrationError::NonFiniteDerivative`] if a derivative at an end is not finite.
    pub fn at(&self, time: ScalarOf<S>) -> Result<S::State, IntegrationError> {
        // the ends need no preparation
        if time == self.time {
            return Ok(self.state);
        }
        self.dense().at(time)
    }

    /// The states within the last step, as [`at`](Self::at) gives them, for many times: what the
    /// method needs for them is computed once.
    #[must_use]
    pub fn dense(&self) -> DenseOutput<'_, S, M> {
        DenseOutput::new(self)
    }

    /// Takes steps to each of these times in turn, lands on it exactly, and calls `visit` there, which
    /// may change the input or start anew. The times may go forwards and backwards.
    ///
    /// # Errors
    /// As [`advance_to`](Self::advance_to).
    pub fn advance_through(
        &mut self,
        stops: impl IntoIterator<Item = ScalarOf<S>>,
        mut visit: impl FnMut(&mut Self),
    ) -> Result<(), IntegrationError> {
        let mut spent = Spent::default();
        for stop in stops {
            self.travel(stop, &mut spent)?;
            visit(self);
        }
        Ok(())
    }

    /// Gives the states at these times, which follow one another in one direction, repeated or not, to `visit`. Unlike
    /// [`advance_through`](Self::advance_through), the steps go their own way, and the states within
    /// them come from the dense output; the last time is landed on.
    ///
    /// # Errors
    /// As [`advance_to`](Self::advance_to), and as [`at`](Self::at) within steps; before anything moves, [`IntegrationError::UnorderedTimes`] for a time that goes
    /// back, and [`IntegrationError::OutsideLastStep`] where the way to the last time does not lead by the first.
    pub fn sample(
        &mut self,
        times: impl IntoIterator<Item = ScalarOf<S>, IntoIter: Clone>,
        mut visit: impl FnMut(ScalarOf<S>, &S::State),
    ) -> Result<(), IntegrationError> {
        let times = times.into_iter();
        let Some(last) = times.clone().last() else { return Ok(()) };
        self.follow_one_another(times.clone(), last)?;
        let mut times = times.peekable();
        let mut spent = Spent::default();
        loop {
            let dense = self.dense();
            while let Some(&time) = times.peek() {
                match dense.at(time) {
                    Ok(state) => visit(time, &state),
                    // a step has yet to come to it
                    Err(IntegrationError::OutsideLastStep { .. }) => break,
                    Err(error) => return Err(error),
                }
                times.next();
            }
            if self.time == last {
                // a time that has been passed already
                return times.next().map_or(Ok(()), |time| dense.at(time).map(|_| ()));
            }
            self.step_within(&mut spent, last)?;
        }
    }

    /// Whether times go in one direction, and the way from here to the last of them leads by the first.
    fn follow_one_another(
        &self,
        mut times: impl Iterator<Item = ScalarOf<S>> + Clone,
        last: ScalarOf<S>,
    ) -> Result<(), IntegrationError> {
        if let Some(time) = times.clone().find(|time| !time.is_finite()) {
            return Err(IntegrationError::NonFiniteTime { time: time.to_f64() });
        }
        let Some(first) = times.next() else { return Ok(()) };
        let goes_back = |before, time| if first <= last { time < before } else { time > before };
        let mut before = first;
        for time in times {
            if goes_back(before, time) {
                let [time, before, last] = [time, before, last].map(|time: ScalarOf<S>| time.to_f64());
                return Err(IntegrationError::UnorderedTimes { time, before, last });
            }
            before = time;
        }
        let leads_by = if first < last { first >= self.time } else { first <= self.time };
        if first != last && !leads_by { self.dense().at(first).map(|_| ()) } else { Ok(()) }
    }

    /// Cuts the last step at a time and state within it.
    pub(crate) fn stand_at(&mut self, time: ScalarOf<S>, state: S::State) {
        if time != self.time {
            self.beyond = Some(Arrival { time: self.time, state: self.state });
            self.time = time;
            self.state = state;
            self.method.stand(&mut self.memory);
        }
    }

    /// Takes the last step back.
    pub(crate) fn take_back(&mut self) {
        if let Some(origin) = self.origin.take() {
            self.time = origin.time;
            self.state = origin.state;
            self.method.stand(&mut self.memory);
        }
    }

    /// The last step: where it came from and with which input, and where the method has led it.
    pub(crate) fn last_step(&self) -> Option<(Start<'_, S>, Arrival<S>)> {
        let origin = self.origin.as_ref()?;
        let start =
            Start { system: &self.system, input: &origin.input, time: origin.time, state: &origin.state };
        let here = Arrival { time: self.time, state: self.state };
        Some((start, self.beyond.unwrap_or(here)))
    }

    /// The method with its memory.
    pub(crate) fn recollection(&self) -> (&M, &M::Memory) {
        (&self.method, &self.memory)
    }
}
