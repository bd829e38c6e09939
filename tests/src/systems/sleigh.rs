//! The Chaplygin sleigh: a rigid body on a plane, carried by a knife edge.
//!
//! CLMM section 6.1, with J about the centre of mass, which lies at (a, b) in the body frame whose
//! origin is the contact point and whose first axis is the blade.

use nonholonomic::prelude::*;

use crate::catalogue::catalogued;
use crate::twins::both;

both! {
    /// On the plane, in body-frame velocities, with friction and a driving torque.
    #[nonholonomic(
        base   { theta, x, y }
        basis  { omega, v1, v2 }
        anchor {
            der(theta) = omega;
            der(x) = v1 * cos(theta) - v2 * sin(theta);
            der(y) = v1 * sin(theta) + v2 * cos(theta);
        }
        lagrangian  { (J + m * (a^2 + b^2)) / 2 * omega^2 + m / 2 * (v1^2 + v2^2) - m * b * omega * v1 + m * a * omega * v2 }
        constraints { blade: v2 = 0; }
        forces      { omega: torque - c * omega; }
        inputs      { torque }
        emit { multipliers, reactions }
    )]
    #[derive(Clone, Copy, Debug)]
    pub struct Sleigh {
        /// Mass.
        pub m: f64,
        /// Moment of inertia about the centre of mass.
        pub J: f64,
        /// Centre of mass ahead of the contact point.
        pub a: f64,
        /// Centre of mass to the left of the contact point.
        pub b: f64,
        /// Rotary friction.
        pub c: f64,
    }
    projected ProjectedSleigh
}

catalogued! {
    Sleigh { state: 5, sections: 3 } of "chaplygin_sleigh",
    parameters |p| Sleigh { m: p["m"], J: p["J"], a: p["a"], b: p["b"], c: 0.0 },
    state |s| [s["theta"], s["x"], s["y"], s["omega"], s["v1"]],
    velocity |s| [s["omega"], s["v1"], s["v2"]],
    multipliers [blade],
    projected ProjectedSleigh
}

both! {
    /// Reduced by the motions of the plane: Euler–Poincaré–Suslov on se(2).
    #[nonholonomic(
        basis { omega, v1, v2 }
        brackets se(2) { omega, v1, v2 }
        lagrangian  { (J + m * (a^2 + b^2)) / 2 * omega^2 + m / 2 * (v1^2 + v2^2) - m * b * omega * v1 + m * a * omega * v2 }
        constraints { blade: v2 = 0; }
        emit { multipliers, reactions }
    )]
    #[derive(Clone, Copy, Debug)]
    pub struct ReducedSleigh {
        /// Mass.
        pub m: f64,
        /// Moment of inertia about the centre of mass.
        pub J: f64,
        /// Centre of mass ahead of the contact point.
        pub a: f64,
        /// Centre of mass to the left of the contact point.
        pub b: f64,
    }
    projected ProjectedReducedSleigh
}

catalogued! {
    ReducedSleigh { state: 2, sections: 3 } of "chaplygin_sleigh",
    parameters |p| ReducedSleigh { m: p["m"], J: p["J"], a: p["a"], b: p["b"] },
    state |s| [s["omega"], s["v1"]],
    velocity |s| [s["omega"], s["v1"], s["v2"]],
    multipliers [blade],
    projected ProjectedReducedSleigh
}

/// In coordinates of the plane, where no velocity can be eliminated for every heading: the state
/// keeps all velocities and the constraint acts through its multiplier.
#[nonholonomic(
    base { theta, x, y }
    lagrangian {
        let xc = der(x) - (a * sin(theta) + b * cos(theta)) * der(theta);
        let yc = der(y) + (a * cos(theta) - b * sin(theta)) * der(theta);
        J / 2 * der(theta)^2 + m / 2 * (xc^2 + yc^2)
    }
    constraints { blade: cos(theta) * der(y) - sin(theta) * der(x) = 0; }
    emit { multipliers, reactions }
)]
#[derive(Clone, Copy, Debug)]
pub struct SleighOnThePlane {
    /// Mass.
    pub m: f64,
    /// Moment of inertia about the centre of mass.
    pub J: f64,
    /// Centre of mass ahead of the contact point.
    pub a: f64,
    /// Centre of mass to the left of the contact point.
    pub b: f64,
}

catalogued! {
    SleighOnThePlane { state: 6, sections: 3 } of "chaplygin_sleigh",
    parameters |p| SleighOnThePlane { m: p["m"], J: p["J"], a: p["a"], b: p["b"] },
    state |s| {
        let (sin, cos) = s["theta"].sin_cos();
        [
            s["theta"], s["x"], s["y"], s["omega"],
            s["v1"] * cos - s["v2"] * sin,
            s["v1"] * sin + s["v2"] * cos,
        ]
    },
    velocity |s| {
        let (sin, cos) = s["theta"].sin_cos();
        [s["omega"], s["v1"] * cos - s["v2"] * sin, s["v1"] * sin + s["v2"] * cos]
    },
    multipliers [blade]
}
