//! What stops an integration, with the numbers that show it and a way out.

use core::error::Error;
use core::fmt::{self, Display, Formatter};

use crate::error::{InputFault, ParameterError, ProjectionError, StateFault};

/// Why an integration stopped. The integrator keeps the last good state and its time, and can go on
/// from there.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum IntegrationError {
    /// A parameter of the system is invalid.
    Parameter(ParameterError),
    /// A setting of the method is invalid.
    Setting {
        /// The setting: `step`, `rtol`, ….
        setting: &'static str,
        /// Its value.
        value: f64,
        /// What it has to be.
        expected: &'static str,
    },
    /// A given state is infinite or not a number.
    NonFiniteState {
        /// The first such component.
        component: &'static str,
        /// Its value.
        value: f64,
    },
    /// A given state does not satisfy the identities of its coordinates.
    InvalidState(StateFault),
    /// A given state is off the position constraints, or its velocities are off the constraints, by more than
    /// the tolerance.
    OffConstraints {
        /// The constraint with the largest residual, by its label.
        constraint: &'static str,
        /// That residual.
        residual: f64,
        /// The first component that a return to the constraints would move too far.
        component: &'static str,
        /// By how much.
        correction: f64,
    },
    /// A given state is off the constraints by more than the tolerance.
    InconsistentStart {
        /// The constraint with the largest residual, in the order of
        /// [`constraint_residual`](crate::Constrained::constraint_residual).
        constraint: usize,
        /// What it is called in the declaration; empty where it has no name.
        name: &'static str,
        /// That residual.
        residual: f64,
        /// The first component that a return to the constraints would move too far.
        component: &'static str,
        /// By how much.
        correction: f64,
    },
    /// A given input is infinite or not a number.
    Input(InputFault),
    /// A given time is infinite or not a number, or the time has outgrown its type.
    NonFiniteTime {
        /// The time.
        time: f64,
    },
    /// A derivative is infinite or not a number.
    NonFiniteDerivative {
        /// The first component whose derivative that is.
        component: &'static str,
        /// The time at which it was evaluated.
        time: f64,
        /// Its value.
        value: f64,
    },
    /// A state within the last step is infinite or not a number.
    NonFiniteWithin {
        /// The first such component.
        component: &'static str,
        /// The time.
        time: f64,
        /// Its value.
        value: f64,
    },
    /// The energy of a method that keeps it is infinite or not a number.
    NonFiniteEnergy {
        /// The time at which it was evaluated.
        time: f64,
        /// Its value.
        value: f64,
    },
    /// A step from finite derivatives has led to an infinite state.
    NonFiniteStep {
        /// The first infinite component.
        component: &'static str,
        /// The time at the start of the step.
        time: f64,
        /// The length of the step.
        step: f64,
    },
    /// The step that the tolerance asks for is shorter than the time can resolve.
    StepUnderflow {
        /// The time at the start of the step.
        time: f64,
        /// The length of the last step tried.
        step: f64,
        /// Its error estimate, in units of the tolerance.
        error: f64,
    },
    /// A step of the given length would be lost where time is so coarse.
    UnresolvedStep {
        /// The time at the start of the step.
        time: f64,
        /// Its length.
        step: f64,
        /// How far apart times are there, up to a factor of two.
        resolution: f64,
    },
    /// The equations of an implicit method were not solved.
    NoConvergence {
        /// The time at the start of the step.
        time: f64,
        /// The length of the step.
        step: f64,
        /// The iterations done.
        iterations: u32,
        /// The size of the last correction, in units of the tolerance.
        residual: f64,
    },
    /// The equations of an implicit step are solved, but singular there, or their derivatives are not finite, so that the
    /// step has no derivatives.
    SingularStep {
        /// The time at the start of the step.
        time: f64,
        /// The length of the step.
        step: f64,
    },
    /// The end of a step could not be moved to the constraint manifold.
    Projection {
        /// The time at the end of the step.
        time: f64,
        /// What the projection came to.
        error: ProjectionError,
    },
    /// A step has led past a configuration where the velocities in the state do not determine the others.
    DeadCentre {
        /// The time at the start of the step.
        time: f64,
        /// The length of the step.
        step: f64,
    },
    /// The target was not reached within the permitted number of steps.
    TooManySteps {
        /// The time reached.
        time: f64,
        /// The time to reach.
        target: f64,
        /// The permitted number of steps.
        limit: u64,
    },
    /// The target was not reached within the permitted number of evaluations of the derivative.
    TooManyEvaluations {
        /// The time reached.
        time: f64,
        /// The time to reach.
        target: f64,
        /// The permitted number of evaluations.
        limit: u64,
    },
    /// The run was interrupted by the function that [`Interruptible`](crate::methods::Interruptible) asks.
    Interrupted {
        /// The time reached.
        time: f64,
    },
    /// An event function is infinite or not a number.
    NonFiniteEvent {
        /// Which of the functions.
        event: usize,
        /// The time.
        time: f64,
        /// Its value.
        value: f64,
    },
    /// An event function that starts from zero is back there after hardly more than what time and function resolve: at
    /// once, or many times in a row.
    EventsAccumulate {
        /// Which of the functions.
        event: usize,
        /// The time at which it left zero the last time.
        time: f64,
        /// How long it was away.
        flight: f64,
        /// What rounding leaves open of the times of its zeros there.
        resolution: f64,
    },
    /// Times at which states were asked for do not follow one another in one direction.
    UnorderedTimes {
        /// The first that does not.
        time: f64,
        /// The one before it.
        before: f64,
        /// The last one, towards which they should lead.
        last: f64,
    },
    /// A state was asked for at a time outside the last step.
    OutsideLastStep {
        /// The time asked for.
        time: f64,
        /// The start of the last step.
        from: f64,
        /// The end of the last step.
        to: f64,
    },
}

fn underflow(f: &mut Formatter<'_>, time: f64, step: f64, error: f64) -> fmt::Result {
    if error.is_finite() {
        write!(
            f,
            "at t = {time:?} a step of length {step:?} still has {error:?} times the permitted error, and the time \
             resolves no shorter one: the solution, the mass matrix or the constraints may be singular near there, \
             or the tolerance too small"
        )
    } else {
        write!(
            f,
            "at t = {time:?} a step of length {step:?} still leads to numbers that are not finite, and the time \
             resolves no shorter one: the solution, the mass matrix or the constraints may be singular near there"
        )
    }
}

fn singular(f: &mut Formatter<'_>, time: f64, step: f64) -> fmt::Result {
    write!(
        f,
        "the step of length {step:?} from t = {time:?} has no derivatives: its equations are singular where they are \
         solved, or the system's Jacobian is not finite there; take a step of another length"
    )
}

fn unsolved(f: &mut Formatter<'_>, (time, step): (f64, f64), iterations: u32, residual: f64) -> fmt::Result {
    write!(f, "the step of length {step:?} from t = {time:?} was not solved")?;
    if residual.is_finite() {
        write!(
            f,
            " in {iterations} iterations, the last correction being {residual:?} times the tolerance: take a smaller step"
        )
    } else {
        write!(
            f,
            ": its corrections were no longer finite after {iterations} iterations: take a smaller step"
        )
    }
}

impl Display for IntegrationError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Parameter(error) => error.fmt(f),
            Self::Setting { setting, value, expected } => {
                write!(f, "the setting `{setting}` of the method is {value:?}, but has to be {expected}")
            }
            Self::NonFiniteState { component, value } => {
                write!(f, "the component `{component}` of the given state is {value:?}: give finite numbers")
            }
            Self::InvalidState(fault) => fault.fmt(f),
            Self::OffConstraints { constraint, residual, component, correction } => {
                let place = format_args!("`{constraint}`");
                off_constraints(f, residual, place, (component, correction), "`project` or `assemble`")
            }
            Self::InconsistentStart { constraint, name: "", residual, component, correction } => {
                let place = format_args!("constraint {constraint}");
                off_constraints(f, residual, place, (component, correction), "`project`")
            }
            Self::InconsistentStart { name, residual, component, correction, .. } => {
                let place = format_args!("the constraint `{name}`");
                off_constraints(f, residual, place, (component, correction), "`project`")
            }
            Self::Input(fault) => fault.fmt(f),
            Self::NonFiniteTime { time } => {
                write!(f, "the time {time:?} cannot be reached: times have to be finite")
            }
            Self::NonFiniteDerivative { component, time, value } => write!(
                f,
                "the derivative of `{component}` is {value:?} at t = {time:?}, where the mass matrix or \
                 the constraints may be singular: look at the last good state, and at inputs and \
                 parameters"
            ),
            Self::NonFiniteWithin { component, time, value } => write!(
                f,
                "`{component}` is {value:?} within the step, at t = {time:?}: what the step was made of is not finite, \
                 or a projection finds no state on the constraints there; take shorter steps"
            ),
            Self::NonFiniteEnergy { time, value } => write!(
                f,
                "the energy is {value:?} at t = {time:?}, so that no step can keep it: look at the state and the \
                 parameters, or measure in units that keep squares within the range of the numbers"
            ),
            Self::NonFiniteStep { component, time, step } => write!(
                f,
                "the step of length {step:?} from t = {time:?} makes `{component}` infinite: the \
                 solution grows too fast, take a smaller step"
            ),
            Self::StepUnderflow { time, step, error } => underflow(f, time, step, error),
            Self::UnresolvedStep { time, step, resolution } => write!(
                f,
                "a step of length {step:?} is lost at t = {time:?}, where time is resolved to \
                 {resolution:.1e}: take longer steps, or count time from an origin nearer by"
            ),
            Self::NoConvergence { time, step, iterations, residual } => {
                unsolved(f, (time, step), iterations, residual)
            }
            Self::SingularStep { time, step } => singular(f, time, step),
            Self::Projection { time, error } => write!(f, "at t = {time:?} {error}"),
            Self::DeadCentre { time, step } => write!(
                f,
                "the step of length {step:?} from t = {time:?} leads past a configuration where the velocities that \
                 `independent` names do not determine the others, such as a dead centre: name others, or keep all \
                 of them with `formulation {{ projected }}`"
            ),
            Self::TooManySteps { time, target, limit } => write!(
                f,
                "{limit} steps have led to t = {time:?} and not to {target:?}: permit more with \
                 `max_steps`, take longer steps, or an implicit method if the system is stiff"
            ),
            Self::TooManyEvaluations { time, target, limit } => write!(
                f,
                "{limit} evaluations of the derivative have led to t = {time:?} and not to {target:?}: permit more \
                 with `max_evaluations`, take a larger tolerance, or an implicit method if the system is stiff"
            ),
            Self::Interrupted { time } => write!(
                f,
                "the run was interrupted at t = {time:?} by the function that `Interruptible` asks: call again to \
                 go on"
            ),
            Self::NonFiniteEvent { event, time, value } => write!(
                f,
                "the event function {event} is {value:?} at t = {time:?}, so that its zeros cannot be \
                 found: it has to be finite wherever the solution leads"
            ),
            Self::EventsAccumulate { event, time, flight, resolution } => {
                accumulating(f, event, [time, flight, resolution])
            }
            Self::UnorderedTimes { time, before, last } => write!(
                f,
                "states were asked for at t = {before:?} and then at {time:?}, on the way to {last:?}: sort the \
                 times, or go through them with `advance_through`, which may turn back"
            ),
            Self::OutsideLastStep { time, from, to } => write!(
                f,
                "there is no state at t = {time:?}, since the last step went from {from:?} to \
                 {to:?}: ask within it"
            ),
        }
    }
}

/// What is said where events accumulate.
fn accumulating(f: &mut Formatter<'_>, event: usize, [time, flight, resolution]: [f64; 3]) -> fmt::Result {
    write!(
        f,
        "the event function {event} leaves zero at t = {time:?} and is back after {flight:?}, where rounding leaves \
         {resolution:?} of its zeros' times open: that is too little, or has been so too often in a row, to go on; events accumulate \
         there, as the impacts of a ball that comes to rest: go on with what holds from then on, such as the contact as \
         a constraint; or time is counted from too far away"
    )
}

/// What is said of a start that is off its constraints.
fn off_constraints(
    f: &mut Formatter<'_>,
    residual: f64,
    place: fmt::Arguments<'_>,
    (component, correction): (&str, f64),
    way_out: &str,
) -> fmt::Result {
    write!(f, "the given state leaves a residual of {residual:?} in {place}, and ")?;
    if correction.is_finite() {
        write!(
            f,
            "a return to the constraints would move `{component}` by {correction:?}: give a state that satisfies \
             them, or {way_out} it first"
        )
    } else {
        write!(
            f,
            "no return to the constraints was found from there: their rates may be dependent at such a state, or it \
             is far off. Begin beside it, or {way_out} it first"
        )
    }
}

impl Error for IntegrationError {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        match self {
            Self::Parameter(error) => Some(error),
            Self::Projection { error, .. } => Some(error),
            Self::InvalidState(fault) => Some(fault),
            Self::Input(fault) => Some(fault),
            _ => None,
        }
    }
}

impl From<ParameterError> for IntegrationError {
    fn from(error: ParameterError) -> Self {
        Self::Parameter(error)
    }
}
