//! The Chaplygin gyro: a rolling ball that carries a gimbal ring with a pendulous mass.
//!
//! CLMM end of section 6.3; Markeev (2002). The ring turns by `alpha` about the third body axis of
//! the ball, the mass sits on it at the angle `beta` from the ring's downward axis, and gravity acts
//! on the mass alone.

use nonholonomic::prelude::*;

use crate::catalogue::catalogued;
use crate::twins::both;

both! {
    /// Reduced to the vertical `gamma` seen from the ball; velocities in the ball's frame span se(3).
    #[nonholonomic(
        base  { alpha, beta, gamma[3] }
        basis { w1, w2, w3, v1, v2, v3, dalpha, dbeta }
        anchor {
            der(alpha) = dalpha;
            der(beta) = dbeta;
            der(gamma[0]) = gamma[1] * w3 - gamma[2] * w2;
            der(gamma[1]) = gamma[2] * w1 - gamma[0] * w3;
            der(gamma[2]) = gamma[0] * w2 - gamma[1] * w1;
        }
        brackets se(3) { w1, w2, w3, v1, v2, v3 }
        lagrangian {
            // the mass in the ball's frame, and its velocity
            let q1 = l * sin(beta) * cos(alpha);
            let q2 = l * sin(beta) * sin(alpha);
            let q3 = -l * cos(beta);
            let s1 = v1 + w2 * q3 - w3 * q2 + l * cos(beta) * cos(alpha) * dbeta - q2 * dalpha;
            let s2 = v2 + w3 * q1 - w1 * q3 + l * cos(beta) * sin(alpha) * dbeta + q1 * dalpha;
            let s3 = v3 + w1 * q2 - w2 * q1 + l * sin(beta) * dbeta;
            // the angular velocity of the ring in its own frame
            let r1 = cos(alpha) * w1 + sin(alpha) * w2;
            let r2 = -sin(alpha) * w1 + cos(alpha) * w2;
            let r3 = w3 + dalpha;
            M / 2 * (v1^2 + v2^2 + v3^2) + (I1 * w1^2 + I2 * w2^2 + I3 * w3^2) / 2
                + (Ga * r1^2 + Gb * r2^2 + Ga * r3^2) / 2
                + mp / 2 * (s1^2 + s2^2 + s3^2)
                - mp * g * (gamma[0] * q1 + gamma[1] * q2 + gamma[2] * q3)
        }
        constraints {
            v1 = r * (w2 * gamma[2] - w3 * gamma[1]);
            v2 = r * (w3 * gamma[0] - w1 * gamma[2]);
            v3 = r * (w1 * gamma[1] - w2 * gamma[0]);
        }
    )]
    #[derive(Clone, Copy, Debug)]
    pub struct ChaplyginGyro {
        /// First principal moment of inertia of the ball.
        pub I1: f64,
        /// Second principal moment of inertia of the ball.
        pub I2: f64,
        /// Third principal moment of inertia of the ball.
        pub I3: f64,
        /// Mass of ball and ring.
        pub M: f64,
        /// Moment of inertia of the ring about the ball's third axis and about one diameter.
        pub Ga: f64,
        /// Moment of inertia of the ring about its own axis.
        pub Gb: f64,
        /// Pendulous mass.
        pub mp: f64,
        /// Distance of the mass from the centre.
        pub l: f64,
        /// Gravity.
        pub g: f64,
        /// Radius of the ball.
        pub r: f64,
    }
    projected ProjectedChaplyginGyro
}

catalogued! {
    ChaplyginGyro { state: 10, sections: 8 } of "chaplygin_gyro",
    parameters |p| ChaplyginGyro {
        I1: p["I1"], I2: p["I2"], I3: p["I3"], M: p["M"], Ga: p["Ga"], Gb: p["Gb"],
        mp: p["mp"], l: p["l"], g: p["g"], r: p["r"],
    },
    state |s| [
        s["alpha"], s["beta"], s["g1"], s["g2"], s["g3"],
        s["w1"], s["w2"], s["w3"], s["dalpha"], s["dbeta"],
    ],
    velocity |s| {
        let (dx, dy) = (s["dx"], s["dy"]);
        let column = |a, b| dx * s[a] + dy * s[b];
        [
            s["w1"], s["w2"], s["w3"],
            column("R11", "R21"), column("R12", "R22"), column("R13", "R23"),
            s["dalpha"], s["dbeta"],
        ]
    },
    projected ProjectedChaplyginGyro
}
