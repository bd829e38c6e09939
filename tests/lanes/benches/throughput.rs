//! Throughput of Runge–Kutta steps of the sleigh, in nanoseconds per step and state:
//!
//! ```sh
//! RUSTFLAGS="-C target-cpu=x86-64-v3" cargo bench -p nh-lanes
//! ```

use std::hint::black_box;
use std::time::Instant;

use nh_lanes::{SleighInput, SleighState, sleigh, starts};
use nonholonomic::prelude::*;
use nonholonomic::wide::{f32x8, f64x4};

const STATES: usize = 512;
const BLOCK: usize = 8;
const STEPS: u32 = 200;
const REPETITIONS: usize = 100;

/// The time per step and state: the sum of the shortest times of small blocks, which others on the machine
/// seldom interrupt.
fn nanoseconds<L: Lanes>() -> f64 {
    let states: Vec<SleighState<L>> = starts(STATES)
        .chunks_exact(L::COUNT)
        .map(|chunk| {
            let component = |k: usize| L::from_lanes(|i| L::Lane::from_f64(chunk[i].to_array()[k]));
            SleighState::from([0, 1, 2, 3, 4].map(component))
        })
        .collect();
    let system = sleigh::<L>(|_| L::Lane::ZERO);
    let input = SleighInput { torque: L::from_f64(0.1) };
    let mut shortest = vec![f64::INFINITY; STATES / BLOCK];
    for _ in 0..REPETITIONS {
        for (shortest, block) in shortest.iter_mut().zip(states.chunks(BLOCK / L::COUNT)) {
            let begin = Instant::now();
            for state in block {
                let mut state = *black_box(state);
                for _ in 0..STEPS {
                    state = Rk4::step(&system, L::ZERO, L::from_f64(0.01), &state, &input);
                }
                black_box(state);
            }
            *shortest = shortest.min(begin.elapsed().as_secs_f64());
        }
    }
    let steps = f64::from(STEPS) * f64::from(u32::try_from(STATES).unwrap_or(u32::MAX));
    1e9 * shortest.iter().sum::<f64>() / steps
}

fn main() {
    println!(
        "RK4 steps of the Chaplygin sleigh, {}",
        if cfg!(target_feature = "avx2") { "with AVX2" } else { "WITHOUT AVX2: set RUSTFLAGS as above" }
    );
    let (platform, fast, lanes) = (nanoseconds::<f64>(), nanoseconds::<Fast<f64>>(), nanoseconds::<f64x4>());
    let (platform32, fast32, lanes32) =
        (nanoseconds::<f32>(), nanoseconds::<Fast<f32>>(), nanoseconds::<f32x8>());
    println!("{:<12}{:>18}{:>20}{:>22}", "scalar", "ns per step", "× platform", "× the same kernel");
    for (name, time, platform, fast) in [
        ("f64", platform, platform, fast),
        ("Fast<f64>", fast, platform, fast),
        ("f64x4", lanes, platform, fast),
        ("f32", platform32, platform32, fast32),
        ("Fast<f32>", fast32, platform32, fast32),
        ("f32x8", lanes32, platform32, fast32),
    ] {
        println!("{name:<12}{time:>18.2}{:>20.2}{:>22.2}", platform / time, fast / time);
    }
}
