//! How long whole steps take: medians of rounds in which the two derivatives take turns.

use std::hint::black_box;
use std::time::Instant;

use nh_bench::runner::median;
use nonholonomic::Method;
use nonholonomic::prelude::*;

use super::{H, METHODS, STEPS};

/// In so many rounds the two take turns.
const ROUNDS: usize = 101;
/// So many times each round goes through all samples.
const PASSES: usize = 4;

/// Nanoseconds per step of all methods: around the emitted derivative, and around that by hand.
pub(crate) fn in_turns<E, H>(
    emitted: E,
    by_hand: H,
    samples: &[(E::State, E::Input)],
) -> [f64; 2 * METHODS.len()]
where
    E: Dynamics<State: State<Scalar = f64>> + Copy,
    H: Dynamics<State = E::State, Input = E::Input> + Copy,
{
    let mut rounds: [Vec<f64>; 2 * METHODS.len()] = Default::default();
    for _ in 0..ROUNDS {
        let both = round(emitted, samples).into_iter().chain(round(by_hand, samples));
        for (found, nanoseconds) in rounds.iter_mut().zip(both) {
            found.push(nanoseconds);
        }
    }
    rounds.map(median)
}

/// Nanoseconds per step of all methods in a short run.
fn round<S>(system: S, samples: &[(S::State, S::Input)]) -> [f64; METHODS.len()]
where
    S: Dynamics<State: State<Scalar = f64>> + Copy,
{
    [
        functions(samples, |state, input| Rk4::step(black_box(&system), 0.0, H, state, input)),
        functions(samples, |state, input| Dop853::step(black_box(&system), 0.0, H, state, input)),
        simulations(system, ImplicitMidpoint::new(H), samples),
        simulations(system, Radau5::new().rtol(1e-6).first_step(H).max_step(H), samples),
    ]
}

/// Steps that are pure functions, from each sample.
fn functions<X, U, R>(samples: &[(X, U)], step: impl Fn(&X, &U) -> R) -> f64 {
    let start = Instant::now();
    for _ in 0..PASSES {
        for (state, input) in black_box(samples) {
            black_box(step(state, input));
        }
    }
    per_step(start, PASSES * samples.len())
}

/// Steps of simulations, after the first few, from each sample.
fn simulations<S, M>(system: S, method: M, samples: &[(S::State, S::Input)]) -> f64
where
    S: Dynamics<State: State<Scalar = f64>> + Copy,
    M: Method<S> + Copy,
{
    let begun = samples.iter().map(|(state, input)| {
        let mut simulation = Integrator::new(system, method, 0.0, *state);
        simulation.set_input(*input);
        for _ in 0..STEPS {
            let _ = simulation.step();
        }
        simulation
    });
    let mut begun: Vec<_> = begun.collect();
    let start = Instant::now();
    for simulation in &mut begun {
        for _ in 0..STEPS {
            let _ = black_box(simulation.step());
        }
    }
    per_step(start, STEPS as usize * samples.len())
}

fn per_step(start: Instant, steps: usize) -> f64 {
    start.elapsed().as_secs_f64() * 1e9 / steps as f64
}
