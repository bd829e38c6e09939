//! Instructions of whole steps around emitted derivatives, and of the same steps around derivatives by hand.
//!
//! ```sh
//! RUSTFLAGS="-C target-cpu=x86-64-v3" cargo run --release -p nh-bench --bin whole_steps
//! ```
//!
//! Steps of explicit methods are pure functions, at the states of the contest; those of implicit ones are of
//! simulations from each of these states. Each figure is the mean over all of them. A second table has their times, a third
//! three systems in single precision, in lanes, with the runtime's own sine, and steps with their derivatives.
#![allow(clippy::cast_precision_loss, reason = "counts stay far below 2⁵²")]
#![allow(non_snake_case, reason = "parameters are written as in mechanics: J, I")]

mod generic;
mod times;

use std::hint::black_box;
use std::process::ExitCode;

use nh_bench::contest::{ByHand, Contest, SAMPLES, samples};
use nh_bench::contest_table::{cell, geometric_mean};
use nh_bench::systems::{
    arm, balancing_robot, ball, ball_with_rotors, car, chaplygin_ball, disk, elbow, finned_body, five_bar,
    four_bar, four_wheels, furuta, heavy_top, hitched_trailer, leg, off_axle, pendulum, quadrotor,
    rattleback, rear_steered, robot, roller_racer, roller_walker, satellite, sleigh, slider_crank,
    snakeboard, tractor, veselova,
};
use nh_counted::{callgrind, program};
use nonholonomic::Method;
use nonholonomic::prelude::*;

/// Instructions are counted from the beginning of the one function to that of the other.
const COUNTED: [&str; 2] = ["*counted_steps*", "*end_of_steps*"];
/// The steps that are counted together.
const STEPS: u32 = 4;
/// Their length.
const H: f64 = 0.01;
/// The methods, in the order in which they are counted.
const METHODS: [&str; 4] = ["Rk4", "Dop853", "ImplicitMidpoint", "Radau5"];

/// Callgrind counts from the beginning of this function to that of the next.
#[inline(never)]
fn counted_steps(steps: &mut dyn FnMut()) {
    steps();
    end_of_steps();
}

#[inline(never)]
fn end_of_steps() {
    black_box(());
}

/// Counts the steps of a method as a pure function, from each sample.
macro_rules! functions {
    ($Method:ident, $system:ident, $samples:ident) => {
        for (state, input) in $samples {
            counted_steps(&mut || {
                for _ in 0..STEPS {
                    black_box($Method::step(black_box(&$system), 0.0, H, black_box(state), input));
                }
            });
        }
    };
}

/// Counts the steps of a simulation, after the first few, from each sample.
fn simulation<S, M>(system: &S, method: M, samples: &[(S::State, S::Input)])
where
    S: Dynamics<State: State<Scalar = f64>> + Clone,
    M: Method<S> + Copy,
{
    for (state, input) in samples {
        let mut sim = Integrator::new(system.clone(), method, 0.0, *state);
        sim.set_input(*input);
        for _ in 0..STEPS {
            let _ = sim.step();
        }
        counted_steps(&mut || {
            for _ in 0..STEPS {
                let _ = black_box(sim.step());
            }
        });
    }
}

/// Counts the steps of all methods.
fn count<S>(system: S, samples: &[(S::State, S::Input)])
where
    S: Dynamics<State: State<Scalar = f64>> + Copy,
{
    functions!(Rk4, system, samples);
    functions!(Dop853, system, samples);
    simulation(&system, ImplicitMidpoint::new(H), samples);
    simulation(&system, Radau5::new().rtol(1e-6).first_step(H).max_step(H), samples);
}

/// The systems of the contest: their names, and what counts the steps around the emitted derivative and around
/// that by hand.
macro_rules! systems {
    ($($System:path),* $(,)?) => {
        /// The names in the tables.
        const NAMES: &[&str] = &[$(<$System>::NAME),*];

        fn count_all() {
            $(
                count(<$System>::ordinary(), &samples::<$System>());
                count(ByHand(<$System>::ordinary()), &samples::<$System>());
            )*
        }

        /// Nanoseconds per step, by system: emitted before by hand, by method.
        fn time_all() -> Vec<Option<f64>> {
            let mut found = Vec::new();
            $(
                let system = <$System>::ordinary();
                found.extend(times::in_turns(system, ByHand(system), &samples::<$System>()).map(Some));
            )*
            found
        }
    };
}
systems!(
    sleigh::Sleigh,
    veselova::Veselova,
    snakeboard::Snakeboard,
    robot::Robot,
    ball::Ball,
    tractor::Tractor1,
    tractor::Tractor2,
    tractor::Tractor3,
    tractor::Tractor4,
    tractor::Tractor5,
    tractor::Tractor6,
    car::Car,
    roller_racer::RollerRacer,
    hitched_trailer::HitchedTrailer,
    balancing_robot::BalancingRobot,
    satellite::Satellite,
    chaplygin_ball::ChaplyginBall,
    pendulum::Pendulum,
    arm::Arm2,
    arm::Arm4,
    arm::Arm6,
    quadrotor::Quadrotor,
    four_bar::FourBar,
    roller_walker::RollerWalker,
    rattleback::Rattleback,
    rattleback::Stone,
    four_wheels::FourWheels,
    finned_body::FinnedBody,
    ball_with_rotors::BallWithRotors,
    heavy_top::HeavyTop,
    disk::Disk,
    rear_steered::RearSteered,
    furuta::Furuta,
    leg::Leg,
    elbow::Elbow,
    five_bar::FiveBar,
    slider_crank::SliderCrank,
    off_axle::OffAxle,
);

fn main() -> ExitCode {
    let evaluate = |parts: &[String]| {
        match parts.first() {
            Some(part) => generic::count_part(part),
            None => count_all(),
        }
        Ok(())
    };
    program::main(evaluate, measure)
}

fn measure(_: &[String]) -> Result<(), String> {
    program::warn_without_fma();
    generic::compare_all()?;
    if !callgrind::is_present() {
        println!("valgrind is not there: nothing is counted");
        return Ok(());
    }
    let own = program::count_each(COUNTED, &[], NAMES.len() * 2 * METHODS.len() * SAMPLES)?;
    let own: Vec<Option<u64>> = own.into_iter().map(Some).collect();
    let methods = METHODS.map(|method| format!("`{method}`"));
    print(NAMES, methods.each_ref(), &means(&own), 0);
    println!();
    print(NAMES, methods.map(|method| format!("{method}, ns")).each_ref(), &time_all(), 1);
    println!();
    // each by itself: valgrind does not know every instruction that a compiler may take
    let mut found = Vec::new();
    for (part, columns) in generic::PARTS {
        match program::count_each(COUNTED, &[part], columns * SAMPLES) {
            Ok(counts) => found.extend(counts.into_iter().map(Some)),
            Err(message) => {
                eprintln!("{part}: {message}");
                found.extend(std::iter::repeat_n(None, columns * SAMPLES));
            }
        }
    }
    print(&generic::NAMES, generic::COLUMNS.map(str::to_owned).each_ref(), &means(&found), 0);
    Ok(())
}

/// What a step costs of each, from what was counted from each sample.
fn means(counts: &[Option<u64>]) -> Vec<Option<f64>> {
    let per_step = 1.0 / (SAMPLES as f64 * f64::from(STEPS));
    let sum = |counts: &[Option<u64>]| counts.iter().copied().sum::<Option<u64>>();
    counts.chunks(SAMPLES).map(|counts| Some(sum(counts)? as f64 * per_step)).collect()
}

/// Prints a table by rows, emitted before by hand, and by columns.
fn print<const N: usize>(names: &[&str], columns: [&String; N], means: &[Option<f64>], digits: usize) {
    println!(
        "| system | {} |",
        columns.map(|column| format!("{column}, by hand | emitted | ratio")).join(" | ")
    );
    println!("|---|{}", "--:|--:|--:|".repeat(N));
    let mut ratios = [const { Vec::new() }; N];
    for (name, means) in names.iter().zip(means.chunks(2 * N)) {
        let (emitted, by_hand) = means.split_at(N);
        let mut cells = Vec::new();
        for ((emitted, by_hand), ratios) in emitted.iter().zip(by_hand).zip(&mut ratios) {
            let ratio = emitted.zip(*by_hand).map(|(emitted, by_hand)| emitted / by_hand);
            ratios.push(ratio);
            cells.push([cell(*by_hand, digits), cell(*emitted, digits), cell(ratio, 2)].join(" | "));
        }
        println!("| {name} | {} |", cells.join(" | "));
    }
    let mean = |ratios: &Vec<Option<f64>>| cell(geometric_mean(ratios.iter().copied()), 3);
    let worst = |ratios: &Vec<Option<f64>>| cell(ratios.iter().flatten().copied().reduce(f64::max), 2);
    println!("| geometric mean | {} |", ratios.each_ref().map(|r| format!("| | {}", mean(r))).join(" | "));
    println!("| worst | {} |", ratios.each_ref().map(|r| format!("| | {}", worst(r))).join(" | "));
}
