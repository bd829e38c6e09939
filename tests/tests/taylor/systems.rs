//! Systems whose equations contain every step that has a recurrence.

use nonholonomic::prelude::*;

/// A sleigh, driven and braked: products, squares, sine and cosine, a constant divisor.
#[nonholonomic(
    base   { theta, x, y }
    basis  { omega, v1, v2 }
    anchor {
        der(theta) = omega;
        der(x) = v1 * cos(theta) - v2 * sin(theta);
        der(y) = v1 * sin(theta) + v2 * cos(theta);
    }
    lagrangian  { (J + m * a^2) / 2 * omega^2 + m / 2 * (v1^2 + v2^2) + m * a * omega * v2 }
    constraints { v2 = 0; }
    forces      { omega: torque - c * omega; v1: abs(torque) * self.slip(c); }
    inputs      { torque }
    emit        { taylor }
)]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sleigh<T> {
    pub(crate) m: T,
    pub(crate) J: T,
    pub(crate) a: T,
    pub(crate) c: T,
}

impl<T: Scalar> Sleigh<T> {
    /// Not analytic, which does no harm: it does not change during a step.
    fn slip(&self, c: T) -> T {
        self.m * c.sign()
    }
}

/// Every function, and the time.
#[nonholonomic(
    base { x, y, z }
    lagrangian { (der(x)^2 + der(y)^2 + der(z)^2) / 2 }
    forces {
        x: sin(x + t) + tan(y / 3) - atan(x * y) + atan2(2 + y, 3 + x) - atan2(c, 2 + z) + 1 / (2 + cos(x));
        y: exp(-x^2) + ln(3 + y) + sqrt(2 + sin(z)) + (3 + x * y)^(1/3) - (2 + z)^(-5/2) + x * y / (4 + z);
        z: sinh(x / 2) - cosh(y / 2) + tanh(z) + asin(x / 4) - acos(y / 4) + cos(t^2) - sqrt(x^2 + y^2 + c) + x^5;
    }
    emit { taylor }
)]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Everything<T> {
    pub(crate) c: T,
}

/// A kinetic energy without sign in more velocities than have a closed form: solved with pivoting.
#[nonholonomic(
    base { q[5] }
    lagrangian {
        a / 2 * (der(q[0])^2 - der(q[1])^2 + der(q[2])^2 - der(q[3])^2 + der(q[4])^2)
            + cos(q[0]) * der(q[0]) * der(q[1]) + sin(q[1]) * der(q[2]) * der(q[3])
            + b * q[0] * der(q[1]) * der(q[4]) + der(q[3]) * der(q[0]) * q[2] / 3
            - dot(q, q) / 2
    }
    forces { q[4]: u; }
    inputs { u }
    emit { taylor }
)]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Indefinite<T> {
    pub(crate) a: T,
    pub(crate) b: T,
}

/// Projected, on an embedded base, with an inertia matrix.
#[nonholonomic(
    base { g[3] }
    basis { w[3] }
    anchor {
        der(g[0]) = g[1] * w[2] - g[2] * w[1];
        der(g[1]) = g[2] * w[0] - g[0] * w[2];
        der(g[2]) = g[0] * w[1] - g[1] * w[0];
    }
    brackets so(3) { w[0], w[1], w[2] }
    lagrangian  { dot(w, I * w) / 2 - dot(c, g) }
    constraints { dot(g, w) = 0; }
    emit { taylor }
)]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Veselova<T> {
    pub(crate) I: [[T; 3]; 3],
    pub(crate) c: [T; 3],
}
