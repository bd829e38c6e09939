//! What a run does, in the units of the motion itself.

use nonholonomic::{
    Dynamics, IntegrationError, Integrator, Method, Real, Scalar, ScalarOf, State, Statistics,
};

use crate::scaled::{Scaled, divided, multiplied};

/// Every number that a run gives, as bits, with what it cost and how it ended.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Record {
    numbers: Vec<u64>,
    statistics: Statistics,
    end: String,
}

impl Record {
    /// What differs first, if anything does.
    pub(crate) fn difference(&self, other: &Self) -> Option<String> {
        if self == other {
            return None;
        }
        let pairs = self.numbers.iter().zip(&other.numbers);
        let first = pairs.enumerate().find(|(_, (a, b))| a != b);
        let numbers = first.map_or(String::new(), |(i, (a, b))| {
            format!("number {i}: {:e} {:e}; ", f64::from_bits(*a), f64::from_bits(*b))
        });
        let count = |r: &Self| {
            let s = r.statistics;
            (s.steps, s.rejected, s.evaluations, s.jacobians, s.factorizations, s.iterations)
        };
        Some(format!("{numbers}{:?} {:?} {} {}", count(self), count(other), self.end, other.end))
    }
}

/// A motion to be recorded: where and when it starts and ends, in its own units.
#[derive(Clone, Copy)]
pub(crate) struct Course<X: State> {
    pub(crate) start: X,
    pub(crate) from: X::Scalar,
    pub(crate) to: X::Scalar,
    /// The steps that are looked at.
    pub(crate) steps: u32,
}

/// Steps towards the end with a state within each, and a run as a whole to where they led.
pub(crate) fn recorded<S, M>(scaled: &Scaled<S>, method: &M, course: &Course<S::State>) -> Record
where
    S: Dynamics + Copy,
    ScalarOf<S>: Real,
    M: Method<Scaled<S>> + Clone,
{
    let tau = scaled.time;
    let start = multiplied(&course.start, &scaled.units);
    let mut numbers = Vec::new();
    let mut note = |time: ScalarOf<S>, state: &S::State| {
        numbers.push((time / tau).to_f64().to_bits());
        let inner = divided(state, &scaled.units).to_array();
        numbers.extend(inner.as_ref().iter().map(|x| x.to_f64().to_bits()));
    };
    let mut sim = Integrator::new(*scaled, method.clone(), course.from * tau, start);
    let mut end = String::from("the end");
    for _ in 0..course.steps {
        let before = sim.time();
        if let Err(error) = sim.step_towards(course.to * tau) {
            end = told(&error, tau.to_f64());
            break;
        }
        note(sim.time(), sim.state());
        let within = before + (sim.time() - before) * ScalarOf::<S>::from_f64(0.375);
        match sim.at(within) {
            Ok(state) => note(within, &state),
            Err(error) => end += &told(&error, tau.to_f64()),
        }
    }
    let reached = sim.time();
    let mut whole = Integrator::new(*scaled, method.clone(), course.from * tau, start).max_steps(1000);
    if let Err(error) = whole.advance_to(reached) {
        end += &told(&error, tau.to_f64());
    }
    note(whole.time(), whole.state());
    // the same way once more, looked at between the steps
    let mut sampled = Integrator::new(*scaled, method.clone(), course.from * tau, start).max_steps(1000);
    let way = reached / tau - course.from;
    let times =
        [0.11, 0.5, 0.73, 1.0].map(|share| (course.from + way * ScalarOf::<S>::from_f64(share)) * tau);
    if let Err(error) = sampled.sample(times, &mut note) {
        end += &told(&error, tau.to_f64());
    }
    // and a step that chooses its length without a target
    let mut free = Integrator::new(*scaled, method.clone(), course.from * tau, start);
    if let Err(error) = free.step() {
        end += &told(&error, tau.to_f64());
    }
    note(free.time(), free.state());
    let mut statistics = sim.statistics();
    statistics.stiff_at = statistics.stiff_at.map(|time| time / tau.to_f64());
    statistics.last_residual /= scaled.other.to_f64();
    statistics.largest_correction /= scaled.units.to_array().as_ref()[0].to_f64();
    Record { numbers, statistics, end }
}

/// The error with its numbers in the units of the motion.
pub(crate) fn told(error: &IntegrationError, tau: f64) -> String {
    match *error {
        IntegrationError::StepUnderflow { time, step, error } => {
            format!("underflow at {:e} of {:e}: {error:e}", time / tau, step / tau)
        }
        IntegrationError::NoConvergence { time, step, iterations, residual } => {
            format!("no convergence at {:e} of {:e}: {iterations} {residual:e}", time / tau, step / tau)
        }
        IntegrationError::NonFiniteStep { component, time, step } => {
            format!("{component} not finite at {:e} of {:e}", time / tau, step / tau)
        }
        IntegrationError::NonFiniteDerivative { component, time, .. } => {
            format!("the derivative of {component} not finite at {:e}", time / tau)
        }
        IntegrationError::Projection { time, error } => {
            format!("not projected at {:e}: {}", time / tau, error.iterations)
        }
        IntegrationError::TooManySteps { time, target, limit } => {
            format!("{limit} steps to {:e}, not {:e}", time / tau, target / tau)
        }
        // its name alone, since its numbers have units
        other => format!("{other:?}").chars().take_while(char::is_ascii_alphanumeric).collect(),
    }
}
