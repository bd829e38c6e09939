//! Allocation-free integration of nonholonomic systems.
//!
//! A system is anything that implements [`Dynamics`]: the attribute macro `#[nonholonomic]` (see the
//! reference of its language there) writes the implementation from a declaration, and a few lines write
//! it by hand. An [`Integrator`] carries
//! the state of such a system through time with one of the [`methods`].
//!
//! ```
//! use nonholonomic::prelude::*;
//! use nonholonomic::D;
//!
//! /// A mathematical pendulum of length `l` (m) in a field `g` (m/s²).
//! #[derive(Clone, Copy)]
//! struct Pendulum { g: f64, l: f64 }
//!
//! #[derive(Clone, Copy, Debug, PartialEq)]
//! struct PendulumState { theta: f64, omega: f64 }
//!
//! impl State for PendulumState {
//!     type Scalar = f64;
//!     type Dim = D<2>;
//!     fn to_array(&self) -> [f64; 2] { [self.theta, self.omega] }
//!     fn from_array([theta, omega]: [f64; 2]) -> Self { Self { theta, omega } }
//!     fn names() -> [&'static str; 2] { ["theta", "omega"] }
//! }
//!
//! impl Dynamics for Pendulum {
//!     type State = PendulumState;
//!     type Input = ();
//!     fn derivative(&self, _t: f64, x: &PendulumState, (): &()) -> PendulumState {
//!         PendulumState { theta: x.omega, omega: -self.g / self.l * x.theta.sin() }
//!     }
//! }
//!
//! # fn main() -> Result<(), IntegrationError> {
//! let start = PendulumState { theta: 1.0, omega: 0.0 };
//! let mut sim = Integrator::new(Pendulum { g: 9.81, l: 1.0 }, Dopri5::new().rtol(1e-10), 0.0, start);
//! sim.advance_to(2.0)?;
//! println!("{:?} at t = {}", sim.state(), sim.time());
//! # Ok(())
//! # }
//! ```
//!
//! # Features
//!
//! | feature | meaning |
//! |---|---|
//! | `std` (default) | elementary functions from the platform |
//! | `libm` | elementary functions from the `libm` crate, for targets without `std`; sine and cosine of `f32` in single precision alone, by the kernel of [`Fast`] |
//! | `macros` (default) | re-exports `#[nonholonomic]` |
//! | `serde` | generated states can be serialized |
//! | `rayon` | batches of rollouts on all cores; needs `std` |
//! | `wide` | `f64x4` and `f32x8` of the crate `wide` as scalars: four or eight states at once |
//!
//! The crate is `no_std` with or without them, allocates nothing, contains no `unsafe` and has no
//! code path that panics.
#![no_std]
#![cfg_attr(docsrs, feature(doc_cfg))]

#[cfg(any(feature = "std", test))]
extern crate std;

#[cfg(not(any(feature = "std", feature = "libm")))]
compile_error!(
    "nonholonomic needs a source of sin, sqrt and the other elementary functions: enable its feature \
     `std` on a target with an operating system, or `libm` on one without"
);

mod angle_cache;
mod arrays;
mod assembly;
pub mod batch;
mod close_angle;
mod complex;
pub mod control;
mod dense;
mod dim;
mod discrete_lagrangian;
mod dynamics;
mod elementary;
pub mod ensemble;
mod error;
mod events;
mod fast;
#[cfg(feature = "macros")]
pub mod guide;
mod held;
mod holders;
pub mod impacts;
mod inclusion;
mod integration_error;
mod integrator;
mod jet;
mod kept_parameters;
mod lanes;
mod linear;
mod linear_model;
pub mod methods;
mod near_return;
mod newton_return;
#[cfg(test)]
mod pair;
pub mod prelude;
mod prepared;
mod projection;
mod reduction;
mod rounding;
mod scalar;
pub mod sensitivity;
mod serde_impls;
mod series;
mod sine;
mod slopes_of_return;
mod statistics;
mod step_control;
mod stiffness;
mod stop;
mod tangent;
mod tolerance;
mod trajectory;
mod trim;
#[doc(hidden)]
pub mod unasked;

pub use angle_cache::{Angle, AngleCache, AngleCached};
pub use assembly::AssemblyError;
pub use dense::DenseOutput;
pub use dim::{D, Dim};
pub use discrete_lagrangian::DiscreteLagrangian;
pub use dynamics::TaylorSeries;
pub use dynamics::{
    AlmostPoisson, Constrained, DimOf, Dynamics, Energy, EulerPoincareSuslov, Invariants, Jacobian, Leapfrog,
    MatOf, Observed, RowsByInput, ScalarOf, State, VecOf,
};
pub use error::{InputFault, ParameterError, ParameterFault, ProjectionError, StateFault};
pub use events::{Event, Events, Simultaneous};
pub use fast::Fast;
pub use held::{Held, Holding};
pub use inclusion::{Inclusion, NotInMode};
pub use integration_error::IntegrationError;
pub use integrator::Integrator;
pub use jet::Jet;
pub use lanes::Lanes;
pub use linear_model::{Linearization, LinearizationError};
pub use methods::Taylor;
pub use methods::{
    Auto, Bs23, Conserving, Controller, DiscreteGradient, DiscreteSuslov, Dop853, Dopri5, Euler,
    GaussLegendre4, GaussLegendre6, Heun, ImplicitMidpoint, Method, Projected, Radau5, Ralston, Rattle,
    ReflectedLeapfrog, Rk4, Rodas5P, Tsit5, Vern9,
};
pub use prepared::{Prepare, Prepared};
pub use reduction::{ByStages, Reconstructed, Reconstruction, Reduction};
pub use scalar::{Real, Scalar};
pub use statistics::Statistics;
pub use stop::Direction;
pub use tangent::{ChartError, OnConstraints, linearize_on_constraints};
pub use trajectory::{Buffer, RecordingError, Segment, Trajectory};
pub use trim::TrimError;

/// # Examples
///
/// A body on a knife edge, driven and braked. The state keeps the velocities `omega` and `v1`; the
/// constraint removes `v2`, and its multiplier is the force on the edge.
///
/// ```
/// use nonholonomic::prelude::*;
///
/// /// A rigid body on a plane, carried by a knife edge (Chaplygin sleigh).
/// #[nonholonomic(
///     base   { theta, x, y }
///     basis  { omega, v1, v2 }
///     anchor {
///         der(theta) = omega;
///         der(x) = v1 * cos(theta) - v2 * sin(theta);
///         der(y) = v1 * sin(theta) + v2 * cos(theta);
///     }
///     lagrangian  { J / 2 * omega^2 + m / 2 * (v1^2 + (v2 + a * omega)^2) }
///     constraints { edge: v2 = 0; }
///     forces      { omega: torque - c * omega; }
///     inputs      { torque }
///     outputs     { speed = sqrt(v1^2 + v2^2); }
///     assume      { m > 0; J > 0; }
///     emit        { multipliers, jacobian }
/// )]
/// #[derive(Clone, Copy, Debug)]
/// pub struct Sleigh { pub m: f64, pub J: f64, pub a: f64, pub c: f64 }
///
/// # fn main() -> Result<(), Box<dyn core::error::Error>> {
/// let sleigh = Sleigh { m: 1.0, J: 0.5, a: 0.3, c: 0.0 };
/// let start = SleighState { theta: 0.0, x: 0.0, y: 0.0, omega: 1.0, v1: 0.5 };
/// let mut sim = Integrator::new(sleigh, Dopri5::new().rtol(1e-10), 0.0, start);
/// sim.advance_to(5.0)?;
/// // without friction and torque the energy stays
/// let energy = sleigh.energy(sim.time(), sim.state());
/// assert!((energy - sleigh.energy(0.0, &start)).abs() < 1e-9);
///
/// let push = SleighInput { torque: 0.1 };
/// sim.set_input(push);
/// sim.advance_to(10.0)?;
/// let (t, state) = (sim.time(), sim.state());
/// assert!(sleigh.outputs(t, state, &push).speed > 0.5);
/// let edge = sleigh.multipliers(t, state, &push).edge;
/// let rates = sleigh.derivative(t, state, &push);
/// // the sideways acceleration of the centre of mass, times the mass
/// assert!((edge - (state.v1 * state.omega + 0.3 * rates.omega)).abs() < 1e-12);
/// let (_by_state, by_input) = sleigh.jacobian(t, state, &push);
/// assert!((by_input[(3, 0)] - 1.0 / (0.5 + 0.3 * 0.3)).abs() < 1e-12);
///
/// let wrong = Sleigh { m: -1.0, ..sleigh };
/// assert_eq!(
///     wrong.validate().unwrap_err().to_string(),
///     "the parameter `m` is -1.0, but the declaration assumes `m > 0`: \
///      give a value that satisfies it, or change the assumption",
/// );
/// # Ok(())
/// # }
/// ```
///
/// Reduced to a Lie algebra: there is no base, and the brackets are those of the plane's rigid motions.
///
/// ```
/// # use nonholonomic::prelude::*;
/// #[nonholonomic(
///     basis       { omega, v1, v2 }
///     brackets se(2) { omega, v1, v2 }
///     lagrangian  { J / 2 * omega^2 + m / 2 * (v1^2 + (v2 + a * omega)^2) }
///     constraints { v2 = 0; }
/// )]
/// #[derive(Clone, Copy, Debug)]
/// struct ReducedSleigh { m: f64, J: f64, a: f64 }
///
/// let sleigh = ReducedSleigh { m: 1.0, J: 0.5, a: 0.3 };
/// let rates = sleigh.derivative(0.0, &ReducedSleighState { omega: 2.0, v1: 0.5 }, &());
/// assert!((rates.v1 - 0.3 * 2.0 * 2.0).abs() < 1e-15);
/// assert!(ReducedSleigh::REPORT.contains("a Lie algebra"));
/// ```
///
/// An affine constraint: a ball on a turning table, in a family of velocities and with a claim that is
/// proved. The angular velocity is that seen in space, for which the brackets have the opposite sign.
///
/// ```
/// # use nonholonomic::prelude::*;
/// #[nonholonomic(
///     base  { x, y }
///     basis { vx, vy, w[3] }
///     anchor { der(x) = vx; der(y) = vy; }
///     brackets so(3) { w[2], w[1], w[0] }
///     lagrangian { m / 2 * (vx^2 + vy^2 + k^2 * dot(w, w)) }
///     constraints {
///         vx = r * w[1] - rate * y;
///         vy = -r * w[0] + rate * x;
///     }
///     conserved { spin = w[2]; }
///     assume { r > 0; k > 0; m > 0; }
/// )]
/// #[derive(Clone, Copy, Debug)]
/// struct BallOnTable<T> { m: T, k: T, r: T, rate: T }
///
/// let ball = BallOnTable { m: 1.0_f32, k: 0.2, r: 0.3, rate: 1.5 };
/// let start = BallOnTableState { x: 0.4, y: 0.1, w: [0.0, 0.0, 1.0] };
/// let next = Rk4::step(&ball, 0.0, 0.01, &start, &());
/// assert!((next.w[2] - 1.0).abs() < 1e-6);
/// ```
///
/// With units, which are proved to fit. Those of what is not listed follow: the velocities, the input, the output.
///
/// ```
/// # use nonholonomic::prelude::*;
/// #[nonholonomic(
///     base        { x, theta, roll }
///     lagrangian  { m / 2 * der(x)^2 + J / 2 * der(roll)^2 - m * g * x * sin(slope) }
///     constraints { contact: der(x) = r * der(roll); der(theta) = 0; }
///     inputs      { torque }
///     forces      { roll: torque - c * der(roll); }
///     outputs     { speed = r * der(roll); }
///     units       { x, r = m; theta, roll, slope = rad; m = kg; J = kg m^2; g = m/s^2; }
/// )]
/// #[derive(Clone, Copy, Debug)]
/// struct Wheel { m: f64, J: f64, g: f64, r: f64, c: f64, slope: f64 }
///
/// assert!(Wheel::REPORT.contains("J: torque"));
/// assert!(Wheel::REPORT.contains("m s⁻¹: x_dot, speed"));
/// assert!(Wheel::REPORT.contains("N: contact"));
/// ```
///
/// Here a radius is missing in the constraint, so that a speed would be a rate:
///
/// ```compile_fail
/// # use nonholonomic::prelude::*;
/// #[nonholonomic(
///     base        { x, roll }
///     lagrangian  { m / 2 * der(x)^2 + J / 2 * der(roll)^2 }
///     constraints { contact: der(x) = der(roll); }
///     units       { x = m; roll = rad; m = kg; J = kg m^2; }
/// )]
/// struct Wheel { m: f64, J: f64 }
/// ```
///
/// A declaration that is ill-posed does not compile: here the constraint is one of positions.
///
/// ```compile_fail
/// # use nonholonomic::prelude::*;
/// #[nonholonomic(
///     base        { x, y }
///     lagrangian  { m / 2 * (der(x)^2 + der(y)^2) }
///     constraints { x^2 + y^2 = 1; }
/// )]
/// struct Bead { m: f64 }
/// ```
#[cfg(feature = "macros")]
pub use nonholonomic_macros::nonholonomic;

/// # Examples
///
/// A skater on the plane is a body on se(2) with a place and a direction, which follow from its motion.
///
/// ```
/// use nonholonomic::prelude::*;
///
/// #[nonholonomic(
///     base        { theta, x, y }
///     lagrangian  { J / 2 * der(theta)^2 + m / 2 * (der(x)^2 + der(y)^2) }
///     constraints { cos(theta) * der(y) = sin(theta) * der(x); }
/// )]
/// #[derive(Clone, Copy, Debug)]
/// pub struct Skater { m: f64, J: f64 }
///
/// #[nonholonomic(
///     basis       { omega, v1, v2 }
///     brackets se(2) { omega, v1, v2 }
///     lagrangian  { J / 2 * omega^2 + m / 2 * (v1^2 + v2^2) }
///     constraints { v2 = 0; }
/// )]
/// #[derive(Clone, Copy, Debug)]
/// pub struct Reduced { m: f64, J: f64 }
///
/// morphism! { Skater -> Reduced {
///     velocities {
///         omega = der(theta);
///         v1 = cos(theta) * der(x) + sin(theta) * der(y);
///         v2 = cos(theta) * der(y) - sin(theta) * der(x);
///     }
/// } }
///
/// # fn main() -> Result<(), IntegrationError> {
/// let skater = Skater { m: 1.0, J: 0.1 };
/// let start = SkaterState { theta_dot: 1.0, x_dot: 2.0, ..SkaterState::default() };
/// assert_eq!(skater.reduce(0.0, &start), ReducedState { omega: 1.0, v1: 2.0 });
///
/// let motion = Reconstructed::<Skater, Reduced>::new(skater);
/// let begin = motion.start(0.0, &start);
/// let mut sim = Integrator::new(motion, Dopri5::new().rtol(1e-10), 0.0, begin);
/// sim.advance_to(core::f64::consts::PI)?;
/// let half_a_circle = motion.full_state(sim.time(), sim.state());
/// assert!(half_a_circle.x.abs() < 1e-8 && (half_a_circle.y - 4.0).abs() < 1e-8);
/// # Ok(())
/// # }
/// ```
#[cfg(feature = "macros")]
pub use nonholonomic_macros::morphism;

/// # Examples
///
/// The skater of [`morphism!`], reduced without a second declaration.
///
/// ```
/// use nonholonomic::prelude::*;
///
/// #[nonholonomic(
///     base        { theta, x, y }
///     lagrangian  { J / 2 * der(theta)^2 + m / 2 * (der(x)^2 + der(y)^2) }
///     constraints { cos(theta) * der(y) = sin(theta) * der(x); }
/// )]
/// #[derive(Clone, Copy, Debug)]
/// pub struct Skater { m: f64, J: f64 }
///
/// quotient! {
///     Skater -> #[derive(Clone, Copy, Debug)] pub struct Reduced by { theta, x, y } {
///         velocities {
///             omega = der(theta);
///             v1 = cos(theta) * der(x) + sin(theta) * der(y);
///             v2 = cos(theta) * der(y) - sin(theta) * der(x);
///         }
///     }
/// }
///
/// let skater = Skater { m: 1.0, J: 0.1 };
/// let start = SkaterState { theta_dot: 1.0, x_dot: 2.0, ..SkaterState::default() };
/// let reduced: Reduced = skater.reduced();
/// assert_eq!(skater.reduce(0.0, &start), ReducedState { omega: 1.0, v1: 2.0 });
/// assert_eq!(reduced.derivative(0.0, &ReducedState { omega: 1.0, v1: 2.0 }, &()), ReducedState::default());
/// ```
#[cfg(feature = "macros")]
pub use nonholonomic_macros::quotient;

/// The crate of the vectors and matrices in signatures (0.35): states convert to and from its `SVector`, Jacobians are
/// its `SMatrix`. A crate that names it by this path cannot have another version by accident.
pub use ::nalgebra;

/// The crate (1.x) whose packs of lanes are scalars with the feature `wide`.
#[cfg(feature = "wide")]
pub use ::wide;

/// The front page of the package: its example is tested with the others.
#[cfg(all(doctest, feature = "macros"))]
#[doc = include_str!("../README.md")]
struct FrontPage;

/// What generated code names. Not part of the public interface: it may change in any release.
#[doc(hidden)]
pub mod __private {
    pub use crate::__nh_serde_impls as serde_impls;
    pub use crate::TaylorSeries;
    pub use crate::assembly::{AssemblyError, Loops, assemble, assemble_holding};
    pub use crate::close_angle::CloseAngle;
    pub use crate::impacts;
    pub use crate::inclusion::{restricted, returned};
    pub use crate::kept_parameters::kept_parameters;
    pub use crate::linear::{inverse_pivoted, solve_pivoted, times};
    pub use crate::linear_model::{
        Directed, FirstOrder, Linearization, LinearizationError, Names, Parts, linearize, to_first_order,
    };
    pub use crate::near_return::{NearReturn, Next};
    pub use crate::newton_return::{corrected, first_iterate, newton, product_of_signs, worst};
    pub use crate::projection::{MOST_RETURNS, check_identities, holds, largest, project, stays};
    pub use crate::series::History;
    pub use crate::slopes_of_return::slopes_of_return;
    pub use crate::trim::{Steady, TrimError, equations, trim};
    pub use crate::{
        AlmostPoisson, Angle, AngleCache, AngleCached, Constrained, D, Dim, DiscreteLagrangian, Dynamics,
        Energy, EulerPoincareSuslov, Held, Holding, Inclusion, InputFault, Invariants, Jacobian, Jet,
        Leapfrog, NotInMode, Observed, ParameterError, ParameterFault, Prepare, Prepared, ProjectionError,
        Real, Reconstruction, Reduction, Scalar, ScalarOf, State, StateFault, VecOf,
    };
    pub use core;
    pub use nalgebra;
    #[cfg(feature = "macros")]
    pub use nonholonomic_macros::{morphism, nonholonomic, quotient};
    #[cfg(feature = "serde")]
    pub use serde;
}
