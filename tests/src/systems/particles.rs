//! Particles with one linear constraint, and a particle in a central force by areal velocity.
//!
//! CNS examples 5.1 and 7.1, CM section 6.

use nonholonomic::prelude::*;

use crate::catalogue::catalogued;
use crate::twins::both;

both! {
    /// The particle with ż = y ẋ by a coframe whose third form vanishes on the constraint (CNS 7.1).
    #[nonholonomic(
        base { x, y, z }
        velocities { w1 = der(x); w2 = der(y); w3 = der(z) - y * der(x); }
        lagrangian { m / 2 * (w1^2 + w2^2 + (w3 + y * w1)^2) - k / 2 * (x^2 + y^2) }
        constraints { phi: w3 = 0; }
        emit { multipliers, reactions }
    )]
    #[derive(Clone, Copy, Debug)]
    pub struct ParticleYCoframe {
        /// Mass.
        pub m: f64,
        /// Stiffness of the potential.
        pub k: f64,
    }
    projected ProjectedParticleYCoframe
}

catalogued! {
    ParticleYCoframe { state: 5, sections: 3 } of "particle_zdot_y_xdot",
    parameters |p| ParticleYCoframe { m: p["m"], k: p["k"] },
    state |s| [s["x"], s["y"], s["z"], s["w1"], s["w2"]],
    velocity |s| [s["w1"], s["w2"], s["w3"]],
    multipliers [phi],
    projected ProjectedParticleYCoframe
}

both! {
    /// The particle with ż = y ẋ in coordinates.
    #[nonholonomic(
        base { x, y, z }
        lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) - k / 2 * (x^2 + y^2) }
        constraints { phi: der(z) = y * der(x); }
        emit { multipliers, reactions }
    )]
    #[derive(Clone, Copy, Debug)]
    pub struct ParticleY {
        /// Mass.
        pub m: f64,
        /// Stiffness of the potential.
        pub k: f64,
    }
    projected ProjectedParticleY
}

catalogued! {
    ParticleY { state: 5, sections: 3 } of "particle_zdot_y_xdot",
    parameters |p| ParticleY { m: p["m"], k: p["k"] },
    state |s| [s["x"], s["y"], s["z"], s["w1"], s["w2"]],
    velocity |s| [s["w1"], s["w2"], s["dz"]],
    multipliers [phi],
    projected ProjectedParticleY
}

both! {
    /// The particle with the integrable constraint ż = x ẋ by a coframe (CM section 6).
    #[nonholonomic(
        base { x, y, z }
        velocities { vx = der(x); vy = der(y); vz = der(z) - x * der(x); }
        lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) }
        constraints { phi: vz = 0; }
        emit { multipliers, reactions }
    )]
    #[derive(Clone, Copy, Debug)]
    pub struct ParticleXCoframe {
        /// Mass.
        pub m: f64,
    }
    projected ProjectedParticleXCoframe
}

catalogued! {
    ParticleXCoframe { state: 5, sections: 3 } of "particle_zdot_x_xdot",
    parameters |p| ParticleXCoframe { m: p["m"] },
    state |s| [s["x"], s["y"], s["z"], s["vx"], s["vy"]],
    velocity |s| [s["vx"], s["vy"], s["vz"]],
    multipliers [phi],
    projected ProjectedParticleXCoframe
}

both! {
    /// The particle with the integrable constraint ż = x ẋ in coordinates.
    #[nonholonomic(
        base { x, y, z }
        lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) }
        constraints { phi: der(z) - x * der(x) = 0; }
        emit { multipliers, reactions }
    )]
    #[derive(Clone, Copy, Debug)]
    pub struct ParticleX {
        /// Mass.
        pub m: f64,
    }
    projected ProjectedParticleX
}

catalogued! {
    ParticleX { state: 5, sections: 3 } of "particle_zdot_x_xdot",
    parameters |p| ParticleX { m: p["m"] },
    state |s| [s["x"], s["y"], s["z"], s["vx"], s["vy"]],
    velocity |s| [s["vx"], s["vy"], s["dz"]],
    multipliers [phi],
    projected ProjectedParticleX
}

/// A particle in the plane under a central force, with the areal velocity r² θ̇ (CNS 5.1).
#[nonholonomic(
    base { r, theta }
    velocities { w1 = der(r); w2 = r^2 * der(theta); }
    lagrangian { m / 2 * (w1^2 + w2^2 / r^2) - m * (c * r^2 / 2 - k / r) }
)]
#[derive(Clone, Copy, Debug)]
pub struct CentralForceAreal {
    /// Mass.
    pub m: f64,
    /// Strength of the inverse-square attraction.
    pub k: f64,
    /// Strength of the linear attraction.
    pub c: f64,
}

catalogued! {
    CentralForceAreal { state: 4, sections: 2 } of "central_force_areal",
    parameters |p| CentralForceAreal { m: p["m"], k: p["k"], c: p["c"] },
    state |s| [s["r"], s["sin_theta"].atan2(s["cos_theta"]), s["w1"], s["w2"]],
    velocity |s| [s["w1"], s["w2"]],
    angles [1]
}

/// The same particle in Cartesian coordinates.
#[nonholonomic(
    base { x, y }
    lagrangian {
        let r = sqrt(x^2 + y^2);
        m / 2 * (der(x)^2 + der(y)^2) - m * (c * r^2 / 2 - k / r)
    }
)]
#[derive(Clone, Copy, Debug)]
pub struct CentralForceCartesian {
    /// Mass.
    pub m: f64,
    /// Strength of the inverse-square attraction.
    pub k: f64,
    /// Strength of the linear attraction.
    pub c: f64,
}

catalogued! {
    CentralForceCartesian { state: 4, sections: 2 } of "central_force_areal",
    parameters |p| CentralForceCartesian { m: p["m"], k: p["k"], c: p["c"] },
    state |s| [s["X"], s["Y"], s["dX"], s["dY"]],
    velocity |s| [s["dX"], s["dY"]]
}
