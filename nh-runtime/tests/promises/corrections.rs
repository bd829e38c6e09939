//! Corrections: where a method chooses its steps, none of them ends farther from where its end belongs than the tolerance
//! says.

use nonholonomic::methods::Interruptible;
use nonholonomic::prelude::*;
use nonholonomic::{D, Method, ProjectionError, TaylorSeries};

use crate::systems::{Contact, contact, start};

/// A place x and a height y, which the equations leave as it is and the constraint does not.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Height<T>([T; 2]);

impl<T: Real> State for Height<T> {
    type Scalar = T;
    type Dim = D<2>;
    fn to_array(&self) -> [T; 2] {
        self.0
    }
    fn from_array(x: [T; 2]) -> Self {
        Self(x)
    }
    fn names() -> [&'static str; 2] {
        ["x", "y"]
    }
}

/// The height that the constraint asks for.
#[derive(Clone, Copy, Debug)]
enum Course {
    /// 0 at t = 0, and 1/2 at all other times.
    Jump,
    /// t, as far as one step drifts from the next.
    Slope,
    /// 0 at t = 0, and nowhere at all other times.
    Nowhere,
}

/// x′ = 1, y′ = 0, and a constraint of y: that of a projection, or a position constraint.
#[derive(Clone, Copy, Debug)]
struct Off {
    course: Course,
    has_positions: bool,
}

impl Off {
    fn height<T: Real>(self, t: T) -> Result<T, ProjectionError> {
        match self.course {
            _ if t == T::ZERO => Ok(T::ZERO),
            Course::Jump => Ok(T::from_f64(0.5)),
            Course::Slope => Ok(t),
            Course::Nowhere => Err(ProjectionError { iterations: 7, residual: 0.5 }),
        }
    }

    fn go<T: Real>(self, t: T, state: &mut Height<T>) -> Result<T, ProjectionError> {
        let height = self.height(t)?;
        let residual = (height - state.0[1]).abs();
        state.0[1] = height;
        Ok(residual)
    }
}

/// The system with numbers of a kind.
#[derive(Clone, Copy, Debug)]
struct With<T>(Off, core::marker::PhantomData<T>);

impl<T: Real> Dynamics for With<T> {
    type State = Height<T>;
    type Input = ();
    fn derivative(&self, _t: T, _state: &Height<T>, (): &()) -> Height<T> {
        Height([T::ONE, T::ZERO])
    }
    fn has_positions(&self) -> bool {
        self.0.has_positions
    }
    fn return_to_positions(&self, t: T, state: &mut Height<T>) -> Result<T, ProjectionError> {
        self.0.go(t, state)
    }
}

impl<T: Real> Constrained for With<T> {
    type Constraints = D<1>;
    fn constraint_residual(&self, t: T, state: &Height<T>) -> [T; 1] {
        if self.0.has_positions {
            return [T::ZERO];
        }
        [self.0.height(t).map_or(T::ONE, |height| state.0[1] - height)]
    }
    fn project(&self, t: T, state: &mut Height<T>) -> Result<(), ProjectionError> {
        if self.0.has_positions {
            return Ok(());
        }
        self.0.go(t, state).map(|_| ())
    }
}

impl<T: Real> TaylorSeries for With<T> {
    type Workspace<const P: usize> = ();
    fn expand<const P: usize>(
        &self,
        _t: T,
        state: &Height<T>,
        (): &(),
        unit: T,
        series: &mut [Height<T>],
        (): &mut (),
    ) {
        series.fill(Height([T::ZERO; 2]));
        series[0] = *state;
        series[1] = Height([unit, T::ZERO]);
    }
}

/// Calls `law(name, method)` with the methods that choose their steps, at a tolerance.
macro_rules! each {
    ($law:expr, $rtol:expr) => {{
        let rtol = $rtol;
        macro_rules! call {
            ($method:expr) => {
                $law(stringify!($method), $method)
            };
        }
        call!(Bs23::new().rtol(rtol));
        call!(Dopri5::new().rtol(rtol));
        call!(Tsit5::new().rtol(rtol));
        call!(Dop853::new().rtol(rtol));
        call!(Vern9::new().rtol(rtol));
        call!(Taylor::new().rtol(rtol));
        call!(Radau5::new().rtol(rtol));
        call!(Rodas5P::new().rtol(rtol));
        call!(Auto::new().rtol(rtol));
        call!(Interruptible::new(Dopri5::new().rtol(rtol), |_: &Statistics| true));
    }};
}

/// Runs to t = `end`, and gives how that ended, when, and at what cost.
fn run<T: Real, M: Method<With<T>>>(
    (course, has_positions): (Course, bool),
    method: M,
    end: f64,
) -> (Result<(), IntegrationError>, f64, Statistics) {
    let system = With(Off { course, has_positions }, core::marker::PhantomData);
    let mut sim = Integrator::new(system, method, T::ZERO, Height([T::ZERO; 2]));
    let ended = sim.advance_to(T::from_f64(end));
    (ended, sim.time().to_f64(), sim.statistics())
}

/// A correction that no step is short enough for, and one that is not found.
fn refused<T: Real>(name: &str, method: impl Method<With<T>> + Clone) {
    for course in [Course::Jump, Course::Nowhere] {
        let check =
            |name: &str, (ended, time, statistics): (Result<(), IntegrationError>, f64, Statistics)| {
                let is_told = match course {
                    Course::Nowhere => matches!(ended, Err(IntegrationError::Projection { .. })),
                    _ => matches!(ended, Err(IntegrationError::StepUnderflow { error, .. }) if error > 1.0),
                };
                assert!(is_told && time < 1.0, "{name}, {course:?}: {ended:?} at {time}");
                assert!(statistics.largest_correction == 0.0, "{name}, {course:?}: {statistics:?}");
                assert!((1..1000).contains(&statistics.rejected), "{name}, {course:?}: {statistics:?}");
            };
        for every in [1, 3] {
            let projected = Projected::new(method.clone(), every);
            check(&format!("{name}, every {every}"), run((course, false), projected, 1.0));
        }
        let within = Projected::new(Interruptible::new(method.clone(), |_: &Statistics| true), 1);
        check(name, run((course, false), within, 1.0));
        check(name, run((course, true), method.clone(), 1.0));
        for every in [1, 3] {
            check(name, run((course, true), Projected::new(method.clone(), every), 1.0));
        }
    }
}

/// A drift that shorter steps keep below the tolerance is kept there, step by step.
fn bounded<T: Real>(name: &str, method: impl Method<With<T>> + Clone, tolerance: f64) {
    let end = 20.0 * tolerance;
    // of two components one is off, by less than the root of two where their mean square is 1
    let most = |every: u32| 1.01 * 2.0_f64.sqrt() * f64::from(every) * tolerance;
    let check = |every: u32, (ended, _, statistics): (Result<(), IntegrationError>, f64, Statistics)| {
        let largest = statistics.largest_correction;
        ended.unwrap_or_else(|error| panic!("{name}, every {every}: {error}"));
        assert!(largest > 0.0 && largest < most(every), "{name}, every {every}: {largest:e}");
    };
    for every in [1, 3] {
        check(every, run((Course::Slope, false), Projected::new(method.clone(), every), end));
        check(every, run((Course::Slope, true), Projected::new(method.clone(), every), end));
    }
    check(1, run((Course::Slope, true), method, end));
}

/// Where there is nothing but the drift of the method itself, steps stay as they are.
fn undisturbed<T: Real>(name: &str, method: impl Method<Contact<T>> + Clone) {
    let cost = |statistics: Statistics| statistics.steps + statistics.rejected;
    let mut free = Integrator::new(contact(), method.clone(), T::ZERO, start()).max_steps(10_000_000);
    free.advance_to(T::from_f64(30.0)).unwrap_or_else(|error| panic!("{name}: {error}"));
    for every in [1, 2, 10, 100] {
        let projected = Projected::new(method.clone(), every);
        let mut sim = Integrator::new(contact(), projected, T::ZERO, start()).max_steps(10_000_000);
        let ended = sim.advance_to(T::from_f64(30.0));
        ended.unwrap_or_else(|error| panic!("{name}, every {every}: {error} {:?}", sim.statistics()));
        let (with, without) = (cost(sim.statistics()), cost(free.statistics()));
        assert!(with <= without + without / 10 + 10, "{name}, every {every}: {with} for {without}");
    }
}

#[test]
fn no_step_is_corrected_by_more_than_the_tolerance() {
    each!(refused::<f64>, 1e-9);
    each!(refused::<f32>, 1e-4_f32);
}

#[test]
fn steps_are_as_short_as_their_corrections_ask_for() {
    each!(|name, method| bounded::<f64>(name, method, 1e-6), 1e-6);
    each!(|name, method| bounded::<f32>(name, method, 1e-4), 1e-4_f32);
}

#[test]
fn a_drift_of_the_method_s_own_shortens_no_steps() {
    for rtol in [1e-2, 1e-3, 1e-6, 1e-9] {
        each!(undisturbed::<f64>, rtol);
    }
    each!(undisturbed::<f32>, 1e-4_f32);
    for rtol in [1e-12, 1e-14] {
        undisturbed::<f64>("Dop853", Dop853::new().rtol(rtol));
        undisturbed::<f64>("Vern9", Vern9::new().rtol(rtol));
        undisturbed::<f64>("Taylor", Taylor::new().rtol(rtol));
    }
    undisturbed::<f64>("Taylor", Taylor::new().rtol(1e-15));
}

/// A correction of fixed steps is compared with nothing: it is told.
#[test]
fn corrections_of_fixed_steps_are_told_and_made() {
    let (ended, _, statistics) = run::<f64, _>((Course::Jump, false), Projected::new(Rk4::new(0.1), 1), 1.0);
    assert_eq!((ended, statistics.largest_correction), (Ok(()), 0.5));
}
