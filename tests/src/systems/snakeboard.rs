//! The snakeboard: a board on two pairs of wheels that steer against each other, with a rotor.
//!
//! M (example of an Atiyah algebroid); equations of Bloch, Krishnaprasad, Marsden and Murray (1996).
//! The total inertia satisfies m l² = J + J0 + 2 J1. The wheels' constraints become dependent where
//! cos(phi) = 0.

use nonholonomic::prelude::*;

use crate::catalogue::catalogued;

/// In the frame of the board, with torques that depend on time.
#[nonholonomic(
    base  { x, y, theta, psi, phi }
    basis { u1, u2, dtheta, dpsi, dphi }
    anchor {
        der(x) = u1 * cos(theta) - u2 * sin(theta);
        der(y) = u1 * sin(theta) + u2 * cos(theta);
        der(theta) = dtheta;
        der(psi) = dpsi;
        der(phi) = dphi;
    }
    lagrangian {
        m / 2 * (u1^2 + u2^2) + m * l^2 / 2 * dtheta^2 + J0 / 2 * dpsi^2 + J0 * dpsi * dtheta + J1 * dphi^2
    }
    constraints {
        wheel_back:  -sin(phi) * u1 + cos(phi) * u2 - l * cos(phi) * dtheta = 0;
        wheel_front:  sin(phi) * u1 + cos(phi) * u2 + l * cos(phi) * dtheta = 0;
    }
    independent { u1, dpsi, dphi }
    forces { psi: Ar * sin(wr * t); phi: As * sin(ws * t); }
    emit { multipliers, reactions }
)]
#[derive(Clone, Copy, Debug)]
pub struct Snakeboard {
    /// Mass.
    pub m: f64,
    /// Half the length of the board.
    pub l: f64,
    /// Moment of inertia of the rotor.
    pub J0: f64,
    /// Moment of inertia of each pair of wheels.
    pub J1: f64,
    /// Amplitude of the torque on the rotor.
    pub Ar: f64,
    /// Angular frequency of the torque on the rotor.
    pub wr: f64,
    /// Amplitude of the steering torque.
    pub As: f64,
    /// Angular frequency of the steering torque.
    pub ws: f64,
}

catalogued! {
    Snakeboard { state: 8, sections: 5 } of "snakeboard",
    parameters |p| Snakeboard {
        m: p["m"], l: p["l"], J0: p["J0"], J1: p["J1"], Ar: p["Ar"], wr: p["wr"], As: p["As"], ws: p["ws"],
    },
    state |s| [
        s["x"], s["y"], s["theta"], s["psi"], s["phi"], s["u1"], s["dpsi"], s["dphi"],
    ],
    velocity |s| [s["u1"], s["u2"], s["dtheta"], s["dpsi"], s["dphi"]],
    multipliers [wheel_back, wheel_front]
}

/// In coordinates, with the torques as inputs: no choice of velocities is good for every heading.
#[nonholonomic(
    base { x, y, theta, psi, phi }
    lagrangian {
        m / 2 * (der(x)^2 + der(y)^2 + l^2 * der(theta)^2)
            + J0 / 2 * der(psi)^2 + J0 * der(psi) * der(theta) + J1 * der(phi)^2
    }
    constraints {
        wheel_back:  -sin(theta + phi) * der(x) + cos(theta + phi) * der(y) - l * cos(phi) * der(theta) = 0;
        wheel_front: -sin(theta - phi) * der(x) + cos(theta - phi) * der(y) + l * cos(phi) * der(theta) = 0;
    }
    forces { psi: rotor; phi: steering; }
    inputs { rotor, steering }
    emit { multipliers, reactions }
)]
#[derive(Clone, Copy, Debug)]
pub struct SnakeboardOnThePlane {
    /// Mass.
    pub m: f64,
    /// Half the length of the board.
    pub l: f64,
    /// Moment of inertia of the rotor.
    pub J0: f64,
    /// Moment of inertia of each pair of wheels.
    pub J1: f64,
}

catalogued! {
    SnakeboardOnThePlane { state: 10, sections: 5 } of "snakeboard",
    parameters |p| SnakeboardOnThePlane { m: p["m"], l: p["l"], J0: p["J0"], J1: p["J1"] },
    input |p, t| SnakeboardOnThePlaneInput {
        rotor: p["Ar"] * (p["wr"] * t).sin(),
        steering: p["As"] * (p["ws"] * t).sin(),
    },
    state |s| [
        s["x"], s["y"], s["theta"], s["psi"], s["phi"],
        s["dx"], s["dy"], s["dtheta"], s["dpsi"], s["dphi"],
    ],
    velocity |s| [s["dx"], s["dy"], s["dtheta"], s["dpsi"], s["dphi"]],
    multipliers [wheel_back, wheel_front]
}
