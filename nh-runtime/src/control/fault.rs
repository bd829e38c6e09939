//! What can go wrong in a block.

use core::error::Error;
use core::fmt::{self, Display, Formatter};

/// Why a block has no result; its arguments are as they were.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum ControlError {
    /// An argument has an entry that is infinite or not a number.
    NotFinite {
        /// The argument, by its name in the documentation.
        argument: &'static str,
        /// The first such entry.
        value: f64,
    },
    /// A matrix that has to be positive definite, or a covariance or weight that has to be positive
    /// semidefinite, is not.
    NotDefinite {
        /// The matrix, by its name in the documentation.
        matrix: &'static str,
        /// The first pivot of its factorization that is not positive, or negative.
        pivot: f64,
    },
    /// A setting is not what it has to be.
    Setting {
        /// The setting, by its name in the documentation.
        setting: &'static str,
        /// Its value.
        value: f64,
        /// What it has to be.
        expected: &'static str,
    },
    /// The bounds of an input leave nothing between them.
    Bounds {
        /// The input, by its index.
        input: usize,
        /// Its lower bound.
        lower: f64,
        /// Its upper bound.
        upper: f64,
    },
    /// A matrix has an exponential that rounding decides.
    TooFast {
        /// The matrix, by its name in the documentation.
        argument: &'static str,
        /// Its norm.
        norm: f64,
    },
    /// The doubling iteration for the Riccati equation does not settle, or the closed loop that its solution
    /// gives leaves the range of the scalar.
    NotStabilizable {
        /// The iterations done: the horizon is two to this power of ticks.
        iterations: u32,
        /// The relative change of the cost matrix in the last of them; infinite where it is the loop that grows.
        change: f64,
    },
    /// The solution of the Riccati equation does not satisfy it.
    Residual {
        /// What is left of the equation, relative to the cost matrix.
        residual: f64,
    },
    /// A slice does not have one entry for each tick.
    Length {
        /// The slice, by its name in the documentation.
        slice: &'static str,
        /// Its length.
        length: usize,
        /// The number of ticks.
        expected: usize,
    },
}

impl Display for ControlError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite { argument, value } => {
                write!(f, "`{argument}` has the entry {value:?}: check how it is computed")
            }
            Self::NotDefinite { matrix, pivot } => write!(
                f,
                "`{matrix}` has to be positive definite, but a pivot of its factorization is {pivot:?}: \
                 give every direction a positive weight or noise"
            ),
            Self::Setting { setting, value, expected } => {
                write!(f, "`{setting}` is {value:?}: it has to be {expected}")
            }
            Self::Bounds { input, lower, upper } => write!(
                f,
                "the bounds of input {input}, {lower:?} and {upper:?}, leave nothing between them: give the \
                 lower one first"
            ),
            Self::TooFast { argument, norm } => write!(
                f,
                "`{argument}` has the norm {norm:.1e}, and modes that turn so fast without decaying have no \
                 digits left after a tick: take a shorter tick, or leave them out"
            ),
            Self::NotStabilizable { iterations, change } => write!(
                f,
                "there is no stationary regulator: after {iterations} doublings of the horizon it still grows \
                 (relative change {change:.1e}): a mode that does not decay, or too slowly to be told from one that does \
                 not, cannot be steered by the inputs or does not appear in the cost; leave it out of the state, or \
                 give it a weight"
            ),
            Self::Residual { residual } => write!(
                f,
                "the solution of the Riccati equation leaves {residual:.1e} of it: too much grows \
                 within a tick, or weights are too far apart, for the digits of the numbers; take a shorter tick, or \
                 weights that are nearer to each other"
            ),
            Self::Length { slice, length, expected } => {
                write!(f, "`{slice}` has {length} entries for {expected} ticks: give it one for each")
            }
        }
    }
}

impl Error for ControlError {}

#[cfg(test)]
mod tests {
    use super::ControlError;
    use std::string::ToString;

    #[test]
    fn messages_name_the_thing_the_evidence_and_the_way_out() {
        let cases = [
            (
                ControlError::NotFinite { argument: "a", value: f64::INFINITY },
                "`a` has the entry inf: check how it is computed",
            ),
            (
                ControlError::NotDefinite { matrix: "r", pivot: -1.0 },
                "`r` has to be positive definite, but a pivot of its factorization is -1.0: give every \
                 direction a positive weight or noise",
            ),
            (
                ControlError::Setting { setting: "kurtosis", value: f64::NAN, expected: "finite" },
                "`kurtosis` is NaN: it has to be finite",
            ),
            (
                ControlError::Bounds { input: 1, lower: 2.0, upper: -2.0 },
                "the bounds of input 1, 2.0 and -2.0, leave nothing between them: give the lower one first",
            ),
            (
                ControlError::TooFast { argument: "a dt", norm: 1e200 },
                "`a dt` has the norm 1.0e200, and modes that turn so fast without decaying have no digits left \
                 after a tick: take a shorter tick, or leave them out",
            ),
            (
                ControlError::NotStabilizable { iterations: 60, change: 0.5 },
                "there is no stationary regulator: after 60 doublings of the horizon it still grows (relative \
                 change 5.0e-1): a mode that does not decay, or too slowly to be told from one that does not, \
                 cannot be steered by the inputs or does not appear in the cost; leave it out of the state, or give \
                 it a weight",
            ),
            (
                ControlError::Residual { residual: 0.25 },
                "the solution of the Riccati equation leaves 2.5e-1 of it: too much grows within a tick, or \
                 weights are too far apart, for the digits of the numbers; take a shorter tick, or weights that are \
                 nearer to each other",
            ),
            (
                ControlError::Length { slice: "states", length: 3, expected: 4 },
                "`states` has 3 entries for 4 ticks: give it one for each",
            ),
        ];
        for (error, text) in cases {
            assert_eq!(error.to_string(), text);
        }
    }
}
