//! Why a machine could not be assembled.

use core::error::Error;
use core::fmt::{self, Display, Formatter};

use crate::newton_return::worst;
use crate::{Real, StateFault};

/// Why a machine could not be assembled: what `assemble` and `assemble_holding` of a system with `holonomic` give.
///
/// Residuals have the units of their constraints, left-hand side less right-hand side.
///
/// ```
/// use nonholonomic::AssemblyError;
/// use nonholonomic::prelude::*;
///
/// #[nonholonomic(
///     base { x, y }
///     holonomic { rope: x^2 + y^2 = l^2; }
///     lagrangian { m / 2 * (der(x)^2 + der(y)^2) - m * g * y }
/// )]
/// #[derive(Clone, Copy, Debug)]
/// struct Pendulum { m: f64, l: f64, g: f64 }
///
/// let pendulum = Pendulum { m: 1.0, l: 0.5, g: 9.81 };
/// let guess = PendulumState { x: 0.3, y: -1.0, ..Default::default() };
/// let start = pendulum.assemble_holding(0.0, &guess, &[PendulumCoordinate::x])?;
/// assert!((start.y + 0.4).abs() < 1e-15);
///
/// // farther out than the rope is long
/// let guess = PendulumState { x: 0.6, ..guess };
/// let error = pendulum.assemble_holding(0.0, &guess, &[PendulumCoordinate::x]).unwrap_err();
/// assert!(matches!(error, AssemblyError::NoSolution { constraint: "rope", .. }));
/// # Ok::<(), AssemblyError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum AssemblyError {
    /// The guess is infinite or not a number.
    NonFiniteGuess {
        /// The first such component.
        component: &'static str,
        /// Its value.
        value: f64,
    },
    /// A constraint has no value where the search is.
    NoValue {
        /// The constraint.
        constraint: &'static str,
        /// Its value: infinite, or not a number.
        value: f64,
    },
    /// The coordinates that are held leave more than the constraints determine.
    TooFewHeld {
        /// How many of those that the constraints depend on are held.
        held: usize,
        /// How many have to be.
        needed: usize,
    },
    /// The coordinates that are held leave less than the constraints need.
    TooManyHeld {
        /// How many of those that the constraints depend on are held.
        held: usize,
        /// How many may be.
        permitted: usize,
    },
    /// No positions satisfy the constraints near the guess.
    NoSolution {
        /// The constraint with the largest residual where the search ended.
        constraint: &'static str,
        /// That residual.
        residual: f64,
    },
    /// The constraints are dependent at a configuration that the search came to, or the coordinates that are held
    /// do not determine the others there.
    Singular {
        /// The constraint with the largest residual there.
        constraint: &'static str,
        /// That residual.
        residual: f64,
    },
    /// There are positions with the given values of the coordinates that are held, but they belong to another branch
    /// than the guess.
    OtherBranch {
        /// The coordinate that is farthest from the guess there.
        coordinate: &'static str,
        /// Its value there.
        value: f64,
    },
    /// Positions were found, but no velocities that satisfy the constraints, with the given rates of the coordinates
    /// that are held.
    Velocities {
        /// The constraint with the largest residual.
        constraint: &'static str,
        /// That residual.
        residual: f64,
    },
}

impl Display for AssemblyError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match *self {
            Self::NonFiniteGuess { component, value } => {
                write!(f, "the component `{component}` of the guess is {value:?}: give finite numbers")
            }
            Self::NoValue { constraint, value } => write!(
                f,
                "`{constraint}` is {value:?} there: the time or a parameter may be no number, or the guess is where it \
                 has no value: give finite ones, or guess elsewhere"
            ),
            Self::TooFewHeld { held, needed } => write!(
                f,
                "of the coordinates that the position constraints depend on {held} are held, which leaves others \
                 free to move: hold {needed}, or none with `assemble`"
            ),
            Self::TooManyHeld { held, permitted } => write!(
                f,
                "of the coordinates that the position constraints depend on {held} are held, and the others cannot \
                 satisfy these: hold {permitted}"
            ),
            Self::NoSolution { constraint, residual } => write!(
                f,
                "no positions were found: `{constraint}` is left with {residual:?}; the parts may not reach each \
                 other there: hold other values, or guess nearer to a solution"
            ),
            Self::Singular { constraint, residual } => write!(
                f,
                "the search came to a configuration where the constraints do not determine where to go, with \
                 {residual:?} left in `{constraint}`: guess positions to one side of it, or hold other coordinates"
            ),
            Self::OtherBranch { coordinate, value } => write!(
                f,
                "the positions that were found are on another branch than the guess, with `{coordinate}` at \
                 {value:?}: guess that if it is meant, else hold other values"
            ),
            Self::Velocities { constraint, residual } => write!(
                f,
                "the positions were found, but no velocities: `{constraint}` is left with {residual:?}; the given \
                 rates may contradict the constraints, or not determine the motion there"
            ),
        }
    }
}

impl Error for AssemblyError {}

/// The largest residual.
fn named<T: Real, const M: usize>(left: &[T; M], names: &[&'static str; M]) -> StateFault {
    let mut pairs = names.iter().zip(left);
    worst([(); M].map(|()| pairs.next().map_or(("", T::ZERO), |(name, left)| (*name, *left))))
}

/// Where a search ended without a solution.
pub(super) fn no_solution<T: Real, const M: usize>(
    left: &[T; M],
    names: &[&'static str; M],
) -> AssemblyError {
    let StateFault { identity, residual } = named(left, names);
    without_value(identity, residual).unwrap_or(AssemblyError::NoSolution { constraint: identity, residual })
}

/// Where it does not know where to go.
pub(super) fn singular<T: Real, const M: usize>(left: &[T; M], names: &[&'static str; M]) -> AssemblyError {
    let StateFault { identity, residual } = named(left, names);
    without_value(identity, residual).unwrap_or(AssemblyError::Singular { constraint: identity, residual })
}

/// That a residual is none.
fn without_value(constraint: &'static str, value: f64) -> Option<AssemblyError> {
    (!value.is_finite()).then_some(AssemblyError::NoValue { constraint, value })
}
