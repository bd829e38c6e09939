//! A rigid body about a fixed point with a rotor along its third axis, driven by a motor.
//!
//! CNS example 6.1.

use nonholonomic::prelude::*;

use crate::catalogue::catalogued;
use crate::systems::inertia;

/// Product of the rotor's circle and so(3); the rotor's velocity is relative to the carrier.
#[nonholonomic(
    base  { alpha }
    basis { w1, w2, w3, dalpha }
    anchor { der(alpha) = dalpha; }
    brackets so(3) { w1, w2, w3 }
    lagrangian {
        dot([w1, w2, w3], I * [w1, w2, w3]) / 2 + Jt / 2 * (w1^2 + w2^2) + J3 / 2 * (w3 + dalpha)^2
    }
    forces { alpha: motor; }
    inputs { motor }
)]
#[derive(Clone, Copy, Debug)]
pub struct RigidBodyRotor {
    /// Inertia tensor of the carrier.
    pub I: [[f64; 3]; 3],
    /// Transverse moment of inertia of the rotor.
    pub Jt: f64,
    /// Axial moment of inertia of the rotor.
    pub J3: f64,
}

catalogued! {
    RigidBodyRotor { state: 5, sections: 4 } of "rigid_body_rotor",
    parameters |p| RigidBodyRotor { I: inertia(p), Jt: p["Jt"], J3: p["J3"] },
    input |p, _t| RigidBodyRotorInput { motor: p["u"] },
    state |s| [s["alpha"], s["w1"], s["w2"], s["w3"], s["dalpha"]],
    velocity |s| [s["w1"], s["w2"], s["w3"], s["dalpha"]]
}

/// With the rotor's absolute spin as velocity: the kinetic energy loses its coupling, and the
/// brackets gain a central extension.
#[nonholonomic(
    base  { alpha }
    basis { w1, w2, w3, spin }
    anchor { der(alpha) = spin - w3; }
    brackets { [w1, w2] = w3 + spin; [w2, w3] = w1; [w3, w1] = w2; }
    lagrangian {
        dot([w1, w2, w3], I * [w1, w2, w3]) / 2 + Jt / 2 * (w1^2 + w2^2) + J3 / 2 * spin^2
    }
    forces { alpha: motor; }
    inputs { motor }
)]
#[derive(Clone, Copy, Debug)]
pub struct RigidBodyRotorAbsolute {
    /// Inertia tensor of the carrier.
    pub I: [[f64; 3]; 3],
    /// Transverse moment of inertia of the rotor.
    pub Jt: f64,
    /// Axial moment of inertia of the rotor.
    pub J3: f64,
}

catalogued! {
    RigidBodyRotorAbsolute { state: 5, sections: 4 } of "rigid_body_rotor",
    parameters |p| RigidBodyRotorAbsolute { I: inertia(p), Jt: p["Jt"], J3: p["J3"] },
    input |p, _t| RigidBodyRotorAbsoluteInput { motor: p["u"] },
    state |s| [s["alpha"], s["w1"], s["w2"], s["w3"], s["w3"] + s["dalpha"]],
    velocity |s| [s["w1"], s["w2"], s["w3"], s["w3"] + s["dalpha"]]
}
