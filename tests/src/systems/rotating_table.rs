//! A homogeneous ball that rolls on a table which rotates about its normal: an affine constraint.
//!
//! CLMM section 7.4. Energy is not conserved, the moving energy is (Fassò and Sansonetto): the
//! energy less Ω times the momentum of the rotation about the axis of the table.

use nonholonomic::prelude::*;

use crate::catalogue::{Moving, Reading, catalogued};
use crate::twins::both;

both! {
    /// On TR² × so(3), with the angular velocity in the frame of space.
    #[nonholonomic(
        base  { x, y }
        basis { dx, dy, wx, wy, wz }
        anchor { der(x) = dx; der(y) = dy; }
        brackets { [wx, wy] = -wz; [wy, wz] = -wx; [wz, wx] = -wy; }
        lagrangian { m / 2 * (dx^2 + dy^2 + k2 * (wx^2 + wy^2 + wz^2)) }
        constraints { roll_x: dx = r * wy - Omega * y; roll_y: dy = -r * wx + Omega * x; }
        conserved {
            spin = wz;
            contact_x = r * dx + k2 * wy;
            contact_y = r * dy - k2 * wx;
            moving = m / 2 * (dx^2 + dy^2 + k2 * (wx^2 + wy^2 + wz^2))
                - Omega * m * (x * dy - y * dx + k2 * wz);
        }
        emit { multipliers, reactions }
    )]
    #[derive(Clone, Copy, Debug)]
    pub struct BallOnRotatingTable {
        /// Mass.
        pub m: f64,
        /// Radius.
        pub r: f64,
        /// Square of the radius of gyration.
        pub k2: f64,
        /// Angular velocity of the table.
        pub Omega: f64,
    }
    projected ProjectedBallOnRotatingTable
}

catalogued! {
    BallOnRotatingTable { state: 5, sections: 5 } of "ball_rotating_table",
    parameters |p| BallOnRotatingTable { m: p["m"], r: p["r"], k2: p["k2"], Omega: p["Omega"] },
    state |s| [s["x"], s["y"], s["wx"], s["wy"], s["wz"]],
    velocity |s| [s["dx"], s["dy"], s["wx"], s["wy"], s["wz"]],
    multipliers [roll_x, roll_y],
    projected ProjectedBallOnRotatingTable
}

both! {
    /// Unreduced, in angles with R = `Rx(a) Ry(b) Rz(c)`, by a coframe: two of its forms are the velocity
    /// of the point of contact, on which the constraints are affine.
    #[nonholonomic(
        base { x, y, a, b, c }
        velocities {
            wx = der(a) + sin(b) * der(c);
            wy = cos(a) * der(b) - sin(a) * cos(b) * der(c);
            wz = sin(a) * der(b) + cos(a) * cos(b) * der(c);
            sx = der(x) - r * (cos(a) * der(b) - sin(a) * cos(b) * der(c));
            sy = der(y) + r * (der(a) + sin(b) * der(c));
        }
        lagrangian { m / 2 * (der(x)^2 + der(y)^2 + k2 * (wx^2 + wy^2 + wz^2)) }
        constraints { roll_x: sx = -Omega * y; roll_y: sy = Omega * x; }
        emit { multipliers, reactions }
    )]
    #[derive(Clone, Copy, Debug)]
    pub struct BallOnRotatingTableCoframe {
        /// Mass.
        pub m: f64,
        /// Radius.
        pub r: f64,
        /// Square of the radius of gyration.
        pub k2: f64,
        /// Angular velocity of the table.
        pub Omega: f64,
    }
    projected ProjectedBallOnRotatingTableCoframe
}

catalogued! {
    BallOnRotatingTableCoframe { state: 8, sections: 5 } of "ball_rotating_table",
    parameters |p| BallOnRotatingTableCoframe { m: p["m"], r: p["r"], k2: p["k2"], Omega: p["Omega"] },
    state |s| {
        let [a, b, c] = angles(s);
        [s["x"], s["y"], a, b, c, s["wx"], s["wy"], s["wz"]]
    },
    velocity |s| [s["wx"], s["wy"], s["wz"], s["sx"], s["sy"]],
    angles [2, 4],
    multipliers [roll_x, roll_y],
    projected ProjectedBallOnRotatingTableCoframe
}

fn angles(s: &Reading) -> [Moving; 3] {
    let cosine = (s["R11"] * s["R11"] + s["R12"] * s["R12"]).sqrt();
    [(-s["R23"]).atan2(s["R33"]), s["R13"].atan2(cosine), (-s["R12"]).atan2(s["R11"])]
}
