//! Runs the contestants of one system: compares their values, times them, evaluates them for a profile.

use std::any::type_name;
use std::hint::black_box;
use std::marker::PhantomData;
use std::time::Instant;

use nonholonomic::State;

use crate::contest::{Contest, Random, recorded_samples, samples};
use crate::systems::{
    arm, balancing_robot, ball, ball_with_rotors, car, chaplygin_ball, disk, elbow, finned_body, five_bar,
    four_bar, four_wheels, furuta, heavy_top, hitched_trailer, leg, off_axle, pendulum, quadrotor,
    rattleback, rear_steered, robot, roller_racer, roller_walker, satellite, sleigh, slider_crank,
    snakeboard, tractor, veselova,
};
use nh_counted::callgrind::Counts;

/// Values of different contestants agree to this, relative to numbers of ordinary size.
pub const AGREEMENT: f64 = 1e-12;

/// The contestants that are compiled into the benchmark.
pub const OWN: [&str; 4] = ["by_hand", "emitted", "linearised", "sparse"];

/// A system of the contest, whatever its type.
pub trait Run {
    /// The name in the tables.
    fn name(&self) -> &'static str;
    /// Compares the emitted derivative with the hand-written one.
    ///
    /// # Errors
    /// Where they differ, and by how much.
    fn compare(&self) -> Result<(), String>;
    /// Evaluates each contestant at each sample, from the numbers that states and inputs are made of.
    fn evaluate(&self, numbers: &mut Random);
    /// Nanoseconds per evaluation of each contestant: medians of rounds in which they take turns.
    fn time(&self) -> [f64; OWN.len()];
    /// Instructions per evaluation of each contestant, where the profile has them.
    fn instructions(&self, counts: &Counts) -> [Option<f64>; OWN.len()];
    /// Parameters, and for each sample the state and the inputs, the derivative by hand and the emitted Jacobians: what a
    /// peer is given and compared with.
    fn data(&self) -> Data;
}

/// The evaluation of a system as numbers.
pub struct Data {
    /// The parameters.
    pub parameters: Vec<f64>,
    /// State, inputs, derivative, and its Jacobians row by row.
    pub samples: Vec<[Vec<f64>; 4]>,
}

/// Every system of the contest.
#[must_use]
pub fn all() -> Vec<Box<dyn Run>> {
    vec![
        Box::new(Of::<sleigh::Sleigh>(PhantomData)),
        Box::new(Of::<veselova::Veselova>(PhantomData)),
        Box::new(Of::<snakeboard::Snakeboard>(PhantomData)),
        Box::new(Of::<robot::Robot>(PhantomData)),
        Box::new(Of::<ball::Ball>(PhantomData)),
        Box::new(Of::<tractor::Tractor1>(PhantomData)),
        Box::new(Of::<tractor::Tractor2>(PhantomData)),
        Box::new(Of::<tractor::Tractor3>(PhantomData)),
        Box::new(Of::<tractor::Tractor4>(PhantomData)),
        Box::new(Of::<tractor::Tractor5>(PhantomData)),
        Box::new(Of::<tractor::Tractor6>(PhantomData)),
        Box::new(Of::<car::Car>(PhantomData)),
        Box::new(Of::<roller_racer::RollerRacer>(PhantomData)),
        Box::new(Of::<hitched_trailer::HitchedTrailer>(PhantomData)),
        Box::new(Of::<balancing_robot::BalancingRobot>(PhantomData)),
        Box::new(Of::<satellite::Satellite>(PhantomData)),
        Box::new(Of::<chaplygin_ball::ChaplyginBall>(PhantomData)),
        Box::new(Of::<pendulum::Pendulum>(PhantomData)),
        Box::new(Of::<arm::Arm2>(PhantomData)),
        Box::new(Of::<arm::Arm4>(PhantomData)),
        Box::new(Of::<arm::Arm6>(PhantomData)),
        Box::new(Of::<quadrotor::Quadrotor>(PhantomData)),
        Box::new(Of::<four_bar::FourBar>(PhantomData)),
        Box::new(Of::<roller_walker::RollerWalker>(PhantomData)),
        Box::new(Of::<rattleback::Rattleback>(PhantomData)),
        Box::new(Of::<rattleback::Stone>(PhantomData)),
        Box::new(Of::<four_wheels::FourWheels>(PhantomData)),
        Box::new(Of::<finned_body::FinnedBody>(PhantomData)),
        Box::new(Of::<ball_with_rotors::BallWithRotors>(PhantomData)),
        Box::new(Of::<heavy_top::HeavyTop>(PhantomData)),
        Box::new(Of::<disk::Disk>(PhantomData)),
        Box::new(Of::<rear_steered::RearSteered>(PhantomData)),
        Box::new(Of::<furuta::Furuta>(PhantomData)),
        Box::new(Of::<leg::Leg>(PhantomData)),
        Box::new(Of::<elbow::Elbow>(PhantomData)),
        Box::new(Of::<five_bar::FiveBar>(PhantomData)),
        Box::new(Of::<slider_crank::SliderCrank>(PhantomData)),
        Box::new(Of::<off_axle::OffAxle>(PhantomData)),
    ]
}

/// The runner of a system.
struct Of<S>(PhantomData<S>);

impl<S: Contest> Run for Of<S> {
    fn name(&self) -> &'static str {
        S::NAME
    }

    fn compare(&self) -> Result<(), String> {
        let system = S::ordinary();
        for (state, input) in samples::<S>() {
            let emitted = system.emitted(0.0, &state, &input).to_array();
            let by_hand = system.by_hand(0.0, &state, &input).to_array();
            agree(S::NAME, "emitted", emitted.as_ref(), by_hand.as_ref())?;
            let (rates, entries) = system.sparse(0.0, &state, &input);
            agree(S::NAME, "sparse", rates.to_array().as_ref(), by_hand.as_ref())?;
            let full = S::jacobian(&system.linearised(0.0, &state, &input));
            agree(S::NAME, "sparse", &S::filled(&entries), &full)?;
        }
        Ok(())
    }

    fn evaluate(&self, numbers: &mut Random) {
        let system = S::ordinary();
        for (state, input) in black_box(recorded_samples::<S>(numbers)) {
            black_box(system.by_hand(0.0, &state, &input));
            black_box(system.emitted(0.0, &state, &input));
            black_box(system.linearised(0.0, &state, &input));
            black_box(system.sparse(0.0, &state, &input));
        }
    }

    fn time(&self) -> [f64; OWN.len()] {
        const ROUNDS: usize = 101;
        let mut rounds: [Vec<f64>; OWN.len()] = Default::default();
        for _ in 0..ROUNDS {
            rounds[0].push(timed(S::by_hand));
            rounds[1].push(timed(S::emitted));
            rounds[2].push(timed(S::linearised));
            rounds[3].push(timed(S::sparse));
        }
        rounds.map(median)
    }

    fn instructions(&self, counts: &Counts) -> [Option<f64>; OWN.len()] {
        let system = type_name::<S>();
        // where it is a function of its own, as the one by hand is, not with the call of `emitted`
        let derivative = counts.get(&format!("{system}::derivative"));
        OWN.map(|method| {
            let symbol = format!("<{system} as nh_bench::contest::Contest>::{method}");
            derivative.filter(|_| method == "emitted").or_else(|| counts.get(&symbol)).copied()
        })
    }

    fn data(&self) -> Data {
        let system = S::ordinary();
        let row = |(state, input): (S::State, S::Input)| {
            let derivative = system.by_hand(0.0, &state, &input);
            let derivative = derivative.to_array().as_ref().to_vec();
            let jacobian = S::jacobian(&system.linearised(0.0, &state, &input));
            [state.to_array().as_ref().to_vec(), S::inputs(&input), derivative, jacobian]
        };
        Data { parameters: system.parameters(), samples: samples::<S>().into_iter().map(row).collect() }
    }
}

/// Nanoseconds per evaluation of a function in a short run.
fn timed<S: Contest, R>(function: impl Fn(&S, f64, &S::State, &S::Input) -> R) -> f64 {
    const PASSES: usize = 40;
    let (system, samples) = (S::ordinary(), samples::<S>());
    let start = Instant::now();
    for _ in 0..PASSES {
        for (state, input) in black_box(&samples) {
            black_box(function(black_box(&system), 0.0, state, input));
        }
    }
    start.elapsed().as_secs_f64() * 1e9 / (PASSES * samples.len()) as f64
}

/// Whether two derivatives are the same up to rounding.
///
/// # Errors
/// The component in which they differ.
pub fn agree(system: &str, contestant: &str, found: &[f64], by_hand: &[f64]) -> Result<(), String> {
    if found.len() != by_hand.len() {
        return Err(format!("{system}: {contestant} has {} components", found.len()));
    }
    for (index, (found, by_hand)) in found.iter().zip(by_hand).enumerate() {
        let difference = (found - by_hand).abs();
        if difference.is_nan() || difference > AGREEMENT * by_hand.abs().max(1.0) {
            return Err(format!("{system}: component {index}: {contestant} {found:e}, by hand {by_hand:e}"));
        }
    }
    Ok(())
}

/// The median; NaN of nothing.
#[must_use]
pub fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}
