//! Building blocks of controllers and estimators for systems with emitted Jacobians.
//!
//! | block | what it does |
//! |---|---|
//! | [`zero_order_hold`] | discretises a linear system whose input is constant over a tick |
//! | [`Regulator`] | the gain of linear-quadratic regulation: stationary, or one step of a finite horizon |
//! | [`Estimate`] | one step of an extended Kalman filter |
//! | [`Unscented`] | one step of an unscented Kalman filter |
//! | [`Ilqr`] | optimal inputs over a horizon, between bounds; model predictive control |
//! | [`Sampled`] | a declared system in discrete time, with exact derivatives of the step: a [`Model`] |
//! | [`Quadratic`], [`Squares`] | costs: diagonal weights; or any residuals, differentiated by jets |
//! | [`shooting_gradient`] | the cost of a sequence of inputs with its exact gradient, for any optimiser |
//!
//! They take and return the matrices of `nalgebra`, as `jacobian` does, for `f32`, `f64` and [`Fast`](crate::Fast) of
//! them. Nothing allocates, nothing panics, every loop is bounded, and what cannot be computed is a
//! [`ControlError`]. The factorizations are the crate's own: those of `nalgebra` ask for elementary
//! functions that it does not have without an operating system.
//!
//! A regulator for a body on a knife edge that is to keep its heading:
//!
//! ```
//! use nh_runtime::control::{ControlError, Regulator, zero_order_hold};
//! use nalgebra::{Matrix2, Vector2, matrix, vector};
//!
//! # fn main() -> Result<(), ControlError> {
//! // θ̇ = ω, ω̇ = −0.2 ω + 2 torque, sampled at 50 Hz
//! let (a, b) = zero_order_hold(&matrix![0.0, 1.0; 0.0, -0.2], &vector![0.0, 2.0], 0.02)?;
//! let regulator = Regulator::stationary(&a, &b, &Matrix2::identity(), &matrix![0.1])?;
//! let mut deviation = Vector2::new(0.3, 0.0);
//! for _ in 0..600 {
//!     deviation = a * deviation + b * regulator.input(&deviation);
//! }
//! assert!(deviation.norm() < 1e-4);
//! # Ok(())
//! # }
//! ```

mod box_quadratic;
mod cholesky;
mod error;
mod hold;
mod horizon;
mod ilqr;
mod kalman;
mod regulator;
mod sampled;
mod shooting;
mod squares;
mod unscented;

use nalgebra::{ClosedAddAssign, ClosedMulAssign, ClosedSubAssign, SMatrix};
use num_traits::{One, Zero};

pub use error::ControlError;
pub use hold::zero_order_hold;
pub use horizon::{Cost, Expansion, Model, Quadratic};
pub use ilqr::{Ilqr, Improvement};
pub use kalman::{Correction, Estimate};
pub use regulator::Regulator;
pub use sampled::Sampled;
pub use shooting::{shooting_cost, shooting_gradient};
pub use squares::{Residuals, Squares};
pub use unscented::Unscented;

use crate::Real;

/// A number that matrices of `nalgebra` can be multiplied with: `f32`, `f64`, [`Fast`](crate::Fast) of them.
///
/// Implemented for every [`Real`] that has the traits of `nalgebra`'s arithmetic.
pub trait Entry: Real + ClosedAddAssign + ClosedSubAssign + ClosedMulAssign + Zero + One {}
impl<T: Real + ClosedAddAssign + ClosedSubAssign + ClosedMulAssign + Zero + One> Entry for T {}

/// The largest sum of absolute values in a column: the norm that the vector norm Σ|x_i| induces.
pub(crate) fn norm<T: Entry, const N: usize, const M: usize>(a: &SMatrix<T, N, M>) -> T {
    a.column_iter().fold(T::ZERO, |largest, column| {
        let sum = column.iter().fold(T::ZERO, |sum, x| sum + crate::Scalar::abs(*x));
        if sum > largest || !sum.is_finite() { sum } else { largest }
    })
}

/// The mean of a matrix and its transpose: what round-off leaves of a symmetric matrix.
pub(crate) fn symmetrized<T: Entry, const N: usize>(a: &SMatrix<T, N, N>) -> SMatrix<T, N, N> {
    // halved first: a sum of two large numbers overflows
    let half = a * T::from_f64(0.5);
    half + half.transpose()
}

/// Refuses a matrix with an entry that is infinite or not a number.
pub(crate) fn finite<T: Entry, const N: usize, const M: usize>(
    argument: &'static str,
    a: &SMatrix<T, N, M>,
) -> Result<(), ControlError> {
    match a.iter().find(|x| !crate::Scalar::is_finite(**x)) {
        None => Ok(()),
        Some(x) => Err(ControlError::NotFinite { argument, value: x.to_f64() }),
    }
}
