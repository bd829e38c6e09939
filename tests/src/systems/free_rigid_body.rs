//! A free rigid body about a fixed point: Euler–Poincaré equations on so(3).
//!
//! CLMM section 6.1 with D = g, CNS equation (9).

use nonholonomic::prelude::*;

use crate::catalogue::catalogued;
use crate::systems::inertia;

/// The body with its inertia tensor as a matrix and its angular velocity as a family.
#[nonholonomic(
    basis { w[3] }
    brackets so(3) { w[0], w[1], w[2] }
    lagrangian { dot(w, I * w) / 2 }
)]
#[derive(Clone, Copy, Debug)]
pub struct FreeRigidBody {
    /// Inertia tensor in the body frame.
    pub I: [[f64; 3]; 3],
}

catalogued! {
    FreeRigidBody { state: 3, sections: 3 } of "free_rigid_body",
    parameters |p| FreeRigidBody { I: inertia(p) },
    state |s| [s["w1"], s["w2"], s["w3"]],
    velocity |s| [s["w1"], s["w2"], s["w3"]]
}

/// The same body written out: scalar entries, scalar velocities, brackets one by one.
#[nonholonomic(
    basis { w1, w2, w3 }
    brackets { [w1, w2] = w3; [w2, w3] = w1; [w3, w1] = w2; }
    lagrangian {
        (I11 * w1^2 + I22 * w2^2 + I33 * w3^2) / 2 + I12 * w1 * w2 + I13 * w1 * w3 + I23 * w2 * w3
    }
)]
#[derive(Clone, Copy, Debug)]
pub struct FreeRigidBodyByEntries {
    /// Moment of inertia about the first body axis.
    pub I11: f64,
    /// Moment of inertia about the second body axis.
    pub I22: f64,
    /// Moment of inertia about the third body axis.
    pub I33: f64,
    /// Entry (1, 2) of the inertia tensor.
    pub I12: f64,
    /// Entry (1, 3) of the inertia tensor.
    pub I13: f64,
    /// Entry (2, 3) of the inertia tensor.
    pub I23: f64,
}

catalogued! {
    FreeRigidBodyByEntries { state: 3, sections: 3 } of "free_rigid_body",
    parameters |p| FreeRigidBodyByEntries {
        I11: p["I11"], I22: p["I22"], I33: p["I33"], I12: p["I12"], I13: p["I13"], I23: p["I23"],
    },
    state |s| [s["w1"], s["w2"], s["w3"]],
    velocity |s| [s["w1"], s["w2"], s["w3"]]
}
