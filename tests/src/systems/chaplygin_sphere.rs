//! The Chaplygin sphere: a ball with its centre of mass in the middle and any inertia tensor rolls
//! on a horizontal plane.
//!
//! CLMM section 6.3 (the gyro without its gyroscope). Rolling means that the velocity of the centre
//! is r ω × e₃.

use nonholonomic::prelude::*;

use crate::catalogue::catalogued;
use crate::systems::inertia;
use crate::twins::both;

both! {
    /// Reduced to the vertical seen from the body, an advected parameter: angular velocity and velocity
    /// of the centre, both in the body frame, span se(3).
    #[nonholonomic(
        base { g1, g2, g3 }
        basis { w1, w2, w3, v1, v2, v3 }
        anchor {
            der(g1) = g2 * w3 - g3 * w2;
            der(g2) = g3 * w1 - g1 * w3;
            der(g3) = g1 * w2 - g2 * w1;
        }
        brackets se(3) { w1, w2, w3, v1, v2, v3 }
        lagrangian { m / 2 * (v1^2 + v2^2 + v3^2) + dot([w1, w2, w3], I * [w1, w2, w3]) / 2 }
        constraints {
            v1 = r * (w2 * g3 - w3 * g2);
            v2 = r * (w3 * g1 - w1 * g3);
            v3 = r * (w1 * g2 - w2 * g1);
        }
    )]
    #[derive(Clone, Copy, Debug)]
    pub struct ChaplyginSphere {
        /// Inertia tensor about the centre, in the body frame.
        pub I: [[f64; 3]; 3],
        /// Mass.
        pub m: f64,
        /// Radius.
        pub r: f64,
    }
    projected ProjectedChaplyginSphere
}

catalogued! {
    ChaplyginSphere { state: 6, sections: 6 } of "chaplygin_sphere",
    parameters |p| ChaplyginSphere { I: inertia(p), m: p["m"], r: p["r"] },
    state |s| [s["g1"], s["g2"], s["g3"], s["w1"], s["w2"], s["w3"]],
    velocity |s| {
        let column = |a, b| s["dx"] * s[a] + s["dy"] * s[b];
        [
            s["w1"], s["w2"], s["w3"],
            column("R11", "R21"), column("R12", "R22"), column("R13", "R23"),
        ]
    },
    projected ProjectedChaplyginSphere
}

both! {
    /// Unreduced: the attitude as a rotation matrix from body to space and the centre on the plane. The
    /// anchor is injective, so the brackets follow from it.
    #[nonholonomic(
        base { R[3][3], x, y }
        basis { w1, w2, w3, dx, dy }
        anchor {
            for i in 0..3 {
                der(R[i][0]) = R[i][1] * w3 - R[i][2] * w2;
                der(R[i][1]) = R[i][2] * w1 - R[i][0] * w3;
                der(R[i][2]) = R[i][0] * w2 - R[i][1] * w1;
            }
            der(x) = dx;
            der(y) = dy;
        }
        lagrangian { m / 2 * (dx^2 + dy^2) + dot([w1, w2, w3], I * [w1, w2, w3]) / 2 }
        constraints {
            roll_x: dx = r * (R[1][0] * w1 + R[1][1] * w2 + R[1][2] * w3);
            roll_y: dy = -r * (R[0][0] * w1 + R[0][1] * w2 + R[0][2] * w3);
        }
        emit { multipliers, reactions }
    )]
    #[derive(Clone, Copy, Debug)]
    pub struct ChaplyginSphereWithAttitude {
        /// Inertia tensor about the centre, in the body frame.
        pub I: [[f64; 3]; 3],
        /// Mass.
        pub m: f64,
        /// Radius.
        pub r: f64,
    }
    projected ProjectedChaplyginSphereWithAttitude
}

catalogued! {
    ChaplyginSphereWithAttitude { state: 14, sections: 5 } of "chaplygin_sphere",
    parameters |p| ChaplyginSphereWithAttitude { I: inertia(p), m: p["m"], r: p["r"] },
    state |s| [
        s["R11"], s["R12"], s["R13"], s["R21"], s["R22"], s["R23"], s["R31"], s["R32"], s["R33"],
        s["x"], s["y"], s["w1"], s["w2"], s["w3"],
    ],
    velocity |s| [s["w1"], s["w2"], s["w3"], s["dx"], s["dy"]],
    multipliers [roll_x, roll_y],
    projected ProjectedChaplyginSphereWithAttitude
}
