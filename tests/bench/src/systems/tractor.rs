//! A tractor that pulls trailers, hitched on its axle and on theirs, in relative angles.
//!
//! The trailers' velocities are proportional to that of the tractor: with C_i = cos rel_1 … cos rel_i,
//! the axle of trailer i moves at C_i v and turns at −S_i v, S_i = C_{i−1} sin rel_i / d_i, so that the
//! equations are those of one speed with a mass that depends on the angles.

use nonholonomic::prelude::*;

use crate::contest::contest;

/// A tractor with a number of trailers, its hand-written equations, and its place in the contest.
macro_rules! tractor {
    ($Tractor:ident, $State:ident, $Input:ident, $name:literal, $trailers:literal, $bodies:literal, $states:literal, [$($i:literal)*]) => {
        nh_models::tractor! {
            $trailers trailers:
            /// A tractor with trailers.
            #[derive(Clone, Copy, Debug)]
            pub struct $Tractor { m: [f64; $bodies], J: [f64; $bodies], d: [f64; $trailers], a: f64 }
            emit { jacobian, sparse_jacobian }
        }

        contest! {
            $Tractor as $name, $states states, 2 inputs of $Input,
            parameters [p.m[0], p.J[0], p.a $(, p.m[$i + 1], p.J[$i + 1], p.d[$i])*] of p,
            $Tractor {
                m: core::array::from_fn(|i| 1.5 / (1.0 + 0.4 * i as f64)),
                J: core::array::from_fn(|i| 0.4 / (1.0 + i as f64)),
                d: core::array::from_fn(|i| 0.9 - 0.05 * i as f64),
                a: 0.25,
            },
            hand |s, _t, x, u| {
                let (sin_th, cos_th) = x.th.sin_cos();
                let pairs = [$(x.rel[$i].sin_cos()),*];
                // C, S and their rates for v = 1, the mass and half its rate, along the chain;
                // body i turns at −S v
                let (mut run, mut run_rate, mut turn) = (1.0, 0.0, -x.omega);
                let (mut mass, mut bias) = (s.m[0], 0.0);
                let mut rel_dot = [0.0; $trailers];
                $(
                    let (sin, cos) = pairs[$i];
                    let (side, next) = (run * sin, run * cos);
                    let over = 1.0 / s.d[$i];
                    let spin = side * over;
                    let before = turn;
                    turn = spin * x.v;
                    let rate = before - turn;
                    rel_dot[$i] = rate;
                    let spin_rate = run_rate.mul_add(sin, next * rate) * over;
                    run_rate = run_rate.mul_add(cos, -(side * rate));
                    run = next;
                    let (momentum, moment) = (s.m[$i + 1] * next, s.J[$i + 1] * spin);
                    mass = momentum.mul_add(next, moment.mul_add(spin, mass));
                    bias = momentum.mul_add(run_rate, moment.mul_add(spin_rate, bias));
                )*
                let _ = (run, run_rate, turn);
                let ma = s.m[0] * s.a;
                let pull = ma * x.omega;
                $State {
                    x: x.v * cos_th,
                    y: x.v * sin_th,
                    th: x.omega,
                    rel: rel_dot,
                    v: x.v.mul_add(-bias, pull.mul_add(x.omega, u.push)) / mass,
                    omega: pull.mul_add(-x.v, u.steer) / ma.mul_add(s.a, s.J[0]),
                }
            }
        }
    };
}

tractor!(Tractor1, Tractor1State, Tractor1Input, "tractor, 1 trailer", 1, 2, 6, [0]);
tractor!(Tractor2, Tractor2State, Tractor2Input, "tractor, 2 trailers", 2, 3, 7, [0 1]);
tractor!(Tractor3, Tractor3State, Tractor3Input, "tractor, 3 trailers", 3, 4, 8, [0 1 2]);
tractor!(Tractor4, Tractor4State, Tractor4Input, "tractor, 4 trailers", 4, 5, 9, [0 1 2 3]);
tractor!(Tractor5, Tractor5State, Tractor5Input, "tractor, 5 trailers", 5, 6, 10, [0 1 2 3 4]);
tractor!(Tractor6, Tractor6State, Tractor6Input, "tractor, 6 trailers", 6, 7, 11, [0 1 2 3 4 5]);
