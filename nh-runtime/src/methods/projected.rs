//! Any method, with a return to the constraint manifold every few steps.

use core::cell::Cell;

use super::{Arrival, Method, Place, Return, Returned, Start, Step, ToPositions, component};
use crate::arrays::difference;
use crate::projection::largest;
use crate::tolerance::{Tolerance, norm};
use crate::{
    Constrained, Dim, DimOf, Dynamics, IntegrationError, ProjectionError, Real, Scalar, ScalarOf, State,
    Statistics, VecOf,
};

/// A method whose state is projected back to the constraint manifold after every few steps.
///
/// In the projected formulation the constraints are invariants of the equations, as the identities of
/// embedded coordinates are in every one, and a numerical solution drifts off them by the method's
/// error (Hairer, Lubich, Wanner, Geometric Numerical
/// Integration, section IV.4). The projection keeps the order of the method. It changes the
/// state at the end of a step and nothing before it, and makes the method drop what it has stored of that state alone;
/// dense output leads to the corrected state. [`Statistics`] say how often that happened and how much it changed.
///
/// States within a step, those of events among them, are on the constraints always. Where the end of a step is not projected
/// the motion therefore jumps there by its drift, and a [`Trajectory`](crate::Trajectory), which goes on from states within a
/// step to its end, is kept of methods that project after each.
///
/// Of a method that chooses its steps, the drift counts as error: a step that makes the correction larger by more than
/// the tolerance, in the norm of that, is rejected and repeated shorter, as is one whose projection is due and does not
/// find back. So that this is known of every step, how a projection would move its end is computed also where none is due.
/// Steps of fixed length are not judged, as there is nothing to compare with, nor are those of a
/// [`Conserving`](crate::Conserving) method: any correction is made there, and [`Statistics::largest_correction`] tells of
/// it.
///
/// A start that a return to the constraints would move by more than the method's tolerance in some component,
/// or √ε of the state's size where steps are fixed, is refused: [`IntegrationError::InconsistentStart`]. Call the
/// system's own [`project`](Constrained::project) on it first, where that is what is meant.
///
/// ```
/// # use nonholonomic::prelude::*;
/// # use nonholonomic::{D, ProjectionError};
/// # struct Circle;
/// # #[derive(Clone, Copy)] struct Point { x: f64, y: f64 }
/// # impl State for Point {
/// #     type Scalar = f64;
/// #     type Dim = D<2>;
/// #     fn to_array(&self) -> [f64; 2] { [self.x, self.y] }
/// #     fn from_array([x, y]: [f64; 2]) -> Self { Self { x, y } }
/// #     fn names() -> [&'static str; 2] { ["x", "y"] }
/// # }
/// # impl Dynamics for Circle {
/// #     type State = Point;
/// #     type Input = ();
/// #     fn derivative(&self, _t: f64, s: &Point, (): &()) -> Point { Point { x: -s.y, y: s.x } }
/// # }
/// # impl Constrained for Circle {
/// #     type Constraints = D<1>;
/// #     fn constraint_residual(&self, _t: f64, s: &Point) -> [f64; 1] { [s.x * s.x + s.y * s.y - 1.0] }
/// #     fn project(&self, _t: f64, s: &mut Point) -> Result<(), ProjectionError> {
/// #         let r = s.x.hypot(s.y);
/// #         *s = Point { x: s.x / r, y: s.y / r };
/// #         Ok(())
/// #     }
/// # }
/// # fn main() -> Result<(), IntegrationError> {
/// // a point that circles the origin, back on the circle after every tenth step
/// let method = Projected::new(Rk4::new(0.1), 10);
/// let mut sim = Integrator::new(Circle, method, 0.0, Point { x: 1.0, y: 0.0 });
/// sim.advance_to(100.0)?;
/// assert!((sim.state().x.hypot(sim.state().y) - 1.0).abs() < 1e-15);
/// assert_eq!(sim.statistics().projections, 100);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projected<M> {
    method: M,
    every: u32,
}

impl<M> Projected<M> {
    /// The method with a projection after every `every` steps; 1 for one after each.
    #[must_use]
    pub fn new(method: M, every: u32) -> Self {
        Self { method, every }
    }

    /// The method without the projection.
    #[must_use]
    pub fn method(&self) -> &M {
        &self.method
    }
}

/// What the method remembers, and the steps since the last projection.
#[derive(Clone, Copy)]
pub struct Memory<M, X> {
    method: M,
    steps: u32,
    /// Whether the start has been found on the constraints.
    started: bool,
    /// How a projection would move the state at the end of the last step.
    drift: X,
}

/// What the end of a step is returned by: to where it belongs otherwise, and where it is `due` by a projection.
struct Drifted<'a, S: Dynamics, R> {
    /// How a projection would move the start.
    from: &'a VecOf<S>,
    is_due: bool,
    first: Option<&'a R>,
    /// How a projection has moved the end, or would move it.
    to: Cell<VecOf<S>>,
    returned: Cell<Option<Returned<S>>>,
}

impl<S: Constrained, R: Return<S>> Return<S> for Drifted<'_, S, R> {
    fn state(&self, system: &S, t: ScalarOf<S>, state: &mut S::State) -> Result<Returned<S>, ProjectionError>
    where
        ScalarOf<S>: Real,
    {
        Returned::of(system, state, |state| {
            let returned = self.first.map(|first| first.state(system, t, state)).transpose()?;
            self.returned.set(returned);
            let otherwise = returned.map_or(ScalarOf::<S>::ZERO, |returned| returned.residual);
            let before = *state;
            let mut moved = before;
            let projected = system.project(t, &mut moved);
            // where a state that is not moved has no way back, nothing is known of its drift
            let to = projected.map_or(*self.from, |()| difference(&moved.to_array(), &before.to_array()));
            self.to.set(to);
            if !self.is_due {
                return Ok(otherwise);
            }
            projected?;
            *state = moved;
            Ok(largest::<ScalarOf<S>>(system.constraint_residual(t, &before).as_ref()).max(otherwise))
        })
    }

    fn error<W: Tolerance<S::State>>(
        &self,
        tolerance: &W,
        _returned: &Returned<S>,
        start: &S::State,
        end: &VecOf<S>,
    ) -> ScalarOf<S>
    where
        ScalarOf<S>: Real,
    {
        let size = |drift| norm(tolerance, drift, &start.to_array(), end);
        let added = size(&self.to.get()) - size(self.from);
        match (self.first, self.returned.get()) {
            (Some(first), Some(returned)) => added.max(first.error(tolerance, &returned, start, end)),
            _ => added,
        }
    }
}

impl<S: Constrained, M: Method<S>> Method<S> for Projected<M>
where
    ScalarOf<S>: Real,
{
    type Memory = Memory<M::Memory, VecOf<S>>;

    handed_on!(
        forget {}
        restart { started = false }
        keeps_positions { |this| this.method.keeps_positions() }
        // what events and samples are given satisfies the constraints, as projected ends of steps do, or is nothing
        interpolated { |start, time, state| {
            match start.system.project(time, &mut state) {
                Ok(()) => state,
                Err(_) => S::State::from_array(DimOf::<S>::vec(ScalarOf::<S>::from_f64(f64::NAN))),
            }
        } }
    );

    fn memory(&self) -> Self::Memory {
        Memory {
            method: self.method.memory(),
            steps: 0,
            started: false,
            drift: DimOf::<S>::vec(ScalarOf::<S>::ZERO),
        }
    }

    fn check(&self) -> Result<(), IntegrationError> {
        self.method.check()?;
        if self.every > 0 {
            return Ok(());
        }
        Err(IntegrationError::Setting {
            setting: "every",
            value: f64::from(self.every),
            expected: "at least 1, the number of steps from one projection to the next",
        })
    }

    #[inline]
    fn advance(
        &self,
        start: &Start<'_, S>,
        target: Option<ScalarOf<S>>,
        memory: &mut Self::Memory,
        statistics: &mut Statistics,
    ) -> Result<Arrival<S>, IntegrationError> {
        let projections = statistics.projections;
        let (arrival, returned) = self.take(start, target, None::<&ToPositions>, memory, statistics)?;
        if let Some(returned) = returned
            && statistics.projections > projections
        {
            statistics.last_residual = returned.residual.to_f64();
            statistics.largest_correction = statistics.largest_correction.max(returned.correction().to_f64());
        }
        Ok(arrival)
    }

    fn advance_and_return<R: Return<S>>(
        &self,
        start: &Start<'_, S>,
        target: Option<ScalarOf<S>>,
        by: &R,
        memory: &mut Self::Memory,
        statistics: &mut Statistics,
    ) -> Result<Step<S>, IntegrationError> {
        self.take(start, target, Some(by), memory, statistics)
    }

    #[inline]
    fn travel(
        &self,
        system: &S,
        input: &S::Input,
        place: &mut Place<S>,
        (target, limit): (ScalarOf<S>, u64),
        memory: &mut Self::Memory,
        statistics: &mut Statistics,
    ) -> Result<u64, IntegrationError> {
        self.begin(&Start { system, input, time: place.time, state: &place.state }, memory)?;
        let mut done = 0;
        while place.time != target && done < limit {
            // all steps to the next projection but its own, if nothing has to be known of each
            let free = if self.method.judges() { 0 } else { self.every - 1 - memory.steps };
            let free = u64::from(free).min(limit - done);
            let leg = (target, free);
            let before = statistics.steps;
            let taken = self.method.travel(system, input, place, leg, &mut memory.method, statistics);
            // counted where a run is interrupted, too; no more than `every`, which is of this type
            memory.steps += u32::try_from(statistics.steps - before).unwrap_or(0);
            done += taken?;
            if place.time != target && done < limit {
                let start = Start { system, input, time: place.time, state: &place.state };
                let arrival = self.advance(&start, Some(target), memory, statistics)?;
                place.move_to(arrival);
                statistics.steps += 1;
                done += 1;
            }
        }
        Ok(done)
    }
}

impl<M> Projected<M> {
    /// Looks at a new start.
    #[inline]
    fn begin<S: Constrained>(
        &self,
        start: &Start<'_, S>,
        memory: &mut Memory<M::Memory, VecOf<S>>,
    ) -> Result<(), IntegrationError>
    where
        M: Method<S>,
        ScalarOf<S>: Real,
    {
        if !memory.started {
            memory.drift = self.admit(start)?;
            memory.started = true;
        }
        Ok(())
    }

    /// Takes a step, and returns its end to where it belongs otherwise, and to the constraints where that is due.
    #[inline]
    fn take<S: Constrained, R: Return<S>>(
        &self,
        start: &Start<'_, S>,
        target: Option<ScalarOf<S>>,
        first: Option<&R>,
        memory: &mut Memory<M::Memory, VecOf<S>>,
        statistics: &mut Statistics,
    ) -> Result<Step<S>, IntegrationError>
    where
        M: Method<S>,
        ScalarOf<S>: Real,
    {
        self.begin(start, memory)?;
        let from = memory.drift;
        let is_due = memory.steps + 1 >= self.every;
        let by = Drifted { from: &from, is_due, first, to: Cell::new(from), returned: Cell::new(None) };
        let (mut arrival, mut returned) =
            self.method.advance_and_return(start, target, &by, &mut memory.method, statistics)?;
        if !is_due {
            // a method that does not judge has returned nothing, and leaves that to the caller
            memory.drift = by.to.get();
            memory.steps += 1;
            return Ok((arrival, returned));
        }
        if returned.is_none() {
            let found = by.state(start.system, arrival.time, &mut arrival.state);
            if !found.as_ref().is_ok_and(|found| !found.is_moved) {
                // the state at the end is not the one that the method has led to
                self.method.moved(&mut memory.method);
            }
            let time = arrival.time.to_f64();
            returned = Some(found.map_err(|error| IntegrationError::Projection { time, error })?);
        }
        statistics.projections += 1;
        memory.steps = 0;
        memory.drift = DimOf::<S>::vec(ScalarOf::<S>::ZERO);
        Ok((arrival, returned))
    }

    /// Refuses a start that a projection would move by more than is permitted, and says how it would move it.
    #[cold]
    fn admit<S: Constrained>(&self, start: &Start<'_, S>) -> Result<VecOf<S>, IntegrationError>
    where
        M: Method<S>,
        ScalarOf<S>: Real,
    {
        let residuals = start.system.constraint_residual(start.time, start.state);
        let sizes = residuals.as_ref().iter().map(|residual| residual.abs()).enumerate();
        let worse = |a: (usize, ScalarOf<S>), b: (usize, ScalarOf<S>)| {
            if b.1 > a.1 || !b.1.is_finite() { b } else { a }
        };
        let (constraint, residual) = sizes.fold((0, ScalarOf::<S>::ZERO), worse);
        if residual == ScalarOf::<S>::ZERO {
            return Ok(DimOf::<S>::vec(ScalarOf::<S>::ZERO));
        }
        let mut moved = *start.state;
        start
            .system
            .project(start.time, &mut moved)
            .map_err(|error| IntegrationError::Projection { time: start.time.to_f64(), error })?;
        let (before, after) = (start.state.to_array(), moved.to_array());
        let permitted = self.method.permitted(start.state);
        let pairs = before.as_ref().iter().zip(after.as_ref()).zip(permitted.as_ref());
        for (index, ((before, after), permitted)) in pairs.enumerate() {
            let correction = (*after - *before).abs();
            // what is not a number is beyond it, too
            if !permitted.all_ge(correction) {
                return Err(IntegrationError::InconsistentStart {
                    constraint,
                    name: S::constraint_names().as_ref().get(constraint).copied().unwrap_or_default(),
                    residual: residual.to_f64(),
                    component: component::<S::State>(index),
                    correction: correction.to_f64(),
                });
            }
        }
        Ok(difference(&after, &before))
    }
}
