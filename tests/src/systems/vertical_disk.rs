//! An upright disk that rolls on a plane without slipping, with a torque on its roll and one on its
//! heading.
//!
//! CLMM table 1.

use nonholonomic::prelude::*;

use crate::catalogue::catalogued;
use crate::twins::both;

both! {
    /// In coordinates.
    #[nonholonomic(
        base { x, y, theta, phi }
        lagrangian { m / 2 * (der(x)^2 + der(y)^2) + I / 2 * der(theta)^2 + J / 2 * der(phi)^2 }
        constraints {
            roll_x: der(x) = R * cos(phi) * der(theta);
            roll_y: der(y) = R * sin(phi) * der(theta);
        }
        forces { theta: drive; phi: steer; }
        inputs { drive, steer }
        emit { multipliers, reactions }
    )]
    #[derive(Clone, Copy, Debug)]
    pub struct VerticalDisk {
        /// Mass.
        pub m: f64,
        /// Moment of inertia about the axle.
        pub I: f64,
        /// Moment of inertia about the vertical.
        pub J: f64,
        /// Radius.
        pub R: f64,
    }
    projected ProjectedVerticalDisk
}

catalogued! {
    VerticalDisk { state: 6, sections: 4 } of "vertical_disk",
    parameters |p| VerticalDisk { m: p["m"], I: p["I"], J: p["J"], R: p["R"] },
    input |p, _t| VerticalDiskInput { drive: p["ut"], steer: p["up"] },
    state |s| [s["x"], s["y"], s["theta"], s["phi"], s["dtheta"], s["dphi"]],
    velocity |s| [s["dx"], s["dy"], s["dtheta"], s["dphi"]],
    multipliers [roll_x, roll_y],
    projected ProjectedVerticalDisk with 2 inputs
}

both! {
    /// By a coframe that moves with the heading: forward and sideways velocity.
    #[nonholonomic(
        base { x, y, theta, phi }
        velocities {
            forward = cos(phi) * der(x) + sin(phi) * der(y);
            sideways = -sin(phi) * der(x) + cos(phi) * der(y);
            roll = der(theta);
            turn = der(phi);
        }
        lagrangian { m / 2 * (forward^2 + sideways^2) + I / 2 * roll^2 + J / 2 * turn^2 }
        constraints { forward = R * roll; sideways = 0; }
        forces { roll: drive; turn: steer; }
        inputs { drive, steer }
    )]
    #[derive(Clone, Copy, Debug)]
    pub struct VerticalDiskMovingFrame {
        /// Mass.
        pub m: f64,
        /// Moment of inertia about the axle.
        pub I: f64,
        /// Moment of inertia about the vertical.
        pub J: f64,
        /// Radius.
        pub R: f64,
    }
    projected ProjectedVerticalDiskMovingFrame
}

catalogued! {
    VerticalDiskMovingFrame { state: 6, sections: 4 } of "vertical_disk",
    parameters |p| VerticalDiskMovingFrame { m: p["m"], I: p["I"], J: p["J"], R: p["R"] },
    input |p, _t| VerticalDiskMovingFrameInput { drive: p["ut"], steer: p["up"] },
    state |s| [s["x"], s["y"], s["theta"], s["phi"], s["dtheta"], s["dphi"]],
    velocity |s| {
        let (sin, cos) = s["phi"].sin_cos();
        [
            s["dx"] * cos + s["dy"] * sin,
            s["dy"] * cos - s["dx"] * sin,
            s["dtheta"], s["dphi"],
        ]
    },
    projected ProjectedVerticalDiskMovingFrame with 2 inputs
}
