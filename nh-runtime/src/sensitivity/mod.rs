//! Derivatives of motions: by their start, by inputs and by parameters; forwards, backwards and across events.
//!
//! | wanted | from | derivative of |
//! |---|---|---|
//! | how everything depends on few numbers: identification, error propagation | [`Variational`] with an adaptive method | the exact motion, to a tolerance of its own |
//! | the same, to be exact for a run that was made | [`Variational`] with an explicit method and [`ColumnTolerance::of_state`]; [`Variational::advance`] with an implicit one | the steps that are taken, to round-off |
//! | how one number depends on everything: optimisation | [`Adjoint`] | the steps that are taken, to round-off |
//! | one step of that | [`Fixed::linearized_step`](crate::methods::Fixed::linearized_step), [`Fixed::pulled_back_step`](crate::methods::Fixed::pulled_back_step) | the step |
//! | the same where a ball bounces | [`advance_across`], [`Crossing`] | the exact motion, or the steps |
//!
//! Everything rests on the system's [`Jacobian`](crate::Jacobian), `emit { jacobian, parameter_jacobian }`. Nothing
//! allocates or panics, and what has no derivative is a [`SensitivityError`]. A system that is declared with a type
//! parameter for its numbers has the derivatives of its steps without any of this, by taking them in
//! [`Jet`](crate::Jet)s: `Rk4::step(&system, t, dt, &state, &input)`, whose one return to position constraints is then
//! differentiated, too.

mod across;
mod adjoint;
mod checkpoints;
mod column_tolerance;
mod crossing;
mod motion;
mod no_derivative;
mod pull_back;
mod stack;
mod steps;

pub use across::{Jumped, Jumps, advance_across};
pub use adjoint::{Adjoint, Gradient, Objective, Slope};
pub use checkpoints::Checkpoint;
pub use column_tolerance::ColumnTolerance;
pub use crossing::{AfterEvent, Crossing};
pub use motion::{By, NoParameters, Variational, WithColumns};
pub use no_derivative::SensitivityError;
pub use pull_back::PulledBack;
pub use stack::{Columns, Stack, Stacked};
pub use steps::LinearizedStep;
