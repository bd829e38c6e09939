//! Why there is no linearisation.

use core::error::Error;
use core::fmt::{self, Display, Formatter};

/// Why a motion could not be linearised in the variables that are kept.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum LinearizationError {
    /// The derivatives at the state are not finite.
    NotFinite,
    /// A kept variable follows from other kept ones by the constraints.
    NotFree {
        /// The variable.
        kept: &'static str,
    },
    /// The rate of a kept variable changes with a variable that is not kept.
    DependsOnOthers {
        /// The kept variable.
        kept: &'static str,
        /// The other one.
        other: &'static str,
        /// The derivative of that rate by it.
        value: f64,
    },
}

impl Display for LinearizationError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match *self {
            Self::NotFinite => write!(
                f,
                "the derivatives are not finite at this state: the mass matrix or the constraints may be singular"
            ),
            Self::NotFree { kept } => write!(
                f,
                "`{kept}` follows from the other variables that are kept by the constraints at this state: keep fewer"
            ),
            Self::DependsOnOthers { kept, other, value } => write!(
                f,
                "the rate of `{kept}` changes with `{other}`, which is not kept, by {value:?}: keep that as well"
            ),
        }
    }
}

impl Error for LinearizationError {}
