//! The jump at one instant: jumps follow one another until every row that is closed rests or opens.

use super::complementarity::Problem;
use super::{Impact, ImpactError, MOST_ROWS, Rows};
use crate::arrays::{all_finite, displaced};
use crate::{Dynamics, Real, Scalar, ScalarOf, State, VecOf};

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

/// A jump of a system.
pub(super) type StruckOf<S, const R: usize> = Struck<ScalarOf<S>, <S as Dynamics>::State, R>;
/// The rows of a system.
type RowsOf<S, const R: usize> = Rows<ScalarOf<S>, VecOf<S>, R>;

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
pub(super) struct Contact<const R: usize> {
    /// A row that has come to rest: it is met whatever its rate.
    pub(super) resting: Option<usize>,
    /// Rows whose gaps have been seen to close: they are closed, whatever rounding shows of them.
    pub(super) touching: [bool; R],
}

impl<const R: usize> Contact<R> {
    pub(super) fn unseen() -> Self {
        Self { resting: None, touching: [false; R] }
    }
}

/// Where an impact happens.
pub(super) struct Place<'a, S: Dynamics> {
    pub(super) system: &'a S,
    pub(super) time: ScalarOf<S>,
    pub(super) state: &'a S::State,
    /// The gap up to which a row is closed.
    pub(super) closed: ScalarOf<S>,
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
pub(super) fn struck<S: Dynamics, I: Impact<S, R>, const R: usize>(
    place: &Place<'_, S>,
    impact: &I,
    restitution: ScalarOf<S>,
    contact: Contact<R>,
) -> Result<StruckOf<S, R>, ImpactError>
where
    ScalarOf<S>: Real,
{
    let Place { system, time, state, closed } = *place;
    admit::<_, R>(restitution, closed)?;
    let failure = Failure { names: impact.names(), time: time.to_f64() };
    let ground = Ground::of(place, impact, contact, &failure)?;
    // restitution acts on gaps alone, and lands what has come to rest
    let coefficients =
        impact.bounces().map(|bounces| if bounces { restitution } else { ScalarOf::<S>::ZERO });
    let mut jumped = Jumped::<S, R>::from(*state);
    for jump in 0..=MOST_JUMPS {
        let rows = impact.rows(system, time, &jumped.after);
        if let Some(index) = not_finite::<S, R>(&rows) {
            return Err(failure.not_finite(index));
        }
        let Closing { present, is_over, pushes } =
            ground.closing(&rows, &jumped, time).map_err(|index| failure.not_finite(index))?;
        if !pushes || jump > 0 && (is_over || ground.are_bilateral()) {
            break;
        }
        if jump == MOST_JUMPS {
            let closes = (0..R).find(|index| present.get(*index) == Some(&true)).unwrap_or(0);
            return Err(ImpactError::Unsettled { row: failure.row(closes), time: failure.time, jumps: jump });
        }
        let mut offset = rows.approach;
        offset.iter_mut().zip(&coefficients).for_each(|(s, e)| *s *= ScalarOf::<S>::ONE + *e);
        let problem = Problem { mobility: &rows.mobility, offset, present, bilateral: ground.bilateral };
        let impulses = problem.solve().map_err(|none| none.told(failure.names, failure.time))?;
        jumped.jump(&rows, &impulses, &coefficients, &present);
    }
    let Jumped { after, impulses, lost, .. } = jumped;
    let lost = impact.is_homogeneous().then_some(lost);
    Ok(Struck { time, before: *state, after, impulses, lost })
}

/// A row with a number that is not finite.
fn not_finite<S: Dynamics, const R: usize>(rows: &RowsOf<S, R>) -> Option<usize> {
    let is_finite = |index: usize| {
        let mobility = rows.mobility.get(index).is_some_and(all_finite::<ScalarOf<S>, _>);
        let response = rows.response.get(index).is_some_and(all_finite::<ScalarOf<S>, _>);
        mobility && response && rows.approach.get(index).is_some_and(|s| s.is_finite())
    };
    (0..R).find(|index| !is_finite(*index))
}

/// What errors name.
struct Failure<const R: usize> {
    names: [&'static str; R],
    time: f64,
}

impl<const R: usize> Failure<R> {
    fn row(&self, index: usize) -> &'static str {
        self.names.get(index).copied().unwrap_or_default()
    }

    fn not_finite(&self, index: usize) -> ImpactError {
        ImpactError::NotFinite { row: self.row(index), time: self.time }
    }
}

/// Where the rows are, which no jump changes.
struct Ground<T, const R: usize> {
    /// The gap of each row; none of a bilateral one, nor of one that rests.
    gaps: [Option<T>; R],
    /// The sizes of the terms that they are the differences of.
    sizes: [T; R],
    bilateral: [bool; R],
    /// Rows whose gaps have been seen to close.
    touching: [bool; R],
    /// Whether a row has come to rest.
    rests: bool,
    /// The gap up to which a row is closed.
    closed: T,
}

/// Which rows a jump meets.
struct Closing<const R: usize> {
    present: [bool; R],
    /// Whether none of them closes but by rounding.
    is_over: bool,
    /// Whether there is a reason to jump: a gap that closes, or nothing but bilateral rows.
    pushes: bool,
}

impl<T: Real, const R: usize> Ground<T, R> {
    fn of<S: Dynamics<State: State<Scalar = T>>, I: Impact<S, R>>(
        place: &Place<'_, S>,
        impact: &I,
        Contact { resting, touching }: Contact<R>,
        failure: &Failure<R>,
    ) -> Result<Self, ImpactError> {
        let Place { system, time, state, closed } = *place;
        let mut gaps = impact.gaps(system, time, state);
        if let Some(index) = gaps.iter().position(|gap| gap.is_some_and(|gap| !gap.is_finite())) {
            return Err(failure.not_finite(index));
        }
        if let Some(gap) = resting.and_then(|row| gaps.get_mut(row)) {
            *gap = None;
        }
        let bilateral = gaps.map(|gap| gap.is_none());
        let sizes = impact.sizes(system, time, state);
        Ok(Self { gaps, sizes, bilateral, touching, rests: resting.is_some(), closed })
    }

    fn are_bilateral(&self) -> bool {
        self.bilateral.iter().all(|is| *is)
    }

    /// The rows that are closed and do not open; the row of which that is not known, as at no time, where there is one.
    fn closing<S: Dynamics<State: State<Scalar = T>>>(
        &self,
        rows: &RowsOf<S, R>,
        jumped: &Jumped<S, R>,
        time: T,
    ) -> Result<Closing<R>, usize> {
        let mut closing =
            Closing { present: [false; R], is_over: true, pushes: self.are_bilateral() || self.rests };
        for (index, (present, (gap, s))) in
            closing.present.iter_mut().zip(self.gaps.iter().zip(&rows.approach)).enumerate()
        {
            let rounding = self.sizes.get(index).map_or(T::ZERO, |size| T::EPSILON.sqrt() * *size)
                + T::from_f64(64.0) * T::EPSILON * (*s * time).abs();
            if gap.is_some() && !rounding.is_finite() {
                return Err(index);
            }
            let is_seen = self.touching.get(index) == Some(&true);
            let may_push = *s <= T::ZERO || jumped.landed.get(index) == Some(&true);
            *present = gap.is_none_or(|gap| (is_seen || gap <= self.closed.max(rounding)) && may_push);
            closing.pushes |= gap.is_some() && *present;
            let speed = jumped.round_off(rows, index);
            closing.is_over &= match gap {
                None => s.abs() <= speed || jumped.is_left(index, *s),
                Some(_) => !*present || -*s <= speed || jumped.is_left(index, *s),
            };
        }
        Ok(closing)
    }
}

/// What jumps have come to.
struct Jumped<S: Dynamics, const R: usize> {
    after: S::State,
    impulses: [ScalarOf<S>; R],
    lost: ScalarOf<S>,
    /// The rates of the rows that the last jump has met.
    met: [Option<ScalarOf<S>>; R],
    /// Rows that have landed stay in, or two that close each other by turns would come to an end in no number of jumps.
    landed: [bool; R],
}

impl<S: Dynamics, const R: usize> Jumped<S, R>
where
    ScalarOf<S>: Real,
{
    fn from(state: S::State) -> Self {
        let zero = ScalarOf::<S>::ZERO;
        Self { after: state, impulses: [zero; R], lost: zero, met: [None; R], landed: [false; R] }
    }

    /// The rate of a row up to which it is what the jumps have left to round-off, which does not close.
    fn round_off(&self, rows: &RowsOf<S, R>, index: usize) -> ScalarOf<S> {
        let zero = ScalarOf::<S>::ZERO;
        let own = rows.mobility.get(index).and_then(|row| row.get(index)).map_or(zero, |k| k.sqrt());
        let most = rows.mobility.iter().zip(&self.impulses).enumerate();
        let moved = most
            .fold(zero, |most, (i, (row, mu))| most.max(mu.abs() * row.get(i).map_or(zero, |k| k.sqrt())));
        ScalarOf::<S>::from_f64(256.0) * ScalarOf::<S>::EPSILON * own * moved
    }

    /// Whether a rate is what a jump has left of it. A jump meets its rows at once: what it has left of them and no longer
    /// halves is round-off of the velocities, however small the impulses are.
    fn is_left(&self, index: usize, s: ScalarOf<S>) -> bool {
        let before = self.met.get(index).copied().flatten();
        before.is_some_and(|before| s.abs() + s.abs() >= before.abs())
    }

    /// Makes a jump.
    fn jump(
        &mut self,
        rows: &RowsOf<S, R>,
        impulses: &[ScalarOf<S>; R],
        coefficients: &[ScalarOf<S>; R],
        present: &[bool; R],
    ) {
        let (zero, one) = (ScalarOf::<S>::ZERO, ScalarOf::<S>::ONE);
        for ((met, s), present) in self.met.iter_mut().zip(&rows.approach).zip(present) {
            *met = present.then_some(*s);
        }
        for ((landed, e), present) in self.landed.iter_mut().zip(coefficients).zip(present) {
            *landed |= *present && *e == zero;
        }
        let mut x = self.after.to_array();
        for ((impulse, response), sum) in impulses.iter().zip(&rows.response).zip(&mut self.impulses) {
            x = displaced(&x, *impulse, response);
            *sum += *impulse;
        }
        let worked = impulses.iter().zip(&rows.approach).zip(coefficients);
        let worked = worked.fold(zero, |sum, ((mu, s), e)| sum - (one - *e) * *mu * *s);
        self.lost += ScalarOf::<S>::from_f64(0.5) * worked;
        self.after = S::State::from_array(x);
    }
}
