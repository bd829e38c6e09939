//! Tractors with trailers, hitched on the axles, in relative angles.
//!
//! The benchmark of record has them too, each beside its hand-written equations; `tests/same_systems.rs` says that
//! these agree.

use crate::places::Numbers;
use std::f64::consts::FRAC_PI_2;

macro_rules! tractor {
    (
        $module:ident, $name:literal, $n:literal trailers, $bodies:literal bodies, $states:literal states of $all:literal,
        inertias $inertias:expr, parameters $parameters:literal, velocities from $velocities:literal
    ) => {
        measured! {
            $module, $name,
            Numbers {
                parameters: $parameters, inertias: &$inertias, states: $states, velocities: $velocities,
                singular: &[(2, FRAC_PI_2), (3, FRAC_PI_2)], inputs: 2,
            },
            /// A tractor with trailers.
            struct Tractor, TractorState, TractorInput of 2 {
                m: [T; $bodies], J: [T; $bodies], d: [T; $n], a: T,
            }
            from |p| {
                m: core::array::from_fn(|i| p[i]),
                J: core::array::from_fn(|i| p[$bodies + i]),
                d: core::array::from_fn(|i| p[2 * $bodies + i]),
                a: p[2 * $bodies + $n],
            },
            states $states of $all,
            nh_models::tractor!($n trailers:)
        }
    };
}

tractor! { one, "tractor, 1 trailer", 1 trailers, 2 bodies, 6 states of 8,
inertias [0, 1, 2, 3], parameters 6, velocities from 4 }
tractor! { two, "tractor, 2 trailers", 2 trailers, 3 bodies, 7 states of 10,
inertias [0, 1, 2, 3, 4, 5], parameters 9, velocities from 5 }
tractor! { three, "tractor, 3 trailers", 3 trailers, 4 bodies, 8 states of 12,
inertias [0, 1, 2, 3, 4, 5, 6, 7], parameters 12, velocities from 6 }
tractor! { four, "tractor, 4 trailers", 4 trailers, 5 bodies, 9 states of 14,
inertias [0, 1, 2, 3, 4, 5, 6, 7, 8, 9], parameters 15, velocities from 7 }
tractor! { five, "tractor, 5 trailers", 5 trailers, 6 bodies, 10 states of 16,
inertias [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11], parameters 18, velocities from 8 }
tractor! { six, "tractor, 6 trailers", 6 trailers, 7 bodies, 11 states of 18,
inertias [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13], parameters 21, velocities from 9 }
