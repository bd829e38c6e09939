//! Building blocks of controllers and estimators for systems with emitted Jacobians.
//!
//! | block | what it does |
//! |---|---|
//! | [`zero_order_hold`] | discretises a linear system whose input is constant over a tick |
//! | [`held_noise`] | the covariance that white noise adds over a tick |
//! | [`Regulator`] | the gain of linear-quadratic regulation: stationary, or one step of a finite horizon |
//! | [`Estimate`] | one step of an extended Kalman filter |
//! | [`Unscented`] | one step of an unscented Kalman filter |
//! | [`Ilqr`] | optimal inputs over a horizon, between bounds; model predictive control |
//! | [`Sampled`] | a declared system in discrete time, with exact derivatives of the step: a [`Model`] |
//! | [`Quadratic`], [`Squares`] | costs: diagonal weights; or any residuals, differentiated by jets |
//! | [`angle_difference`] | the difference of two angles, the short way round |
//! | [`shooting_gradient`] | the cost of a sequence of inputs with its exact gradient, for any optimiser |
//!
//! They take and return the matrices of `nalgebra`, as `jacobian` does, for `f32`, `f64` and [`Fast`](crate::Fast) of
//! them. Nothing allocates, nothing panics, every loop is bounded, and what cannot be computed is a
//! [`ControlError`]. The factorizations are the crate's own: those of `nalgebra` ask for elementary
//! functions that it does not have without an operating system.
//!
//! # From a declaration to a loop
//!
//! 1. **Declare** the system with its `inputs` and `emit { jacobian }`. What the controller neither sees nor weighs
//!    is left out of its model by `track { … }`: a mode that does not decay and costs nothing has no stationary
//!    regulator.
//! 2. **Linearise** where the system should be, `jacobian(t, &state, &input)`, and discretise; along a trajectory
//!    take `Rk4::linearized_step` of every tick and iterate [`Regulator::before`] backwards.
//! 3. **Weigh** by names: a generated state becomes the vector of a diagonal. A weight is one over the square of
//!    the deviation that matters.
//! 4. **Estimate**: predict with the tick's own derivative, correct with what a sensor shows. The derivative of a
//!    measurement is that of its formula; for one that is awkward to differentiate take [`Unscented`].
//! 5. **Refuse** what is wrong and go on: an error leaves the estimate as it was, and a surprising measurement
//!    is one to leave out.
//!
//! A pole on a cart, balanced from noisy readings of the cart's place:
//!
//! ```
//! use nalgebra::{SMatrix, SVector, matrix, vector};
//! use nonholonomic::control::{Estimate, Regulator, held_noise, zero_order_hold};
//! use nonholonomic::prelude::*;
//!
//! /// A pole on a cart; the state is named `place, tilt, place_dot, tilt_dot`.
//! #[nonholonomic(
//!     base       { place, tilt }
//!     lagrangian {
//!         cart / 2 * der(place)^2 + pole / 2 * (der(place) + l * der(tilt) * cos(tilt))^2
//!             + pole / 2 * (l * der(tilt) * sin(tilt))^2 - pole * g * l * cos(tilt)
//!     }
//!     forces     { place: push; }
//!     inputs     { push }
//!     assume     { cart > 0; pole > 0; l > 0; }
//!     emit       { jacobian }
//! )]
//! #[derive(Clone, Copy, Debug)]
//! struct Balance { cart: f64, pole: f64, l: f64, g: f64 }
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! const TICK: f64 = 0.01;
//! let model = Balance { cart: 1.0, pole: 0.2, l: 0.5, g: 9.81 };
//! model.validate()?;
//! let upright = BalanceState::default();
//! let (a, b) = model.jacobian(0.0, &upright, &BalanceInput::default());
//! let (step, reach) = zero_order_hold(&a, &b, TICK)?;
//! let weights = BalanceState { place: 10.0, tilt: 50.0, place_dot: 1.0, tilt_dot: 1.0 };
//! let q = SMatrix::<f64, 4, 4>::from_diagonal(&weights.into());
//! let regulator = Regulator::stationary(&step, &reach, &q, &matrix![0.1])?;
//!
//! // gusts: white noise on the push
//! let noise = held_noise(&a, &(b * b.transpose() * 1e-3), TICK)?;
//! let mut belief = Estimate { mean: SVector::zeros(), covariance: SMatrix::<f64, 4, 4>::identity() * 0.01 };
//! let mut real = BalanceState { place: 0.1, tilt: 0.1, ..upright };
//! for tick in 0..1000 {
//!     // a sensor of the place, two millimetres off, and broken at times
//!     let seen = if tick % 50 == 7 { f64::NAN } else { real.place + [0.002, -0.002, 0.0][tick % 3] };
//!     let innovation = vector![seen - belief.mean[0]];
//!     match belief.corrected(&innovation, &matrix![1.0, 0.0, 0.0, 0.0], &matrix![4e-6]) {
//!         // what happens once in a million ticks is not believed
//!         Ok(seen) if seen.surprise < 24.0 => belief = seen.estimate,
//!         Ok(_) | Err(_) => {}
//!     }
//!     let push = regulator.input(&belief.mean)[0].clamp(-20.0, 20.0);
//!     let input = BalanceInput { push };
//!     let ahead = Rk4::linearized_step(&model, 0.0, TICK, &belief.mean.into(), &input);
//!     belief = belief.predicted(ahead.state.into(), &ahead.by_state, &noise)?;
//!     real = Rk4::step(&model, 0.0, TICK, &real, &input);
//! }
//! assert!(real.tilt.abs() < 0.02 && real.place.abs() < 0.02, "{real:?}");
//! # Ok(())
//! # }
//! ```
//!
//! A deviation of angles is taken by [`angle_difference`]. The gain of a stationary filter is the transpose of that
//! of [`Regulator::stationary`] for the transposed matrices, with the covariances in the place of the weights.

mod balance;
mod box_quadratic;
mod cholesky;
#[cfg(test)]
mod draws;
mod fault;
mod hold;
mod horizon;
mod ilqr;
mod kalman;
mod noise;
mod regularization;
mod regulator;
mod sampled;
mod shooting;
mod square_root;
mod squares;
mod unscented;

use nalgebra::{ClosedAddAssign, ClosedMulAssign, ClosedSubAssign, SMatrix};
use num_traits::{One, Zero};

pub use fault::ControlError;
pub use hold::zero_order_hold;
pub use horizon::{Cost, Expansion, Model, Quadratic};
pub use ilqr::{Ilqr, Improvement};
pub use kalman::{Correction, Estimate};
pub use noise::held_noise;
pub use regulator::Regulator;
pub use sampled::Sampled;
pub use shooting::{shooting_cost, shooting_gradient};
pub use squares::{Residuals, Squares};
pub use unscented::Unscented;

use crate::{Real, Scalar};

/// A number that matrices of `nalgebra` can be multiplied with: `f32`, `f64`, [`Fast`](crate::Fast) of them.
///
/// Implemented for every [`Real`] that has the traits of `nalgebra`'s arithmetic.
pub trait Entry: Real + ClosedAddAssign + ClosedSubAssign + ClosedMulAssign + Zero + One {}
impl<T: Real + ClosedAddAssign + ClosedSubAssign + ClosedMulAssign + Zero + One> Entry for T {}

/// a − b of two angles, the short way round: in [−π, π].
///
/// For what a filter or a regulator calls a difference, where a heading may have passed π. If a − b is not finite
/// the result is NaN, which filters refuse.
///
/// ```
/// use nonholonomic::control::angle_difference;
///
/// assert!((angle_difference(3.1, -3.1) - (6.2 - core::f64::consts::TAU)).abs() < 1e-15);
/// ```
#[inline]
#[must_use]
pub fn angle_difference<T: Scalar>(a: T, b: T) -> T {
    let (sin, cos) = (a - b).sin_cos();
    sin.atan2(cos)
}

/// The largest sum of absolute values in a column: the norm that the vector norm Σ|x_i| induces.
pub(crate) fn norm<T: Entry, const N: usize, const M: usize>(a: &SMatrix<T, N, M>) -> T {
    a.column_iter().fold(T::ZERO, |largest, column| {
        let sum = column.iter().fold(T::ZERO, |sum, x| sum + Scalar::abs(*x));
        if sum > largest || !sum.is_finite() { sum } else { largest }
    })
}

/// The mean of a matrix and its transpose: what round-off leaves of a symmetric matrix.
pub(crate) fn symmetrized<T: Entry, const N: usize>(a: &SMatrix<T, N, N>) -> SMatrix<T, N, N> {
    // halved first: a sum of two large numbers overflows
    let half = a * T::from_f64(0.5);
    half + half.transpose()
}

/// a aᵀ.
pub(crate) fn squares<T: Entry, const N: usize, const M: usize>(a: &SMatrix<T, N, M>) -> SMatrix<T, N, N> {
    a * a.transpose()
}

/// Refuses a matrix with an entry that is infinite or not a number.
pub(crate) fn finite<T: Entry, const N: usize, const M: usize>(
    argument: &'static str,
    a: &SMatrix<T, N, M>,
) -> Result<(), ControlError> {
    match a.iter().find(|x| !Scalar::is_finite(**x)) {
        None => Ok(()),
        Some(x) => Err(ControlError::NotFinite { argument, value: x.to_f64() }),
    }
}
