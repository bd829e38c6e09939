//! The jump, and an integration from jump to jump.

use core::ops::ControlFlow;

use super::complementarity::Problem;
use super::{Impact, ImpactError, MOST_ROWS};
use crate::arrays::{all_finite, displaced};
use crate::integrator::Spent;
use crate::methods::Method;
use crate::{
    Direction, Dynamics, Event, Events, IntegrationError, Integrator, Real, Scalar, ScalarOf, State,
};

/// The jumps that may follow one another in one instant.
const MOST_JUMPS: u32 = 8;

/// What an impact has done.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Struck<T, X, const R: usize> {
    /// When.
    pub time: T,
    /// The state before.
    pub before: X,
    /// The state after.
    pub after: X,
    /// The impulse of each row.
    pub impulses: [T; R],
    /// The energy that is lost, −½ (1 − e) μᵀs of each jump: with one e for all rows, ½ (1 − e)/(1 + e) μᵀKμ. `None` where
    /// rows or constraints are not homogeneous, and what moves by itself does work: ask the energies before and after.
    pub lost: Option<T>,
}

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

/// A jump of a system.
type StruckOf<S, const R: usize> = Struck<ScalarOf<S>, <S as Dynamics>::State, R>;

/// The state after an impact, mathematics (50): all bilateral rows are met, and of the unilateral ones those that are
/// closed, with a gap of at most `closed` or of rounding, and do not open. Rows that the jump closes jump again. Where
/// all unilateral rows are open or separate, the state stays as it is.
///
/// # Errors
/// [`ImpactError`], with nothing done.
pub fn strike<S: Dynamics, I: Impact<S, R>, const R: usize>(
    system: &S,
    impact: &I,
    t: ScalarOf<S>,
    state: &S::State,
    closed: ScalarOf<S>,
) -> Result<StruckOf<S, R>, ImpactError>
where
    ScalarOf<S>: Real,
{
    let place = Place { system, time: t, state, closed };
    struck(&place, impact, impact.restitution(system), Contact::unseen())
}

/// What is known of the contacts besides their gaps.
#[derive(Clone, Copy)]
struct Contact<const R: usize> {
    /// A row that has come to rest: it is met whatever its rate.
    resting: Option<usize>,
    /// Rows whose gaps have been seen to close: they are closed, whatever rounding shows of them.
    touching: [bool; R],
}

impl<const R: usize> Contact<R> {
    fn unseen() -> Self {
        Self { resting: None, touching: [false; R] }
    }
}

/// Where an impact happens.
struct Place<'a, S: Dynamics> {
    system: &'a S,
    time: ScalarOf<S>,
    state: &'a S::State,
    /// The gap up to which a row is closed.
    closed: ScalarOf<S>,
}

/// Refuses what no jump can be made with.
fn admit<T: Real, const R: usize>(restitution: T, closed: T) -> Result<(), ImpactError> {
    if R > MOST_ROWS {
        return Err(ImpactError::TooManyRows { rows: R });
    }
    if !(restitution >= T::ZERO && restitution <= T::ONE) {
        return Err(ImpactError::Restitution { value: restitution.to_f64() });
    }
    if !(closed >= T::ZERO && closed.is_finite()) {
        return Err(ImpactError::Closed { value: closed.to_f64() });
    }
    Ok(())
}

/// The jump with this coefficient of restitution.
fn struck<S: Dynamics, I: Impact<S, R>, const R: usize>(
    place: &Place<'_, S>,
    impact: &I,
    restitution: ScalarOf<S>,
    Contact { resting, touching }: Contact<R>,
) -> Result<StruckOf<S, R>, ImpactError>
where
    ScalarOf<S>: Real,
{
    let Place { system, time: t, state, closed } = *place;
    let (zero, one) = (ScalarOf::<S>::ZERO, ScalarOf::<S>::ONE);
    admit::<_, R>(restitution, closed)?;
    let time = t.to_f64();
    let row = |index: usize| impact.names().get(index).copied().unwrap_or_default();
    let mut gaps = impact.gaps(system, t, state);
    if let Some(index) = gaps.iter().position(|gap| gap.is_some_and(|gap| !gap.is_finite())) {
        return Err(ImpactError::NotFinite { row: row(index), time });
    }
    if let Some(gap) = resting.and_then(|row| gaps.get_mut(row)) {
        *gap = None;
    }
    let bilateral = gaps.map(|gap| gap.is_none());
    let sizes = impact.sizes(system, t, state);
    // restitution acts on gaps alone, and lands what has come to rest
    let coefficients = impact.bounces().map(|bounces| if bounces { restitution } else { zero });
    let mut after = *state;
    let mut impulses = [zero; R];
    let mut lost = zero;
    // the rates of the rows that the last jump has met
    let mut met = [None; R];
    // rows that have landed stay in, or two that close each other by turns would come to an end in no number of jumps
    let mut landed = [false; R];
    for jump in 0..=MOST_JUMPS {
        let rows = impact.rows(system, t, &after);
        let are_finite = |index: usize| {
            let mobility = rows.mobility.get(index).is_some_and(all_finite::<ScalarOf<S>, _>);
            let response = rows.response.get(index).is_some_and(all_finite::<ScalarOf<S>, _>);
            mobility && response && rows.approach.get(index).is_some_and(|s| s.is_finite())
        };
        if let Some(index) = (0..R).find(|index| !are_finite(*index)) {
            return Err(ImpactError::NotFinite { row: row(index), time });
        }
        // what a jump has left to round-off does not close
        let speed = |index: usize| {
            let own = rows.mobility.get(index).and_then(|row| row.get(index)).map_or(zero, |k| k.sqrt());
            let most = rows.mobility.iter().zip(&impulses).enumerate();
            let moved = most.fold(zero, |most, (i, (row, mu))| {
                most.max(mu.abs() * row.get(i).map_or(zero, |k| k.sqrt()))
            });
            ScalarOf::<S>::from_f64(256.0) * ScalarOf::<S>::EPSILON * own * moved
        };
        // a jump meets its rows at once: what it has left of them and no longer halves is round-off of the velocities,
        // however small the impulses are
        let is_left = |index: usize, s: ScalarOf<S>| {
            let before: Option<ScalarOf<S>> = met.get(index).copied().flatten();
            before.is_some_and(|before| s.abs() + s.abs() >= before.abs())
        };
        let mut present = [false; R];
        let mut is_over = true;
        let mut pushes = bilateral.iter().all(|is| *is) || resting.is_some();
        for (index, (present, (gap, s))) in
            present.iter_mut().zip(gaps.iter().zip(&rows.approach)).enumerate()
        {
            let rounding = sizes.get(index).map_or(zero, |size| ScalarOf::<S>::EPSILON.sqrt() * *size)
                + ScalarOf::<S>::from_f64(64.0) * ScalarOf::<S>::EPSILON * (*s * t).abs();
            // which gaps are closed is not known where it is no number, as at no time
            if gap.is_some() && !rounding.is_finite() {
                return Err(ImpactError::NotFinite { row: row(index), time });
            }
            let is_seen = touching.get(index) == Some(&true);
            let has_landed = landed.get(index) == Some(&true);
            let may_push = *s <= zero || has_landed;
            *present = gap.is_none_or(|gap| (is_seen || gap <= closed.max(rounding)) && may_push);
            pushes |= gap.is_some() && *present;
            is_over &= match gap {
                None => s.abs() <= speed(index) || is_left(index, *s),
                Some(_) => !*present || -*s <= speed(index) || is_left(index, *s),
            };
        }
        if !pushes || jump > 0 && (is_over || bilateral.iter().all(|is| *is)) {
            break;
        }
        if jump == MOST_JUMPS {
            let closes = (0..R).find(|index| present.get(*index) == Some(&true)).unwrap_or(0);
            return Err(ImpactError::Unsettled { row: row(closes), time, jumps: jump });
        }
        let mut offset = rows.approach;
        offset.iter_mut().zip(&coefficients).for_each(|(s, e)| *s *= one + *e);
        for ((met, s), present) in met.iter_mut().zip(&rows.approach).zip(&present) {
            *met = present.then_some(*s);
        }
        for ((landed, e), present) in landed.iter_mut().zip(&coefficients).zip(&present) {
            *landed |= *present && *e == zero;
        }
        let problem = Problem { mobility: &rows.mobility, offset, present, bilateral };
        let found = problem.solve().map_err(|none| none.told(impact.names(), time))?;
        let mut x = after.to_array();
        for ((impulse, response), sum) in found.iter().zip(&rows.response).zip(&mut impulses) {
            x = displaced(&x, *impulse, response);
            *sum += *impulse;
        }
        let worked = found.iter().zip(&rows.approach).zip(&coefficients);
        let worked = worked.fold(zero, |sum, ((mu, s), e)| sum - (one - *e) * *mu * *s);
        lost += ScalarOf::<S>::from_f64(0.5) * worked;
        after = S::State::from_array(x);
    }
    let lost = impact.is_homogeneous().then_some(lost);
    Ok(Struck { time: t, before: *state, after, impulses, lost })
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
