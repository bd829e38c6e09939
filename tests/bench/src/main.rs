//! The benchmark of record: instructions and nanoseconds per evaluation of emitted code, of the same
//! function written by hand, and of generated C.
//!
//! ```sh
//! RUSTFLAGS="-C target-cpu=x86-64-v3" cargo run --release -p nh-bench
//! RUSTFLAGS="-C target-cpu=x86-64-v3" cargo run --release -p nh-bench -- arm "five-bar linkage"
//! ```
//!
//! Words that follow choose the systems whose names begin with one of them.

use std::process::ExitCode;

use nh_bench::contest::Random;
use nh_bench::contest_table::{Row, print, print_jacobians, print_peers};
use nh_bench::peers::Workshop;
use nh_bench::runner::{OWN, Run, all};
use nh_counted::callgrind::{self, Counts};
use nh_counted::program;

fn main() -> ExitCode {
    let evaluate = |names: &[String]| {
        let path = program::beside(SAMPLES)?;
        let text = std::fs::read_to_string(path).map_err(|error| error.to_string())?;
        let mut numbers = Random::recorded(text.lines().filter_map(|line| line.parse().ok()).collect());
        for system in chosen(names)? {
            system.evaluate(&mut numbers);
        }
        Ok(())
    };
    program::main(evaluate, measure)
}

/// Where the numbers of all samples are left for the run that is counted: states are returned to their constraints before
/// it, by code that valgrind may not know every instruction of.
const SAMPLES: &str = "nh-bench.samples";

/// The systems whose names begin with one of these; all, if there is none.
fn chosen(names: &[String]) -> Result<Vec<Box<dyn Run>>, String> {
    let mut systems = all();
    if let Some(unknown) = names.iter().find(|name| systems.iter().all(|s| !s.name().starts_with(&***name))) {
        return Err(format!("no system has a name that begins with `{unknown}`"));
    }
    systems.retain(|s| names.is_empty() || names.iter().any(|name| s.name().starts_with(&**name)));
    Ok(systems)
}

fn measure(names: &[String]) -> Result<(), String> {
    let systems = chosen(names)?;
    program::warn_without_fma();
    // 1. a comparison of different functions would mean nothing
    systems.iter().try_for_each(|system| system.compare())?;
    // 2. instructions
    let samples = systems.iter().flat_map(|system| system.data().samples);
    let numbers = samples.flat_map(|[state, input, ..]| state.into_iter().chain(input));
    let lines: Vec<String> = numbers.map(|number| format!("{number:e}")).collect();
    std::fs::write(program::beside(SAMPLES)?, lines.join("\n")).map_err(|error| error.to_string())?;
    let counts = own_counts(names)?;
    // 3. times, and the table
    let rows: Vec<Row> = systems.iter().map(|system| row(system.as_ref(), &counts)).collect();
    print(&rows);
    // 4. other tools, where they are installed
    let directory = program::beside("nh-bench.peers")?;
    match Workshop::open(&directory) {
        Ok(workshop) => {
            let peers: Result<Vec<_>, String> =
                systems.iter().map(|system| workshop.measure(system.as_ref())).collect();
            let peers = peers?;
            print_peers(&rows, &peers);
            print_jacobians(&rows, &peers);
        }
        Err(missing) => println!("\n{missing}"),
    }
    Ok(())
}

/// Instructions of everything compiled into this benchmark.
fn own_counts(names: &[String]) -> Result<Counts, String> {
    if !callgrind::is_present() {
        println!("valgrind is not installed: instructions are not counted\n");
        return Ok(Counts::default());
    }
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    program::count("nh-bench.callgrind", &names, |name| {
        OWN.iter().any(|own| name.ends_with(own)) || name.ends_with("::derivative")
    })
}

/// The row of a system.
fn row(system: &dyn Run, counts: &Counts) -> Row {
    Row { name: system.name(), instructions: system.instructions(counts), nanoseconds: system.time() }
}
