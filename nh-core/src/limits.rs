//! How much work a declaration may take before it is refused as too large.
//!
//! Work is counted, not timed, so that what compiles compiles everywhere: a unit is one operand that the
//! algebra reads, or one entry that it builds, which takes an unoptimised build up to a microsecond. Whoever does
//! work that grows with the declaration says so by [`spend`]; where more is spent than [`WORK`] allows, the
//! derivation ends at once by unwinding to [`within_limits`], which gives an error in its place. So no function
//! between the two has to hand on that it could not be finished, and none sees half a value.
//!
//! Limits of the language, such as the length of numbers, stand in `nh-macros/src/syntax/limits.rs`.

use std::any::Any;
use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};

/// All work of one declaration: chosen so that an unoptimised build refuses within half a minute what it does not
/// compile.
pub const WORK: u64 = 72_000_000;

/// Entries of sums and products that are stored: chosen so that a derivation stays below a gibibyte.
pub const STORED: u64 = 2_500_000;

/// What a remark of the report may take that nothing else depends on: beyond it the report leaves it out.
pub const REMARK: u64 = 6_000_000;

/// What is being worked on, for the message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Subject {
    /// Names and expressions as they are written.
    Declaration,
    /// The kinematic equations or the coframe, and the brackets that follow.
    Kinematics,
    /// Identities of the embedded base.
    Embedding,
    /// Brackets and the structure equations.
    Brackets,
    /// Constraints, or the sections that span the distribution, and the choice of velocities.
    Constraints,
    /// Symmetries and their momenta.
    Symmetries,
    /// The equations of motion: the derivatives of the Lagrangian.
    Equations,
    /// The solution for the accelerations.
    Solution,
    /// Claims of first integrals, volumes and the like.
    Claims,
    /// What `emit` asks for.
    Requests,
    /// The search for the shortest code.
    Code,
    /// The proof that a map relates two systems.
    Map,
    /// The quotient of a system.
    Quotient,
}

/// That a declaration is too large.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TooLarge {
    /// What took the last of the work.
    pub subject: Subject,
    /// Which limit was met.
    pub limit: Limit,
}

/// A limit of this file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Limit {
    /// [`WORK`]
    Work,
    /// [`STORED`]
    Stored,
}

#[derive(Clone, Copy, Debug)]
struct Meter {
    allowed: u64,
    stored: u64,
    subject: Subject,
}

thread_local! {
    /// What else is counted; nothing is outside of [`within_limits`].
    static METER: Cell<Option<Meter>> = const { Cell::new(None) };
    /// The work that is left. By itself, since it is counted at every turn.
    static LEFT: Cell<u64> = const { Cell::new(u64::MAX) };
}

/// Runs a derivation within the limits of a declaration. Inside of another run it draws on what that has left.
///
/// # Errors
/// That the limits do not allow it.
pub fn within_limits<T>(derivation: impl FnOnce() -> T) -> Result<T, TooLarge> {
    within(WORK, derivation)
}

/// The same with less work than others may have, or more.
///
/// # Errors
/// That so much work is not enough.
pub fn within<T>(work: u64, derivation: impl FnOnce() -> T) -> Result<T, TooLarge> {
    if METER.get().is_some() {
        return Ok(derivation());
    }
    METER.set(Some(Meter { allowed: work, stored: STORED, subject: Subject::Declaration }));
    LEFT.set(work);
    // nothing of an unfinished derivation is seen again
    let outcome = catch_unwind(AssertUnwindSafe(derivation));
    METER.set(None);
    outcome.or_else(|reason| caught(reason))
}

/// Runs what may be left out with so much work at most; `None` where that is not enough.
pub fn attempt<T>(work: u64, question: impl FnOnce() -> T) -> Option<T> {
    let Some(outer) = METER.get() else { return Some(question()) };
    let kept_back = LEFT.get().saturating_sub(work);
    LEFT.set(LEFT.get() - kept_back);
    // an unfinished question leaves expressions behind that nobody refers to
    let answer = catch_unwind(AssertUnwindSafe(question));
    LEFT.set(LEFT.get() + kept_back);
    about(outer.subject);
    answer.map_or_else(|reason| caught(reason).ok(), Some)
}

fn caught<T>(reason: Box<dyn Any + Send>) -> Result<T, TooLarge> {
    match reason.downcast::<TooLarge>() {
        Ok(too_large) => Err(*too_large),
        Err(panic) => resume_unwind(panic),
    }
}

/// How much work is done so far.
#[must_use]
pub fn spent() -> u64 {
    METER.get().map_or(0, |meter| meter.allowed - LEFT.get())
}

/// The seconds that this thread has spent on a processor, where the system tells (Linux). What is not counted as work
/// shows there, however busy the machine is.
#[must_use]
pub fn processor_time() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    let nanoseconds: f64 = text.split(' ').next()?.parse().ok()?;
    Some(nanoseconds * 1e-9)
}

/// What a computation gives, and the seconds of [`processor_time`] that it takes; 0 where no system tells.
pub fn timed<T>(computation: impl FnOnce() -> T) -> (T, f64) {
    let before = processor_time();
    let result = computation();
    let seconds = processor_time().zip(before).map_or(0.0, |(after, before)| after - before);
    (result, seconds)
}

/// Does some work, unless it is too much.
pub fn spend(work: usize) {
    let is_enough = LEFT.with(|left| {
        // as wide as any work on all targets
        let (before, work) = (left.get(), work as u64);
        if work <= before {
            left.set(before - work);
        }
        work <= before
    });
    if !is_enough {
        too_much();
    }
}

/// Refuses more work, where it is counted.
#[cold]
fn too_much() {
    match METER.get() {
        Some(meter) => refuse(meter.subject, Limit::Work),
        None => LEFT.set(u64::MAX),
    }
}

/// Stores some entries, unless they are too many.
pub(crate) fn store(entries: usize) {
    let Some(mut meter) = METER.get() else { return };
    match meter.stored.checked_sub(u64::try_from(entries).unwrap_or(u64::MAX)) {
        Some(left) => meter.stored = left,
        None => refuse(meter.subject, Limit::Stored),
    }
    METER.set(Some(meter));
}

/// What is worked on from now on.
pub fn about(subject: Subject) {
    if let Some(meter) = METER.get() {
        METER.set(Some(Meter { subject, ..meter }));
    }
}

/// Unwinds to [`within_limits`]. No message is printed on the way, since this is no panic.
fn refuse(subject: Subject, limit: Limit) -> ! {
    resume_unwind(Box::new(TooLarge { subject, limit }))
}

impl TooLarge {
    /// What is wrong.
    #[must_use]
    pub fn what(&self) -> String {
        let what = match self.subject {
            Subject::Declaration => "what is written here",
            Subject::Kinematics => "the kinematic equations",
            Subject::Embedding => "the identities of the base",
            Subject::Brackets => "the brackets",
            Subject::Constraints => "the constraints",
            Subject::Symmetries => "the symmetries",
            Subject::Equations => "the derivatives of the Lagrangian",
            Subject::Solution => "the solution for the accelerations",
            Subject::Claims => "the claims about the motion",
            Subject::Requests => "what is asked for",
            Subject::Code => "the search for short code",
            Subject::Map => "the proof that the map relates the two systems",
            Subject::Quotient => "the quotient",
        };
        let more = match self.limit {
            Limit::Work => format!("more than {} million steps", WORK / 1_000_000),
            Limit::Stored => format!("expressions of more than {STORED} entries"),
        };
        format!("this declaration is too large, because {what} would take {more}")
    }

    /// What the user can do.
    #[must_use]
    pub fn way_out(&self) -> &'static str {
        match self.subject {
            Subject::Declaration => "shorten the ranges of `sum` and `for`, or use fewer bodies",
            Subject::Kinematics => {
                "use quasi-velocities in which the anchor has few entries, or split the system"
            }
            Subject::Embedding => "use fewer embedded coordinates, or local ones",
            Subject::Brackets => {
                "use a basis whose brackets are short: that of the coordinates, or of a known algebra"
            }
            Subject::Constraints => {
                "use fewer constraints, or `formulation { projected }`, which solves them by numbers"
            }
            Subject::Symmetries => "declare fewer symmetries, or split the system",
            Subject::Equations => {
                "use fewer bodies, shorter `let`s, or velocities in which the energy is short"
            }
            Subject::Solution => "use fewer bodies, or coordinates in which the mass matrix has few entries",
            Subject::Claims => "leave claims out: they can be watched as `outputs`",
            Subject::Requests => "ask for less in `emit` and `outputs`",
            Subject::Code => "use fewer bodies, or `track` the variables that matter",
            Subject::Map => "map fewer bodies, or in coordinates and velocities in which the map is short",
            Subject::Quotient => "name invariant `velocities` that are short, or use fewer bodies",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_too_much_is_refused_with_its_subject() {
        let refused = within_limits(|| {
            about(Subject::Brackets);
            loop {
                spend(1_000_000);
            }
        });
        let Err::<(), _>(too_large) = refused else { panic!("without end") };
        assert_eq!(too_large, TooLarge { subject: Subject::Brackets, limit: Limit::Work });
        assert!(too_large.what().contains("because the brackets would take more than"));
        let stored = within_limits(|| store(usize::MAX));
        assert_eq!(stored.map_err(|too_large| too_large.limit), Err(Limit::Stored));
        // nothing is left of it
        assert_eq!(within_limits(|| spend(1)), Ok(()));
        spend(usize::MAX);
    }

    #[test]
    fn runs_inside_of_runs_share_the_limits() {
        let outcome = within_limits(|| {
            let half = usize::try_from(WORK / 2).unwrap_or(0);
            let first = within_limits(|| spend(half + 1));
            assert_eq!((first, spent()), (Ok(()), WORK / 2 + 1));
            within_limits(|| spend(half + 1))
        });
        assert!(outcome.is_err());
    }

    #[test]
    fn what_may_be_left_out_has_a_share_of_its_own() {
        let outcome = within_limits(|| {
            let endless = attempt(1000, || {
                loop {
                    spend(10);
                }
            });
            let short = attempt(1000, || spend(10));
            (endless, short, spent())
        });
        let Ok((None::<()>, Some(()), spent)) = outcome else { panic!("{outcome:?}") };
        assert_eq!(spent, 1010);
    }

    #[test]
    fn waiting_takes_no_time_of_the_processor() {
        let ((), seconds) = timed(|| std::thread::sleep(std::time::Duration::from_millis(200)));
        assert!(seconds < 0.1, "{seconds}");
    }

    #[test]
    fn panics_stay_panics() {
        let panic = catch_unwind(|| within_limits(|| resume_unwind(Box::new("a defect"))));
        let Err(reason) = panic.map(|outcome: Result<(), TooLarge>| outcome.is_ok()) else {
            panic!("caught")
        };
        assert_eq!(reason.downcast_ref(), Some(&"a defect"));
        assert_eq!(spent(), 0);
    }
}
