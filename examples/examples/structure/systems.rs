//! The test problems of geometric integration for nonholonomic systems.
#![allow(non_snake_case, reason = "moments of inertia are written I")]

use nonholonomic::prelude::*;

/// The contact oscillator: three oscillators, coupled by a contact constraint and a quartic term
/// (McLachlan, Perlmutter, Integrators for nonholonomic mechanical systems, J. Nonlinear Sci. 16 (2006)).
#[nonholonomic(
    base { x, y, z }
    lagrangian {
        (der(x)^2 + der(y)^2 + der(z)^2) / 2 - (x^2 + y^2 + z^2) / 2 - epsilon / 2 * x^2 * z^2
    }
    constraints { der(x) = -y * der(z); }
    emit { discrete_gradient, divergence, volume }
    volume;
)]
#[derive(Clone, Copy, Debug)]
pub(crate) struct ContactOscillator {
    /// Strength of the coupling.
    pub(crate) epsilon: f64,
}

/// The same on TQ with its multiplier, for the leapfrog method.
#[nonholonomic(
    base { x, y, z }
    lagrangian {
        (der(x)^2 + der(y)^2 + der(z)^2) / 2 - (x^2 + y^2 + z^2) / 2 - epsilon / 2 * x^2 * z^2
    }
    constraints { contact: der(x) = -y * der(z); }
    formulation { projected }
    conserved { total = (der(x)^2 + der(y)^2 + der(z)^2) / 2 + (x^2 + y^2 + z^2) / 2 + epsilon / 2 * x^2 * z^2; }
    emit { discrete_gradient, leapfrog, invariants }
)]
#[derive(Clone, Copy, Debug)]
pub(crate) struct ContactOscillatorOnTq {
    /// Strength of the coupling.
    pub(crate) epsilon: f64,
}

/// The chaotic quartic system with n = 3 (McLachlan, Perlmutter 2006).
#[nonholonomic(
    base { x, y[3], z[3] }
    lagrangian {
        (der(x)^2 + sum(i in 0..3: der(y[i])^2 + der(z[i])^2)) / 2
            - (x^2 + dot(y, y) + dot(z, z) + sum(i in 0..3: y[i]^2 * z[i]^2) + z[0]^2 * z[1]^2) / 2
    }
    constraints { der(x) = -sum(i in 0..3: y[i] * der(z[i])); }
    emit { discrete_gradient }
)]
#[derive(Clone, Copy, Debug)]
pub(crate) struct ChaoticQuartic;

/// The same on TQ with its multiplier, for the leapfrog method.
#[nonholonomic(
    base { x, y[3], z[3] }
    lagrangian {
        (der(x)^2 + sum(i in 0..3: der(y[i])^2 + der(z[i])^2)) / 2
            - (x^2 + dot(y, y) + dot(z, z) + sum(i in 0..3: y[i]^2 * z[i]^2) + z[0]^2 * z[1]^2) / 2
    }
    constraints { der(x) = -sum(i in 0..3: y[i] * der(z[i])); }
    formulation { projected }
    emit { leapfrog }
)]
#[derive(Clone, Copy, Debug)]
pub(crate) struct ChaoticQuarticOnTq;

/// A heavy rigid body whose angular velocity stays orthogonal to its third axis.
#[nonholonomic(
    base { g[3] }
    on { dot(g, g) = 1; }
    basis { w[3] }
    anchor { der(g) = cross(g, w); }
    brackets so(3) { w }
    lagrangian { sum(i in 0..3: I[i] * w[i]^2) / 2 - dot(c, g) }
    constraints { w[2] = 0; }
    emit { discrete_gradient, divergence, volume }
    volume;
    assume { I[0] > 0; I[1] > 0; I[2] > 0; }
)]
#[derive(Clone, Copy, Debug)]
pub(crate) struct HeavySuslov {
    /// Principal moments of inertia.
    pub(crate) I: [f64; 3],
    /// The potential is ⟨c, g⟩.
    pub(crate) c: [f64; 3],
}

/// The Suslov problem with the constraint in general position: every motion settles.
#[nonholonomic(
    basis { w[3] }
    brackets so(3) { w }
    lagrangian { sum(i in 0..3: I[i] * w[i]^2) / 2 }
    constraints { w[2] = k * w[0]; }
    emit { discrete_gradient, divergence, euler_poincare_suslov }
)]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Suslov {
    /// Principal moments of inertia.
    pub(crate) I: [f64; 3],
    /// Slope of the plane of velocities.
    pub(crate) k: f64,
}

/// A heavy rigid body whose angular velocity stays orthogonal to the vertical: D has no global basis.
#[nonholonomic(
    base { g[3] }
    on { dot(g, g) = 1; }
    basis { w[3] }
    anchor { der(g) = cross(g, w); }
    brackets so(3) { w }
    lagrangian { sum(i in 0..3: I[i] * w[i]^2) / 2 - dot(c, g) }
    constraints { dot(g, w) = 0; }
    emit { discrete_gradient, divergence, volume }
    volume;
)]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Veselova {
    /// Principal moments of inertia.
    pub(crate) I: [f64; 3],
    /// The potential is ⟨c, g⟩.
    pub(crate) c: [f64; 3],
}

/// A ball with its centre of mass in the middle and any inertia rolls on a plane.
#[nonholonomic(
    base { g[3] }
    on { dot(g, g) = 1; }
    basis { w[3], v[3] }
    anchor { der(g) = cross(g, w); }
    brackets se(3) { w[0], w[1], w[2], v[0], v[1], v[2] }
    lagrangian { sum(i in 0..3: I[i] * w[i]^2) / 2 + m / 2 * dot(v, v) }
    constraints { v = r * cross(w, g); }
    emit { discrete_gradient, divergence, volume }
    volume;
    assume { m > 0; r > 0; I[0] > 0; I[1] > 0; I[2] > 0; }
)]
#[derive(Clone, Copy, Debug)]
pub(crate) struct ChaplyginSphere {
    /// Principal moments of inertia.
    pub(crate) I: [f64; 3],
    /// Mass.
    pub(crate) m: f64,
    /// Radius.
    pub(crate) r: f64,
}

/// Two oscillators behind a gearbox whose ratio a pendulum drives, as in the problems of Modin and
/// Verdier (What makes nonholonomic integrators work?, Numer. Math. 145 (2020)): the pendulum knows
/// nothing of the oscillators, so that its energy and theirs are conserved separately. With `skew` the
/// pendulum's potential has no mirror symmetry, and where it turns over no reversal is left.
#[nonholonomic(
    base { x, y, s }
    lagrangian {
        (der(x)^2 + der(y)^2 + der(s)^2) / 2 - (x^2 + y^2) / 2 + cos(s) - skew * sin(2 * s)
    }
    constraints { der(x) = -sin(s) * der(y); }
    outputs {
        pendulum = der(s)^2 / 2 - cos(s) + skew * sin(2 * s);
        oscillators = (der(x)^2 + der(y)^2 + x^2 + y^2) / 2;
    }
    emit { discrete_gradient }
)]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Gearbox {
    /// How far the pendulum's potential is from symmetric.
    pub(crate) skew: f64,
}
