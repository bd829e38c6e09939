//! The Veselova system with a linear potential: a rigid body about a fixed point whose angular
//! velocity stays orthogonal to a vector fixed in space.
//!
//! CLMM section 6.2, equation (6.13).

use nonholonomic::prelude::*;

use crate::catalogue::{Moving, Reading, catalogued};
use crate::systems::inertia;
use crate::twins::both;

/// On the action algebroid S² × so(3): `g` is the vertical seen from the body. The constraint
/// distribution has no global frame, so the state keeps all velocities.
#[nonholonomic(
    base { g[3] }
    basis { w[3] }
    anchor {
        der(g[0]) = g[1] * w[2] - g[2] * w[1];
        der(g[1]) = g[2] * w[0] - g[0] * w[2];
        der(g[2]) = g[0] * w[1] - g[1] * w[0];
    }
    brackets so(3) { w[0], w[1], w[2] }
    lagrangian  { dot(w, I * w) / 2 - dot(c, g) }
    constraints { veselova: dot(g, w) = 0; }
    emit { multipliers, reactions }
)]
#[derive(Clone, Copy, Debug)]
pub struct Veselova {
    /// Inertia tensor in the body frame.
    pub I: [[f64; 3]; 3],
    /// The potential is ⟨c, g⟩.
    pub c: [f64; 3],
}

catalogued! {
    Veselova { state: 6, sections: 3 } of "veselova",
    parameters |p| Veselova { I: inertia(p), c: [p["c1"], p["c2"], p["c3"]] },
    state |s| [s["g1"], s["g2"], s["g3"], s["w1"], s["w2"], s["w3"]],
    velocity |s| [s["w1"], s["w2"], s["w3"]],
    multipliers [veselova]
}

both! {
    /// Unreduced, in Euler angles with R = `Rz(phi) Rx(theta) Rz(psi)`: the angular velocity about the
    /// vertical is `der(phi) + cos(theta) der(psi)`.
    #[nonholonomic(
        base { phi, theta, psi }
        lagrangian {
            let w1 = der(phi) * sin(theta) * sin(psi) + der(theta) * cos(psi);
            let w2 = der(phi) * sin(theta) * cos(psi) - der(theta) * sin(psi);
            let w3 = der(phi) * cos(theta) + der(psi);
            dot([w1, w2, w3], I * [w1, w2, w3]) / 2
                - dot(c, [sin(theta) * sin(psi), sin(theta) * cos(psi), cos(theta)])
        }
        constraints { veselova: der(phi) = -cos(theta) * der(psi); }
    )]
    #[derive(Clone, Copy, Debug)]
    pub struct VeselovaInEulerAngles {
        /// Inertia tensor in the body frame.
        pub I: [[f64; 3]; 3],
        /// The potential is ⟨c, g⟩.
        pub c: [f64; 3],
    }
    projected ProjectedVeselovaInEulerAngles
}

catalogued! {
    VeselovaInEulerAngles { state: 5, sections: 3 } of "veselova",
    parameters |p| VeselovaInEulerAngles { I: inertia(p), c: [p["c1"], p["c2"], p["c3"]] },
    state |s| {
        let (phi, theta, psi) = euler_angles(s);
        let [_, theta_dot, psi_dot] = euler_rates(s, theta, psi);
        [phi, theta, psi, theta_dot, psi_dot]
    },
    velocity |s| {
        let (_, theta, psi) = euler_angles(s);
        euler_rates(s, theta, psi)
    },
    angles [0, 2],
    projected ProjectedVeselovaInEulerAngles
}

fn euler_angles(s: &Reading) -> (Moving, Moving, Moving) {
    let sine = (s["R31"] * s["R31"] + s["R32"] * s["R32"]).sqrt();
    let phi = s["R13"].atan2(-s["R23"]);
    (phi, sine.atan2(s["R33"]), s["R31"].atan2(s["R32"]))
}

fn euler_rates(s: &Reading, theta: Moving, psi: Moving) -> [Moving; 3] {
    let (sin_theta, cos_theta) = theta.sin_cos();
    let (sin_psi, cos_psi) = psi.sin_cos();
    let phi_dot = (s["w1"] * sin_psi + s["w2"] * cos_psi) / sin_theta;
    [phi_dot, s["w1"] * cos_psi - s["w2"] * sin_psi, s["w3"] - phi_dot * cos_theta]
}
