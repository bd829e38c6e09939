//! The error of emitted code and its cost, at every level of accuracy.
//!
//! ```sh
//! RUSTFLAGS="-C target-cpu=x86-64-v3" cargo run --release -p nh-accuracy
//! ```

use std::process::ExitCode;

use nh_accuracy::measured::LEVELS;
use nh_accuracy::{errors_by_level, systems};
use nh_counted::callgrind::{self, Counts};
use nh_counted::program;

fn main() -> ExitCode {
    program::main(evaluate, |_| measure())
}

/// What is counted: the level that is named.
fn evaluate(arguments: &[String]) -> Result<(), String> {
    let [level] = arguments else { return Err("a level is wanted".to_owned()) };
    let level = LEVELS.iter().position(|known| known == level).ok_or("an unknown level")?;
    for system in systems::all() {
        system.evaluate(level);
    }
    Ok(())
}

fn measure() -> Result<(), String> {
    program::warn_without_fma();
    let counts = if callgrind::is_present() {
        LEVELS.into_iter().map(counts).collect::<Result<Vec<_>, _>>()?
    } else {
        println!("valgrind is not installed: instructions are not counted\n");
        vec![Counts::default(); LEVELS.len()]
    };
    errors_by_level::print(&systems::all(), &counts);
    Ok(())
}

/// The instructions of one level.
fn counts(level: &str) -> Result<Counts, String> {
    program::count(&format!("nh-accuracy.{level}.callgrind"), &[level], |name| name.ends_with("::counted"))
}
