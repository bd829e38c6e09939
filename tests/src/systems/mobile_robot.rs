//! A two-wheeled planar mobile robot: two independently driven coaxial wheels and a passive caster.
//!
//! CLMM section 6.4.

use nonholonomic::prelude::*;

use crate::catalogue::catalogued;
use crate::twins::both;

both! {
    /// On the Atiyah algebroid of the trivial bundle over the wheel angles, fibre se(2): position and
    /// heading are reduced away. Constraints as printed: the body rolls backwards when the wheels turn
    /// forwards.
    #[nonholonomic(
        base  { psi1, psi2 }
        basis { dpsi1, dpsi2, w1, w2, w3 }
        anchor { der(psi1) = dpsi1; der(psi2) = dpsi2; }
        brackets se(2) { w3, w1, w2 }
        lagrangian {
            (m0 + 2 * m1) / 2 * (w1^2 + w2^2) + m0 * l * w2 * w3 + J / 2 * w3^2 + J2 / 2 * (dpsi1^2 + dpsi2^2)
        }
        constraints {
            lateral: -w2 = 0;
            wheel1: w1 + c * w3 + R * dpsi1 = 0;
            wheel2: w1 - c * w3 + R * dpsi2 = 0;
        }
        emit { multipliers, reactions }
    )]
    #[derive(Clone, Copy, Debug)]
    pub struct MobileRobot {
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
    }
    projected ProjectedMobileRobot
}

catalogued! {
    MobileRobot { state: 4, sections: 5 } of "mobile_robot",
    parameters |p| MobileRobot {
        m0: p["m0"], m1: p["m1"], l: p["l"], J: p["J"], J2: p["J2"], c: p["c"], R: p["R"],
    },
    state |s| [s["psi1"], s["psi2"], s["dpsi1"], s["dpsi2"]],
    velocity |s| [s["dpsi1"], s["dpsi2"], s["w1"], s["w2"], s["w3"]],
    multipliers [lateral, wheel1, wheel2],
    projected ProjectedMobileRobot
}

both! {
    /// Unreduced, with the constraints solved for the motion of the body.
    #[nonholonomic(
        base { psi1, psi2, x, y, theta }
        lagrangian {
            let lateral = -der(x) * sin(theta) + der(y) * cos(theta);
            (m0 + 2 * m1) / 2 * (der(x)^2 + der(y)^2) + m0 * l * lateral * der(theta)
                + J / 2 * der(theta)^2 + J2 / 2 * (der(psi1)^2 + der(psi2)^2)
        }
        constraints {
            der(x) = -R / 2 * (der(psi1) + der(psi2)) * cos(theta);
            der(y) = -R / 2 * (der(psi1) + der(psi2)) * sin(theta);
            der(theta) = R / (2 * c) * (der(psi2) - der(psi1));
        }
    )]
    #[derive(Clone, Copy, Debug)]
    pub struct MobileRobotOnThePlane {
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
    }
    projected ProjectedMobileRobotOnThePlane
}

catalogued! {
    MobileRobotOnThePlane { state: 7, sections: 5 } of "mobile_robot",
    parameters |p| MobileRobotOnThePlane {
        m0: p["m0"], m1: p["m1"], l: p["l"], J: p["J"], J2: p["J2"], c: p["c"], R: p["R"],
    },
    state |s| [s["psi1"], s["psi2"], s["x"], s["y"], s["theta"], s["dpsi1"], s["dpsi2"]],
    velocity |s| {
        let (sin, cos) = s["theta"].sin_cos();
        [
            s["dpsi1"], s["dpsi2"],
            s["w1"] * cos - s["w2"] * sin,
            s["w1"] * sin + s["w2"] * cos,
            s["w3"],
        ]
    },
    projected ProjectedMobileRobotOnThePlane
}
