//! An integration from jump to jump.

use core::ops::ControlFlow;

use super::jumps::{Contact, Place, StruckOf, struck};
use super::{Impact, ImpactError};
use crate::integrator::Spent;
use crate::methods::Method;
use crate::{
    Direction, Dynamics, Event, Events, IntegrationError, Integrator, Real, Scalar, ScalarOf, State,
};

/// How an integration with impacts has ended.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum End<T> {
    /// At the target.
    Target,
    /// After an impact at which it was told to.
    Stopped,
    /// Impacts of a row follow one another sooner than time resolves: it has come to rest on it, and stands there, with
    /// the row landed. What goes on from there is another motion, with the row as a constraint.
    Accumulated {
        /// The row.
        row: usize,
        /// When.
        time: T,
    },
}

/// Refuses a start beyond a gap: nothing would lead back from there.
fn admit_start<S: Dynamics, I: Impact<S, R>, const R: usize>(
    place: &Place<'_, S>,
    impact: &I,
) -> Result<(), ImpactError>
where
    ScalarOf<S>: Real,
{
    let Place { system, time, state, closed } = *place;
    let zero = ScalarOf::<S>::ZERO;
    let largest = state.to_array().as_ref().iter().fold(zero, |most, x| most.max(x.abs()));
    let gaps = impact.gaps(system, time, state);
    for ((gap, size), row) in gaps.iter().zip(impact.sizes(system, time, state)).zip(impact.names()) {
        // where nothing is said of the terms, the state tells what is small
        let size = if size > zero { size } else { largest };
        let allowed = closed.max(ScalarOf::<S>::EPSILON.sqrt() * size);
        if let Some(gap) = gap.filter(|gap| *gap < -allowed) {
            return Err(ImpactError::Beyond { row, time: time.to_f64(), gap: gap.to_f64() });
        }
    }
    Ok(())
}

/// Takes steps to `target`, which is not before the time, and makes the jump of `impact` wherever a gap closes, and at the
/// start where one is closed and does not open; `visit` sees each and may end the run there. `closed` is the largest gap that
/// counts as closed, in the units of the gaps: 0 unless a gap is known to that alone, since rounding is allowed for without it.
/// A start with a gap that is negative by more than that is refused. Statistics, input and step length go on from jump to
/// jump, and the limits on steps and evaluations hold for the whole call.
///
/// # Errors
/// [`ImpactError`]; state and time are those before the impact, or of the last good step.
pub fn advance_with_impacts<S, M, I, const R: usize>(
    sim: &mut Integrator<S, M>,
    target: ScalarOf<S>,
    impact: &I,
    closed: ScalarOf<S>,
    mut visit: impl FnMut(&StruckOf<S, R>) -> ControlFlow<()>,
) -> Result<End<ScalarOf<S>>, ImpactError>
where
    S: Dynamics + Clone,
    M: Method<S>,
    I: Impact<S, R>,
    ScalarOf<S>: Real,
{
    sim.admit_target(target)?;
    if sim.time() == target {
        return Ok(End::Target);
    }
    if target < sim.time() {
        let [time, target] = [sim.time(), target].map(|time: ScalarOf<S>| time.to_f64());
        return Err(ImpactError::Backwards { time, target });
    }
    let system = sim.system().clone();
    let strike_at = |time: ScalarOf<S>, state: &S::State, contact| {
        let place = Place { system: &system, time, state, closed };
        struck(&place, impact, impact.restitution(&system), contact)
    };
    let gaps = |t: ScalarOf<S>, state: &S::State| impact.gaps(&system, t, state);
    if gaps(sim.time(), sim.state()).iter().any(Option::is_some) {
        admit_start(&Place { system: &system, time: sim.time(), state: sim.state(), closed }, impact)?;
        let struck = strike_at(sim.time(), sim.state(), Contact::unseen())?;
        if struck.impulses.iter().any(|impulse| *impulse != ScalarOf::<S>::ZERO) {
            sim.set_state(struck.after);
            if visit(&struck).is_break() {
                return Ok(End::Stopped);
            }
        }
    }
    let gap_or_open = |t: ScalarOf<S>, state: &S::State, _: &S::Input| {
        gaps(t, state).map(|gap| gap.unwrap_or(ScalarOf::<S>::ONE))
    };
    let events = Events::new(gap_or_open).directions([Direction::Closing; R]);
    let mut spent = Spent::default();
    loop {
        let mut touching = [false; R];
        let note = |event: &Event<ScalarOf<S>, S::State>| {
            touching.iter_mut().skip(event.index).take(1).for_each(|row| *row = true);
            ControlFlow::Break(())
        };
        match sim.watch((target, &mut spent), &events, false, note, |_| Ok(())) {
            Ok(None) => return Ok(End::Target),
            Ok(Some(_)) => {
                let struck = strike_at(sim.time(), sim.state(), Contact { resting: None, touching })?;
                sim.set_state(struck.after);
                if visit(&struck).is_break() {
                    return Ok(End::Stopped);
                }
            }
            Err(IntegrationError::EventsAccumulate { event, .. }) => {
                let (time, state) = (sim.time(), *sim.state());
                let place = Place { system: &system, time, state: &state, closed };
                let contact = Contact { resting: Some(event), ..Contact::unseen() };
                let landed = struck(&place, impact, ScalarOf::<S>::ZERO, contact)?;
                sim.set_state(landed.after);
                return Ok(End::Accumulated { row: event, time });
            }
            Err(error) => return Err(error.into()),
        }
    }
}
