//! Motions that are kept: the states of a whole run, at any time of it.

mod buffer;
mod recording;
mod segment;
#[cfg(feature = "serde")]
mod stored;

pub use buffer::Buffer;
pub use recording::RecordingError;
pub use segment::Segment;

use core::fmt;

use crate::{Real, Scalar, State};

/// A motion, kept as one polynomial for every step, in a buffer of the caller.
///
/// It knows neither system nor method: it can outlive both, be sent, and with the feature `serde` be stored and read.
/// [`Integrator::record`](crate::Integrator::record) fills it. The states at the ends of steps are those of the
/// integration, bit for bit; between them each component is the polynomial through `P` states that the dense output
/// gave at Chebyshev's points of the step. With the eight that it has if nothing is said, that is the dense output
/// of every method of cubic, quartic or seventh degree ([`Dopri5`](crate::Dopri5), [`Dop853`](crate::Dop853),
/// [`Radau5`](crate::Radau5), all of fixed step) up to rounding, and of the others as far as their tolerance asks;
/// where `P` states are too few for that, recording says so.
///
/// A buffer is an array, a slice or a `Vec` of [`Segment`]s, or whatever implements [`Buffer`].
///
/// ```
/// use nonholonomic::prelude::*;
/// use nonholonomic::{Segment, Trajectory};
/// # use nonholonomic::D;
/// # struct Spring;
/// # #[derive(Clone, Copy, Debug, PartialEq)] struct SpringState { x: f64, v: f64 }
/// # impl State for SpringState {
/// #     type Scalar = f64;
/// #     type Dim = D<2>;
/// #     fn to_array(&self) -> [f64; 2] { [self.x, self.v] }
/// #     fn from_array([x, v]: [f64; 2]) -> Self { Self { x, v } }
/// #     fn names() -> [&'static str; 2] { ["x", "v"] }
/// # }
/// # impl Dynamics for Spring {
/// #     type State = SpringState;
/// #     type Input = ();
/// #     fn derivative(&self, _t: f64, s: &SpringState, (): &()) -> SpringState { SpringState { x: s.v, v: -s.x } }
/// # }
/// # fn main() -> Result<(), nonholonomic::RecordingError> {
/// let start = SpringState { x: 1.0, v: 0.0 };
/// let mut sim = Integrator::new(Spring, Dopri5::new().rtol(1e-9), 0.0, start);
/// // room for a hundred steps on the stack
/// let mut motion: Trajectory<SpringState, _> = Trajectory::new([Segment::default(); 100]);
/// sim.record(6.0, &mut motion)?;
/// assert_eq!(motion.at(0.0), Some(start));
/// assert_eq!(motion.at(6.0), Some(*sim.state()));
/// let between = motion.at(2.5).expect("within the run");
/// assert!((between.x - 2.5_f64.cos()).abs() < 1e-7);
/// assert_eq!(motion.at(6.1), None);
/// // the ends of the steps, for a plot of where they were
/// assert_eq!(motion.knots().count(), motion.len() + 1);
/// # Ok(())
/// # }
/// ```
///
/// A run may be recorded in parts, with other inputs, events and jumps between: each part begins when the last one
/// ended. Where the state jumps, [`at`](Self::at) gives the state after the jump.
#[doc(alias("solution", "dense output", "interpolation"))]
#[derive(Clone, Copy)]
pub struct Trajectory<X: State, B, const P: usize = 8> {
    segments: B,
    len: usize,
    state: core::marker::PhantomData<X>,
}

impl<X: State, B, const P: usize> fmt::Debug for Trajectory<X, B, P>
where
    X::Scalar: Real,
    B: Buffer<Segment<X, P>>,
{
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Trajectory")
            .field("segments", &self.len)
            .field("start", &self.start())
            .field("end", &self.end())
            .finish()
    }
}

impl<X: State, B, const P: usize> Trajectory<X, B, P>
where
    X::Scalar: Real,
    B: Buffer<Segment<X, P>>,
{
    /// No motion yet, with room for as many steps as the buffer has. What is in the buffer is overwritten.
    #[must_use]
    pub fn new(buffer: B) -> Self {
        const { assert!(P >= 2, "a polynomial that meets both ends of a step has at least two states") };
        Self { segments: buffer, len: 0, state: core::marker::PhantomData }
    }

    /// The steps that are kept.
    #[must_use]
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether nothing is kept.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// Drops what is kept.
    pub fn clear(&mut self) {
        self.len = 0;
    }

    /// The buffer.
    #[must_use]
    pub fn into_buffer(self) -> B {
        self.segments
    }

    /// The steps, in the order in which they were taken.
    #[must_use]
    pub fn segments(&self) -> &[Segment<X, P>] {
        self.segments.items().get(..self.len).unwrap_or_default()
    }

    /// The time at which the motion begins.
    #[must_use]
    pub fn start(&self) -> Option<X::Scalar> {
        self.segments().first().map(Segment::from)
    }

    /// The time at which it ends, which is the earlier one if the run went backwards.
    #[must_use]
    pub fn end(&self) -> Option<X::Scalar> {
        self.segments().last().map(Segment::to)
    }

    /// The state at a time of the run; none for a time outside of it, or if that is NaN.
    ///
    /// The step is found by bisection. On an embedded base, and where position constraints hold, the states at the ends
    /// of steps are on it to rounding, those between to the tolerance of the method: `normalize` and `project` of the
    /// system return them.
    #[must_use]
    pub fn at(&self, time: X::Scalar) -> Option<X> {
        let segments = self.segments();
        let is_backwards = segments.first().is_some_and(|first| first.to() < first.from());
        let ended =
            segments.partition_point(
                |segment| {
                    if is_backwards { segment.to() >= time } else { segment.to() <= time }
                },
            );
        match segments.get(ended) {
            Some(segment) => segment.at(time),
            None => segments.last().and_then(|segment| segment.at(time)),
        }
    }

    /// The times and states at the ends of the steps: the start, then the end of every step, and where the state jumps
    /// between two steps both states.
    pub fn knots(&self) -> impl Iterator<Item = (X::Scalar, X)> + '_ {
        let segments = self.segments();
        segments.iter().enumerate().flat_map(move |(index, segment)| {
            let before = index.checked_sub(1).and_then(|before| segments.get(before));
            let goes_on = before.is_some_and(|before| before.meets(segment));
            let start = (!goes_on).then(|| (segment.from(), segment.first()));
            start.into_iter().chain(core::iter::once((segment.to(), segment.last())))
        })
    }

    /// Keeps one more step.
    fn keep(&mut self, segment: Segment<X, P>) -> Result<(), RecordingError> {
        let (from, to) = (segment.from(), segment.to());
        if let Some(end) = self.end()
            && end != from
        {
            return Err(RecordingError::Gap { end: end.to_f64(), start: from.to_f64() });
        }
        if let Some(first) = self.segments().first()
            && (first.from() < first.to()) != (from < to)
        {
            return Err(RecordingError::Turn { time: from.to_f64() });
        }
        if self.segments.put(self.len, segment) {
            self.len += 1;
            Ok(())
        } else {
            Err(self.full())
        }
    }

    fn full(&self) -> RecordingError {
        let time = self.end().map_or(f64::NAN, Scalar::to_f64);
        RecordingError::Full { time, segments: self.len }
    }
}
