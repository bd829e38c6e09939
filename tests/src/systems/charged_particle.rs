//! A charged particle in a magnetic field as a Lagrange–Poincaré system on R³ × S¹.
//!
//! CNS example 6.1 (principal bundle). The connection is A = (−B0 y/2, B0 x/2 + b1 x²/2, a3 x y),
//! its curvature the field B = (a3 x, −a3 y, B0 + b1 x), and the charge is the momentum of the circle.

use nonholonomic::prelude::*;

use crate::catalogue::catalogued;

/// Reduced to the Atiyah algebroid: the brackets of the horizontal sections are the curvature.
#[nonholonomic(
    base  { x, y, z }
    basis { dx, dy, dz, p }
    anchor { der(x) = dx; der(y) = dy; der(z) = dz; }
    brackets {
        [dx, dy] = -(B0 + b1 * x) * p;
        [dy, dz] = -a3 * x * p;
        [dz, dx] = a3 * y * p;
    }
    lagrangian { m / 2 * (dx^2 + dy^2 + dz^2) + p^2 / 2 - k / 2 * (x^2 + y^2 + z^2) }
)]
#[derive(Clone, Copy, Debug)]
pub struct ChargedParticle {
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
    ChargedParticle { state: 7, sections: 4 } of "charged_particle_kk",
    parameters |p| ChargedParticle { m: p["m"], B0: p["B0"], b1: p["b1"], a3: p["a3"], k: p["k"] },
    state |s| [s["x"], s["y"], s["z"], s["dx"], s["dy"], s["dz"], s["p"]],
    velocity |s| [s["dx"], s["dy"], s["dz"], s["p"]]
}

/// With the angle of the circle kept: the connection form is one of the coframe's forms.
#[nonholonomic(
    base { x, y, z, theta }
    velocities {
        dx = der(x);
        dy = der(y);
        dz = der(z);
        p = der(theta) - B0 * y / 2 * der(x) + (B0 * x / 2 + b1 * x^2 / 2) * der(y) + a3 * x * y * der(z);
    }
    lagrangian { m / 2 * (dx^2 + dy^2 + dz^2) + p^2 / 2 - k / 2 * (x^2 + y^2 + z^2) }
)]
#[derive(Clone, Copy, Debug)]
pub struct ChargedParticleCoframe {
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
    ChargedParticleCoframe { state: 8, sections: 4 } of "charged_particle_kk",
    parameters |p| ChargedParticleCoframe {
        m: p["m"], B0: p["B0"], b1: p["b1"], a3: p["a3"], k: p["k"],
    },
    state |s| [s["x"], s["y"], s["z"], s["theta"], s["dx"], s["dy"], s["dz"], s["p"]],
    velocity |s| [s["dx"], s["dy"], s["dz"], s["p"]]
}

/// Unreduced, in coordinates.
#[nonholonomic(
    base { x, y, z, theta }
    lagrangian {
        let A = [-B0 * y / 2, B0 * x / 2 + b1 * x^2 / 2, a3 * x * y];
        let v = [der(x), der(y), der(z)];
        m / 2 * dot(v, v) + (dot(A, v) + der(theta))^2 / 2 - k / 2 * (x^2 + y^2 + z^2)
    }
)]
#[derive(Clone, Copy, Debug)]
pub struct ChargedParticleOnTheBundle {
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
    ChargedParticleOnTheBundle { state: 8, sections: 4 } of "charged_particle_kk",
    parameters |p| ChargedParticleOnTheBundle {
        m: p["m"], B0: p["B0"], b1: p["b1"], a3: p["a3"], k: p["k"],
    },
    state |s| [s["x"], s["y"], s["z"], s["theta"], s["dx"], s["dy"], s["dz"], s["dtheta"]],
    velocity |s| [s["dx"], s["dy"], s["dz"], s["dtheta"]]
}
