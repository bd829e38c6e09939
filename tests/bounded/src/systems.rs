//! A system of each formulation and number.

use nonholonomic::prelude::*;

/// A rigid body on a plane, carried by a knife edge, with a wheel that drives it.
#[nonholonomic(
    base   { theta, x, y }
    basis  { omega, v1, v2 }
    anchor {
        der(theta) = omega;
        der(x) = v1 * cos(theta) - v2 * sin(theta);
        der(y) = v1 * sin(theta) + v2 * cos(theta);
    }
    lagrangian  { (J + J_w + m * (a^2 + b^2)) / 2 * omega^2 + m / 2 * (v1^2 + v2^2) - m * b * omega * v1 + m * a * omega * v2 }
    constraints { edge: v2 = 0; }
    forces      { omega: torque - c * omega; }
    inputs      { torque }
    outputs     { speed = sqrt(v1^2 + v2^2); }
    emit        { multipliers, jacobian }
)]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sleigh<T> {
    pub(crate) m: T,
    pub(crate) J: T,
    pub(crate) J_w: T,
    pub(crate) a: T,
    pub(crate) b: T,
    pub(crate) c: T,
}

nh_models::driven_robot! {
    /// A robot on two driven wheels, with its centre of mass ahead of the axle.
    #[derive(Clone, Copy, Debug)]
    pub(crate) struct Robot {
        pub(crate) m: f64,
        pub(crate) J: f64,
        pub(crate) I: f64,
        pub(crate) b: f64,
        pub(crate) d: f64,
        pub(crate) r: f64,
    }
    emit { multipliers, jacobian }
}

/// In coordinates of the plane, in the projected formulation.
#[nonholonomic(
    base { theta, x, y }
    lagrangian  { J / 2 * der(theta)^2 + m / 2 * (der(x)^2 + der(y)^2) }
    constraints { cos(theta) * der(y) - sin(theta) * der(x) = 0; }
    emit        { multipliers, jacobian }
)]
#[derive(Clone, Copy, Debug)]
pub(crate) struct SleighOnThePlane {
    pub(crate) m: f64,
    pub(crate) J: f64,
}

/// McLachlan and Perlmutter's contact oscillator, for discrete gradients and Taylor series.
#[nonholonomic(
    base { x, y, z }
    lagrangian { (der(x)^2 + der(y)^2 + der(z)^2) / 2 - (x^2 + y^2 + z^2) / 2 - epsilon / 2 * x^2 * z^2 }
    constraints { der(x) = -y * der(z); }
    emit { discrete_gradient, taylor }
)]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Contact<T> {
    pub(crate) epsilon: T,
}

/// The same on TQ, for the leapfrog method and the projections.
#[nonholonomic(
    base { x, y, z }
    lagrangian { (der(x)^2 + der(y)^2 + der(z)^2) / 2 - (x^2 + y^2 + z^2) / 2 - epsilon / 2 * x^2 * z^2 }
    constraints { der(x) = -y * der(z); }
    formulation { projected }
    conserved { total = (der(x)^2 + der(y)^2 + der(z)^2) / 2 + (x^2 + y^2 + z^2) / 2 + epsilon / 2 * x^2 * z^2; }
    emit { leapfrog, invariants }
)]
#[derive(Clone, Copy, Debug)]
pub(crate) struct ContactOnTq<T> {
    pub(crate) epsilon: T,
}

/// A mass on a rod, on TQ.
#[nonholonomic(
    base { x, y }
    holonomic { rod: x^2 + y^2 = 1; }
    lagrangian { (der(x)^2 + der(y)^2) / 2 - g * y }
    emit { rattle }
)]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rod<T> {
    pub(crate) g: T,
}

/// Suslov's problem, on a Lie algebra.
#[nonholonomic(
    basis { w[3] }
    brackets so(3) { w }
    lagrangian { sum(i in 0..3: I[i] * w[i]^2) / 2 }
    constraints { w[2] = k * w[0]; }
    emit { euler_poincare_suslov }
)]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Suslov<T> {
    pub(crate) I: [T; 3],
    pub(crate) k: T,
}
