//! Why there is no linearisation.

use core::error::Error;
use core::fmt::{self, Display, Formatter};

/// Why a motion could not be linearised in the variables that are kept.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum LinearizationError {
    /// The motion at the state, or what it is made of, is not finite.
    NotFinite,
    /// A rate, an output or a constraint is finite at the state, but its derivatives are not.
    NotDifferentiable {
        /// The variable whose rate that is, the output or the constraint.
        of: &'static str,
    },
    /// The state is not on the manifold of all constraints.
    OffConstraints {
        /// The constraint, or the identity of the base.
        constraint: &'static str,
        /// What is left of it.
        residual: f64,
    },
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
            Self::NotDifferentiable { of } => write!(
                f,
                "`{of}` has no finite derivatives at this state, though it has a value: it may take the root, or a power, of \
                 a variable or a parameter that is 0; linearise at another state, or with another parameter"
            ),
            Self::OffConstraints { constraint, residual } => write!(
                f,
                "the state does not satisfy `{constraint}`, of which {residual:?} is left: `project` it to the constraints \
                 first"
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
