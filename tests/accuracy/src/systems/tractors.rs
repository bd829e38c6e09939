//! Tractors with trailers, hitched on the axles, in relative angles.
//!
//! These are the systems of the benchmark of record, written again as those in [`bodies`](super::bodies) are:
//! there each stands beside its hand-written equations, over `f64`; here every level of accuracy is a
//! declaration of its own, over any number. `tests/same_systems.rs` says that they agree.

use crate::random::Numbers;
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
            {
                base  { x, y, th, rel[$n] }
                basis { v, side, omega, rd[$n] }
                anchor {
                    der(x) = v * cos(th) - side * sin(th);
                    der(y) = v * sin(th) + side * cos(th);
                    der(th) = omega;
                    for i in 0..$n { der(rel[i]) = rd[i]; }
                }
                lagrangian {
                    let ang[i in 0..$n] = sum(j in 0..i+1: rel[j]);
                    let w[i in 0..$n] = omega + sum(j in 0..i+1: rd[j]);
                    let px[i in 0..$n] = v + sum(j in 0..i+1: d[j] * sin(ang[j]) * w[j]);
                    let py[i in 0..$n] = side - sum(j in 0..i+1: d[j] * cos(ang[j]) * w[j]);
                    m[0] / 2 * (v^2 + (side + a * omega)^2) + J[0] / 2 * omega^2
                        + sum(i in 0..$n: J[i+1] / 2 * w[i]^2 + m[i+1] / 2 * (px[i]^2 + py[i]^2))
                }
                constraints {
                    let ang[i in 0..$n] = sum(j in 0..i+1: rel[j]);
                    let w[i in 0..$n] = omega + sum(j in 0..i+1: rd[j]);
                    let px[i in 0..$n] = v + sum(j in 0..i+1: d[j] * sin(ang[j]) * w[j]);
                    let py[i in 0..$n] = side - sum(j in 0..i+1: d[j] * cos(ang[j]) * w[j]);
                    side = 0;
                    for i in 0..$n { cos(ang[i]) * py[i] = sin(ang[i]) * px[i]; }
                }
                inputs { push, steer }
                forces { v: push; omega: steer; }
            }
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
