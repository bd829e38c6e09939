//! Reference systems by frames, by the sections that span the distribution, and on embedded bases
//! with their identities declared.

use nonholonomic::prelude::*;

use crate::catalogue::catalogued;
use crate::systems::inertia;
use crate::twins::both;

/// The snakeboard without its constraints: the distribution is spanned by
/// s = sin φ ∂_θ − l cos φ u₁ and the rates of rotor and wheels (M).
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
    frame { s = sin(phi) * dtheta - l * cos(phi) * u1; }
    distribution { s, dpsi, dphi }
    lagrangian {
        m / 2 * (u1^2 + u2^2) + m * l^2 / 2 * dtheta^2 + J0 / 2 * dpsi^2 + J0 * dpsi * dtheta + J1 * dphi^2
    }
    forces { psi: Ar * sin(wr * t); phi: As * sin(ws * t); }
)]
#[derive(Clone, Copy, Debug)]
pub struct SnakeboardBySpan {
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
    SnakeboardBySpan { state: 8, sections: 5 } of "snakeboard",
    parameters |p| SnakeboardBySpan {
        m: p["m"], l: p["l"], J0: p["J0"], J1: p["J1"], Ar: p["Ar"], wr: p["wr"], As: p["As"], ws: p["ws"],
    },
    state |s| {
        let (sin, _) = s["phi"].sin_cos();
        [s["x"], s["y"], s["theta"], s["psi"], s["phi"], s["dtheta"] / sin, s["dpsi"], s["dphi"]]
    },
    velocity |s| [s["u1"], s["u2"], s["dtheta"], s["dpsi"], s["dphi"]]
}

/// The charged particle through its connection: horizontal lifts of the coordinate fields, and the
/// turning of the circle.
#[nonholonomic(
    base { x, y, z, theta }
    basis { d1, d2, d3, xi }
    anchor { der(x) = d1; der(y) = d2; der(z) = d3; der(theta) = xi; }
    frame {
        let A = [-B0 * y / 2, B0 * x / 2 + b1 * x^2 / 2, a3 * x * y];
        h1 = d1 - A[0] * xi;
        h2 = d2 - A[1] * xi;
        h3 = d3 - A[2] * xi;
        p = xi;
    }
    lagrangian { m / 2 * (h1^2 + h2^2 + h3^2) + p^2 / 2 - k / 2 * (x^2 + y^2 + z^2) }
    conserved { charge = p; }
)]
#[derive(Clone, Copy, Debug)]
pub struct ChargedParticleByConnection {
    /// Mass.
    pub m: f64,
    /// Uniform part of the field along the third axis.
    pub B0: f64,
    /// Gradient of that part.
    pub b1: f64,
    /// Strength of the transverse field.
    pub a3: f64,
    /// Stiffness of the trap.
    pub k: f64,
}

catalogued! {
    ChargedParticleByConnection { state: 8, sections: 4 } of "charged_particle_kk",
    parameters |p| ChargedParticleByConnection {
        m: p["m"], B0: p["B0"], b1: p["b1"], a3: p["a3"], k: p["k"],
    },
    state |s| [s["x"], s["y"], s["z"], s["theta"], s["dx"], s["dy"], s["dz"], s["p"]],
    velocity |s| [s["dx"], s["dy"], s["dz"], s["p"]]
}

/// Veselova's system on the unit sphere.
#[nonholonomic(
    base { g[3] }
    on { dot(g, g) = 1; }
    basis { w[3] }
    anchor { der(g) = cross(g, w); }
    brackets so(3) { w[0], w[1], w[2] }
    lagrangian  { dot(w, I * w) / 2 - dot(c, g) }
    constraints { veselova: dot(g, w) = 0; }
    emit { multipliers, reactions }
)]
#[derive(Clone, Copy, Debug)]
pub struct VeselovaOnSphere {
    /// Inertia tensor in the body frame.
    pub I: [[f64; 3]; 3],
    /// The potential is ⟨c, g⟩.
    pub c: [f64; 3],
}

catalogued! {
    VeselovaOnSphere { state: 6, sections: 3 } of "veselova",
    parameters |p| VeselovaOnSphere { I: inertia(p), c: [p["c1"], p["c2"], p["c3"]] },
    state |s| [s["g1"], s["g2"], s["g3"], s["w1"], s["w2"], s["w3"]],
    velocity |s| [s["w1"], s["w2"], s["w3"]],
    multipliers [veselova]
}

/// Veselova's system with the whole attitude, `R` from body to space, as a rotation matrix.
#[nonholonomic(
    base { R[3][3] }
    on { for i in 0..3 { for j in 0..i { sum(k in 0..3: R[k][i] * R[k][j]) = 0; } sum(k in 0..3: R[k][i]^2) = 1; } }
    basis { w[3] }
    anchor { for i in 0..3 { der(R[i]) = cross(R[i], w); } }
    brackets so(3) { w[0], w[1], w[2] }
    lagrangian  { dot(w, I * w) / 2 - dot(c, R[2]) }
    constraints { veselova: dot(R[2], w) = 0; }
    emit { multipliers, reactions }
)]
#[derive(Clone, Copy, Debug)]
pub struct VeselovaOnRotations {
    /// Inertia tensor in the body frame.
    pub I: [[f64; 3]; 3],
    /// The potential is ⟨c, g⟩.
    pub c: [f64; 3],
}

catalogued! {
    VeselovaOnRotations { state: 12, sections: 3 } of "veselova",
    parameters |p| VeselovaOnRotations { I: inertia(p), c: [p["c1"], p["c2"], p["c3"]] },
    state |s| [
        s["R11"], s["R12"], s["R13"], s["R21"], s["R22"], s["R23"], s["R31"], s["R32"], s["R33"],
        s["w1"], s["w2"], s["w3"],
    ],
    velocity |s| [s["w1"], s["w2"], s["w3"]],
    multipliers [veselova]
}

/// Without potential, with what Veselova's system keeps on |γ| = 1: the square of the part of the
/// angular momentum that is orthogonal to the vertical.
#[nonholonomic(
    base { g[3] }
    on { dot(g, g) = 1; }
    basis { w[3] }
    anchor { der(g) = cross(g, w); }
    brackets so(3) { w[0], w[1], w[2] }
    lagrangian  { (A * w[0]^2 + B * w[1]^2 + C * w[2]^2) / 2 }
    constraints { veselova: dot(g, w) = 0; }
    conserved {
        let M = [A * w[0], B * w[1], C * w[2]];
        let along = dot(M, g);
        momentum = dot(M, M) - along^2;
        vertical = dot(g, g);
        energy = dot(M, w);
    }
)]
#[derive(Clone, Copy, Debug)]
pub struct FreeVeselova {
    /// Principal moment of inertia about the first axis.
    pub A: f64,
    /// Principal moment of inertia about the second axis.
    pub B: f64,
    /// Principal moment of inertia about the third axis.
    pub C: f64,
}

both! {
    /// The Chaplygin sphere on the unit sphere of directions, with the integrals of its momentum about
    /// the point of contact.
    #[nonholonomic(
        base { g[3] }
        on { dot(g, g) = 1; }
        basis { w[3], v[3] }
        anchor { der(g) = cross(g, w); }
        brackets se(3) { w[0], w[1], w[2], v[0], v[1], v[2] }
        lagrangian { m / 2 * dot(v, v) + dot(w, I * w) / 2 }
        constraints { for i in 0..3 { v[i] = r * cross(w, g)[i]; } }
        conserved {
            // what is conserved is the momentum, to which the antisymmetric part of I does not contribute
            let P[i in 0..3] = sum(j in 0..3: (I[i][j] + I[j][i]) / 2 * w[j]);
            let K = P + m * r * cross(g, v);
            vertical = dot(K, g);
            square = dot(K, K);
        }
    )]
    #[derive(Clone, Copy, Debug)]
    pub struct ChaplyginSphereOnSphere {
        /// Inertia tensor about the centre, in the body frame.
        pub I: [[f64; 3]; 3],
        /// Mass.
        pub m: f64,
        /// Radius.
        pub r: f64,
    }
    projected ProjectedChaplyginSphereOnSphere
}

catalogued! {
    ChaplyginSphereOnSphere { state: 6, sections: 6 } of "chaplygin_sphere",
    parameters |p| ChaplyginSphereOnSphere { I: inertia(p), m: p["m"], r: p["r"] },
    state |s| [s["g1"], s["g2"], s["g3"], s["w1"], s["w2"], s["w3"]],
    velocity |s| {
        let column = |a, b| s["dx"] * s[a] + s["dy"] * s[b];
        [
            s["w1"], s["w2"], s["w3"],
            column("R11", "R21"), column("R12", "R22"), column("R13", "R23"),
        ]
    },
    projected ProjectedChaplyginSphereOnSphere
}
