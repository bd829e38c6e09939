//! A homogeneous ball that rolls on a fixed horizontal plane.
//!
//! CNS example 7.2. The angular velocity is taken in the frame of space: right-invariant fields, so
//! that the brackets have the sign opposite to those of the body frame.

use nonholonomic::prelude::*;

use crate::catalogue::catalogued;
use crate::twins::both;

both! {
    /// The ball on the plane; `k2` is the square of the radius of gyration.
    #[nonholonomic(
        base  { x, y }
        basis { dx, dy, wx, wy, wz }
        anchor { der(x) = dx; der(y) = dy; }
        brackets { [wx, wy] = -wz; [wy, wz] = -wx; [wz, wx] = -wy; }
        lagrangian { m / 2 * (dx^2 + dy^2 + k2 * (wx^2 + wy^2 + wz^2)) }
        constraints { roll_x: dx = r * wy; roll_y: dy = -r * wx; }
        emit { multipliers, reactions }
    )]
    #[derive(Clone, Copy, Debug)]
    pub struct RollingBall {
        /// Mass.
        pub m: f64,
        /// Radius.
        pub r: f64,
        /// Square of the radius of gyration.
        pub k2: f64,
    }
    projected ProjectedRollingBall
}

catalogued! {
    RollingBall { state: 5, sections: 5 } of "ball_fixed_plane",
    parameters |p| RollingBall { m: p["m"], r: p["r"], k2: p["k2"] },
    state |s| [s["x"], s["y"], s["wx"], s["wy"], s["wz"]],
    velocity |s| [s["dx"], s["dy"], s["wx"], s["wy"], s["wz"]],
    multipliers [roll_x, roll_y],
    projected ProjectedRollingBall
}
