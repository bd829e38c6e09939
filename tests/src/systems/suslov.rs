//! The Suslov problem: a rigid body whose angular velocity stays orthogonal to a body-fixed vector.
//!
//! CLMM section 6.1, equation (6.2).

use nonholonomic::prelude::*;

use crate::catalogue::catalogued;
use crate::systems::inertia;
use crate::twins::both;

both! {
    /// The constraint covector in general position.
    #[nonholonomic(
        basis { w1, w2, w3 }
        brackets so(3) { w1, w2, w3 }
        lagrangian  { dot([w1, w2, w3], I * [w1, w2, w3]) / 2 }
        constraints { suslov: dot(G, [w1, w2, w3]) = 0; }
        emit { multipliers, reactions }
    )]
    #[derive(Clone, Copy, Debug)]
    pub struct Suslov {
        /// Inertia tensor in the body frame.
        pub I: [[f64; 3]; 3],
        /// The body-fixed vector that the angular velocity is orthogonal to.
        pub G: [f64; 3],
    }
    projected ProjectedSuslov
}

catalogued! {
    Suslov { state: 2, sections: 3 } of "suslov",
    parameters |p| Suslov { I: inertia(p), G: [p["G1"], p["G2"], p["G3"]] },
    state |s| [s["w1"], s["w2"]],
    velocity |s| [s["w1"], s["w2"], s["w3"]],
    multipliers [suslov],
    projected ProjectedSuslov
}

both! {
    /// The constraint covector along the third body axis: one velocity is simply zero.
    #[nonholonomic(
        basis { w1, w2, w3 }
        brackets so(3) { w1, w2, w3 }
        lagrangian  { dot([w1, w2, w3], I * [w1, w2, w3]) / 2 }
        constraints { suslov: w3 = 0; }
        emit { multipliers, reactions }
    )]
    #[derive(Clone, Copy, Debug)]
    pub struct SuslovAlongAxis {
        /// Inertia tensor in the body frame.
        pub I: [[f64; 3]; 3],
    }
    projected ProjectedSuslovAlongAxis
}

catalogued! {
    SuslovAlongAxis { state: 2, sections: 3 } of "suslov",
    parameters |p| SuslovAlongAxis { I: inertia(p) },
    state |s| [s["w1"], s["w2"]],
    velocity |s| [s["w1"], s["w2"], s["w3"]],
    covers |p| p["G1"] == 0.0 && p["G2"] == 0.0,
    multipliers [suslov],
    projected ProjectedSuslovAlongAxis
}
