//! What can be wrong with parameters, inputs and states, with the numbers that show it and a way out.

use core::error::Error;
use core::fmt::{self, Display, Formatter};

/// A parameter that a system cannot be integrated with.
///
/// ```
/// use nonholonomic::{ParameterError, ParameterFault};
///
/// let error = ParameterError {
///     parameter: "m",
///     value: -1.0,
///     fault: ParameterFault::Assumption { text: "m > 0" },
/// };
/// assert_eq!(
///     error.to_string(),
///     "the parameter `m` is -1.0, but the declaration assumes `m > 0`: \
///      give a value that satisfies it, or change the assumption"
/// );
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ParameterError {
    /// The parameter as it is written in the declaration: `m`, `I[0][1]`.
    pub parameter: &'static str,
    /// Its value.
    pub value: f64,
    /// What is wrong with it.
    pub fault: ParameterFault,
}

/// What is wrong with a parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum ParameterFault {
    /// It is infinite or not a number.
    NotFinite,
    /// It breaks an assumption of the declaration.
    Assumption {
        /// The assumption as it is written there.
        text: &'static str,
    },
    /// It is an entry of a symmetric matrix, and differs from the entry opposite.
    NotSymmetric {
        /// The entry opposite.
        opposite: &'static str,
    },
    /// It makes an expression zero that the equations divide by.
    ZeroPivot {
        /// The expression.
        expression: &'static str,
    },
}

impl Display for ParameterError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self { parameter, value, fault } = self;
        write!(f, "the parameter `{parameter}` is {value:?}, but ")?;
        match fault {
            ParameterFault::NotFinite => {
                write!(f, "parameters have to be finite: check how it is computed")
            }
            ParameterFault::Assumption { text } => write!(
                f,
                "the declaration assumes `{text}`: give a value that satisfies it, or change the \
                 assumption"
            ),
            ParameterFault::NotSymmetric { opposite } => write!(
                f,
                "the matrix is declared symmetric, and `{opposite}` is another number: give both the same"
            ),
            ParameterFault::ZeroPivot { expression } => write!(
                f,
                "the equations divide by `{expression}`, which it makes zero: give another value, \
                 or choose other velocities with `independent {{ … }}`"
            ),
        }
    }
}

impl Error for ParameterError {}

/// An input that a system cannot be integrated with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InputFault {
    /// The input as it is written in the declaration.
    pub input: &'static str,
    /// Its value, which is not finite.
    pub value: f64,
}

impl Display for InputFault {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self { input, value } = self;
        write!(f, "the input `{input}` is {value:?}: give finite numbers")
    }
}

impl Error for InputFault {}

/// A state that a system cannot start from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StateFault {
    /// The identity that it does not satisfy, as it is written in the declaration.
    pub identity: &'static str,
    /// Left-hand side less right-hand side.
    pub residual: f64,
}

impl Display for StateFault {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self { identity, residual } = self;
        write!(f, "the given state does not satisfy `{identity}`, by {residual:?}: normalize it first")
    }
}

impl Error for StateFault {}

/// A state that could not be moved to the constraint manifold, or to the level of the invariants.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProjectionError {
    /// The iterations done.
    pub iterations: u32,
    /// The largest residual of a constraint or invariant that was left.
    pub residual: f64,
}

impl Display for ProjectionError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self { iterations, residual } = self;
        write!(
            f,
            "the projection left a residual of {residual:?} after {iterations} iterations: the state is too \
             far from the constraints, or from the level of the invariants, or these are dependent there; \
             start nearer to them, or take smaller steps; past a place where they are dependent, as where all links \
             are in line, longer steps"
        )
    }
}

impl Error for ProjectionError {}
