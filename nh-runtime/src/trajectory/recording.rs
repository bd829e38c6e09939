//! From an integration to a motion that is kept.

use core::error::Error;
use core::fmt::{self, Display, Formatter};

use super::segment::{between, node};
use super::{Buffer, Segment, Trajectory};
use crate::integrator::Spent;
use crate::methods::{Method, component};
use crate::{Dynamics, IntegrationError, Integrator, Real, Scalar, ScalarOf, State};

/// Why a motion could not be kept. The integration stands at the end of what was.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum RecordingError {
    /// The integration itself stopped.
    Integration(IntegrationError),
    /// The buffer is full.
    Full {
        /// The time until which the motion is kept.
        time: f64,
        /// The steps that it has room for.
        segments: usize,
    },
    /// The run does not go on where the kept motion ends.
    Gap {
        /// The time at which the kept motion ends.
        end: f64,
        /// The time at which the run begins.
        start: f64,
    },
    /// The run goes backwards where the kept motion went forwards, or the other way round.
    Turn {
        /// The time at which it turns.
        time: f64,
    },
    /// The polynomial through the nodes is not what the dense output gives, to the tolerance of the method.
    TooFewNodes {
        /// The time at which the two were compared.
        time: f64,
        /// The component that differs.
        component: &'static str,
        /// By how much.
        difference: f64,
        /// By how much it may.
        permitted: f64,
        /// The nodes of a step.
        nodes: usize,
    },
}

impl Display for RecordingError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Integration(error) => error.fmt(f),
            Self::Full { time, segments } => write!(
                f,
                "the buffer of {segments} steps is full at t = {time:?}: give a longer one, a `Vec`, or go on into another"
            ),
            Self::Gap { end, start } => write!(
                f,
                "the kept motion ends at t = {end:?}, and the run begins at {start:?}: record all parts of a run, \
                 or keep each in a trajectory of its own"
            ),
            Self::Turn { time } => write!(
                f,
                "the run turns back at t = {time:?}, where a kept motion goes in one direction: keep the way back in \
                 a trajectory of its own"
            ),
            Self::TooFewNodes { time, component, difference, permitted, nodes } => write!(
                f,
                "the polynomial through {nodes} states of a step is {difference:?} away from the dense output in \
                 `{component}` at t = {time:?}, where the method's tolerance permits {permitted:?}: keep more states \
                 of each step, as in `Trajectory<_, _, {}>`, or, of a `Projected` method that does not, project after each step",
                nodes.saturating_mul(2)
            ),
        }
    }
}

impl Error for RecordingError {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        match self {
            Self::Integration(error) => Some(error),
            _ => None,
        }
    }
}

impl From<IntegrationError> for RecordingError {
    fn from(error: IntegrationError) -> Self {
        Self::Integration(error)
    }
}

impl<S: Dynamics, M: Method<S>> Integrator<S, M>
where
    ScalarOf<S>: Real,
{
    /// Takes steps to `target`, lands on it exactly, and keeps each of them.
    ///
    /// # Errors
    /// [`RecordingError`]: as [`advance_to`](Self::advance_to), and where a step cannot be kept. The integration stands at
    /// the end of the last step that was, so that the run can go on into another buffer.
    pub fn record<B, const P: usize>(
        &mut self,
        target: ScalarOf<S>,
        motion: &mut Trajectory<S::State, B, P>,
    ) -> Result<(), RecordingError>
    where
        B: Buffer<Segment<S::State, P>>,
    {
        self.admit_target(target)?;
        let mut spent = Spent::default();
        while self.time() != target {
            if !motion.has_room() {
                return Err(motion.full());
            }
            self.step_within(&mut spent, target)?;
            if let Err(error) = motion.keep_last_step(self) {
                self.take_back();
                return Err(error);
            }
        }
        Ok(())
    }
}

impl<X: State, B, const P: usize> Trajectory<X, B, P>
where
    X::Scalar: Real,
    B: Buffer<Segment<X, P>>,
{
    fn has_room(&self) -> bool {
        self.segments.has_room(self.len)
    }

    /// Keeps the last step of an integration, for loops of one's own around [`step`](Integrator::step) and
    /// [`step_towards`](Integrator::step_towards). Before the first step there is nothing to keep.
    /// [`record_acting`](Integrator::record_acting) keeps runs with events.
    ///
    /// # Errors
    /// As [`record`](Integrator::record); nothing is kept then.
    pub fn keep_last_step<S, M>(&mut self, sim: &Integrator<S, M>) -> Result<(), RecordingError>
    where
        S: Dynamics<State = X>,
        M: Method<S>,
    {
        let Some((start, _)) = sim.last_step() else { return Ok(()) };
        let (from, to) = (start.time, sim.time());
        if from == to {
            return Ok(());
        }
        let dense = sim.dense();
        let time = |s: X::Scalar| s.mul_add(to - from, from);
        let mut nodes = [*start.state; P];
        let interior = P.saturating_sub(1);
        for (index, state) in nodes.iter_mut().enumerate().take(interior).skip(1) {
            *state = dense.at(time(node::<X::Scalar, P>(index)))?;
        }
        if let Some(last) = nodes.last_mut() {
            *last = *sim.state();
        }
        let segment = Segment::new(from, to, nodes);
        // where the polynomials differ most: in the middle, and beside the ends
        for index in [0, interior / 2, interior.saturating_sub(1)] {
            let s = between::<X::Scalar, P>(index);
            agrees::<S, M, P>(sim, time(s), &segment, &dense.at(time(s))?)?;
        }
        self.keep(segment)
    }
}

/// Sixteen units in the last place of the largest state of the step, which interpolation may round by, and of what the
/// state changes by where times are rounded.
const ROUNDING: f64 = 16.0;

/// Whether the polynomial gives this state to the tolerance of the method, which a step may err by anyway.
fn agrees<S: Dynamics, M: Method<S>, const P: usize>(
    sim: &Integrator<S, M>,
    time: ScalarOf<S>,
    segment: &Segment<S::State, P>,
    state: &S::State,
) -> Result<(), RecordingError>
where
    ScalarOf<S>: Real,
{
    let Some(kept) = segment.at(time) else { return Ok(()) };
    // by what a component is at either end of the step, as its error is judged: where it passes zero less is permitted
    let mut permitted = sim.method().permitted(state);
    for end in [segment.first(), segment.last()] {
        let at_end = sim.method().permitted(&end);
        permitted.as_mut().iter_mut().zip(at_end.as_ref()).for_each(|(most, here)| *most = most.max(*here));
    }
    // how many roundings of the clock stand in a rounding of the step
    let (from, to) = (segment.from(), segment.to());
    let clock = from.abs().max(to.abs()) / (to - from).abs();
    let (kept, given) = (kept.to_array(), state.to_array());
    let compared = kept.as_ref().iter().zip(given.as_ref()).zip(permitted.as_ref());
    for (index, ((&kept, &given), &permitted)) in compared.enumerate() {
        let of_nodes = || {
            let of_node = |node: &S::State| node.to_array().as_ref().get(index).copied();
            segment.nodes().iter().filter_map(of_node)
        };
        let size = of_nodes().fold(ScalarOf::<S>::ZERO, |largest, x| largest.max(x.abs()));
        let change = of_nodes().fold(ScalarOf::<S>::ZERO, |most, x| most.max((x - given).abs()));
        let rounding = ScalarOf::<S>::from_f64(ROUNDING) * ScalarOf::<S>::EPSILON;
        let permitted = permitted + rounding * (size + change * clock);
        let difference = (kept - given).abs();
        if difference > permitted {
            return Err(RecordingError::TooFewNodes {
                time: time.to_f64(),
                component: component::<S::State>(index),
                difference: difference.to_f64(),
                permitted: permitted.to_f64(),
                nodes: P,
            });
        }
    }
    Ok(())
}
