//! Constraints that depend on time, linear and affine in the velocities.
//!
//! The reference data come from `tests/reference/unreduced.py`.

use nonholonomic::prelude::*;

use crate::catalogue::catalogued;
use crate::twins::both;

both! {
    /// The Chaplygin sleigh on a belt that moves to and fro: its blade does not slip on the belt.
    #[nonholonomic(
        base   { theta, x, y }
        basis  { omega, v1, v2 }
        anchor {
            der(theta) = omega;
            der(x) = v1 * cos(theta) - v2 * sin(theta);
            der(y) = v1 * sin(theta) + v2 * cos(theta);
        }
        lagrangian  { (J + m * (a^2 + b^2)) / 2 * omega^2 + m / 2 * (v1^2 + v2^2) - m * b * omega * v1 + m * a * omega * v2 }
        constraints { blade: v2 = -sin(theta) * U * cos(w * t); }
        forces      { omega: -cf * omega; }
        emit { multipliers, reactions }
    )]
    #[derive(Clone, Copy, Debug)]
    pub struct SleighOnBelt {
        /// Mass.
        pub m: f64,
        /// Moment of inertia about the centre of mass.
        pub J: f64,
        /// Centre of mass ahead of the contact point.
        pub a: f64,
        /// Centre of mass to the left of the contact point.
        pub b: f64,
        /// Largest speed of the belt.
        pub U: f64,
        /// Angular frequency of the belt.
        pub w: f64,
        /// Rotary friction.
        pub cf: f64,
    }
    projected ProjectedSleighOnBelt
}

catalogued! {
    SleighOnBelt { state: 5, sections: 3 } of "sleigh_on_a_belt",
    parameters |p| SleighOnBelt {
        m: p["m"], J: p["J"], a: p["a"], b: p["b"], U: p["U"], w: p["w"], cf: p["cf"],
    },
    state |s| [s["theta"], s["x"], s["y"], s["dtheta"], s["v1"]],
    velocity |s| [s["dtheta"], s["v1"], s["v2"]],
    multipliers [blade],
    projected ProjectedSleighOnBelt
}

both! {
    /// The sleigh whose blade is steered, by the slope of the blade in the body.
    #[nonholonomic(
        base   { theta, x, y }
        basis  { omega, v1, v2 }
        anchor {
            der(theta) = omega;
            der(x) = v1 * cos(theta) - v2 * sin(theta);
            der(y) = v1 * sin(theta) + v2 * cos(theta);
        }
        lagrangian  { (J + m * (a^2 + b^2)) / 2 * omega^2 + m / 2 * (v1^2 + v2^2) - m * b * omega * v1 + m * a * omega * v2 }
        constraints { blade_by_slope: v2 = tan(A * sin(w * t)) * v1; }
        emit { multipliers, reactions }
    )]
    #[derive(Clone, Copy, Debug)]
    pub struct SteeredSleigh {
        /// Mass.
        pub m: f64,
        /// Moment of inertia about the centre of mass.
        pub J: f64,
        /// Centre of mass ahead of the contact point.
        pub a: f64,
        /// Centre of mass to the left of the contact point.
        pub b: f64,
        /// Largest steering angle.
        pub A: f64,
        /// Angular frequency of the steering.
        pub w: f64,
    }
    projected ProjectedSteeredSleigh
}

catalogued! {
    SteeredSleigh { state: 5, sections: 3 } of "sleigh_with_steered_blade",
    parameters |p| SteeredSleigh { m: p["m"], J: p["J"], a: p["a"], b: p["b"], A: p["A"], w: p["w"] },
    state |s| [s["theta"], s["x"], s["y"], s["dtheta"], s["v1"]],
    velocity |s| [s["dtheta"], s["v1"], s["v2"]],
    multipliers [blade_by_slope],
    projected ProjectedSteeredSleigh
}

/// The same in coordinates of the plane, where the state keeps all velocities.
#[nonholonomic(
    base { theta, x, y }
    lagrangian {
        let xc = der(x) - (a * sin(theta) + b * cos(theta)) * der(theta);
        let yc = der(y) + (a * cos(theta) - b * sin(theta)) * der(theta);
        J / 2 * der(theta)^2 + m / 2 * (xc^2 + yc^2)
    }
    constraints { blade: cos(theta + A * sin(w * t)) * der(y) = sin(theta + A * sin(w * t)) * der(x); }
    emit { multipliers, reactions }
)]
#[derive(Clone, Copy, Debug)]
pub struct SteeredSleighOnThePlane {
    /// Mass.
    pub m: f64,
    /// Moment of inertia about the centre of mass.
    pub J: f64,
    /// Centre of mass ahead of the contact point.
    pub a: f64,
    /// Centre of mass to the left of the contact point.
    pub b: f64,
    /// Largest steering angle.
    pub A: f64,
    /// Angular frequency of the steering.
    pub w: f64,
}

catalogued! {
    SteeredSleighOnThePlane { state: 6, sections: 3 } of "sleigh_with_steered_blade",
    parameters |p| SteeredSleighOnThePlane {
        m: p["m"], J: p["J"], a: p["a"], b: p["b"], A: p["A"], w: p["w"],
    },
    state |s| [s["theta"], s["x"], s["y"], s["dtheta"], s["dx"], s["dy"]],
    velocity |s| [s["dtheta"], s["dx"], s["dy"]],
    multipliers [blade]
}

both! {
    /// The two-wheeled robot with the speeds of its wheels prescribed and an arm on a spring: the arm is
    /// all that is left to move by itself.
    #[nonholonomic(
        base { psi1, psi2, x, y, theta, alpha }
        lagrangian {
            let lateral = -der(x) * sin(theta) + der(y) * cos(theta);
            let xa = der(x) - d * sin(alpha) * der(alpha);
            let ya = der(y) + d * cos(alpha) * der(alpha);
            (m0 + 2 * m1) / 2 * (der(x)^2 + der(y)^2) + m0 * l * lateral * der(theta)
                + J / 2 * der(theta)^2 + J2 / 2 * (der(psi1)^2 + der(psi2)^2)
                + M / 2 * (xa^2 + ya^2) + k * cos(alpha - theta)
        }
        constraints {
            lateral: -sin(theta) * der(x) + cos(theta) * der(y) = 0;
            wheel1: der(x) * cos(theta) + der(y) * sin(theta) + c * der(theta) + R * der(psi1) = 0;
            wheel2: der(x) * cos(theta) + der(y) * sin(theta) - c * der(theta) + R * der(psi2) = 0;
            drive1: der(psi1) = W1 * (1 + E * sin(w * t));
            drive2: der(psi2) = W2 * cos(w * t);
        }
        emit { multipliers, reactions }
    )]
    #[derive(Clone, Copy, Debug)]
    pub struct PrescribedRobot {
        /// Mass of the body.
        pub m0: f64,
        /// Mass of each wheel.
        pub m1: f64,
        /// Centre of mass ahead of the axle.
        pub l: f64,
        /// Moment of inertia about the vertical through the middle of the axle.
        pub J: f64,
        /// Axial moment of inertia of each wheel.
        pub J2: f64,
        /// Half the axle.
        pub c: f64,
        /// Radius of the wheels.
        pub R: f64,
        /// Mass at the end of the arm.
        pub M: f64,
        /// Length of the arm.
        pub d: f64,
        /// Stiffness of the arm's spring.
        pub k: f64,
        /// Mean speed of the first wheel.
        pub W1: f64,
        /// Largest speed of the second wheel.
        pub W2: f64,
        /// Modulation of the first wheel's speed.
        pub E: f64,
        /// Angular frequency of both.
        pub w: f64,
    }
    projected ProjectedPrescribedRobot
}

catalogued! {
    PrescribedRobot { state: 7, sections: 6 } of "robot_with_prescribed_wheels",
    parameters |p| PrescribedRobot {
        m0: p["m0"], m1: p["m1"], l: p["l"], J: p["J"], J2: p["J2"], c: p["c"], R: p["R"],
        M: p["M"], d: p["d"], k: p["k"], W1: p["W1"], W2: p["W2"], E: p["E"], w: p["w"],
    },
    state |s| [s["psi1"], s["psi2"], s["x"], s["y"], s["theta"], s["alpha"], s["dalpha"]],
    velocity |s| [s["dpsi1"], s["dpsi2"], s["dx"], s["dy"], s["dtheta"], s["dalpha"]],
    multipliers [lateral, wheel1, wheel2, drive1, drive2],
    projected ProjectedPrescribedRobot
}
