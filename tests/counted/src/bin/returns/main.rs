//! Instructions of the return to position constraints, beside those of the derivative at the same states.
//!
//! ```sh
//! RUSTFLAGS="-C target-cpu=x86-64-v3" cargo run --release -p nh-counted --bin returns
//! ```
//!
//! The states are those that a run by `Dopri5` asks to be returned at the ends of its steps. Each is counted by itself; the
//! figures are means.
#![allow(clippy::cast_precision_loss, reason = "counts stay far below 2⁵²")]
#![allow(non_snake_case, reason = "parameters are written as in mechanics: J, I")]

mod machines;

use std::cell::RefCell;
use std::hint::black_box;
use std::process::ExitCode;

use machines::{MACHINES, on_each};
use nh_counted::{callgrind, program};
use nonholonomic::prelude::*;
use nonholonomic::{ProjectionError, StateFault};

/// Instructions are counted from the beginning of the one function to that of the other.
const COUNTED: [&str; 2] = ["*counted_calls*", "*end_of_calls*"];
/// States of a run, of which as many before are left out.
const SAMPLES: usize = 256;
/// What is counted at them.
const COLUMNS: [&str; 4] = ["nothing", "derivative", "return", "return of what holds"];

/// Callgrind counts from the beginning of this function to that of the next.
#[inline(never)]
fn counted_calls(calls: &mut dyn FnMut()) {
    calls();
    end_of_calls();
}

#[inline(never)]
fn end_of_calls() {
    black_box(());
}

/// A system that remembers the states which were to be returned.
struct Remembering<S: Dynamics> {
    system: S,
    states: RefCell<Vec<S::State>>,
}

impl<S: Dynamics<State: State<Scalar = f64>>> Dynamics for Remembering<S> {
    type State = S::State;
    type Input = S::Input;

    fn derivative(&self, t: f64, state: &S::State, input: &S::Input) -> S::State {
        self.system.derivative(t, state, input)
    }
    fn has_positions(&self) -> bool {
        true
    }
    fn return_to_positions(&self, t: f64, state: &mut S::State) -> Result<f64, ProjectionError> {
        self.states.borrow_mut().push(*state);
        self.system.return_to_positions(t, state)
    }
    fn worst_constraint(&self, t: f64, state: &S::State) -> StateFault {
        self.system.worst_constraint(t, state)
    }
}

/// Counts what a table's line has.
fn count<S>(system: S, start: S::State)
where
    S: Dynamics<State: State<Scalar = f64>, Input = ()> + Copy,
{
    let remembering = Remembering { system, states: RefCell::default() };
    let mut sim = Integrator::new(&remembering, Dopri5::new().rtol(1e-6).atol(1e-6), 0.0, start);
    while remembering.states.borrow().len() < 2 * SAMPLES {
        if let Err(error) = sim.step() {
            eprintln!("{error}");
            return;
        }
    }
    let states: Vec<S::State> = remembering.states.borrow()[SAMPLES..2 * SAMPLES].to_vec();
    let held = |state: &S::State| {
        let mut held = *state;
        for _ in 0..8 {
            _ = system.return_to_positions(0.0, &mut held);
        }
        held
    };
    let held: Vec<S::State> = states.iter().map(held).collect();
    counted_calls(&mut || {
        for state in &states {
            black_box(*black_box(state));
        }
    });
    counted_calls(&mut || {
        for state in &states {
            black_box(black_box(&system).derivative(0.0, black_box(state), &()));
        }
    });
    for states in [&states, &held] {
        counted_calls(&mut || {
            for state in states {
                let mut state = *black_box(state);
                _ = black_box(black_box(&system).return_to_positions(0.0, &mut state));
                black_box(state);
            }
        });
    }
}

fn main() -> ExitCode {
    program::main(
        |_| {
            on_each();
            Ok(())
        },
        measure,
    )
}

fn measure(_: &[String]) -> Result<(), String> {
    program::warn_without_fma();
    if !callgrind::is_present() {
        println!("valgrind is not there: nothing is counted");
        return Ok(());
    }
    let counts = program::count_each(COUNTED, &[], MACHINES.len() * COLUMNS.len())?;
    println!("| | derivative | return | by the derivative | of what holds | by the derivative |");
    println!("|---|--:|--:|--:|--:|--:|");
    for (name, counts) in MACHINES.iter().zip(counts.chunks(COLUMNS.len())) {
        let each = |column: usize| counts[column].saturating_sub(counts[0]) as f64 / SAMPLES as f64;
        let [derivative, back, holds] = [each(1), each(2), each(3)];
        println!(
            "| {name} | {derivative:.0} | {back:.0} | {:.2} | {holds:.0} | {:.2} |",
            back / derivative,
            holds / derivative
        );
    }
    Ok(())
}
