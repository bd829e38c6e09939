//! Rollouts of many initial states, inputs and parameter sets at once.
//!
//! The members of a batch stand in a slice, in whatever struct is convenient. [`for_each`] goes through
//! it in groups of as many as there are lanes; [`gather`] and [`pack`] collect numbers and states of a
//! group in lanes, [`scatter`] and [`unpack`] bring results back. In between stands an ordinary loop with
//! any fixed-step method. With the feature `rayon`, `par_for_each` spreads the groups over the cores.
//! Nothing is allocated.
//!
//! The lanes are a type that the caller chooses: `f64x4` or `f32x8` with the feature `wide`, or `f64`, `f32`
//! and [`Fast`](crate::Fast) one by one. The results of `Fast<f64>` and `f64x4` are equal bit for bit.
//!
//! ```
//! use nonholonomic::batch::{self, gather, pack, scatter, unpack};
//! use nonholonomic::prelude::*;
//! # #[cfg(not(feature = "wide"))] type Pack = Fast<f64>;
//! # #[cfg(feature = "wide")]
//! type Pack = nonholonomic::wide::f64x4;
//!
//! /// A wheel that a torque turns against friction.
//! #[nonholonomic(
//!     base       { angle }
//!     lagrangian { J / 2 * der(angle)^2 }
//!     forces     { angle: torque - c * der(angle); }
//!     inputs     { torque }
//! )]
//! #[derive(Clone, Copy, Debug)]
//! struct Wheel<T> { J: T, c: T }
//!
//! /// One rollout: its parameters, state, inputs and cost.
//! #[derive(Clone, Copy)]
//! struct Trial { inertia: f64, state: WheelState<f64>, torque: [f64; 50], cost: f64 }
//!
//! let mut trials = [10, 11, 12, 13, 14].map(|i| Trial {
//!     inertia: 0.1 * f64::from(i),
//!     state: WheelState { angle: 0.0, angle_dot: 1.0 },
//!     torque: core::array::from_fn(|step| if step % 2 == 0 { 0.5 } else { -0.1 }),
//!     cost: 0.0,
//! });
//! let dt = Pack::from_f64(0.01);
//! batch::for_each::<Pack, _>(&mut trials, |group| {
//!     let wheel = Wheel { J: gather(group, |trial| trial.inertia), c: Pack::from_f64(0.2) };
//!     let mut state: WheelState<Pack> = pack(group, |trial| trial.state);
//!     let mut cost = Pack::ZERO;
//!     for step in 0..50 {
//!         let input = WheelInput { torque: gather(group, |trial| trial.torque[step]) };
//!         state = Rk4::step(&wheel, Pack::ZERO, dt, &state, &input);
//!         cost += dt * state.angle * state.angle;
//!     }
//!     unpack(&state, group, |trial, state| trial.state = state);
//!     scatter(cost, group, |trial, cost| trial.cost = cost);
//! });
//! // the lighter the wheel, the further it went
//! assert!(trials[0].state.angle > trials[4].state.angle && trials[0].cost > trials[4].cost);
//! ```

use crate::{Dim, Lanes, Scalar, State};

/// Calls a function with one group of members after the other: `L::COUNT` of them, and what is left in the last.
#[inline]
pub fn for_each<L: Lanes, M>(members: &mut [M], mut group: impl FnMut(&mut [M])) {
    for members in members.chunks_mut(L::COUNT.max(1)) {
        group(members);
    }
}

/// As [`for_each`], on all cores.
#[cfg(feature = "rayon")]
pub fn par_for_each<L: Lanes, M: Send>(members: &mut [M], group: impl Fn(&mut [M]) + Sync + Send) {
    use rayon::iter::ParallelIterator;
    use rayon::slice::ParallelSliceMut;

    members.par_chunks_mut(L::COUNT.max(1)).for_each(group);
}

/// A number of each member, in lanes. Where members are missing the last one stands in, so that no lane
/// computes with what nobody has given; the pack is zero if there are none.
#[inline]
pub fn gather<L: Lanes, M>(group: &[M], mut number: impl FnMut(&M) -> L::Lane) -> L {
    L::from_lanes(|lane| group.get(lane).or(group.last()).map_or(L::Lane::ZERO, &mut number))
}

/// Gives each member the number of its lane.
#[inline]
pub fn scatter<L: Lanes, M>(numbers: L, group: &mut [M], mut put: impl FnMut(&mut M, L::Lane)) {
    for (lane, member) in group.iter_mut().enumerate().take(L::COUNT) {
        put(member, numbers.lane(lane));
    }
}

/// The states of the members of a group, in lanes: [`gather`] for every component.
#[inline]
pub fn pack<Y, X, M>(group: &[M], mut state: impl FnMut(&M) -> X) -> Y
where
    X: State,
    Y: State<Dim = X::Dim, Scalar: Lanes<Lane = X::Scalar>>,
{
    let mut packed = <Y::Dim as Dim>::vec(Y::Scalar::ZERO);
    for (k, component) in packed.as_mut().iter_mut().enumerate() {
        *component = gather(group, |member| entry(&state(member), k));
    }
    Y::from_array(packed)
}

/// Gives each member the state of its lane.
#[inline]
pub fn unpack<Y, X, M>(states: &Y, group: &mut [M], mut put: impl FnMut(&mut M, X))
where
    X: State,
    Y: State<Dim = X::Dim, Scalar: Lanes<Lane = X::Scalar>>,
{
    let states = states.to_array();
    for (lane, member) in group.iter_mut().enumerate().take(Y::Scalar::COUNT) {
        let mut alone = <X::Dim as Dim>::vec(X::Scalar::ZERO);
        for (component, pack) in alone.as_mut().iter_mut().zip(states.as_ref()) {
            *component = pack.lane(lane);
        }
        put(member, X::from_array(alone));
    }
}

/// A component of a state; there is always one.
#[inline]
fn entry<X: State>(state: &X, k: usize) -> X::Scalar {
    state.to_array().as_ref().get(k).copied().unwrap_or(X::Scalar::ZERO)
}
