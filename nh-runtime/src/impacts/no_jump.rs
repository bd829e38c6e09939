//! Why there is no jump.

use core::error::Error;
use core::fmt::{self, Display, Formatter};

use crate::IntegrationError;

/// Why an impact has no solution, or an integration with impacts stopped.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum ImpactError {
    /// A coefficient of restitution is outside 0 … 1.
    Restitution {
        /// Its value.
        value: f64,
    },
    /// The gap up to which a row is closed is negative or no finite number.
    Closed {
        /// Its value.
        value: f64,
    },
    /// There are more rows than are tried in all combinations.
    TooManyRows {
        /// How many.
        rows: usize,
    },
    /// A number of a row, its gap among them, is infinite or not a number.
    NotFinite {
        /// The row.
        row: &'static str,
        /// The time.
        time: f64,
    },
    /// A run starts where a gap is negative, by more than rounding and what counts as closed.
    Beyond {
        /// The row.
        row: &'static str,
        /// The time.
        time: f64,
        /// The gap.
        gap: f64,
    },
    /// The impulse of a row does not move it ahead, n M⁻¹ nᵀ ≤ 0 on the constraints.
    NoResponse {
        /// The row.
        row: &'static str,
        /// The time.
        time: f64,
        /// The change of its rate by an impulse of 1.
        response: f64,
    },
    /// A row is a combination of others on the constraints, so that its impulse is not determined.
    Dependent {
        /// The row.
        row: &'static str,
        /// The time.
        time: f64,
    },
    /// Rows that were open close by the jump of others, again and again.
    Unsettled {
        /// A row that still closes.
        row: &'static str,
        /// The time.
        time: f64,
        /// How many jumps were made in one instant.
        jumps: u32,
    },
    /// The way to the target leads back in time, and what a motion was before an impact cannot be told from what it is
    /// after it: all that lands ends alike.
    Backwards {
        /// The time.
        time: f64,
        /// The target.
        target: f64,
    },
    /// A step between two impacts.
    Integration(IntegrationError),
}

impl Display for ImpactError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Restitution { value } => {
                write!(f, "the coefficient of restitution is {value:?}, but has to be from 0 to 1")
            }
            Self::Closed { value } => write!(
                f,
                "the gap up to which a row is closed is {value:?}, but has to be a finite number that is not negative"
            ),
            Self::TooManyRows { rows } => write!(
                f,
                "the impact has {rows} rows, more than the six that are tried in all combinations: tell those apart \
                 that cannot be closed together"
            ),
            Self::NotFinite { row, time } => write!(
                f,
                "the row `{row}` has a number that is not finite at t = {time:?}: look at the last good state, and \
                 at the parameters"
            ),
            Self::Beyond { row, time, gap } => write!(
                f,
                "the gap of the row `{row}` is {gap:?} at t = {time:?}, where the run starts: start where no gap is \
                 negative, or say how far it may be by `closed`"
            ),
            Self::NoResponse { row, time, response } => write!(
                f,
                "an impulse of 1 along the row `{row}` changes its rate by {response:?} at t = {time:?}, which has to be \
                 positive: look for a mass that is not, and for constraints that hold the row"
            ),
            Self::Dependent { row, time } => write!(
                f,
                "the row `{row}` is a combination of the others on the constraints at t = {time:?}, so that its \
                 impulse is not determined: leave it out"
            ),
            Self::Unsettled { row, time, jumps } => write!(
                f,
                "the row `{row}` still closes at t = {time:?} after {jumps} jumps in one instant: give less \
                 restitution, or let the rows land together"
            ),
            Self::Backwards { time, target } => write!(
                f,
                "the way from t = {time:?} to {target:?} leads back in time, where impacts cannot be undone: start before \
                 them, or go back to the last one with `advance_to`"
            ),
            Self::Integration(error) => error.fmt(f),
        }
    }
}

impl Error for ImpactError {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        match self {
            Self::Integration(error) => error.source(),
            _ => None,
        }
    }
}

impl From<IntegrationError> for ImpactError {
    fn from(error: IntegrationError) -> Self {
        Self::Integration(error)
    }
}
