//! Why there are no derivatives of a motion.

use core::error::Error;
use core::fmt::{self, Display, Formatter};

use crate::IntegrationError;

/// Why a motion has no derivatives, or they could not be computed.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum SensitivityError {
    /// A column is to be taken by something that there is not.
    NoSuchColumn {
        /// What kind.
        what: &'static str,
        /// Its number, from 0.
        index: usize,
        /// How many there are.
        count: usize,
    },
    /// The system has position constraints to which states are returned, and the return is not differentiated: not by
    /// parameters, and by states not without `emit { return_jacobian }`.
    Returned,
    /// The motion only touches where an event function is zero, or crosses there by no more than rounding before it turns, so
    /// that the time of the event has no derivative.
    Grazing {
        /// The event.
        event: usize,
        /// When.
        time: f64,
        /// The rate of the event function along the motion, as a part of the size of its terms.
        rate: f64,
    },
    /// Events happen at one time, and their order, on which what follows depends, changes with the motion.
    Simultaneous {
        /// Two of them.
        events: [usize; 2],
        /// When.
        time: f64,
    },
    /// A slice has the wrong length.
    Length {
        /// Which.
        slice: &'static str,
        /// Its length.
        length: usize,
        /// What it has to be.
        expected: usize,
    },
    /// A number is infinite or not a number.
    NotFinite {
        /// What it is of.
        what: &'static str,
        /// The time.
        time: f64,
    },
    /// A step.
    Integration(IntegrationError),
}

impl Display for SensitivityError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoSuchColumn { what, index, count } => {
                write!(
                    f,
                    "a column is to be taken by number {index} of the {what}, of which there are {count}: count from 0"
                )
            }
            Self::Returned => write!(
                f,
                "the system has position constraints to which its states are returned, and the return is not \
                 differentiated: by states it is with `emit {{ jacobian, return_jacobian }}`; by parameters integrate \
                 `Variational`, or steps over `Jet` numbers, which contain the return"
            ),
            Self::Grazing { event, time, rate } => {
                write!(
                    f,
                    "at t = {time:?} the motion touches the zeros of the event function {event} and, but for rounding, does \
                     not cross them, so that the time of the event has no derivative: "
                )?;
                // of one term it is all, however small that is
                if rate.abs() < 1e-6 {
                    write!(f, "it changes at {rate:.1e} of the size of its terms")
                } else {
                    f.write_str("its rate turns within the time in which it is rounding")
                }
            }
            Self::Simultaneous { events: [first, second], time } => write!(
                f,
                "the events {first} and {second} happen together at t = {time:?}: what follows depends on their order, and \
                 has no derivative"
            ),
            Self::Length { slice, length, expected } => {
                write!(f, "the slice `{slice}` has {length} entries, but has to have {expected}")
            }
            Self::NotFinite { what, time } => {
                write!(
                    f,
                    "the {what} at t = {time:?} is not finite: look at the state there, and at the cost"
                )
            }
            Self::Integration(error) => error.fmt(f),
        }
    }
}

impl Error for SensitivityError {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        match self {
            Self::Integration(error) => error.source(),
            _ => None,
        }
    }
}

impl From<IntegrationError> for SensitivityError {
    fn from(error: IntegrationError) -> Self {
        Self::Integration(error)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::format;

    #[test]
    fn a_rate_of_one_term_is_not_said_to_be_small() {
        let told = |rate| format!("{}", SensitivityError::Grazing { event: 0, time: 2.0, rate });
        assert!(told(1e-17).ends_with("it changes at 1.0e-17 of the size of its terms"));
        assert!(told(-1.0).ends_with("its rate turns within the time in which it is rounding"));
    }
}
