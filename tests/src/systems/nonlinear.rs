//! Constraints that are not linear in the velocities (Chetaev's rule).
//!
//! CLMM section 7 has the theory; the reference data come from `tests/reference/unreduced.py`.

use nonholonomic::prelude::*;

use crate::catalogue::catalogued;

/// Two points whose velocities stay parallel: homogeneous, so that energy is conserved, and singular
/// at rest.
#[nonholonomic(
    base { x1, y1, x2, y2 }
    lagrangian {
        m1 / 2 * (der(x1)^2 + der(y1)^2) + m2 / 2 * (der(x2)^2 + der(y2)^2)
            - k / 2 * ((x1 - x2)^2 + (y1 - y2)^2) - g * (m1 * y1 + m2 * y2)
    }
    constraints { parallel: der(x1) * der(y2) = der(y1) * der(x2); }
    emit { multipliers, reactions }
)]
#[derive(Clone, Copy, Debug)]
pub struct ParallelVelocities {
    /// Mass of the first point.
    pub m1: f64,
    /// Mass of the second point.
    pub m2: f64,
    /// Stiffness of the spring between them.
    pub k: f64,
    /// Gravity.
    pub g: f64,
}

catalogued! {
    ParallelVelocities { state: 8, sections: 4 } of "parallel_velocities",
    parameters |p| ParallelVelocities { m1: p["m1"], m2: p["m2"], k: p["k"], g: p["g"] },
    state |s| [s["x1"], s["y1"], s["x2"], s["y2"], s["dx1"], s["dy1"], s["dx2"], s["dy2"]],
    velocity |s| [s["dx1"], s["dy1"], s["dx2"], s["dy2"]],
    multipliers [parallel]
}

/// A point whose speed is held.
#[nonholonomic(
    base { x, y, z }
    lagrangian {
        m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) - k / 2 * (x^2 + 2 * y^2 + 3 * z^2) - m * g * z
    }
    constraints { speed: der(x)^2 + der(y)^2 + der(z)^2 = c^2; }
    emit { multipliers, reactions }
)]
#[derive(Clone, Copy, Debug)]
pub struct ConstantSpeed {
    /// Mass.
    pub m: f64,
    /// The speed.
    pub c: f64,
    /// Stiffness of the potential.
    pub k: f64,
    /// Gravity.
    pub g: f64,
}

catalogued! {
    ConstantSpeed { state: 6, sections: 3 } of "constant_speed",
    parameters |p| ConstantSpeed { m: p["m"], c: p["c"], k: p["k"], g: p["g"] },
    state |s| [s["x"], s["y"], s["z"], s["dx"], s["dy"], s["dz"]],
    velocity |s| [s["dx"], s["dy"], s["dz"]],
    multipliers [speed]
}

/// A point whose speed grows with time.
#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) - m * g * y }
    constraints { speed: der(x)^2 + der(y)^2 = c^2 * (1 + t)^2; }
    emit { multipliers, reactions }
)]
#[derive(Clone, Copy, Debug)]
pub struct GrowingSpeed {
    /// Mass.
    pub m: f64,
    /// The speed at the time zero.
    pub c: f64,
    /// Gravity.
    pub g: f64,
}

catalogued! {
    GrowingSpeed { state: 4, sections: 2 } of "growing_speed",
    parameters |p| GrowingSpeed { m: p["m"], c: p["c"], g: p["g"] },
    state |s| [s["x"], s["y"], s["dx"], s["dy"]],
    velocity |s| [s["dx"], s["dy"]],
    multipliers [speed]
}
