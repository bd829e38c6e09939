//! The error of emitted code and its cost, at every level of accuracy.
//!
//! ```sh
//! RUSTFLAGS="-C target-cpu=x86-64-v3" cargo run --release -p nh-accuracy
//! ```

use std::process::ExitCode;

use nh_accuracy::measured::LEVELS;
use nh_accuracy::{systems, table};
use nh_bench::callgrind::{self, Counts};

/// The argument with which the program calls itself under callgrind.
const EVALUATE: &str = "--evaluate";

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

fn run() -> Result<(), String> {
    let systems = systems::all();
    let arguments: Vec<String> = std::env::args().collect();
    if let [_, argument, level] = arguments.as_slice()
        && argument == EVALUATE
    {
        let level = LEVELS.iter().position(|known| known == level).ok_or("an unknown level")?;
        for system in &systems {
            system.evaluate(level);
        }
        return Ok(());
    }
    if !cfg!(target_feature = "fma") {
        println!("compiled without fused multiply-add: set RUSTFLAGS=\"-C target-cpu=x86-64-v3\"\n");
    }
    let counts = if callgrind::is_present() {
        LEVELS.into_iter().map(counts).collect::<Result<Vec<_>, _>>()?
    } else {
        println!("valgrind is not installed: instructions are not counted\n");
        vec![Counts::default(); LEVELS.len()]
    };
    table::print(&systems, &counts);
    Ok(())
}

/// The instructions of one level.
fn counts(level: &str) -> Result<Counts, String> {
    let program = std::env::current_exe().map_err(|error| error.to_string())?;
    let profile = program.with_file_name(format!("nh-accuracy.{level}.callgrind"));
    callgrind::count(&[&program.to_string_lossy(), EVALUATE, level], &profile, |name| {
        name.ends_with("::counted")
    })
}
